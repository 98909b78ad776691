#include "parts.hpp"

#include <memory>

#include "agents.hpp"
#include "devlearn/error.hpp"

namespace devlearn::python {
namespace {

py::object senses_in_python(const Senses& senses) {
  return py::module_::import("devlearn._types")
      .attr("Senses")(senses.pose, senses.goal_distance, senses.clearance);
}

// A function as files name it: by itself, or by the class of an object that can be called.
std::string name_of_callable(const py::object& callable) {
  return name_of(py::hasattr(callable, "__qualname__") ? callable
                                                       : py::object(py::type::of(callable)));
}

struct PythonEvaluation {
  std::shared_ptr<const py::object> callable;
  double operator()(const Senses& senses) const {
    const Gil gil;
    const py::object sef = (*callable)(senses_in_python(senses));
    const double value = PyFloat_AsDouble(sef.ptr());
    if (PyErr_Occurred() == nullptr) return value;
    const py::error_already_set error;
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_OverflowError)) throw error;
    throw InvalidValue("SEF by " + name_of_callable(*callable), shown(sef),
                       "a number in [-1e300, 1e300]");
  }
};

struct PythonSituations {
  std::shared_ptr<const py::object> callable;
  SituationId operator()(const Senses& senses) const {
    const Gil gil;
    const py::object given = (*callable)(senses_in_python(senses));
    try {
      return given.cast<Whole<SituationTag>>().value;
    } catch (const InvalidValue&) {
    } catch (const py::cast_error&) {
    }
    throw InvalidValue("situation by " + name_of_callable(*callable), shown(given),
                       SituationTag::allowed);
  }
};

template <typename Function, typename Value>
void put(NamedFunction<Value>& part, const py::object& callable) {
  part = {name_of_callable(callable), Function{shared_object(callable)}};
}

// None where it is none of Python's.
template <typename Function, typename Value>
py::object callable_of(const NamedFunction<Value>& part) {
  const Function* const ours = part.function.template target<Function>();
  return ours == nullptr ? py::object(py::none()) : *ours->callable;
}

std::vector<double> table_from(const py::object& evaluation) {
  const auto table =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(evaluation);
  if (!table || table.ndim() != 1 || table.size() == 0) {
    PyErr_Clear();
    throw InvalidValue("evaluation", shown(evaluation),
                       "None, a callable of Senses, or an array of SEFs, one a situation of the "
                       "grid");
  }
  return {table.data(), table.data() + table.size()};
}

}  // namespace

TrialParts parts_from(const py::object& evaluation, const py::object& situations) {
  TrialParts parts;
  if (py::isinstance<StateEvaluation>(evaluation)) {
    throw InvalidValue("evaluation", shown(evaluation),
                       "a callable of Senses, or an array; a StateEvaluation stands in the config");
  }
  if (PyCallable_Check(evaluation.ptr()) != 0) {
    put<PythonEvaluation>(parts.evaluation, evaluation);
  } else if (!evaluation.is_none()) {
    parts.sef_table = table_from(evaluation);
  }
  if (PyCallable_Check(situations.ptr()) != 0) {
    put<PythonSituations>(parts.situations, situations);
  } else if (!situations.is_none()) {
    throw InvalidValue("situations", shown(situations), "None, or a callable of Senses");
  }
  return parts;
}

py::object evaluation_of(const Trial& trial) {
  const TrialParts& parts = trial.parts();
  if (parts.sef_table.empty()) return callable_of<PythonEvaluation>(parts.evaluation);
  return py::array_t<double>(static_cast<py::ssize_t>(parts.sef_table.size()),
                             parts.sef_table.data());
}

py::object situations_of(const Trial& trial) {
  return callable_of<PythonSituations>(trial.parts().situations);
}

py::dict names_of(const TrialParts& parts) {
  py::dict names;
  if (parts.evaluation.function) names["evaluation"] = parts.evaluation.name;
  if (!parts.sef_table.empty()) names["evaluation"] = "table";
  if (parts.situations.function) names["situations"] = parts.situations.name;
  return names;
}

}  // namespace devlearn::python
