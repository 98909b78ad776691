"""Measures what docs/who_is_who/iac.md tells of Iac in its task, and draws iac_attention.png.

    python docs/images/iac.py

The criteria stand on that page, and were written there before this was run.
"""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from devlearn import Observation, Random
from devlearn.agents import Iac
from devlearn.plots.panels import png
from devlearn.plots.style import GREEN, GREY, ORANGE, STYLE
from devlearn.tasks import Attention
from matplotlib.figure import Figure

SEEDS = range(30)
STEPS, SPAN, TEST_EVERY, TEST_SIZE = 5000, 250, 500, 300
WINDOWS = {"theta 25, tau 15, typical in the paper": (25, 15), "theta 100, tau 150": (100, 150)}
ZONES = {"moves at random": GREY, "stays": ORANGE, "jumps to the robot": GREEN}


def test_set(seed):
    """What random motions lead to where the toy stays: distance, motion, next distance."""
    task, random, found = Attention(), Random(seed, "test set"), []
    task.begin(seed + 1_000_000)
    while len(found) < TEST_SIZE:
        before, motion = task.distance, random.index(task.motion_count)
        task.step(motion)
        if task.zone(motion) == 1:
            found.append((before, motion, task.distance))
    return found


def test_error(agent, task, tests):
    """The mean squared error of what is predicted where the toy stays."""
    errors = []
    for before, motion, after in tests:
        predicted = agent.predict(Observation(0, task.motion_count, senses=[before]), motion)
        errors.append((predicted[0] - after) ** 2)
    return np.mean(errors)


def lived(config, seed):
    """The zone of each step, the test errors, and the regions."""
    task, tests = Attention(), test_set(seed)
    agent = Iac(config, seed, motors=task.motors)
    zone_of = [task.zone(motion) for motion in range(task.motion_count)]
    task.begin(seed)
    zones, errors = [], []
    for step in range(1, STEPS + 1):
        motion = agent.choose(task.observation()).motion
        zones.append(zone_of[motion])
        outcome = task.step(motion)
        agent.observe(outcome)
        if step % TEST_EVERY == 0:
            errors.append(test_error(agent, task, tests))
    return np.array(zones), np.array(errors), agent.regions()


def share(zones, first, last):
    """The shares of the zones in steps first ... last, counted from 1."""
    return np.array([np.mean(zones[first - 1 : last] == zone) for zone in range(3)])


def regions_in_zones(regions):
    """How many leaves lie in each zone by the middle of their frequencies; few lie in none."""
    leaves = regions[regions["split_dimension"] < 0]
    low = np.maximum(leaves["lower"][:, 3], 0.0)
    high = np.minimum(leaves["upper"][:, 3], 1.0)
    one_zone = high - low < 0.4
    return np.bincount((3 * (low + high)[one_zone] / 2).astype(int), minlength=3)[:3]


def tell(name, runs):
    """The figures of the page."""
    print(f"\n{name}")
    for first, last in ((1, 250), (251, 750), (1001, 2000), (3001, 5000)):
        of = np.array([share(zones, first, last) for zones, _, _ in runs])
        print(f"  steps {first} to {last}: {of.mean(0).round(3)}, sd of runs {of.std(0).round(3)}")
    spans = np.array(
        [[share(z, 1 + i, i + SPAN)[0] for i in range(SPAN, STEPS, SPAN)] for z, _, _ in runs]
    )
    print(f"  most of the random zone in a span after the first: {spans.mean(0).max():.3f}")
    order = [
        (share(z, 251, 750).argmax(), share(z, 1001, 2000).argmax()) == (2, 1) for z, _, _ in runs
    ]
    print(f"  first the easy zone, then the harder one: {sum(order)} of {len(runs)}")
    first = [regions[0] for _, _, regions in runs]
    cuts = np.unique(np.round([one["split_value"] for one in first], 3), return_counts=True)
    by_frequency = sum(one["split_dimension"] == 3 for one in first)
    print(f"  first split by the frequency: {by_frequency} of {len(runs)}, at {cuts}")
    print(f"  regions in the zones: {np.sum([regions_in_zones(r) for _, _, r in runs], 0)}")
    errors = np.array([errors for _, errors, _ in runs])
    print(f"  error where the toy stays: {errors.mean(0).round(4)}, sd {errors.std(0)[-1]:.4f}")


def draw(found):
    """Shares of the zones over time: means of the runs, and their 10th to 90th percentiles."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.0, 2.4), layout="constrained")
        for axes, (name, runs) in zip(figure.subplots(1, len(found), sharey=True), found.items()):
            ends = np.arange(SPAN, STEPS + 1, SPAN)
            of = np.array([[share(z, end - SPAN + 1, end) for end in ends] for z, _, _ in runs])
            for zone, (label, colour) in enumerate(ZONES.items()):
                middle = ends - SPAN / 2
                low, high = np.percentile(of[:, :, zone], (10, 90), axis=0)
                axes.fill_between(middle, low, high, color=colour, alpha=0.2, linewidth=0)
                axes.plot(middle, of[:, :, zone].mean(0), color=colour, label=f"the toy {label}")
            axes.set(title=name, xlabel="step", xlim=(0, STEPS), ylim=(0, 1))
        figure.axes[0].set_ylabel("share of the motions")
        figure.axes[-1].legend()
        (Path(__file__).parent / "iac_attention.png").write_bytes(png(figure.axes[0]))


def main():
    """Runs it all."""
    found = {}
    for name, (smoothing, window) in WINDOWS.items():
        config = Iac.Config(smoothing=smoothing, window=window)
        found[name] = [lived(config, seed) for seed in SEEDS]
        tell(name, found[name])
    tell("random motions", [lived(Iac.Config(epsilon=1.0), seed) for seed in SEEDS])
    draw(found)


if __name__ == "__main__":
    main()
