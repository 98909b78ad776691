#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/appraisal.hpp"
#include "devlearn/dyna_q.hpp"
#include "devlearn/expected_sarsa.hpp"
#include "devlearn/iac.hpp"
#include "devlearn/lrta_star.hpp"
#include "devlearn/operant_conditioning.hpp"
#include "devlearn/prioritized_sweeping.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/r_max.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/salient_events.hpp"
#include "devlearn/sarsa_lambda.hpp"
#include "devlearn/shortest_path_agent.hpp"
#include "devlearn/trial_snapshot.hpp"

namespace devlearn::python {

template <class... A>
struct Agents {};
/// devlearn's agents that are the same object in Python and in C++.
using OwnAgents =
    Agents<RandomAgent, QLearning, ExpectedSarsa, SarsaLambda, DynaQ, PrioritizedSweeping, LrtaStar,
           RMax, Iac, OperantConditioning, SalientEvents, Appraisal, ShortestPathAgent>;

/// The class of one of them, without its module; null for any other.
const char* own_name(const Agent& agent);

/// An observation that Python may keep: what is allowed and sensed is its own.
struct KeptObservation : Observation {
  KeptObservation() = default;
  explicit KeptObservation(const Observation& seen);

  std::optional<std::vector<bool>> mask;
  std::optional<std::vector<double>> sensed;
};

/// An observation of the ones that Python keeps, as C++ sees it while this lives.
class SeenObservation {
 public:
  /// Throws InvalidValue for a mask that does not fit.
  explicit SeenObservation(const KeptObservation& kept);
  operator const Observation&() const noexcept { return seen_; }

 private:
  Observation seen_;
  std::unique_ptr<bool[]> allowed_;
};

/// What an agent chooses, of the motions that the observation allows.
Choice choice_of(Agent& agent, const KeptObservation& observation);

/// What a trial calls of an agent, for a loop of one's own. Refused while another thread's run has
/// the agent in hand.
template <class A>
void def_calls(py::class_<A, std::shared_ptr<A>>& cls) {
  const auto idle = [](A& agent) -> Agent& {
    require_idle(&agent, own_name(agent));
    return agent;
  };
  cls.def(
         "begin_round", [idle](A& self) { idle(self).begin_round(); },
         "A round begins. As all that follow it: what a trial calls, for a loop of one's own.")
      .def(
          "choose",
          [idle](A& self, const KeptObservation& observation) {
            return choice_of(idle(self), observation);
          },
          py::arg("observation"),
          "A motion for what is observed. Raises InvalidValue, likewise while a choice waits for "
          "observe() or cancel().")
      .def(
          "observe", [idle](A& self, const Outcome& outcome) { idle(self).observe(outcome); },
          py::arg("outcome"), "What came of the choice. Raises InvalidValue.")
      .def(
          "cancel", [idle](A& self) { idle(self).cancel(); }, "The waiting choice was not made.")
      .def(
          "end_round", [idle](A& self, bool arrived) { idle(self).end_round(arrived); },
          py::arg("arrived"), "The round has ended, at the target or not.");
}

/// A class or a function as files name it, module:name. Nothing is imported by this name.
std::string name_of(const py::object& named);
/// Shared with C++, whatever thread lets go of it.
std::shared_ptr<const py::object> shared_object(const py::object& object);

/// Whoever Python names as a trial's agent.
std::shared_ptr<Agent> as_agent(const py::object& agent);
/// The reverse.
py::object agent_of(const Trial& trial);
/// Who goes on in a trial that is loaded: None for the agent in the file, an agent, or a class that
/// makes one by from_state.
LoadOptions load_options(const py::object& agent);

/// A state's texts and arrays as a dict, arrays without dimensions as numbers.
py::dict dict_of(const AgentState& state);
/// The reverse. Throws InvalidValue for what no array can hold.
AgentState state_of_dict(const std::string& kind, const py::dict& dict);

}  // namespace devlearn::python
