#include "devlearn/error.hpp"

#include <stdexcept>
#include <string_view>

#include "bindings.hpp"

namespace devlearn::python {

namespace {

// Whatever bytes a caller gave, a message comes of them.
py::object as_text(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
      bytes.data(), static_cast<py::ssize_t>(bytes.size()), "backslashreplace"));
}

py::object as_path(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<py::ssize_t>(bytes.size())));
}

}  // namespace

std::string shown(py::handle value, PyObject* (*text)(PyObject*)) {
  constexpr py::ssize_t kLongest = 160;
  const auto whole = py::reinterpret_steal<py::object>(text(value.ptr()));
  if (!whole) {
    if (!PyErr_ExceptionMatches(PyExc_Exception)) throw py::error_already_set();
    PyErr_Clear();
    return "a value of " + shown(py::type::of(value));
  }
  const py::object cut = whole[py::slice(0, kLongest, 1)];
  const py::bytes bytes = cut.attr("encode")("utf-8", "backslashreplace");
  return std::string(bytes) + (py::len(whole) > kLongest ? "..." : "");
}

// The exception types live on the Python side, so that Python code raises the same ones.
void bind_error(py::module_&) {
  py::register_local_exception_translator([](std::exception_ptr raised) {
    const auto raise = [](const char* type, auto... arguments) {
      const py::object error = py::module_::import("devlearn.errors").attr(type)(arguments...);
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
    };
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const FileError& error) {
      raise("FileError", as_path(error.file()), as_text(error.field()), as_text(error.value()),
            as_text(error.allowed()));
    } catch (const InvalidValue& error) {
      raise("InvalidValue", as_text(error.quantity()), as_text(error.value()),
            as_text(error.allowed()));
    } catch (const std::runtime_error& error) {
      // pybind11 has no type of its own for arrays that do not broadcast.
      if (std::string_view(error.what()).rfind("pybind11::vectorize", 0) != 0) throw;
      raise("InvalidValue", "the arrays' shapes", "others", "shapes that broadcast");
    }
  });
}

}  // namespace devlearn::python
