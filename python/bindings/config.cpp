#include "config.hpp"

#include <sstream>

namespace devlearn::python {

std::string in_lines(const std::string& text) {
  constexpr std::size_t kWidth = 92;
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
      lines += "    " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + "    " + line + "\n";
}

std::string kind_of(const py::dict& nested, const std::string& field, const py::object& type) {
  if (!nested.contains(field.c_str())) return "";
  const py::dict types = nested[field.c_str()];
  if (type.is(types[""])) return "";
  for (const auto& [kind, other] : types) {
    if (type.is(other)) return py::str(kind);
  }
  return "";
}

py::object nested_from_dict(const std::string& quantity, const py::dict& types,
                            const py::handle& fields) {
  const py::dict rest = fields.attr("copy")();
  if (!rest.contains("kind") || types.size() == 1) return types[""].attr("from_dict")(rest);
  const py::object kind = rest.attr("pop")("kind");
  if (!py::isinstance<py::str>(kind) || py::len(kind) == 0 || !types.contains(kind)) {
    std::string known;
    for (const auto& [name, type] : types) {
      const std::string text = py::str(name);
      if (!text.empty()) known += (known.empty() ? "'" : " or '") + text + "'";
    }
    throw InvalidValue(quantity + ".kind", shown(kind), known);
  }
  return types[kind].attr("from_dict")(rest);
}

}  // namespace devlearn::python
