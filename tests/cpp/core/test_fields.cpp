#include <doctest/doctest.h>

#include "core/field_laws.hpp"
#include "devlearn/adaptive.hpp"
#include "devlearn/evaluation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/snapshot.hpp"

using devlearn::AdaptiveConfig;
using devlearn::AdaptiveLearner;
using devlearn::Learner;
using devlearn::LearnerConfig;
using devlearn::StateEvaluation;

TEST_CASE(
    "every member of the learner's Defs is described, compared, and refused beyond its bounds") {
  field_laws::check_fields<LearnerConfig>();
  field_laws::check_fields<AdaptiveConfig>();
  field_laws::check_fields<StateEvaluation>();
}

TEST_CASE("every field of a learner's configuration is saved") {
  const auto config = field_laws::with_every_field_changed<LearnerConfig>();
  const auto bytes = to_bytes(Learner(config, 3));
  CHECK(devlearn::load_learner(bytes.data(), bytes.size()).config() == config);
  const auto adaptive = field_laws::with_every_field_changed<AdaptiveConfig>();
  const auto saved = to_bytes(AdaptiveLearner(adaptive, 3));
  CHECK(devlearn::load_adaptive_learner(saved.data(), saved.size()).config() == adaptive);
}

TEST_CASE("a range says what it allows as a refusal does") {
  using namespace devlearn::detail;
  CHECK(closed(0.0, 2.5, "m").text() == "in [0, 2.5] m");
  CHECK(open(0.0, 2.5).text() == "in (0, 2.5)");
  CHECK(above(0.0, 2.5, "s").text() == "in (0, 2.5] s");
  CHECK(whole(1, 3).text() == "a whole number in [1, 3]");
  CHECK(names("a", "b", "c").text() == "'a' or 'b' or 'c'");
  CHECK(or_none(above(0.0, 1.0, "m")).text() == "in (0, 1] m, or none");
  CHECK(list(whole(1, 3), closed(-1.0, 1.0, "m")).text() == "1 ... 3 numbers, each in [-1, 1] m");
}
