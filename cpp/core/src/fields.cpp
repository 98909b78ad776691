#include "devlearn/detail/fields.hpp"

namespace devlearn::detail {

std::string Interval::text() const {
  std::string text = low_in ? "in [" : "in (";
  text += to_text(low) + ", " + to_text(high) + (high_in ? "]" : ")");
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

std::string WholeNumbers::text() const {
  return "a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]";
}

std::string List::text() const {
  return std::to_string(count.low) + " ... " + std::to_string(count.high) + " numbers, each " +
         each.text();
}

void require_list(const char* owner, const char* name, const List& range,
                  const std::vector<double>& values) {
  if (!range.count.allows(static_cast<long long>(values.size()))) {
    throw InvalidValue(quantity(owner, name), std::to_string(values.size()) + " numbers",
                       range.text());
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (range.each.allows(values[i])) continue;
    throw InvalidValue(quantity(owner, name) + "[" + std::to_string(i) + "]", to_text(values[i]),
                       range.each.text());
  }
}

}  // namespace devlearn::detail
