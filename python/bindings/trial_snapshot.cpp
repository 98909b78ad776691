#include "devlearn/trial_snapshot.hpp"

#include <optional>
#include <utility>

#include "agents.hpp"
#include "bindings.hpp"
#include "parts.hpp"
#include "record_object.hpp"

namespace devlearn::python {
namespace {

/// What Python asks to be saved, as C++ does; it is made with the GIL held.
class Saving {
 public:
  Saving(const Trial& trial, const py::object& record, bool without_agent)
      : reading_(trial, InHand::For::kReading) {
    options_.agent = !without_agent;
    if (record.is_none()) return;
    const py::module_ ours = py::module_::import("devlearn.record");
    if (!py::isinstance(record, ours.attr("Record"))) {
      throw InvalidValue("record", shown(record), "None or a Record");
    }
    record_ = record_of(record);
    options_.record = &record_;
    const py::object dumps = py::module_::import("json").attr("dumps");
    options_.note = dumps(record.attr("provenance")).cast<std::string>();
  }
  Saving(const Saving&) = delete;
  Saving& operator=(const Saving&) = delete;

  const SaveOptions& options() const { return options_; }

 private:
  InHand reading_;
  Record record_;
  SaveOptions options_;
};

py::bytes snapshot_bytes(const Trial& trial, const py::object& record, bool without_agent) {
  const Saving saving(trial, record, without_agent);
  std::vector<std::byte> bytes;
  {
    const NoGil no_gil;
    bytes = to_bytes(trial, saving.options());
  }
  return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

LoadOptions options_of(const py::object& agent, const py::object& evaluation,
                       const py::object& situations) {
  LoadOptions options = load_options(agent);
  options.parts = parts_from(evaluation, situations);
  return options;
}

// What its snapshot names and does not hold.
py::object evaluation_to_keep(const Trial& trial) {
  return trial.parts().evaluation.function ? evaluation_of(trial) : py::none();
}

TrialSnapshot from_bytes(const py::bytes& bytes, const LoadOptions& options,
                         const std::string& source) {
  const std::string_view view = bytes;
  const NoGil no_gil;
  return load_trial(reinterpret_cast<const std::byte*>(view.data()), view.size(), options, source);
}

}  // namespace

void bind_trial_snapshot(py::module_& m) {
  m.def(
      "record_in_snapshot",
      [](const py::object& path) -> py::object {
        const std::string source = file_path(path);
        RecordSnapshot snapshot = [&] {
          const NoGil no_gil;
          return load_record(source);
        }();
        if (!snapshot.record) throw FileError(source, "record", "nothing", "a record");
        return py::make_tuple(columns(std::move(*snapshot.record)), snapshot.world, snapshot.config,
                              snapshot.seed, snapshot.note);
      },
      py::arg("path"), "The record in a trial's snapshot, for Record.load.");
  m.def(
      "require_record", [](const py::object& record) { record_of(record).validate(); },
      py::arg("record"), "Raises InvalidValue unless a Record holds what a trial can write.");

  auto cls = py::reinterpret_borrow<py::class_<Trial>>(m.attr("Trial"));
  cls.def(
         "save",
         [](const Trial& self, const py::object& path, const py::object& record,
            bool without_agent) {
           const std::string name = file_path(path);
           const Saving saving(self, record, without_agent);
           const NoGil no_gil;
           save(self, name, saving.options());
         },
         py::arg("path"), py::arg("record") = py::none(), py::kw_only(),
         py::arg("without_agent") = false,
         "Writes a snapshot (safetensors layout): world, configuration, seed, pose, round and "
         "agent "
         "with its generator, and a Record if one is given, which Record.load reads. To the side "
         "first, flushed, then renamed. Of agents devlearn's own are saved, and one "
         "with state() -> dict of str, numbers and numpy arrays, whose class has from_state(dict); "
         "any other only by its owner: then save the trial `without_agent`. Raises FileError, "
         "InvalidValue.")
      .def_static(
          "load",
          [](const py::object& path, const py::object& agent, const py::object& evaluation,
             const py::object& situations) {
            const std::string name = file_path(path);
            const LoadOptions options = options_of(agent, evaluation, situations);
            const NoGil no_gil;
            return load_trial(name, options).trial;
          },
          py::arg("path"), py::arg("agent") = py::none(), py::kw_only(),
          py::arg("evaluation") = py::none(), py::arg("situations") = py::none(),
          "The trial in a snapshot; it goes on equal to the bit, in the middle of a round, too. "
          "`agent` takes the place of the one in the file; a class makes it, by from_state(dict) "
          "of "
          "what its state() was. `evaluation` and `situations` are the callables that the file "
          "names, given again; an array is in the file. Nothing is imported by a name in the file. "
          "Raises FileError, "
          "saying what is wrong with the file.")
      .def("to_bytes", &snapshot_bytes, py::arg("record") = py::none(), py::kw_only(),
           py::arg("without_agent") = false, "The snapshot as bytes.")
      .def_static(
          "from_bytes",
          [](const py::bytes& bytes, const py::object& agent, const py::object& evaluation,
             const py::object& situations) {
            return from_bytes(bytes, options_of(agent, evaluation, situations), "bytes").trial;
          },
          py::arg("snapshot"), py::arg("agent") = py::none(), py::kw_only(),
          py::arg("evaluation") = py::none(), py::arg("situations") = py::none(),
          "The trial in a snapshot's bytes. Raises FileError.")
      // The agent is pickled or copied by its own rules, and with whoever else holds it; functions
      // likewise.
      .def(py::pickle(
          [](const py::object& self) -> py::object {
            const auto& trial = self.cast<const Trial&>();
            return py::make_tuple(snapshot_bytes(trial, py::none(), true), agent_of(trial),
                                  self.attr("__dict__"), evaluation_to_keep(trial),
                                  situations_of(trial));
          },
          [](const py::object& given) {
            const auto state = given.cast<py::tuple>();
            LoadOptions options{as_agent(state[1])};
            // Earlier ones have neither.
            if (state.size() > 3) options.parts = parts_from(state[3], state[4]);
            return std::pair(from_bytes(state[0], options, "bytes").trial,
                             state[2].cast<py::dict>());
          }))
      .def(
          "copy",
          [](const py::object& self) { return py::module_::import("copy").attr("deepcopy")(self); },
          "An independent trial, with an agent of its own, that goes on alike.")
      .def("__copy__", [](const py::object& self) { return self.attr("copy")(); });
}

}  // namespace devlearn::python
