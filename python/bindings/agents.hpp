#pragma once

#include "bindings.hpp"
#include "devlearn/trial_snapshot.hpp"

namespace devlearn::python {

/// Whoever Python names as a trial's agent.
std::shared_ptr<Agent> as_agent(const py::object& agent);
/// The reverse.
py::object agent_of(const Trial& trial);
/// Who goes on in a trial that is loaded: None for the agent in the file, an agent, or a class that
/// makes one by from_state.
LoadOptions load_options(const py::object& agent);

}  // namespace devlearn::python
