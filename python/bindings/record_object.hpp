#pragma once

#include "bindings.hpp"
#include "devlearn/record.hpp"

namespace devlearn::python {

/// The record's columns as numpy arrays, which take over its memory.
py::dict columns(Record&& record);
/// The reverse: a copy of a devlearn.Record's columns. Throws InvalidValue for other columns.
Record record_of(const py::object& record);

}  // namespace devlearn::python
