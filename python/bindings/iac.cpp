#include "devlearn/iac.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agents.hpp"
#include "bindings.hpp"
#include "config.hpp"
#include "def_agent.hpp"

namespace devlearn::python {
namespace {

using Matrix = py::typing::Optional<
    py::typing::Union<py::typing::List<py::typing::List<double>>, py::array_t<double>>>;

// A row a motion.
Motors motors_from(const Matrix& given) {
  if (given.is_none()) return {};
  const auto matrix = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!matrix || matrix.ndim() != 2 || matrix.size() == 0) {
    PyErr_Clear();
    throw InvalidValue("motors", shown(given), "None, or a matrix of numbers, a row a motion");
  }
  return {{matrix.data(), matrix.data() + matrix.size()}, static_cast<int>(matrix.shape(1))};
}

py::object matrix_of(const Motors& motors) {
  if (motors.values.empty()) return py::none();
  return moved_array<double>(std::vector<double>(motors.values),
                             {static_cast<py::ssize_t>(motors.rows()), motors.columns});
}

// One entry a region.
py::object array_of_regions(const std::vector<IacRegion>& regions, std::size_t dimensions) {
  const py::module_ numpy = py::module_::import("numpy");
  const auto bounds = py::make_tuple("f8", py::make_tuple(dimensions));
  py::list fields;
  const auto field = [&](const char* name, const char* type) {
    fields.append(py::make_tuple(name, type));
  };
  field("region", "i8");
  field("parent", "i8");
  fields.append(py::make_tuple("lower", bounds[0], bounds[1]));
  fields.append(py::make_tuple("upper", bounds[0], bounds[1]));
  for (const char* name : {"since", "exemplars"}) field(name, "i8");
  for (const char* name : {"error", "progress"}) field(name, "f8");
  field("split_dimension", "i8");
  field("split_value", "f8");
  for (const char* name : {"below", "above"}) field(name, "i8");
  py::list rows;
  for (const IacRegion& one : regions) {
    rows.append(py::make_tuple(one.region, one.parent, one.lower, one.upper, one.since,
                               one.exemplars, one.error, one.progress, one.split_dimension,
                               one.split_value, one.below, one.above));
  }
  return numpy.attr("array")(rows, py::arg("dtype") = fields);
}

void def_explanation(py::module_& m) {
  py::class_<IacRegion> region(m, "IacRegion", "A region of the sensorimotor space of an Iac.");
  region
      .def_readonly("region", &IacRegion::region,
                    "Its number, in the order in which they came to be; 0 is the whole space.")
      .def_readonly("parent", &IacRegion::parent,
                    "The one that was split into this one and another; -1: none.")
      .def_readonly("lower", &IacRegion::lower,
                    "What lies in it is not below these: a number for each of SM, first S, then M; "
                    "-inf for no bound.")
      .def_readonly("upper", &IacRegion::upper, "And below these; inf for no bound.")
      .def_readonly("since", &IacRegion::since,
                    "How many exemplars had been learned when it came to be.")
      .def_readonly("exemplars", &IacRegion::exemplars, "How many it holds.")
      .def_readonly("error", &IacRegion::error,
                    "<e>: the mean of its latest theta + 1 squared errors; NaN before the first.")
      .def_readonly("progress", &IacRegion::progress, "L, Eq. 2.")
      .def_readonly("split_dimension", &IacRegion::split_dimension,
                    "Where in SM it was split; -1: it was not.")
      .def_readonly("split_value", &IacRegion::split_value, "At which value.")
      .def_readonly("below", &IacRegion::below, "The half below that; -1: none.")
      .def_readonly("above", &IacRegion::above, "The other half; -1: none.")
      .def("__repr__", [](const IacRegion& self) {
        return py::str(
                   "<devlearn.agents.IacRegion {}: {} exemplars, error {:.4g}, progress {:.4g}>")
            .format(self.region, self.exemplars, self.error, self.progress);
      });
  def_result(region, &IacRegion::region, &IacRegion::parent, &IacRegion::lower, &IacRegion::upper,
             &IacRegion::since, &IacRegion::exemplars, &IacRegion::error, &IacRegion::progress,
             &IacRegion::split_dimension, &IacRegion::split_value, &IacRegion::below,
             &IacRegion::above);

  py::class_<IacExplanation> explanation(
      m, "IacExplanation",
      "Why an Iac chooses motions for what is observed. str() of it is a table.");
  explanation.def_readonly("senses", &IacExplanation::senses, "S(t), as it learns from it.")
      .def_readonly("allowed", &IacExplanation::allowed, "A bool a motion.")
      .def_readonly("region", &IacExplanation::region, "A number a motion: where it falls.")
      .def_readonly("progress", &IacExplanation::progress,
                    "A number a motion: the progress that is expected, L of its region, Eq. 4.")
      .def_readonly("probability", &IacExplanation::probability,
                    "A number a motion: of being chosen; they sum to 1.")
      .def_readonly("regions", &IacExplanation::regions,
                    "Each IacRegion in which a motion falls, by their number.")
      .def("__str__", py::overload_cast<const IacExplanation&>(&to_text))
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.agents.IacExplanation: {} regions, probability {}>")
            .format(py::len(self.attr("regions")), self.attr("probability"));
      });
  def_result(explanation, &IacExplanation::senses, &IacExplanation::allowed,
             &IacExplanation::region, &IacExplanation::progress, &IacExplanation::probability,
             &IacExplanation::regions);
}

}  // namespace

void bind_iac(py::module_& m) {
  def_explanation(m);
  auto cls = def_agent_without_init<Iac>(
      m, "Iac",
      "Intelligent adaptive curiosity (Oudeyer, Kaplan & Hafner 2007): it seeks the region of its\n"
      "sensorimotor space in which its predictions improve the most, and is not led by rewards.",
      "; motors, a matrix\nof numbers in [-1e9, 1e9], a row a motion (None: one number, from 0 of "
      "the first motion to 1\nof the last)");
  cls.def(py::init(
              [](const std::optional<IacConfig>& given, Whole<SeedTag> seed, const Matrix& motors) {
                return std::make_shared<Iac>(given.value_or(IacConfig{}), seed.value,
                                             motors_from(motors));
              }),
          py::arg("config") = py::none(), py::arg("seed") = 0, py::arg("motors") = py::none())
      .def_property_readonly(
          "motors", [](const Iac& self) { return matrix_of(readable(self).motors()); },
          "A copy of the matrix of motors; None where it is not needed yet.")
      .def(
          "explain",
          [](const Iac& self, const KeptObservation& observation) {
            return readable(self).explain(SeenObservation(observation));
          },
          py::arg("observation"),
          "Why motions are chosen for what is observed: an IacExplanation. Draws and changes "
          "nothing. Raises InvalidValue.")
      .def(
          "predict",
          [](const Iac& self, const KeptObservation& observation,
             Whole<MotionTag> motion) -> std::optional<py::array_t<double>> {
            std::optional<std::vector<double>> next =
                readable(self).predict(SeenObservation(observation), motion.value);
            if (!next) return std::nullopt;
            return py::array_t<double>(moved_array<double>(std::move(*next)));
          },
          py::arg("observation"), py::arg("motion"),
          "What will be sensed after a motion, by what is learned so far; None before the first "
          "exemplar. Raises InvalidValue.")
      .def(
          "regions",
          [](const Iac& self) {
            const std::vector<IacRegion> regions = readable(self).regions();
            return array_of_regions(regions, regions.empty() ? 0 : regions[0].lower.size());
          },
          "All regions that ever were, by their number: a structured array with the fields of an "
          "IacRegion.")
      .def(
          "tree", [](const Iac& self) { return to_text(readable(self).regions()); },
          "The regions as a text, each line below that of the region that it was split from.");
}

}  // namespace devlearn::python
