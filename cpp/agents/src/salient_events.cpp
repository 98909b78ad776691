#include "devlearn/salient_events.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "agent_snapshot.hpp"
#include "candidates.hpp"
#include "lines.hpp"

namespace devlearn {

using detail::Ending;
using detail::kNoRow;
using detail::Row;
using detail::ValueTable;

namespace {

static_assert(kEventCount <= 64, "a mask of 64 bits has one for each option");
constexpr double kNone = -std::numeric_limits<double>::infinity();

constexpr ValueTable::Rules rules(const SalientEventsConfig& config) {
  return {FirstValue::kConstant, 0.0, Shaping::kNone, config.gamma};
}

}  // namespace

SalientEvents::SalientEvents(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(rules(config), seed) {}

// --- choice: epsilon-greedy over motions and options ---------------------------------------------

Choice SalientEvents::choose(const Observation& observation) {
  const Row row = table_.meet(observation);
  fit();
  for (int whose = kBehaviour; whose < options(); ++whose) find_best(whose, row);

  // An option ends where it could not be begun, and with it all that run within it.
  const auto ended = std::find_if(running_.begin(), running_.end(),
                                  [&](int number) { return option(number).initiation[row] == 0; });
  running_.erase(ended, running_.end());

  // By chance any motion or option, or within an option any motion, after which it goes on.
  const bool within = !running_.empty();
  const int whose = within ? running_.back() : kBehaviour;
  const bool by_chance = config_.epsilon > 0.0 && table_.random().uniform() < config_.epsilon;
  int action = by_chance ? draw([&](int each) {
    return available(whose, row, each) && !(within && is_option(each));
  })
                         : draw_greedy(whose, row);
  while (is_option(action)) {
    running_.push_back(action - table_.motion_count());
    action = draw_greedy(running_.back(), row);
  }
  return table_.wait(row, action);
}

// One of the candidates among the actions, each as likely.
template <typename Candidate>
int SalientEvents::draw(const Candidate& candidate) {
  const std::uint32_t candidates = count_candidates(actions(), candidate);
  return nth_candidate(candidates == 1 ? 0 : table_.random().index(candidates), candidate);
}

// One of the highest value, of those that do not run already: so no option calls itself.
int SalientEvents::draw_greedy(int whose, Row row) {
  const auto idle = [&](int action) {
    return available(whose, row, action) &&
           std::find(running_.begin(), running_.end(), action - table_.motion_count()) ==
               running_.end();
  };
  double highest = kNone;
  for (int action = 0; action < actions(); ++action) {
    if (idle(action)) highest = std::max(highest, q(whose, row, action));
  }
  return draw([&](int action) { return idle(action) && q(whose, row, action) == highest; });
}

// --- learning: the lines of Figure 2, NIPS 2004, in their order ----------------------------------

Development SalientEvents::observe(const Outcome& outcome) {
  require_count("event", outcome.event, -1, kEventCount - 1);
  const auto [s, a, r_e, next] = table_.observe(outcome);
  const double alpha = config_.alpha, gamma = config_.gamma;
  fit();

  // Deal with the special case that the next state is salient.
  const int event = outcome.event;
  double r_i = 0.0;
  int made = options();  // none
  if (event >= 0) {
    const int known = option_for(event);
    const int o_e = known < options() ? known : (made = make_option(event));
    option(o_e).initiation[s] = 1;
    r_i = intrinsic(option(o_e).model.probability(s, next));
  }
  intrinsic_reward_ = r_i;

  // Update all option models, but for that of an option just made.
  for (int number = 0; number < options(); ++number) {
    Option& o = option(number);
    const bool ended = o.event == event;
    if (next != kNoRow && o.initiation[next] != 0) o.initiation[s] = 1;
    std::uint64_t asked = 0;
    if (number == made || !is_greedy(number, s, a, asked)) continue;
    o.model.learn(s, r_e, next, ended, alpha, gamma, static_cast<std::size_t>(config_.endings));
  }

  // Q-learning update of the behaviour's action values.
  learn(kBehaviour, s, a, r_e + r_i + gamma * best(kBehaviour, next));

  // SMDP-planning update of the behaviour's action values.
  for (int number = 0; number < options(); ++number) {
    const Option& o = option(number);
    if (o.initiation[s] == 0) continue;
    const auto worth = [&](Row x) { return best(kBehaviour, x); };
    learn(kBehaviour, s, table_.motion_count() + number,
          o.model.reward(s) + o.model.mean(s, worth));
  }

  // Update the options' action values. No other option ends with this one's event.
  for (int number = 0; number < options(); ++number) {
    if (option(number).initiation[s] == 0) continue;
    const bool ended = option(number).event == event;
    learn(number, s, a, r_e + gamma * (ended ? config_.terminal_value : best(number, next)));
    for (int other = 0; other < options(); ++other) {
      const Option& o = option(other);
      if (other == number || o.initiation[s] == 0) continue;
      const auto worth = [&](Row x) { return best(number, x); };
      learn(number, s, table_.motion_count() + other, o.model.reward(s) + o.model.mean(s, worth));
    }
  }

  // What runs ends with its event, and all ends with an arrival.
  const auto ended = std::find_if(running_.begin(), running_.end(), [&](int number) {
    return outcome.arrived || option(number).event == event;
  });
  running_.erase(ended, running_.end());
  return {};
}

// Intrinsic reward of an option's event. Of P the discount of the one step is taken out: with it,
// what is foreseen would go on being rewarded with tau (1 - gamma).
double SalientEvents::intrinsic(double probability) const noexcept {
  return config_.tau * std::max(0.0, 1.0 - probability / config_.gamma);
}

// Its number; options() where there is none.
int SalientEvents::option_for(int event) const noexcept {
  const auto found = std::find_if(options_.begin(), options_.end(),
                                  [&](const Option& each) { return each.event == event; });
  return static_cast<int>(found - options_.begin());
}

int SalientEvents::make_option(int event) {
  options_.emplace_back();
  options_.back().event = event;
  fit();
  return options() - 1;
}

// Room for all situations met, and all options: whenever there are more of either.
void SalientEvents::fit() {
  const std::size_t rows = table_.rows();
  const auto fit_values = [&](Values& values, std::size_t pairs) {
    values.motions.resize(pairs);
    values.options.resize(options_.size());
    for (auto& of_option : values.options) of_option.resize(rows);
    values.best.resize(rows);
  };
  fit_values(behaviour_, 0);
  for (Option& each : options_) {
    each.initiation.resize(rows);
    each.model.fit(rows);
    fit_values(each.values, table_.pairs());
  }
}

// Whether a motion is greedy for an option: its own best one, or that of an option that is. `asked`
// has the options that were asked already.
bool SalientEvents::is_greedy(int number, Row row, int motion, std::uint64_t& asked) const {
  asked |= std::uint64_t{1} << number;
  const double highest = best(number, row);
  if (q(number, row, motion) == highest) return true;
  for (int other = 0; other < options(); ++other) {
    const int action = table_.motion_count() + other;
    if ((asked >> other & 1) == 0 && available(number, row, action) &&
        q(number, row, action) == highest && is_greedy(other, row, motion, asked)) {
      return true;
    }
  }
  return false;
}

// --- values --------------------------------------------------------------------------------------

bool SalientEvents::available(int whose, Row row, int action) const noexcept {
  if (!is_option(action)) return table_.allowed(row, action);
  const int number = action - table_.motion_count();
  return number != whose && option(number).initiation[row] != 0;
}

double SalientEvents::q(int whose, Row row, int action) const noexcept {
  if (is_option(action)) {
    return values(whose).options[static_cast<std::size_t>(action - table_.motion_count())][row];
  }
  const std::size_t pair = table_.pair(row, action);
  return whose == kBehaviour ? table_.q(pair) : values(whose).motions[pair];
}

double SalientEvents::best(int whose, Row row) const noexcept {
  return row == kNoRow ? 0.0 : values(whose).best[row];
}

void SalientEvents::find_best(int whose, Row row) {
  double highest = kNone;
  for (int action = 0; action < actions(); ++action) {
    if (available(whose, row, action)) highest = std::max(highest, q(whose, row, action));
  }
  values(whose).best[row] = highest;
}

// Q <- Q + alpha (target - Q)
void SalientEvents::learn(int whose, Row row, int action, double target) {
  const std::size_t pair = table_.pair(row, action);
  if (whose == kBehaviour && !is_option(action)) {
    table_.learn(pair, config_.alpha, target);
  } else {
    double& value =
        is_option(action)
            ? values(whose).options[static_cast<std::size_t>(action - table_.motion_count())][row]
            : values(whose).motions[pair];
    value = ValueTable::bounded(value + config_.alpha * (target - value));
  }
  find_best(whose, row);
}

// --- what it makes of a situation ----------------------------------------------------------------

std::vector<int> SalientEvents::events() const {
  std::vector<int> events;
  for (const Option& each : options_) events.push_back(each.event);
  return events;
}

// What an option does first, the first among equals.
int SalientEvents::first_motion(int number, Row row) const {
  std::uint64_t asked = 0;
  for (;;) {
    asked |= std::uint64_t{1} << number;
    int first = -1;
    for (int action = 0; action < actions(); ++action) {
      if (!available(number, row, action)) continue;
      if (is_option(action) && (asked >> (action - table_.motion_count()) & 1) != 0) continue;
      if (first < 0 || q(number, row, action) > q(number, row, first)) first = action;
    }
    if (!is_option(first)) return first;
    number = first - table_.motion_count();
  }
}

std::optional<SalientEventsExplanation> SalientEvents::explain(SituationId situation) const {
  const std::optional<std::size_t> found = table_.find(situation, 0);
  if (!found) return std::nullopt;
  const auto row = static_cast<Row>(*found / static_cast<std::size_t>(table_.motion_count()));
  SalientEventsExplanation why;
  why.situation = situation;
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    why.allowed.push_back(table_.allowed(row, motion));
    why.value.push_back(table_.q(table_.pair(row, motion)));
  }
  for (int number = 0; number < options(); ++number) {
    const Option& o = option(number);
    OptionView view;
    view.event = o.event;
    view.available = o.initiation[row] != 0;
    view.probability = o.model.probability(row);
    double expected = 0.0;
    for (const Ending& ending : o.model.endings(row)) {
      expected = std::max(expected, ending.probability);
    }
    view.intrinsic = intrinsic(expected);
    view.value = q(kBehaviour, row, table_.motion_count() + number);
    if (view.available) view.motion = first_motion(number, row);
    why.options.push_back(view);
  }
  for (const int number : running_) why.running.push_back(option(number).event);
  return why;
}

std::string to_text(const SalientEventsExplanation& why) {
  std::string text = "situation " + std::to_string(why.situation) + ": ";
  text += why.running.empty() ? "no option runs" : "options run for the events";
  for (const int event : why.running) text += " " + std::to_string(event);
  text += "\nmotion  value\n";
  for (std::size_t i = 0; i < why.value.size(); ++i) {
    append(text, "%6d  %.4g%s\n", static_cast<int>(i), why.value[i],
           why.allowed[i] ? "" : "  (not allowed)");
  }
  if (why.options.empty()) return text;
  text += "option for event  value       probability  intrinsic reward  first motion\n";
  for (const OptionView& view : why.options) {
    append(text, "%16d  %-10.4g  %-11.4g  %-16.4g  ", view.event, view.value, view.probability,
           view.intrinsic);
    text += view.available ? std::to_string(view.motion) : "(not available)";
    text += "\n";
  }
  return text;
}

// --- states --------------------------------------------------------------------------------------

std::optional<AgentState> SalientEvents::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  const std::uint64_t rows = table_.rows(), count = options_.size();
  const auto motions = static_cast<std::uint64_t>(table_.motion_count());
  add_entry(state, "options", count);
  add_entry(state, "running_options", std::uint64_t{running_.size()});
  add_entry(state, "intrinsic_reward", intrinsic_reward_);

  std::vector<std::uint8_t> initiation;
  std::vector<double> reward, of_motions, of_options, probability;
  std::vector<std::uint32_t> endings;
  std::vector<Row> ending_row;
  const auto add = [](auto& all_of_them, const auto& more) {
    all_of_them.insert(all_of_them.end(), more.begin(), more.end());
  };
  for (const auto& values : behaviour_.options) add(of_options, values);
  for (const Option& each : options_) {
    add(initiation, each.initiation);
    add(of_motions, each.values.motions);
    for (const auto& values : each.values.options) add(of_options, values);
    for (Row row = 0; row < rows; ++row) {
      reward.push_back(each.model.reward(row));
      endings.push_back(static_cast<std::uint32_t>(each.model.endings(row).size()));
      for (const Ending& ending : each.model.endings(row)) {
        ending_row.push_back(ending.row);
        probability.push_back(ending.probability);
      }
    }
  }
  add_entry(state, "ending_count", std::uint64_t{ending_row.size()});
  state.arrays["event"] = array_of(events());
  state.arrays["initiation"] = array_of(std::move(initiation), {count, rows});
  state.arrays["option_q"] = array_of(std::move(of_motions), {count, rows, motions});
  // Of the behaviour, then of each option: the values of options.
  state.arrays["value_of_option"] = array_of(std::move(of_options), {count + 1, count, rows});
  state.arrays["option_reward"] = array_of(std::move(reward), {count, rows});
  state.arrays["row_endings"] = array_of(std::move(endings), {count, rows});
  state.arrays["ending_row"] = array_of(std::move(ending_row));
  state.arrays["ending_probability"] = array_of(std::move(probability));
  state.arrays["running"] = array_of(running_);
  return state;
}

SalientEvents::SalientEvents(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(rules(config_), state, source),
      intrinsic_reward_(entry_of<double>(state, "intrinsic_reward", source)) {
  const std::uint64_t rows = table_.rows();
  const auto motions = static_cast<std::uint64_t>(table_.motion_count());
  const auto count = entry_of<std::uint64_t>(state, "options", source);
  made_of(source, [&] {
    require_count("options", static_cast<long long>(std::min<std::uint64_t>(count, 1000)), 0,
                  rows == 0 ? 0 : kEventCount);
    ValueTable::require_bounded("intrinsic_reward", intrinsic_reward_);
  });
  values_of<int>(state, "event", {count}, source, [&](const char* name, int event) {
    require_count(name, event, 0, kEventCount - 1);
    if (option_for(event) < options()) {
      throw InvalidValue(name, std::to_string(event), "each event once");
    }
    options_.emplace_back();
    options_.back().event = event;
  });
  fit();

  const auto initiation = values_of<std::uint8_t>(
      state, "initiation", {count, rows}, source,
      [](const char* name, std::uint8_t value) { require_count(name, value, 0, 1); });
  const auto of_motions = values_of<double>(state, "option_q", {count, rows, motions}, source,
                                            ValueTable::require_bounded);
  const auto of_options = values_of<double>(state, "value_of_option", {count + 1, count, rows},
                                            source, ValueTable::require_bounded);
  const auto reward =
      values_of<double>(state, "option_reward", {count, rows}, source, ValueTable::require_bounded);
  const auto endings = values_of<std::uint32_t>(state, "row_endings", {count, rows}, source,
                                                [&](const char* name, std::uint32_t value) {
                                                  require_count(name, value, 0, config_.endings);
                                                });
  const auto ending_count = entry_of<std::uint64_t>(state, "ending_count", source);
  std::uint64_t sum = 0;
  for (const std::uint32_t each : endings) sum += each;
  if (sum != ending_count) {
    throw FileError(source, "ending_count", std::to_string(ending_count), std::to_string(sum));
  }
  const auto ending_row =
      values_of<Row>(state, "ending_row", {sum}, source, [&](const char* name, Row row) {
        if (row >= rows && row != kNoRow) {
          throw InvalidValue(name, std::to_string(row), "a row of the table, or an arrival");
        }
      });
  const auto probability =
      values_of<double>(state, "ending_probability", {sum}, source,
                        [](const char* name, double value) { require_in(name, value, 0.0, 1.0); });

  const auto copy = [](auto from, auto& to) {
    std::copy_n(from, to.size(), to.begin());
    return from + static_cast<std::ptrdiff_t>(to.size());
  };
  auto initiated = initiation.begin();
  auto of_motion = of_motions.begin();
  auto of_option = of_options.begin();
  for (auto& values : behaviour_.options) of_option = copy(of_option, values);
  std::size_t place = 0, ending = 0;
  for (Option& each : options_) {
    initiated = copy(initiated, each.initiation);
    of_motion = copy(of_motion, each.values.motions);
    for (auto& values : each.values.options) of_option = copy(of_option, values);
    for (Row row = 0; row < rows; ++row, ++place) {
      std::vector<Ending> of_row;
      for (std::uint32_t i = 0; i < endings[place]; ++i, ++ending) {
        if (i > 0 && ending_row[ending] <= of_row.back().row) {
          throw FileError(source, "ending_row", std::to_string(ending_row[ending]),
                          "rows in ascending order");
        }
        of_row.push_back({ending_row[ending], probability[ending]});
      }
      each.model.set(row, reward[place], std::move(of_row));
    }
  }
  for (int whose = kBehaviour; whose < options(); ++whose) {
    for (Row row = 0; row < rows; ++row) find_best(whose, row);
  }

  const auto running = entry_of<std::uint64_t>(state, "running_options", source);
  if (running > count) {
    throw FileError(source, "running_options", std::to_string(running), "as many as there are");
  }
  running_.reserve(running);
  values_of<int>(state, "running", {running}, source, [&](const char* name, int number) {
    require_count(name, number, 0, options() - 1);
    if (std::find(running_.begin(), running_.end(), number) != running_.end()) {
      throw InvalidValue(name, std::to_string(number), "each option once");
    }
    running_.push_back(number);
  });
}

}  // namespace devlearn
