// An empty call from Python, bound as devlearn's are: what a crossing costs at least.

#include <pybind11/pybind11.h>

PYBIND11_MODULE(bench_crossing, m) {
  m.def("empty", [] {});
}
