#include "wrong_calls.hpp"

#include <string>
#include <unordered_map>

#include "bindings.hpp"

namespace devlearn::python {
namespace {

using Entry = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);

PyMethodDef* definition_of(py::handle function) {
  return reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
}

Entry dispatch = nullptr;  // pybind11's, one for all functions

// Of each static method, by what it is bound to, the class that it belongs to.
std::unordered_map<PyObject*, std::string>& owners() {
  static auto* const all = new std::unordered_map<PyObject*, std::string>;
  return *all;
}

// Has the Python side raise what is wrong with the call; what it cannot tell stays as it was.
void explain(py::error_already_set& error, PyObject* self, PyObject* const* values,
             Py_ssize_t count, PyObject* names) {
  py::tuple positional(static_cast<std::size_t>(count));
  for (Py_ssize_t i = 0; i < count; ++i) {
    positional[static_cast<std::size_t>(i)] = py::reinterpret_borrow<py::object>(values[i]);
  }
  py::dict named;
  for (Py_ssize_t i = 0; names != nullptr && i < PyTuple_GET_SIZE(names); ++i) {
    named[py::handle(PyTuple_GET_ITEM(names, i))] = py::handle(values[count + i]);
  }
  const auto owner = owners().find(self);
  py::module_::import("devlearn._calls")
      .attr("explain")(py::str(error.value()), positional, named,
                       owner == owners().end() ? std::string() : owner->second);
}

PyObject* entry(PyObject* self, PyObject* const* values, Py_ssize_t count, PyObject* names) {
  PyObject* const result = dispatch(self, values, count, names);
  if (result != nullptr || !PyErr_ExceptionMatches(PyExc_TypeError)) return result;
  py::error_already_set error;
  try {
    explain(error, self, values, count, names);
    error.restore();
  } catch (py::error_already_set& explained) {
    explained.restore();
  }
  return nullptr;
}

}  // namespace

void explain_wrong_calls_of(py::handle function) {
  if (PyInstanceMethod_Check(function.ptr()))
    function = PyInstanceMethod_GET_FUNCTION(function.ptr());
  if (!PyCFunction_Check(function.ptr())) return;
  PyMethodDef* const definition = definition_of(function);
  if (definition->ml_flags != (METH_FASTCALL | METH_KEYWORDS)) return;
  const auto known = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&entry));
  if (definition->ml_meth == known) return;
  dispatch = reinterpret_cast<Entry>(reinterpret_cast<void (*)()>(definition->ml_meth));
  definition->ml_meth = known;
}

void explain_wrong_calls(py::module_& m) {
  const py::object static_method = py::module_::import("builtins").attr("staticmethod");
  for (const auto& [name, value] : m.attr("__dict__").cast<py::dict>()) {
    explain_wrong_calls_of(value);
    if (!PyType_Check(value.ptr())) continue;
    for (const auto& item : value.attr("__dict__").attr("items")()) {
      const py::object member = item.cast<py::tuple>()[1];
      const bool is_static = py::isinstance(member, static_method);
      const py::object function = is_static ? member.attr("__func__") : member;
      explain_wrong_calls_of(function);
      if (is_static && PyCFunction_Check(function.ptr())) {
        owners()[PyCFunction_GET_SELF(function.ptr())] = name.cast<std::string>();
      }
    }
  }
}

}  // namespace devlearn::python
