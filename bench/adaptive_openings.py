"""Do curious rounds notice that a shorter way has opened? Criteria, and what came of them.

Seven worlds in which something then opens: a wall is removed, shortened, or gets a gap. 300 rounds
before, 300 after; seeds 100 on. An opening is found in the first round within 1.25 of the new
shortest path. Control: the same without curious rounds.

Held good, as said before it was run: with curious rounds every opening is found, and in the median
over all runs within 40 rounds.

    python bench/adaptive_openings.py [SEEDS]
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from devlearn import (
    AdaptiveConfig,
    Polygon,
    Rectangle,
    Robot,
    Trial,
    TrialConfig,
    World,
    shortest_path,
)

BEFORE, AFTER, WITHIN, MEDIAN = 300, 300, 1.25, 40


ACROSS = ((0.51, 2.515, 0.0), (4.4, 2.5))
UPWARDS = ((2.515, 0.51, 90.0), (2.5, 4.4))


def openings() -> dict[str, tuple[World, World]]:
    """Name: the world before and after."""
    slalom, trap = World.load("slalom"), World.load("u_trap")
    corridor, paper = World.load("corridor"), World.load("paper")

    def with_obstacles(world: World, *obstacles: Any) -> World:
        return World(start=world.start, target=world.target, obstacles=obstacles, name=world.name)

    def walled(ways: tuple[Any, Any], *obstacles: Any) -> World:
        return World(start=ways[0], target=ways[1], obstacles=obstacles)

    upright, level = Rectangle((2.5, 2.05), (0.1, 4.2)), Rectangle((2.05, 2.5), (4.2, 0.1))
    return {
        "slalom, second wall removed": (
            slalom,
            with_obstacles(slalom, *(o for i, o in enumerate(slalom.obstacles) if i != 1)),
        ),
        "slalom, a gap in the second wall": (
            slalom,
            with_obstacles(
                slalom,
                slalom.obstacles[0],
                *slalom.obstacles[2:],
                Rectangle((2.15, 1.75), (0.1, 1.3)),
                Rectangle((2.15, 4.1), (0.1, 1.9)),
            ),
        ),
        "u_trap, a gap in its back": (
            trap,
            with_obstacles(
                trap,
                Polygon([(1.6, 1.4), (3.2, 1.4), (3.2, 2.1), (3.0, 2.1), (3.0, 1.6), (1.6, 1.6)]),
                Polygon([(1.6, 3.6), (1.6, 3.4), (3.0, 3.4), (3.0, 2.9), (3.2, 2.9), (3.2, 3.6)]),
            ),
        ),
        "an upright wall, a gap in its middle": (
            walled(ACROSS, upright),
            walled(ACROSS, Rectangle((2.5, 1.0), (0.1, 2.1)), Rectangle((2.5, 3.55), (0.1, 1.2))),
        ),
        "a level wall, a gap in its middle": (
            walled(UPWARDS, level),
            walled(UPWARDS, Rectangle((1.0, 2.5), (2.1, 0.1)), Rectangle((3.55, 2.5), (1.2, 0.1))),
        ),
        "corridor, its corner cut": (
            corridor,
            with_obstacles(
                corridor,
                Polygon([(-0.05, 0.9), (1.0, 0.9), (4.1, 4.0), (4.1, 5.05), (-0.05, 5.05)]),
            ),
        ),
        "paper, a wall across removed": (
            walled(ACROSS, *paper.obstacles, Rectangle((2.9, 2.05), (0.1, 4.2))),
            walled(ACROSS, *paper.obstacles),
        ),
    }


def found_after(before: World, after: World, every: int, seed: int, shortest: int) -> int | None:
    """Rounds after the opening until one is within WITHIN of the shortest; None where none is."""
    config = TrialConfig.adaptive().replace(learner=AdaptiveConfig(curious_every=every))
    trial = Trial(before, config, seed=seed)
    trial.path_learning(rounds=BEFORE, rounds_only=True)
    rounds = Trial(after, config, agent=trial.learner).path_learning(AFTER, rounds_only=True).rounds
    good = np.flatnonzero(rounds["arrived"] & (rounds["steps"] <= WITHIN * shortest))
    return int(good[0]) + 1 if len(good) else None


def main() -> None:
    """Prints a line an opening, and whether the criteria hold."""
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    found: dict[int, list[int | None]] = {10: [], 0: []}
    for name, (before, after) in openings().items():
        was, now = (shortest_path(Robot(world)).steps or 0 for world in (before, after))
        assert 0 < WITHIN * now < was, (name, was, now)
        line = f"{name:38} {was:4} -> {now:4}"
        for every, all_of in found.items():
            these = [
                found_after(before, after, every, seed, now) for seed in range(100, 100 + seeds)
            ]
            all_of += these
            line += f"   {'curious' if every else 'without'}: {these}"
        print(line, flush=True)
    curious = [n for n in found[10] if n is not None]
    print(f"curious rounds: {len(curious)} of {len(found[10])}, median {np.median(curious):.0f}")
    print(f"without: {sum(n is not None for n in found[0])} of {len(found[0])}")
    good = len(curious) == len(found[10]) and np.median(curious) <= MEDIAN
    print("holds" if good else "FAILS")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
