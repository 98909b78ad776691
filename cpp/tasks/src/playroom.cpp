#include "devlearn/playroom.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "devlearn/detail/require.hpp"

namespace devlearn {
namespace {

constexpr int kSide = 5;
constexpr int kNoEvent = -1;

Playroom::Square square_of(std::uint32_t number) noexcept {
  return {static_cast<int>(number) / kSide, static_cast<int>(number) % kSide};
}

}  // namespace

const char* Playroom::name(Object object) noexcept {
  constexpr const char* kNames[] = {"switch", "ball", "bell", "blue_block", "red_block", "monkey"};
  return kNames[object];
}

const char* Playroom::name(Motion motion) noexcept {
  constexpr const char* kNames[] = {"eye_to_hand",
                                    "eye_to_marker",
                                    "eye_north",
                                    "eye_south",
                                    "eye_east",
                                    "eye_west",
                                    "eye_to_random_object",
                                    "hand_to_eye",
                                    "marker_to_eye",
                                    "flick_switch",
                                    "kick_ball",
                                    "press_blue_block",
                                    "push_blue_block",
                                    "press_red_block",
                                    "push_red_block"};
  return kNames[motion];
}

const char* Playroom::name(Event event) noexcept {
  constexpr const char* kNames[] = {"light_on",  "light_off",  "music_on",
                                    "music_off", "bell_rings", "monkey_cries"};
  return kNames[event];
}

Playroom::Playroom(const Config& config) : config_((config.validate(), config)) {}

void Playroom::begin(std::uint64_t seed) {
  random_ = Random(seed, "playroom");
  state_ = {};
  std::array<bool, std::size_t{kSide} * kSide> taken{};
  for (Square& square : state_.objects) {
    std::uint32_t number = random_.index(kSide * kSide);
    while (taken[number]) number = random_.index(kSide * kSide);
    taken[number] = true;
    square = square_of(number);
  }
  for (Square* square : {&state_.eye, &state_.hand, &state_.marker}) {
    *square = square_of(random_.index(kSide * kSide));
  }
  counts_ = {};
  under_way_ = true;
  succeeded_ = false;
  find_allowed();
}

Observation Playroom::observation() const {
  require_under_way("observation");
  Observation seen;
  seen.situation = situation();
  seen.motion_count = kMotions;
  seen.allowed = allowed_;
  return seen;
}

Outcome Playroom::step(int motion) {
  require_under_way("step");
  require_count("motion", motion, 0, kMotions - 1);
  if (!allowed_[static_cast<std::size_t>(motion)]) {
    throw InvalidValue("motion", std::to_string(motion), "one of those allowed");
  }
  Outcome outcome;
  const bool rang = std::exchange(state_.ringing, false);
  outcome.event = act(static_cast<Motion>(motion));
  if (rang && outcome.event == kNoEvent && !state_.light && state_.music) {
    outcome.event = kMonkeyCries;
  }
  if (outcome.event >= 0) ++counts_[static_cast<std::size_t>(outcome.event)];
  find_allowed();
  const bool cries = outcome.event == kMonkeyCries;
  outcome.cost = cries ? -config_.reward : 0.0;
  outcome.situation = situation();
  if (cries && config_.ending) {
    outcome.arrived = succeeded_ = true;
    under_way_ = false;
  }
  return outcome;
}

void Playroom::place(const State& state) {
  require_under_way("place");
  const auto require = [](const char* quantity, const Square& square) {
    require_count(quantity, square.row, 0, kSide - 1);
    require_count(quantity, square.column, 0, kSide - 1);
  };
  require("eye", state.eye);
  require("hand", state.hand);
  require("marker", state.marker);
  for (int object = 0; object < kObjects; ++object) {
    require(name(static_cast<Object>(object)), state.objects[static_cast<std::size_t>(object)]);
  }
  state_ = state;
  find_allowed();
}

void Playroom::require_under_way(const char* call) const {
  if (under_way_) return;
  throw InvalidValue(call, "called where no episode is under way", "begin first");
}

bool Playroom::at_hand(Object object) const noexcept {
  return state_.eye == state_.hand && state_.objects[object] == state_.eye;
}

// The objects in the square of the eye, of the hand, and of the marker, six bits each, then light,
// music and the ringing of the bell. In the dark one block, or two, are the bits of a block,
// whichever.
SituationId Playroom::situation() const noexcept {
  SituationId id = 0;
  for (const Square* square : {&state_.eye, &state_.hand, &state_.marker}) {
    unsigned bits = 0;
    for (unsigned object = 0; object < kObjects; ++object) {
      if (state_.objects[object] == *square) bits |= 1U << object;
    }
    const unsigned blue = 1U << kBlueBlock, red = 1U << kRedBlock;
    if (!state_.light && (bits & (blue | red)) == red) bits ^= blue | red;
    id = id << kObjects | bits;
  }
  return id << 3 | (state_.light ? 4 : 0) | (state_.music ? 2 : 0) | (state_.ringing ? 1 : 0);
}

void Playroom::find_allowed() noexcept {
  allowed_.fill(true);
  allowed_[kFlickSwitch] = at_hand(kSwitch);
  allowed_[kKickBall] = at_hand(kBall);
  allowed_[kPressBlueBlock] = allowed_[kPushBlueBlock] = state_.light && at_hand(kBlueBlock);
  allowed_[kPressRedBlock] = allowed_[kPushRedBlock] = state_.light && at_hand(kRedBlock);
}

// What comes of a motion: its event.
int Playroom::act(Motion motion) {
  Square& eye = state_.eye;
  switch (motion) {
    case kEyeToHand:
      eye = state_.hand;
      return kNoEvent;
    case kEyeToMarker:
      eye = state_.marker;
      return kNoEvent;
    case kEyeNorth:
      eye.row = std::max(eye.row - 1, 0);
      return kNoEvent;
    case kEyeSouth:
      eye.row = std::min(eye.row + 1, kSide - 1);
      return kNoEvent;
    case kEyeEast:
      eye.column = std::min(eye.column + 1, kSide - 1);
      return kNoEvent;
    case kEyeWest:
      eye.column = std::max(eye.column - 1, 0);
      return kNoEvent;
    case kEyeToRandomObject:
      eye = state_.objects[random_.index(kObjects)];
      return kNoEvent;
    case kHandToEye:
      state_.hand = eye;
      return kNoEvent;
    case kMarkerToEye:
      state_.marker = eye;
      return kNoEvent;
    case kFlickSwitch:
      state_.light = !state_.light;
      return state_.light ? kLightOn : kLightOff;
    case kKickBall:
      return kick_ball();
    case kPressBlueBlock:
      return std::exchange(state_.music, true) ? kNoEvent : kMusicOn;
    case kPressRedBlock:
      return std::exchange(state_.music, false) ? kMusicOff : kNoEvent;
    case kPushBlueBlock:
      move_aside(state_.objects[kBlueBlock]);
      return kNoEvent;
    case kPushRedBlock:
      move_aside(state_.objects[kRedBlock]);
      return kNoEvent;
  }
  return kNoEvent;
}

int Playroom::kick_ball() {
  Square& ball = state_.objects[kBall];
  Square& bell = state_.objects[kBell];
  if (ball == state_.marker) return kNoEvent;
  ball = state_.marker;
  if (!(ball == bell)) return kNoEvent;
  move_aside(bell);
  state_.ringing = true;
  return kBellRings;
}

// To one of the up to eight squares around, each as likely.
void Playroom::move_aside(Square& square) {
  std::array<Square, 8> around{};
  std::uint32_t count = 0;
  for (int row = std::max(square.row - 1, 0); row <= std::min(square.row + 1, kSide - 1); ++row) {
    for (int column = std::max(square.column - 1, 0);
         column <= std::min(square.column + 1, kSide - 1); ++column) {
      const Square other{row, column};
      if (!(other == square)) around[count++] = other;
    }
  }
  square = around[random_.index(count)];
}

}  // namespace devlearn
