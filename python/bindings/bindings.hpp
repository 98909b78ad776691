#pragma once

// The one include point of the bindings: pybind11, the casters of ours, and what each file defines.

#include <pybind11/native_enum.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/world.hpp"
#include "threads.hpp"

namespace py = pybind11;

namespace devlearn::python {

void bind_error(py::module_& m);
void bind_math(py::module_& m);
void bind_random(py::module_& m);
void bind_situation(py::module_& m);
void bind_evaluation(py::module_& m);
void bind_learner(py::module_& m);
void bind_adaptive(py::module_& m);
void bind_explanation(py::module_& m);
void bind_world(py::module_& m);
void bind_robot(py::module_& m);
void bind_record(py::module_& m);
void bind_tally(py::module_& m);
void bind_agents(py::module_& m);
void bind_value_agents(py::module_& m);
void bind_iac(py::module_& m);
void bind_attention(py::module_& m);
void bind_operant_conditioning(py::module_& m);
void bind_salient_events(py::module_& m);
void bind_tasks(py::module_& m);
void bind_balance(py::module_& m);
void bind_playroom(py::module_& m);
void bind_appraisal(py::module_& m);
void bind_foraging(py::module_& m);
void bind_trial(py::module_& m);
void bind_trial_snapshot(py::module_& m);
void bind_batch(py::module_& m);
void bind_file(py::module_& m);

/// A whole number from Python that devlearn refuses itself where it does not fit the C++ type.
template <typename Tag>
struct Whole {
  typename Tag::type value = 0;
};
struct SituationTag {
  using type = SituationId;
  static constexpr const char* quantity = "situation";
  static constexpr const char* allowed = "a whole number in [0, 2^63 - 1]";
};
struct SeedTag {
  using type = std::uint64_t;
  static constexpr const char* quantity = "seed";
  static constexpr const char* allowed = "a whole number in [0, 2^64 - 1]";
};
struct MotionTag {
  using type = int;
  static constexpr const char* quantity = "motion";
  static constexpr const char* allowed = "a whole number in [0, motion_count - 1]";
};

/// Which motions may be chosen, from Python: None for every one, or bools.
class Mask {
 public:
  Mask() = default;
  explicit Mask(py::array_t<bool> allowed) : allowed_(std::move(allowed)) {}
  /// A view of it.
  operator AllowedMotions() const {
    if (!allowed_) return {};
    return {allowed_->data(), static_cast<std::size_t>(allowed_->size())};
  }

 private:
  std::optional<py::array_t<bool>> allowed_;
};

/// devlearn.Record, built on the Python side; record_of looks at one that is given.
class RecordObject : public py::object {
 public:
  using py::object::object;
  explicit RecordObject(py::object record) : py::object(std::move(record)) {}
  static bool check_(py::handle) { return true; }
};

/// devlearn.LearnerMemory, or what has its attributes.
class MemoryObject : public py::object {
 public:
  using py::object::object;
  explicit MemoryObject(py::object memory) : py::object(std::move(memory)) {}
  static bool check_(py::handle) { return true; }
};

/// A threading.Event, or what has its is_set().
class EventObject : public py::object {
 public:
  using py::object::object;
  static bool check_(py::handle event) { return py::hasattr(event, "is_set"); }
  bool is_set() const { return py::bool_(attr("is_set")()); }
};

/// A path from Python as the system takes it: text, bytes or os.PathLike. Raises
/// WrongType.
inline std::string file_path(const py::object& path) {
  const py::object known = py::module_::import("devlearn._calls").attr("path_text")(path);
  std::string text = py::bytes(py::module_::import("os").attr("fsencode")(known));
  if (text.find('\0') != std::string::npos) {
    throw FileError(text.substr(0, text.find('\0')), "", "a name that holds a null",
                    "a file's name");
  }
  return text;
}

/// A numpy array that takes over the vector's memory.
template <typename Scalar, typename T>
py::array moved_array(std::vector<T>&& values, std::vector<py::ssize_t> shape = {}) {
  static_assert(sizeof(Scalar) == sizeof(T));
  auto* owned = new std::vector<T>(std::move(values));
  const py::capsule owner(owned, [](void* data) { delete static_cast<std::vector<T>*>(data); });
  if (shape.empty()) shape = {static_cast<py::ssize_t>(owned->size())};
  return py::array(py::dtype::of<Scalar>(), std::move(shape), owned->data(), owner);
}

/// A value as it may stand in a message: its repr, or another text of it, cut where it is long.
std::string shown(py::handle value, PyObject* (*text)(PyObject*) = PyObject_Repr);

/// Pickling by state(T) and made(state), a T; what an object of a derived class has besides comes
/// along.
template <typename Class, typename State, typename Made>
void def_pickling_by_state(Class& cls, const State& state, const Made& made) {
  using T = typename Class::type;
  cls.def(py::pickle(
      [=](const py::object& self) {
        return py::make_tuple(state(self.cast<const T&>()),
                              py::getattr(self, "__dict__", py::dict()));
      },
      [=](const py::object& given) {
        if (!py::isinstance<py::tuple>(given) || py::len(given) != 2) {
          throw InvalidValue("state", shown(given), "a tuple of two, as pickle writes it");
        }
        const auto both = given.cast<py::tuple>();
        return std::pair(std::make_shared<T>(made(both[0])),
                         both[1].attr("copy")().template cast<py::dict>());
      }));
}

/// The attributes of these names, as a tuple.
inline py::tuple attributes(const py::object& self, const std::vector<std::string>& names) {
  py::tuple values(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) values[i] = self.attr(names[i].c_str());
  return values;
}

/// A generator's state, for a repr.
inline std::string words_of(const Random& random) {
  std::string text;
  for (const std::uint64_t word : random.state()) {
    text += (text.empty() ? "" : " ") + std::to_string(word);
  }
  return text;
}

/// With a capital and a full stop.
inline std::string sentence(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

using State = py::typing::Tuple<py::object, py::ellipsis>;

/// Equality by value, and pickling, of a class without a constructor: by these members.
template <typename T, typename... Members>
void def_result(py::class_<T>& cls, Members... members) {
  cls.def(py::pickle(
      [=](const T& self) -> State { return py::make_tuple(self.*members...); },
      [=](const State& state) {
        if (state.size() != sizeof...(members)) {
          throw InvalidValue("state", shown(state),
                             "a tuple of " + std::to_string(sizeof...(members)) + " values");
        }
        T value;
        std::size_t i = 0;
        ((value.*members = state[i++].template cast<std::decay_t<decltype(value.*members)>>()),
         ...);
        return value;
      }));
  cls.def("__eq__", [](const py::object& self, const py::object& other) {
    return py::type::of(self).is(py::type::of(other)) &&
           self.attr("__getstate__")().equal(other.attr("__getstate__")());
  });
}

/// Pickling of a class whose constructor takes the attributes of these names, in this order.
template <typename T>
void def_pickling(py::class_<T>& cls, std::vector<std::string> names) {
  cls.def("__reduce__", [names = std::move(names)](const py::object& self) {
    return py::make_tuple(py::type::of(self), attributes(self, names));
  });
}

/// Equality and pickling of a class that is made from the attributes of these names.
template <typename T>
void def_value(py::class_<T>& cls, const std::vector<std::string>& names) {
  cls.def(
      "__eq__",
      [names](const py::object& a, const T& b) {
        return attributes(a, names).equal(attributes(py::cast(b), names));
      },
      py::is_operator());
  def_pickling(cls, names);
}

}  // namespace devlearn::python

namespace PYBIND11_NAMESPACE {
namespace detail {

/// A pose from any three numbers; back as devlearn.Pose.
template <>
struct type_caster<devlearn::Pose> {
  PYBIND11_TYPE_CASTER(devlearn::Pose,
                       io_name("collections.abc.Sequence[float]", "devlearn._types.Pose"));
  bool load(handle source, bool convert);
  static handle cast(const devlearn::Pose& pose, return_value_policy, handle);
};

/// A point from any two numbers; back as a tuple.
template <>
struct type_caster<devlearn::Point> {
  PYBIND11_TYPE_CASTER(devlearn::Point,
                       io_name("collections.abc.Sequence[float]", "tuple[float, float]"));
  bool load(handle source, bool convert);
  static handle cast(const devlearn::Point& point, return_value_policy, handle);
};

/// devlearn.Choice and devlearn.Development, and back.
template <>
struct type_caster<devlearn::Choice> {
  PYBIND11_TYPE_CASTER(devlearn::Choice, const_name("devlearn._types.Choice"));
  bool load(handle source, bool convert);
  static handle cast(const devlearn::Choice& choice, return_value_policy, handle);
};
template <>
struct type_caster<devlearn::Development> {
  PYBIND11_TYPE_CASTER(devlearn::Development, const_name("devlearn._types.Development"));
  bool load(handle source, bool convert);
  static handle cast(const devlearn::Development& development, return_value_policy, handle);
};

template <typename L>
struct type_caster<devlearn::python::IdleOf<L>> {
  PYBIND11_TYPE_CASTER(devlearn::python::IdleOf<L>, make_caster<L>::name);
  bool load(handle source, bool convert) {
    // Looked up once: that takes longer than choosing.
    static const type_info* const type = get_type_info(typeid(L));
    type_caster_generic learner(type);
    if (!learner.load(source, convert) || learner.value == nullptr) return false;
    value = {*static_cast<L*>(learner.value), type->type->tp_name + sizeof "devlearn._core." - 1};
    return true;
  }
};

/// Bools alone: of numbers nobody knows which ones mean true.
template <>
struct type_caster<devlearn::python::Mask> {
  PYBIND11_TYPE_CASTER(devlearn::python::Mask,
                       const_name("collections.abc.Sequence[bool] | "
                                  "numpy.typing.NDArray[numpy.bool_] | None"));
  bool load(handle source, bool convert);
};

template <typename Tag>
struct type_caster<devlearn::python::Whole<Tag>> {
  PYBIND11_TYPE_CASTER(devlearn::python::Whole<Tag>, const_name("typing.SupportsIndex"));
  bool load(handle source, bool) {
    // What is whole counts, 3.0 too; a conversion would cut fractions off.
    const bool real =
        PyIndex_Check(source.ptr()) == 0 && PyObject_HasAttrString(source.ptr(), "is_integer") != 0;
    double number = real ? PyFloat_AsDouble(source.ptr()) : 0.5;
    if (PyErr_Occurred() != nullptr) number = 0.5;
    PyErr_Clear();
    const auto whole =
        reinterpret_steal<object>(std::nearbyint(number) == number ? PyLong_FromDouble(number)
                                                                   : PyNumber_Index(source.ptr()));
    make_caster<typename Tag::type> caster;
    if (whole && !PyBool_Check(source.ptr()) && caster.load(whole, false)) {
      value.value = cast_op<typename Tag::type>(caster);
      return true;
    }
    PyErr_Clear();
    if (!PyIndex_Check(source.ptr()) && !real) return false;
    throw devlearn::InvalidValue(Tag::quantity, devlearn::python::shown(source, PyObject_Str),
                                 Tag::allowed);
  }
};

template <>
struct handle_type_name<devlearn::python::MemoryObject> {
  static constexpr auto name = const_name("devlearn._types.LearnerMemory");
};

template <>
struct handle_type_name<devlearn::python::EventObject> {
  static constexpr auto name = const_name("threading.Event");
};

template <>
struct handle_type_name<devlearn::python::RecordObject> {
  static constexpr auto name = const_name("devlearn.record.Record");
};

}  // namespace detail
}  // namespace PYBIND11_NAMESPACE
