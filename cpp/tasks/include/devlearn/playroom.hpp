#pragma once

#include <array>
#include <cstdint>

#include "devlearn/random.hpp"
#include "devlearn/task.hpp"

namespace devlearn {

/// The settings of Playroom.
struct PlayroomConfig {
  double reward = 1.0;
  bool ending = true;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = PlayroomConfig;
    return described(
        "PlayroomConfig",
        field("reward", &C::reward, "r_e", closed(-1e6, 1e6), "reward where the monkey cries"),
        field("ending", &C::ending, "", Truth{}, "whether an episode ends where the monkey cries"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const PlayroomConfig& a, const PlayroomConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const PlayroomConfig& a, const PlayroomConfig& b) noexcept {
  return !(a == b);
}

/// The playroom of Singh, Barto & Chentanez (2004, NIPS): a grid of 5 x 5 squares with a light
/// switch, a ball, a bell, a blue and a red block, and a toy monkey. The agent has an eye, a hand
/// and a marker, and senses which objects are in the squares of these, and whether there is light
/// and music and the bell rang; it does not sense where they are.
///
/// Where eye and hand are on the same object, what can be done with it is allowed. The switch turns
/// the light on and off. A block, pressed, turns music on (blue) or off (red); pushed, it moves to
/// a random adjacent square. In the dark blocks look alike and cannot be handled. The ball, kicked,
/// goes to the marker; if it comes to the bell there, the bell rings and moves to a random adjacent
/// square. The monkey cries in the step after, if it is dark then, with music on.
///
/// Light and music going on or off, the bell and the monkey are the salient events. An episode
/// begins in the dark, without music, with everything at random, each object in a square of its
/// own.
class Playroom final : public Task {
 public:
  using Config = PlayroomConfig;  ///< its settings

  /// What is in the room, by its bit in a situation.
  enum Object : std::uint8_t { kSwitch, kBall, kBell, kBlueBlock, kRedBlock, kMonkey };
  static constexpr int kObjects = 6;  ///< how many
  /// The motions.
  enum Motion : std::uint8_t {
    kEyeToHand,
    kEyeToMarker,
    kEyeNorth,
    kEyeSouth,
    kEyeEast,
    kEyeWest,
    kEyeToRandomObject,
    kHandToEye,
    kMarkerToEye,
    kFlickSwitch,
    kKickBall,
    kPressBlueBlock,
    kPushBlueBlock,
    kPressRedBlock,
    kPushRedBlock,
  };
  static constexpr int kMotions = 15;  ///< how many
  /// The salient events.
  enum Event : std::uint8_t { kLightOn, kLightOff, kMusicOn, kMusicOff, kBellRings, kMonkeyCries };
  static constexpr int kEvents = 6;  ///< how many

  static const char* name(Object object) noexcept;  ///< `switch`, `ball` ...
  static const char* name(Motion motion) noexcept;  ///< `eye_to_hand` ...
  static const char* name(Event event) noexcept;    ///< `light_on` ...

  /// A square.
  struct Square {
    int row = 0;     ///< 0 ... 4 from the north
    int column = 0;  ///< 0 ... 4 from the west
    /// Whether they are the same.
    friend bool operator==(const Square& a, const Square& b) noexcept {
      return a.row == b.row && a.column == b.column;
    }
  };
  /// Where everything is.
  struct State {
    Square eye;                            ///< where the agent looks
    Square hand;                           ///< where its hand is
    Square marker;                         ///< where its visual marker is
    std::array<Square, kObjects> objects;  ///< by Object
    bool light = false;                    ///< whether it is on
    bool music = false;                    ///< whether it plays
    bool ringing = false;                  ///< whether the bell rang in the last step
  };

  /// Throws InvalidValue.
  explicit Playroom(const Config& config = {});

  int motion_count() const noexcept override { return kMotions; }
  SituationId situation_count() const noexcept override {
    return SituationId{1} << (3 * kObjects + 3);
  }
  void begin(std::uint64_t seed) override;
  Observation observation() const override;
  Outcome step(int motion) override;
  bool succeeded() const noexcept override { return succeeded_; }

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// Where everything is; before an episode in the north-western square.
  const State& state() const noexcept { return state_; }
  /// How often each event came in the episode, by Event.
  const std::array<std::int64_t, kEvents>& counts() const noexcept { return counts_; }
  /// Goes on from here, with the draws of the episode. Throws InvalidValue where none is under way,
  /// or for a square outside the room.
  void place(const State& state);

 private:
  void require_under_way(const char* call) const;
  bool at_hand(Object object) const noexcept;
  SituationId situation() const noexcept;
  void find_allowed() noexcept;
  int act(Motion motion);
  int kick_ball();
  void move_aside(Square& square);

  Config config_;
  Random random_{0, "playroom"};
  State state_;
  std::array<bool, kMotions> allowed_{};
  std::array<std::int64_t, kEvents> counts_{};
  bool under_way_ = false;
  bool succeeded_ = false;
};

}  // namespace devlearn
