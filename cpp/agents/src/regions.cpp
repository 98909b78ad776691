#include "devlearn/detail/regions.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "agent_snapshot.hpp"

namespace devlearn::detail {
namespace {

double square(double value) noexcept { return value * value; }

double squared_distance(const double* a, const double* b, std::size_t count) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += square(a[i] - b[i]);
  return sum;
}

double mean(const double* first, int count) noexcept {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += first[i];
  return sum / count;
}

// Of vectors that come and go: |Gamma| sigma(Gamma), the sum of their squared distances from their
// mean.
class Spread {
 public:
  explicit Spread(std::size_t length) : sum_(length) {}
  void add(const double* vector, double sign) noexcept {
    count_ += sign;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      sum_[i] += sign * vector[i];
      squares_ += sign * square(vector[i]);
    }
  }
  double value() const noexcept {
    double of_mean = 0.0;
    for (const double one : sum_) of_mean += square(one);
    return squares_ - of_mean / count_;
  }

 private:
  std::vector<double> sum_;
  double squares_ = 0.0, count_ = 0.0;
};

}  // namespace

void require_reading(const char* quantity, double value) { require_in(quantity, value, -1e9, 1e9); }

Regions::Regions(const Rules& rules, std::size_t points, std::size_t follows)
    : rules_(rules), points_(points), follows_(follows), regions_(1) {
  measure(regions_[0]);
}

std::size_t Regions::find(const double* point) const noexcept {
  std::size_t region = 0;
  while (const std::uint32_t split = regions_[region].split) {
    const Split& by = splits_[split - 1];
    region = 2 * split - (point[by.dimension] < by.cut ? 1 : 0);
  }
  return region;
}

// --- experts -------------------------------------------------------------------------------------

std::vector<double> Regions::predict(const double* point) const {
  return predict(regions_[find(point)], point);
}

std::vector<double> Regions::predict(const Region& region, const double* point) const {
  if (region.exemplars.empty()) return {};
  struct Neighbour {
    double distance;
    const double* exemplar;
  };
  const auto k = static_cast<std::size_t>(rules_.neighbours);
  std::vector<Neighbour> nearest;  // the nearest first, the latest of equals
  const double* const first = region.exemplars.data();
  for (const double* exemplar = first + region.exemplars.size(); exemplar != first;) {
    exemplar -= width();
    const double distance = squared_distance(point, exemplar, points_);
    if (nearest.size() == k && distance >= nearest.back().distance) continue;
    if (nearest.size() == k) nearest.pop_back();
    const auto place =
        std::upper_bound(nearest.begin(), nearest.end(), distance,
                         [](double d, const Neighbour& other) { return d < other.distance; });
    nearest.insert(place, {distance, exemplar});
  }
  std::vector<double> follows(follows_);
  for (const Neighbour& one : nearest) {
    for (std::size_t i = 0; i < follows_; ++i) follows[i] += one.exemplar[points_ + i];
  }
  for (double& one : follows) one /= static_cast<double>(nearest.size());
  return follows;
}

void Regions::learn(const double* point, const double* next) {
  const std::size_t place = find(point);
  Region& region = regions_[place];
  const std::vector<double> predicted = predict(region, point);
  if (!predicted.empty()) {
    const int needed = rules_.smoothing + 1 + rules_.window;
    if (static_cast<int>(region.errors.size()) == needed)
      region.errors.erase(region.errors.begin());
    region.errors.push_back(squared_distance(next, predicted.data(), follows_));
    measure(region);
  }
  region.exemplars.insert(region.exemplars.end(), point, point + points_);
  region.exemplars.insert(region.exemplars.end(), next, next + follows_);
  ++learned_;
  if (exemplars(place) > static_cast<std::size_t>(rules_.most_exemplars) && !split(place)) {
    const auto oldest = region.exemplars.begin();
    region.exemplars.erase(oldest, oldest + static_cast<std::ptrdiff_t>(width()));
  }
}

// Eq. 1 and 2.
void Regions::measure(Region& region) const noexcept {
  const int count = static_cast<int>(region.errors.size()), smoothed = rules_.smoothing + 1;
  const double* const end = region.errors.data() + count;
  const int latest = std::min(count, smoothed);
  region.error = count == 0 ? std::numeric_limits<double>::quiet_NaN() : mean(end - latest, latest);
  region.progress = count < smoothed + rules_.window
                        ? 0.0
                        : mean(end - rules_.window - smoothed, smoothed) - region.error;
}

// --- splits --------------------------------------------------------------------------------------

// Criterion C2: of all cuts the one of the least |Gamma_1| sigma_1 + |Gamma_2| sigma_2; among
// equals the most even one.
bool Regions::split(std::size_t place) {
  if (splits_.size() + 1 >= static_cast<std::size_t>(rules_.most_regions)) return false;
  const std::vector<double>& exemplars = regions_[place].exemplars;
  const std::size_t count = exemplars.size() / width();
  const auto at = [&](std::size_t exemplar) { return exemplars.data() + exemplar * width(); };

  std::vector<double> centred(count * follows_);  // what followed, less its mean: digits are kept
  for (std::size_t i = 0; i < follows_; ++i) {
    double sum = 0.0;
    for (std::size_t e = 0; e < count; ++e) sum += at(e)[points_ + i];
    const double centre = sum / static_cast<double>(count);
    for (std::size_t e = 0; e < count; ++e) centred[e * follows_ + i] = at(e)[points_ + i] - centre;
  }
  Spread whole(follows_);
  for (std::size_t e = 0; e < count; ++e) whole.add(&centred[e * follows_], 1.0);

  std::optional<Split> best;
  double least = 0.0;
  std::size_t evenness = 0;
  std::vector<std::size_t> order(count);
  for (std::size_t dimension = 0; dimension < points_; ++dimension) {
    const auto value = [&](std::size_t e) { return at(e)[dimension]; };
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
    Spread below(follows_), above = whole;
    for (std::size_t n = 1; n < count; ++n) {
      const double* const moved = &centred[order[n - 1] * follows_];
      below.add(moved, 1.0);
      above.add(moved, -1.0);
      const double low = value(order[n - 1]), high = value(order[n]);
      if (!(low < high)) continue;
      const double sum = below.value() + above.value();
      const std::size_t even = std::min(n, count - n);
      if (best && (sum > least || (sum == least && even <= evenness))) continue;
      // Half-way, where that is not low itself.
      const double half = low + (high - low) / 2.0;
      best = Split{static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(dimension),
                   half > low ? half : high, learned_};
      least = sum;
      evenness = even;
    }
  }
  if (!best) return false;
  add(*best);
  return true;
}

// Both halves have the errors of the whole; each exemplar goes into the one that it lies in.
void Regions::add(const Split& split) {
  splits_.push_back(split);
  regions_.resize(regions_.size() + 2);
  Region& whole = regions_[split.region];
  whole.split = static_cast<std::uint32_t>(splits_.size());
  Region* const halves = &regions_[regions_.size() - 2];
  halves[0].errors = halves[1].errors = std::exchange(whole.errors, {});
  const std::vector<double> exemplars = std::exchange(whole.exemplars, {});
  for (auto one = exemplars.begin(); one != exemplars.end();) {
    const auto next = one + static_cast<std::ptrdiff_t>(width());
    Region& half = halves[one[split.dimension] < split.cut ? 0 : 1];
    half.exemplars.insert(half.exemplars.end(), one, next);
    one = next;
  }
  for (Region* region : {&whole, halves, halves + 1}) measure(*region);
}

// --- states --------------------------------------------------------------------------------------

void Regions::describe(AgentState& state) const {
  std::vector<std::uint32_t> region, dimension, exemplar_count, error_count;
  std::vector<std::uint64_t> learned;
  std::vector<double> cut, exemplars, errors;
  for (const Split& one : splits_) {
    region.push_back(one.region);
    dimension.push_back(one.dimension);
    cut.push_back(one.cut);
    learned.push_back(one.learned);
  }
  for (const Region& one : regions_) {
    exemplar_count.push_back(static_cast<std::uint32_t>(one.exemplars.size() / width()));
    error_count.push_back(static_cast<std::uint32_t>(one.errors.size()));
    exemplars.insert(exemplars.end(), one.exemplars.begin(), one.exemplars.end());
    errors.insert(errors.end(), one.errors.begin(), one.errors.end());
  }
  add_entry(state, "splits", std::uint64_t{splits_.size()});
  add_entry(state, "learned", learned_);
  state.arrays["split_region"] = array_of(std::move(region));
  state.arrays["split_dimension"] = array_of(std::move(dimension));
  state.arrays["split_cut"] = array_of(std::move(cut));
  state.arrays["split_learned"] = array_of(std::move(learned));
  state.arrays["exemplar_count"] = array_of(std::move(exemplar_count));
  state.arrays["error_count"] = array_of(std::move(error_count));
  const Shape shape{exemplars.size() / width(), width()};
  state.arrays["exemplar"] = array_of(std::move(exemplars), shape);
  state.arrays["error"] = array_of(std::move(errors));
}

Regions::Regions(const Rules& rules, std::size_t points, std::size_t follows,
                 const AgentState& state, const std::string& source)
    : Regions(rules, points, follows) {
  const auto splits = entry_of<std::uint64_t>(state, "splits", source);
  learned_ = entry_of<std::uint64_t>(state, "learned", source);
  const auto most = static_cast<std::uint64_t>(rules.most_regions - 1);
  if (splits > most) {
    throw FileError(source, "splits", std::to_string(splits), "at most " + std::to_string(most));
  }
  const auto accept = [](const char*, auto) {};
  const auto region = values_of<std::uint32_t>(state, "split_region", {splits}, source, accept);
  const auto dimension = values_of<std::uint32_t>(
      state, "split_dimension", {splits}, source, [&](const char* name, std::uint32_t value) {
        require_count(name, value, 0, static_cast<long long>(points_) - 1);
      });
  const auto cut = values_of<double>(state, "split_cut", {splits}, source, require_finite);
  const auto learned = values_of<std::uint64_t>(
      state, "split_learned", {splits}, source, [&](const char* name, std::uint64_t value) {
        if (value > learned_) throw InvalidValue(name, std::to_string(value), "up to learned");
      });
  for (std::size_t k = 0; k < splits; ++k) {
    if (region[k] >= regions_.size() || regions_[region[k]].split != 0) {
      throw FileError(source, "split_region", std::to_string(region[k]),
                      "a region that has come to be, and was not split");
    }
    add({region[k], dimension[k], cut[k], learned[k]});
  }

  // So many of each, of which the regions that were split have none.
  const auto counts = [&](const char* name, int most_of_each) {
    std::size_t place = 0;
    return values_of<std::uint32_t>(
        state, name, {regions_.size()}, source, [&](const char* called, std::uint32_t count) {
          require_count(called, count, 0, regions_[place++].split == 0 ? most_of_each : 0);
        });
  };
  const auto total = [](const std::vector<std::uint32_t>& each) {
    return std::accumulate(each.begin(), each.end(), std::uint64_t{0});
  };
  const auto exemplar_count = counts("exemplar_count", rules.most_exemplars);
  const auto error_count = counts("error_count", rules.smoothing + 1 + rules.window);
  const auto exemplars = values_of<double>(state, "exemplar", {total(exemplar_count), width()},
                                           source, require_reading);
  const auto errors = values_of<double>(
      state, "error", {total(error_count)}, source,
      [](const char* name, double value) { require_in(name, value, 0.0, 1e100); });
  auto exemplar = exemplars.begin();
  auto error = errors.begin();
  for (std::size_t place = 0; place < regions_.size(); ++place) {
    for (std::uint32_t i = 0; i < exemplar_count[place]; ++i) {
      if (find(&*exemplar) != place) {
        throw FileError(source, "exemplar", "one outside its region", "each within its own");
      }
      const auto next = exemplar + static_cast<std::ptrdiff_t>(width());
      regions_[place].exemplars.insert(regions_[place].exemplars.end(), exemplar, next);
      exemplar = next;
    }
    const auto next = error + static_cast<std::ptrdiff_t>(error_count[place]);
    regions_[place].errors.assign(error, next);
    error = next;
    measure(regions_[place]);
  }
}

}  // namespace devlearn::detail
