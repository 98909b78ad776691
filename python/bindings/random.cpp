#include "devlearn/random.hpp"

#include "bindings.hpp"
#include "devlearn/detail/require.hpp"

namespace devlearn::python {
namespace {

struct CountTag {
  using type = long long;
  static constexpr const char* quantity = "count";
  static constexpr const char* allowed = "a whole number in [1, 2^32 - 1]";
};

}  // namespace

void bind_random(py::module_& m) {
  py::class_<Random>(m, "Random",
                     "A seedable generator (xoshiro256++) with named streams; the same draws on "
                     "every machine.\n\nThe paper's learner draws from the stream \"agent\" of its "
                     "seed.")
      .def(py::init([](Whole<SeedTag> seed, const std::string& stream) {
             return Random(seed.value, stream);
           }),
           py::arg("seed"), py::arg("stream"))
      .def_static(
          "from_state",
          [](const py::array& state) {
            Random::State words{};
            if (!py::isinstance<py::array_t<std::uint64_t>>(state) || state.ndim() != 1 ||
                state.shape(0) != static_cast<py::ssize_t>(words.size())) {
              throw InvalidValue("state", shown(state), "an array of four uint64");
            }
            const auto view = py::array_t<std::uint64_t>(state).unchecked<1>();
            for (std::size_t i = 0; i < words.size(); ++i) {
              words[i] = view(static_cast<py::ssize_t>(i));
            }
            if (words == Random::State{}) {
              throw InvalidValue("state", "all zeros", "a state of the generator");
            }
            return Random(words);
          },
          py::arg("state"),
          "A generator that goes on from a state. Raises InvalidValue for what is none.")
      .def_property_readonly(
          "state",
          [](const Random& self) {
            return py::array_t<std::uint64_t>(static_cast<py::ssize_t>(self.state().size()),
                                              self.state().data());
          },
          "What it goes on from, as an array of four uint64.")
      .def(py::pickle([](const Random& self) { return self.state(); },
                      [](const Random::State& state) { return Random(state); }))
      .def("__repr__",
           [](const Random& self) { return "<devlearn.Random: state " + words_of(self) + ">"; })
      .def(
          "__eq__",
          [](const Random& self, const Random& other) { return self.state() == other.state(); },
          py::is_operator())
      .def("next", &Random::next, "64 random bits as an int.")
      .def("uniform", &Random::uniform, "A float uniform on [0, 1).")
      .def("normal", &Random::normal,
           "Normal with mean 0 and standard deviation 1, as far as twelve uniform numbers less six "
           "are (Irwin-Hall); never beyond 6.")
      .def(
          "index",
          [](Random& self, Whole<CountTag> count) {
            require_count("count", count.value, 1, 0xffffffffLL);
            return self.index(static_cast<std::uint32_t>(count.value));
          },
          py::arg("count"),
          "An int uniform on {0, ..., count - 1}. Raises InvalidValue unless 1 <= count < 2**32.");
}

}  // namespace devlearn::python
