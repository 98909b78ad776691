#include "devlearn/world.hpp"

#include <algorithm>
#include <iterator>
#include <variant>

#include "bindings.hpp"
#include "devlearn/detail/require.hpp"

namespace devlearn::python {
namespace {

double clearance(const World& world, double x, double y, bool walls_count, double time) {
  require_finite("x", x);
  require_finite("y", y);
  return world.clearance({x, y}, walls_count, time);
}

void require_time(double time) { require_in("time", time, 0.0, 1e9, "s"); }

void bind_obstacles(py::module_& m) {
  py::class_<Circle> circle(m, "Circle",
                            "A round obstacle: center (x, y) [m], radius in [0.01, 1000] m.");
  circle
      .def(py::init([](Point center, double radius) {
             const Circle made{center, radius};
             made.validate("Circle");
             return made;
           }),
           py::arg("center"), py::arg("radius"))
      .def_readonly("center", &Circle::center, "(x, y) [m]")
      .def_readonly("radius", &Circle::radius, "[m]")
      .def("__repr__", [](const py::object& self) {
        return py::str("Circle({}, {})").format(self.attr("center"), self.attr("radius"));
      });
  def_value(circle, {"center", "radius"});
  py::class_<Rectangle> rectangle(
      m, "Rectangle",
      "A rectangular obstacle: center (x, y) [m], size (width, height) "
      "in [0.01, 1000] m, turned by `angle` degrees counter-clockwise.");
  rectangle
      .def(py::init([](Point center, Point size, double angle) {
             const Rectangle made{center, size.x, size.y, angle};
             made.validate("Rectangle");
             return made;
           }),
           py::arg("center"), py::arg("size"), py::arg("angle") = 0.0)
      .def_readonly("center", &Rectangle::center, "(x, y) [m]")
      .def_property_readonly(
          "size",
          [](const Rectangle& self) {
            return Point{self.width, self.height};
          },
          "(width, height) [m]")
      .def_readonly("angle", &Rectangle::angle, "[degrees]")
      .def("__repr__", [](const py::object& self) {
        return py::str("Rectangle({}, {}, {})")
            .format(self.attr("center"), self.attr("size"), self.attr("angle"));
      });
  def_value(rectangle, {"center", "size", "angle"});
  py::class_<Polygon> polygon(m, "Polygon",
                              "An obstacle of any simple outline, convex or not: at least 3 "
                              "corners (x, y) [m] in either direction, neighbours at least 0.01 m "
                              "apart. Its holes, each such a list of corners inside the outline, "
                              "apart from it and from each other, are free.");
  polygon
      .def(py::init([](std::vector<Point> corners, std::vector<std::vector<Point>> holes) {
             Polygon made{std::move(corners), std::move(holes)};
             made.validate("Polygon");
             return made;
           }),
           py::arg("corners"), py::arg("holes") = py::list())
      .def_readonly("corners", &Polygon::corners, "(x, y) of each corner [m]")
      .def_readonly("holes", &Polygon::holes, "(x, y) of each corner of each hole [m]")
      .def("__repr__", [](const py::object& self) {
        const py::object corners = self.attr("corners"), holes = self.attr("holes");
        if (py::len(holes) == 0) return py::str("Polygon({})").format(corners);
        return py::str("Polygon({}, {})").format(corners, holes);
      });
  def_value(polygon, {"corners", "holes"});
  py::class_<Polyline> polyline(m, "Polyline",
                                "A wall of no thickness: at least 2 points (x, y) [m], neighbours "
                                "at least 0.01 m apart. It may cross itself, and is closed if it "
                                "ends where it begins.");
  polyline
      .def(py::init([](std::vector<Point> points) {
             Polyline made{std::move(points)};
             made.validate("Polyline");
             return made;
           }),
           py::arg("points"))
      .def_readonly("points", &Polyline::points, "(x, y) of each point [m]")
      .def("__repr__", [](const py::object& self) {
        return py::str("Polyline({})").format(self.attr("points"));
      });
  def_value(polyline, {"points"});
}

void bind_movers(py::module_& m) {
  py::class_<MoverPath> path(
      m, "MoverPath",
      "A way along 2 to 10 000 points (x, y) [m], neighbours at least 0.01 m apart, at one speed "
      "in\n"
      "(0, 1] m/s. What comes after the last point: 'back' (the same way back to the first, and "
      "so\n"
      "on), 'around' (straight to the first, and around again) or 'stop'. Raises InvalidValue.");
  path.def(py::init([](std::vector<Point> points, double speed, const std::string& then) {
             const auto* const known =
                 std::find(std::begin(MoverPath::kThens), std::end(MoverPath::kThens), then);
             if (known == std::end(MoverPath::kThens)) {
               throw InvalidValue("MoverPath.then", then, "'back', 'around' or 'stop'");
             }
             const MoverPath made{
                 std::move(points), speed,
                 static_cast<MoverPath::Then>(known - std::begin(MoverPath::kThens))};
             made.validate("MoverPath");
             return made;
           }),
           py::arg("points"), py::arg("speed"), py::arg("then") = "back")
      .def_readonly("points", &MoverPath::points, "(x, y) of each [m]")
      .def_readonly("speed", &MoverPath::speed, "[m/s]")
      .def_property_readonly(
          "then",
          [](const MoverPath& self) {
            return MoverPath::kThens[static_cast<std::size_t>(self.then)];
          },
          "'back', 'around' or 'stop'")
      .def("__repr__", [](const py::object& self) {
        return py::str("MoverPath({}, {}, {!r})")
            .format(self.attr("points"), self.attr("speed"), self.attr("then"));
      });
  def_value(path, {"points", "speed", "then"});
  py::class_<MoverWalk> walk(
      m, "MoverWalk",
      "A walk by random waypoints: every leg_time seconds a new point, uniform in the box from\n"
      "low (x, y) to high (x, y) [m]; straight and evenly from one to the next, at most at 1 m/s:\n"
      "leg_time in [0.1, 1e6] s is at least what the box's diagonal takes then. Raises\n"
      "InvalidValue.");
  walk.def(py::init([](Whole<SeedTag> seed, const Point& low, const Point& high, double leg_time) {
             const MoverWalk made{seed.value, low, high, leg_time};
             made.validate("MoverWalk");
             return made;
           }),
           py::arg("seed"), py::arg("low"), py::arg("high"), py::arg("leg_time"))
      .def_readonly("seed", &MoverWalk::seed, "Of the points.")
      .def_readonly("low", &MoverWalk::low, "The box's corner of least x and y [m]")
      .def_readonly("high", &MoverWalk::high, "Its corner of greatest x and y [m]")
      .def_readonly("leg_time", &MoverWalk::leg_time, "From point to point [s]")
      .def("__repr__", [](const py::object& self) {
        return py::str("MoverWalk({}, {}, {}, {})")
            .format(self.attr("seed"), self.attr("low"), self.attr("high"), self.attr("leg_time"));
      });
  def_value(walk, {"seed", "low", "high", "leg_time"});
  py::class_<Mover> mover(
      m, "Mover",
      "An obstacle that moves and does not turn: a Circle or Rectangle whose centre, which is\n"
      "given as (0, 0), goes along a MoverPath or MoverWalk from time 0 on. Raises InvalidValue.");
  mover
      .def(py::init([](std::variant<Circle, Rectangle> shape,
                       std::variant<MoverPath, MoverWalk> course) {
             Mover made{shape, std::move(course)};
             made.validate("Mover");
             return made;
           }),
           py::arg("shape"), py::arg("course"))
      .def_readonly("shape", &Mover::shape, "A Circle or Rectangle about (0, 0).")
      .def_readonly("course", &Mover::course, "A MoverPath or MoverWalk.")
      .def("__repr__", [](const py::object& self) {
        return py::str("Mover({}, {})").format(self.attr("shape"), self.attr("course"));
      });
  def_value(mover, {"shape", "course"});
}

}  // namespace

void bind_world(py::module_& m) {
  bind_obstacles(m);
  bind_movers(m);

  py::class_<World> world(
      m, "World",
      "An arena with walls, obstacles, a start and a target; checked once, then unchanging.\n\n"
      "Parameters: width, height of the arena in [0.5, 1000] m; start (x, y, heading) and target\n"
      "(x, y) inside it and outside every obstacle, in metres and degrees; obstacles, a list of\n"
      "Circle, Rectangle, Polygon and Polyline; origin (x, y), the arena's corner of least x and\n"
      "y, each within 100 000 m of 0; movers, a list of Mover, which go through obstacles, walls\n"
      "and each other, but not over the start. Where these are is a pure function of time [s], "
      "from\n"
      "0 to 1e9. Raises InvalidValue.");
  def_pickling(world, {"width", "height", "start", "target", "obstacles", "name", "description",
                       "origin", "movers"});
  world
      .def(py::init([](double width, double height, const Pose& start, const Point& target,
                       std::vector<Obstacle> obstacles, std::string name, std::string description,
                       const Point& origin, std::vector<Mover> movers) {
             const NoGil no_gil;
             return World(WorldDef{std::move(name), std::move(description), width, height, origin,
                                   start, target, std::move(obstacles), std::move(movers)});
           }),
           py::arg("width") = 5.0, py::arg("height") = 5.0,
           py::arg("start") = py::make_tuple(0.5, 0.5, 0.0),
           py::arg("target") = py::make_tuple(4.5, 4.5), py::arg("obstacles") = py::list(),
           py::arg("name") = "", py::arg("description") = "",
           py::arg("origin") = py::make_tuple(0.0, 0.0), py::arg("movers") = py::list())
      .def_static(
          "load",
          [](const py::object& path_or_name) {
            const py::object path =
                py::module_::import("devlearn._worlds").attr("path_of")(path_or_name);
            const std::string name = file_path(path);
            const NoGil no_gil;
            return World::load(name);
          },
          py::arg("path_or_name"),
          "The world in a JSON file, or one that ships by its name (see devlearn.worlds()). Raises "
          "FileError, naming file and field.")
      .def_static(
          "random",
          [](const std::string& kind, Whole<SeedTag> seed, double difficulty) {
            const NoGil no_gil;
            return World::random(kind, seed.value, difficulty);
          },
          py::arg("kind"), py::arg("seed"), py::kw_only(), py::arg("difficulty") = 0.5,
          "A world of 5 m x 5 m drawn by chance, the same on every machine, in which the robot of\n"
          "the paper has a way from start to target. kind: 'similar' (to Fig. 2), 'clutter',\n"
          "'corridors', 'rooms' or 'traps'. difficulty in [0, 1]: what it means for each kind is\n"
          "in docs/worlds.md. Raises InvalidValue.")
      .def_static(
          "from_ros_map",
          [](const py::object& yaml, const std::optional<Pose>& start,
             const std::optional<Point>& target, const std::string& unknown,
             std::optional<double> tolerance, Whole<SeedTag> seed, double radius) {
            const py::object imported = py::module_::import("devlearn.maps").attr("import_ros_map");
            return imported(yaml, start, target, unknown, tolerance, seed.value, radius)
                .attr("world")
                .cast<World>();
          },
          py::arg("yaml"), py::arg("start") = py::none(), py::arg("target") = py::none(),
          py::arg("unknown") = "occupied", py::arg("tolerance") = py::none(), py::arg("seed") = 0,
          py::arg("radius") = 0.1,
          "The world in a map of ROS's map_server: its YAML, with a PGM or PNG, in the map's own\n"
          "frame. start (x, y, heading) and target (x, y), where None drawn by `seed`, with a way\n"
          "between them for a robot of `radius` [m]. unknown: what cells are of which the map "
          "does\n"
          "not know, 'occupied', 'free' or 'border' (occupied where they touch free ones). "
          "Outlines\n"
          "lie within `tolerance` [m] of those traced; None: half a cell. Needs the extra `maps`;\n"
          "docs/maps.md tells all, devlearn.maps.import_ros_map what was made of a map. Raises\n"
          "FileError, InvalidValue.")
      .def_static(
          "from_json",
          [](const std::string& text) {
            const NoGil no_gil;
            return World::parse(text);
          },
          py::arg("text"), "The world in JSON text. Raises FileError.")
      .def("to_json", &World::to_json, py::call_guard<NoGil>(),
           "JSON text that from_json reads back as an equal world.")
      .def(
          "save",
          [](const World& self, const py::object& path) {
            const std::string name = file_path(path);
            const NoGil no_gil;
            self.save(name);
          },
          py::arg("path"), "Writes to_json() to a file, atomically. Raises FileError.")
      .def("with_start", &World::with_start, py::arg("start"),
           "The same world with another start (x, y, heading). Raises InvalidValue.")
      .def("standing", &World::standing, "The same world without its movers.")
      .def(
          "movers_at",
          [](const World& self, double time) {
            require_time(time);
            return self.movers_at(time);
          },
          py::arg("time"),
          "The movers where they are at a time [s], as a list of Circle and Rectangle. Raises "
          "InvalidValue.")
      .def(
          "clearance",
          [](const World& self, double x, double y, bool walls_count, double time) {
            require_time(time);
            return clearance(self, x, y, walls_count, time);
          },
          py::arg("x"), py::arg("y"), py::arg("walls_count") = false, py::arg("time") = 0.0,
          "d_o: least distance from a point to an obstacle's surface at a time [m], 0 inside one, "
          "inf where there is none; with walls_count the walls count too. Numbers or arrays of "
          "points. Raises InvalidValue for what is not finite.")
      .def(
          "clearance",
          [](const World& self, const py::array_t<double>& x, const py::array_t<double>& y,
             bool walls_count, double time) {
            require_time(time);
            return py::vectorize([&self, walls_count, time](double px, double py_) {
              take_a_breath();
              return clearance(self, px, py_, walls_count, time);
            })(x, y);
          },
          py::arg("x"), py::arg("y"), py::arg("walls_count") = false, py::arg("time") = 0.0)
      .def_property_readonly(
          "name", [](const World& self) { return self.def().name; }, "For people.")
      .def_property_readonly(
          "description", [](const World& self) { return self.def().description; }, "For people.")
      .def_property_readonly(
          "width", [](const World& self) { return self.def().width; }, "[m]")
      .def_property_readonly(
          "height", [](const World& self) { return self.def().height; }, "[m]")
      .def_property_readonly(
          "origin", [](const World& self) { return self.def().origin; },
          "The arena's corner of least x and y, (x, y) [m]")
      .def_property_readonly(
          "start", [](const World& self) { return self.def().start; }, "Pose [m, m, degrees]")
      .def_property_readonly(
          "target", [](const World& self) { return self.def().target; }, "(x, y) [m]")
      .def_property_readonly(
          "obstacles", [](const World& self) { return self.def().obstacles; },
          "Circle, Rectangle, Polygon and Polyline, as a list.")
      .def_property_readonly(
          "movers", [](const World& self) { return self.def().movers; }, "Mover, as a list.")
      .def_property_readonly(
          "hash",
          [](const World& self) {
            const py::bytes text(self.to_json());
            return py::module_::import("hashlib")
                .attr("sha256")(text)
                .attr("hexdigest")()
                .cast<std::string>();
          },
          "SHA-256 of to_json(), in hexadecimal.")
      .def(
          "__eq__", [](const World& a, const World& b) { return a.to_json() == b.to_json(); },
          py::is_operator())
      .def("__hash__", [](const World& self) { return py::hash(py::str(self.to_json())); })
      .def("__repr__", [](const World& self) {
        const std::size_t movers = self.def().movers.size();
        return "<devlearn.World '" + self.def().name + "': " + to_text(self.def().width) + " x " +
               to_text(self.def().height) + " m, " + std::to_string(self.def().obstacles.size()) +
               " obstacles" + (movers > 0 ? ", " + std::to_string(movers) + " movers>" : ">");
      });
}

}  // namespace devlearn::python
