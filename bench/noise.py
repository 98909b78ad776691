"""How does learning fare where the robot neither moves nor knows its pose exactly?

The presets `paper` and `adaptive` in a world, 30 seeds (301-330), 300 rounds of path learning of at
most 2000 steps without free learning, at three levels of noise, each with exact odometry and with
one that drifts:

    little   turn 1 degree, drive 2 mm; odometry 0.2 degrees and 1 % a step
    some     turn 2 degrees, drive 5 mm, 2 % of motions random; odometry 0.5 degrees and 2 %
    much     turn 5 degrees, drive 10 mm, 5 % of motions random; odometry 1 degree and 5 %

What is told of each: the share of the last 50 rounds that arrived, and the median of their steps
over the shortest path's, over the seeds (median, 10-90 %); how often the robot took itself to be in
another situation than it was. Held good, as said before it was run: `adaptive` arrives in 95 % of
the last 50 rounds at the levels little and some.

    python bench/noise.py [SEEDS [WORLD]]
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

import numpy as np
from devlearn import AdaptiveConfig, NoiseDef, Robot, Trial, TrialConfig, World, shortest_path

MOVING = {
    "little": NoiseDef(turn=1, drive=0.002),
    "some": NoiseDef(turn=2, drive=0.005, slip=0.02),
    "much": NoiseDef(turn=5, drive=0.01, slip=0.05),
}
DRIFTING = {
    "little": {"odometry_turn": 0.2, "odometry_drive": 0.01},
    "some": {"odometry_turn": 0.5, "odometry_drive": 0.02},
    "much": {"odometry_turn": 1, "odometry_drive": 0.05},
}
LEVELS = (
    {"none": NoiseDef()}
    | {f"{level}, exact odometry": noise for level, noise in MOVING.items()}
    | {level: noise.replace(**DRIFTING[level]) for level, noise in MOVING.items()}
)
PRESETS = {
    "paper": TrialConfig(),
    "adaptive": TrialConfig.adaptive(),
    "adaptive, tolerance 0.3": TrialConfig(learner=AdaptiveConfig(tolerance=0.3)),
}
ROUNDS, LAST, LIMIT = 300, 50, 2000


def rows(seeds: int, world: World) -> Iterator[str]:
    """A line of the table each."""
    shortest = shortest_path(Robot(world), world.start).steps
    for level, noise in LEVELS.items():
        for name, preset in PRESETS.items():
            config = preset.replace(noise=noise)
            made = [last_rounds(world, config, 301 + i) for i in range(seeds)]
            arrived, steps, elsewhere = np.array(made).T
            low, middle, high = np.percentile(steps / shortest, (10, 50, 90))
            yield (
                f"| {level} | {name} | {arrived.mean():.1%} (least {arrived.min():.0%}) "
                f"| {middle:.2f} ({low:.2f}-{high:.2f}) | {elsewhere.mean():.0%} |"
            )


def last_rounds(world: World, config: TrialConfig, seed: int) -> tuple[float, float, float]:
    """Share that arrived, median steps, and share of steps in another situation than believed."""
    record = Trial(world, config, seed).path_learning(ROUNDS, LIMIT)
    last = record.rounds[-LAST:]
    elsewhere = (record.situation != record.true_situation).mean()
    return last["arrived"].mean(), np.median(last["steps"]), elsewhere


if __name__ == "__main__":
    print("| noise | preset | arrived | steps / shortest | elsewhere |")
    print("|---|---|---|---|---|")
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    for row in rows(seeds, World.load(sys.argv[2] if len(sys.argv) > 2 else "paper")):
        print(row, flush=True)
