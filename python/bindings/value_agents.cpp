#include "agents.hpp"
#include "bindings.hpp"
#include "def_agent.hpp"

namespace devlearn::python {
namespace {

void bind_shortest_path_agent(py::module_& m) {
  py::class_<ShortestPathAgent, std::shared_ptr<ShortestPathAgent>> cls(
      m, "ShortestPathAgent",
      "Follows the way that shortest_path finds from where the robot stands: with the map, the\n"
      "bound of what can be learned without one. It plans anew where it is off its way. At the\n"
      "target it makes the first motion that touches nothing.\n\n"
      "Parameters: robot, as the trial's, without a safety margin; goal_radius of the target, in\n"
      "(0, 100] m. Raises InvalidValue.");
  cls.def(py::init([](const Robot& robot, double goal_radius) {
            return std::make_shared<ShortestPathAgent>(robot, goal_radius);
          }),
          py::arg("robot"), py::arg("goal_radius") = 0.1)
      .def_property_readonly("goal_radius", &ShortestPathAgent::goal_radius, "Of the target [m].")
      .def("__repr__", [](const py::object& self) {
        const auto& agent = self.cast<const ShortestPathAgent&>();
        return py::str("<devlearn.agents.{}: world {!r}, goal_radius {:.4g}>")
            .format(py::type::of(self).attr("__name__"), agent.robot().world().def().name,
                    agent.goal_radius());
      });
  def_pickling_of_agent(cls);
}

}  // namespace

void bind_value_agents(py::module_& m) {
  def_value_agent<QLearning>(m, "QLearning",
                             "Q-learning (Watkins 1989; Sutton & Barto 6.5), epsilon-greedy:\n\n"
                             "Q(S, A) <- Q(S, A) + alpha (R + gamma max_a Q(S', a) - Q(S, A)).");
  def_value_agent<ExpectedSarsa>(
      m, "ExpectedSarsa",
      "Expected SARSA (Sutton & Barto 6.6) under its epsilon-greedy policy pi:\n\n"
      "Q(S, A) <- Q(S, A) + alpha (R + gamma sum_a pi(a | S') Q(S', a) - Q(S, A)).");
  def_value_agent<SarsaLambda>(
      m, "SarsaLambda",
      "SARSA(lambda), tabular and epsilon-greedy (Sutton & Barto 12.7); SARSA "
      "where trace_decay is\n"
      "0. A motion is learned about once the next one has run.");
  def_value_agent<DynaQ>(
      m, "DynaQ",
      "Tabular Dyna-Q (Sutton & Barto 8.2), epsilon-greedy: after each step of Q-learning,\n"
      "planning_steps more from what came of each motion when it was last tried. With kappa > 0\n"
      "Dyna-Q+ (8.3); then gamma should be below 1.");
  def_value_agent<PrioritizedSweeping>(
      m, "PrioritizedSweeping",
      "Prioritized sweeping for a deterministic world (Moore & Atkeson 1993, as in Sutton & Barto\n"
      "8.4), epsilon-greedy: after each step at most planning_steps updates of Q-learning from "
      "what\n"
      "came of each motion when it was last tried, those first that change most.")
      .def_property_readonly(
          "updates", [](const PrioritizedSweeping& self) { return readable(self).updates(); },
          "How many updates there have been.");
  def_value_agent<LrtaStar>(
      m, "LrtaStar",
      "Learning real-time A* (Korf 1990): the motion of the least f(s, a) = cost + h(s'), of what\n"
      "each led to when it was last tried, and h(s) <- min_a f(s, a). h is first the estimate of\n"
      "the cost to go. A value is -f.");
  def_value_agent<RMax>(
      m, "RMax",
      "R-max (Brafman & Tennenholtz 2002): a motion is known in a situation once it was tried m\n"
      "times there; one that is not is worth its first value. The best plan under that is "
      "followed.")
      .def(
          "visits",
          [](const RMax& self, Whole<SituationTag> situation, Whole<MotionTag> motion) {
            return readable(self).visits(situation.value, motion.value);
          },
          py::arg("situation"), py::arg("motion"),
          "How often a motion was tried in a situation, at most m: then it is known. Raises "
          "InvalidValue.");
  bind_shortest_path_agent(m);
}

}  // namespace devlearn::python
