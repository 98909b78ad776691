#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// The one reader of JSON, on nlohmann-json, which nothing but json.cpp sees. Every text is UTF-8
// all through, names each field of an object once, and ends where its value does.
namespace devlearn::json {

/// What a text may hold; beyond, it is refused while it is read.
struct Limits {
  std::size_t bytes;
  std::size_t depth;   ///< objects and arrays in each other
  std::size_t values;  ///< in all
};

struct Value;
using Array = std::vector<Value>;
using Object = std::map<std::string, Value, std::less<>>;
struct Value {
  std::variant<std::nullptr_t, bool, std::uint64_t, std::int64_t, double, std::string, Array,
               Object>
      is;
};

/// From a value into it: the name of a field, or an element's place.
using Step = std::variant<std::string_view, std::size_t>;

class Node;

/// A text that has been read.
class Document {
 public:
  /// Throws FileError naming `source` and the field, such as `obstacles[2].radius`; `whole` is what
  /// the text is called where it is no field.
  Document(std::string_view text, std::string source, const Limits& limits, std::string whole = "");
  Node root() const;

 private:
  friend Node;
  std::string source_, whole_;
  Value root_;
};

/// A value of a document that knows its way back to the root, for messages: it refers to the nodes
/// that led to it. Whatever asks for what is not there throws FileError.
class Node {
 public:
  bool has(std::string_view field) const { return object().count(field) > 0; }
  Node operator[](std::string_view field) const;
  Node operator[](std::size_t element) const;
  /// Of an array.
  std::size_t size() const { return array().size(); }

  /// Calls each(element).
  template <typename Each>
  void each_element(const Each& each) const {
    for (std::size_t i = 0; i < size(); ++i) each((*this)[i]);
  }
  /// Calls each(name, field), in the names' order.
  template <typename Each>
  void each_field(const Each& each) const {
    for (const auto& [name, value] : object()) each(name, Node(value, *this, name));
  }
  /// Refuses fields of other names.
  void require_known(const std::vector<std::string_view>& names) const;

  bool is_null() const { return std::holds_alternative<std::nullptr_t>(value_.is); }
  // `allowed` is what a refusal says.
  const std::string& text(const std::string& allowed = "a text") const;
  bool truth(const std::string& allowed = "true or false") const;
  double number(const std::string& allowed = "a number") const;
  /// In [0, 2^64 - 1].
  std::uint64_t whole_number(const std::string& allowed = "a whole number of 64 bits") const;

  /// Refuses the value.
  [[noreturn]] void refuse(const std::string& allowed) const;
  /// The same, where there is more to say than the value.
  [[noreturn]] void refuse(const std::string& value, const std::string& allowed) const;

 private:
  friend Document;
  explicit Node(const Document& document) : document_(document), value_(document.root_) {}
  Node(const Value& value, const Node& parent, Step step)
      : document_(parent.document_), value_(value), parent_(&parent), step_(step) {}

  template <typename T>
  const T& as(const std::string& allowed) const;
  const Object& object() const;
  const Array& array() const;
  std::string path() const;

  const Document& document_;
  const Value& value_;
  const Node* parent_ = nullptr;
  Step step_;
};

/// A text in UTF-8 as JSON, in quotes.
std::string quoted(const std::string& text);
bool is_utf8(const std::string& text);

}  // namespace devlearn::json
