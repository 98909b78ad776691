#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/field_laws.hpp"
#include "devlearn/error.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/trial_snapshot.hpp"

using devlearn::InvalidValue;
using devlearn::NoiseDef;
using devlearn::Record;
using devlearn::RobotDef;
using devlearn::Trial;
using devlearn::TrialConfig;
using devlearn::World;
using devlearn::detail::each_column;

namespace {

template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](T one, T other) { return one == other || (one != one && other != other); });
}

}  // namespace

TEST_CASE("every member of a trial's Defs is described, compared, and refused beyond its bounds") {
  field_laws::check_fields<RobotDef>();
  field_laws::check_fields<NoiseDef>();
  field_laws::check_fields<TrialConfig>();
}

TEST_CASE("every field of a trial's configuration is saved, at any depth") {
  const auto config = field_laws::with_every_field_changed<TrialConfig>();
  const auto bytes = to_bytes(Trial(World{}, config, 3));
  CHECK(devlearn::load_trial(bytes.data(), bytes.size()).trial.config() == config);
}

TEST_CASE("every column has a value a step or a pose, is saved, and refuses what it cannot hold") {
  Trial trial(World{});
  Record record;
  trial.free_learning(record, 50);
  devlearn::SaveOptions options;
  options.record = &record;
  const auto bytes = to_bytes(trial, options);
  const Record loaded = *devlearn::load_trial(bytes.data(), bytes.size()).record;
  std::set<std::string> names;
  const auto check = [&](std::size_t length) {
    return [&, length](const auto& column) {
      CAPTURE(column.name);
      CHECK(names.insert(column.name).second);
      CHECK((record.*column.values).size() == length);
      CHECK(same(loaded.*column.values, record.*column.values));
      Record broken = record;
      (broken.*column.values).pop_back();
      CHECK_THROWS_AS(broken.validate(), InvalidValue);
      using Range = std::decay_t<decltype(column.range)>;
      broken = record;
      const auto refused = [&](auto value) {
        auto& last = (broken.*column.values).back();
        last = static_cast<std::decay_t<decltype(last)>>(value);
        const std::string place = "[" + std::to_string(length - 1) + "]";
        try {
          broken.validate();
          FAIL_CHECK("accepted");
        } catch (const InvalidValue& error) {
          CHECK(error.quantity() == "record." + std::string(column.name) + place);
        }
      };
      if constexpr (std::is_same_v<Range, devlearn::detail::Interval>) {
        refused(std::numeric_limits<double>::quiet_NaN());
        if (column.range.low_in) refused(column.range.low - 1.0);
        if (!column.range.high_in) refused(column.range.high);
      } else if constexpr (std::is_same_v<Range, devlearn::detail::OrUnknown>) {
        refused(std::numeric_limits<double>::infinity());
      } else {
        refused(column.range.low - 1);
        if (column.range.high < 256) refused(column.range.high + 1);
      }
    };
  };
  each_column(Record::step_columns(), check(50));
  each_column(Record::pose_columns(), check(51));
}
