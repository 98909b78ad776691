#include "devlearn/adaptive.hpp"

#include <optional>

#include "bindings.hpp"
#include "config.hpp"
#include "snapshots.hpp"

namespace devlearn::python {
namespace {

using IdleLearner = IdleOf<AdaptiveLearner>;

struct SituationsTag {
  using type = std::size_t;
  static constexpr const char* quantity = "situations";
  static constexpr const char* allowed = "a whole number in [0, 2^31 - 2]";
};
struct OutcomesTag {
  using type = std::size_t;
  static constexpr const char* quantity = "outcomes";
  static constexpr const char* allowed = "a whole number in [0, 2^32 - 2]";
};

void bind_results(py::module_& m) {
  py::class_<AdaptiveMemory> memory(
      m, "AdaptiveMemory",
      "What one situation holds, as a copy. The three lists of motion indices are views of the\n"
      "losses: no outcome yet, expected loss at most E, more than E. N motions.");
  memory
      .def_readonly("first_estimate", &AdaptiveMemory::first_estimate,
                    "h: the estimate at the first meeting.")
      .def_readonly("expected_loss", &AdaptiveMemory::expected_loss,
                    "E: on the way to the goal, beyond the estimate.")
      .def_readonly("losses", &AdaptiveMemory::losses, "N values: q of each motion.")
      .def_readonly("times", &AdaptiveMemory::times, "N values: outcomes remembered of each.")
      .def_readonly("effective", &AdaptiveMemory::effective, "M_i: tried, q at most E.")
      .def_readonly("ineffective", &AdaptiveMemory::ineffective, "Tried, q more than E.")
      .def_readonly("unexplored", &AdaptiveMemory::unexplored, "RM_i: not tried yet.")
      .def("__repr__", [](const py::object& self) {
        return py::str(
                   "AdaptiveMemory(first_estimate={:.6g}, expected_loss={:.6g}, losses={}, "
                   "times={}, effective={}, ineffective={}, unexplored={})")
            .format(*attributes(self, {"first_estimate", "expected_loss", "losses", "times",
                                       "effective", "ineffective", "unexplored"}));
      });
  def_result(memory, &AdaptiveMemory::first_estimate, &AdaptiveMemory::expected_loss,
             &AdaptiveMemory::losses, &AdaptiveMemory::times, &AdaptiveMemory::effective,
             &AdaptiveMemory::ineffective, &AdaptiveMemory::unexplored);

  py::class_<Recollection> recollection(m, "Recollection", "What one recollection changed.");
  recollection.def_readonly("situation", &Recollection::situation, "Of the mapping recalled.")
      .def_readonly("motion", &Recollection::motion, "Of the mapping recalled.")
      .def_readonly("loss_before", &Recollection::loss_before, "q of the mapping.")
      .def_readonly("loss", &Recollection::loss, "q, after it.")
      .def_readonly("expected_before", &Recollection::expected_before, "E of the situation.")
      .def_readonly("expected", &Recollection::expected, "E, after it.")
      .def("__repr__", [](const py::object& self) {
        return py::str(
                   "Recollection(situation={}, motion={}, q {:.6g} -> {:.6g}, E {:.6g} -> {:.6g})")
            .format(*attributes(self, {"situation", "motion", "loss_before", "loss",
                                       "expected_before", "expected"}));
      });
  def_result(recollection, &Recollection::situation, &Recollection::motion,
             &Recollection::loss_before, &Recollection::loss, &Recollection::expected_before,
             &Recollection::expected);

  py::class_<AdaptiveExplanation> why(m, "AdaptiveExplanation",
                                      "Why a motion is chosen in a situation, by an "
                                      "AdaptiveLearner. Motions are -1 where there is\n"
                                      "none. str() of it is a table.");
  using E = AdaptiveExplanation;
  why.def_readonly("situation", &E::situation, "The situation's id.")
      .def_readonly("memory", &E::memory, "Lists and losses.")
      .def_readonly("allowed", &E::allowed, "N bools: whether each motion may be chosen.")
      .def_readonly("probability", &E::probability, "N values: of each to be chosen by values.")
      .def_readonly("held", &E::held, "The motion that is held here.")
      .def_readonly("deviation", &E::deviation,
                    "The one by which this round is to deviate from the habit here.")
      .def_readonly("habit", &E::habit, "The habit's here, where this round goes by habit.")
      .def_readonly("homeward", &E::homeward, "Whether this round goes home by what is known.")
      .def_readonly(
          "kind", &E::kind,
          "What the choice goes by, or went by: a Kind; UNSTATED where a draw is to decide that.")
      .def_readonly("motion", &E::motion,
                    "What it was, where it was made; before, what it will be where there is "
                    "nothing to draw.")
      .def_readonly("recollections", &E::recollections,
                    "What those of the last decision changed, at most 1000.")
      .def("__str__", py::overload_cast<const AdaptiveExplanation&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.AdaptiveExplanation: situation {}, motion {}, {!r}>")
            .format(*attributes(self, {"situation", "motion", "kind"}));
      });
  def_result(why, &E::situation, &E::memory, &E::allowed, &E::probability, &E::held, &E::deviation,
             &E::habit, &E::homeward, &E::kind, &E::motion, &E::recollections);
}

}  // namespace

void bind_adaptive(py::module_& m) {
  def_config<AdaptiveConfig>(m,
                             "The adaptive learner's parameters. Costs are in the caller's unit; "
                             "in a trial a step costs 1.");
  bind_results(m);

  py::class_<AdaptiveLearner, std::shared_ptr<AdaptiveLearner>> cls(
      m, "AdaptiveLearner",
      "A learner with an adaptive SEF, -(Phi + E): the estimate of the cost to go, corrected by\n"
      "what was experienced.\n\n"
      "    learner = AdaptiveLearner(AdaptiveConfig(motion_count=4), seed=1)\n"
      "    learner.begin_round()\n"
      "    while not arrived:\n"
      "        motion = learner.choose(situation, estimate).motion\n"
      "        ...make one step of it...\n"
      "        learner.learn(cost, next, next_estimate)   # estimate 0: the goal\n"
      "    learner.end_round(True)\n\n"
      "The estimate is the caller's guess of the cost to go: linear in the distance, 0 at the "
      "goal\n"
      "and nowhere else. Without rounds there are no habits. The same configuration, seed and\n"
      "outcomes give the same history everywhere. One thread at a time.");
  cls.def(py::init([](const std::optional<AdaptiveConfig>& config, Whole<SeedTag> seed) {
            return std::make_shared<AdaptiveLearner>(config.value_or(AdaptiveConfig{}), seed.value);
          }),
          py::arg("config") = py::none(), py::arg("seed") = 0)
      .def(
          "begin_round", [](IdleLearner self) { self->begin_round(); },
          "A round begins, where its first step is made; an open decision is dropped.")
      .def(
          "end_round", [](IdleLearner self, bool arrived) { self->end_round(arrived); },
          py::arg("arrived").noconvert(),
          "A round ends, at the goal or not; one without a step counts for nothing. Raises "
          "InvalidValue where none has begun.")
      .def(
          "choose",
          [](IdleLearner self, Whole<SituationTag> situation, double estimate,
             const Mask& allowed) { return self->choose(situation.value, estimate, allowed); },
          py::arg("situation"), py::arg("estimate"), py::arg("allowed") = py::none(),
          "The motion for the next step: the one that is held, or a new decision, among those "
          "`allowed`: bools, one a motion (None: every one). estimate: of the cost to go, in "
          "[0, 1e12]. Raises InvalidValue, likewise while a choice waits for learn() or cancel().")
      .def(
          "learn",
          [](IdleLearner self, double cost, Whole<SituationTag> next, double next_estimate,
             bool interrupted) {
            return self->learn(cost, next.value, next_estimate, interrupted);
          },
          py::arg("cost"), py::arg("next"), py::arg("next_estimate"),
          py::arg("interrupted").noconvert() = false,
          "What that step came to: its cost in [0, 1e12], and where it led; next_estimate 0 is the "
          "goal. interrupted: the motion cannot be held (the body touched something). The "
          "Development tells an event at the end of a decision. Raises InvalidValue.")
      .def(
          "cancel", [](IdleLearner self) { self->cancel(); },
          "The waiting choice is not made: as the first of its decision nothing happened; later, "
          "the decision ends as interrupted. Raises InvalidValue where none waits.")
      .def(
          "update",
          [](IdleLearner self, Whole<SituationTag> situation, Whole<MotionTag> motion, double cost,
             Whole<SituationTag> next, double next_estimate, std::optional<double> estimate) {
            return self->update(situation.value, motion.value, cost, next.value, next_estimate,
                                estimate);
          },
          py::arg("situation"), py::arg("motion"), py::arg("cost"), py::arg("next"),
          py::arg("next_estimate"), py::arg("estimate") = py::none(),
          "An outcome whoever made it: of a decision by `motion` in `situation` that cost so much "
          "and led to `next`. estimate: where the decision was made (None: what it was at the "
          "first meeting). The open decision, round and habit stay. Raises InvalidValue.")
      .def(
          "forget",
          [](IdleLearner self, Whole<SituationTag> situation) {
            return self->forget(situation.value);
          },
          py::arg("situation"),
          "Forgets the outcomes of a situation's motions; whether it was ever met. Those that lead "
          "there stay; a habit through it is dropped. Raises InvalidValue for a negative "
          "situation, or while a decision is open in it.")
      .def(
          "best",
          [](IdleLearner self, Whole<SituationTag> situation) {
            return self->best(situation.value);
          },
          py::arg("situation"),
          "The tried motion of least expected loss, the first among equals; None where none was "
          "tried. Draws and changes nothing.")
      .def(
          "expected_loss",
          [](IdleLearner self, Whole<SituationTag> situation) {
            return self->expected_loss(situation.value);
          },
          py::arg("situation"), "E of a situation; None where it was never met.")
      .def(
          "situation",
          [](IdleLearner self, Whole<SituationTag> situation) {
            return self->situation(situation.value);
          },
          py::arg("situation"),
          "A situation's lists and losses, an AdaptiveMemory; of one never met every motion is "
          "unexplored. Creates nothing.")
      .def(
          "explain",
          [](IdleLearner self, Whole<SituationTag> situation, const Mask& allowed) {
            return self->explain(situation.value, allowed);
          },
          py::arg("situation"), py::arg("allowed") = py::none(),
          "Why a motion would be chosen in a situation as it is now: an AdaptiveExplanation. "
          "Changes nothing.")
      .def_property_readonly(
          "last_choice", [](IdleLearner self) { return self->last_choice(); },
          "Why the last decision came out as it did: an AdaptiveExplanation; None before the first "
          "one since the learner was made or loaded.")
      .def(
          "situations",
          [](IdleLearner self) { return moved_array<SituationId>(self->situations()); },
          "Ids of the situations met, in that order: an int64 array.")
      .def(
          "reserve",
          [](AdaptiveLearner& self, Whole<SituationsTag> situations, Whole<OutcomesTag> outcomes) {
            const InHand in_hand(self, InHand::For::kRunning);
            const NoGil no_gil;
            self.reserve(situations.value, outcomes.value);
          },
          py::arg("situations"), py::arg("outcomes"),
          "Makes room for so many in all, so that up to then nothing is allocated.")
      .def_property_readonly(
          "explored_count", [](IdleLearner self) { return self->explored_count(); },
          "NUM_RM: mappings with an outcome.")
      .def_property_readonly(
          "effective_count", [](IdleLearner self) { return self->effective_count(); },
          "NUM_M: of these, the ones whose loss is at most E.")
      .def_property_readonly(
          "situations_experienced", [](IdleLearner self) { return self->situations_experienced(); },
          "How many situations were met.")
      .def_property_readonly(
          "outcomes", [](IdleLearner self) { return self->outcomes(); }, "How many are remembered.")
      .def_property_readonly(
          "optimism", [](IdleLearner self) { return self->optimism(); }, "w, as it has fallen.")
      .def_property_readonly(
          "habit_cost", [](IdleLearner self) { return self->habit_cost(); },
          "What the habit costs; None where there is none.")
      .def_property_readonly(
          "in_round", [](IdleLearner self) { return self->in_round(); },
          "Whether a round is under way: begun, and neither ended nor gone on with from the goal.")
      .def_property_readonly(
          "memory_use", [](IdleLearner self) { return self->memory_use(); },
          "Bytes used and spare, a MemoryUse.")
      .def_property_readonly("config", &AdaptiveLearner::config, py::return_value_policy::copy,
                             "Its parameters.")
      .def_property_readonly("seed", &AdaptiveLearner::seed, "The seed it began with.")
      .def_property_readonly(
          "pending", [](IdleLearner self) { return self->pending(); },
          "The choice that waits for its step, or None.")
      .def("__repr__", [](IdleLearner self) {
        return "<devlearn.AdaptiveLearner: " + std::to_string(self->situations_experienced()) +
               " situations, " + std::to_string(self->explored_count()) + " mappings explored, " +
               std::to_string(self->outcomes()) + " outcomes>";
      });
  def_snapshots(cls);
}

}  // namespace devlearn::python
