#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"

namespace devlearn::detail {

/// Throws InvalidValue for a number that is no reading: these lie in [-1e9, 1e9].
void require_reading(const char* quantity, double value);

/// A sensorimotor space that splits into regions, each with an expert, which predicts what follows,
/// and the errors of its predictions (Oudeyer, Kaplan & Hafner 2007, section IV). A point of it is
/// SM(t); what follows is S(t + 1).
///
/// Regions are numbered as they come to be: the whole space is 0, and split k makes 2 k + 1, below
/// its cut, and 2 k + 2. One that was split has neither exemplars nor errors any more.
class Regions {
 public:
  /// How it splits, predicts and measures progress.
  struct Rules {
    int most_exemplars;  ///< of a region; more, and it is split
    int most_regions;    ///< that were not split
    int neighbours;      ///< k
    int smoothing;       ///< theta
    int window;          ///< tau
  };
  /// Those of a configuration.
  template <typename Config>
  static Rules rules(const Config& config) {
    return {config.most_exemplars, config.most_regions, config.neighbours, config.smoothing,
            config.window};
  }

  /// Of points of so many numbers, after which so many follow.
  Regions(const Rules& rules, std::size_t points, std::size_t follows);
  /// One that goes on from a state. Throws FileError, naming `source`.
  Regions(const Rules& rules, std::size_t points, std::size_t follows, const AgentState& state,
          const std::string& source);
  /// Adds to a state all that it goes on from, but for the rules and the lengths.
  void describe(AgentState& state) const;

  /// The region that a point lies in.
  std::size_t find(const double* point) const noexcept;
  /// What its region's expert says will follow a point: the mean of what followed the k nearest
  /// exemplars, among equals the latest ones. Nothing where the region has none.
  std::vector<double> predict(const double* point) const;
  /// What followed a point: an error, an exemplar, and a split where there are too many of these.
  void learn(const double* point, const double* next);

  std::size_t size() const noexcept { return regions_.size(); }  ///< how many came to be
  /// How many exemplars were learned.
  std::uint64_t learned() const noexcept { return learned_; }
  /// <e>: the mean of the latest theta + 1 errors; NaN where there is none.
  double error(std::size_t region) const noexcept { return regions_[region].error; }
  /// L, Eq. 2: how much <e> fell over the latest tau errors; 0 while there are too few to tell.
  double progress(std::size_t region) const noexcept { return regions_[region].progress; }
  /// How many exemplars it has.
  std::size_t exemplars(std::size_t region) const noexcept {
    return regions_[region].exemplars.size() / width();
  }

  /// A split of a region in two.
  struct Split {
    std::uint32_t region = 0;     ///< which was split
    std::uint32_t dimension = 0;  ///< of the points
    double cut = 0.0;             ///< points below it go into the one, the rest into the other
    std::uint64_t learned = 0;    ///< exemplars that had been learned then
  };
  /// All of them, in their order.
  const std::vector<Split>& splits() const noexcept { return splits_; }

 private:
  struct Region {
    std::uint32_t split = 0;        // its place among the splits, from 1; 0 for none
    std::vector<double> exemplars;  // a point and what followed, the oldest first
    std::vector<double> errors;     // as many as progress needs, the oldest first
    double error = 0.0, progress = 0.0;
  };

  std::size_t width() const noexcept { return points_ + follows_; }
  std::vector<double> predict(const Region& region, const double* point) const;
  void measure(Region& region) const noexcept;
  bool split(std::size_t region);
  void add(const Split& split);

  Rules rules_;
  std::size_t points_, follows_;
  std::vector<Region> regions_;
  std::vector<Split> splits_;
  std::uint64_t learned_ = 0;
};

}  // namespace devlearn::detail
