#pragma once

#include "bindings.hpp"
#include "devlearn/trial.hpp"

namespace devlearn::python {

/// Whoever Python names as a trial's agent.
std::shared_ptr<Agent> as_agent(const py::object& agent);
/// The reverse.
py::object agent_of(const Trial& trial);

}  // namespace devlearn::python
