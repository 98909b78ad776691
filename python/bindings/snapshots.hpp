#pragma once

// What every learner that has a snapshot offers.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "devlearn/snapshot.hpp"

namespace devlearn::python {

template <typename L, typename... From>
L loaded(const From&... from) {
  if constexpr (std::is_same_v<L, Learner>) {
    return load_learner(from...);
  } else {
    return load_adaptive_learner(from...);
  }
}

template <typename L>
py::bytes snapshot_bytes(const L& learner) {
  std::vector<std::byte> bytes;
  {
    const InHand reading(learner, InHand::For::kReading);
    const NoGil no_gil;
    bytes = to_bytes(learner);
  }
  return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

template <typename L>
L from_bytes(const py::bytes& bytes) {
  const std::string_view view = bytes;
  const NoGil no_gil;
  return loaded<L>(reinterpret_cast<const std::byte*>(view.data()), view.size(),
                   std::string("bytes"));
}

// An object of a derived class goes the way of pickle: it keeps its class, and what it has besides,
// copied where there is a memo.
template <typename L>
py::object copied(const py::object& self, const std::optional<py::dict>& memo) {
  const py::object cls = py::type::of(self);
  if (cls.is(py::type::of<L>())) {
    const L& learner = self.cast<const L&>();
    return py::cast([&]() -> L {
      const InHand reading(learner, InHand::For::kReading);
      const NoGil no_gil;
      return learner;
    }());
  }
  py::object made = cls.attr("__new__")(cls);
  py::object state = self.attr("__getstate__")();
  if (memo) {
    (*memo)[py::int_(reinterpret_cast<std::uintptr_t>(self.ptr()))] = made;  // it may hold itself
    state = py::module_::import("copy").attr("deepcopy")(state, *memo);
  }
  made.attr("__setstate__")(state);
  return made;
}

/// save, load, to_bytes, from_bytes, copy, and pickling.
template <typename L>
void def_snapshots(py::class_<L, std::shared_ptr<L>>& cls) {
  cls.def(
         "save",
         [](const L& self, const py::object& path) {
           const std::string name = file_path(path);
           const InHand reading(self, InHand::For::kReading);
           const NoGil no_gil;
           save(self, name);
         },
         py::arg("path"),
         "Writes a snapshot (safetensors layout): to the side first, flushed, then renamed. Raises "
         "FileError.")
      .def_static(
          "load",
          [](const py::object& path) {
            const std::string name = file_path(path);
            const NoGil no_gil;
            return loaded<L>(name);
          },
          py::arg("path"),
          "The learner in a snapshot; it goes on equal to the bit. Raises FileError, saying what "
          "is wrong with the file.")
      .def("to_bytes", &snapshot_bytes<L>, "The snapshot as bytes.")
      .def_static("from_bytes", &from_bytes<L>, py::arg("snapshot"),
                  "The learner in a snapshot's bytes. Raises FileError.")
      .def(
          "copy", [](const py::object& self) { return copied<L>(self, py::dict()); },
          "An independent learner that goes on alike.")
      .def("__copy__", [](const py::object& self) { return copied<L>(self, std::nullopt); })
      .def(
          "__deepcopy__",
          [](const py::object& self, const py::dict& memo) { return copied<L>(self, memo); },
          py::arg("memo"));
  def_pickling_by_state(cls, &snapshot_bytes<L>, [](const py::object& state) {
    return from_bytes<L>(state.cast<py::bytes>());
  });
}

}  // namespace devlearn::python
