#pragma once

#include <box2d/box2d.h>

#include <memory>
#include <mutex>
#include <vector>

#include "body/moving_shape.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// The sonars of a robot: rays in a Box2D world of all that stands still, made when first asked,
/// and among what moves, where that is. They see both from the arena's origin, so that floats lose
/// nothing to where the arena lies.
class Sonars {
 public:
  Sonars(std::shared_ptr<const World> world, const RobotDef& robot);

  /// Echo distances from the rim of a body at a pose, as Robot::sonar has them; each looks `aside`
  /// by some degrees, or null.
  void listen(const Pose& pose, const double* aside, double* echoes, double time) const;

 private:
  // A mover that a ray may meet.
  struct Near {
    const b2Shape* shape;
    b2Transform place;
    bool holds_robot;  // the centre of it
  };

  void build() const;
  std::vector<Near> movers_near(const Pose& pose, double time) const;
  double nearest_echo(Point at, double heading, const std::vector<Near>& movers) const;
  double echo(Point at, double heading, const std::vector<Near>& movers) const;

  std::shared_ptr<const World> world_;
  mutable std::once_flag built_;
  mutable std::unique_ptr<b2World> standing_;
  mutable std::vector<MovingShape> moving_;  // as the world numbers its movers
  std::vector<double> angles_;
  std::vector<double> cone_;  // its rays, relative to where a sonar looks [degrees]
  double radius_, range_, least_range_, blind_range_;
  double least_cosine_;  // of the angle at which sound comes back
};

}  // namespace devlearn
