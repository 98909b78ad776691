"""What do devlearn's learners come to in Gymnasium's environments? Criteria, and what came of them.

Eight tasks, each with a budget of episodes; seeds 100 on. A run learns for its budget; then 100
episodes are played by what it has learned, and nothing is learned any more. A run's score is their
mean return. Beside them random motions, and the Q-learning of Gymnasium's tutorials (FrozenLake by
A. Pierre, action masking in Taxi, Blackjack by T. Zemann), written anew as they have it, settings
and all, in the tasks that they are about.

The paper's learner runs twice: by reward, and by an SEF that knows the task, which is knowledge
that nobody else here has. `adaptive` is told costs; its estimate is 1 everywhere: it knows nothing.
Q-learning runs by reward, and, where they are not the same, by the costs that `adaptive` is told.

Held good, as said before it was run with seeds 100 to 119, and after a look at seeds 3 and 4, by
which settings were found:

1. `adaptive` comes to the best return in at least 18 of 20 runs in both lakes that are not slippery
   and at the cliff; in the mean to at least 0.70 in the slippery lake and 475 in CartPole
   (Gymnasium's thresholds), 7.5 in Taxi, -150 in MountainCar.
2. devlearn's Q-learning and the tutorial's, with the same settings, have intervals that overlap in
   the lakes.
3. By reward the paper's learner is nowhere but in Blackjack better than 0.1 of the way from random
   motions to the best of the others.
4. By its SEF it comes to the best return in at least 18 of 20 runs in the small lake that is not
   slippery and at the cliff, and to at least -130 in MountainCar in the mean; to less than 0.2 in
   the slippery lake and less than 0 in Taxi.

    python bench/other_environments.py [SEEDS [TASK ...]]
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import gymnasium
import numpy as np
from devlearn import (
    AdaptiveConfig,
    AdaptiveLearner,
    Learner,
    LearnerConfig,
    Random,
    RandomAgent,
)
from devlearn.agents import QLearning
from devlearn.envs import LearnerOn, TileSituations
from devlearn.experiments.statistics import Estimate, bootstrap, mean
from gymnasium.envs.toy_text.frozen_lake import generate_random_map

PLAYED = 100
FIRST_SEED = 100


def make(name: str, **settings: Any) -> gymnasium.Env[Any, Any]:
    """The newest version of an environment, without the checks that Gymnasium adds to each step."""
    versions = [spec for spec in gymnasium.registry.values() if spec.name == name]
    return gymnasium.make(
        max(versions, key=lambda spec: spec.version or 0), disable_env_checker=True, **settings
    )


# --- the agents of the tutorials ------------------------------------------------------------------


@dataclass(frozen=True)
class Tutorial:
    """Q-learning as a tutorial has it."""

    alpha: float
    gamma: float
    epsilon: Callable[[int], float]  # of the episode's number
    draws_among_best: bool = False  # otherwise the first of them
    learns_from_the_end: bool = True  # the one in Taxi does not

    def play(self, env: gymnasium.Env[Any, Any], episodes: int, seed: int) -> np.ndarray:
        """Returns of PLAYED greedy episodes after so many of learning."""
        random = np.random.default_rng(seed)
        table: dict[Any, np.ndarray] = {}
        actions = int(env.action_space.n)

        def values(state: Any) -> np.ndarray:
            return table.setdefault(state, np.zeros(actions))

        def among(info: dict[str, Any]) -> np.ndarray:
            return np.flatnonzero(info.get("action_mask", np.ones(actions)))

        def best(state: Any, info: dict[str, Any]) -> int:
            allowed = among(info)
            of = values(state)[allowed]
            if self.draws_among_best:
                return int(random.choice(allowed[of == of.max()]))
            return int(allowed[of.argmax()])

        for episode in range(episodes):
            state, info = env.reset(seed=seed if episode == 0 else None)
            over = False
            while not over:
                explores = random.random() < self.epsilon(episode)
                action = int(random.choice(among(info))) if explores else best(state, info)
                after, reward, terminated, truncated, info = env.step(action)
                over = terminated or truncated
                if not over or self.learns_from_the_end:
                    future = 0.0 if terminated else values(after)[among(info)].max()
                    target = float(reward) + self.gamma * future
                    values(state)[action] += self.alpha * (target - values(state)[action])
                state = after

        returns = np.zeros(PLAYED)
        for i in range(PLAYED):
            state, info = env.reset(seed=Random(seed, f"evaluation {i}").next() % 2**31)
            over = False
            while not over:
                state, reward, terminated, truncated, info = env.step(best(state, info))
                returns[i] += reward
                over = terminated or truncated
        return returns


LAKE = Tutorial(0.8, 0.95, lambda _: 0.1, draws_among_best=True)
TAXI = Tutorial(0.1, 0.95, lambda _: 0.1, learns_from_the_end=False)


def blackjack(episodes: int) -> Tutorial:
    """Its epsilon falls from 1 to 0.1 over the first half."""
    return Tutorial(0.01, 0.95, lambda episode: max(0.1, 1.0 - 2.0 * episode / episodes))


# --- the tasks, and what an SEF may know of them --------------------------------------------------


@dataclass(frozen=True)
class Task:
    """An environment, a budget, and how each learner is told of it."""

    make: Callable[[], gymnasium.Env[Any, Any]]
    episodes: int
    q: QLearning.Config
    adaptive: dict[str, Any] = field(default_factory=dict)
    cost: Callable[[float, bool], float] | None = None
    arrived: Callable[[float], bool] | None = None
    sef: Callable[[Any], float] | None = None
    situations: Callable[[gymnasium.Env[Any, Any]], Callable[[Any], int]] | None = None
    tutorial: Tutorial | None = None


def lake_sef(board: list[str]) -> Callable[[int], float]:
    """Less the steps to the goal as if there were no holes, and 10 less in one."""
    size = len(board)

    def sef(place: int) -> float:
        row, column = divmod(place, size)
        return -float(2 * (size - 1) - row - column) - 10.0 * (board[row][column] == "H")

    return sef


def cliff_sef(place: int) -> float:
    """Less the steps to the goal, round the cliff."""
    row, column = divmod(place, 12)
    if row < 3:
        return -float(3 - row + 11 - column)
    return -float(0 if column == 11 else 1 + 11 - column + 1)


STANDS = ((0, 0), (0, 4), (4, 0), (4, 3))


def taxi_sef(state: int) -> float:
    """Less the way to the passenger and on to where the passenger goes, walls left out."""
    state, to = divmod(state, 4)
    state, at = divmod(state, 5)
    taxi = divmod(state, 5)

    def way(a: tuple[int, int], b: tuple[int, int]) -> int:
        return abs(a[0] - b[0]) + abs(a[1] - b[1])

    if at == 4:
        return -float(way(taxi, STANDS[to]))
    if at == to:
        return 1.0
    return -float(way(taxi, STANDS[at]) + 1 + way(STANDS[at], STANDS[to]))


def car_sef(seen: np.ndarray) -> float:
    """Its energy, as the environment computes hill and engine, in units that suit eta."""
    position, velocity = float(seen[0]), float(seen[1])
    return 1e5 * (velocity**2 / 2 + 0.0025 / 3 * math.sin(3 * position))


def pole_sef(seen: np.ndarray) -> float:
    """Less how far from upright the pole will be in half a second."""
    return -10.0 * abs(float(seen[2]) + 0.5 * float(seen[3]))


SMALL = ["SFFF", "FHFH", "FFFH", "HFFG"]
LARGE = generate_random_map(size=11, p=0.9, seed=123)  # the tutorial's
BY_CHANCE = {"hold_limit": 1, "patience": 1_000_000, "enough": 1e9}  # no habit, no short cut home


def hole_costs(most: float) -> Callable[[float, bool], float]:
    """A step costs 1, a hole so much more."""
    return lambda reward, terminated: 1.0 + most * (terminated and reward == 0)


def won(reward: float) -> bool:
    """Whether an end was a good one."""
    return reward > 0


def tiles(counts: int) -> Callable[[gymnasium.Env[Any, Any]], TileSituations]:
    """Even ones."""
    return lambda env: TileSituations.even(env.observation_space, counts)


LAKE_Q = QLearning.Config(alpha=0.8, gamma=0.95, epsilon=0.1)
BLACKJACK = 20_000
TASKS = {
    "FrozenLake, 4 x 4, not slippery": Task(
        lambda: make("FrozenLake", desc=SMALL, is_slippery=False),
        2000, LAKE_Q, {"hold_limit": 1}, hole_costs(100), won, lake_sef(SMALL), tutorial=LAKE,
    ),
    "FrozenLake, 11 x 11, not slippery": Task(
        lambda: make("FrozenLake", desc=LARGE, is_slippery=False),
        2000, LAKE_Q, {"hold_limit": 1}, hole_costs(100), won, lake_sef(LARGE), tutorial=LAKE,
    ),
    "FrozenLake, 4 x 4, slippery": Task(
        lambda: make("FrozenLake", desc=SMALL, is_slippery=True),
        2000, LAKE_Q, BY_CHANCE, hole_costs(1000), won, lake_sef(SMALL), tutorial=LAKE,
    ),
    "CliffWalking": Task(
        lambda: gymnasium.wrappers.TimeLimit(make("CliffWalking"), 200),
        500, QLearning.Config(alpha=0.5, gamma=1.0, epsilon=0.1), {"hold_limit": 1}, None, None,
        cliff_sef,
    ),
    "Taxi": Task(
        lambda: make("Taxi"),
        2000, QLearning.Config(alpha=0.1, gamma=0.95, epsilon=0.1),
        {"hold_limit": 1, "enough": 1e9},
        lambda reward, terminated: 21.0 * terminated - reward, None, taxi_sef, tutorial=TAXI,
    ),
    "Blackjack": Task(
        lambda: make("Blackjack", sab=True),
        BLACKJACK, QLearning.Config(alpha=0.01, gamma=0.95, epsilon=0.1), BY_CHANCE,
        lambda reward, terminated: 100.0 * (terminated - reward), won,
        tutorial=blackjack(BLACKJACK),
    ),
    "CartPole": Task(
        lambda: make("CartPole"),
        500, QLearning.Config(alpha=0.1, gamma=0.99, epsilon=0.1), {"enough": 1e9},
        lambda reward, terminated: 100.0 * terminated, lambda _: False, pole_sef,
        lambda env: TileSituations.from_quantiles(env, [4, 4, 8, 8], warm_up=5000),
    ),
    "MountainCar": Task(
        lambda: make("MountainCar"),
        500, QLearning.Config(alpha=0.1, gamma=1.0, epsilon=0.1), {"enough": 1e9}, None, None,
        car_sef, tiles(20),
    ),
}  # fmt: skip


# --- runs -----------------------------------------------------------------------------------------


def score(task: Task, who: str, seed: int) -> float | None:
    """The mean return after the budget; None where who has no part in the task."""
    env = task.make()
    if who == "tutorial":
        if task.tutorial is None:
            return None
        return float(task.tutorial.play(env, task.episodes, seed).mean())
    motions = int(env.action_space.n)
    functions: dict[str, Any] = {"situations": task.situations and task.situations(env)}
    learner: Any
    if who == "random":
        learner = RandomAgent(seed)
    elif who == "Q-learning":
        learner = QLearning(task.q, seed)
    elif who == "Q-learning, costs":
        if task.cost is None:
            return None
        learner = QLearning(task.q, seed)
        functions["cost"] = task.cost
    elif who == "adaptive":
        learner = AdaptiveLearner(AdaptiveConfig(motion_count=motions, **task.adaptive), seed)
        functions["cost"], functions["arrived"] = task.cost, task.arrived
    else:
        learner = Learner(LearnerConfig(motion_count=motions), seed)
        functions["evaluation"] = "reward" if who == "paper, reward" else task.sef
        if functions["evaluation"] is None:
            return None
    on = LearnerOn(env, learner, **functions)
    if who != "random":
        on.run(task.episodes, seed=seed)
    return float(on.evaluate(PLAYED, seed=seed)["return"].mean())


WHO = [
    "random", "paper, reward", "paper, SEF", "adaptive", "Q-learning", "Q-learning, costs",
    "tutorial",
]  # fmt: skip


def judge(scores: dict[str, dict[str, np.ndarray]], told: dict[str, dict[str, Estimate]]) -> bool:
    """Says which criteria hold; whether all do."""
    small, large, slippery, cliff, taxi, cards, pole, car = TASKS

    def of(task: str, who: str) -> float:
        return told[task][who].value

    def share(task: str, who: str, least: float) -> float:
        return float(np.mean(scores[task][who] >= least))

    def overlap(task: str) -> bool:
        a, b = told[task]["Q-learning"], told[task]["tutorial"]
        return a.low <= b.high and b.low <= a.high

    def gained(task: str) -> float:
        floor = of(task, "random")
        top = max(estimate.value for estimate in told[task].values())
        return (of(task, "paper, reward") - floor) / (top - floor)

    criteria = {
        "1 adaptive": all(
            share(task, "adaptive", best) >= 0.9
            for task, best in ((small, 1.0), (large, 1.0), (cliff, -13.0))
        )
        and all(
            of(task, "adaptive") >= least
            for task, least in ((slippery, 0.7), (pole, 475.0), (taxi, 7.5), (car, -150.0))
        ),
        "2 the same Q-learning": all(map(overlap, (small, large, slippery))),
        "3 paper by reward": all(gained(task) <= 0.1 for task in TASKS if task != cards),
        "4 paper by SEF": share(small, "paper, SEF", 1.0) >= 0.9
        and share(cliff, "paper, SEF", -13.0) >= 0.9
        and of(car, "paper, SEF") >= -130
        and of(slippery, "paper, SEF") < 0.2
        and of(taxi, "paper, SEF") < 0,
    }
    for name, holds in criteria.items():
        print(f"{'holds' if holds else 'FAILS'}: {name}")
    return all(criteria.values())


def main() -> None:
    """Prints a row a task, as Markdown, and whether the criteria hold."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    chosen = sys.argv[2:] or list(TASKS)
    scores: dict[str, dict[str, np.ndarray]] = {}
    told: dict[str, dict[str, Estimate]] = {}
    print("| task, episodes | " + " | ".join(WHO) + " | s |\n|" + "---|" * (len(WHO) + 2))
    for name in chosen:
        began = time.process_time()
        scores[name], told[name], cells = {}, {}, []
        for who in WHO:
            found = [score(TASKS[name], who, FIRST_SEED + i) for i in range(seeds)]
            if found[0] is None:
                cells.append("")
                continue
            scores[name][who] = np.array(found)
            estimate = told[name][who] = bootstrap(mean, scores[name][who][:, None])
            cells.append(f"{estimate.value:.4g} ({estimate.low:.4g} to {estimate.high:.4g})")
        took = time.process_time() - began
        row = " | ".join(cells)
        print(f"| {name}, {TASKS[name].episodes} | {row} | {took:.0f} |", flush=True)
    if chosen == list(TASKS):
        sys.exit(0 if judge(scores, told) else 1)


if __name__ == "__main__":
    main()
