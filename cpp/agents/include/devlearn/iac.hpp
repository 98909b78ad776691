#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/detail/regions.hpp"
#include "devlearn/motors.hpp"
#include "devlearn/random.hpp"

namespace devlearn {

/// The settings of Iac.
struct IacConfig {
  double epsilon = 0.35;
  int most_exemplars = 250;
  int smoothing = 25;
  int window = 15;
  int neighbours = 1;
  int most_regions = 1000;
  double length = 5.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = IacConfig;
    return described(
        "IacConfig",
        field("epsilon", &C::epsilon, "epsilon", closed(0.0, 1.0),
              "probability of any motion instead of one of the most progress"),
        field("most_exemplars", &C::most_exemplars, "T", whole(2, 100000),
              "exemplars of a region, above which it is split"),
        field("smoothing", &C::smoothing, "theta", whole(0, 10000),
              "a mean error is that of the latest theta + 1"),
        field("window", &C::window, "tau", whole(1, 10000),
              "progress is how much the mean error fell over so many errors"),
        field("neighbours", &C::neighbours, "k", whole(1, 1000),
              "nearest exemplars, of what followed which the mean is predicted"),
        field("most_regions", &C::most_regions, "", whole(1, 1000000),
              "regions, above which none is split, and a full one forgets its oldest exemplar"),
        field("length", &C::length, "", closed(0.01, 1e6, "m"),
              "what counts as 1 of places and distances in a trial"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const IacConfig& a, const IacConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const IacConfig& a, const IacConfig& b) noexcept { return !(a == b); }

/// A region of the sensorimotor space.
struct IacRegion {
  int region = 0;             ///< its number, in the order in which they came to be; 0: all
  int parent = -1;            ///< which was split into this one and another; -1: none
  std::vector<double> lower;  ///< its bounds in each dimension of SM, first S, then M: not below
  std::vector<double> upper;  ///< below; -inf and inf where it has none
  std::uint64_t since = 0;    ///< exemplars that had been learned when it came to be
  int exemplars = 0;          ///< that it holds now
  double error = 0.0;         ///< mean of its latest theta + 1 squared errors, Eq. 1; NaN: none yet
  double progress = 0.0;      ///< L, Eq. 2
  int split_dimension = -1;   ///< by which it was split; -1: it was not, and holds its exemplars
  double split_value = 0.0;   ///< where
  int below = -1;             ///< the region that it was split into, of what is below split_value,
  int above = -1;             ///< and of what is not
};

/// Why motions are chosen for what is observed.
struct IacExplanation {
  std::vector<double> senses;       ///< S(t), as learned from
  std::vector<bool> allowed;        ///< a motion: whether it may be chosen
  std::vector<int> region;          ///< a motion: in which it falls
  std::vector<double> progress;     ///< a motion: L of that, the progress that is expected, Eq. 4
  std::vector<double> probability;  ///< a motion: to be chosen; they sum to 1
  std::vector<IacRegion> regions;   ///< those in which motions fall, by their number
};

/// Intelligent adaptive curiosity (Oudeyer, Kaplan & Hafner 2007, section IV): of the regions of
/// its sensorimotor space it seeks the one in which its predictions improve the most; what it is
/// paid is nothing to it.
///
/// S(t) is what is sensed; in a trial, which has no senses, (x, y, cos, sin, d_g, d_o), lengths
/// over Config::length, d_o at most 1. M(t) is the motion's row of a matrix. A motion is learned
/// from as the next choice begins, for an outcome has no senses: the last one of a round is not.
///
/// Choosing costs a look into the tree for each motion, learning a look at one region's exemplars.
/// It holds at most most_regions x most_exemplars of these.
///
/// choose throws InvalidValue while a choice waits, or for another motion_count, or another number
/// of senses, than before; observe and cancel where none waits; all for numbers outside
/// [-1e9, 1e9].
class Iac final : public Agent {
 public:
  using Config = IacConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "iac";

  /// seed: of the stream "agent". motors: a row a motion; without values, i / (n - 1) of motion i
  /// of n. Throws InvalidValue.
  explicit Iac(const Config& config = {}, std::uint64_t seed = 0, Motors motors = {});
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit Iac(const AgentState& state, const std::string& source = "state");

  void begin_round() override { forget_last(); }
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override;
  void end_round(bool) override { forget_last(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  const Motors& motors() const noexcept { return motors_; }  ///< as given, or as first needed
  /// Why choose would choose as it does for what is observed. Draws and changes nothing. Throws
  /// InvalidValue as choose.
  IacExplanation explain(const Observation& observation) const;
  /// What will be sensed after a motion: S(t + 1), as the expert of its region says; nothing before
  /// the first exemplar. Throws InvalidValue as explain, and for a motion outside M.
  std::optional<std::vector<double>> predict(const Observation& observation, int motion) const;
  /// All regions that ever were, by their number. None before the first choice.
  std::vector<IacRegion> regions() const;

 private:
  void require(const Observation& observation) const;
  void prepare(const Observation& observation);
  std::vector<double> senses_of(const Observation& observation) const;
  void learn_last(const std::vector<double>& senses);
  void forget_last() noexcept {
    if (!waits_) last_.clear();
  }
  std::vector<double> point(const std::vector<double>& senses, int motion) const;
  std::vector<std::size_t> regions_of(const std::vector<double>& senses) const;
  std::vector<bool> most_progress(const std::vector<std::size_t>& regions,
                                  AllowedMotions allowed) const;
  IacRegion region(std::size_t number) const;

  Config config_;
  Motors motors_;
  Random random_;
  int motion_count_ = 0;  // 0 before the first choice
  std::size_t sense_count_ = 0;
  std::optional<detail::Regions> regions_;  // from the first choice on
  std::vector<double> last_;  // SM of a motion that is not learned from yet; empty: there is none
  bool waits_ = false;        // whether its outcome is not known either
};

/// Tables for people.
std::string to_text(const IacExplanation& explanation);
/// A line a region, each below the one that it was split from.
std::string to_text(const std::vector<IacRegion>& regions);

}  // namespace devlearn
