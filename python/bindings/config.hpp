#pragma once

// A class for each Def, made of what the Def says of its fields.

#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"
#include "devlearn/detail/fields.hpp"

namespace devlearn::python {

template <typename Def, std::size_t I>
constexpr auto field_of() {
  return std::get<I>(Def::fields().each);
}

/// A whole number for a field, which refuses by its name what does not fit its type.
template <typename Def, std::size_t I>
struct FieldTag {
  using type = typename decltype(field_of<Def, I>())::Value;
  static inline const std::string quantity =
      detail::quantity(Def::fields().owner, field_of<Def, I>().name);
  static inline const std::string allowed = field_of<Def, I>().allowed();
};

template <typename T>
struct Type {
  using type = T;
};

template <typename Range>
constexpr bool is_nested = std::is_same_v<std::decay_t<Range>, detail::Nested> ||
                           detail::IsOneOf<std::decay_t<Range>>::value;

template <typename Def, std::size_t I>
constexpr auto type_of_argument() {
  using Field = decltype(field_of<Def, I>());
  using T = typename Field::Value;
  if constexpr (std::is_enum_v<T>) {
    return Type<std::string>{};
  } else if constexpr (is_nested<decltype(Field::range)>) {
    return Type<std::optional<T>>{};
  } else if constexpr (std::is_same_v<decltype(Field::range), detail::WholeNumbers>) {
    return Type<Whole<FieldTag<Def, I>>>{};
  } else {
    return Type<T>{};
  }
}
/// What Python gives for a field.
template <typename Def, std::size_t I>
using Argument = typename decltype(type_of_argument<Def, I>())::type;

template <typename Def, std::size_t I>
void assign(Def& def, Argument<Def, I>&& given) {
  constexpr auto field = field_of<Def, I>();
  auto& place = def.*field.member;
  using T = std::decay_t<decltype(place)>;
  if constexpr (std::is_enum_v<T>) {
    const auto& names = field.range.names;
    const auto found = std::find(names.begin(), names.end(), given);
    if (found == names.end()) {
      throw InvalidValue(detail::quantity(Def::fields().owner, field.name), "'" + given + "'",
                         field.allowed());
    }
    place = static_cast<T>(found - names.begin());
  } else if constexpr (is_nested<decltype(field.range)>) {
    if (given) place = *std::move(given);
  } else if constexpr (std::is_same_v<decltype(field.range), detail::WholeNumbers>) {
    place = given.value;
  } else {
    place = std::move(given);
  }
}

/// What a signature shows as the field's default.
template <typename Def, std::size_t I>
py::object default_of(const Def& defaults) {
  constexpr auto field = field_of<Def, I>();
  const auto& value = defaults.*field.member;
  using T = std::decay_t<decltype(value)>;
  if constexpr (std::is_enum_v<T>) {
    return py::str(field.range.names[static_cast<std::size_t>(value)]);
  } else if constexpr (is_nested<decltype(field.range)>) {
    return py::none();
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    return py::tuple(py::cast(value));
  } else {
    return py::cast(value);
  }
}

/// Such as "eta: orientation parameter of Eq. 9; in (0, 1)."
template <typename Field>
std::string text_of(const Field& field) {
  const std::string rest = field.doc + std::string("; ") + field.allowed();
  return *field.symbol == '\0' ? sentence(rest) : field.symbol + std::string(": ") + rest + ".";
}

/// Text in lines of a docstring that is indented by four already, each after four spaces.
std::string in_lines(const std::string& text);

template <typename Def, std::size_t... I>
void def_constructor(py::class_<Def>& cls, std::index_sequence<I...>) {
  const Def defaults;
  cls.def(
      py::init([](Argument<Def, I>... given) {
        Def def;
        (assign<Def, I>(def, std::move(given)), ...);
        def.validate();
        return def;
      }),
      (py::arg(field_of<Def, I>().name)
           // Any value has a truth; what is no bool is refused.
           .noconvert(std::is_same_v<Argument<Def, I>, bool>) = default_of<Def, I>(defaults))...);
}

/// The classes of a variant's Defs by kind; the first is the one meant where none is named.
template <std::size_t N, typename... Defs>
py::dict types_of(const detail::OneOf<N>& range, const std::variant<Defs...>*) {
  py::dict types;
  std::size_t i = 0;
  ((types[i == 0 ? "" : range.kinds[i]] = py::type::of<Defs>(), ++i), ...);
  types[range.kinds[0]] = types[""];
  return types;
}

/// What a field's dict says besides its fields: which class it stands for, if not the first.
std::string kind_of(const py::dict& nested, const std::string& field, const py::object& type);
/// What a field's dict stands for. Throws InvalidValue for an unknown kind.
py::object nested_from_dict(const std::string& quantity, const py::dict& types,
                            const py::handle& fields);

/// The class: its constructor, an attribute a field, fields, to_dict, from_dict, replace, equality,
/// hash, repr and pickling. `about` is the docstring's head.
template <typename Def>
py::class_<Def> def_config(py::module_& m, const std::string& about) {
  const std::string owner = Def::fields().owner;
  std::vector<std::string> names;
  py::dict nested;  // the classes that a field's dict stands for, by its kind
  std::string doc = about + "\n\nRaises InvalidValue.\n\nParameters\n----------\n";
  detail::each_field<Def>([&](const auto& field) {
    names.emplace_back(field.name);
    if constexpr (std::is_same_v<decltype(field.range), detail::Nested>) {
      nested[field.name] =
          py::dict(py::arg("") = py::type::of<typename std::decay_t<decltype(field)>::Value>());
    } else if constexpr (is_nested<decltype(field.range)>) {
      nested[field.name] = types_of(
          field.range, static_cast<const typename std::decay_t<decltype(field)>::Value*>(nullptr));
    }
    doc += field.name + std::string("\n") + in_lines(text_of(field));
  });

  py::class_<Def> cls(m, owner.c_str(), doc.c_str());
  constexpr auto count = std::tuple_size_v<decltype(Def::fields().each)>;
  def_constructor(cls, std::make_index_sequence<count>{});
  detail::each_field<Def>([&](const auto& field) {
    const std::string text = text_of(field);
    if constexpr (std::is_enum_v<typename std::decay_t<decltype(field)>::Value>) {
      cls.def_property_readonly(
          field.name,
          [field](const Def& self) {
            return field.range.names[static_cast<std::size_t>(self.*field.member)];
          },
          text.c_str());
    } else {
      cls.def_readonly(field.name, field.member, text.c_str());
    }
  });

  cls.def_static(
      "fields",
      [] {
        const py::object defaults = py::cast(Def{});
        py::dict fields;
        detail::each_field<Def>([&](const auto& field) {
          fields[field.name] = py::dict(
              py::arg("symbol") = field.symbol, py::arg("unit") = detail::unit_of(field.range),
              py::arg("range") = field.allowed(), py::arg("default") = defaults.attr(field.name),
              py::arg("doc") = field.doc);
        });
        return fields;
      },
      "What each field is, by name: a dict of its symbol, unit, range, default and doc.");
  cls.def(
      "to_dict",
      [names, nested](const py::object& self) {
        py::dict fields;
        for (const std::string& name : names) {
          py::object value = self.attr(name.c_str());
          if (py::hasattr(value, "to_dict")) {
            const py::object type = py::type::of(value);
            value = value.attr("to_dict")();
            if (const std::string kind = kind_of(nested, name, type); !kind.empty()) {
              value["kind"] = kind;
            }
          }
          fields[name.c_str()] = value;
        }
        return fields;
      },
      "Its fields as a dict of plain values, as JSON can hold.");
  const auto from_dict = [names, nested, owner, type = py::handle(cls)](const py::dict& fields) {
    py::dict arguments;
    for (const auto& [key, value] : fields) {
      const std::string name = py::str(key);
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        std::string known;
        for (const std::string& field : names) known += (known.empty() ? "" : ", ") + field;
        throw InvalidValue(owner + "." + name, "an unknown field", "one of " + known);
      }
      arguments[key] = nested.contains(key) && py::isinstance<py::dict>(value)
                           ? nested_from_dict(owner + "." + name, nested[key], value)
                           : py::reinterpret_borrow<py::object>(value);
    }
    return type(**arguments).template cast<Def>();
  };
  cls.def_static("from_dict", from_dict, py::arg("fields"),
                 "From a dict of fields; those left out keep their defaults. Raises InvalidValue "
                 "for an unknown field.");
  cls.def(
      "replace",
      [from_dict](const py::object& self, const py::kwargs& changes) {
        py::dict fields = self.attr("to_dict")();
        for (const auto& [key, value] : changes) fields[key] = value;
        return from_dict(fields);
      },
      "A copy with some fields changed.");
  cls.def(
      "__eq__", [](const Def& a, const Def& b) { return a == b; }, py::is_operator());
  cls.def("__hash__", [names](const py::object& self) {
    py::list values;
    for (const std::string& name : names) {
      const py::object value = self.attr(name.c_str());
      values.append(py::isinstance<py::list>(value) ? py::object(py::tuple(value)) : value);
    }
    return py::hash(py::tuple(values));
  });
  cls.def("__repr__", [names, owner](const py::object& self) {
    std::string text;
    for (const std::string& name : names) {
      text +=
          (text.empty() ? "" : ", ") + name + "=" + std::string(py::repr(self.attr(name.c_str())));
    }
    return owner + "(" + text + ")";
  });
  def_pickling(cls, names);
  return cls;
}

}  // namespace devlearn::python
