#pragma once

#include <string>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/motor_memory.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// Why motions are chosen in a situation: all that step 3 makes of its memory. Of N motions, n are
/// effective. Where not every motion is allowed, n and n_R of the probabilities count those that
/// are.
struct Explanation {
  SituationId situation = -1;       ///< which
  SituationMemory memory;           ///< what the choice goes by: lists, orientations, counts
  std::vector<bool> allowed;        ///< N: whether each motion of M may be chosen
  double explore = 0.0;             ///< probability to explore, n_R / (n + n_R)
  double exploit = 0.0;             ///< probability to exploit, n / (n + n_R)
  double exhausted = 0.0;           ///< 1 where nothing is left to explore or exploit, otherwise 0
  std::vector<double> probability;  ///< N: of each motion of M to be chosen; they sum to 1
  std::vector<double> curiosity;    ///< n: c_ik of each effective motion, Eq. 5
  std::vector<double> op_plain;     ///< n: op of each, another one's curiosity active, Eq. 7
  std::vector<double> op_curious;   ///< n: op of each, its own curiosity active, Eq. 7
  std::vector<int> winner;  ///< n: the motion that wins where the curiosity of each is active; -1
                            ///< of one that is not allowed, whose curiosity is never active
};

/// Why one choice came out as it did.
struct ChoiceTrace {
  Explanation explanation;  ///< of the situation as the choice found it
  Choice choice;            ///< what came out
  int curious = -1;         ///< the motion whose curiosity was drawn; -1 unless exploited
  std::vector<double> op;   ///< n: op of each effective motion, Eq. 7; empty unless exploited
};

/// Explains the choices in a situation's memory.
Explanation explain(SituationId situation, const MotorMemory& memory, double sigma,
                    const Curiosity& curiosity, AllowedMotions allowed = {});

/// Explains the choice that a draw led to.
ChoiceTrace trace(SituationId situation, const MotorMemory& memory, int draw, double sigma,
                  const Curiosity& curiosity, AllowedMotions allowed = {});

/// A table for people, a line a motion.
std::string to_text(const Explanation& explanation);
std::string to_text(const ChoiceTrace& trace);

}  // namespace devlearn
