#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "devlearn/detail/fields.hpp"

/// Laws of every Def, stated over what it says of its fields.
namespace field_laws {

using namespace devlearn::detail;

template <typename Def>
constexpr std::size_t count_of = std::tuple_size_v<decltype(Def::fields().each)>;

/// All members of a Def that has so many of them: another number does not compile.
template <typename Def>
auto members_of(const Def& def) {
  constexpr std::size_t n = count_of<Def>;
  if constexpr (n == 2) {
    const auto& [a, b] = def;
    return std::tuple(&a, &b);
  } else if constexpr (n == 3) {
    const auto& [a, b, c] = def;
    return std::tuple(&a, &b, &c);
  } else if constexpr (n == 4) {
    const auto& [a, b, c, d] = def;
    return std::tuple(&a, &b, &c, &d);
  } else if constexpr (n == 5) {
    const auto& [a, b, c, d, e] = def;
    return std::tuple(&a, &b, &c, &d, &e);
  } else if constexpr (n == 6) {
    const auto& [a, b, c, d, e, f] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f);
  } else if constexpr (n == 7) {
    const auto& [a, b, c, d, e, f, g] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g);
  } else if constexpr (n == 8) {
    const auto& [a, b, c, d, e, f, g, h] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g, &h);
  } else if constexpr (n == 9) {
    const auto& [a, b, c, d, e, f, g, h, i] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g, &h, &i);
  } else if constexpr (n == 10) {
    const auto& [a, b, c, d, e, f, g, h, i, j] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g, &h, &i, &j);
  } else if constexpr (n == 12) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l);
  } else if constexpr (n == 13) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l, &m);
  } else {
    static_assert(n == 14, "a line more, please");
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o] = def;
    return std::tuple(&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l, &m, &o);
  }
}

/// Every member is described, in order.
template <typename Def>
void check_every_member_is_described() {
  const Def def;
  const auto described =
      std::apply([&](const auto&... field) { return std::tuple(&(def.*field.member)...); },
                 Def::fields().each);
  CHECK(described == members_of(def));
}

/// Sets a field to another value near its default, which it may have.
template <typename Field, typename T>
void change(const Field& field, T& value) {
  if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>((static_cast<std::size_t>(value) + 1) % field.range.names.size());
  } else if constexpr (std::is_same_v<T, bool>) {
    value = !value;
  } else if constexpr (std::is_same_v<T, double>) {
    const double more = value == 0.0 ? 0.1 : 1.1 * value;
    value = field.range.allows(more) ? more : 0.9 * value;
    CHECK(field.range.allows(value));
  } else if constexpr (std::is_same_v<T, std::optional<double>>) {
    value = value ? 1.1 * *value : 0.1;
    CHECK(field.range.allows(value));
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    value.push_back(0.5);
  } else if constexpr (std::is_integral_v<T>) {
    value += 1;
    CHECK(field.range.allows(value));
  } else if constexpr (IsOneOf<std::decay_t<decltype(field.range)>>::value) {
    using Other = std::decay_t<decltype(std::get<1>(value))>;
    Other other;
    each_field<Other>([&](const auto& inner) { change(inner, other.*inner.member); });
    value = other;
  } else {
    each_field<T>([&](const auto& inner) { change(inner, value.*inner.member); });
  }
}

template <typename Def>
Def with_every_field_changed() {
  Def def;
  each_field<Def>([&](const auto& field) { change(field, def.*field.member); });
  return def;
}

template <typename Def>
void check_every_field_is_compared() {
  each_field<Def>([](const auto& field) {
    CAPTURE(field.name);
    Def changed;
    change(field, changed.*field.member);
    CHECK(changed != Def{});
    CHECK_FALSE(changed == Def{});
    changed.*field.member = Def{}.*field.member;
    CHECK(changed == Def{});
    if constexpr (std::is_same_v<std::decay_t<decltype(changed.*field.member)>, double>) {
      changed.*field.member = std::numeric_limits<double>::quiet_NaN();
      CHECK(changed != changed);
    }
  });
}

template <typename Def, typename T>
void check_refused(T Def::*member, T value, const std::string& name, const std::string& allowed) {
  Def def;
  def.*member = std::move(value);
  try {
    def.validate();
    FAIL_CHECK("accepted");
  } catch (const devlearn::InvalidValue& error) {
    CHECK(error.quantity() == Def::fields().owner + ("." + name));
    CHECK(error.allowed() == allowed);
  }
}

template <typename Def, typename T>
void check_accepted(T Def::*member, T value) {
  Def def;
  def.*member = std::move(value);
  CHECK_NOTHROW(require_fields(def));
}

/// try_value(value, allowed) for what lies at and just beyond each bound, and for no numbers.
template <typename Try>
void at_the_bounds(const Interval& range, const Try& try_value) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  try_value(range.low, range.low_in);
  try_value(std::nextafter(range.low, kInfinite), true);
  try_value(std::nextafter(range.low, -kInfinite), false);
  try_value(range.high, range.high_in);
  try_value(std::nextafter(range.high, -kInfinite), true);
  try_value(std::nextafter(range.high, kInfinite), false);
  for (const double none : {kInfinite, -kInfinite, std::nan("")}) try_value(none, false);
}

template <typename Def>
void check_every_bound() {
  each_field<Def>([](const auto& field) {
    CAPTURE(field.name);
    using Field = std::decay_t<decltype(field)>;
    using T = typename Field::Value;
    const auto try_value = [&](T value, bool allowed) {
      if (allowed) check_accepted(field.member, value);
      if (!allowed) check_refused(field.member, value, field.name, field.allowed());
    };
    using Range = std::decay_t<decltype(field.range)>;
    if constexpr (std::is_same_v<Range, Interval>) {
      at_the_bounds(field.range, try_value);
    } else if constexpr (std::is_same_v<Range, OrNone>) {
      at_the_bounds(field.range.number, try_value);
      try_value(std::nullopt, true);
    } else if constexpr (std::is_same_v<Range, WholeNumbers>) {
      try_value(static_cast<T>(field.range.low), true);
      try_value(static_cast<T>(field.range.low - 1), false);
      try_value(static_cast<T>(field.range.high), true);
      try_value(static_cast<T>(field.range.high + 1), false);
    } else if constexpr (std::is_same_v<Range, List>) {
      const auto most = static_cast<std::size_t>(field.range.count.high);
      try_value(T(static_cast<std::size_t>(field.range.count.low)), true);
      if (field.range.count.low > 0) {
        try_value(T(static_cast<std::size_t>(field.range.count.low - 1)), false);
      }
      try_value(T(most), true);
      try_value(T(most + 1), false);
      at_the_bounds(field.range.each, [&](double value, bool allowed) {
        if (allowed) check_accepted(field.member, T{0.0, value});
        if (allowed) return;
        check_refused(field.member, T{0.0, value}, std::string(field.name) + "[1]",
                      field.range.each.text());
      });
    } else if constexpr (std::is_enum_v<T>) {
      const std::size_t count = field.range.names.size();
      for (std::size_t i = 0; i < count; ++i) try_value(static_cast<T>(i), true);
      try_value(static_cast<T>(count), false);
    }
  });
}

template <typename Def>
void check_fields() {
  CAPTURE(Def::fields().owner);
  check_every_member_is_described<Def>();
  check_every_field_is_compared<Def>();
  check_every_bound<Def>();
}

}  // namespace field_laws
