#include "json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "devlearn/error.hpp"
#include "excerpt.hpp"

namespace devlearn::json {
namespace {

void append(std::string& path, const Step& step) {
  if (const auto* const field = std::get_if<std::string_view>(&step)) {
    path += (path.empty() ? "" : ".") + excerpt(std::string(*field));
  } else {
    path += "[" + std::to_string(std::get<std::size_t>(step)) + "]";
  }
}

[[noreturn]] void refuse_at(const std::string& source, const std::string& path,
                            const std::string& whole, const std::string& value,
                            const std::string& allowed) {
  throw FileError(source, path.empty() ? whole : excerpt(path), value, allowed);
}

// Follows nlohmann's parser through the text, and stops it where the text goes too far.
class Builder {
 public:
  Builder(Value& root, const std::string& source, const std::string& whole, const Limits& limits)
      : root_(root), source_(source), whole_(whole), limits_(limits) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(value); }
  bool number_unsigned(std::uint64_t value) { return put(value); }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& text) { return put(std::move(text)); }
  bool binary(nlohmann::json::binary_t&) { return false; }  // of other formats
  bool start_object(std::size_t) { return open(Object()); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(Array()); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    Open& object = open_.back();
    const auto [field, is_new] = std::get<Object>(object.value->is).try_emplace(std::move(name));
    object.field = &*field;
    if (!is_new) refuse("the field again", "each field once");
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    constexpr int kOverflow = 406;
    std::string what = error.what();
    if (error.id == kOverflow) {
      place();
      refuse(excerpt(what.substr(what.find("number"))), "a number that a double can hold");
    }
    what.erase(0, what.find("line "));
    refuse_at(source_, "", whole_, excerpt(what), "JSON text in UTF-8");
  }

 private:
  struct Open {
    Value* value;
    Object::value_type* field = nullptr;  // the last one, of an object
  };

  // Where the next value goes.
  Value& place() {
    Value* value = &root_;
    if (!open_.empty()) {
      auto* const array = std::get_if<Array>(&open_.back().value->is);
      value = array != nullptr ? &array->emplace_back() : &open_.back().field->second;
    }
    if (++count_ > limits_.values) {
      refuse("another value", "at most " + std::to_string(limits_.values) + " values");
    }
    return *value;
  }

  template <typename T>
  bool put(T&& value) {
    place().is = std::forward<T>(value);
    return true;
  }

  template <typename Container>
  bool open(Container&& container) {
    Value& value = place();
    if (open_.size() == limits_.depth) {
      refuse("deeper nesting", "at most " + std::to_string(limits_.depth) + " levels");
    }
    value.is = std::forward<Container>(container);
    open_.push_back({&value});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  // Refuses the value that was placed last, or its name.
  [[noreturn]] void refuse(const std::string& value, const std::string& allowed) const {
    std::string path;
    for (const auto& [container, field] : open_) {
      if (field != nullptr) {
        append(path, field->first);
      } else {
        append(path, std::get<Array>(container->is).size() - 1);
      }
    }
    refuse_at(source_, path, whole_, value, allowed);
  }

  Value& root_;
  const std::string& source_;
  const std::string& whole_;
  const Limits limits_;
  std::vector<Open> open_;
  std::size_t count_ = 0;
};

// A value as it may stand in a message.
struct Shown {
  std::string operator()(const Object&) const { return "an object"; }
  std::string operator()(const Array& array) const {
    return "an array of " + std::to_string(array.size());
  }
  template <typename T>
  std::string operator()(const T& value) const {
    return excerpt(nlohmann::json(value).dump(-1, ' ', true));
  }
};

}  // namespace

Document::Document(std::string_view text, std::string source, const Limits& limits,
                   std::string whole)
    : source_(std::move(source)), whole_(std::move(whole)) {
  const auto refuse = [&](const std::string& value, const std::string& allowed) {
    refuse_at(source_, "", whole_, value, allowed);
  };
  if (text.size() > limits.bytes) {
    const std::string most = std::to_string(limits.bytes >> 20) + " MiB";
    refuse("more than " + most, "at most " + most);
  }
  // nlohmann skips the one and takes the other for the end.
  if (text.substr(0, 3) == "\xef\xbb\xbf") refuse("a byte order mark", "JSON text in UTF-8");
  if (text.find('\0') != text.npos) refuse("a byte of zero", "JSON text in UTF-8");
  Builder builder(root_, source_, whole_, limits);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
}

Node Document::root() const { return Node(*this); }

Node Node::operator[](std::string_view field) const {
  const auto found = object().find(field);
  if (found != object().end()) return Node(found->second, *this, field);
  Node(value_, *this, field).refuse("nothing", "the field, which is required");
}

Node Node::operator[](std::size_t element) const {
  return Node(array().at(element), *this, element);
}

void Node::require_known(const std::vector<std::string_view>& names) const {
  each_field([&](const std::string& name, const Node& field) {
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    std::string known;
    for (const std::string_view one : names) known.append(known.empty() ? "" : ", ").append(one);
    field.refuse("an unknown field", "one of " + known);
  });
}

const std::string& Node::text(const std::string& allowed) const { return as<std::string>(allowed); }

bool Node::truth(const std::string& allowed) const { return as<bool>(allowed); }

double Node::number(const std::string& allowed) const {
  if (const auto* whole = std::get_if<std::uint64_t>(&value_.is)) {
    return static_cast<double>(*whole);
  }
  if (const auto* negative = std::get_if<std::int64_t>(&value_.is)) {
    return static_cast<double>(*negative);
  }
  return as<double>(allowed);
}

std::uint64_t Node::whole_number(const std::string& allowed) const {
  return as<std::uint64_t>(allowed);
}

void Node::refuse(const std::string& allowed) const {
  refuse(std::visit(Shown{}, value_.is), allowed);
}

void Node::refuse(const std::string& value, const std::string& allowed) const {
  refuse_at(document_.source_, path(), document_.whole_, value, allowed);
}

template <typename T>
const T& Node::as(const std::string& allowed) const {
  const T* const value = std::get_if<T>(&value_.is);
  if (value == nullptr) refuse(allowed);
  return *value;
}

const Object& Node::object() const { return as<Object>("an object"); }
const Array& Node::array() const { return as<Array>("an array"); }

std::string Node::path() const {
  if (parent_ == nullptr) return "";
  std::string path = parent_->path();
  append(path, step_);
  return path;
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

bool is_utf8(const std::string& text) {
  try {
    quoted(text);
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

}  // namespace devlearn::json
