#include "devlearn/appraisal.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "agent_snapshot.hpp"
#include "lines.hpp"

namespace devlearn {

using detail::kNoRow;
using detail::ValueTable;

namespace {

// base^-n, by multiplications alone: the same on every machine.
double decayed(double base, std::uint64_t n) {
  double power = 1.0;
  for (double factor = 1.0 / base; n != 0; n >>= 1, factor *= factor) {
    if (n & 1) power *= factor;
  }
  return power;
}

// The mean of n values, when `value` is the last of them.
double mean(double before, double value, std::uint64_t n) {
  return before + (value - before) / static_cast<double>(n);
}

// Q over V, the highest of such Q: 1 for the best, less for others, in [0, 1].
double share(double q, double best) {
  return std::clamp(best > 0.0 ? q / best : best / q, 0.0, 1.0);
}

}  // namespace

Appraisal::Appraisal(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_(rules(config), seed), epsilon_(config.epsilon) {}

Choice Appraisal::choose(const Observation& observation) {
  const Row row = table_.meet(observation);
  fit();
  rank(row);  // where other motions are allowed than before
  aim();
  return table_.choose(row, epsilon_);
}

Development Appraisal::observe(const Outcome& outcome) {
  const auto [row, motion, external, next] = table_.observe(outcome);
  const std::size_t pair = table_.pair(row, motion);
  fit();
  const double novel = novelty(row, motion);  // before this visit counts
  if (model_.learn(pair, next) && next != kNoRow) shorten(next);
  learn(kExternal, pair, external, next);
  aim();
  Appraisals now = appraise(row, motion);
  now.novelty = novel;
  learn(kAppraised, pair, weighted(now, external), next);
  epsilon_ /= config_.epsilon_decay;
  return {};
}

// --- appraisals ----------------------------------------------------------------------------------

double Appraisal::novelty(Row row, int motion) const noexcept {
  std::uint64_t visits = 0;
  for (int any = 0; any < table_.motion_count(); ++any) {
    visits += model_.visits(table_.pair(row, any));
  }
  return 0.5 * decayed(config_.novelty_decay, visits) +
         0.5 * decayed(config_.novelty_decay, model_.visits(table_.pair(row, motion)));
}

Appraisal::Appraisals Appraisal::appraise(Row row, int motion) const noexcept {
  const std::size_t pair = table_.pair(row, motion);
  const double highest = -ranked_.begin()->first, lowest = -ranked_.rbegin()->first;
  const double worth = worth_[row];

  Appraisals a{};
  a.novelty = novelty(row, motion);
  if (distance_[row] >= 0) a.motivation = 1.0 / (1.0 + static_cast<double>(distance_[row]));
  a.control = std::clamp(1.0 - change_[pair], 0.0, 1.0);
  if (worth != 0.0 && highest > lowest) {
    a.valence = 0.5 * share(external_[pair], worth) + 0.5 * (worth - lowest) / (highest - lowest);
  }
  return a;
}

double Appraisal::weighted(const Appraisals& a, double external) const noexcept {
  return ValueTable::bounded(config_.novelty * a.novelty + config_.motivation * a.motivation +
                             config_.control * a.control + config_.valence * a.valence +
                             config_.external * external);
}

// --- values --------------------------------------------------------------------------------------

double Appraisal::q(Of of, std::size_t pair) const noexcept {
  return of == kAppraised ? table_.q(pair) : external_[pair];
}

double Appraisal::best(Of of, Row row) const noexcept {
  if (row == kNoRow) return 0.0;
  return of == kAppraised ? table_.max(row) : worth_[row];
}

void Appraisal::set(Of of, std::size_t pair, double value) {
  if (of == kAppraised) {
    table_.set(pair, value);
    return;
  }
  const double before = external_[pair];
  external_[pair] = ValueTable::bounded(value);
  change_[pair] = mean(change_[pair], std::abs(external_[pair] - before), ++updates_[pair]);
  rank(static_cast<Row>(pair / static_cast<std::size_t>(table_.motion_count())));
}

double Appraisal::priority(Of of, std::size_t pair, double reward, Row next) const noexcept {
  return std::abs(reward + config_.gamma * best(of, next) - q(of, pair));
}

// Prioritized sweeping from the pair that was just tried. Each pair is updated once at most, by a
// situation drawn from what it led to; what led to one that changed is queued.
void Appraisal::learn(Of of, std::size_t pair, double reward, Row next) {
  std::vector<double>& mean_reward = reward_[of];
  mean_reward[pair] = mean(mean_reward[pair], reward, model_.visits(pair));
  // A heap of the priorities, and pairs; among equals the first of these.
  std::vector<std::pair<double, std::size_t>> queue;
  const auto later = [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  const auto add = [&](std::size_t one, double reward_of_it, Row to) {
    const double by = priority(of, one, reward_of_it, to);
    if (!(by > config_.theta)) return;
    queue.emplace_back(by, one);
    std::push_heap(queue.begin(), queue.end(), later);
  };
  std::vector<std::size_t> updated;
  add(pair, reward, next);
  for (int i = 0; i < config_.planning_steps && !queue.empty();) {
    std::pop_heap(queue.begin(), queue.end(), later);
    const std::size_t first = queue.back().second;
    queue.pop_back();
    if (updated_[first]) continue;
    updated_[first] = true;
    updated.push_back(first);
    const Row to = model_.draw(first, table_.random());
    const double target = mean_reward[first] + config_.gamma * best(of, to);
    set(of, first, q(of, first) + config_.alpha * (target - q(of, first)));
    ++i;
    const auto row = static_cast<Row>(first / static_cast<std::size_t>(table_.motion_count()));
    for (const std::size_t before : model_.leading(row)) {
      if (!updated_[before]) add(before, mean_reward[before], row);
    }
  }
  for (const std::size_t one : updated) updated_[one] = false;
}

// --- the goal ------------------------------------------------------------------------------------

// Room for all situations met, of which nothing is known.
void Appraisal::fit() {
  model_.fit(table_);
  for (std::vector<double>* each :
       {&reward_[kExternal], &reward_[kAppraised], &external_, &change_}) {
    each->resize(table_.pairs());
  }
  updates_.resize(table_.pairs());
  updated_.resize(table_.pairs());
  distance_.resize(table_.rows(), -1);
  while (worth_.size() < table_.rows()) {
    ranked_.emplace(0.0, static_cast<Row>(worth_.size()));
    worth_.push_back(0.0);
  }
}

// V_e of a row, as its values are now.
void Appraisal::rank(Row row) {
  bool any = false;
  double worth = 0.0;
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    if (!table_.allowed(row, motion)) continue;
    const double one = external_[table_.pair(row, motion)];
    worth = any ? std::max(worth, one) : one;
    any = true;
  }
  if (worth == worth_[row]) return;
  auto node = ranked_.extract({-worth_[row], row});
  worth_[row] = worth;
  node.value() = {-worth, row};
  ranked_.insert(std::move(node));
}

// The goal is the situation of the highest V_e, the first met among equals; none while all are
// equal. Distances are anew those from it, if it is another.
void Appraisal::aim() {
  const bool any = ranked_.begin()->first < ranked_.rbegin()->first;
  const Row goal = any ? ranked_.begin()->second : kNoRow;
  if (goal == goal_) return;
  goal_ = goal;
  std::fill(distance_.begin(), distance_.end(), std::int64_t{-1});
  if (goal == kNoRow) return;
  distance_[goal] = 0;
  shorten(goal);
}

// Ways that lead through a row may be shorter now, by all transitions seen.
void Appraisal::shorten(Row row) {
  if (distance_[row] < 0) return;
  std::deque<Row> queue{row};
  for (; !queue.empty(); queue.pop_front()) {
    const std::int64_t through = distance_[queue.front()] + 1;
    for (const std::size_t pair : model_.leading(queue.front())) {
      const auto before = static_cast<Row>(pair / static_cast<std::size_t>(table_.motion_count()));
      if (distance_[before] >= 0 && distance_[before] <= through) continue;
      distance_[before] = through;
      queue.push_back(before);
    }
  }
}

// --- explanations --------------------------------------------------------------------------------

std::optional<AppraisalExplanation> Appraisal::explain(SituationId situation) const {
  const std::optional<std::size_t> first = table_.find(situation, 0);
  if (!first) return std::nullopt;
  const auto row = static_cast<Row>(*first / static_cast<std::size_t>(table_.motion_count()));
  AppraisalExplanation why;
  why.situation = situation;
  why.config = config_;
  why.epsilon = epsilon_;
  why.goal = goal_ == kNoRow ? -1 : table_.situation(goal_);
  why.goal_distance = distance_[row];
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    const std::size_t pair = table_.pair(row, motion);
    const Appraisals a = appraise(row, motion);
    why.allowed.push_back(table_.allowed(row, motion));
    why.visits.push_back(model_.visits(pair));
    why.novelty.push_back(a.novelty);
    why.motivation = a.motivation;
    why.control.push_back(a.control);
    why.valence.push_back(a.valence);
    why.external.push_back(reward_[kExternal][pair]);
    why.reward.push_back(weighted(a, reward_[kExternal][pair]));
    why.value.push_back(table_.q(pair));
    why.external_value.push_back(external_[pair]);
  }
  return why;
}

std::string to_text(const AppraisalExplanation& why) {
  std::string text = "situation " + std::to_string(why.situation);
  append(text, ": epsilon %.3g, ", why.epsilon);
  if (why.goal < 0) {
    text += "no goal as yet\n";
  } else {
    text += "goal " + std::to_string(why.goal) + ", ";
    text += why.goal_distance < 0 ? "no way known\n"
                                  : std::to_string(why.goal_distance) + " motions away\n";
  }
  text +=
      "motion  novelty  motivation  control  valence  external  reward    Q         Q external  "
      "tried\n";
  append(text, "weight  %-7.3g  %-10.3g  %-7.3g  %-7.3g  %-8.3g\n", why.config.novelty,
         why.config.motivation, why.config.control, why.config.valence, why.config.external);
  for (std::size_t motion = 0; motion < why.allowed.size(); ++motion) {
    append(text, "%6zu  %-7.3f  %-10.3f  %-7.3f  %-7.3f  %-8.3g  %-8.3g  %-8.3g  %-10.3g  %u%s\n",
           motion, why.novelty[motion], why.motivation, why.control[motion], why.valence[motion],
           why.external[motion], why.reward[motion], why.value[motion], why.external_value[motion],
           why.visits[motion], why.allowed[motion] ? "" : "  (not allowed)");
  }
  return text;
}

// --- states --------------------------------------------------------------------------------------

std::optional<AgentState> Appraisal::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  model_.describe(state);
  add_entry(state, "epsilon_now", epsilon_);
  const Shape shape{table_.rows(), static_cast<std::uint64_t>(table_.motion_count())};
  state.arrays["external_reward"] = array_of(reward_[kExternal], shape);
  state.arrays["appraised_reward"] = array_of(reward_[kAppraised], shape);
  state.arrays["external_q"] = array_of(external_, shape);
  state.arrays["external_change"] = array_of(change_, shape);
  state.arrays["external_updates"] = array_of(updates_, shape);
  return state;
}

Appraisal::Appraisal(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      table_(rules(config_), state, source),
      model_(table_, state, source),
      epsilon_(entry_of<double>(state, "epsilon_now", source)) {
  made_of(source, [&] { require_in("epsilon_now", epsilon_, 0.0, config_.epsilon); });
  const Shape shape{table_.rows(), static_cast<std::uint64_t>(table_.motion_count())};
  const auto bounded = [&](const char* name) {
    return values_of<double>(state, name, shape, source, ValueTable::require_bounded);
  };
  reward_ = {bounded("external_reward"), bounded("appraised_reward")};
  external_ = bounded("external_q");
  change_ = values_of<double>(
      state, "external_change", shape, source,
      [](const char* name, double change) { require_in(name, change, 0.0, 2e100); });
  updates_ = values_of<std::uint64_t>(
      state, "external_updates", shape, source, [](const char* name, std::uint64_t updates) {
        if (updates >= std::uint64_t{1} << 53) {
          throw InvalidValue(name, std::to_string(updates), "below 2^53");
        }
      });
  fit();
  for (Row row = 0; row < table_.rows(); ++row) rank(row);
  if (table_.rows() > 0) aim();
}

}  // namespace devlearn
