#include "devlearn/record.hpp"

#include <type_traits>

#include "bindings.hpp"
#include "record_object.hpp"

namespace devlearn::python {

namespace {

// What stands in a column as numpy sees it.
template <typename Column>
using Scalar =
    std::conditional_t<std::is_same_v<typename Column::Value, bool>, bool, typename Column::Stored>;

template <typename Visit>
void each_column(const Visit& visit) {
  detail::each_column(Record::step_columns(), visit);
  detail::each_column(Record::pose_columns(), visit);
}

// name -> (dtype, what it is)
template <typename Columns>
py::dict described(const Columns& columns) {
  py::dict result;
  detail::each_column(columns, [&](const auto& column) {
    const py::object dtype = py::dtype::of<Scalar<std::decay_t<decltype(column)>>>().attr("name");
    result[column.name] = py::make_tuple(dtype, column.doc);
  });
  return result;
}

}  // namespace

py::dict columns(Record&& record) {
  const auto steps = static_cast<py::ssize_t>(record.steps());
  const py::ssize_t sonars = record.sonar_count;
  py::dict result;
  each_column([&](const auto& column) {
    result[column.name] =
        moved_array<Scalar<std::decay_t<decltype(column)>>>(std::move(record.*column.values));
  });
  result["rounds"] = moved_array<Round>(std::move(record.rounds));
  if (sonars > 0) {
    result["echoes"] = moved_array<double>(std::move(record.echoes), {steps, sonars});
  }
  return result;
}

namespace {

template <typename Dtype, typename T>
void copy_column(const py::object& record, const char* name, std::vector<T>& column) {
  static_assert(sizeof(Dtype) == sizeof(T));
  const py::object values = record.attr(name);
  const auto array = py::array_t<Dtype, py::array::c_style>::ensure(values);
  if (!array || !py::isinstance<py::array_t<Dtype>>(values)) {
    PyErr_Clear();
    throw InvalidValue("record." + std::string(name), py::repr(py::type::of(values)),
                       "an array of " + std::string(py::str(py::dtype::of<Dtype>())));
  }
  const auto* const first = reinterpret_cast<const T*>(array.data());
  column.assign(first, first + array.size());
}

}  // namespace

Record record_of(const py::object& source) {
  if (!py::isinstance(source, py::module_::import("devlearn.record").attr("Record"))) {
    throw InvalidValue("record", shown(source), "a Record");
  }
  Record record;
  each_column([&](const auto& column) {
    copy_column<Scalar<std::decay_t<decltype(column)>>>(source, column.name, record.*column.values);
  });
  const py::object rounds = source.attr("rounds");
  for (const py::handle entry : rounds) {
    record.rounds.push_back({entry["round"].cast<std::int32_t>(),
                             entry["steps"].cast<std::int64_t>(), entry["arrived"].cast<bool>(),
                             entry["began"].cast<std::int64_t>()});
  }
  if (const py::object echoes = source.attr("echoes"); !echoes.is_none()) {
    copy_column<double>(source, "echoes", record.echoes);
    record.sonar_count = echoes.attr("shape")[py::int_(1)].cast<int>();
  }
  return record;
}

void bind_record(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(Round, round, steps, arrived, began);

  m.attr("step_columns") = described(Record::step_columns());
  py::list may_lack;
  detail::each_column(Record::step_columns(), [&](const auto& column) {
    if constexpr (std::decay_t<decltype(column)>::may_lack()) may_lack.append(column.name);
  });
  m.attr("later_columns") = py::tuple(may_lack);
  m.attr("pose_columns") = described(Record::pose_columns());

  py::class_<Step> step(m, "Step", "Everything about one step of a trial.");
  detail::each_column(Record::step_columns(), [&](const auto& column) {
    step.def_readonly(column.name, column.of, sentence(column.doc).c_str());
  });
  step.def_readonly("pose", &Step::pose, "After the step [m, m, degrees].")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.Step: round {}, situation {}, motion {}, {}, smf {:.4g}>")
            .format(self.attr("round"), self.attr("situation"), self.attr("motion"),
                    self.attr("kind").attr("name"), self.attr("smf"));
      });
  std::apply([&](const auto&... column) { def_result(step, column.of..., &Step::pose); },
             Record::step_columns());
}

}  // namespace devlearn::python
