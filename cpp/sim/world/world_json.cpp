#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/world.hpp"
#include "excerpt.hpp"
#include "file.hpp"
#include "world/world_text.hpp"

namespace devlearn {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "devlearn-world";
constexpr int kVersion = 1;
constexpr std::size_t kLongestFile = std::size_t{64} << 20;
constexpr std::size_t kDeepest = 16;
constexpr std::size_t kMostElements = 100'000;  // of an array
constexpr std::size_t kMostFields = 32;         // of an object

// --- reading -----------------------------------------------------------------------------------

std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  return excerpt(value.dump(-1, ' ', true));
}

// Follows the parser through the text and stops it where the text grows too deep or too large or
// says a thing twice: the tree of values does not show that any more, or is too late for it.
class ParseGuard {
 public:
  explicit ParseGuard(const std::string& source) : source_(source) {}

  bool operator()(int, json::parse_event_t event, json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        enter_value();
        if (open_.size() == kDeepest) {
          refuse("deeper nesting", "at most " + std::to_string(kDeepest) + " levels");
        }
        open_.emplace_back();
        open_.back().is_array = event == json::parse_event_t::array_start;
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        open_.pop_back();
        break;
      case json::parse_event_t::key:
        enter_key(parsed.get_ref<const std::string&>());
        break;
      case json::parse_event_t::value:
        enter_value();
        break;
    }
    return true;
  }

  // Path of the value that is being read.
  std::string path() const {
    std::string text;
    for (const Container& container : open_) {
      if (container.is_array) {
        text += "[" + std::to_string(container.count - 1) + "]";
      } else {
        text += (text.empty() ? "" : ".") + container.key;
      }
    }
    return text.empty() ? text : excerpt(text);
  }
  // The same where the value's first event has not come.
  std::string next_path() {
    if (!open_.empty() && open_.back().is_array) ++open_.back().count;
    return path();
  }

 private:
  struct Container {
    bool is_array = false;
    std::size_t count = 0;  // elements so far
    std::set<std::string> keys;
    std::string key;
  };

  void enter_value() {
    if (open_.empty() || !open_.back().is_array) return;
    if (++open_.back().count > kMostElements) {
      refuse("a longer array", "at most " + std::to_string(kMostElements) + " elements");
    }
  }

  void enter_key(const std::string& key) {
    Container& object = open_.back();
    object.key = key;
    if (!object.keys.insert(key).second) refuse("the field twice", "each field once");
    if (object.keys.size() > kMostFields) {
      refuse("another field", "at most " + std::to_string(kMostFields) + " fields");
    }
  }

  [[noreturn]] void refuse(const std::string& value, const std::string& allowed) const {
    throw FileError(source_, path(), value, allowed);
  }

  const std::string& source_;
  std::vector<Container> open_;
};

json parse_text(const std::string& text, const std::string& source) {
  if (text.size() > kLongestFile) {
    throw FileError(source, "", "more than 64 MiB", "at most 64 MiB");
  }
  ParseGuard guard(source);
  const json::parser_callback_t callback = [&](int depth, json::parse_event_t event, json& parsed) {
    return guard(depth, event, parsed);
  };
  try {
    return json::parse(text, callback);
  } catch (const json::out_of_range& e) {
    const std::string what = e.what();
    throw FileError(source, guard.next_path(), excerpt(what.substr(what.find("number"))),
                    "a number that a double can hold");
  } catch (const json::exception& e) {
    std::string what = e.what();
    const auto place = what.find("line ");
    if (place != std::string::npos) what.erase(0, place);
    throw FileError(source, "", excerpt(what), "JSON text in UTF-8");
  }
}

// A value in the file that knows its way back to the root, for messages.
class Node {
 public:
  Node(const json& value, const std::string& source) : value_(value), source_(source) {}

  void require_object(std::initializer_list<const char*> required,
                      std::initializer_list<const char*> optional = {}) const {
    if (!value_.is_object()) refuse("an object");
    for (const char* key : required) {
      if (!value_.contains(key)) {
        throw FileError(source_, path_of_field(key), "nothing", "the field, which is required");
      }
    }
    const auto among = [](const auto& keys, const std::string& key) {
      return std::find(keys.begin(), keys.end(), key) != keys.end();
    };
    for (const auto& [key, value] : value_.items()) {
      if (among(required, key) || among(optional, key)) continue;
      std::string known;
      for (const auto& keys : {required, optional}) {
        for (const char* name : keys) known.append(known.empty() ? "" : ", ").append(name);
      }
      throw FileError(source_, path_of_field(excerpt(key)), "an unknown field", "one of " + known);
    }
  }

  bool has(const char* key) const { return value_.contains(key); }
  Node operator[](const char* key) const { return Node(value_.at(key), this, key, 0); }
  Node operator[](std::size_t index) const { return Node(value_.at(index), this, nullptr, index); }

  std::size_t array_size() const {
    if (!value_.is_array()) refuse("an array");
    return value_.size();
  }

  std::string text() const {
    if (!value_.is_string()) refuse("a text");
    return value_.get<std::string>();
  }

  double number() const {
    if (!value_.is_number()) refuse("a number");
    return value_.get<double>();
  }

  std::pair<double, double> two_numbers(const char* meaning) const {
    if (!value_.is_array() || value_.size() != 2) refuse(std::string("two numbers, ") + meaning);
    return {(*this)[std::size_t{0}].number(), (*this)[1].number()};
  }

  Point point() const {
    const auto [x, y] = two_numbers("[x, y]");
    return {x, y};
  }

  const json& value() const { return value_; }

  [[noreturn]] void refuse(const std::string& allowed) const {
    throw FileError(source_, path(), shown(value_), allowed);
  }

 private:
  Node(const json& value, const Node* parent, const char* key, std::size_t index)
      : value_(value), source_(parent->source_), parent_(parent), key_(key), index_(index) {}

  std::string path() const {
    if (!parent_) return "";
    if (!key_) return parent_->path() + "[" + std::to_string(index_) + "]";
    return parent_->path_of_field(key_);
  }
  std::string path_of_field(const std::string& key) const {
    const std::string own = path();
    return own.empty() ? key : own + "." + key;
  }

  const json& value_;
  const std::string& source_;
  const Node* parent_ = nullptr;
  const char* key_ = nullptr;
  std::size_t index_ = 0;
};

void require_format(const Node& world) {
  if (!world.value().is_object()) world.refuse("an object");
  if (!world.has("format") || world["format"].value() != kFormat) {
    if (world.has("format")) world["format"].refuse(json(kFormat).dump());
    world.require_object({"format"});
  }
  if (!world.has("version")) return;  // missed below, with the others
  const Node version = world["version"];
  if (version.value() == kVersion && version.value().is_number_integer()) return;
  if (version.value().is_number_integer() && version.value() > kVersion) {
    version.refuse(std::to_string(kVersion) +
                   " or less; the file was written for a newer devlearn");
  }
  version.refuse(std::to_string(kVersion));
}

Obstacle read_obstacle(const Node& node) {
  if (!node.value().is_object() || !node.has("shape")) node.require_object({"shape"});
  const std::string shape = node["shape"].text();
  if (shape == "circle") {
    node.require_object({"shape", "center", "radius"});
    return Circle{node["center"].point(), node["radius"].number()};
  }
  if (shape == "rectangle") {
    node.require_object({"shape", "center", "size"}, {"angle"});
    const auto [width, height] = node["size"].two_numbers("[width, height]");
    const double angle = node.has("angle") ? node["angle"].number() : 0.0;
    return Rectangle{node["center"].point(), width, height, angle};
  }
  if (shape == "polygon") {
    node.require_object({"shape", "corners"});
    const Node corners = node["corners"];
    Polygon polygon;
    polygon.corners.reserve(corners.array_size());
    for (std::size_t i = 0; i < corners.array_size(); ++i) {
      polygon.corners.push_back(corners[i].point());
    }
    return polygon;
  }
  node["shape"].refuse("\"circle\", \"rectangle\" or \"polygon\"");
}

WorldDef read_world(const Node& node) {
  require_format(node);
  node.require_object({"format", "version", "arena", "start", "target", "obstacles"},
                      {"name", "description"});
  WorldDef def;
  if (node.has("name")) def.name = node["name"].text();
  if (node.has("description")) def.description = node["description"].text();

  const Node arena = node["arena"];
  arena.require_object({"width", "height"});
  def.width = arena["width"].number();
  def.height = arena["height"].number();

  const Node start = node["start"];
  start.require_object({"x", "y", "heading"});
  def.start = {start["x"].number(), start["y"].number(), start["heading"].number()};

  const Node target = node["target"];
  target.require_object({"x", "y"});
  def.target = {target["x"].number(), target["y"].number()};

  const Node obstacles = node["obstacles"];
  def.obstacles.reserve(obstacles.array_size());
  for (std::size_t i = 0; i < obstacles.array_size(); ++i) {
    def.obstacles.push_back(read_obstacle(obstacles[i]));
  }
  return def;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, "", std::strerror(errno), "a readable file");
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  // One byte more than is allowed is enough to know.
  while (
      text.size() <= kLongestFile &&
      (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) throw FileError(path, "", std::strerror(errno), "a readable file");
  return text;
}

// --- writing -----------------------------------------------------------------------------------

// A number as JSON that reads back to the bit: a bare -0 would come back as the whole number 0.
std::string json_number(double value) {
  return value == 0.0 && std::signbit(value) ? "-0.0" : to_text(value);
}

std::string json_pair(double x, double y) {
  return "[" + json_number(x) + ", " + json_number(y) + "]";
}
std::string json_point(Point p) { return json_pair(p.x, p.y); }

struct ObstacleText {
  std::string operator()(const Circle& circle) const {
    return R"({"shape": "circle", "center": )" + json_point(circle.center) + R"(, "radius": )" +
           json_number(circle.radius) + "}";
  }
  std::string operator()(const Rectangle& rectangle) const {
    return R"({"shape": "rectangle", "center": )" + json_point(rectangle.center) + R"(, "size": )" +
           json_pair(rectangle.width, rectangle.height) + R"(, "angle": )" +
           json_number(rectangle.angle) + "}";
  }
  std::string operator()(const Polygon& polygon) const {
    std::string text = R"({"shape": "polygon", "corners": [)";
    const char* separator = "";
    for (const Point& corner : polygon.corners) {
      text += separator + json_point(corner);
      separator = ", ";
    }
    return text + "]}";
  }
};

}  // namespace

bool is_utf8(const std::string& text) {
  try {
    json(text).dump();
    return true;
  } catch (const json::type_error&) {
    return false;
  }
}

World World::parse(const std::string& text, const std::string& source) {
  const json tree = parse_text(text, source);
  WorldDef def = read_world(Node(tree, source));
  try {
    return World(std::move(def));
  } catch (const InvalidValue& e) {
    throw FileError(source, e.quantity(), e.value(), e.allowed());
  }
}

World World::load(const std::string& path) { return parse(read_file(path), path); }

std::string World::to_json() const {
  std::string text =
      "{\n  \"format\": " + json(kFormat).dump() + ",\n  \"version\": " + std::to_string(kVersion);
  const auto add = [&text](const char* key, const std::string& value) {
    text.append(",\n  \"").append(key).append("\": ").append(value);
  };
  if (!def_->name.empty()) add("name", json(def_->name).dump());
  if (!def_->description.empty()) add("description", json(def_->description).dump());
  add("arena", R"({"width": )" + json_number(def_->width) + R"(, "height": )" +
                   json_number(def_->height) + "}");
  add("start", R"({"x": )" + json_number(def_->start.x) + R"(, "y": )" +
                   json_number(def_->start.y) + R"(, "heading": )" +
                   json_number(def_->start.heading) + "}");
  add("target",
      R"({"x": )" + json_number(def_->target.x) + R"(, "y": )" + json_number(def_->target.y) + "}");
  std::string obstacles = "[";
  const char* separator = "\n    ";
  for (const Obstacle& obstacle : def_->obstacles) {
    obstacles += separator + std::visit(ObstacleText{}, obstacle);
    separator = ",\n    ";
  }
  add("obstacles", obstacles + (def_->obstacles.empty() ? "]" : "\n  ]"));
  return text + "\n}\n";
}

void World::save(const std::string& path) const {
  const std::string text = to_json();
  SideFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace devlearn
