#include "devlearn/record.hpp"

#include <string_view>
#include <type_traits>

#include "bindings.hpp"
#include "loop/record_columns.hpp"
#include "record_object.hpp"

namespace devlearn::python {

namespace {

// Whether a column of bytes holds booleans.
bool holds_booleans(const char* dtype) { return std::string_view(dtype) == "BOOL"; }

}  // namespace

py::dict columns(Record&& record) {
  const auto steps = static_cast<py::ssize_t>(record.steps());
  const py::ssize_t sonars = record.sonar_count;
  py::dict result;
  const auto move = [&](const char* name, auto& column, const char* dtype) {
    using T = typename std::decay_t<decltype(column)>::value_type;
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      if (holds_booleans(dtype)) {
        result[name] = moved_array<bool>(std::move(column));
        return;
      }
    }
    result[name] = moved_array<T>(std::move(column));
  };
  each_step_column(record, move);
  each_pose_column(record, move);
  result["rounds"] = moved_array<Round>(std::move(record.rounds));
  if (sonars > 0) {
    result["echoes"] = moved_array<double>(std::move(record.echoes), {steps, sonars});
  }
  return result;
}

namespace {

template <typename Scalar, typename T>
void copy_column(const py::object& record, const char* name, std::vector<T>& column) {
  static_assert(sizeof(Scalar) == sizeof(T));
  const py::object values = record.attr(name);
  const auto array = py::array_t<Scalar, py::array::c_style>::ensure(values);
  if (!array || !py::isinstance<py::array_t<Scalar>>(values)) {
    PyErr_Clear();
    throw InvalidValue("record." + std::string(name), py::repr(py::type::of(values)),
                       "an array of " + std::string(py::str(py::dtype::of<Scalar>())));
  }
  const auto* const first = reinterpret_cast<const T*>(array.data());
  column.assign(first, first + array.size());
}

}  // namespace

Record record_of(const py::object& source) {
  Record record;
  const auto copy = [&](const char* name, auto& column, const char* dtype) {
    using T = typename std::decay_t<decltype(column)>::value_type;
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      if (holds_booleans(dtype)) return copy_column<bool>(source, name, column);
    }
    copy_column<T>(source, name, column);
  };
  each_step_column(record, copy);
  each_pose_column(record, copy);
  const py::object rounds = source.attr("rounds");
  for (const py::handle entry : rounds) {
    record.rounds.push_back({entry["round"].cast<std::int32_t>(),
                             entry["steps"].cast<std::int64_t>(), entry["arrived"].cast<bool>()});
  }
  if (const py::object echoes = source.attr("echoes"); !echoes.is_none()) {
    copy_column<double>(source, "echoes", record.echoes);
    record.sonar_count = echoes.attr("shape")[py::int_(1)].cast<int>();
  }
  return record;
}

void bind_record(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Round, round, steps, arrived);

  py::class_<StepRecord>(m, "Step", "Everything about one step of a trial.")
      .def_readonly("round", &StepRecord::round, "The round it belongs to, from 1.")
      .def_readonly("situation", &StepRecord::situation, "Before the step: S_i.")
      .def_readonly("motion", &StepRecord::motion, "Index in M.")
      .def_readonly("kind", &StepRecord::kind, "Why it was chosen.")
      .def_readonly("sef", &StepRecord::sef, "After the step: SEF(t+1).")
      .def_readonly("smf", &StepRecord::smf, "SEF(t+1) - SEF(t), Eq. 8.")
      .def_readonly("smf_used", &StepRecord::smf_used,
                    "What was learned from: min(smf, -1) for a collision.")
      .def_readonly("collided", &StepRecord::collided, "Whether the body touched something.")
      .def_readonly("arrived", &StepRecord::arrived, "After the step: d_g <= goal_radius.")
      .def_readonly("goal_distance", &StepRecord::goal_distance, "After the step: d_g [m].")
      .def_readonly("clearance", &StepRecord::clearance, "After the step: d_o [m].")
      .def_readonly("event", &StepRecord::event, "What the outcome changed.")
      .def_readonly("reduced", &StepRecord::reduced, "Motions removed by reduction development.")
      .def_readonly("explored_count", &StepRecord::explored_count, "After the step: NUM_RM.")
      .def_readonly("effective_count", &StepRecord::effective_count, "After the step: NUM_M.")
      .def_readonly("pose", &StepRecord::pose, "After the step.")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.Step: round {}, situation {}, motion {}, {}, smf {:.4g}>")
            .format(self.attr("round"), self.attr("situation"), self.attr("motion"),
                    self.attr("kind").attr("name"), self.attr("smf"));
      });
}

}  // namespace devlearn::python
