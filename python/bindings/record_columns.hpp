#pragma once

#include "bindings.hpp"
#include "devlearn/record.hpp"

namespace devlearn::python {

/// The record's columns as numpy arrays, which take over its memory.
py::dict columns(Record&& record);

}  // namespace devlearn::python
