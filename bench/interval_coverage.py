"""How often intervals of few runs hold the true value: the table of docs/statistics.md.

Scores are exp(0.6 z), z standard normal: skewed, as steps are. Takes some ten minutes of one core.
"""

from __future__ import annotations

import argparse
import math

import numpy as np
import scipy.stats
from devlearn.experiments import statistics

RUNS = (5, 10, 30)
SPREAD = 0.6
TASKS = 7
RESAMPLES = 1999
MEAN = math.exp(SPREAD**2 / 2)
# The middle half of exp(0.6 z): E[exp(0.6 z); |z| < q] / (1/2).
QUARTILE = scipy.stats.norm.ppf(0.75)
IQM = (
    2 * MEAN * (scipy.stats.norm.cdf(QUARTILE - SPREAD) - scipy.stats.norm.cdf(-QUARTILE - SPREAD))
)


def bootstrapped(statistic, **options):
    """Its interval, of one sample."""
    return lambda *scores: statistics.bootstrap(statistic, *scores, resamples=RESAMPLES, **options)


def bca(scores):
    """SciPy's, of the mean of one task."""
    found = scipy.stats.bootstrap(
        (scores[:, 0],), np.mean, method="BCa", n_resamples=RESAMPLES, random_state=1
    ).confidence_interval
    return statistics.Estimate(float(scores.mean()), found.low, found.high, len(scores), 0.95)


def skewed(random, runs, tasks=1):
    """Scores of one agent."""
    return (np.exp(SPREAD * random.normal(size=(runs, tasks))),)


def normal(random, runs):
    """Of one task, their mean being MEAN, too."""
    return (random.normal(MEAN, 1.0, (runs, 1)),)


def two(p):
    """Of two agents, the first being better with probability p."""
    factor = math.exp(SPREAD * math.sqrt(2) * scipy.stats.norm.ppf(p))
    return lambda random, runs: (*skewed(random, runs), factor * skewed(random, runs)[0])


def pairs(random, runs):
    """Of two agents in several worlds, half of whose variance is the seed's."""
    seeds, one, other = (skewed(random, runs, TASKS)[0] for _ in range(3))
    return seeds + one, seeds + other


def many(random, runs):
    """Scores of one agent in several worlds."""
    return skewed(random, runs, TASKS)


def both(statistic, **options):
    """The two bootstrap intervals of a statistic, by name."""
    return {
        "expanded": bootstrapped(statistic, **options),
        "percentile": bootstrapped(statistic, expanded=False, **options),
    }


IQM_INTERVALS = both(statistics.interquartile_mean)
PAIRED = both(statistics.difference(statistics.interquartile_mean), paired=True)
IMPROVEMENT = {
    "Newcombe": statistics.estimate_improvement,
    **both(statistics.probability_of_improvement),
}
# What is estimated, how scores are drawn, intervals by name, the true value.
CASES = [
    ("median", skewed, {"order statistics": statistics.estimate_median}, 1.0),
    ("mean, normal scores", normal, {"t": statistics.estimate_mean}, MEAN),
    ("mean", skewed, {"t": statistics.estimate_mean, **both(statistics.mean), "BCa": bca}, MEAN),
    ("IQM", skewed, IQM_INTERVALS, IQM),
    (f"IQM, {TASKS} tasks", many, IQM_INTERVALS, IQM),
    (f"difference of IQMs, {TASKS} tasks, paired", pairs, PAIRED, 0.0),
    ("improvement, P = 0.7", two(0.7), IMPROVEMENT, 0.7),
    ("improvement, P = 0.95", two(0.95), IMPROVEMENT, 0.95),
]


def coverage(scores, interval, truth, runs, repetitions):
    """Share of the intervals that hold the true value; None where they are vacuous."""
    random = np.random.default_rng(runs)
    estimates = [interval(*scores(random, runs)) for _ in range(repetitions)]
    if any(estimate.vacuous for estimate in estimates):
        return None
    return np.mean([estimate.low <= truth <= estimate.high for estimate in estimates])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repetitions", type=int, default=2000)
    repetitions = parser.parse_args().repetitions
    print("| of | interval | " + " | ".join(f"n = {runs}" for runs in RUNS) + " |")
    print("|---" * (2 + len(RUNS)) + "|")
    for what, scores, intervals, truth in CASES:
        for name, interval in intervals.items():
            found = (coverage(scores, interval, truth, runs, repetitions) for runs in RUNS)
            cells = ("none" if share is None else f"{100 * share:.1f} %" for share in found)
            print(f"| {what} | {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
