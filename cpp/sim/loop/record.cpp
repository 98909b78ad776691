#include "devlearn/record.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "loop/record_columns.hpp"

namespace devlearn {
namespace {

// Room for some more in every column before the first grows, so that they stay of one length where
// memory ends.
template <typename... Columns>
void make_room(std::size_t more, Columns&... columns) {
  const auto grow = [&](auto& column) {
    const std::size_t size = column.size();
    if (column.capacity() - size >= more) return;
    column.reserve(std::max<std::size_t>({64, size + more, 2 * size}));
  };
  (grow(columns), ...);
}

// Calls for a whole number in [least, most] everywhere in a column.
template <typename T>
void require_each(const std::string& name, const std::vector<T>& column, T least, T most) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (column[i] >= least && column[i] <= most) continue;
    require_count("record." + name + "[" + std::to_string(i) + "]", column[i], least, most);
  }
}

}  // namespace

void Record::begin_round(std::int32_t number, const Pose& pose) {
  if (!rounds.empty() && rounds.back().round == number &&
      Pose{x.back(), y.back(), heading.back()} == pose) {
    return;
  }
  make_room(1, rounds, x, y, heading);
  rounds.push_back({number, 0, false});
  x.push_back(pose.x);
  y.push_back(pose.y);
  heading.push_back(pose.heading);
}

void Record::reserve(std::size_t more) {
  make_room(more, round, situation, motion, kind, sef, smf, smf_used, collided, arrived,
            goal_distance, clearance, event, reduced, explored_count, effective_count, x, y,
            heading);
}

void Record::append(const StepRecord& step) {
  reserve(1);
  round.push_back(step.round);
  situation.push_back(step.situation);
  motion.push_back(step.motion);
  kind.push_back(static_cast<std::uint8_t>(step.kind));
  sef.push_back(step.sef);
  smf.push_back(step.smf);
  smf_used.push_back(step.smf_used);
  collided.push_back(step.collided);
  arrived.push_back(step.arrived);
  goal_distance.push_back(step.goal_distance);
  clearance.push_back(step.clearance);
  event.push_back(static_cast<std::uint8_t>(step.event));
  reduced.push_back(step.reduced);
  explored_count.push_back(step.explored_count);
  effective_count.push_back(step.effective_count);
  x.push_back(step.pose.x);
  y.push_back(step.pose.y);
  heading.push_back(step.pose.heading);
  count(step);
}

void Record::count(const StepRecord& step) noexcept {
  rounds.back().steps += 1;
  rounds.back().arrived |= step.arrived;
}

void Record::validate() const {
  std::size_t step = 0;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const std::string name = "record.rounds[" + std::to_string(i) + "]";
    require_count(name + ".round", rounds[i].round, 1, std::numeric_limits<std::int32_t>::max());
    require_count(name + ".steps", rounds[i].steps, 0, static_cast<long long>(steps() - step));
    step += static_cast<std::size_t>(rounds[i].steps);
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
  each_step_column(*this, [&](const char* name, const auto& column, const char*) {
    require_size(name, column.size(), steps());
  });
  each_pose_column(*this, [&](const char* name, const auto& column, const char*) {
    require_size(name, column.size(), steps() + rounds.size());
  });
  require_count("record.sonar_count", sonar_count, 0, 720);
  require_size("echoes", echoes.size(), steps() * static_cast<std::size_t>(sonar_count));

  constexpr std::uint8_t kNo = 0, kYes = 1;
  constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  constexpr std::int64_t kLargest64 = std::numeric_limits<std::int64_t>::max();
  require_each("round", round, 1, kLargest);
  require_each("situation", situation, std::int64_t{0}, kLargest64);
  require_each("motion", motion, 0, kLargest);
  require_each("kind", kind, kNo, static_cast<std::uint8_t>(Kind::kUnstated));
  require_each("collided", collided, kNo, kYes);
  require_each("arrived", arrived, kNo, kYes);
  require_each("event", event, kNo, static_cast<std::uint8_t>(Event::kAbandonment));
  require_each("reduced", reduced, 0, kLargest);
  require_each("explored_count", explored_count, std::int64_t{0}, kLargest64);
  require_each("effective_count", effective_count, std::int64_t{0}, kLargest64);
}

}  // namespace devlearn
