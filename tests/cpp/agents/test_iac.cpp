#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/field_laws.hpp"
#include "devlearn/error.hpp"
#include "devlearn/iac.hpp"
#include "devlearn/random.hpp"

using namespace devlearn;
using detail::Regions;

namespace {

constexpr Regions::Rules kRules{250, 1000, 1, 25, 15};

// A toy of one sense x and one motor m in {0, 0.25, ..., 1}: below 0.5 what follows is m, else
// nobody knows.
struct Toy {
  static constexpr int kMotions = 5;
  explicit Toy(std::uint64_t seed) : random(seed, "toy") {}
  Observation observation() const {
    Observation seen;
    seen.situation = 0;
    seen.motion_count = kMotions;
    seen.senses = {&x, 1};
    return seen;
  }
  Outcome step(int motion) {
    x = motion < 2 ? 0.25 * motion : random.uniform();
    Outcome outcome;
    outcome.situation = 0;
    return outcome;
  }
  std::vector<int> run(Iac& agent, int steps) {
    std::vector<int> motions;
    for (int i = 0; i < steps; ++i) {
      motions.push_back(agent.choose(observation()).motion);
      agent.observe(step(motions.back()));
    }
    return motions;
  }
  Random random;
  double x = 0.5;
};

bool equal(const AgentState& a, const AgentState& b) {
  return a.kind == b.kind && a.texts == b.texts && a.arrays.size() == b.arrays.size() &&
         std::all_of(a.arrays.begin(), a.arrays.end(), [&](const auto& entry) {
           const StateArray& other = b.arrays.at(entry.first);
           return entry.second.shape == other.shape && entry.second.bytes == other.bytes &&
                  (other.bytes == 0 ||
                   std::memcmp(entry.second.data.get(), other.data.get(), other.bytes) == 0);
         });
}

template <class Call>
void check_refusal(Call call, const std::string& quantity) {
  CAPTURE(quantity);
  try {
    call();
    FAIL_CHECK("expected InvalidValue");
  } catch (const InvalidValue& error) {
    CHECK(error.quantity() == quantity);
  }
}

// Exemplars of three numbers and two that follow.
struct Exemplar {
  double point[3];
  double next[2];
};
std::vector<Exemplar> some_exemplars(std::uint64_t seed, int count) {
  Random random(seed, "exemplars");
  std::vector<Exemplar> all;
  for (int i = 0; i < count; ++i) {
    Exemplar one{};
    // Few values of the second, so that there are equal ones.
    for (double& number : one.point) number = random.uniform();
    one.point[1] = std::floor(4.0 * one.point[1]);
    one.next[0] = one.point[0] * one.point[1] + 0.1 * random.normal();
    one.next[1] = one.point[2] > 0.7 ? 1.0 : 0.1 * random.normal();
    all.push_back(one);
  }
  return all;
}

// |S| sigma(S), as the paper has it: the sum of squared distances from the mean.
double spread(const std::vector<Exemplar>& set) {
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    double mean = 0.0;
    for (const Exemplar& one : set) mean += one.next[i] / static_cast<double>(set.size());
    for (const Exemplar& one : set) sum += (one.next[i] - mean) * (one.next[i] - mean);
  }
  return sum;
}

}  // namespace

// --- regions -------------------------------------------------------------------------------------

TEST_CASE("a region is split by the cut of the least sum of weighted variances, criterion C2") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Regions regions({60, 1000, 1, 25, 15}, 3, 2);
    const std::vector<Exemplar> all = some_exemplars(seed, 61);
    for (const Exemplar& one : all) {
      CHECK(regions.splits().empty());
      regions.learn(one.point, one.next);
    }
    REQUIRE(regions.splits().size() == 1);
    const auto sum_of = [&](std::size_t dimension, double cut) {
      std::vector<Exemplar> below, above;
      for (const Exemplar& one : all) (one.point[dimension] < cut ? below : above).push_back(one);
      return below.empty() || above.empty() ? std::numeric_limits<double>::infinity()
                                            : spread(below) + spread(above);
    };
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t dimension = 0; dimension < 3; ++dimension) {
      for (const Exemplar& one : all) {
        least = std::min(least, sum_of(dimension, one.point[dimension]));
      }
    }
    const Regions::Split& split = regions.splits()[0];
    CHECK(sum_of(split.dimension, split.cut) == doctest::Approx(least).epsilon(1e-9));
    CHECK(split.learned == 61);
    CHECK(regions.exemplars(0) == 0);
    CHECK(regions.exemplars(1) + regions.exemplars(2) == 61);
    CHECK(regions.exemplars(1) > 0);
    CHECK(regions.exemplars(2) > 0);
  }
}

TEST_CASE("a region is split where what follows changes, and a half of which all is alike evenly") {
  Regions regions({100, 1000, 1, 25, 15}, 2, 1);
  Random random(3, "points");
  while (regions.splits().size() < 2) {
    const double point[] = {random.uniform(), random.uniform()};
    const double next = point[1] < 0.3 ? 5.0 : 1.0;
    regions.learn(point, &next);
  }
  const Regions::Split first = regions.splits()[0], second = regions.splits()[1];
  CHECK(first.dimension == 1);
  CHECK(first.cut == doctest::Approx(0.3).epsilon(0.1));
  CHECK(second.region == 2);
  CHECK(std::max(regions.exemplars(3), regions.exemplars(4)) == 51);
}

TEST_CASE("an expert predicts the mean of what followed the nearest exemplars of its region") {
  const std::vector<Exemplar> all = some_exemplars(5, 1000);
  for (const int k : {1, 3}) {
    Regions regions({80, 1000, k, 25, 15}, 3, 2);
    for (const Exemplar& one : all) regions.learn(one.point, one.next);
    REQUIRE(regions.size() > 10);
    for (const Exemplar& asked : some_exemplars(6, 100)) {
      const std::size_t region = regions.find(asked.point);
      CHECK(regions.exemplars(region) > 0);
      std::vector<std::pair<double, const Exemplar*>> near;
      for (const Exemplar& one : all) {
        if (regions.find(one.point) != region) continue;
        double distance = 0.0;
        for (int i = 0; i < 3; ++i) distance += std::pow(one.point[i] - asked.point[i], 2);
        near.emplace_back(distance, &one);
      }
      CHECK(near.size() == regions.exemplars(region));
      std::sort(near.begin(), near.end());
      const std::size_t count = std::min<std::size_t>(near.size(), static_cast<std::size_t>(k));
      const std::vector<double> predicted = regions.predict(asked.point);
      for (int i = 0; i < 2; ++i) {
        double mean = 0.0;
        for (std::size_t n = 0; n < count; ++n) {
          mean += near[n].second->next[i] / static_cast<double>(count);
        }
        CHECK(predicted[static_cast<std::size_t>(i)] == doctest::Approx(mean));
      }
    }
  }
}

TEST_CASE("progress is how much the mean error fell, Eq. 1 and 2, and 0 while that is unknown") {
  Regions regions({250, 1000, 1, 2, 3}, 1, 1);  // means of 3 errors, 3 errors apart
  const double point = 0.0;
  CHECK(regions.predict(&point).empty());
  CHECK(std::isnan(regions.error(0)));
  // Of equally near ones the latest is believed: each error is the square of the last change.
  std::vector<double> errors;
  double value = 0.0;
  regions.learn(&point, &value);
  CHECK(std::isnan(regions.error(0)));
  for (const double change : {4.0, -3.0, 1.0, 0.0, 2.0, -1.0, 5.0}) {
    CHECK(regions.progress(0) == 0.0);
    value += change;
    regions.learn(&point, &value);
    errors.push_back(change * change);
    if (errors.size() == 6) break;
  }
  // 16 9 1 | 0 4 1
  CHECK(regions.error(0) == doctest::Approx((0.0 + 4.0 + 1.0) / 3.0));
  CHECK(regions.progress(0) == doctest::Approx((16.0 + 9.0 + 1.0) / 3.0 - (0.0 + 4.0 + 1.0) / 3.0));
  value += 5.0;
  regions.learn(&point, &value);  // 9 1 0 | 4 1 25
  CHECK(regions.progress(0) == doctest::Approx((9.0 + 1.0 + 0.0) / 3.0 - (4.0 + 1.0 + 25.0) / 3.0));
}

TEST_CASE("both halves of a region begin with its errors") {
  Regions regions({60, 1000, 1, 25, 15}, 3, 2);
  double error = 0.0, progress = 0.0;
  for (const Exemplar& one : some_exemplars(2, 61)) {
    Regions before = regions;
    regions.learn(one.point, one.next);
    if (regions.splits().empty()) continue;
    // The last error belongs to them, too: a region that may not split shows what it came to.
    Regions whole({60, 1, 1, 25, 15}, 3, 2);
    for (const Exemplar& again : some_exemplars(2, 61)) whole.learn(again.point, again.next);
    error = whole.error(0);
    progress = whole.progress(0);
  }
  for (const std::size_t half : {1, 2}) {
    CHECK(regions.error(half) == error);
    CHECK(regions.progress(half) == progress);
  }
  CHECK(std::isnan(regions.error(0)));
}

TEST_CASE("what it holds is bounded: full regions forget their oldest exemplars") {
  Regions regions({50, 4, 1, 25, 15}, 3, 2);
  const std::vector<Exemplar> all = some_exemplars(9, 5000);
  for (const Exemplar& one : all) regions.learn(one.point, one.next);
  CHECK(regions.size() == 7);
  std::size_t total = 0;
  for (std::size_t region = 0; region < regions.size(); ++region) {
    CHECK(regions.exemplars(region) <= 50);
    total += regions.exemplars(region);
  }
  CHECK(total == 200);
  CHECK(regions.learned() == 5000);

  Regions alike({50, 1000, 1, 25, 15}, 1, 1);  // which no cut divides
  const double point = 1.0;
  for (int i = 0; i < 500; ++i) {
    const double next = i;
    alike.learn(&point, &next);
  }
  CHECK(alike.size() == 1);
  CHECK(alike.exemplars(0) == 50);
  CHECK(alike.predict(&point) == std::vector<double>{499.0});
}

// --- the agent -----------------------------------------------------------------------------------

TEST_CASE("every setting of Iac is described, compared, refused beyond its bounds, and saved") {
  field_laws::check_fields<IacConfig>();
  const auto config = field_laws::with_every_field_changed<IacConfig>();
  CHECK(dynamic_cast<const Iac&>(*make_agent(*Iac(config, 3).state())).config() == config);
}

TEST_CASE("what can be learned is sought while it is learned, rather than what cannot") {
  double known = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Iac agent({}, seed);
    Toy toy(seed);
    toy.run(agent, 260);
    for (const int motion : toy.run(agent, 60)) known += motion < 2 ? 1.0 : 0.0;
  }
  // Two of five motions: 0.4 by chance; the most that epsilon leaves is 0.35 x 0.4 + 0.65 = 0.79.
  CHECK(known / (20 * 60) > 0.6);
}

TEST_CASE("an explanation's probabilities are how often motions are chosen, of those allowed") {
  for (const int steps : {0, 200, 700}) {
    CAPTURE(steps);
    Iac agent({}, 1);
    Toy toy(1);
    toy.run(agent, steps);
    const bool allowed[] = {true, true, false, true, true};
    Observation seen = toy.observation();
    seen.allowed = allowed;
    const std::optional<AgentState> state = agent.state();
    const IacExplanation why = agent.explain(seen);
    CHECK(equal(*agent.state(), *state));
    CHECK(why.probability[2] == 0.0);
    std::map<int, double> frequency;
    constexpr int kDraws = 4000;
    for (int i = 0; i < kDraws; ++i) {
      AgentState other = *state;
      const Random::State words = Random(static_cast<std::uint64_t>(i), "other").state();
      other.arrays["random"] = array_of(std::vector<std::uint64_t>(words.begin(), words.end()));
      frequency[Iac(other).choose(seen).motion] += 1.0 / kDraws;
    }
    double sum = 0.0;
    for (int motion = 0; motion < Toy::kMotions; ++motion) {
      const double probability = why.probability[static_cast<std::size_t>(motion)];
      const double sigma = std::sqrt(probability * (1.0 - probability) / kDraws);
      CHECK(std::abs(frequency[motion] - probability) <= 5.0 * sigma);
      sum += probability;
    }
    CHECK(sum == doctest::Approx(1.0));
    CHECK(to_text(why).find("region") != std::string::npos);
  }
}

TEST_CASE("an explanation's regions hold the motions, and their errors are what will be compared") {
  Iac agent({}, 4);
  Toy toy(4);
  toy.run(agent, 3000);
  const IacExplanation why = agent.explain(toy.observation());
  for (int motion = 0; motion < Toy::kMotions; ++motion) {
    const auto m = static_cast<std::size_t>(motion);
    const auto found = std::find_if(why.regions.begin(), why.regions.end(),
                                    [&](const auto& one) { return one.region == why.region[m]; });
    REQUIRE(found != why.regions.end());
    CHECK(found->progress == why.progress[m]);
    CHECK(found->split_dimension == -1);
    CHECK(found->exemplars > 0);
    const double point[] = {toy.x, 0.25 * motion};
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(point[i] >= found->lower[i]);
      CHECK(point[i] < found->upper[i]);
    }
  }
}

TEST_CASE("the regions are a tree, whose leaves hold all that was learned") {
  Iac agent({}, 4);
  CHECK(agent.regions().empty());
  Toy toy(4);
  toy.run(agent, 600);
  const std::vector<IacRegion> all = agent.regions();
  int exemplars = 0;
  for (const IacRegion& one : all) {
    exemplars += one.exemplars;
    if (one.split_dimension < 0) continue;
    CHECK(one.exemplars == 0);
    for (const int half : {one.below, one.above}) {
      CHECK(all[static_cast<std::size_t>(half)].parent == one.region);
      CHECK(all[static_cast<std::size_t>(half)].since > one.since);
    }
    const auto d = static_cast<std::size_t>(one.split_dimension);
    CHECK(all[static_cast<std::size_t>(one.below)].upper[d] == one.split_value);
    CHECK(all[static_cast<std::size_t>(one.above)].lower[d] == one.split_value);
  }
  CHECK(exemplars == 599);  // the last motion is not learned from yet
  // The first split parts what can be known from what cannot.
  CHECK(all[0].split_dimension == 1);
  CHECK(all[0].split_value == doctest::Approx(0.375));
  const std::string text = to_text(all);
  CHECK(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) == all.size());
}

TEST_CASE("the last motion of a round is not learned from, nor one that was refused") {
  Iac agent;
  Toy toy(1);
  const auto learned = [&] {
    int count = 0;
    for (const IacRegion& one : agent.regions()) count += one.exemplars;
    return count;
  };
  agent.begin_round();
  toy.run(agent, 10);
  CHECK(learned() == 9);
  agent.end_round(false);
  agent.begin_round();
  toy.run(agent, 1);
  CHECK(learned() == 9);
  agent.choose(toy.observation());
  CHECK(learned() == 10);
  agent.cancel();
  toy.run(agent, 1);
  CHECK(learned() == 10);
  Outcome arrival;
  arrival.situation = 0;
  arrival.arrived = true;
  agent.choose(toy.observation());
  CHECK(learned() == 11);
  agent.observe(arrival);
  toy.run(agent, 1);
  CHECK(learned() == 11);
}

TEST_CASE("in a trial it senses place, heading, and distances") {
  Iac agent;
  Observation seen;
  seen.situation = 3;
  seen.motion_count = 2;
  seen.pose = {1.0, 2.0, 90.0};
  seen.goal_distance = 3.0;
  seen.clearance = 0.5;
  CHECK(agent.explain(seen).senses == std::vector<double>{0.2, 0.4, 0.0, 1.0, 0.6, 0.1});
  seen.clearance = std::numeric_limits<double>::infinity();  // of a world without obstacles
  CHECK(agent.explain(seen).senses.back() == 1.0);
  CHECK(!agent.predict(seen, 0));
  agent.choose(seen);
  agent.observe({});
  seen.pose.x = 2.0;
  agent.choose(seen);
  CHECK((*agent.predict(seen, 1))[0] == doctest::Approx(0.4));
  CHECK(agent.motors().values == std::vector<double>{0.0, 1.0});
}

TEST_CASE("the same seed gives the same history, to the bit on every machine") {
  Iac first({}, 3), second({}, 3), third({}, 4);
  const std::vector<int> motions = Toy(1).run(first, 3000);
  CHECK(Toy(1).run(second, 3000) == motions);
  CHECK(equal(*first.state(), *second.state()));
  CHECK(Toy(1).run(third, 3000) != motions);
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  const auto add = [&](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3U;
    }
  };
  for (const int motion : motions) add(static_cast<std::uint64_t>(motion));
  for (const IacRegion& one : first.regions()) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &one.progress, sizeof bits);
    add(bits);
  }
  CHECK(hash == 0x88b9092761745470U);
}

TEST_CASE("what is made of a state goes on equal to the bit, within a step, too") {
  const Motors motors{{0.0, 1.0, 0.1, 0.9, 0.2, 0.8, 0.3, 0.7, 0.4, 0.6}, 2};
  for (const int steps : {0, 1, 2, 250, 251, 252, 253, 1500}) {
    CAPTURE(steps);
    IacConfig config;
    config.most_regions = 6;
    config.neighbours = 2;
    Iac agent(config, 7, motors);
    Toy toy(2);
    toy.run(agent, steps);
    const auto between = make_agent(*agent.state());
    auto& same = dynamic_cast<Iac&>(*between);
    CHECK(equal(*same.state(), *agent.state()));
    CHECK(same.motors().values == motors.values);
    const int motion = agent.choose(toy.observation()).motion;
    CHECK(same.choose(toy.observation()).motion == motion);
    const auto within = make_agent(*agent.state());
    CHECK(equal(*within->state(), *agent.state()));
    const Outcome outcome = toy.step(motion);
    Toy twin = toy, third = toy;
    agent.observe(outcome);
    same.observe(outcome);
    within->observe(outcome);
    const std::vector<int> rest = toy.run(agent, 400);
    CHECK(twin.run(same, 400) == rest);
    CHECK(third.run(dynamic_cast<Iac&>(*within), 400) == rest);
    CHECK(equal(*same.state(), *agent.state()));
    CHECK(equal(*within->state(), *agent.state()));
  }
}

TEST_CASE(
    "a state that lacks anything, or holds what no agent can, is refused by its file's name") {
  Iac agent({}, 7);
  Toy toy(2);
  toy.run(agent, 1000);
  const AgentState good = *agent.state();
  const auto check_refused = [](const AgentState& state) {
    try {
      make_agent(state, "it");
      FAIL_CHECK("made");
    } catch (const FileError& error) {
      CHECK(error.file() == "it");
    }
  };
  for (const auto& entry : good.texts) {
    CAPTURE(entry.first);
    AgentState state = good;
    state.texts.erase(entry.first);
    check_refused(state);
    state.texts[entry.first] = "-1";
    check_refused(state);
  }
  for (const auto& entry : good.arrays) {
    CAPTURE(entry.first);
    AgentState state = good;
    state.arrays.erase(entry.first);
    check_refused(state);
    if (entry.first == "random") continue;  // of which but one state is none
    const std::vector<std::byte> ones(entry.second.bytes, std::byte{0xff});
    const auto owner = std::make_shared<const std::vector<std::byte>>(ones);
    state.arrays[entry.first] = entry.second;
    state.arrays[entry.first].data = {owner, owner->data()};
    if (entry.second.bytes > 0) check_refused(state);
  }
  AgentState moved = good;  // exemplars of the one region in the other
  std::vector<double> cut = good.values<double>("split_cut", good.arrays.at("split_cut").shape);
  cut[0] = -cut[0];
  moved.arrays["split_cut"] = array_of(cut);
  check_refused(moved);
}

TEST_CASE("what no observation or motor matrix may hold is refused, and nothing is changed") {
  Iac agent;
  Toy toy(1);
  toy.run(agent, 20);
  const AgentState before = *agent.state();
  const auto check = [&](const Observation& seen, const char* quantity) {
    check_refusal([&] { agent.choose(seen); }, quantity);
    check_refusal([&] { static_cast<void>(agent.explain(seen)); }, quantity);
    CHECK(equal(*agent.state(), before));
  };
  Observation seen = toy.observation();
  seen.motion_count = 4;
  check(seen, "motion_count");
  seen = toy.observation();
  const double two[] = {0.0, 0.0}, nan[] = {std::nan("")}, huge[] = {1e10};
  seen.senses = {two, 2};
  check(seen, "senses");
  seen.senses = {nan, 1};
  check(seen, "senses");
  seen.senses = {huge, 1};
  check(seen, "senses");
  const bool none[5] = {};
  seen = toy.observation();
  seen.allowed = none;
  check(seen, "allowed");
  check_refusal([&] { agent.observe({}); }, "observe");
  check_refusal([&] { agent.cancel(); }, "cancel");
  agent.choose(toy.observation());
  check_refusal([&] { agent.choose(toy.observation()); }, "choose");

  check_refusal([] { Iac({}, 0, {{1.0, 2.0, 3.0}, 2}); }, "motors");
  check_refusal([] { Iac({}, 0, {{1.0}, 0}); }, "motors.columns");
  check_refusal([] { Iac({}, 0, {{std::nan("")}, 1}); }, "motors");
  Iac four({}, 0, {{1.0, 2.0, 3.0, 4.0}, 1});
  check_refusal([&] { four.choose(toy.observation()); }, "motion_count");
}
