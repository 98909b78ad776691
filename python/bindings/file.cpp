#include "file.hpp"

#include <string_view>

#include "bindings.hpp"

namespace devlearn::python {

void bind_file(py::module_& m) {
  m.def(
      "write_file",
      [](const py::object& path, const py::bytes& content) {
        const std::string name = file_path(path);
        const std::string_view view = content;
        // Another thread may hold the file's lock and want the GIL.
        const NoGil no_gil;
        SideFile file(name);
        file.write(view.data(), view.size());
        file.commit();
      },
      py::arg("path"), py::arg("content"),
      "Writes a file as a whole: to the side, flushed to the disk, renamed, its folder flushed. "
      "Raises FileError; then what was there before is whole.");
}

}  // namespace devlearn::python
