#include "devlearn/explanation.hpp"

#include <algorithm>

#include "lines.hpp"
#include "op.hpp"

namespace devlearn {
namespace {

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kExplore:
      return "explored";
    case Kind::kExploit:
      return "exploited";
    case Kind::kExhausted:
      return "drawn from all, for none is effective";
    default:
      return "chosen";
  }
}

}  // namespace

Explanation explain(SituationId situation, const MotorMemory& memory, double sigma,
                    const Curiosity& curiosity, AllowedMotions allowed) {
  const int n = memory.effective_count(), motions = memory.motion_count();
  const Candidates left = candidates(memory, allowed);
  const int draws = left.count();
  Explanation why;
  why.situation = situation;
  why.memory = memory.copy();
  for (int motion = 0; motion < motions; ++motion) why.allowed.push_back(allowed(motion));
  why.explore = static_cast<double>(left.unexplored) / draws;
  why.exploit = static_cast<double>(left.effective) / draws;
  why.exhausted = left.any > 0 ? 1.0 : 0.0;
  for (const std::uint32_t times_learned : why.memory.times_learned) {
    why.curiosity.push_back(curiosity(times_learned));
  }
  why.op_plain.resize(why.curiosity.size());
  why.op_curious.resize(why.curiosity.size());
  const ConstArray o(memory.orientations(), n), c(why.curiosity.data(), n);
  Array(why.op_plain.data(), n) = op(o, 0.0 * c, sigma);
  Array(why.op_curious.data(), n) = op(o, c, sigma);

  for (int j = 0; j < n; ++j) {
    const bool drawn = allowed(memory.motion(j));
    why.winner.push_back(drawn ? memory.motion(winner(memory, j, sigma, curiosity, allowed)) : -1);
  }
  std::vector<int> draws_of(static_cast<std::size_t>(motions));
  for (int draw = 0; draw < draws; ++draw) {
    const int place = choose_motion(memory, left, draw, sigma, curiosity, allowed);
    ++draws_of[static_cast<std::size_t>(memory.motion(place))];
  }
  for (const int count : draws_of) {
    why.probability.push_back(static_cast<double>(count) / draws);
  }
  return why;
}

ChoiceTrace trace(SituationId situation, const MotorMemory& memory, int draw, double sigma,
                  const Curiosity& curiosity, AllowedMotions allowed) {
  const Candidates left = candidates(memory, allowed);
  ChoiceTrace trace;
  trace.explanation = explain(situation, memory, sigma, curiosity, allowed);
  const int place = choose_motion(memory, left, draw, sigma, curiosity, allowed);
  trace.choice = choice_at(memory, place);
  if (trace.choice.kind == Kind::kExploit) {
    const int curious = nth_allowed(memory, 0, draw - left.unexplored, allowed);
    trace.curious = memory.motion(curious);
    trace.op = trace.explanation.op_plain;
    trace.op[static_cast<std::size_t>(curious)] =
        trace.explanation.op_curious[static_cast<std::size_t>(curious)];
  }
  return trace;
}

std::string to_text(const Explanation& why) {
  const auto note = [&](int motion) {
    return why.allowed[static_cast<std::size_t>(motion)] ? "" : "  (not allowed)";
  };
  std::string text = "situation " + std::to_string(why.situation);
  append(text, ": explore %.3g, exploit %.3g, exhausted %.3g\n", why.explore, why.exploit,
         why.exhausted);
  text += "motion  list         probability  orientation  learned  curiosity  op      op curious\n";
  for (std::size_t j = 0; j < why.memory.effective.size(); ++j) {
    const int motion = why.memory.effective[j];
    append(text, "%6d  effective    %-11.4g  %-11.4g  %-7u  %-9.3g  %-6.4f  %.4f%s\n", motion,
           why.probability[static_cast<std::size_t>(motion)], why.memory.orientation[j],
           why.memory.times_learned[j], why.curiosity[j], why.op_plain[j], why.op_curious[j],
           note(motion));
  }
  const auto list = [&](const std::vector<int>& motions, const char* name) {
    for (const int motion : motions) {
      append(text, "%6d  %-11s  %.4g%s\n", motion, name,
             why.probability[static_cast<std::size_t>(motion)], note(motion));
    }
  };
  list(why.memory.ineffective, "ineffective");
  list(why.memory.unexplored, "unexplored");
  return text;
}

std::string to_text(const ChoiceTrace& trace) {
  std::string text;
  append(text, "motion %d, %s", trace.choice.motion, name_of(trace.choice.kind));
  if (trace.curious >= 0) {
    const auto& effective = trace.explanation.memory.effective;
    const auto j = static_cast<std::size_t>(
        std::find(effective.begin(), effective.end(), trace.choice.motion) - effective.begin());
    append(text, " with op %.4f; curious about motion %d", trace.op[j], trace.curious);
  }
  return text + "\n" + to_text(trace.explanation);
}

}  // namespace devlearn
