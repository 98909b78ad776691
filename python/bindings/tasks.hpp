#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "config.hpp"
#include "devlearn/task.hpp"

namespace devlearn::python {

/// A task that Python calls, as `name`; refused while another thread's run has it in hand.
template <class T>
T& idle(T& task, const char* name) {
  require_idle(static_cast<const Task*>(&task), name);
  return task;
}

/// The class of a task T, made from its Config, and that of its settings. What all tasks have
/// stands in Task.
template <class T>
py::class_<T, Task, std::shared_ptr<T>> def_task(py::module_& m, const std::string& name,
                                                 const std::string& about) {
  using Config = typename T::Config;
  const py::object config = def_config<Config>(m, "The settings of " + name + ".");
  const std::string doc = about + "\n\nParameters: config, a " + name + "Config, also " + name +
                          ".Config (None: the defaults). Raises InvalidValue.";
  py::class_<T, Task, std::shared_ptr<T>> cls(m, name.c_str(), doc.c_str());
  cls.attr("Config") = config;
  cls.def(py::init([](const std::optional<Config>& given) {
            return std::make_shared<T>(given.value_or(Config{}));
          }),
          py::arg("config") = py::none())
      .def_property_readonly(
          "config", [](const T& self) { return self.config(); }, "Its settings.")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.tasks.{}: {!r}>")
            .format(py::type::of(self).attr("__name__"), self.attr("config"));
      });
  return cls;
}

}  // namespace devlearn::python
