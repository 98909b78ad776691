#include "devlearn/operant_conditioning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "agent_snapshot.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "lines.hpp"

namespace devlearn {

using detail::Row;

OperantConditioning::OperantConditioning(const Config& config, std::uint64_t seed)
    : config_((config.validate(), config)), table_({}, seed) {}

// What is left to the motions that are allowed. That of all is 1, whatever rounding left.
template <typename Allowed>
OperantConditioning::Share OperantConditioning::share_of(Row row, const Allowed& allowed) const {
  Share share{0.0, 0};
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    if (!allowed(motion)) continue;
    share.sum += table_.q(table_.pair(row, motion));
    ++share.count;
  }
  if (share.count == table_.motion_count()) share.sum = 1.0;
  return share;
}

// --- a step --------------------------------------------------------------------------------------

Choice OperantConditioning::choose(const Observation& observation) {
  const Row row = table_.meet(observation);
  fit();
  const double sum = share_of(row, observation.allowed).sum;
  if (!(sum > 0.0)) return table_.choose(row, 1.0);
  double draw = sum * table_.random().uniform();
  int chosen = -1;
  for (int motion = 0; motion < table_.motion_count() && !(draw < 0.0); ++motion) {
    const double p = table_.q(table_.pair(row, motion));
    if (!table_.allowed(row, motion) || !(p > 0.0)) continue;
    chosen = motion;
    draw -= p;
  }
  return table_.wait(row, chosen);
}

Development OperantConditioning::observe(const Outcome& outcome) {
  require_finite("smf", outcome.smf);
  const auto [row, motion, reward, next] = table_.observe(outcome);
  fit();
  const int reinforcement = judge(row, outcome.smf, reward);
  learn(row, motion, reinforcement);
  Counts& counts = counts_[table_.pair(row, motion)];
  ++counts.tried;
  counts.reinforced += reinforcement > 0 ? 1 : 0;
  counts.extinguished += reinforcement < 0 ? 1 : 0;
  last_[row].motion = motion;
  last_[row].reinforcement = reinforcement;
  return {};
}

// What came, by its sign; and the mean of the rewards, with this one.
int OperantConditioning::judge(Row row, double smf, double reward) {
  std::uint64_t before = 0;
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    before += counts_[table_.pair(row, motion)].tried;
  }
  double& mean = last_[row].mean_reward;
  const double better = before == 0 ? 0.0 : reward - mean;
  mean += (reward - mean) / (static_cast<double>(before) + 1.0);
  const double told = config_.reinforced_by == ReinforcedBy::kSmf ? smf : better;
  return told > 0.0 ? 1 : told < 0.0 ? -1 : 0;
}

void OperantConditioning::learn(Row row, int motion, int reinforcement) {
  const auto [sum, count] = share_of(row, [&](int one) { return table_.allowed(row, one); });
  if (reinforcement == 0 || count == 1) return;
  const double step = reinforcement > 0 ? config_.reward_step : config_.penalty_step;
  const double to_chosen = reinforcement > 0 ? step * sum : 0.0;
  const double to_others = reinforcement > 0 ? 0.0 : step * sum / (count - 1);
  for (int one = 0; one < table_.motion_count(); ++one) {
    if (!table_.allowed(row, one)) continue;
    const std::size_t pair = table_.pair(row, one);
    const double added = one == motion ? to_chosen : to_others;
    table_.set(pair, std::min((1.0 - step) * table_.q(pair) + added, 1.0));
  }
}

// Room for all situations met; in new ones each motion is as likely.
void OperantConditioning::fit() {
  counts_.resize(table_.pairs());
  while (last_.size() < table_.rows()) {
    const auto row = static_cast<Row>(last_.size());
    for (int motion = 0; motion < table_.motion_count(); ++motion) {
      table_.set(table_.pair(row, motion), 1.0 / table_.motion_count());
    }
    last_.emplace_back();
  }
}

// --- what it has come to -------------------------------------------------------------------------

double OperantConditioning::entropy_of(Row row) const noexcept {
  double sum = 0.0;
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    const double p = table_.q(table_.pair(row, motion));
    if (p > 0.0) sum -= p * std::log2(p);
  }
  return std::max(sum, 0.0);
}

std::optional<double> OperantConditioning::entropy(SituationId situation) const {
  const std::optional<std::size_t> pair = table_.find(situation, 0);
  if (!pair) return std::nullopt;
  return entropy_of(static_cast<Row>(*pair / static_cast<std::size_t>(table_.motion_count())));
}

std::optional<double> OperantConditioning::mean_entropy() const {
  if (table_.rows() == 0) return std::nullopt;
  double sum = 0.0;
  for (Row row = 0; row < table_.rows(); ++row) sum += entropy_of(row);
  return sum / static_cast<double>(table_.rows());
}

std::optional<ConditioningExplanation> OperantConditioning::explain(SituationId situation,
                                                                    AllowedMotions allowed) const {
  const std::optional<std::size_t> pair = table_.find(situation, 0);
  if (!pair) return std::nullopt;
  allowed.validate(table_.motion_count());
  const auto row = static_cast<Row>(*pair / static_cast<std::size_t>(table_.motion_count()));
  ConditioningExplanation why;
  why.situation = situation;
  const auto [sum, count] = share_of(row, allowed);
  for (int motion = 0; motion < table_.motion_count(); ++motion) {
    const double p = table_.q(table_.pair(row, motion));
    const Counts& counts = counts_[table_.pair(row, motion)];
    why.allowed.push_back(allowed(motion));
    why.probability.push_back(!allowed(motion) ? 0.0 : sum > 0.0 ? p / sum : 1.0 / count);
    why.tried.push_back(counts.tried);
    why.reinforced.push_back(counts.reinforced);
    why.extinguished.push_back(counts.extinguished);
  }
  why.entropy = entropy_of(row);
  why.mean_reward = last_[row].mean_reward;
  why.last_motion = last_[row].motion;
  why.last_reinforcement = last_[row].reinforcement;
  return why;
}

std::string to_text(const ConditioningExplanation& why) {
  std::string text = "situation " + std::to_string(why.situation);
  append(text, ": entropy %.4g bits, mean reward %.4g", why.entropy, why.mean_reward);
  if (why.last_motion >= 0) {
    append(text, "; motion %d was last %s", why.last_motion,
           why.last_reinforcement > 0   ? "reinforced"
           : why.last_reinforcement < 0 ? "extinguished"
                                        : "neither reinforced nor extinguished");
  }
  text += "\nmotion  probability  tried  reinforced  extinguished\n";
  for (std::size_t motion = 0; motion < why.probability.size(); ++motion) {
    append(text, "%6d  %-11.4g  %-5llu  %-10llu  %llu%s\n", static_cast<int>(motion),
           why.probability[motion], static_cast<unsigned long long>(why.tried[motion]),
           static_cast<unsigned long long>(why.reinforced[motion]),
           static_cast<unsigned long long>(why.extinguished[motion]),
           why.allowed[motion] ? "" : "  (not allowed)");
  }
  return text;
}

// --- states --------------------------------------------------------------------------------------

std::optional<AgentState> OperantConditioning::state() const {
  AgentState state = state_of(kKind, config_);
  table_.describe(state);
  std::vector<std::uint64_t> tried, reinforced, extinguished;
  for (const Counts& counts : counts_) {
    tried.push_back(counts.tried);
    reinforced.push_back(counts.reinforced);
    extinguished.push_back(counts.extinguished);
  }
  std::vector<std::int32_t> motion, reinforcement;
  std::vector<double> mean_reward;
  for (const Last& last : last_) {
    motion.push_back(last.motion);
    reinforcement.push_back(last.reinforcement);
    mean_reward.push_back(last.mean_reward);
  }
  const std::uint64_t rows = table_.rows();
  const Shape pairs{rows, static_cast<std::uint64_t>(table_.motion_count())};
  state.arrays["tried"] = array_of(std::move(tried), pairs);
  state.arrays["reinforced"] = array_of(std::move(reinforced), pairs);
  state.arrays["extinguished"] = array_of(std::move(extinguished), pairs);
  state.arrays["last_motion"] = array_of(std::move(motion), {rows});
  state.arrays["last_reinforcement"] = array_of(std::move(reinforcement), {rows});
  state.arrays["mean_reward"] = array_of(std::move(mean_reward), {rows});
  return state;
}

OperantConditioning::OperantConditioning(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)), table_({}, state, source) {
  constexpr double kNearOne = 1e-6;
  for (Row row = 0; row < table_.rows(); ++row) {
    double sum = 0.0;
    for (int motion = 0; motion < table_.motion_count(); ++motion) {
      const double p = table_.q(table_.pair(row, motion));
      made_of(source, [&] { require_in("q", p, 0.0, 1.0); });
      sum += p;
    }
    if (!(std::abs(sum - 1.0) < kNearOne)) {
      throw FileError(source, "q", to_text(sum) + " together", "1 in each situation");
    }
  }
  const std::uint64_t rows = table_.rows();
  const Shape pairs{rows, static_cast<std::uint64_t>(table_.motion_count())};
  const auto count = [](const char* name, std::uint64_t times) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
    if (times > kMost) throw InvalidValue(name, std::to_string(times), "at most 2^53");
  };
  const auto tried = values_of<std::uint64_t>(state, "tried", pairs, source, count);
  const auto reinforced = values_of<std::uint64_t>(state, "reinforced", pairs, source, count);
  const auto extinguished = values_of<std::uint64_t>(state, "extinguished", pairs, source, count);
  for (std::size_t pair = 0; pair < table_.pairs(); ++pair) {
    if (reinforced[pair] + extinguished[pair] > tried[pair]) {
      throw FileError(source, "tried", std::to_string(tried[pair]),
                      "at least as often as reinforced and extinguished");
    }
    counts_.push_back({tried[pair], reinforced[pair], extinguished[pair]});
  }
  const auto motion = values_of<std::int32_t>(
      state, "last_motion", {rows}, source, [&](const char* name, std::int32_t last) {
        require_count(name, last, -1, table_.motion_count() - 1);
      });
  const auto reinforcement = values_of<std::int32_t>(
      state, "last_reinforcement", {rows}, source,
      [](const char* name, std::int32_t last) { require_count(name, last, -1, 1); });
  const auto mean_reward =
      values_of<double>(state, "mean_reward", {rows}, source, detail::ValueTable::require_bounded);
  for (Row row = 0; row < table_.rows(); ++row) {
    last_.push_back({motion[row], reinforcement[row], mean_reward[row]});
  }
}

}  // namespace devlearn
