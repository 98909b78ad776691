#include <doctest/doctest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "golden_text.hpp"
#include "many.hpp"
#include "refusal.hpp"

namespace devlearn {

// Two memories are the same when every list and number is, to the last bit.
static bool operator==(const SituationMemory& a, const SituationMemory& b) {
  return a.effective == b.effective && a.ineffective == b.ineffective &&
         a.unexplored == b.unexplored && a.orientation == b.orientation &&
         a.times_learned == b.times_learned;
}

}  // namespace devlearn

using namespace devlearn;

namespace {

using Motions = std::vector<int>;
using Counts = std::vector<std::uint32_t>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr SituationId kLastSituation = std::numeric_limits<SituationId>::max();
constexpr OnNegative kOnNegative[] = {OnNegative::kAbandon, OnNegative::kWeaken};
constexpr WhenExhausted kWhenExhausted[] = {WhenExhausted::kRetry, WhenExhausted::kWander};

bool contains(const Motions& motions, int motion) {
  return std::find(motions.begin(), motions.end(), motion) != motions.end();
}

Motions with(Motions motions, int motion) {
  motions.push_back(motion);
  return motions;
}

Motions without(Motions motions, int motion) {
  motions.erase(std::remove(motions.begin(), motions.end(), motion), motions.end());
  return motions;
}

// Where a motion stands in M_i.
std::size_t place_of(const SituationMemory& memory, int motion) {
  return static_cast<std::size_t>(
      std::find(memory.effective.begin(), memory.effective.end(), motion) -
      memory.effective.begin());
}

// Everything that a learner shows of itself.
bool same_state(const Learner& a, const Learner& b) {
  const std::optional<Choice> left = a.pending(), right = b.pending();
  if (left.has_value() != right.has_value()) return false;
  if (left && (left->motion != right->motion || left->kind != right->kind)) return false;
  if (a.situations() != b.situations() || a.explored_count() != b.explored_count() ||
      a.effective_count() != b.effective_count() || a.config() != b.config() ||
      a.seed() != b.seed() || a.situations_experienced() != b.situations_experienced()) {
    return false;
  }
  for (const SituationId id : a.situations()) {
    if (!(a.situation(id) == b.situation(id))) return false;
  }
  return true;
}

// Whether two learners make the same choices and developments over some steps of one random task.
bool go_on_alike(Learner& a, Learner& b, std::uint64_t task, int steps = 500) {
  Random random(task, "task");
  if (a.pending()) a.cancel();
  if (b.pending()) b.cancel();
  for (int i = 0; i < steps; ++i) {
    const SituationId id = random.index(7);
    const Choice left = a.choose(id), right = b.choose(id);
    if (left.motion != right.motion || left.kind != right.kind) return false;
    const double smf = 4.0 * random.uniform() - 1.0;
    const Development ours = a.learn(smf), theirs = b.learn(smf);
    if (ours.event != theirs.event || ours.reduced != theirs.reduced) return false;
  }
  return same_state(a, b);
}

Learner experienced(const LearnerConfig& config = {}, std::uint64_t seed = 1, int steps = 300) {
  Learner learner(config, seed);
  Random random(seed, "task");
  for (int i = 0; i < steps; ++i) {
    learner.choose(random.index(9));
    learner.learn(4.0 * random.uniform() - 1.0);
  }
  return learner;
}

// --- Proofs I-IV ---

// How often each thing that a law might break on was met.
struct Met {
  long updates = 0, lowest_d = 0, sole = 0, reduction = 0, abandonment = 0, retry = 0,
       extension = 0, reward = 0;
};

// How often each law was broken.
struct Broken {
  long partition = 0, in_unit_interval = 0, sum = 0, lists = 0, event = 0, counts = 0, choice = 0,
       reward_lowers = 0, greater_reward = 0, elsewhere = 0, times_learned = 0, sole = 0;
};

// A random history of one learner, each update of which is held against the laws.
class History {
 public:
  History(const LearnerConfig& config, std::uint64_t seed, Met& met, Broken& broken)
      : learner_(config, seed), random_(seed, "history"), met_(met), broken_(broken) {
    for (int i = 0; i < 6; ++i) {
      ids_.push_back(static_cast<SituationId>(random_.next() >> 1));
      known_[ids_.back()] = learner_.situation(ids_.back());
    }
  }

  void run(int updates) {
    const long end = met_.updates + updates;
    while (met_.updates < end) step();
    check_everything();
  }

 private:
  void step() {
    const SituationId id = ids_[random_.index(6)];
    switch (random_.index(10)) {
      default: {  // the plain loop
        const Choice choice = choose(id);
        update(id, choice.motion, [](Learner& l, double smf) { return l.learn(smf); });
        break;
      }
      case 0: {  // another motion really ran
        choose(id);
        const int motion = any_motion();
        update(id, motion, [motion](Learner& l, double smf) { return l.learn(smf, motion); });
        break;
      }
      case 1:  // nothing ran
        choose(id);
        learner_.cancel();
        broken_.elsewhere += !(learner_.situation(id) == known_[id]);
        break;
      case 2:
      case 3: {  // somebody else chose
        const int motion = any_motion();
        update(id, motion, [=](Learner& l, double smf) { return l.update(id, motion, smf); });
        break;
      }
      case 4: {  // an outcome arrives while another is awaited, perhaps of the same situation
        choose(id);
        const SituationId other = ids_[random_.index(6)];
        const int motion = any_motion();
        update(other, motion, [=](Learner& l, double smf) { return l.update(other, motion, smf); });
        update(id, learner_.pending()->motion, [](Learner& l, double smf) { return l.learn(smf); });
        break;
      }
    }
    if (met_.updates % 64 == 0) check_everything();
  }

  int any_motion() { return static_cast<int>(random_.index(learner_.config().motion_count)); }

  // The motion's kind is the list that it was drawn from.
  Choice choose(SituationId id) {
    const Choice choice = learner_.choose(id);
    const SituationMemory& memory = known_[id];
    const bool exhausted = memory.effective.empty() && memory.unexplored.empty();
    bool right = false;
    switch (choice.kind) {
      case Kind::kExplore:
        right = contains(memory.unexplored, choice.motion);
        break;
      case Kind::kExploit:
        right = contains(memory.effective, choice.motion);
        break;
      default:
        right = choice.kind == Kind::kExhausted && exhausted;
        break;
    }
    broken_.choice += !right;
    return choice;
  }

  // Sensorimotor mapping evaluations from everywhere that a law might break.
  double any_smf() {
    const double u = random_.uniform();
    switch (random_.index(16)) {
      case 0:
        return 0.0;
      case 1:
        return -0.0;
      case 2:
        return std::ldexp(u - 0.5, -static_cast<int>(random_.index(1074)));
      case 3:
        return 1000.0 * u;
      case 4:
        return std::ldexp(u, static_cast<int>(random_.index(1024)));
      case 5:  // D = -1 and around it
        return -13.862943611198906 - 0.01 * (u - 0.5);
      case 6:
        return -13.87 - 100.0 * u;
      case 7:
        return -std::ldexp(u, static_cast<int>(random_.index(1024)));
      default:
        return 6.0 * u - 1.5;
    }
  }

  template <class Apply>
  void update(SituationId id, int motion, const Apply& apply) {
    const double smf = any_smf();
    const LearnerConfig& config = learner_.config();
    const SituationMemory before = known_[id];
    const std::int64_t explored = learner_.explored_count();
    const std::int64_t effective = learner_.effective_count();
    const bool was_unexplored = contains(before.unexplored, motion);
    const bool was_effective = contains(before.effective, motion);
    const bool was_ineffective = !was_unexplored && !was_effective;
    const bool good = smf >= 0.0;

    std::optional<Learner> twin;
    if (was_effective && good) twin = learner_;

    const Development development = apply(learner_, smf);
    const SituationMemory after = learner_.situation(id);

    // What method.md says of the lists.
    Event event = Event::kNothing;
    Motions entered = before.effective, left = before.ineffective, unexplored = before.unexplored;
    if (was_unexplored ||
        (was_ineffective && good && config.when_exhausted == WhenExhausted::kRetry)) {
      unexplored = without(unexplored, motion);
      left = without(left, motion);
      event = good ? Event::kExtension : Event::kRejection;
      Motions& list = good ? entered : left;
      list = with(list, motion);
    } else if (was_effective && !good && config.on_negative == OnNegative::kAbandon) {
      event = Event::kAbandonment;
      entered = without(entered, motion);
      left = with(left, motion);
    } else if (was_effective) {
      event = Event::kOrientation;
      // Which motions are reduced is for Eq. 9 to say; they leave in their order.
      for (const int other : before.effective) {
        if (!contains(after.effective, other)) {
          entered = without(entered, other);
          left = with(left, other);
        }
      }
    }
    broken_.event += development.event != event || development.situation != id ||
                     development.motion != motion ||
                     development.reduced !=
                         (event == Event::kOrientation
                              ? static_cast<int>(before.effective.size() - after.effective.size())
                              : 0);
    broken_.lists +=
        after.effective != entered || after.ineffective != left || after.unexplored != unexplored;
    check_situation(after);
    check_times_learned(before, after, motion, event);

    // NUM_RM and NUM_M by what changed here; check_everything counts them afresh.
    broken_.counts += learner_.explored_count() != explored + was_unexplored ||
                      learner_.effective_count() !=
                          effective + static_cast<std::int64_t>(after.effective.size()) -
                              static_cast<std::int64_t>(before.effective.size());

    if (twin) check_reward(id, before, after, motion, smf, *twin, apply);

    ++met_.updates;
    met_.extension += event == Event::kExtension;
    met_.abandonment += event == Event::kAbandonment;
    met_.reduction += event == Event::kOrientation && development.reduced > 0;
    met_.retry += was_ineffective && config.when_exhausted == WhenExhausted::kRetry;
    if (event == Event::kOrientation) {
      met_.lowest_d += smf < -13.8629436112;
      if (before.effective.size() == 1) {
        ++met_.sole;
        broken_.sole += after.orientation != std::vector<double>{1.0};
      }
    }
    known_[id] = after;
  }

  // Condition 1 of the proofs, and Eq. 3-4.
  void check_situation(const SituationMemory& memory) {
    Motions all = memory.effective;
    all.insert(all.end(), memory.ineffective.begin(), memory.ineffective.end());
    all.insert(all.end(), memory.unexplored.begin(), memory.unexplored.end());
    std::sort(all.begin(), all.end());
    bool partition = static_cast<int>(all.size()) == learner_.config().motion_count;
    for (std::size_t i = 0; partition && i < all.size(); ++i) {
      partition = all[i] == static_cast<int>(i);
    }
    broken_.partition += !partition ||
                         !std::is_sorted(memory.unexplored.begin(), memory.unexplored.end()) ||
                         memory.orientation.size() != memory.effective.size() ||
                         memory.times_learned.size() != memory.effective.size();
    double sum = 0.0;
    for (const double o : memory.orientation) {
      broken_.in_unit_interval += !(o >= 0.0 && o <= 1.0);
      sum += o;
    }
    broken_.sum += !memory.effective.empty() && !(std::fabs(sum - 1.0) <= 1e-9);
  }

  // n_ik is 1 on entering M_i, grows by one when exploited, and goes where its motion goes.
  void check_times_learned(const SituationMemory& before, const SituationMemory& after, int motion,
                           Event event) {
    for (std::size_t j = 0; j < after.effective.size(); ++j) {
      const int other = after.effective[j];
      const std::size_t place = place_of(before, other);
      std::uint32_t expected = 1;
      if (place < before.effective.size()) {
        expected = before.times_learned[place] + (other == motion && event == Event::kOrientation);
      }
      broken_.times_learned += after.times_learned[j] != expected;
    }
  }

  // Condition 2: reward never lowers the chosen orientation, and greater reward raises it at least
  // as much. 1e-15 is for rounding.
  template <class Apply>
  void check_reward(SituationId id, const SituationMemory& before, const SituationMemory& after,
                    int motion, double smf, Learner& twin, const Apply& apply) {
    ++met_.reward;
    const double orientation = before.orientation[place_of(before, motion)];
    const std::size_t place = place_of(after, motion);
    const bool kept = place < after.effective.size();
    if (kept) {
      broken_.reward_lowers += !(after.orientation[place] >= orientation - 1e-15);
    } else {
      // Only a motion that was below the threshold already (an abandonment had raised it since) can
      // leave in spite of a reward.
      broken_.reward_lowers +=
          !(orientation < 1.0 / (3.0 * static_cast<double>(before.effective.size())) + 1e-15);
    }

    const double greater =
        std::min(kLargest, random_.index(2) == 0 ? 2.0 * smf : smf + random_.uniform());
    apply(twin, greater);
    if (!kept) return;
    const SituationMemory more = twin.situation(id);
    const std::size_t twin_place = place_of(more, motion);
    broken_.greater_reward += !(twin_place < more.effective.size() &&
                                more.orientation[twin_place] >= after.orientation[place] - 1e-15);
  }

  // Everything is recounted, and no situation changed but by its own updates.
  void check_everything() {
    std::int64_t explored = 0, effective = 0;
    for (const SituationId id : ids_) {
      const SituationMemory memory = learner_.situation(id);
      broken_.elsewhere += !(memory == known_[id]);
      explored += static_cast<std::int64_t>(memory.effective.size() + memory.ineffective.size());
      effective += static_cast<std::int64_t>(memory.effective.size());
    }
    broken_.counts +=
        learner_.explored_count() != explored || learner_.effective_count() != effective;
  }

  Learner learner_;
  Random random_;
  Met& met_;
  Broken& broken_;
  std::vector<SituationId> ids_;
  std::map<SituationId, SituationMemory> known_;
};

// --- golden histories ---

constexpr int kGoldenSteps = 5000;
constexpr int kGoldenSituations = 37;
constexpr std::size_t kGoldenLinesKept = 600;

// SMF of a motion in a situation at a time, by whole numbers only: in [-18, 26].
double golden_smf(int situation, int motion, int time) {
  const int of_mapping =
      (situation * situation * 7 + motion * 29 + situation * motion * 13) % 41 - 16;
  const int of_time = (time * time * 5 + time * 3) % 17 - 8;
  return of_mapping + of_time / 4.0;
}

std::string numbers(const char* format, long long a, long long b, long long c, long long d = 0,
                    long long e = 0, long long f = 0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b, c, d, e, f);
  return text;
}

std::string orientations(const SituationMemory& memory) {
  std::string text;
  for (const double o : memory.orientation) {
    char digits[40];  // as %.13a writes them, which not every C library knows
    const auto end =
        std::to_chars(digits, digits + sizeof digits, o, std::chars_format::hex, 13).ptr;
    text += " 0x" + std::string(digits, end);
  }
  return text;
}

// A world-free history, line by line; tests/golden/README.md says how it goes.
std::vector<std::string> golden_history(const LearnerConfig& config) {
  Learner learner(config, 2020);
  std::vector<std::string> lines;
  const auto id_of = [](int situation) { return SituationId{situation} << 57; };
  const auto add = [&](const char* what, int situation, const Development& development) {
    lines.push_back(what +
                    numbers(" %lld %lld %lld %lld %lld %lld", situation, development.motion,
                            static_cast<int>(development.event), development.reduced,
                            learner.explored_count(), learner.effective_count()) +
                    orientations(learner.situation(id_of(situation))));
  };
  int situation = 0;
  for (int t = 0; t < kGoldenSteps; ++t) {
    const Choice choice = learner.choose(id_of(situation));
    lines.push_back(
        numbers("choose %lld %lld %lld", situation, choice.motion, static_cast<int>(choice.kind)));
    int ran = choice.motion;
    if (t % 11 == 10) {
      learner.cancel();
    } else if (t % 13 == 12) {
      ran = (choice.motion + 1) % config.motion_count;
      add("learn", situation, learner.learn(golden_smf(situation, ran, t), ran));
    } else {
      add("learn", situation, learner.learn(golden_smf(situation, ran, t)));
    }
    if (t % 7 == 6) {
      const int other = (3 * situation + 1) % kGoldenSituations, motion = t % config.motion_count;
      add("update", other, learner.update(id_of(other), motion, golden_smf(other, motion, t)));
    }
    situation = (3 * situation + 7 * ran + 1 + t % 2) % kGoldenSituations;
  }
  const auto listed = [](const auto& list) {
    std::string text = " |";
    for (const auto value : list) text += " " + std::to_string(value);
    return text;
  };
  for (const SituationId id : learner.situations()) {
    const SituationMemory memory = learner.situation(id);
    lines.push_back("situation " + std::to_string(id) + listed(memory.effective) +
                    listed(memory.ineffective) + listed(memory.unexplored) +
                    listed(memory.times_learned) + " |" + orientations(memory));
  }
  return lines;
}

void check_golden(const std::string& preset, const LearnerConfig& config) {
  const std::string path =
      std::string(DEVLEARN_SOURCE_DIR "/tests/golden/learner_") + preset + ".txt";
  const std::string text = golden_text(golden_history(config), kGoldenLinesKept, kGoldenSituations);
  if (std::getenv("DEVLEARN_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << text;
  std::ifstream file(path);
  REQUIRE_MESSAGE(file, path);
  const std::string golden((std::istreambuf_iterator<char>(file)),
                           std::istreambuf_iterator<char>());
  const auto differs = std::mismatch(golden.begin(), golden.end(), text.begin(), text.end());
  CAPTURE(std::count(golden.begin(), differs.first, '\n') + 1);  // the first line that differs
  CHECK(differs.first == golden.end());
  CHECK(differs.second == text.end());
}

}  // namespace

TEST_CASE("Proofs I-IV hold after every one of a million random updates") {
  Met met;
  Broken broken;
  std::uint64_t seed = 0;
  for (const int motion_count : {1, 2, 3, 5, 9}) {
    for (const OnNegative on_negative : kOnNegative) {
      for (const WhenExhausted when_exhausted : kWhenExhausted) {
        LearnerConfig config;
        config.motion_count = motion_count;
        config.on_negative = on_negative;
        config.when_exhausted = when_exhausted;
        // Many short lives: what is known as ineffective to a wanderer remains so.
        for (int life = 0; life < many(200); ++life) {
          History(config, ++seed, met, broken).run(life % 10 == 0 ? 1350 : 150);
        }
      }
    }
  }
  CHECK(broken.partition == 0);
  CHECK(broken.in_unit_interval == 0);
  CHECK(broken.sum == 0);
  CHECK(broken.sole == 0);
  CHECK(broken.lists == 0);
  CHECK(broken.event == 0);
  CHECK(broken.counts == 0);
  CHECK(broken.choice == 0);
  CHECK(broken.times_learned == 0);
  CHECK(broken.elsewhere == 0);
  CHECK(broken.reward_lowers == 0);
  CHECK(broken.greater_reward == 0);

  CHECK(met.updates >= many(1'000'000));
  CHECK(met.lowest_d >= many(1000));
  CHECK(met.sole >= many(1000));
  CHECK(met.reduction >= many(1000));
  CHECK(met.abandonment >= 1000);
  CHECK(met.retry >= 1000);
  CHECK(met.extension >= 1000);
  CHECK(met.reward >= 1000);
  MESSAGE("updates " << met.updates << ", D = -1 " << met.lowest_d << ", sole motion " << met.sole
                     << ", reductions " << met.reduction << ", abandonments " << met.abandonment
                     << ", retries " << met.retry << ", extensions " << met.extension
                     << ", rewards " << met.reward);
}

TEST_CASE("orientations sum to 1 however long motions are weakened in turn") {
  for (const double smf : {-0.1, -1.0, -3.0}) {
    Learner learner(LearnerConfig::step5());
    for (int motion = 0; motion < 5; ++motion) learner.update(0, motion, 1.0);
    for (int i = 0; i < 50000; ++i) learner.update(0, i % 5, smf);
    double sum = 0.0;
    for (const double o : learner.situation(0).orientation) sum += o;
    CAPTURE(smf);
    CHECK(std::fabs(sum - 1.0) <= 1e-12);
  }
}

TEST_CASE("the defaults are the paper's parameters, and step 5's reading differs in two options") {
  const LearnerConfig paper;
  CHECK(paper == LearnerConfig::paper());
  CHECK(paper.motion_count == 5);
  CHECK(paper.eta == 0.05);
  CHECK(paper.sigma == 0.3);
  CHECK(paper.c1 == 0.5);
  CHECK(paper.c2 == 1.0);
  CHECK(paper.on_negative == OnNegative::kAbandon);
  CHECK(paper.when_exhausted == WhenExhausted::kRetry);
  LearnerConfig step5;
  step5.on_negative = OnNegative::kWeaken;
  step5.when_exhausted = WhenExhausted::kWander;
  CHECK(step5 == LearnerConfig::step5());
  CHECK(step5 != paper);
}

TEST_CASE("configurations are equal when every field is") {
  const std::function<void(LearnerConfig&)> changes[] = {
      [](LearnerConfig& c) { c.motion_count = 6; },
      [](LearnerConfig& c) { c.eta = 0.06; },
      [](LearnerConfig& c) { c.sigma = 0.4; },
      [](LearnerConfig& c) { c.c1 = 1.0; },
      [](LearnerConfig& c) { c.c2 = 2.0; },
      [](LearnerConfig& c) { c.on_negative = OnNegative::kWeaken; },
      [](LearnerConfig& c) { c.when_exhausted = WhenExhausted::kWander; }};
  for (const auto& change : changes) {
    LearnerConfig other;
    change(other);
    CHECK(other != LearnerConfig{});
    CHECK_FALSE(other == LearnerConfig{});
  }
}

TEST_CASE("step 5, case I: an explored motion is accepted where SMF >= 0 and rejected below") {
  for (const OnNegative on_negative : kOnNegative) {
    for (const WhenExhausted when_exhausted : kWhenExhausted) {
      LearnerConfig config;
      config.on_negative = on_negative;
      config.when_exhausted = when_exhausted;
      Learner learner(config);
      CHECK(learner.update(3, 4, 0.0).event == Event::kExtension);
      CHECK(learner.update(3, 1, -5e-324).event == Event::kRejection);
      CHECK(learner.update(3, 2, -0.0).event == Event::kExtension);
      const SituationMemory memory = learner.situation(3);
      CHECK(memory.effective == Motions{4, 2});
      CHECK(memory.ineffective == Motions{1});
      CHECK(memory.unexplored == Motions{0, 3});
      CHECK(memory.orientation == std::vector<double>{0.5, 0.5});
      CHECK(memory.times_learned == Counts{1, 1});
      CHECK(learner.explored_count() == 3);
      CHECK(learner.effective_count() == 2);
    }
  }
}

TEST_CASE("step 5, case II: Eq. 9 takes D = 1 - exp(-eta SMF), at least -1") {
  LearnerConfig config = LearnerConfig::step5();
  config.eta = 0.5;
  const auto first_of_two = [&config](double smf) {
    Learner learner(config);
    learner.update(0, 0, 1.0);
    learner.update(0, 1, 1.0);
    CHECK(learner.update(0, 0, smf).event == Event::kOrientation);
    const SituationMemory memory = learner.situation(0);
    return memory.effective.size() == 2 ? memory.orientation[0] : 0.0;
  };
  CHECK(first_of_two(0.0) == 0.5);
  // D = 1 - e^-0.5 = 0.39346934028736658: (0.5 + 0.5 D)/(1 + 0.5 D)
  CHECK(first_of_two(1.0) == doctest::Approx(0.58219644464719267).epsilon(1e-15));
  // D = 1 - e^0.1 = -0.10517091807564762
  CHECK(first_of_two(-0.2) == doctest::Approx(0.47224791431614559).epsilon(1e-15));
  // D = 1: 1/1.5
  CHECK(first_of_two(kLargest) == doctest::Approx(2.0 / 3).epsilon(1e-15));
  // D = -1 from -2 ln 2 on: nothing is left of it.
  CHECK(first_of_two(-1.4) == 0.0);
  CHECK(first_of_two(-kLargest) == 0.0);
}

TEST_CASE("step 4 or step 5: an exploited motion that meets SMF < 0 is abandoned or weakened") {
  Learner abandoning(LearnerConfig::paper()), weakening(LearnerConfig::step5());
  for (Learner* learner : {&abandoning, &weakening}) {
    for (const int motion : {2, 0, 4}) learner->update(0, motion, 1.0);
  }
  CHECK(abandoning.update(0, 0, -0.1).event == Event::kAbandonment);
  CHECK(abandoning.situation(0).effective == Motions{2, 4});
  CHECK(abandoning.situation(0).ineffective == Motions{0});
  CHECK(abandoning.situation(0).orientation == std::vector<double>{0.5, 0.5});
  CHECK(abandoning.effective_count() == 2);
  CHECK(abandoning.explored_count() == 3);

  CHECK(weakening.update(0, 0, -0.1).event == Event::kOrientation);
  const SituationMemory memory = weakening.situation(0);
  CHECK(memory.effective == Motions{2, 0, 4});
  CHECK(memory.times_learned == Counts{1, 2, 1});
  CHECK(memory.orientation[1] < 1.0 / 3);
  CHECK(memory.orientation[0] > 1.0 / 3);
}

TEST_CASE("a sole motion is weakened without end, but abandoned at once") {
  Learner abandoning(LearnerConfig::paper()), weakening(LearnerConfig::step5());
  abandoning.update(0, 3, 1.0);
  weakening.update(0, 3, 1.0);
  for (int i = 0; i < 100; ++i) weakening.update(0, 3, -50.0);
  CHECK(weakening.situation(0).effective == Motions{3});
  CHECK(weakening.situation(0).orientation == std::vector<double>{1.0});
  CHECK(weakening.situation(0).times_learned == Counts{101});
  abandoning.update(0, 3, -1e-9);
  CHECK(abandoning.situation(0).effective.empty());
}

TEST_CASE("reduction development is reported with the number that left") {
  Learner learner;
  for (int motion = 0; motion < 3; ++motion) learner.update(0, motion, 0.0);
  // D = 1: weights 2 : 1 : 1, 4 : 1 : 1, 8 : 1 : 1; at 1/10 the others lie below 1/9.
  CHECK(learner.update(0, 0, 1e6).reduced == 0);
  CHECK(learner.update(0, 0, 1e6).reduced == 0);
  const Development last = learner.update(0, 0, 1e6);
  CHECK(last.event == Event::kOrientation);
  CHECK(last.reduced == 2);
  CHECK(learner.situation(0).effective == Motions{0});
  CHECK(learner.situation(0).ineffective == Motions{1, 2});
  CHECK(learner.situation(0).orientation == std::vector<double>{1.0});
  CHECK(learner.effective_count() == 1);
  CHECK(learner.explored_count() == 3);
}

TEST_CASE("where nothing is left, a retry may succeed and wandering learns nothing") {
  LearnerConfig wander;
  wander.when_exhausted = WhenExhausted::kWander;
  for (const LearnerConfig& config : {LearnerConfig::paper(), wander}) {
    const bool retry = config.when_exhausted == WhenExhausted::kRetry;
    Learner learner(config);
    for (const int motion : {1, 4, 0, 3, 2}) learner.update(7, motion, -1.0);
    const SituationMemory before = learner.situation(7);
    Choice choice = learner.choose(7);
    CHECK(choice.kind == Kind::kExhausted);
    CHECK(learner.learn(-2.0).event == Event::kNothing);
    CHECK(learner.situation(7) == before);

    choice = learner.choose(7);
    const Development development = learner.learn(0.0);
    CHECK(development.event == (retry ? Event::kExtension : Event::kNothing));
    const SituationMemory after = learner.situation(7);
    if (retry) {
      CHECK(after.effective == Motions{choice.motion});
      CHECK(after.ineffective == without(before.ineffective, choice.motion));
    } else {
      CHECK(after == before);
    }
    CHECK(learner.effective_count() == (retry ? 1 : 0));
    CHECK(learner.explored_count() == 5);
  }
}

TEST_CASE("learning from another motion leaves the chosen one alone") {
  Learner learner;
  const Choice choice = learner.choose(0);
  const int ran = (choice.motion + 2) % 5;
  const Development development = learner.learn(1.0, ran);
  CHECK(development.motion == ran);
  CHECK(learner.situation(0).effective == Motions{ran});
  CHECK(contains(learner.situation(0).unexplored, choice.motion));
  CHECK_FALSE(learner.pending());
}

TEST_CASE("an update leaves a waiting choice waiting") {
  Learner learner;
  const Choice choice = learner.choose(5);
  for (SituationId id = 0; id < 1000; ++id) learner.update(id, 1, 1.0);
  REQUIRE(learner.pending());
  CHECK(learner.pending()->motion == choice.motion);
  CHECK(learner.pending()->kind == choice.kind);
  CHECK(learner.learn(1.0).situation == 5);
}

TEST_CASE("a cancelled choice teaches nothing, and what it drew is drawn") {
  Learner learner, other;
  learner.choose(5);
  learner.cancel();
  CHECK_FALSE(learner.pending());
  CHECK(learner.explored_count() == 0);
  CHECK(learner.situation(5) == other.situation(5));
  CHECK(learner.situations() == std::vector<SituationId>{5});
  other.choose(5);
  other.cancel();
  CHECK(go_on_alike(learner, other, 80));
}

TEST_CASE("asking about a situation never experienced creates nothing") {
  Learner learner = experienced(), twin = learner;
  const SituationMemory fresh = learner.situation(kLastSituation);
  CHECK(fresh.unexplored == Motions{0, 1, 2, 3, 4});
  CHECK(fresh.effective.empty());
  CHECK(fresh.ineffective.empty());
  CHECK(same_state(learner, twin));
  CHECK(learner.situations_experienced() == 9);
}

TEST_CASE("the learner refuses bad input by name and is left as it was") {
  const Learner original = experienced();
  Learner learner = original;
  check_refused([&] { learner.learn(1.0); }, "Learner.learn",
                "no choice that waits for its outcome");
  check_refused([&] { learner.learn(1.0, 2); }, "Learner.learn",
                "no choice that waits for its outcome");
  check_refused([&] { learner.cancel(); }, "Learner.cancel",
                "no choice that waits for its outcome");
  for (const SituationId bad : {SituationId{-1}, std::numeric_limits<SituationId>::min()}) {
    const std::string value = std::to_string(bad);
    check_refused([&] { learner.choose(bad); }, "situation", value);
    check_refused([&] { learner.update(bad, 0, 1.0); }, "situation", value);
    check_refused([&] { learner.situation(bad); }, "situation", value);
  }
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    check_refused([&] { learner.update(99, 0, bad); }, "smf", to_text(bad));
  }
  for (const int bad : {-1, 5, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    check_refused([&] { learner.update(99, bad, 1.0); }, "motion", std::to_string(bad));
  }
  check_refused([&] { learner.reserve(4294967295U); }, "situations", "4294967295");
  CHECK(same_state(learner, original));

  // The same with a choice that waits; it goes on waiting.
  Learner waiting = original;
  const Choice choice = waiting.choose(3);
  const Learner before = waiting;
  check_refused([&] { waiting.choose(3); }, "Learner.choose",
                "a second choice before the first met its outcome");
  check_refused([&] { waiting.choose(-3); }, "situation", "-3");
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    check_refused([&] { waiting.learn(bad); }, "smf", to_text(bad));
    check_refused([&] { waiting.learn(bad, 0); }, "smf", to_text(bad));
  }
  for (const int bad : {-1, 5}) {
    check_refused([&] { waiting.learn(1.0, bad); }, "motion", std::to_string(bad));
  }
  CHECK(same_state(waiting, before));
  REQUIRE(waiting.pending());
  CHECK(waiting.pending()->motion == choice.motion);
  // Not even a draw was taken.
  Learner twin = before;
  CHECK(go_on_alike(waiting, twin, 81));
  Learner fresh = original;
  CHECK(go_on_alike(learner, fresh, 81));
}

TEST_CASE("every parameter out of its range is refused by name") {
  const auto refuse = [](auto set, const char* quantity, const std::string& value) {
    LearnerConfig config;
    set(config);
    check_refused([&] { config.validate(); }, quantity, value);
    check_refused([&] { Learner learner(config); }, quantity, value);
  };
  for (const int bad : {0, -1, 65536}) {
    refuse([=](LearnerConfig& c) { c.motion_count = bad; }, "LearnerConfig.motion_count",
           std::to_string(bad));
  }
  for (const double bad : {0.0, 1.0, -0.1, 1.5, kInfinity, -kInfinity, kNaN}) {
    refuse([=](LearnerConfig& c) { c.eta = bad; }, "LearnerConfig.eta", to_text(bad));
    refuse([=](LearnerConfig& c) { c.sigma = bad; }, "LearnerConfig.sigma", to_text(bad));
  }
  for (const double bad : {-5e-324, 1000001.0, kInfinity, kNaN}) {
    refuse([=](LearnerConfig& c) { c.c1 = bad; }, "LearnerConfig.c1", to_text(bad));
  }
  for (const double bad : {-1000001.0, 1000001.0, kInfinity, -kInfinity, kNaN}) {
    refuse([=](LearnerConfig& c) { c.c2 = bad; }, "LearnerConfig.c2", to_text(bad));
  }
}

TEST_CASE("a learner works at the ends of every parameter's range") {
  for (const double small : {5e-324, std::nextafter(1.0, 0.0)}) {
    for (const double c1 : {0.0, 1e6}) {
      for (const double c2 : {-1e6, 1e6}) {
        for (const int motion_count : {1, 65535}) {
          LearnerConfig config = LearnerConfig::step5();
          config.motion_count = motion_count;
          config.eta = config.sigma = small;
          config.c1 = c1;
          config.c2 = c2;
          Learner learner(config, 1);
          for (int i = 0; i < 100; ++i) {
            const Choice choice = learner.choose(0);
            REQUIRE(choice.motion >= 0);
            REQUIRE(choice.motion < motion_count);
            learner.learn(i % 7 == 6 ? -kLargest : kLargest);
          }
          double sum = 0.0;
          for (const double o : learner.situation(0).orientation) sum += o;
          REQUIRE(std::fabs(sum - 1.0) <= 1e-9);
        }
      }
    }
  }
}

TEST_CASE("copies are independent and go on alike") {
  Learner original = experienced(), copy = original;
  const Learner before = original;
  copy.update(3, 1, 2.0);
  copy.choose(12345);
  CHECK(same_state(original, before));

  Learner waiting = before;
  waiting.choose(4);
  Learner twin = waiting, assigned;
  assigned = waiting;
  CHECK(same_state(waiting, twin));
  CHECK(twin.learn(1.0).situation == 4);
  CHECK(assigned.learn(1.0).situation == 4);
  waiting.learn(1.0);
  CHECK(same_state(assigned, waiting));
  CHECK(go_on_alike(twin, waiting, 82));
}

TEST_CASE("the same seed gives the same history, another seed another one") {
  Learner a({}, 17), b({}, 17), c({}, 18);
  CHECK(go_on_alike(a, b, 83));
  Learner d({}, 17);
  CHECK_FALSE(go_on_alike(c, d, 83));
}

TEST_CASE("reserving changes nothing but where memory lies") {
  Learner learner = experienced(), twin = learner;
  const SituationMemory third = learner.situation(3);
  learner.reserve(100000);
  CHECK(same_state(learner, twin));
  CHECK(learner.situation(3) == third);
  learner.reserve(1);
  CHECK(same_state(learner, twin));
  learner.choose(2);
  learner.reserve(200000);
  CHECK(learner.pending());
  twin.choose(2);
  CHECK(same_state(learner, twin));
  CHECK(go_on_alike(learner, twin, 84));
}

// Sanitizers end the program where others throw std::bad_alloc.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a reservation that memory cannot meet changes nothing") {
  LearnerConfig config;
  config.motion_count = 65535;
  Learner learner(config, 5);
  learner.update(1, 2, 1.0);
  Learner twin = learner;
  CHECK_THROWS_AS(learner.reserve(4294967294U), std::bad_alloc);
  CHECK(same_state(learner, twin));
  CHECK(go_on_alike(learner, twin, 85, 20));
}

TEST_CASE("a reservation gives its room or is refused where 32 bits cannot count the bytes, too") {
  LearnerConfig config;
  config.motion_count = 65535;
  Learner learner(config);
  constexpr std::size_t kSituations = 4682;  // a little more than 2^32 bytes
  bool refused = false;
  try {
    learner.reserve(kSituations);
  } catch (const std::bad_alloc&) {
    refused = true;
  }
  CHECK((refused || learner.room() >= kSituations));
}
#endif

TEST_CASE("situation ids reach to 2^63 - 1") {
  Learner learner;
  for (const SituationId id : {kLastSituation, kLastSituation - 1, SituationId{0},
                               SituationId{1} << 32, SituationId{1} << 62}) {
    CHECK(learner.choose(id).kind == Kind::kExplore);
    CHECK(learner.learn(1.0).situation == id);
    CHECK(learner.situation(id).effective.size() == 1);
  }
  CHECK(learner.situations() == std::vector<SituationId>{kLastSituation, kLastSituation - 1, 0,
                                                         SituationId{1} << 32,
                                                         SituationId{1} << 62});
}

TEST_CASE("a hundred thousand situations are kept apart, in the order of first experience") {
  LearnerConfig config;
  config.motion_count = 3;
  Learner learner(config);
  std::map<SituationId, std::vector<int>> model;  // motions found effective, in order
  std::vector<SituationId> order;
  Random random(86, "ids");
  while (model.size() < 100000) {
    SituationId id = 0;
    switch (random.index(4)) {
      case 0:  // scattered
        id = static_cast<SituationId>(random.next() >> 1);
        break;
      case 1:  // in a row, as a grid's are
        id = random.index(40000);
        break;
      case 2:  // equal in their low bits
        id = SituationId{random.index(40000)} << 47;
        break;
      default:  // one known already
        if (!order.empty()) id = order[random.index(static_cast<std::uint32_t>(order.size()))];
        break;
    }
    const int motion = static_cast<int>(random.index(3));
    learner.update(id, motion, 0.0);
    if (model.find(id) == model.end()) order.push_back(id);
    std::vector<int>& effective = model[id];
    if (!contains(effective, motion)) effective.push_back(motion);
  }
  CHECK(learner.situations_experienced() == model.size());
  CHECK(learner.situations() == order);
  std::int64_t wrong = 0, effective_count = 0;
  for (const auto& [id, effective] : model) {
    wrong += learner.situation(id).effective != effective;
    effective_count += static_cast<std::int64_t>(effective.size());
  }
  for (int i = 0; i < 100000; ++i) {
    const SituationId absent = static_cast<SituationId>(random.next() >> 1);
    if (model.count(absent) == 0) wrong += learner.situation(absent).unexplored.size() != 3;
  }
  CHECK(wrong == 0);
  CHECK(learner.explored_count() == effective_count);
  CHECK(learner.effective_count() == effective_count);
  CHECK(learner.situations_experienced() == model.size());
}

// To write the golden files anew: DEVLEARN_UPDATE_GOLDEN=1 test_core -tc="the golden*"
TEST_CASE("the golden history of the paper's preset is repeated to the last bit") {
  check_golden("paper", LearnerConfig::paper());
}

TEST_CASE("the golden history of step 5's preset is repeated to the last bit") {
  check_golden("step5", LearnerConfig::step5());
}
