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
      .def("next", &Random::next, "64 random bits as an int.")
      .def("uniform", &Random::uniform, "A float uniform on [0, 1).")
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
