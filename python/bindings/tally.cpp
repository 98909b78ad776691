#include "devlearn/tally.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "bindings.hpp"
#include "record_object.hpp"

namespace devlearn::python {
namespace {

template <typename T>
py::array numbers(py::ssize_t count, py::ssize_t stride, const T* first) {
  return py::array(py::dtype::of<T>(), {count}, {stride}, first);
}

// A copy, an entry a round, without padding.
py::array rounds_of(const std::vector<RoundTally>& rounds) {
  const auto count = static_cast<py::ssize_t>(rounds.size());
  py::list fields;
  detail::each_column(RoundTally::fields(), [&](const auto& field) {
    using T = std::decay_t<decltype(RoundTally().*field.of)>;
    fields.append(py::make_tuple(field.name, py::dtype::of<T>()));
  });
  py::array result(py::dtype::from_args(fields), std::vector<py::ssize_t>{count});
  if (rounds.empty()) return result;
  detail::each_column(RoundTally::fields(), [&](const auto& field) {
    result[field.name] = numbers(count, sizeof(RoundTally), &(rounds.front().*field.of));
  });
  return result;
}

// A table of the fields, as the class's help has it.
std::string help() {
  constexpr std::size_t kName = 23, kType = 9, kMeaning = 81;
  const auto cell = [](std::string text, std::size_t width) {
    return text + std::string(std::max(width, text.size() + 2) - text.size(), ' ');
  };
  const auto bar = [](std::size_t width) { return std::string(width, '='); };
  const std::string rule = bar(kName) + "  " + bar(kType - 2) + "  " + bar(kMeaning) + "\n";
  std::string table = rule + cell("field", kName + 2) + cell("dtype", kType) + "meaning\n" + rule;
  detail::each_column(RoundTally::fields(), [&](const auto& field) {
    using T = std::decay_t<decltype(RoundTally().*field.of)>;
    table += cell("``" + std::string(field.name) + "``", kName + 2) +
             cell(py::str(py::dtype::of<T>()), kType) + field.doc + "\n";
  });
  return "What a run came to, counted as its steps pass, where no record is kept of them.\n\n"
         "A trial's phases count into the one that they are given as `tally`, whatever their\n"
         "record holds; memory does not grow with steps. It is of one trial. ``rounds`` is a\n"
         "structured array, an entry a round, of\n\n" +
         table + rule +
         "\nA mapping is a situation and a motion executed in it. A round that goes on in another\n"
         "call is one entry, and each of its fields as if it had never been stopped.";
}

}  // namespace

void bind_tally(py::module_& m) {
  py::class_<Tally>(m, "Tally", help().c_str())
      .def(py::init<>(), "One that holds nothing yet.")
      .def_static(
          "of",
          [](const RecordObject& source) {
            const Record record = record_of(source);
            const NoGil no_gil;
            return Tally::of(record);
          },
          py::arg("record"),
          "That of a Record's steps, equal to what is counted as they pass. Raises InvalidValue "
          "for a record of rounds only.")
      .def_property_readonly(
          "rounds",
          [](const Tally& self) {
            require_free(&self, "Tally", InHand::For::kReading);
            return rounds_of(self.rounds());
          },
          "A copy of what each round came to, a structured array.")
      .def_property_readonly(
          "steps",
          [](const Tally& self) {
            require_free(&self, "Tally", InHand::For::kReading);
            return self.steps();
          },
          "How many were counted.")
      .def("__repr__", [](const py::object& self) {
        return py::str("<devlearn.Tally: {} steps in {} rounds>")
            .format(self.attr("steps"), py::len(self.attr("rounds")));
      });
}

}  // namespace devlearn::python
