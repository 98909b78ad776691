#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/tally.hpp"
#include "devlearn/trial.hpp"
#include "sim/open_world.hpp"

using namespace devlearn;

namespace {

// An ineffective step that changed nothing.
Step step_of(SituationId situation, int motion, double smf_used = -1.0) {
  Step step;
  step.round = 1;
  step.situation = situation;
  step.motion = motion;
  step.smf_used = smf_used;
  return step;
}

// Of one round.
RoundTally counted(const std::vector<Step>& steps) {
  Tally tally;
  tally.begin_round(1, {});
  for (const Step& step : steps) tally.count(step);
  return tally.rounds().back();
}

void check_same(const Tally& a, const Tally& b) {
  REQUIRE(a.rounds().size() == b.rounds().size());
  for (std::size_t i = 0; i < a.rounds().size(); ++i) {
    CAPTURE(i);
    detail::each_column(RoundTally::fields(), [&](const auto& field) {
      CAPTURE(field.name);
      CHECK(a.rounds()[i].*field.of == b.rounds()[i].*field.of);
    });
  }
}

// Throws when asked for a motion after so many.
class Failing : public Agent {
 public:
  explicit Failing(int motions) : left_(motions) {}
  Choice choose(const Observation&) override {
    if (left_-- == 0) throw std::runtime_error("no more");
    return {0, Kind::kUnstated};
  }
  Development observe(const Outcome&) override { return {}; }

 private:
  int left_;
};

}  // namespace

TEST_CASE("A new tally holds nothing") {
  const Tally tally;
  CHECK(tally.rounds().empty());
  CHECK(tally.steps() == 0);
}

TEST_CASE("An ineffective mapping is known from its second execution on, whatever it then does") {
  CHECK(counted({step_of(4, 1)}).known_ineffective == 0);
  CHECK(counted({step_of(4, 1), step_of(4, 1)}).known_ineffective == 1);
  CHECK(counted({step_of(4, 1), step_of(4, 1, 3.0), step_of(4, 1)}).known_ineffective == 2);
  CHECK(counted({step_of(4, 1, 0.0), step_of(4, 1), step_of(4, 1)}).known_ineffective == 0);
}

TEST_CASE("Mappings differ in their situation or in their motion, however large these are") {
  const SituationId far = INT64_MAX;
  const int last = 65534;
  const RoundTally round =
      counted({step_of(0, 0), step_of(0, last), step_of(far, 0), step_of(far, last),
               step_of(far - 1, last), step_of(0, 1), step_of(far, last)});
  CHECK(round.mappings == 6);
  CHECK(round.known_ineffective == 1);
  CHECK(round.ineffective == 7);
}

TEST_CASE("What is known of mappings stays where motions of a higher index are met") {
  std::vector<Step> steps;
  for (int motion = 0; motion < 100; ++motion) {
    for (SituationId situation = 0; situation < 5; ++situation) {
      steps.push_back(step_of(situation, motion, motion % 3 == 0 ? -1.0 : 1.0));
    }
  }
  const std::size_t once = steps.size();
  for (std::size_t i = 0; i < once; ++i) steps.push_back(steps[i]);
  const RoundTally round = counted(steps);
  CHECK(round.mappings == 500);
  CHECK(round.known_ineffective == 170);
}

TEST_CASE("Mappings stay known from round to round") {
  Tally tally;
  tally.begin_round(1, {});
  tally.count(step_of(4, 1));
  tally.count(step_of(4, 2));
  tally.begin_round(2, {1.0, 0.0, 0.0});
  tally.count(step_of(4, 1));
  tally.count(step_of(4, 3));
  CHECK(tally.rounds()[0].mappings == 2);
  CHECK(tally.rounds()[1].mappings == 3);
  CHECK(tally.rounds()[1].known_ineffective == 1);
}

TEST_CASE("Exploring, touching, cost and updates are counted, these apart where ineffective") {
  std::vector<Step> steps;
  for (const Event event : {Event::kNothing, Event::kExtension, Event::kRejection,
                            Event::kOrientation, Event::kAbandonment}) {
    Step step = step_of(1, 1, event == Event::kAbandonment ? -0.5 : 0.5);
    step.event = event;
    step.kind = event == Event::kRejection ? Kind::kExplore : Kind::kExploit;
    step.collided = event == Event::kOrientation;
    step.cost = step.collided ? 6.0 : 1.0;
    steps.push_back(step);
  }
  const RoundTally round = counted(steps);
  CHECK(round.steps == 5);
  CHECK(round.updates == 3);
  CHECK(round.ineffective_updates == 1);
  CHECK(round.ineffective == 1);
  CHECK(round.explored == 1);
  CHECK(round.touches == 1);
  CHECK(round.cost == 10.0);
}

TEST_CASE("The first arrival is a step of its round, and 0 where there is none") {
  Step there = step_of(2, 0);
  there.arrived = true;
  CHECK(counted({step_of(1, 0), there, step_of(1, 0), there}).first_arrival == 2);
  CHECK(counted({step_of(1, 0), there, step_of(1, 0)}).arrived);
  CHECK(counted({step_of(1, 0)}).first_arrival == 0);
  CHECK_FALSE(counted({step_of(1, 0)}).arrived);
}

TEST_CASE("The fingerprint tells the motions apart: which, in which order, how many") {
  const std::vector<std::vector<int>> paths = {{},     {0},    {1},       {0, 0},    {0, 1},
                                               {1, 0}, {1, 1}, {0, 0, 0}, {0, 1, 0}, {65534}};
  std::vector<std::uint64_t> values;
  for (const auto& path : paths) {
    std::vector<Step> steps, elsewhere;
    for (const int motion : path) {
      steps.push_back(step_of(1, motion));
      elsewhere.push_back(step_of(99, motion, 2.0));
    }
    const std::uint64_t value = counted(steps).path;
    CHECK(value == counted(elsewhere).path);
    for (const std::uint64_t other : values) CHECK(value != other);
    values.push_back(value);
  }
}

TEST_CASE("A round goes on from the pose where it stopped, and from no other") {
  Tally tally;
  tally.begin_round(3, {1.0, 2.0, 30.0});
  Step step = step_of(1, 0);
  step.pose = {4.0, 5.0, 60.0};
  tally.count(step);
  tally.begin_round(3, step.pose);
  tally.count(step);
  CHECK(tally.rounds().size() == 1);
  tally.begin_round(3, {1.0, 2.0, 30.0});
  CHECK(tally.rounds().size() == 2);
  CHECK(tally.steps() == 2);
}

TEST_CASE("A round of no step holds what was so far") {
  Tally tally;
  tally.begin_round(1, {});
  Step step = step_of(1, 0);
  step.explored_count = 7;
  step.effective_count = 8;
  tally.count(step);
  tally.begin_round(2, {});
  const RoundTally& none = tally.rounds().back();
  CHECK(none.steps == 0);
  CHECK(none.path == 0);
  CHECK(none.mappings == 1);
  CHECK(none.explored_count == 7);
  CHECK(none.effective_count == 8);
}

TEST_CASE("What a trial counts is what its record comes to, the record full or of rounds only") {
  const World world = open_world();
  for (const bool rounds_only : {false, true}) {
    Trial trial(world, {}, 3), recorded_trial(world, {}, 3);
    Tally tally;
    RunOptions options;
    options.tally = &tally;
    options.rounds_only = rounds_only;
    const auto phases = [](Trial& t, Record& record, const RunOptions& o) {
      t.free_learning(record, 300, o);
      t.path_learning(record, 20, 40, o);
      t.finish_round(record, 100, o);
      t.run(record, 10, o);
    };
    Record counted_beside, full;
    phases(trial, counted_beside, options);
    phases(recorded_trial, full, {});
    CHECK(tally.steps() == static_cast<std::int64_t>(full.steps()));
    check_same(tally, Tally::of(full));
  }
}

TEST_CASE("A run is the same with a tally as without") {
  const World world = open_world();
  Tally tally;
  RunOptions options;
  options.tally = &tally;
  const auto record_of = [&](const RunOptions& o) {
    Trial trial(world, {}, 5);
    return recorded([&](Record& r) { trial.path_learning(r, 10, 60, o); });
  };
  const Record with = record_of(options), without = record_of({});
  detail::each_column(Record::pose_columns(),
                      [&](auto& column) { CHECK(with.*column.values == without.*column.values); });
}

TEST_CASE("A round that begins at the target is counted, arrived by no step") {
  WorldDef def = open_world().def();
  def.target = {def.start.x, def.start.y};
  Trial trial(World(def), {}, 1);
  Tally tally;
  RunOptions options;
  options.tally = &tally;
  Record record;
  trial.path_learning(record, 2, 10, options);
  REQUIRE(tally.rounds().size() == 2);
  for (const RoundTally& round : tally.rounds()) {
    CHECK(round.arrived);
    CHECK(round.steps == 0);
    CHECK(round.first_arrival == 0);
  }
  check_same(tally, Tally::of(record));
}

TEST_CASE("What was finished before an agent throws is counted") {
  Trial trial(open_world(), {}, 1, std::make_shared<Failing>(5));
  Tally tally;
  RunOptions options;
  options.tally = &tally;
  Record record;
  CHECK_THROWS_AS(trial.free_learning(record, 9, options), std::runtime_error);
  CHECK(tally.steps() == 5);
  check_same(tally, Tally::of(record));
}

TEST_CASE("A record that tells no steps, or tells them wrongly, is refused") {
  Trial trial(open_world(), {}, 1);
  RunOptions options;
  options.rounds_only = true;
  Record brief;
  trial.run(brief, 3, options);
  check_refused([&] { Tally::of(brief); }, "record", "rounds only");
  Record wrong;
  Trial(open_world(), {}, 1).run(wrong, 3);
  wrong.motion[1] = -1;
  check_refused([&] { Tally::of(wrong); }, "record.motion[1]", "-1");
  wrong.motion[1] = 65535;
  check_refused([&] { Tally::of(wrong); }, "record.motion[1]", "65535");
}
