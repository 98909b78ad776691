#pragma once

#include "devlearn/adaptive.hpp"

namespace devlearn {

/// A corridor of cells 0 ... 19, each of three places, the goal behind the last: motion 0 steps
/// forward, 1 back, 2 into a wall (dear), and 3 leaps two cells on from every fourth cell.
class Corridor {
 public:
  static constexpr int kPlaces = 60;

  int place = 0;
  bool door = true;  // whether leaps are possible

  SituationId situation() const { return place / 3; }
  double estimate() const { return (kPlaces - place) / 6.0; }  // all by leaps
  bool arrived() const { return place >= kPlaces; }

  struct Came {
    double cost;
    bool touched;
  };
  Came step(int motion) {
    switch (motion) {
      case 0:
        ++place;
        return {1.0, false};
      case 1:
        place = place > 0 ? place - 1 : 0;
        return {1.0, false};
      case 3:
        if (door && place / 3 % 4 == 0) {
          place += 6;
          return {1.0, false};
        }
        return {6.0, true};
      default:
        return {6.0, true};
    }
  }
};

inline AdaptiveConfig four_motions() {
  AdaptiveConfig config;
  config.motion_count = 4;
  return config;
}

}  // namespace devlearn
