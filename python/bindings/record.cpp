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
