#pragma once

#include <pybind11/pybind11.h>

namespace devlearn::python {

/// pybind11 answers a call that fits no signature with a list of signatures. After this, functions
/// and methods of the module raise WrongType instead: which argument, what was given, what is
/// wanted. A call that fits costs one jump more.
void explain_wrong_calls(pybind11::module_& m);
/// The same for one function of pybind11's that a class no longer shows.
void explain_wrong_calls_of(pybind11::handle function);

}  // namespace devlearn::python
