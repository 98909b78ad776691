"""What is asked of the speed, as ratios within one run.

A measurement is named as its benchmark is: nanoseconds per step, unless its name says otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

Measured = Mapping[str, float]

FLOOR = "floor/move_and_5_rays"
Q = "q_learning/4800"
LOOP = "trial/closed_loop"
CONTACT = "contact/step"


class Item(NamedTuple):
    """One thing asked: a value, computed from what was measured, and its bound."""

    group: str
    what: str
    sign: str  # '<=' or '>='
    bound: float
    value: Callable[[Measured], float]

    def holds(self, value: float) -> bool:
        """Whether a value keeps to the bound."""
        return value <= self.bound if self.sign == "<=" else value >= self.bound

    def worsening(self, earlier: float, now: float) -> float:
        """By which factor a value has become worse."""
        return now / earlier if self.sign == "<=" else earlier / now


def ratio(above: str, below: str) -> Callable[[Measured], float]:
    """One measurement over another."""
    return lambda m: m[above] / m[below]


def free_loop(m: Measured) -> float:
    """The closed loop over the steps that touch nothing.

    From the whole run is taken what its contacts cost more than free steps do. Moving is the only
    stage that treats them differently, and is measured on the same steps, replayed.
    """
    share = m["contact_share"]
    return m[LOOP] - share * (m[CONTACT] - m["contact/free_step"])


def with_echoes(m: Measured) -> float:
    """A run that records echoes, over the bare raycasts and the same run without."""
    return m["trial/closed_loop_echoes"] / (m["box2d/5_raycasts_2.1m"] + m[LOOP])


def crossing(m: Measured) -> float:
    """What choose and learn cost beyond C++ when called from Python, in empty calls."""
    return (m["python/choose_learn"] - m["learner/replay"]) / m["python/empty_call"]


ITEMS = [
    Item("0 denominators", "floor / five Box2D raycasts of 3 m", "<=", 0.33,
         ratio(FLOOR, "box2d/5_raycasts_3m")),
    Item("0 denominators", "least Q-learning loop / floor", "<=", 0.2, ratio(Q, FLOOR)),
    Item("1 learner", "replay of a free learning / Q loop", "<=", 2.0, ratio("learner/replay", Q)),
    Item("1 learner", "random among 4.8 million / Q loop of that size", "<=", 3.5,
         ratio("learner/random_4800000", "q_learning/4800000")),
    Item("2 closed loop", "free steps / floor", "<=", 2.0, lambda m: free_loop(m) / m[FLOOR]),
    Item("2 closed loop", "Box2D at 60 Hz / free steps", ">=", 25.0,
         lambda m: m["box2d/closed_loop_60hz"] / free_loop(m)),
    Item("2 closed loop", "contact step / plain stepping of it", "<=", 1.0,
         ratio(CONTACT, "contact/plain")),
    Item("2 closed loop", "whole free learning / floor", "<=", 4.0, ratio(LOOP, FLOOR)),
    Item("2 closed loop", "whole experiment / floor", "<=", 4.0, ratio("trial/experiment", FLOOR)),
    Item("2 closed loop", "600 rounds of the adaptive learner / of the paper's", "<=", 2.5,
         ratio("trial/600_rounds_adaptive", "trial/600_rounds")),
    Item("2 closed loop", "rounds alone, with a tally / without", "<=", 1.06,
         ratio("trial/rounds_only_tally", "trial/rounds_only")),
    Item("3 echoes", "five sonars recorded / (raycasts + closed loop)", "<=", 1.5, with_echoes),
    Item("4 growth", "whether a step is free: 8000 / 8 obstacles, arena kept", "<=", 1.5,
         ratio("clearance/free_step_8000", "clearance/free_step")),
    Item("4 growth", "8192 / 8 obstacles, arena grown", "<=", 1.5,
         ratio("trial/8192_obstacles_arena_grown", LOOP)),
    Item("4 growth", "8000 / 8 obstacles, arena kept", "<=", 1.5,
         ratio("trial/8000_obstacles_arena_kept", LOOP)),
    Item("4 growth", "bytes per experienced situation, reserved", "<=", 96.0,
         lambda m: m["memory/reserved_mean"]),
    # No more than all of the world's 4800 situations come to.
    Item("4 growth", "memory of 10^8 steps beyond the first 10^6 [MB]", "<=", 1.0,
         lambda m: m["endurance/growth_mb"]),
    Item("5 Python", "instructions of a phase / those from C++", "<=", 1.02,
         ratio("instructions/phase_python", "instructions/phase_cpp")),
    Item("5 Python", "choose + learn beyond C++, in empty calls", "<=", 8.0, crossing),
    Item("6 many runs", "runs of 2 workers / of 1", ">=", 1.9,
         ratio("runs/per_second_2", "runs/per_second_1")),
    Item("6 many runs", "a sweep's two workers / two processes by themselves", ">=", 0.97,
         ratio("runs/per_second_2", "runs/per_second_of_two_processes")),
    Item("6 many runs", "store / run", "<=", 0.02, lambda m: m["runs/store_share"]),
    Item("6 many runs", "start-up of a worker [s]", "<=", 0.3, lambda m: m["runs/start_up"]),
    Item("7 import", "devlearn beyond numpy [ms]", "<=", 50.0, lambda m: m["import/devlearn"]),
    Item("7 import", "devlearn --help: needless modules", "<=", 0.0,
         lambda m: m["import/needless_for_help"]),
]  # fmt: skip

# Figures without a bound, for people.
FIGURES = {
    "whole experiments per minute on two cores": lambda m: 60.0 * m["runs/per_second_2"],
    "replay with memory asked for as it goes / Q loop": ratio("learner/replay_from_nothing", Q),
    "adaptive learner: bytes a situation, five motions": lambda m: m["memory/adaptive_situation"],
    "adaptive learner: bytes an outcome": lambda m: m["memory/adaptive_outcome"],
    "bytes per situation with spare capacity": lambda m: m["memory/grown_mean"],
    "free steps of the closed loop [ns]": free_loop,
    "share of contacts in a free learning": lambda m: m["contact_share"],
}

# Where the time of a step of the closed loop goes [ns, instructions], contacts by their share.
STAGES = {
    "choose and learn": lambda m: m["learner/replay_from_nothing"],
    "move, where nothing is touched": lambda m: (1.0 - m["contact_share"]) * m["contact/free_step"],
    "move, where something is": lambda m: m["contact_share"] * m[CONTACT],
    "nearest obstacle, situation, evaluation, record": lambda m: (
        m[LOOP]
        - m["learner/replay_from_nothing"]
        - m["contact_share"] * m[CONTACT]
        - (1.0 - m["contact_share"]) * m["contact/free_step"]
    ),
    "all": lambda m: m[LOOP],
}

# Whose instructions are counted: what the ratios above need, and the stages of a step.
COUNTED = (
    FLOOR, Q, LOOP, CONTACT, "learner/replay", "learner/replay_from_nothing", "contact/free_step",
    "contact/plain", "clearance/geometric", "clearance/free_step", "sonar/5",
    "box2d/5_raycasts_3m", "box2d/5_raycasts_2.1m", "box2d/closed_loop_60hz",
    "trial/closed_loop_echoes", "trial/experiment",
)  # fmt: skip


def value_of(item: Item, measured: Measured) -> float:
    """Its value, NaN where not all of it was measured."""
    try:
        return item.value(measured)
    except KeyError:
        return math.nan
