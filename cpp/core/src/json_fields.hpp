#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "devlearn/detail/fields.hpp"
#include "json.hpp"

namespace devlearn::json {

template <typename Def>
Def def_at(const Node& node, const char* besides = nullptr);

/// A field's value, which lies in its range.
template <typename Field>
typename Field::Value value_at(const Node& node, const Field& field) {
  using T = typename Field::Value;
  using Range = std::decay_t<decltype(field.range)>;
  if constexpr (std::is_same_v<Range, detail::Nested>) {
    return def_at<T>(node);
  } else if constexpr (detail::IsOneOf<Range>::value) {
    T value;
    if (node.has("kind")) {
      const auto& kinds = field.range.kinds;
      std::string allowed;
      for (const char* kind : kinds) allowed += (allowed.empty() ? "" : " or ") + std::string(kind);
      const auto found = std::find(kinds.begin(), kinds.end(), node["kind"].text(allowed));
      if (found == kinds.end()) node["kind"].refuse(allowed);
      detail::hold(value, static_cast<std::size_t>(found - kinds.begin()));
    }
    std::visit([&](auto& def) { def = def_at<std::decay_t<decltype(def)>>(node, "kind"); }, value);
    return value;
  } else if constexpr (std::is_same_v<Range, detail::List>) {
    const detail::Interval& each = field.range.each;
    if (!field.range.count.allows(static_cast<long long>(node.size())))
      node.refuse(field.allowed());
    T values;
    node.each_element([&](const Node& element) {
      values.push_back(element.number(each.text()));
      if (!each.allows(values.back())) element.refuse(each.text());
    });
    return values;
  } else if constexpr (std::is_enum_v<T>) {
    const auto& names = field.range.names;
    const auto found = std::find(names.begin(), names.end(), node.text(field.allowed()));
    if (found == names.end()) node.refuse(field.allowed());
    return static_cast<T>(found - names.begin());
  } else if constexpr (std::is_same_v<Range, detail::Truth>) {
    return node.truth(field.allowed());
  } else if constexpr (std::is_same_v<Range, detail::WholeNumbers>) {
    const auto value = static_cast<long long>(node.whole_number(field.allowed()));
    if (!field.range.allows(value)) node.refuse(field.allowed());
    return static_cast<T>(value);
  } else {
    if (std::is_same_v<Range, detail::OrNone> && node.is_null()) return T{};
    const T value = node.number(field.allowed());
    if (!field.range.allows(value)) node.refuse(field.allowed());
    return value;
  }
}

/// A Def from an object of its fields; those left out keep their defaults. Laws of several fields
/// together are the Def's own: validate(). besides: a name that may be there, too.
template <typename Def>
Def def_at(const Node& node, const char* besides) {
  Def def;
  std::vector<std::string_view> names;
  detail::each_field<Def>([&](const auto& field) { names.push_back(field.name); });
  if (besides != nullptr) names.push_back(besides);
  node.require_known(names);
  detail::each_field<Def>([&](const auto& field) {
    if (node.has(field.name)) def.*field.member = value_at(node[field.name], field);
  });
  return def;
}

}  // namespace devlearn::json
