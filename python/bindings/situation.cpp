#include "devlearn/situation.hpp"

#include "bindings.hpp"

namespace PYBIND11_NAMESPACE {
namespace detail {
namespace {

// The numbers of a sequence of exactly `count`; false where it is none.
bool load_numbers(handle source, double* numbers, std::size_t count) {
  if (!PySequence_Check(source.ptr()) || PyUnicode_Check(source.ptr())) return false;
  const auto values = reinterpret_borrow<sequence>(source);
  if (values.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    make_caster<double> number;
    if (!number.load(object(values[i]), true)) return false;
    numbers[i] = cast_op<double>(number);
  }
  return true;
}

}  // namespace

bool type_caster<devlearn::Pose>::load(handle source, bool) {
  double numbers[3];
  if (!load_numbers(source, numbers, 3)) return false;
  value = {numbers[0], numbers[1], numbers[2]};
  return true;
}

handle type_caster<devlearn::Pose>::cast(const devlearn::Pose& pose, return_value_policy, handle) {
  return module_::import("devlearn._types").attr("Pose")(pose.x, pose.y, pose.heading).release();
}

bool type_caster<devlearn::Point>::load(handle source, bool) {
  double numbers[2];
  if (!load_numbers(source, numbers, 2)) return false;
  value = {numbers[0], numbers[1]};
  return true;
}

handle type_caster<devlearn::Point>::cast(const devlearn::Point& point, return_value_policy,
                                          handle) {
  return make_tuple(point.x, point.y).release();
}

}  // namespace detail
}  // namespace PYBIND11_NAMESPACE

namespace devlearn::python {
namespace {

struct ColumnsTag {
  using type = int;
  static constexpr const char* quantity = "SituationGrid.columns";
  static constexpr const char* allowed = "a whole number in [1, 100000]";
};
struct RowsTag {
  using type = int;
  static constexpr const char* quantity = "SituationGrid.rows";
  static constexpr const char* allowed = "a whole number in [1, 100000]";
};
struct HeadingsTag {
  using type = int;
  static constexpr const char* quantity = "SituationGrid.headings";
  static constexpr const char* allowed = "a whole number in [1, 3600]";
};

}  // namespace

void bind_situation(py::module_& m) {
  m.def(
      "heading_of_yaw", [](double yaw) { return Pose::from_radians(0.0, 0.0, yaw).heading; },
      py::arg("yaw"), "Pose.from_radians, its heading alone.");
  m.def(
      "yaw_of_heading",
      [](double heading) {
        return Pose{0.0, 0.0, heading}.yaw();
      },
      py::arg("heading"), "Pose.yaw of a heading.");
  py::class_<SituationGrid> grid(
      m, "SituationGrid",
      "Step 1: which sensory situation a pose is, on an even grid of cells and headings.\n\n"
      "Cells are half-open; the arena's far borders belong to the last cells. Heading bin k is\n"
      "centred on k * 360 / headings degrees. id = (row * columns + column) * headings + bin.\n\n"
      "Parameters: width, height in (0, 10000] m; columns, rows in 1 ... 100000; headings in\n"
      "1 ... 3600; origin (x, y), the arena's corner of least x and y, each within 1e7 m of 0;\n"
      "outside: of poses beyond the arena, 'refuse', or 'clamp' to the nearest cell, as a real\n"
      "robot's estimate may need. Raises InvalidValue.");
  grid.def(py::init([](double width, double height, Whole<ColumnsTag> columns, Whole<RowsTag> rows,
                       Whole<HeadingsTag> headings, Point origin, const std::string& outside) {
             if (outside != "refuse" && outside != "clamp") {
               throw InvalidValue("SituationGrid.outside", "'" + outside + "'",
                                  "'refuse' or 'clamp'");
             }
             return SituationGrid(width, height, columns.value, rows.value, headings.value, origin,
                                  outside == "clamp" ? Outside::kClamp : Outside::kRefuse);
           }),
           py::arg("width") = 5.0, py::arg("height") = 5.0, py::arg("columns") = 20,
           py::arg("rows") = 20, py::arg("headings") = 12,
           py::arg("origin") = py::make_tuple(0.0, 0.0), py::arg("outside") = "refuse")
      .def(
          "situation",
          py::overload_cast<double, double, double>(&SituationGrid::situation, py::const_),
          py::arg("x"), py::arg("y"), py::arg("heading"),
          "The situation id of a pose: x, y in metres inside the grid, heading in degrees. Numbers "
          "give an int; arrays broadcast and give an int64 array. Of a robot that has radians: "
          "situation(Pose.from_radians(x, y, yaw)). Raises InvalidValue.")
      .def("situation", py::overload_cast<const Pose&>(&SituationGrid::situation, py::const_),
           py::arg("pose"), "The same of a Pose.")
      .def("situation",
           py::vectorize([](const SituationGrid* self, double x, double y, double heading) {
             take_a_breath();
             return self->situation(x, y, heading);
           }),
           py::arg("x"), py::arg("y"), py::arg("heading"))
      .def(
          "centre",
          [](const SituationGrid& self, Whole<SituationTag> situation) {
            return self.centre(situation.value);
          },
          py::arg("situation"),
          "The pose in the middle of a situation's cell and heading bin. Raises InvalidValue.")
      .def_property_readonly("count", &SituationGrid::count, "N_S, the number of situations.")
      .def_property_readonly("width", &SituationGrid::width, "[m]")
      .def_property_readonly("height", &SituationGrid::height, "[m]")
      .def_property_readonly("columns", &SituationGrid::columns, "Cells along x.")
      .def_property_readonly("rows", &SituationGrid::rows, "Cells along y.")
      .def_property_readonly("headings", &SituationGrid::headings, "Heading bins.")
      .def_property_readonly("origin", &SituationGrid::origin, "(x, y) [m]")
      .def_property_readonly(
          "outside",
          [](const SituationGrid& self) {
            return self.outside() == Outside::kClamp ? "clamp" : "refuse";
          },
          "Of poses beyond the arena: 'refuse' or 'clamp'.")
      .def("__repr__", [](const SituationGrid& self) {
        return "SituationGrid(width=" + to_text(self.width()) +
               ", height=" + to_text(self.height()) +
               ", columns=" + std::to_string(self.columns()) +
               ", rows=" + std::to_string(self.rows()) +
               ", headings=" + std::to_string(self.headings()) + ", origin=(" +
               to_text(self.origin().x) + ", " + to_text(self.origin().y) + ")" +
               (self.outside() == Outside::kClamp ? ", outside='clamp')" : ")");
      });
  def_value(grid, {"width", "height", "columns", "rows", "headings", "origin", "outside"});
}

}  // namespace devlearn::python
