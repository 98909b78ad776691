#include "devlearn/iac.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "agent_snapshot.hpp"
#include "candidates.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"
#include "lines.hpp"

namespace devlearn {

using detail::Regions;
using detail::require_reading;

namespace {

constexpr int kMostMotions = 65535;
constexpr std::size_t kSensesOfATrial = 6;

void require_motors(const Motors& motors) {
  require_count("motors.columns", motors.columns, 1, 1000);
  if (motors.values.size() % static_cast<std::size_t>(motors.columns) != 0) {
    throw InvalidValue("motors", std::to_string(motors.values.size()) + " values",
                       "whole rows of " + std::to_string(motors.columns));
  }
  if (motors.rows() > kMostMotions) {
    throw InvalidValue("motors", std::to_string(motors.rows()) + " rows", "at most 65535");
  }
  for (const double value : motors.values) require_reading("motors", value);
}

std::size_t senses_in(const Observation& observation) {
  return observation.senses.empty() ? kSensesOfATrial : observation.senses.size();
}

}  // namespace

Iac::Iac(const Config& config, std::uint64_t seed, Motors motors)
    : config_((config.validate(), config)),
      motors_((require_motors(motors), std::move(motors))),
      random_(seed, "agent") {}

// --- a step --------------------------------------------------------------------------------------

Choice Iac::choose(const Observation& observation) {
  if (waits_) {
    throw InvalidValue("choose", "called while a choice waits for its outcome",
                       "observe or cancel first");
  }
  require(observation);
  prepare(observation);
  const std::vector<double> senses = senses_of(observation);
  learn_last(senses);

  const bool any = config_.epsilon > 0.0 && random_.uniform() < config_.epsilon;
  std::vector<bool> candidates;
  if (any) {
    for (int m = 0; m < motion_count_; ++m) candidates.push_back(observation.allowed(m));
  } else {
    candidates = most_progress(regions_of(senses), observation.allowed);
  }
  const auto candidate = [&](int m) { return candidates[static_cast<std::size_t>(m)]; };
  const int motion =
      nth_candidate(random_.index(count_candidates(motion_count_, candidate)), candidate);
  last_ = point(senses, motion);
  waits_ = true;
  return {motion, Kind::kUnstated};
}

Development Iac::observe(const Outcome& outcome) {
  if (!waits_) throw InvalidValue("observe", "called where no choice waits", "choose first");
  waits_ = false;
  if (outcome.arrived) forget_last();
  return {};
}

void Iac::cancel() {
  if (!waits_) throw InvalidValue("cancel", "called where no choice waits", "choose first");
  waits_ = false;
  forget_last();
}

void Iac::require(const Observation& observation) const {
  require_count("motion_count", observation.motion_count, 1, kMostMotions);
  const int motions = motion_count_ != 0 ? motion_count_ : static_cast<int>(motors_.rows());
  if (motions != 0) require_count("motion_count", observation.motion_count, motions, motions);
  observation.allowed.validate(observation.motion_count);
  const std::size_t senses = senses_in(observation);
  require_size("senses", senses, sense_count_ != 0 ? sense_count_ : senses);
  if (observation.senses.empty()) require_finite("pose.heading", observation.pose.heading);
  for (const double value : senses_of(observation)) require_reading("senses", value);
}

void Iac::prepare(const Observation& observation) {
  if (regions_) return;
  motion_count_ = observation.motion_count;
  sense_count_ = senses_in(observation);
  if (motors_.values.empty()) {
    motors_.columns = 1;
    for (int m = 0; m < motion_count_; ++m) {
      motors_.values.push_back(static_cast<double>(m) / std::max(1, motion_count_ - 1));
    }
  }
  regions_.emplace(Regions::rules(config_),
                   sense_count_ + static_cast<std::size_t>(motors_.columns), sense_count_);
}

std::vector<double> Iac::senses_of(const Observation& seen) const {
  if (!seen.senses.empty()) return {seen.senses.begin(), seen.senses.end()};
  const Direction heading = direction(seen.pose.heading);
  const double length = config_.length;
  return {seen.pose.x / length,
          seen.pose.y / length,
          heading.x,
          heading.y,
          seen.goal_distance / length,
          std::min(seen.clearance / length, 1.0)};
}

// (SM(t), S(t + 1)) is an exemplar now.
void Iac::learn_last(const std::vector<double>& senses) {
  if (!last_.empty()) regions_->learn(last_.data(), senses.data());
  last_.clear();
}

// SM: the senses, then the motion's row.
std::vector<double> Iac::point(const std::vector<double>& senses, int motion) const {
  std::vector<double> point = senses;
  point.insert(point.end(), motors_.row(motion), motors_.row(motion) + motors_.columns);
  return point;
}

std::vector<std::size_t> Iac::regions_of(const std::vector<double>& senses) const {
  std::vector<std::size_t> regions;
  regions.reserve(static_cast<std::size_t>(motion_count_));
  std::vector<double> candidate = point(senses, 0);
  for (int m = 0; m < motion_count_; ++m) {
    std::copy_n(motors_.row(m), motors_.columns,
                candidate.begin() + static_cast<std::ptrdiff_t>(sense_count_));
    regions.push_back(regions_->find(candidate.data()));
  }
  return regions;
}

// Which of the allowed motions fall where the most progress is expected, Eq. 4.
std::vector<bool> Iac::most_progress(const std::vector<std::size_t>& regions,
                                     AllowedMotions allowed) const {
  const auto m = [](std::size_t place) { return static_cast<int>(place); };
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (allowed(m(i))) most = std::max(most, regions_->progress(regions[i]));
  }
  std::vector<bool> best;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    best.push_back(allowed(m(i)) && regions_->progress(regions[i]) == most);
  }
  return best;
}

// --- what it knows -------------------------------------------------------------------------------

std::optional<std::vector<double>> Iac::predict(const Observation& observation, int motion) const {
  require(observation);
  require_count("motion", motion, 0, observation.motion_count - 1);
  if (!regions_) return std::nullopt;
  std::vector<double> next = regions_->predict(point(senses_of(observation), motion).data());
  if (next.empty()) return std::nullopt;
  return next;
}

IacExplanation Iac::explain(const Observation& observation) const {
  require(observation);
  Iac self = *this;  // as choose would find it
  self.prepare(observation);
  IacExplanation why;
  why.senses = senses_of(observation);
  if (!waits_) self.learn_last(why.senses);

  const std::vector<std::size_t> regions = self.regions_of(why.senses);
  const std::vector<bool> best = self.most_progress(regions, observation.allowed);
  for (int m = 0; m < observation.motion_count; ++m) {
    why.allowed.push_back(observation.allowed(m));
  }
  const auto any = static_cast<double>(std::count(why.allowed.begin(), why.allowed.end(), true));
  const auto of_best = static_cast<double>(std::count(best.begin(), best.end(), true));
  for (std::size_t m = 0; m < regions.size(); ++m) {
    why.region.push_back(static_cast<int>(regions[m]));
    why.progress.push_back(self.regions_->progress(regions[m]));
    why.probability.push_back((why.allowed[m] ? config_.epsilon / any : 0.0) +
                              (best[m] ? (1.0 - config_.epsilon) / of_best : 0.0));
  }
  for (const std::size_t number : std::set<std::size_t>(regions.begin(), regions.end())) {
    why.regions.push_back(self.region(number));
  }
  return why;
}

std::vector<IacRegion> Iac::regions() const {
  std::vector<IacRegion> all;
  if (!regions_) return all;
  for (std::size_t number = 0; number < regions_->size(); ++number) all.push_back(region(number));
  return all;
}

IacRegion Iac::region(std::size_t number) const {
  const std::vector<Regions::Split>& splits = regions_->splits();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::size_t dimensions = sense_count_ + static_cast<std::size_t>(motors_.columns);
  IacRegion found;
  found.region = static_cast<int>(number);
  found.lower.assign(dimensions, -infinity);
  found.upper.assign(dimensions, infinity);
  // Region 2 k + 1 is below the cut of split k, and 2 k + 2 is not.
  for (std::size_t at = number; at != 0; at = splits[(at - 1) / 2].region) {
    const Regions::Split& by = splits[(at - 1) / 2];
    double& lower = found.lower[by.dimension];
    double& upper = found.upper[by.dimension];
    if (at % 2 == 1) {
      upper = std::min(upper, by.cut);
    } else {
      lower = std::max(lower, by.cut);
    }
  }
  if (number != 0) {
    const Regions::Split& from = splits[(number - 1) / 2];
    found.parent = static_cast<int>(from.region);
    found.since = from.learned;
  }
  found.exemplars = static_cast<int>(regions_->exemplars(number));
  found.error = regions_->error(number);
  found.progress = regions_->progress(number);
  for (std::size_t k = 0; k < splits.size(); ++k) {
    if (splits[k].region != number) continue;
    found.split_dimension = static_cast<int>(splits[k].dimension);
    found.split_value = splits[k].cut;
    found.below = static_cast<int>(2 * k + 1);
    found.above = static_cast<int>(2 * k + 2);
  }
  return found;
}

namespace {

void append_bounds(std::string& text, const IacRegion& region) {
  for (std::size_t i = 0; i < region.lower.size(); ++i) {
    append(text, "%s[%.4g, %.4g)", i == 0 ? "" : " x ", region.lower[i], region.upper[i]);
  }
}

void append_tree(std::string& text, const std::vector<IacRegion>& regions, int number, int depth) {
  const IacRegion& region = regions[static_cast<std::size_t>(number)];
  text.append(2 * static_cast<std::size_t>(depth), ' ');
  append(text, "%d: ", number);
  if (region.split_dimension >= 0) {
    append(text, "split after %llu at %.4g of dimension %d\n",
           static_cast<unsigned long long>(regions[static_cast<std::size_t>(region.below)].since),
           region.split_value, region.split_dimension);
    append_tree(text, regions, region.below, depth + 1);
    append_tree(text, regions, region.above, depth + 1);
  } else {
    append(text, "%d exemplars, error %.4g, progress %.4g\n", region.exemplars, region.error,
           region.progress);
  }
}

}  // namespace

std::string to_text(const IacExplanation& why) {
  std::string text = "senses";
  for (const double one : why.senses) append(text, " %.4g", one);
  text += "\nregion  exemplars  error       progress    motions  probability  bounds of SM\n";
  for (const IacRegion& region : why.regions) {
    int motions = 0;
    double probability = 0.0;
    for (std::size_t m = 0; m < why.region.size(); ++m) {
      if (why.region[m] != region.region) continue;
      motions += why.allowed[m] ? 1 : 0;
      probability += why.probability[m];
    }
    append(text, "%6d  %-9d  %-10.4g  %-10.4g  %-7d  %-11.4g  ", region.region, region.exemplars,
           region.error, region.progress, motions, probability);
    append_bounds(text, region);
    text += '\n';
  }
  return text;
}

std::string to_text(const std::vector<IacRegion>& regions) {
  std::string text;
  if (!regions.empty()) append_tree(text, regions, 0, 0);
  return text;
}

// --- states --------------------------------------------------------------------------------------

std::optional<AgentState> Iac::state() const {
  AgentState state = state_of(kKind, config_);
  add_entry(state, "motion_count", motion_count_);
  add_entry(state, "sense_count", std::uint64_t{sense_count_});
  add_entry(state, "motor_rows", std::uint64_t{motors_.rows()});
  add_entry(state, "motor_columns", motors_.columns);
  add_entry(state, "last_count", std::uint64_t{last_.size()});
  add_entry(state, "waits", waits_);
  state.arrays["motors"] =
      array_of(motors_.values, {motors_.rows(), static_cast<std::uint64_t>(motors_.columns)});
  state.arrays["last"] = array_of(last_);
  const Random::State words = random_.state();
  state.arrays["random"] = array_of(std::vector<std::uint64_t>(words.begin(), words.end()));
  if (regions_) regions_->describe(state);
  return state;
}

Iac::Iac(const AgentState& state, const std::string& source)
    : config_(config_of<Config>(kKind, state, source)),
      random_(random_of({state.texts, state.arrays}, source)) {
  motion_count_ = entry_of<int>(state, "motion_count", source);
  const auto senses = entry_of<std::uint64_t>(state, "sense_count", source);
  const auto motor_rows = entry_of<std::uint64_t>(state, "motor_rows", source);
  motors_.columns = entry_of<int>(state, "motor_columns", source);
  const auto last = entry_of<std::uint64_t>(state, "last_count", source);
  waits_ = entry_of<bool>(state, "waits", source);
  made_of(source, [&] {
    require_count("motion_count", motion_count_, 0, kMostMotions);
    require_count("motor_columns", motors_.columns, 1, 1000);
    const bool chose = motion_count_ != 0;
    require_size("motor_rows", motor_rows, chose ? std::uint64_t(motion_count_) : motor_rows);
    const std::uint64_t most_senses = 1'000'000;
    require_size("sense_count", senses,
                 chose ? std::clamp<std::uint64_t>(senses, 1, most_senses) : 0);
    const std::uint64_t point = senses + std::uint64_t(motors_.columns);
    require_size("last_count", last, (chose && last != 0) || waits_ ? point : 0);
  });
  sense_count_ = static_cast<std::size_t>(senses);
  motors_.values =
      values_of<double>(state, "motors", {motor_rows, static_cast<std::uint64_t>(motors_.columns)},
                        source, require_reading);
  made_of(source, [&] { require_motors(motors_); });
  last_ = values_of<double>(state, "last", {last}, source, require_reading);
  if (motion_count_ == 0) return;
  regions_.emplace(Regions::rules(config_),
                   sense_count_ + static_cast<std::size_t>(motors_.columns), sense_count_, state,
                   source);
}

}  // namespace devlearn
