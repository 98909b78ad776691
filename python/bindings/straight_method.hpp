#pragma once

#include <string>
#include <vector>

#include "bindings.hpp"
#include "wrong_calls.hpp"

namespace devlearn::python {

template <auto function>
class StraightMethod;

/// A method that is called at every step, put in front of pybind11's method of that name: to
/// dispatch a call takes pybind11 longer than the learner takes. Given its one argument by
/// position, it calls the function straight away; any other call, and one of wrong types, it leaves
/// to pybind11's.
template <typename Result, typename Argument, Result (*function)(Idle, Argument)>
class StraightMethod<function> {
 public:
  static void put_before(const py::object& type, const char* name) {
    general_ = py::object(type.attr(name)).release().ptr();
    explain_wrong_calls_of(general_);
    docstring_ = py::str(py::handle(general_).attr("__doc__"));
    definition_ = {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&call)),
                   METH_FASTCALL | METH_KEYWORDS, docstring_.c_str()};
    type.attr(name) = py::reinterpret_steal<py::object>(
        PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(type.ptr()), &definition_));
  }

 private:
  static PyObject* call(PyObject* self, PyObject* const* values, Py_ssize_t count,
                        PyObject* keywords) {
    try {
      py::detail::make_caster<Idle> learner;
      py::detail::make_caster<Argument> argument;
      if (count == 1 && keywords == nullptr && learner.load(self, true) &&
          argument.load(values[0], true)) {
        return py::cast(function(learner, argument)).release().ptr();
      }
    } catch (py::error_already_set& error) {
      error.restore();
      return nullptr;
    } catch (...) {
      py::detail::try_translate_exceptions();
      return nullptr;
    }
    std::vector<PyObject*> all{self};
    const Py_ssize_t named = keywords == nullptr ? 0 : PyTuple_GET_SIZE(keywords);
    all.insert(all.end(), values, values + count + named);
    return PyObject_Vectorcall(general_, all.data(), all.size() - named, keywords);
  }

  static inline PyObject* general_ = nullptr;
  static inline std::string docstring_;
  static inline PyMethodDef definition_{};
};

}  // namespace devlearn::python
