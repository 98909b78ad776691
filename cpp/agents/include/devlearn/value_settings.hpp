#pragma once

#include <cstdint>

#include "devlearn/detail/fields.hpp"

namespace devlearn {

/// What Q(S, A) is when situation S is first met.
enum class FirstValue : std::uint8_t {
  kConstant,  ///< initial_value
  kEstimate,  ///< -estimate: no return is higher where each step costs 1
};

/// The potential Phi of shaped rewards: R + gamma Phi(S') - Phi(S) is learned from, which leaves
/// the best policy as it is (Ng, Harada & Russell 1999). Phi of an arrival is 0.
enum class Shaping : std::uint8_t {
  kNone,      ///< none: the reward itself
  kSef,       ///< SEF
  kEstimate,  ///< -estimate
};

namespace detail {

/// What the settings are that value learners share, and those that one adds. Symbols are those of
/// Sutton & Barto, Reinforcement Learning, 2nd edition.
template <typename C, typename... More>
constexpr auto described_with_values(const char* owner, More... more) {
  return described(
      owner, field("alpha", &C::alpha, "alpha", above(0.0, 1.0), "step size"),
      field("gamma", &C::gamma, "gamma", closed(0.0, 1.0), "discount rate"),
      field("epsilon", &C::epsilon, "epsilon", closed(0.0, 1.0),
            "probability of a random motion instead of a greedy one"),
      field("first_value", &C::first_value, "Q_0", names("constant", "estimate"),
            "Q of a situation when it is first met: initial_value, or less the estimate of the "
            "cost to go"),
      field("initial_value", &C::initial_value, "", closed(-1e9, 1e9),
            "Q of a situation when it is first met, where first_value is constant"),
      field("shaping", &C::shaping, "Phi", names("none", "sef", "estimate"),
            "potential by which rewards are shaped: none, SEF, or less the estimate"),
      more...);
}

}  // namespace detail
}  // namespace devlearn
