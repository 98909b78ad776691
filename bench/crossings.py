"""What crossings from Python cost: prints nanoseconds a call, as JSON.

With an argument it makes one phase of so many steps instead, for counting its instructions.
"""

from __future__ import annotations

import importlib.util
import json
import sys
from collections.abc import Callable
from itertools import repeat
from time import perf_counter

import devlearn
from devlearn import Learner, Trial, World

SEED, STEPS, REPEATS = 1, 10_000, 5


def best(run: Callable[[], object]) -> float:
    """The least time of some runs [ns], that of fewest disturbances."""
    times = []
    for _ in range(REPEATS):
        began = perf_counter()
        run()
        times.append(perf_counter() - began)
    return 1e9 * min(times)


def choose_and_learn(situations: list[int], smf: list[float]) -> None:
    """A free learning's choices and outcomes once more, from nothing."""
    learner = Learner(seed=SEED)
    choose, learn = learner.choose, learner.learn
    for situation, value in zip(situations, smf):
        choose(situation)
        learn(value)


def nothing(situations: list[int], smf: list[float]) -> None:
    """The loop alone."""
    for _ in zip(situations, smf):
        pass


def empty_calls(empty: Callable[[], None]) -> None:
    """As many calls of something that does nothing."""
    for _ in repeat(None, STEPS):
        empty()


def no_calls() -> None:
    """The loop alone."""
    for _ in repeat(None, STEPS):
        pass


def main() -> None:
    """Measures, or makes one phase."""
    trial = Trial(World.load("paper"), seed=SEED)
    if len(sys.argv) > 1:
        print(len(trial.free_learning(int(sys.argv[1]))))
        return
    record = trial.free_learning(STEPS)
    met = record.situation.tolist(), record.smf_used.tolist()
    measured = {
        "python/choose_learn": (best(lambda: choose_and_learn(*met)) - best(lambda: nothing(*met)))
        / STEPS
    }
    if importlib.util.find_spec("bench_crossing"):
        from bench_crossing import empty

        measured["python/empty_call"] = (best(lambda: empty_calls(empty)) - best(no_calls)) / STEPS
    print(json.dumps({"commit": devlearn._core.commit, **measured}))


if __name__ == "__main__":
    main()
