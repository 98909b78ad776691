#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/option_model.hpp"
#include "devlearn/detail/value_table.hpp"

namespace devlearn {

/// The settings of SalientEvents.
struct SalientEventsConfig {
  double alpha = 0.1;
  double gamma = 0.9;
  double epsilon = 0.3;
  double tau = 0.5;
  double terminal_value = 1.0;
  int endings = 32;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = SalientEventsConfig;
    return described(
        "SalientEventsConfig", field("alpha", &C::alpha, "alpha", above(0.0, 1.0), "step size"),
        field("gamma", &C::gamma, "gamma", above(0.0, 1.0), "discount rate"),
        field("epsilon", &C::epsilon, "epsilon", closed(0.0, 1.0),
              "probability of a random motion or option instead of a greedy one; within an option, "
              "of "
              "a random motion"),
        field("tau", &C::tau, "tau", closed(0.0, 1e6),
              "intrinsic reward of a salient event that was not foreseen at all"),
        field("terminal_value", &C::terminal_value, "", closed(-1e6, 1e6),
              "what its event is worth to an option"),
        field("endings", &C::endings, "", whole(1, 1000000),
              "situations in which an option ends that its model keeps for each one, at most"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const SalientEventsConfig& a, const SalientEventsConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const SalientEventsConfig& a, const SalientEventsConfig& b) noexcept {
  return !(a == b);
}

/// An option, as it stands in a situation.
struct OptionView {
  int event = -1;            ///< the salient event that it leads to
  bool available = false;    ///< whether it can be begun here
  double probability = 0.0;  ///< of its event, discounted by the steps to it: sum_x P(x | s)
  double intrinsic = 0.0;    ///< reward of its event now, where it comes in the likeliest way
  double value = 0.0;        ///< Q_B of it
  int motion = -1;           ///< what it does first, the first among equals; -1: not available
};

/// What SalientEvents makes of a situation.
struct SalientEventsExplanation {
  SituationId situation = -1;       ///< which
  std::vector<bool> allowed;        ///< N: whether each motion was, at the last choice there
  std::vector<double> value;        ///< N: Q_B of each motion
  std::vector<OptionView> options;  ///< in the order in which they were made
  std::vector<int> running;         ///< events of the options under way, the outermost first
};
/// A table for people, a line a motion and a line an option.
std::string to_text(const SalientEventsExplanation& explanation);

/// Skills from salient events (Singh, Barto & Chentanez 2004, NIPS; Barto, Singh & Chentanez 2004,
/// ICDL). The first time that an event, Outcome::event, comes, an option is made that learns to
/// bring it about. An event that the option's model did not foresee is rewarding in itself,
///
///     r_i = tau (1 - P(s' | s) / gamma),
///
/// so what is not yet mastered is sought. Options are learned about off-policy, all at once, and
/// are actions for each other.
///
/// Epsilon-greedy over motions and options. An option runs until its event comes, or where it
/// could not be begun. A round's beginning and its arrival end all of them.
///
/// An arrival is worth 0. Only allowed motions count. choose throws InvalidValue while a choice
/// waits, or for another motion_count than before; observe and cancel where none waits; all for
/// numbers that are not finite, observe for an event beyond 63.
class SalientEvents final : public Agent {
 public:
  using Config = SalientEventsConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "salient_events";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit SalientEvents(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit SalientEvents(const AgentState& state, const std::string& source = "state");

  void begin_round() override { running_.clear(); }
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// Q_B of a situation and motion; nothing for a situation never met. Throws InvalidValue for a
  /// negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }
  /// The events for which there is an option, in the order in which they first came.
  std::vector<int> events() const;
  /// Intrinsic reward of the last outcome, r_i.
  double intrinsic_reward() const noexcept { return intrinsic_reward_; }
  /// What it makes of a situation; nothing for one never met. Draws and changes nothing. Throws
  /// InvalidValue for a negative situation.
  std::optional<SalientEventsExplanation> explain(SituationId situation) const;

 private:
  using Row = detail::Row;

  // Whose values: Q_B of the behaviour, or Q of an option by its number.
  static constexpr int kBehaviour = -1;
  // Q(s, .) but for Q_B's of motions, which the table has. An action is a motion, 0 ... N - 1, or
  // an option, N and more.
  struct Values {
    std::vector<double> motions;               // of each pair
    std::vector<std::vector<double>> options;  // of each option, by row
    std::vector<double> best;                  // max_a Q(s, a), by row
  };
  struct Option {
    int event = -1;
    std::vector<std::uint8_t> initiation;  // I, by row
    detail::OptionModel model;             // P and R
    Values values;                         // Q
  };

  int options() const noexcept { return static_cast<int>(options_.size()); }
  int actions() const noexcept { return table_.motion_count() + options(); }
  bool is_option(int action) const noexcept { return action >= table_.motion_count(); }
  const Option& option(int number) const { return options_[static_cast<std::size_t>(number)]; }
  Option& option(int number) { return options_[static_cast<std::size_t>(number)]; }
  const Values& values(int whose) const {
    return whose == kBehaviour ? behaviour_ : option(whose).values;
  }
  Values& values(int whose) { return whose == kBehaviour ? behaviour_ : option(whose).values; }

  double intrinsic(double probability) const noexcept;
  int option_for(int event) const noexcept;
  int make_option(int event);
  void fit();

  bool available(int whose, Row row, int action) const noexcept;
  double q(int whose, Row row, int action) const noexcept;
  double best(int whose, Row row) const noexcept;
  void find_best(int whose, Row row);
  void learn(int whose, Row row, int action, double target);

  template <typename Candidate>
  int draw(const Candidate& candidate);
  int draw_greedy(int whose, Row row);
  bool is_greedy(int whose, Row row, int action, std::uint64_t& asked) const;
  int first_motion(int number, Row row) const;

  Config config_;
  detail::ValueTable table_;  // Q_B of motions
  Values behaviour_;
  std::vector<Option> options_;  // in the order in which their events first came
  std::vector<int> running_;     // options under way, the outermost first
  double intrinsic_reward_ = 0.0;
};

}  // namespace devlearn
