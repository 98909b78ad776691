#include "devlearn/record.hpp"

#include "bindings.hpp"
#include "record_columns.hpp"

namespace devlearn::python {

py::dict columns(Record&& record) {
  const auto steps = static_cast<py::ssize_t>(record.steps());
  const py::ssize_t sonars = record.sonar_count;
  py::dict result;
  result["round"] = moved_array<std::int32_t>(std::move(record.round));
  result["situation"] = moved_array<std::int64_t>(std::move(record.situation));
  result["motion"] = moved_array<std::int32_t>(std::move(record.motion));
  result["kind"] = moved_array<std::uint8_t>(std::move(record.kind));
  result["sef"] = moved_array<double>(std::move(record.sef));
  result["smf"] = moved_array<double>(std::move(record.smf));
  result["smf_used"] = moved_array<double>(std::move(record.smf_used));
  result["collided"] = moved_array<bool>(std::move(record.collided));
  result["arrived"] = moved_array<bool>(std::move(record.arrived));
  result["goal_distance"] = moved_array<double>(std::move(record.goal_distance));
  result["clearance"] = moved_array<double>(std::move(record.clearance));
  result["event"] = moved_array<std::uint8_t>(std::move(record.event));
  result["reduced"] = moved_array<std::int32_t>(std::move(record.reduced));
  result["explored_count"] = moved_array<std::int64_t>(std::move(record.explored_count));
  result["effective_count"] = moved_array<std::int64_t>(std::move(record.effective_count));
  result["x"] = moved_array<double>(std::move(record.x));
  result["y"] = moved_array<double>(std::move(record.y));
  result["heading"] = moved_array<double>(std::move(record.heading));
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
  copy_column<std::int32_t>(source, "round", record.round);
  copy_column<std::int64_t>(source, "situation", record.situation);
  copy_column<std::int32_t>(source, "motion", record.motion);
  copy_column<std::uint8_t>(source, "kind", record.kind);
  copy_column<double>(source, "sef", record.sef);
  copy_column<double>(source, "smf", record.smf);
  copy_column<double>(source, "smf_used", record.smf_used);
  copy_column<bool>(source, "collided", record.collided);
  copy_column<bool>(source, "arrived", record.arrived);
  copy_column<double>(source, "goal_distance", record.goal_distance);
  copy_column<double>(source, "clearance", record.clearance);
  copy_column<std::uint8_t>(source, "event", record.event);
  copy_column<std::int32_t>(source, "reduced", record.reduced);
  copy_column<std::int64_t>(source, "explored_count", record.explored_count);
  copy_column<std::int64_t>(source, "effective_count", record.effective_count);
  copy_column<double>(source, "x", record.x);
  copy_column<double>(source, "y", record.y);
  copy_column<double>(source, "heading", record.heading);
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
