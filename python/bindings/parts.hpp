#pragma once

#include "bindings.hpp"
#include "devlearn/trial.hpp"

namespace devlearn::python {

/// What Python gives as evaluation (None, a callable, or an array of SEFs, one a situation of the
/// grid) and as situations (None or a callable).
TrialParts parts_from(const py::object& evaluation, const py::object& situations);
///@{
/// The reverse.
py::object evaluation_of(const Trial& trial);
py::object situations_of(const Trial& trial);
///@}
/// What of them a record's provenance tells, by name.
py::dict names_of(const TrialParts& parts);

}  // namespace devlearn::python
