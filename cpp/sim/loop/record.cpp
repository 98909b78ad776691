#include "devlearn/record.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {
namespace {

// Room for some more in a column: a look at every step, and once in a while more memory.
template <typename T>
[[gnu::noinline]] void grow(std::size_t more, std::vector<T>& column) {
  column.reserve(std::max<std::size_t>({64, column.size() + more, 2 * column.size()}));
}
template <typename T>
void make_room(std::size_t more, std::vector<T>& column) {
  if (column.capacity() - column.size() < more) grow(more, column);
}

constexpr auto kStepColumns = Record::step_columns();
constexpr auto kPoseColumns = Record::pose_columns();

}  // namespace

// Everywhere there is room before the first column grows, so that they stay of one length where
// memory ends.

void Record::begin_round(std::int32_t number, const Pose& pose, std::int64_t began) {
  if (!rounds.empty() && rounds.back().round == number &&
      Pose{x.back(), y.back(), heading.back()} == pose) {
    return;
  }
  make_room(1, rounds);
  detail::each_column(kPoseColumns, [&](auto& column) { make_room(1, this->*column.values); });
  rounds.push_back({number, 0, false, began});
  detail::each_column(kPoseColumns, [&](auto& column) { column.append(*this, pose); });
}

void Record::reserve(std::size_t more) {
  const auto grow = [&](auto& column) { make_room(more, this->*column.values); };
  detail::each_column(kStepColumns, grow);
  detail::each_column(kPoseColumns, grow);
}

void Record::append(const Step& step) {
  reserve(1);
  detail::each_column(kStepColumns, [&](auto& column) { column.append(*this, step); });
  detail::each_column(kPoseColumns, [&](auto& column) { column.append(*this, step.pose); });
  count(step);
}

void Record::count(const Step& step) noexcept {
  rounds.back().steps += 1;
  rounds.back().arrived |= step.arrived;
}

void Record::validate() const {
  constexpr long long kMany = std::numeric_limits<std::int64_t>::max();
  const bool brief = rounds_only();
  const std::size_t poses = brief ? 0 : steps() + rounds.size();
  std::size_t step = 0;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const std::string name = "record.rounds[" + std::to_string(i) + "]";
    require_count(name + ".round", rounds[i].round, 1, std::numeric_limits<std::int32_t>::max());
    const auto left = static_cast<long long>(steps() - step);
    require_count(name + ".steps", rounds[i].steps, 0, brief ? kMany : left);
    require_count(name + ".began", rounds[i].began, -1, kMany);
    if (!brief) step += static_cast<std::size_t>(rounds[i].steps);
  }
  if (step != steps()) {
    throw InvalidValue("record.rounds.steps", "a sum of " + std::to_string(step),
                       std::to_string(steps()) + ", the number of steps");
  }
  const auto require_size = [](const char* name, std::size_t size, std::size_t expected) {
    if (size == expected) return;
    throw InvalidValue("record." + std::string(name), std::to_string(size) + " values",
                       std::to_string(expected) + " values");
  };
  detail::each_column(kStepColumns, [&](auto& column) {
    require_size(column.name, (this->*column.values).size(), steps());
  });
  detail::each_column(kPoseColumns, [&](auto& column) {
    require_size(column.name, (this->*column.values).size(), poses);
  });
  require_count("record.sonar_count", sonar_count, 0, 720);
  require_size("echoes", echoes.size(), steps() * static_cast<std::size_t>(sonar_count));
  detail::each_column(kStepColumns, [&](auto& column) { column.require_values(*this); });
  detail::each_column(kPoseColumns, [&](auto& column) { column.require_values(*this); });
  if (!brief) require_steps_in_rounds();
}

// What `rounds` says of the steps is what they say.
void Record::require_steps_in_rounds() const {
  std::size_t step = 0;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    bool reached = false;
    for (const std::size_t end = step + static_cast<std::size_t>(rounds[i].steps); step < end;
         ++step) {
      if (round[step] != rounds[i].round) {
        throw InvalidValue("record.round[" + std::to_string(step) + "]",
                           std::to_string(round[step]),
                           std::to_string(rounds[i].round) + ", that of its round");
      }
      reached |= arrived[step] != 0;
    }
    if (reached && !rounds[i].arrived) {
      throw InvalidValue("record.rounds[" + std::to_string(i) + "].arrived", "false",
                         "true, as one of its steps arrived");
    }
  }
}

}  // namespace devlearn
