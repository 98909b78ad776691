#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/world.hpp"
#include "file.hpp"
#include "json.hpp"
#include "made_of.hpp"

namespace devlearn {
namespace {

constexpr const char* kFormat = "devlearn-world";
constexpr std::uint64_t kVersion = 1;
constexpr json::Limits kLimits{std::size_t{64} << 20, 16, 4'000'000};

// --- reading -----------------------------------------------------------------------------------

std::pair<double, double> two_numbers(const json::Node& node, const char* meaning) {
  if (node.size() != 2) node.refuse(std::string("two numbers, ") + meaning);
  return {node[0].number(), node[1].number()};
}

Point point(const json::Node& node) {
  const auto [x, y] = two_numbers(node, "[x, y]");
  return {x, y};
}

std::vector<Point> points(const json::Node& node) {
  std::vector<Point> all;
  node.each_element([&](const json::Node& one) { all.push_back(point(one)); });
  return all;
}

void require_format(const json::Node& world) {
  if (world["format"].text() != kFormat) world["format"].refuse(json::quoted(kFormat));
  const json::Node version = world["version"];
  const std::string allowed = std::to_string(kVersion);
  if (version.whole_number() > kVersion) {
    version.refuse(allowed + " or less; the file was written for a newer devlearn");
  }
  if (version.whole_number() != kVersion) version.refuse(allowed);
}

Obstacle read_obstacle(const json::Node& node) {
  const std::string& shape = node["shape"].text();
  if (shape == "circle") {
    node.require_known({"shape", "center", "radius"});
    return Circle{point(node["center"]), node["radius"].number()};
  }
  if (shape == "rectangle") {
    node.require_known({"shape", "center", "size", "angle"});
    const auto [width, height] = two_numbers(node["size"], "[width, height]");
    const double angle = node.has("angle") ? node["angle"].number() : 0.0;
    return Rectangle{point(node["center"]), width, height, angle};
  }
  if (shape == "polygon") {
    node.require_known({"shape", "corners", "holes"});
    Polygon polygon{points(node["corners"])};
    if (node.has("holes")) {
      node["holes"].each_element(
          [&](const json::Node& hole) { polygon.holes.push_back(points(hole)); });
    }
    return polygon;
  }
  if (shape == "polyline") {
    node.require_known({"shape", "points"});
    return Polyline{points(node["points"])};
  }
  node["shape"].refuse("\"circle\", \"rectangle\", \"polygon\" or \"polyline\"");
}

MoverPath read_path(const json::Node& node) {
  node.require_known({"points", "speed", "then"});
  MoverPath path;
  path.points = points(node["points"]);
  path.speed = node["speed"].number();
  const std::string& then = node["then"].text();
  const auto* const known =
      std::find(std::begin(MoverPath::kThens), std::end(MoverPath::kThens), then);
  if (known == std::end(MoverPath::kThens)) {
    node["then"].refuse("\"back\", \"around\" or \"stop\"");
  }
  path.then = static_cast<MoverPath::Then>(known - std::begin(MoverPath::kThens));
  return path;
}

MoverWalk read_walk(const json::Node& node) {
  node.require_known({"seed", "low", "high", "leg_time"});
  return {node["seed"].whole_number(), point(node["low"]), point(node["high"]),
          node["leg_time"].number()};
}

Mover read_mover(const json::Node& node) {
  Mover mover;
  const std::string& shape = node["shape"].text();
  if (shape == "circle") {
    node.require_known({"shape", "radius", "path", "walk"});
    mover.shape = Circle{{}, node["radius"].number()};
  } else if (shape == "rectangle") {
    node.require_known({"shape", "size", "angle", "path", "walk"});
    const auto [width, height] = two_numbers(node["size"], "[width, height]");
    mover.shape = Rectangle{{}, width, height, node.has("angle") ? node["angle"].number() : 0.0};
  } else {
    node["shape"].refuse("\"circle\" or \"rectangle\"");
  }
  if (node.has("path") && node.has("walk")) node["walk"].refuse("nothing, beside a path");
  if (node.has("walk")) {
    mover.course = read_walk(node["walk"]);
  } else {
    mover.course = read_path(node["path"]);
  }
  return mover;
}

WorldDef read_world(const json::Node& world) {
  require_format(world);  // before all else, as a newer one may have other fields
  world.require_known({"format", "version", "name", "description", "arena", "start", "target",
                       "obstacles", "movers"});
  WorldDef def;
  if (world.has("name")) def.name = world["name"].text();
  if (world.has("description")) def.description = world["description"].text();

  const json::Node arena = world["arena"];
  arena.require_known({"width", "height", "origin"});
  def.width = arena["width"].number();
  def.height = arena["height"].number();
  if (arena.has("origin")) def.origin = point(arena["origin"]);

  const json::Node start = world["start"];
  start.require_known({"x", "y", "heading"});
  def.start = {start["x"].number(), start["y"].number(), start["heading"].number()};

  const json::Node target = world["target"];
  target.require_known({"x", "y"});
  def.target = {target["x"].number(), target["y"].number()};

  world["obstacles"].each_element(
      [&](const json::Node& obstacle) { def.obstacles.push_back(read_obstacle(obstacle)); });
  if (world.has("movers")) {
    world["movers"].each_element(
        [&](const json::Node& mover) { def.movers.push_back(read_mover(mover)); });
  }
  return def;
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

// Items as a JSON list, each written by `write`.
template <typename T, typename Write>
std::string json_list(const std::vector<T>& items, const Write& write) {
  std::string text = "[";
  const char* separator = "";
  for (const T& item : items) {
    text += separator + write(item);
    separator = ", ";
  }
  return text + "]";
}
std::string json_points(const std::vector<Point>& points) { return json_list(points, json_point); }

std::string sides_of(const Rectangle& rectangle) {
  return R"("size": )" + json_pair(rectangle.width, rectangle.height) + R"(, "angle": )" +
         json_number(rectangle.angle);
}

struct ObstacleText {
  std::string operator()(const Circle& circle) const {
    return R"({"shape": "circle", "center": )" + json_point(circle.center) + R"(, "radius": )" +
           json_number(circle.radius) + "}";
  }
  std::string operator()(const Rectangle& rectangle) const {
    return R"({"shape": "rectangle", "center": )" + json_point(rectangle.center) + ", " +
           sides_of(rectangle) + "}";
  }
  std::string operator()(const Polygon& polygon) const {
    // Left out where there are none, as the origin is.
    const std::string holes =
        polygon.holes.empty() ? "" : R"(, "holes": )" + json_list(polygon.holes, json_points);
    return R"({"shape": "polygon", "corners": )" + json_points(polygon.corners) + holes + "}";
  }
  std::string operator()(const Polyline& polyline) const {
    return R"({"shape": "polyline", "points": )" + json_points(polyline.points) + "}";
  }
};

struct MoverText {
  std::string operator()(const Circle& circle) const {
    return R"({"shape": "circle", "radius": )" + json_number(circle.radius);
  }
  std::string operator()(const Rectangle& rectangle) const {
    return R"({"shape": "rectangle", )" + sides_of(rectangle);
  }
  std::string operator()(const MoverPath& path) const {
    return R"(, "path": {"points": )" + json_points(path.points) + R"(, "speed": )" +
           json_number(path.speed) + R"(, "then": )" +
           json::quoted(MoverPath::kThens[static_cast<std::size_t>(path.then)]) + "}}";
  }
  std::string operator()(const MoverWalk& walk) const {
    return R"(, "walk": {"seed": )" + std::to_string(walk.seed) + R"(, "low": )" +
           json_point(walk.low) + R"(, "high": )" + json_point(walk.high) + R"(, "leg_time": )" +
           json_number(walk.leg_time) + "}}";
  }
};

// A list of what has such texts, one a line.
template <typename Things, typename Text>
std::string json_lines(const Things& things, const Text& text_of) {
  std::string text = "[";
  const char* separator = "\n    ";
  for (const auto& thing : things) {
    text += separator + text_of(thing);
    separator = ",\n    ";
  }
  return text + (things.empty() ? "]" : "\n  ]");
}

}  // namespace

World World::parse(const std::string& text, const std::string& source) {
  const json::Document document(text, source, kLimits);
  return made_of(source, [&] { return World(read_world(document.root())); });
}

World World::load(const std::string& path) {
  return parse(text_of_file(path, kLimits.bytes), path);
}

std::string World::to_json() const {
  std::string text =
      "{\n  \"format\": " + json::quoted(kFormat) + ",\n  \"version\": " + std::to_string(kVersion);
  const auto add = [&text](const char* key, const std::string& value) {
    text.append(",\n  \"").append(key).append("\": ").append(value);
  };
  if (!def_->name.empty()) add("name", json::quoted(def_->name));
  if (!def_->description.empty()) add("description", json::quoted(def_->description));
  // Left out where it says nothing, so that worlds keep the hashes they had before there was one.
  const std::string origin = json_point(def_->origin);
  add("arena", R"({"width": )" + json_number(def_->width) + R"(, "height": )" +
                   json_number(def_->height) +
                   (origin == json_point({}) ? "" : R"(, "origin": )" + origin) + "}");
  add("start", R"({"x": )" + json_number(def_->start.x) + R"(, "y": )" +
                   json_number(def_->start.y) + R"(, "heading": )" +
                   json_number(def_->start.heading) + "}");
  add("target",
      R"({"x": )" + json_number(def_->target.x) + R"(, "y": )" + json_number(def_->target.y) + "}");
  add("obstacles", json_lines(def_->obstacles, [](const Obstacle& obstacle) {
        return std::visit(ObstacleText{}, obstacle);
      }));
  if (!def_->movers.empty()) {
    add("movers", json_lines(def_->movers, [](const Mover& mover) {
          return std::visit(MoverText{}, mover.shape) + std::visit(MoverText{}, mover.course);
        }));
  }
  return text + "\n}\n";
}

void World::save(const std::string& path) const {
  const std::string text = to_json();
  SideFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace devlearn
