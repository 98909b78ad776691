#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "devlearn/detail/fields.hpp"
#include "devlearn/detail/require.hpp"

/// What a Record says of its columns, once, right below them: which member of a row (a step, or a
/// pose) stands in which, what it may be and what it means.
namespace devlearn::detail {

/// Numbers that are finite.
constexpr Interval finite() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {-kInfinity, kInfinity, false, false, ""};
}
/// Numbers from 0 on, infinity too.
constexpr Interval at_least_zero() {
  return {0.0, std::numeric_limits<double>::infinity(), true, true, ""};
}

/// Finite numbers from `low` on, or NaN: unknown, as in files of builds that had no such column.
struct OrUnknown {
  Interval number;

  bool allows(double value) const { return std::isnan(value) || number.allows(value); }
  std::string text() const { return number.text() + ", or nan"; }
};
constexpr OrUnknown or_unknown() { return {finite()}; }
constexpr OrUnknown or_unknown(double low) {
  return {{low, std::numeric_limits<double>::infinity(), true, false, ""}};
}

/// Whole numbers from `low` to the largest of their type.
constexpr WholeNumbers from(long long low) { return {low, std::numeric_limits<long long>::max()}; }

/// Whole numbers from 0 on, or -1: unknown, as in files of builds that had no such column.
struct OrUntold : WholeNumbers {};
constexpr OrUntold or_untold() { return {from(-1)}; }

/// One column. Enums stand in it by their number.
template <typename Record, typename T, typename Row, typename Member, typename Range>
struct Column {
  using Stored = T;
  using Value = Member;

  const char* name;
  std::vector<T> Record::*values;
  Member Row::*of;
  Range range;
  const char* doc;  ///< without a full stop

  /// As safetensors names it.
  static constexpr const char* dtype() {
    if constexpr (std::is_same_v<Member, bool>) return "BOOL";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "U8";
    if constexpr (std::is_same_v<T, std::int32_t>) return "I32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "I64";
    if constexpr (std::is_same_v<T, double>) return "F64";
  }

  /// Whether files of earlier builds may lack it.
  static constexpr bool may_lack() {
    return std::is_same_v<Range, OrUnknown> || std::is_same_v<Range, OrUntold>;
  }
  /// What stands in it then.
  static constexpr T missing() {
    return std::is_same_v<T, double> ? std::numeric_limits<T>::quiet_NaN() : static_cast<T>(-1);
  }

  void append(Record& record, const Row& row) const {
    if constexpr (std::is_same_v<Member, std::optional<T>>) {
      (record.*values).push_back((row.*of).value_or(std::numeric_limits<T>::quiet_NaN()));
    } else {
      (record.*values).push_back(static_cast<T>(row.*of));
    }
  }

  /// Throws InvalidValue unless each of the values may stand here.
  void require_values(const Record& record) const {
    const std::vector<T>& all = record.*values;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (range.allows(all[i])) continue;
      const std::string quantity = "record." + std::string(name) + "[" + std::to_string(i) + "]";
      if constexpr (std::is_same_v<Range, Interval> || std::is_same_v<Range, OrUnknown>) {
        refuse(quantity, to_text(all[i]), range.text());
      } else {
        const long long most = std::min<long long>(range.high, std::numeric_limits<T>::max());
        require_count(quantity, all[i], range.low, most);
      }
    }
  }
};

template <typename Record, typename T, typename Row, typename Member, typename Range>
constexpr Column<Record, T, Row, Member, Range> column(const char* name,
                                                       std::vector<T> Record::*values,
                                                       Member Row::*of, Range range,
                                                       const char* doc) {
  return {name, values, of, range, doc};
}

/// One field of rows that are kept whole.
template <typename Row, typename T>
struct RowField {
  const char* name;
  T Row::*of;
  const char* doc;  ///< without a full stop
};

template <typename Row, typename T>
constexpr RowField<Row, T> row_field(const char* name, T Row::*of, const char* doc) {
  return {name, of, doc};
}

/// visit(column) for each of them.
template <typename Columns, typename Visit>
void each_column(const Columns& columns, const Visit& visit) {
  std::apply([&](const auto&... column) { (visit(column), ...); }, columns);
}

}  // namespace devlearn::detail
