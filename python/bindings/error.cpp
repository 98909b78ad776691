#include "devlearn/error.hpp"

#include "bindings.hpp"

namespace devlearn::python {

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
      const auto file = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(
          error.file().data(), static_cast<py::ssize_t>(error.file().size())));
      raise("FileError", file, error.field(), error.value(), error.allowed());
    } catch (const InvalidValue& error) {
      raise("InvalidValue", error.quantity(), error.value(), error.allowed());
    }
  });
}

}  // namespace devlearn::python
