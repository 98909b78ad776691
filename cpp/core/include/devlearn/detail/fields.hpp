#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "devlearn/error.hpp"

/// What a Def says of its fields, once, right below its members, and what follows for every Def:
/// equality and validation here; snapshots, the dict, the bindings and the reference elsewhere.
namespace devlearn::detail {

// --- what a field may hold -----------------------------------------------------------------------
// allows(value) is never true of NaN; text() is what a refusal calls allowed.

/// Numbers from `low` to `high`, each included where `in` says so.
struct Interval {
  double low, high;
  bool low_in, high_in;
  std::string_view unit;

  constexpr bool allows(double value) const {
    return (low_in ? value >= low : value > low) && (high_in ? value <= high : value < high);
  }
  std::string text() const;
};
/// [low, high]
constexpr Interval closed(double low, double high, std::string_view unit = "") {
  return {low, high, true, true, unit};
}
/// (low, high)
constexpr Interval open(double low, double high, std::string_view unit = "") {
  return {low, high, false, false, unit};
}
/// (low, high]
constexpr Interval above(double low, double high, std::string_view unit = "") {
  return {low, high, false, true, unit};
}

/// Whole numbers from `low` to `high`.
struct WholeNumbers {
  long long low, high;

  constexpr bool allows(long long value) const { return value >= low && value <= high; }
  std::string text() const;
};
constexpr WholeNumbers whole(long long low, long long high) { return {low, high}; }

/// The members of an enum, by these names in their order.
template <std::size_t N>
struct Names {
  std::array<const char*, N> names;

  template <typename Enum>
  constexpr bool allows(Enum value) const {
    return static_cast<std::size_t>(value) < N;
  }
  std::string text() const {
    std::string text;
    for (const char* name : names) text += (text.empty() ? "'" : " or '") + std::string(name) + "'";
    return text;
  }
};
template <typename... Name>
constexpr Names<sizeof...(Name)> names(Name... name) {
  return {{name...}};
}

/// True or false.
struct Truth {
  constexpr bool allows(bool) const { return true; }
  std::string text() const { return "true or false"; }
};

/// A number, or none.
struct OrNone {
  Interval number;

  constexpr bool allows(const std::optional<double>& value) const {
    return !value || number.allows(*value);
  }
  std::string text() const { return number.text() + ", or none"; }
};
constexpr OrNone or_none(Interval number) { return {number}; }

/// So many numbers.
struct List {
  WholeNumbers count;
  Interval each;

  std::string text() const;
};
constexpr List list(WholeNumbers count, Interval each) { return {count, each}; }

/// Another Def, which has laws of its own.
struct Nested {};

/// One of several Defs, a std::variant of them. Where it is written down as text, the entry `kind`
/// says by name which; where that is missing, it is the first.
template <std::size_t N>
struct OneOf {
  std::array<const char*, N> kinds;
};
template <typename... Kind>
constexpr OneOf<sizeof...(Kind)> one_of(Kind... kind) {
  return {{kind...}};
}
template <typename Range>
struct IsOneOf : std::false_type {};
template <std::size_t N>
struct IsOneOf<OneOf<N>> : std::true_type {};

/// Makes a variant of Defs hold the one of this place, by its defaults.
template <std::size_t I = 0, typename... Defs>
void hold(std::variant<Defs...>& defs, std::size_t place) {
  if constexpr (I < sizeof...(Defs)) {
    if (I == place) {
      defs.template emplace<I>();
    } else {
      hold<I + 1>(defs, place);
    }
  }
}
template <typename... Defs>
std::string owners_of(const std::variant<Defs...>*) {
  std::string text;
  ((text += (text.empty() ? "a " : " or ") + std::string(Defs::fields().owner)), ...);
  return text;
}

inline std::string_view unit_of(const Interval& range) { return range.unit; }
inline std::string_view unit_of(const OrNone& range) { return range.number.unit; }
inline std::string_view unit_of(const List& range) { return range.each.unit; }
template <typename Range>
std::string_view unit_of(const Range&) {
  return "";
}

// --- fields --------------------------------------------------------------------------------------

/// One of them. Its default is the member's own initialiser.
template <typename Def, typename T, typename Range>
struct Field {
  using Value = T;

  const char* name;
  T Def::*member;
  const char* symbol;  ///< the paper's, or nothing
  Range range;
  const char* doc;        ///< without a full stop
  bool may_lack = false;  ///< whether files of earlier builds have no entry of it: its default then

  std::string allowed() const {
    if constexpr (std::is_same_v<Range, Nested>) {
      return std::string("a ") + T::fields().owner;
    } else if constexpr (IsOneOf<Range>::value) {
      return owners_of(static_cast<const T*>(nullptr));
    } else {
      return range.text();
    }
  }
};

template <typename Def, typename T, typename Range>
constexpr Field<Def, T, Range> field(const char* name, T Def::*member, const char* symbol,
                                     Range range, const char* doc) {
  return {name, member, symbol, range, doc, false};
}

/// The same field, which files of earlier builds lack.
template <typename Field>
constexpr Field later(Field field) {
  field.may_lack = true;
  return field;
}

/// A Def's fields in their order, and its name.
template <typename... Each>
struct Fields {
  const char* owner;
  std::tuple<Each...> each;
};
template <typename... Each>
constexpr Fields<Each...> described(const char* owner, Each... each) {
  return {owner, {each...}};
}

/// visit(field) for every field of a Def.
template <typename Def, typename Visit>
void each_field(const Visit& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Def::fields().each);
}

/// Whether two Defs agree in every field.
template <typename Def>
bool same_fields(const Def& a, const Def& b) noexcept {
  return std::apply(
      [&](const auto&... field) { return ((a.*field.member == b.*field.member) && ...); },
      Def::fields().each);
}

/// Whether earlier builds, which lack some fields of a Def, know all that this one says.
template <typename Def>
bool known_to_earlier_builds(const Def& def) {
  bool known = true;
  each_field<Def>([&, usual = Def{}](const auto& field) {
    known = known && (!field.may_lack || def.*field.member == usual.*field.member);
  });
  return known;
}

// --- laws ----------------------------------------------------------------------------------------

/// Such as `LearnerConfig.eta`.
inline std::string quantity(const char* owner, const char* name) {
  return owner + std::string(".") + name;
}

void require_list(const char* owner, const char* name, const List& range,
                  const std::vector<double>& values);

/// Throws InvalidValue, naming the field, unless every one holds what it may; of a nested Def by
/// its own validate().
template <typename Def>
void require_fields(const Def& def) {
  each_field<Def>([&](const auto& field) {
    const auto& value = def.*field.member;
    const char* const owner = Def::fields().owner;
    using Range = std::decay_t<decltype(field.range)>;
    if constexpr (std::is_same_v<Range, Nested>) {
      value.validate();
    } else if constexpr (IsOneOf<Range>::value) {
      std::visit([](const auto& one) { one.validate(); }, value);
    } else if constexpr (std::is_same_v<Range, List>) {
      require_list(owner, field.name, field.range, value);
    } else if (!field.range.allows(value)) {
      if constexpr (std::is_same_v<Range, Interval>) {
        refuse(quantity(owner, field.name), to_text(value), field.allowed());
      } else if constexpr (std::is_same_v<Range, OrNone>) {
        refuse(quantity(owner, field.name), to_text(*value), field.allowed());
      } else {
        refuse(quantity(owner, field.name), std::to_string(static_cast<long long>(value)),
               field.allowed());
      }
    }
  });
}

}  // namespace devlearn::detail
