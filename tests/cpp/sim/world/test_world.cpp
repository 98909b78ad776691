#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/shortest_path.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/world.hpp"
#include "many.hpp"
#include "sim/body/plain.hpp"
#include "sim/world/random_worlds.hpp"
#include "world/surfaces.hpp"

using namespace devlearn;
namespace fs = std::filesystem;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();

// All the numbers of a world, in order.
std::vector<double> numbers(const WorldDef& def) {
  std::vector<double> all{def.width,   def.height,        def.origin.x, def.origin.y, def.start.x,
                          def.start.y, def.start.heading, def.target.x, def.target.y};
  for (const Obstacle& obstacle : def.obstacles) {
    all.push_back(static_cast<double>(obstacle.index()));
    const auto add = [&](const std::vector<Point>& points) {
      all.push_back(static_cast<double>(points.size()));
      for (const Point& p : points) all.insert(all.end(), {p.x, p.y});
    };
    if (const auto* circle = std::get_if<Circle>(&obstacle)) {
      all.insert(all.end(), {circle->center.x, circle->center.y, circle->radius});
    } else if (const auto* box = std::get_if<Rectangle>(&obstacle)) {
      all.insert(all.end(), {box->center.x, box->center.y, box->width, box->height, box->angle});
    } else if (const auto* polygon = std::get_if<Polygon>(&obstacle)) {
      add(polygon->corners);
      for (const auto& hole : polygon->holes) add(hole);
    } else {
      add(std::get<Polyline>(obstacle).points);
    }
  }
  return all;
}

bool same(const WorldDef& a, const WorldDef& b) {
  const std::vector<double> u = numbers(a), v = numbers(b);
  return a.name == b.name && a.description == b.description && u.size() == v.size() &&
         std::memcmp(u.data(), v.data(), u.size() * sizeof(double)) == 0;
}

const std::string kText = R"({
  "format": "devlearn-world", "version": 1, "name": "example",
  "arena": {"width": 5, "height": 4},
  "start": {"x": 0.5, "y": 0.5, "heading": 0},
  "target": {"x": 4.5, "y": 3.5},
  "obstacles": [
    {"shape": "circle", "center": [1.5, 1.5], "radius": 0.25},
    {"shape": "rectangle", "center": [2.5, 1], "size": [0.6, 0.4], "angle": 30},
    {"shape": "polygon", "corners": [[3, 1], [4, 1.25], [3.5, 2]]}
  ]
})";

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const auto place = text.find(part);
  REQUIRE(place != std::string::npos);
  return text.replace(place, part.size(), by);
}

// Checks that parsing throws FileError that names the file and this field; gives its text.
std::string refusal(const std::string& text, const std::string& field) {
  CAPTURE(text.substr(0, 1000));
  CAPTURE(field);
  try {
    World::parse(text, "some/file.json");
    FAIL_CHECK("accepted");
  } catch (const FileError& e) {
    CHECK(e.file() == "some/file.json");
    CHECK(e.field() == field);
    CHECK_FALSE(e.value().empty());
    CHECK_FALSE(e.allowed().empty());
    CHECK(std::string(e.what()).find("some/file.json") == 0);
    return e.what();
  }
  return "";
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

fs::path fresh_folder(const char* name) {
  const fs::path folder = fs::path(DEVLEARN_BINARY_DIR) / "files" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void refused(const WorldDef& def, const std::string& quantity) {
  CAPTURE(quantity);
  try {
    World world(def);
    FAIL_CHECK("accepted");
  } catch (const FileError&) {
    FAIL_CHECK("not about a file");
  } catch (const InvalidValue& e) {
    CHECK(e.quantity() == quantity);
  }
}

WorldDef with(Obstacle obstacle) {
  WorldDef def;
  def.obstacles = {Circle{{2.5, 2.5}, 0.1}, std::move(obstacle)};
  return def;
}

const std::vector<Point> kSquare{{3, 3}, {4, 3}, {4, 4}, {3, 4}};

WorldDef with_polygon(std::vector<Point> corners) { return with(Polygon{std::move(corners)}); }

// --- an independent clearance ------------------------------------------------------------------

double segment_distance(Point p, Point a, Point b) {
  // In the frame of the segment.
  const long double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const long double u = ((p.x - a.x) * dx + (p.y - a.y) * dy) / length;
  const long double v = (-(p.x - a.x) * dy + (p.y - a.y) * dx) / length;
  return static_cast<double>(std::hypot(u - std::clamp(u, 0.0L, length), v));
}

double distance_to(Point p, const std::vector<Point>& points, bool closed) {
  double least = kInfinite;
  for (std::size_t i = closed ? 0 : 1; i < points.size(); ++i) {
    const Point before = points[(i + points.size() - 1) % points.size()];
    least = std::min(least, segment_distance(p, before, points[i]));
  }
  return least;
}

bool winds_around(const std::vector<Point>& corners, Point p) {
  double turned = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i], b = corners[(i + 1) % corners.size()];
    turned += std::remainder(std::atan2(b.y - p.y, b.x - p.x) - std::atan2(a.y - p.y, a.x - p.x),
                             2.0 * 3.14159265358979323846);
  }
  return std::abs(turned) > 3.0;
}

double distance_by_winding(Point p, const Polygon& polygon) {
  double least = distance_to(p, polygon.corners, true);
  bool inside = winds_around(polygon.corners, p);
  for (const std::vector<Point>& hole : polygon.holes) {
    least = std::min(least, distance_to(p, hole, true));
    inside = inside && !winds_around(hole, p);
  }
  return inside ? 0.0 : least;
}

double plain_clearance(const WorldDef& def, Point p) {
  double least = kInfinite;
  for (const Obstacle& obstacle : def.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&obstacle)) {
      least =
          std::min(least, std::max(0.0, std::hypot(p.x - circle->center.x, p.y - circle->center.y) -
                                            circle->radius));
    } else if (const auto* box = std::get_if<Rectangle>(&obstacle)) {
      // In the frame of the rectangle.
      const double angle = box->angle * 3.14159265358979323846 / 180.0;
      const double dx = p.x - box->center.x, dy = p.y - box->center.y;
      const double u = std::abs(dx * std::cos(angle) + dy * std::sin(angle)) - 0.5 * box->width;
      const double v = std::abs(dy * std::cos(angle) - dx * std::sin(angle)) - 0.5 * box->height;
      least = std::min(least, std::hypot(std::max(u, 0.0), std::max(v, 0.0)));
    } else if (const auto* polygon = std::get_if<Polygon>(&obstacle)) {
      least = std::min(least, distance_by_winding(p, *polygon));
    } else {
      least = std::min(least, distance_to(p, std::get<Polyline>(obstacle).points, false));
    }
  }
  return least;
}

double plain_wall_distance(const WorldDef& def, Point p) {
  return std::max(0.0, std::min(std::min(p.x, def.width - p.x), std::min(p.y, def.height - p.y)));
}

// --- an independent test for simple polygons, on whole numbers ---------------------------------

struct GridPoint {
  long x = 0, y = 0;
};

long area(GridPoint a, GridPoint b, GridPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool on(GridPoint p, GridPoint a, GridPoint b) {
  return area(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

bool cross_within(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto sign = [](long v) { return (v > 0) - (v < 0); };
  return sign(area(a, b, c)) * sign(area(a, b, d)) < 0 &&
         sign(area(c, d, a)) * sign(area(c, d, b)) < 0;
}

bool simple_on_grid(const std::vector<GridPoint>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const GridPoint a = corners[i], b = corners[(i + 1) % n];
    if (a.x == b.x && a.y == b.y) return false;
    for (std::size_t j = 0; j < n; ++j) {
      const GridPoint c = corners[j], d = corners[(j + 1) % n];
      // No corner lies on an edge but that edge's own two ends.
      if (j != i && j != (i + 1) % n && on(c, a, b)) return false;
      if (cross_within(a, b, c, d)) return false;
    }
  }
  return true;
}

bool meet_on_grid(const std::vector<GridPoint>& one, const std::vector<GridPoint>& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < other.size(); ++j) {
      const GridPoint a = one[i], b = one[(i + 1) % one.size()];
      const GridPoint c = other[j], d = other[(j + 1) % other.size()];
      if (on(a, c, d) || on(c, a, b) || cross_within(a, b, c, d)) return true;
    }
  }
  return false;
}

// A point that is on no edge.
bool inside_on_grid(GridPoint p, const std::vector<GridPoint>& corners) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const GridPoint a = corners[i], b = corners[(i + 1) % corners.size()];
    if ((a.y > p.y) != (b.y > p.y) && (area(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

// The first of them is the outline.
bool polygon_on_grid(const std::vector<std::vector<GridPoint>>& rings) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (!simple_on_grid(rings[i])) return false;
    if (i > 0 && !inside_on_grid(rings[i][0], rings[0])) return false;
    for (std::size_t j = 0; j < rings.size(); ++j) {
      if (j != i && meet_on_grid(rings[i], rings[j])) return false;
      if (j != i && j > 0 && inside_on_grid(rings[i][0], rings[j])) return false;
    }
  }
  return true;
}

}  // namespace

// --- files -------------------------------------------------------------------------------------

TEST_CASE("A world written as JSON reads back equal to the bit") {
  Random random(1, "round trip");
  for (int n = 0; n < 200; ++n) {
    const World world = random_world(random, 8, between(random, 2.0, 50.0));
    const World back = World::parse(world.to_json());
    CHECK(same(back.def(), world.def()));
    CHECK(back.to_json() == world.to_json());
  }
  WorldDef def;
  def.name = "quotes \" and \\, lines\n, \x01 and \xe4\xb8\x96\xe7\x95\x8c";
  def.description = std::string("nul \0 too", 9);
  def.width = std::nextafter(5.0, 6.0);
  def.start = {5e-324, 0.1 + 0.2, -0.0};
  def.target = {1.0 / 3.0, 2.2250738585072014e-308};
  def.obstacles = {Rectangle{{-0.0, 3.0}, 0.01, 1.0 / 7.0, -1e-300}};
  const World world(def);
  CHECK(same(world.def(), def));
  CHECK(same(World::parse(world.to_json()).def(), def));
  def.start.heading = -std::numeric_limits<double>::max();
  CHECK(same(World::parse(World(def).to_json()).def(), def));
  for (const Point origin : {Point{-0.1, -1.0 / 3.0}, {0.0, -0.0}, {-0.0, 0.0}, {0.0, -5e-324}}) {
    def.origin = origin;
    CHECK(same(World::parse(World(def).to_json()).def(), def));
  }
}

TEST_CASE("An origin of (0, 0) is not written, so that a world keeps its text and its hash") {
  const std::string text = World().to_json();
  CHECK(text.find("origin") == std::string::npos);
  CHECK(
      World(shifted({}, {256.0, -128.0})).to_json() ==
      replaced(replaced(replaced(text, "\"height\": 5}", "\"height\": 5, \"origin\": [256, -128]}"),
                        R"("x": 0.5, "y": 0.5)", R"("x": 256.5, "y": -127.5)"),
               R"("x": 4.5, "y": 4.5)", R"("x": 260.5, "y": -123.5)"));
  const std::string written = replaced(kText, R"("height": 4)", R"("height": 4, "origin": [0, 0])");
  CHECK(World::parse(written).to_json() == World::parse(kText).to_json());
}

TEST_CASE("Holes are written where there are any, so that polygons keep their text and hash") {
  const std::string text = World::parse(kText).to_json(), corners = "[[3, 1], [4, 1.25], [3.5, 2]]";
  CHECK(text.find("holes") == std::string::npos);
  CHECK(World::parse(replaced(kText, corners, corners + R"(, "holes": [])")).to_json() == text);
  const std::string holes = R"(, "holes": [[[3.4, 1.25], [3.6, 1.25], [3.5, 1.5]]])";
  CHECK(World::parse(replaced(kText, corners, corners + holes)).to_json() ==
        replaced(text, corners, corners + holes));
}

TEST_CASE("What may be left out of a file may be left out") {
  CHECK(World::parse(kText).def().description.empty());
  const World world = World::parse(replaced(kText, R"(, "angle": 30)", ""));
  CHECK(std::get<Rectangle>(world.def().obstacles[1]).angle == 0.0);
}

TEST_CASE("Every world that ships loads, round-trips and has room for the default robot") {
  int count = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(DEVLEARN_SOURCE_DIR) / "python/devlearn/worlds")) {
    if (entry.path().extension() != ".json") continue;
    CAPTURE(entry.path().string());
    const World world = World::load(entry.path().string());
    CHECK(world.def().name == entry.path().stem().string());
    CHECK_FALSE(world.def().description.empty());
    CHECK(same(World::parse(world.to_json()).def(), world.def()));
    CHECK_NOTHROW(Robot(world, {}).require_place(world.def().start));
    CHECK(world.clearance(world.def().target, true) > 0.12);
    ++count;
  }
  CHECK(count >= 6);
}

TEST_CASE("A saved world loads again") {
  const fs::path folder = fresh_folder("saved");
  const World world = World::parse(kText);
  const std::string path = (folder / "world.json").string();
  world.save(path);
  CHECK(same(World::load(path).def(), world.def()));
  World().save(path);
  CHECK(contents(path) == World().to_json());
  CHECK(entries(folder) == 1);
}

TEST_CASE("A save that fails loses nothing and leaves nothing behind") {
  const fs::path folder = fresh_folder("failed");
  const std::string path = (folder / "world.json").string();
  World().save(path);
  const auto fails = [](const std::string& place) {
    try {
      World::parse(kText).save(place);
      FAIL_CHECK("saved");
    } catch (const FileError& e) {
      CHECK(e.file() == place);
      CHECK(e.field().empty());
    }
  };
  fails((folder / "missing" / "world.json").string());
  fs::create_directory(folder / "taken");
  fails((folder / "taken").string());
  CHECK(entries(folder / "taken") == 0);

  // A disk that fills up halfway.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit tight = before;
  tight.rlim_cur = 64;
  REQUIRE(setrlimit(RLIMIT_FSIZE, &tight) == 0);
  std::string message;
  try {
    World::parse(kText).save(path);
  } catch (const FileError& e) {
    message = e.what();
  }
  REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  CHECK(message.find("File too large") != std::string::npos);
  CHECK(contents(path) == World().to_json());
  CHECK(entries(folder) == 2);
}

TEST_CASE("A file that cannot be read is refused by its name") {
  const fs::path folder = fresh_folder("unreadable");
  for (const std::string& path : {(folder / "missing.json").string(), folder.string()}) {
    try {
      World::load(path);
      FAIL_CHECK("loaded");
    } catch (const FileError& e) {
      CHECK(e.file() == path);
      CHECK(e.field().empty());
    }
  }
  // Sparse, so it costs no room.
  const std::string path = (folder / "huge.json").string();
  std::ofstream(path).close();
  fs::resize_file(path, (std::uintmax_t{64} << 20) + 1);
  try {
    World::load(path);
    FAIL_CHECK("loaded");
  } catch (const FileError& e) {
    CHECK(e.value() == "more than 64 MiB");
  }
  fs::remove(path);
}

TEST_CASE("A file that breaks the format is refused by the path of its field") {
  const auto edited = [](const std::string& part, const std::string& by, const std::string& field) {
    return refusal(replaced(kText, part, by), field);
  };
  // Unknown, missing and doubled fields.
  edited(R"("name")", R"("title")", "title");
  edited(R"("width")", R"("depth": 1, "width")", "arena.depth");
  edited(R"("radius": 0.25)", R"("radius": 0.25, "angle": 0)", "obstacles[0].angle");
  edited(R"("heading")", R"("theta")", "start.theta");
  edited(R"(, "heading": 0)", "", "start.heading");
  edited(R"(, "radius": 0.25)", "", "obstacles[0].radius");
  edited(R"("target": {"x": 4.5, "y": 3.5},)", "", "target");
  edited(R"("format": "devlearn-world",)", "", "format");
  edited(R"("version": 1,)", "", "version");
  edited(R"("shape": "polygon", )", "", "obstacles[2].shape");
  edited(R"("radius": 0.25)", R"("radius": 0.25, "radius": 0.25)", "obstacles[0].radius");
  edited(R"("name": "example")", R"("name": "a", "name": "b")", "name");
  // Wrong types.
  refusal("[]", "");
  refusal("3", "");
  refusal("null", "");
  edited(R"("example")", "7", "name");
  edited(R"({"width": 5, "height": 4})", "5", "arena");
  edited(R"("width": 5)", R"("width": "5")", "arena.width");
  edited(R"("width": 5)", R"("width": null)", "arena.width");
  edited(R"("width": 5)", R"("width": true)", "arena.width");
  const std::string height = R"("height": 4)";
  edited(height, height + R"(, "origin": 5)", "arena.origin");
  edited(height, height + R"(, "origin": [0])", "arena.origin");
  edited(height, height + R"(, "origin": [0, "0"])", "arena.origin[1]");
  edited(height, height + R"(, "origin": [1e6, 0])", "arena.origin[0]");
  edited("[1.5, 1.5]", "1.5", "obstacles[0].center");
  edited("[1.5, 1.5]", "[1.5]", "obstacles[0].center");
  edited("[1.5, 1.5]", "[1.5, 1.5, 1.5]", "obstacles[0].center");
  edited("[1.5, 1.5]", "[1.5, {}]", "obstacles[0].center[1]");
  edited("[4, 1.25]", R"([4, "1.25"])", "obstacles[2].corners[1][1]");
  edited("[4, 1.25]", "4", "obstacles[2].corners[1]");
  edited("[[3, 1], [4, 1.25], [3.5, 2]]", "{}", "obstacles[2].corners");
  const auto with_holes = [&](const std::string& holes, const std::string& field) {
    edited("[3.5, 2]]", "[3.5, 2]], \"holes\": " + holes, field);
  };
  with_holes("7", "obstacles[2].holes");
  with_holes("[7]", "obstacles[2].holes[0]");
  with_holes("[[[3.4, 1.25], [3.6, 1.25], 7]]", "obstacles[2].holes[0][2]");
  with_holes("[[[3.4, 1.25], [3.6, 1.25], [3.5, \"\"]]]", "obstacles[2].holes[0][2][1]");
  with_holes("[[[3.4, 1.25], [3.6, 1.25], [3.5, 15]]]", "obstacles[2].holes[0][2][1]");
  edited(R"("polygon", "corners")", R"("polyline", "corners")", "obstacles[2].corners");
  edited(R"("polygon", "corners")", R"("polyline", "points": 1, "corners")",
         "obstacles[2].corners");
  edited(R"("polygon")", R"("polygon", "points": [])", "obstacles[2].points");
  edited(R"("circle")", R"("blob")", "obstacles[0].shape");
  edited(R"("circle")", "1", "obstacles[0].shape");
  edited(R"({"shape": "circle", "center": [1.5, 1.5], "radius": 0.25})", "7", "obstacles[0]");
  // Format and version.
  edited("devlearn-world", "other", "format");
  edited(R"("version": 1)", R"("version": "1")", "version");
  edited(R"("version": 1)", R"("version": 1.5)", "version");
  edited(R"("version": 1)", R"("version": 0)", "version");
  CHECK(edited(R"("version": 1)", R"("version": 2)", "version").find("newer devlearn") !=
        std::string::npos);
  // A file of a newer version may have other fields: that is not what is said of it.
  CHECK(edited(R"("version": 1)", R"("version": 2, "new": 1)", "version").find("newer devlearn") !=
        std::string::npos);
  // Values, by the same names as in code.
  edited(R"("radius": 0.25)", R"("radius": -1)", "obstacles[0].radius");
  edited(R"("size": [0.6, 0.4])", R"("size": [0.6, 0])", "obstacles[1].size[1]");
  edited("[4, 1.25]", "[4, 12.25]", "obstacles[2].corners[1][1]");
  edited(R"("x": 0.5)", R"("x": 1.5e300)", "start.x");
}

TEST_CASE("Text that is not JSON is refused with line and column") {
  const auto says = [](const std::string& message, const std::string& part) {
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
  };
  says(refusal("", ""), "line 1, column 1");
  says(refusal(kText + "x", ""), "line 11");
  says(refusal(kText + kText, ""), "line 11");
  says(refusal(kText.substr(0, kText.size() / 2), ""), "line ");
  says(refusal(replaced(kText, R"("width": 5)", R"("width": NaN)"), ""), "line 3, column");
  says(refusal(replaced(kText, R"("width": 5)", R"("width": 0x5)"), ""), "line 3, column");
  says(refusal(replaced(kText, "example", "ex\xff\xfe"), ""), "line 2, column");
  says(refusal(replaced(kText, "example", "\\ud800"), ""), "line 2, column");
  says(refusal("{\"name\": \"" + std::string(100000, 'a'), ""), "...");
  says(refusal(replaced(kText, R"("width": 5)", R"("width": 1e999)"), "arena.width"), "1e999");
  says(refusal(replaced(kText, "[4, 1.25]", "[4, -1e999]"), "obstacles[2].corners[1][1]"),
       "-1e999");
  says(refusal("1e999", ""), "1e999");
  says(refusal("\xef\xbb\xbf" + kText, ""), "byte order mark");
  says(refusal(kText + '\0', ""), "byte of zero");
  for (const char c : refusal(replaced(kText, "example", "ex\xff\xfe"), "")) {
    REQUIRE((c >= ' ' && c <= '~'));
  }
}

TEST_CASE("Depth and sizes are bounded while reading") {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  std::string field;
  for (int i = 0; i < 16; ++i) field += "[0]";
  CHECK(refusal(nested(17), field).find("16 levels") != std::string::npos);
  CHECK(refusal(nested(1000000), field).find("16 levels") != std::string::npos);
  CHECK(refusal(std::string(60000000, '['), field).find("16 levels") != std::string::npos);
  CHECK(refusal(nested(16), "").find("an object") != std::string::npos);
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  refusal(objects, "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a");

  std::string many = "[0";
  for (int i = 1; i < 4000000; ++i) many += ",0";
  CHECK(refusal(many + "]", "[3999999]").find("at most 4000000 values") != std::string::npos);
  CHECK(refusal(std::string((std::size_t{64} << 20) + 1, ' '), "").find("64 MiB") !=
        std::string::npos);
}

TEST_CASE("A refusal leaves the world it was asked of as it was") {
  World world = World::parse(kText);
  const WorldDef before = world.def();
  CHECK_THROWS_AS(world = World::parse(replaced(kText, "0.25", "-1")), FileError);
  CHECK_THROWS_AS(world = world.with_start({1.5, 1.5, 0.0}), InvalidValue);
  CHECK_THROWS_AS(world = world.with_start({0.5, 0.5, kNan}), InvalidValue);
  CHECK_THROWS_AS(world = world.with_start({5.1, 0.5, 0.0}), InvalidValue);
  CHECK(same(world.def(), before));
  const World moved = world.with_start({0.7, 0.6, 90.0});
  CHECK(moved.def().start == Pose{0.7, 0.6, 90.0});
  CHECK(same(world.def(), before));
}

TEST_CASE("Mutated files are refused by name or stand up to sonar and steps") {
  Random random(2, "mutations");
  const std::string alphabet = "0123456789.-+eE[]{}\",: \n\t\\/ntfaul\x80\xff";
  const std::vector<std::string> words = {"1e999", "-0", "1e-320", "0.01", "100000", "null",
                                          "[]",    "{}", "[[",     "]]",   "1e5",    "-3"};
  const auto index = [&](std::size_t count) {
    return static_cast<std::size_t>(random.index(static_cast<std::uint32_t>(count)));
  };
  int refused_count = 0, worlds = 0, stood = 0;
  for (int n = 0; n < 6000; ++n) {
    std::string text = kText;
    for (auto edits = 1 + random.index(3); edits > 0; --edits) {
      const std::size_t place = index(text.size());
      switch (random.index(10)) {
        case 0:
          text[place] = alphabet[index(alphabet.size())];
          break;
        case 1:
          text.erase(place, 1 + random.index(4));
          break;
        case 2:
          text.insert(place, words[index(words.size())]);
          break;
        case 3:  // a piece of the text somewhere else
          text.insert(place, text.substr(index(text.size()), 1 + random.index(40)));
          break;
        default: {  // another number
          const auto digit = text.find_first_of("0123456789", place);
          if (digit == std::string::npos) break;
          const auto end = text.find_first_not_of("0123456789.", digit);
          text.replace(digit, end - digit, to_text(between(random, -1.0, 6.0)));
        }
      }
    }
    try {
      const World world = World::parse(text, "mutated.json");
      ++worlds;
      const Robot robot(world, {});
      Pose pose = world.def().start;
      for (int i = 0; i < 10; ++i) {
        robot.sonar(pose);
        pose = robot.step(pose, static_cast<int>(random.index(5))).pose;
      }
      ++stood;
    } catch (const FileError& e) {
      REQUIRE(e.file() == "mutated.json");
      ++refused_count;
    } catch (const InvalidValue&) {  // no room for the robot
    }
  }
  MESSAGE(refused_count << " mutated files refused, " << worlds << " worlds, " << stood
                        << " with room for the robot");
  CHECK(refused_count > 1000);
  CHECK(stood > 500);
}

// --- definitions -------------------------------------------------------------------------------

TEST_CASE("A definition out of range is refused by the name of its field") {
  for (const double bad : {0.49, 1000.1, -1.0, 0.0, kNan, kInfinite}) {
    WorldDef wide, high;
    wide.width = bad;
    high.height = bad;
    refused(wide, "arena.width");
    refused(high, "arena.height");
  }
  for (const double bad : {-0.01, 5.01, kNan, kInfinite, -kInfinite}) {
    WorldDef def;
    def.start.x = bad;
    refused(def, "start.x");
    def = {};
    def.start.y = bad;
    refused(def, "start.y");
    def = {};
    def.target.x = bad;
    refused(def, "target.x");
    def = {};
    def.target.y = bad;
    refused(def, "target.y");
  }
  for (const double bad : {-100000.1, 100000.1, kNan, kInfinite}) {
    refused(shifted({}, {bad, 0.0}), "arena.origin[0]");
    refused(shifted({}, {0.0, bad}), "arena.origin[1]");
  }
  for (const double bad : {kNan, kInfinite}) {
    WorldDef def;
    def.start.heading = bad;
    refused(def, "start.heading");
  }
  for (const double bad : {0.0099, 1000.1, -1.0, 0.0, kNan, kInfinite}) {
    refused(with(Circle{{3, 3}, bad}), "obstacles[1].radius");
    refused(with(Rectangle{{3, 3}, bad, 1, 0}), "obstacles[1].size[0]");
    refused(with(Rectangle{{3, 3}, 1, bad, 0}), "obstacles[1].size[1]");
  }
  for (const double bad : {-360.1, 361.0, kNan, kInfinite}) {
    refused(with(Rectangle{{3, 3}, 1, 1, bad}), "obstacles[1].angle");
  }
  for (const double bad : {-5.1, 10.1, kNan, kInfinite, 1e300}) {
    refused(with(Circle{{bad, 3}, 0.1}), "obstacles[1].center[0]");
    refused(with(Rectangle{{3, bad}, 1, 1, 0}), "obstacles[1].center[1]");
    refused(with_polygon({{3, 3}, {4, 3}, {4, bad}}), "obstacles[1].corners[2][1]");
    refused(with(Polygon{kSquare, {{{3.1, 3.1}, {3.9, 3.1}, {3.5, bad}}}}),
            "obstacles[1].holes[0][2][1]");
    refused(with(Polyline{{{3, 3}, {bad, 3}}}), "obstacles[1].points[1][0]");
  }
  WorldDef def;
  def.name = "\xff";
  refused(def, "name");
  def.name = std::string(10001, 'a');
  refused(def, "name");
  def = {};
  def.description = "\xc3";
  refused(def, "description");
  def = {};
  def.obstacles.assign(100001, Circle{{3, 3}, 0.1});
  refused(def, "obstacles");
}

TEST_CASE("A start or target in an obstacle is refused, on its edge too") {
  for (const Obstacle& obstacle :
       {Obstacle(Circle{{2, 2}, 0.5}), Obstacle(Rectangle{{2, 2}, 1.0, 1.0, 0.0}),
        Obstacle(Polygon{{{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}}})}) {
    for (const Point p : {Point{2, 2}, {2.1, 1.9}, {1.5, 2}, {2.5, 2}}) {
      WorldDef def;
      def.obstacles = {obstacle};
      def.start = {p.x, p.y, 0.0};
      refused(def, "start");
      def.start = {0.5, 0.5, 0.0};
      def.target = p;
      refused(def, "target");
    }
  }
}

TEST_CASE("In a hole it is free to start, on a thin wall it is not") {
  WorldDef def;
  def.obstacles = {
      Polygon{{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, {{{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}}}},
      Polyline{{{3.5, 1}, {3.5, 3}, {4.5, 4}}}};
  def.target = {2.4, 2.0};
  CHECK(World(def).clearance(def.target) == doctest::Approx(0.1));
  for (const Point p :
       {Point{1.5, 2.0}, {2.0, 2.5}, {2.75, 2.0}, {3.5, 2.0}, {3.5, 1.0}, {4, 3.5}}) {
    def.start = {p.x, p.y, 0.0};
    refused(def, "start");
  }
  def.start = {3.5 + 1e-9, 2.0, 0.0};
  CHECK_NOTHROW(World{def});
}

TEST_CASE("Holes that are not inside the outline and apart from each other are refused") {
  const std::vector<Point> inner{{3.2, 3.2}, {3.5, 3.2}, {3.5, 3.5}, {3.2, 3.5}};
  const auto holes = [](std::vector<std::vector<Point>> all) {
    return with(Polygon{kSquare, std::move(all)});
  };
  const std::string first = "obstacles[1].holes[0]", second = "obstacles[1].holes[1]";
  CHECK_NOTHROW(World(holes({inner})));
  CHECK_NOTHROW(World(holes({inner, {{3.6, 3.2}, {3.9, 3.2}, {3.9, 3.9}}})));
  refused(holes({{}}), first);
  refused(holes({inner, {{3.6, 3.2}, {3.9, 3.2}}}), second);
  refused(holes({{{3.2, 3.2}, {3.5, 3.2}, {3.5, 3.205}}}), first + "[2]");
  refused(holes({{{3.2, 3.2}, {3.5, 3.5}, {3.5, 3.2}, {3.2, 3.5}}}), first);  // crosses itself
  refused(holes({{{3.2, 3.2}, {3.22, 3.2}, {3.21, 3.2099}}}), first);         // next to no area
  refused(holes({kSquare}), first);
  refused(holes({{{3.5, 3.0}, {3.6, 3.5}, {3.4, 3.5}}}), first);              // touches the outline
  refused(holes({{{3.5, 3.5}, {4.5, 3.5}, {3.5, 3.7}}}), first);              // crosses it
  refused(holes({{{4.2, 3.2}, {4.5, 3.2}, {4.5, 3.5}}}), first);              // outside
  refused(holes({{{2.5, 2.5}, {4.5, 2.5}, {4.5, 4.5}, {2.5, 4.5}}}), first);  // around it
  refused(holes({inner, {{3.3, 3.3}, {3.4, 3.3}, {3.4, 3.4}}}), second);      // within a hole
  refused(holes({{{3.3, 3.3}, {3.4, 3.3}, {3.4, 3.4}}, inner}), first);       // likewise
  refused(holes({inner, {{3.4, 3.4}, {3.8, 3.4}, {3.8, 3.8}}}), second);      // cross each other
  refused(holes({inner, {{3.5, 3.5}, {3.8, 3.5}, {3.8, 3.8}}}), second);      // touch each other
  refused(holes({inner, inner}), second);
}

TEST_CASE("Thin walls have two points or more, no two neighbours on top of each other") {
  const std::string points = "obstacles[1].points";
  refused(with(Polyline{}), points);
  refused(with(Polyline{{{3, 3}}}), points);
  refused(with(Polyline{{{3, 3}, {3, 3}}}), points + "[1]");
  refused(with(Polyline{{{3, 3}, {4, 3}, {4.009, 3}}}), points + "[2]");
  refused(with(Polyline{std::vector<Point>(100'001)}), points);
  CHECK_NOTHROW(World(with(Polyline{{{3, 3}, {3.01, 3}}})));
  CHECK_NOTHROW(World(with(Polyline{{{3, 3}, {4, 3}, {3, 3}}})));                  // there and back
  CHECK_NOTHROW(World(with(Polyline{{{3, 3}, {4, 4}, {4, 3}, {3, 4}, {3, 3}}})));  // crosses itself
}

TEST_CASE("The sweep agrees with whole-number arithmetic on which holes are right") {
  Random random(8, "grid holes");
  const auto scaled = [](const std::vector<GridPoint>& grid) {
    std::vector<Point> corners;
    for (const GridPoint& p : grid) {
      corners.push_back(
          {2.0 + 0.25 * static_cast<double>(p.x), 2.0 + 0.25 * static_cast<double>(p.y)});
    }
    return corners;
  };
  const std::vector<GridPoint> bent{{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 4}, {4, 4}, {4, 9}, {0, 9}};
  int right = 0, others = 0, wrong = 0;
  for (int n = 0; n < 40000; ++n) {
    std::vector<std::vector<GridPoint>> rings{bent};
    for (auto count = 1 + random.index(3); count > 0; --count) {
      const long x = random.index(8), y = random.index(8);
      const auto span = 2 + random.index(3);
      std::vector<GridPoint>& ring = rings.emplace_back(3 + random.index(2));
      for (GridPoint& p : ring) p = {x + random.index(span), y + random.index(span)};
    }
    for (auto& ring : rings) {
      if (random.index(2) == 1) std::reverse(ring.begin(), ring.end());
    }
    WorldDef def;
    def.target = {0.5, 0.7};
    Polygon polygon{scaled(rings[0])};
    for (std::size_t i = 1; i < rings.size(); ++i) polygon.holes.push_back(scaled(rings[i]));
    def.obstacles = {polygon};
    bool accepted = true;
    try {
      World world(def);
    } catch (const InvalidValue&) {
      accepted = false;
    }
    for (auto& ring : rings) {  // closed ones
      if (ring.size() > 3 && ring.front().x == ring.back().x && ring.front().y == ring.back().y) {
        ring.pop_back();
      }
    }
    const bool expected = polygon_on_grid(rings);
    (expected ? right : others) += 1;
    wrong += accepted != expected;
  }
  MESSAGE(right << " polygons with holes, " << others << " others");
  CHECK(right > 1000);
  CHECK(others > 1000);
  CHECK(wrong == 0);
}

TEST_CASE("Polygons that Box2D could not bear or nobody could mean are refused") {
  const std::string corners = "obstacles[1].corners";
  refused(with_polygon({}), corners);
  refused(with_polygon({{3, 3}, {4, 3}}), corners);
  refused(with_polygon({{3, 3}, {4, 3}, {4, 4}, {4.005, 4.005}}), corners + "[3]");
  refused(with_polygon({{3, 3}, {4, 3}, {4, 4}, {3.001, 3.001}}), corners + "[0]");
  refused(with_polygon({{3, 3}, {3, 3}, {4, 4}}), corners + "[1]");
  refused(with_polygon({{3, 3}, {4, 4}, {4, 3}, {3, 4}}), corners);            // crosses itself
  refused(with_polygon({{3, 3}, {3.5, 3.5}, {4, 4}}), corners);                // a line
  refused(with_polygon({{3, 3}, {4, 3}, {4, 4}, {4, 3.5}}), corners);          // a spike
  refused(with_polygon({{3, 3}, {4, 3}, {4.5, 3}, {4, 3}, {4, 4}}), corners);  // a whisker
  refused(with_polygon({{3, 3}, {4, 3}, {3.5, 3}, {3.5, 4}}), corners);        // doubles back
  refused(with_polygon({{3, 3}, {4, 3}, {4, 4}, {3.5, 3}, {3, 4}}), corners);  // touches an edge
  refused(with_polygon({{3, 3}, {4, 3}, {3.5, 3.5}, {4, 4}, {3, 4}, {3.5, 3.5}}), corners);
  refused(with_polygon({{3, 3}, {3.02, 3}, {3.01, 3.0099}}), corners);  // next to no area
  CHECK_NOTHROW(World(with_polygon({{3, 3}, {3.02, 3}, {3.01, 3.0101}})));
  CHECK_NOTHROW(World(with_polygon({{3, 3}, {3.5, 3}, {4, 3}, {4, 4}})));  // a corner on a straight
  refused(with(Polygon{std::vector<Point>(100002)}), corners);
}

TEST_CASE("The sweep agrees with whole-number arithmetic on what is simple") {
  Random random(3, "grid polygons");
  int simple = 0, tangled = 0, wrong = 0;
  for (int n = 0; n < 60000; ++n) {
    // Few grid points, so that corners on edges and overlapping edges are common.
    const auto size = 3 + random.index(7), span = 2 + random.index(6);
    std::vector<GridPoint> grid(size);
    std::vector<Point> corners;
    for (GridPoint& p : grid) {
      p = {static_cast<long>(random.index(span)), static_cast<long>(random.index(span))};
      corners.push_back(
          {2.0 + 0.25 * static_cast<double>(p.x), 2.0 + 0.25 * static_cast<double>(p.y)});
    }
    WorldDef def;
    def.obstacles = {Polygon{corners}};
    def.start = {0.5, 0.5, 0.0};
    def.target = {0.5, 0.7};
    bool accepted = true;
    try {
      World world(def);
    } catch (const InvalidValue&) {
      accepted = false;
    }
    const bool closed = grid.front().x == grid.back().x && grid.front().y == grid.back().y;
    if (closed && size > 3) grid.pop_back();  // a ring
    const bool expected = simple_on_grid(grid);
    (expected ? simple : tangled) += 1;
    wrong += accepted != expected;
  }
  MESSAGE(simple << " simple polygons, " << tangled << " others");
  CHECK(simple > 5000);
  CHECK(tangled > 5000);
  CHECK(wrong == 0);
}

TEST_CASE("A hundred thousand corners are checked in a moment, however they overlap") {
  // A comb of long slanted teeth: all edges overlap each other in x and many in y.
  const auto comb = [](int teeth) {
    Polygon polygon;
    for (int i = 0; i < teeth; ++i) {
      const double y = 0.0199 * i;
      polygon.corners.push_back({1.0, y});
      polygon.corners.push_back({900.0, y + 0.01 + 90.0});
    }
    polygon.corners.push_back({0.5, 0.0199 * teeth});
    return polygon;
  };
  WorldDef def;
  def.width = def.height = 1000.0;
  def.start = {990.0, 10.0, 0.0};
  def.target = {995.0, 10.0};
  def.obstacles = {comb(40000)};
  CHECK_NOTHROW(World{def});
  // One tooth that reaches across its neighbour.
  auto& corners = std::get<Polygon>(def.obstacles[0]).corners;
  corners[40001].y += 0.05;
  refused(def, "obstacles[0].corners");
}

// --- distances ---------------------------------------------------------------------------------

TEST_CASE("Clearance is the distance to the nearest obstacle, and to the walls where they count") {
  Random random(4, "clearance");
  double worst = 0.0;
  for (int n = 0; n < 200; ++n) {
    const World world = random_world(random, 10, 4.0);
    for (int i = 0; i < 200; ++i) {
      const Point p = point_in(random, 4.0);
      const double expected = plain_clearance(world.def(), p);
      const double walls = plain_wall_distance(world.def(), p);
      worst = std::max({worst, std::abs(world.clearance(p) - expected),
                        std::abs(world.clearance(p, true) - std::min(expected, walls))});
    }
  }
  CHECK(worst < 1e-12);

  CHECK(World().clearance({2.0, 3.0}) == kInfinite);
  CHECK(World().clearance({2.0, 3.0}, true) == 2.0);
  CHECK(World().clearance({-2.0, 3.0}, true) == 0.0);
}

TEST_CASE("However long an outline is, the edges near a point tell whether it lies inside") {
  Random random(9, "long outlines");
  // A floor of four hundred rooms, and a comb whose teeth lie so close that they are searched for.
  WorldDef floor;
  floor.width = floor.height = 20.0;
  Polygon rooms{{{-1, -1}, {21, -1}, {21, 21}, {-1, 21}}};
  for (int i = 0; i < 400; ++i) {
    const Point centre{i % 20 + 0.5, i / 20 + 0.5};
    rooms.holes.push_back(random_ring(random, centre, 5 + random.index(20), 0.2, 0.48));
  }
  floor.obstacles = {rooms};
  floor.target = {1.5, 1.5};
  WorldDef combed;
  combed.width = combed.height = 20.0;
  Polygon comb;
  for (int i = 0; i < 800; ++i) {
    comb.corners.push_back({1.0 + 0.02 * i, 2.0});
    comb.corners.push_back({1.01 + 0.02 * i, 18.0 + between(random, 0.0, 1.0)});
  }
  comb.corners.push_back({17.1, 1.0});
  comb.corners.push_back({1.0, 1.0});
  combed.obstacles = {comb};
  for (const WorldDef& def : {floor, combed}) {
    const World world(def);
    long inside = 0, outside = 0, differ = 0;
    for (int i = 0; i < many(4000); ++i) {
      const Point p{between(random, -1.5, 21.5), between(random, -1.5, 21.5)};
      const double clearance = world.clearance(p);
      (clearance == 0.0 ? inside : outside) += 1;
      differ += std::abs(clearance - plain_clearance(def, p)) > 1e-12;
    }
    CHECK(differ == 0);
    CHECK(inside > many(500));
    CHECK(outside > many(500));
  }
}

TEST_CASE("Leaving far obstacles out changes no bit of a clearance") {
  Random random(5, "rejection");
  long differ = 0;
  for (int n = 0; n < 100; ++n) {
    const World world = random_world(random, 15, 4.0);
    std::vector<World> alone;
    for (const Obstacle& obstacle : world.def().obstacles) {
      WorldDef def = world.def();
      def.obstacles = {obstacle};
      alone.emplace_back(def);
    }
    for (int i = 0; i < 100; ++i) {
      const Point p = point_in(random, 4.0);
      double least = kInfinite;
      for (const World& one : alone) least = std::min(least, one.clearance(p));
      differ += least != world.clearance(p);
    }
  }
  CHECK(differ == 0);
}

TEST_CASE("What is told of a distance without looking is never too much, and in the open near it") {
  Random random(7, "at least");
  long told = 0, too_much = 0, near = 0;
  for (int n = 0; n < 100; ++n) {
    const World world = random_world(random, 8, 4.0);
    for (int i = 0; i < 200; ++i) {
      const Point p = point_in(random, 4.0);
      const double distance = world.clearance(p);
      const double at_least = world.surfaces().distance_at_least(p);
      too_much += at_least > distance;
      told += at_least > 0.0;
      near += at_least > 0.5 * distance;
    }
  }
  CHECK(too_much == 0);
  CHECK(told > 5000);
  CHECK(near > 3000);
  CHECK(World().surfaces().distance_at_least({2.0, 3.0}) == kInfinite);
  CHECK(World().surfaces().distance_at_least({-20.0, 3.0}) < 0.0);
}

TEST_CASE("Swept clearance is the least clearance along the way") {
  Random random(6, "swept");
  int crossing = 0, clear = 0;
  for (int n = 0; n < 200; ++n) {
    const World world = random_world(random, 8, 4.0);
    for (int i = 0; i < 20; ++i) {
      const Point a = point_in(random, 4.0);
      const double heading = between(random, 0.0, 6.3), length = between(random, 0.0, 1.0);
      const Point b{a.x + length * std::cos(heading), a.y + length * std::sin(heading)};
      const int samples = 500;
      double least = kInfinite;
      for (int k = 0; k <= samples; ++k) {
        const double t = static_cast<double>(k) / samples;
        least =
            std::min(least, world.clearance({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}, true));
      }
      const double swept = plain::swept_clearance(world, a, b);
      CHECK(swept <= least + 1e-12);
      CHECK(swept >= least - 0.5 * length / samples - 1e-12);
      CHECK(swept == doctest::Approx(plain::swept_clearance(world, b, a)).epsilon(1e-12));
      (swept == 0.0 ? crossing : clear) += 1;
    }
  }
  CHECK(crossing > 300);
  CHECK(clear > 300);
  CHECK(plain::swept_clearance(World(), {1.0, 1.0}, {1.0, 1.0}) == 1.0);
}

TEST_CASE("Edges lead around what is solid on their left, walls first") {
  const World world = World::parse(kText);
  REQUIRE(world.surfaces().edges().size() == 4 + 4 + 3);
  REQUIRE(world.surfaces().circles().size() == 1);
  for (const Edge& edge : world.surfaces().edges()) {
    const Point middle{0.5 * (edge.a.x + edge.b.x), 0.5 * (edge.a.y + edge.b.y)};
    const double length = std::hypot(edge.b.x - edge.a.x, edge.b.y - edge.a.y);
    const Point left{-1e-6 * (edge.b.y - edge.a.y) / length, 1e-6 * (edge.b.x - edge.a.x) / length};
    CHECK(world.clearance({middle.x + left.x, middle.y + left.y}, true) == 0.0);
    CHECK(world.clearance({middle.x - left.x, middle.y - left.y}, true) > 0.0);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Edge &edge = world.surfaces().edges()[i], &next = world.surfaces().edges()[(i + 1) % 4];
    CHECK(edge.b == next.a);
    CHECK(edge.a == next.before);
    CHECK(edge.after == next.b);
    CHECK((edge.a.x == 0.0 || edge.a.x == 5.0));
  }
}

// --- elsewhere ---------------------------------------------------------------------------------

namespace {

// Rounded to what a double still holds a hundred kilometres away.
double on_lattice(double x) { return std::round(x * 0x1p20) * 0x1p-20; }

Pose on_lattice(const Pose& pose) { return {on_lattice(pose.x), on_lattice(pose.y), pose.heading}; }

WorldDef on_lattice(WorldDef def) {
  const auto round = [](Point& p) { p = {on_lattice(p.x), on_lattice(p.y)}; };
  for (Obstacle& obstacle : def.obstacles) each_point(obstacle, round);
  def.start = on_lattice(def.start);
  round(def.target);
  return def;
}

// The furthest that arenas of this side can lie, and a shift that takes no bit.
const Point kShifts[] = {{256.0, -128.0}, {-99840.0, 99968.0}};

Pose shifted(const Pose& pose, Point by) { return {pose.x + by.x, pose.y + by.y, pose.heading}; }

// How far apart two poses are, the second in a world shifted by that much.
double gap(const Pose& here, const Pose& there, Point by) {
  return std::max(std::abs(here.x - (there.x - by.x)), std::abs(here.y - (there.y - by.y)));
}

}  // namespace

TEST_CASE("Wherever the arena lies, distances, steps and echoes are what they are at (0, 0)") {
  Random random(1, "elsewhere");
  double worst_clearance = 0.0, worst_free = 0.0, worst_contact = 0.0, worst_echo = 0.0;
  long contacts = 0, differing = 0;
  for (int n = 0; n < 60; ++n) {
    const WorldDef def = on_lattice(random_world(random, 8, 5.0).def());
    for (const Point by : kShifts) {
      const World here(def), there(shifted(def, by));
      const Robot robot(here, {}), other(there, {});
      for (int i = 0; i < 40; ++i) {
        const Point p{on_lattice(between(random, -1.0, 6.0)),
                      on_lattice(between(random, -1.0, 6.0))};
        const Point q{p.x + by.x, p.y + by.y};
        const auto compare = [&](double a, double b) {
          worst_clearance = std::max(worst_clearance, std::abs(a - b));
        };
        compare(here.clearance(p), there.clearance(q));
        compare(here.wall_distance(p), there.wall_distance(q));
        differing += here.surfaces().keep_clear_of({2.0, 2.0}, p, 0.1) !=
                     there.surfaces().keep_clear_of({2.0 + by.x, 2.0 + by.y}, q, 0.1);
      }
      auto pose = free_pose(random, here, 0.15);
      for (int i = 0; pose && i < 60; ++i) {
        *pose = on_lattice(*pose);
        if (here.clearance({pose->x, pose->y}, true) < 0.1) break;
        const std::vector<double> heard = robot.sonar(*pose);
        const std::vector<double> also = other.sonar(shifted(*pose, by));
        for (std::size_t k = 0; k < heard.size(); ++k) {
          worst_echo = std::max(worst_echo, std::abs(heard[k] - also[k]));
        }
        const int motion = i % 7 == 0 ? static_cast<int>(random.index(5)) : 2;
        const auto a = robot.step(*pose, motion), b = other.step(shifted(*pose, by), motion);
        differing += a.collided != b.collided;
        contacts += a.collided;
        double& worst = a.collided ? worst_contact : worst_free;
        worst = std::max(worst, gap(a.pose, b.pose, by));
        pose = a.pose;
      }
    }
  }
  MESSAGE("off by at most " << worst_clearance << " m in clearance, " << worst_free
                            << " m in free steps, " << worst_contact << " m in " << contacts
                            << " contacts, " << worst_echo << " m in echoes");
  CHECK(worst_clearance < 1e-10);
  CHECK(worst_free < 1e-10);
  CHECK(worst_contact < 1e-10);
  CHECK(worst_echo < 1e-6);
  CHECK(contacts > 500);
  CHECK(differing == 0);
}

TEST_CASE("Wherever the arena lies, the shortest path and a trial's situations are the same") {
  const World paper = World::load(DEVLEARN_SOURCE_DIR "/python/devlearn/worlds/paper.json");
  const WorldDef def = on_lattice(paper.def());
  const World here(def);
  const std::vector<Pose> way = shortest_path(Robot(here, {}), def.start).poses;
  Trial trial(here, {}, 3);
  Record record;
  trial.free_learning(record, 4000);
  for (const Point by : kShifts) {
    const World there(shifted(def, by));
    const std::vector<Pose> other = shortest_path(Robot(there, {}), there.def().start).poses;
    REQUIRE(other.size() == way.size());
    for (std::size_t i = 0; i < way.size(); ++i) REQUIRE(gap(way[i], other[i], by) < 1e-8);

    Trial elsewhere(there, {}, 3);
    Record same;
    elsewhere.free_learning(same, 4000);
    CHECK(same.situation == record.situation);
    CHECK(same.motion == record.motion);
    CHECK(same.collided == record.collided);
    CHECK(elsewhere.grid().origin() == by);
  }
}

TEST_CASE("What lies outside an arena that lies elsewhere is refused with the range it has") {
  const WorldDef def = shifted(WorldDef(), {256.0, -128.0});
  const auto refusal = [](const auto& act) {
    try {
      act();
    } catch (const InvalidValue& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  const auto says = [&](const WorldDef& bad, const std::string& range) {
    CAPTURE(range);
    CHECK(refusal([&] { World{bad}; }).find(range) != std::string::npos);
  };
  WorldDef bad = def;
  bad.start.x = 0.5;
  says(bad, "in [256, 261] m");
  bad = def;
  bad.target.y = 4.5;
  says(bad, "in [-128, -123] m");
  bad = def;
  bad.obstacles = {Circle{{250.9, -126.0}, 0.1}};
  says(bad, "in [251, 266] m");
  const Robot robot(World(def), {});
  CHECK(refusal([&] {
          robot.require_place({0.5, -127.5, 0.0});
        }).find("in [256, 261] m") != std::string::npos);
  const SituationGrid grid(5.0, 5.0, 20, 20, 12, def.origin);
  CHECK(refusal([&] { grid.situation(257.0, 0.0, 0.0); }).find("in [-128, -123] m") !=
        std::string::npos);
}
