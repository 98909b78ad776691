"""Statistics against rliable, the library of Agarwal et al. (2021), of the long tier.

pytest collects it where it is named. rliable takes higher for better: it is given ``-scores``.
"""

import math

import numpy as np
import pytest
from devlearn.experiments.statistics import (
    bootstrap,
    interquartile_mean,
    mean,
    median_over_tasks,
    optimality_gap,
    performance_profile,
    probability_of_improvement,
)
from rliable import library, metrics

SHAPES = [(5, 1), (10, 7), (30, 3)]
TAUS = np.linspace(0, 4, 41)
EXACT = {"rel": 1e-12, "abs": 1e-12}
RESAMPLES = 2000  # of rliable's


def drawn(seed, runs, tasks):
    """Skewed scores of which some are equal."""
    return np.round(np.exp(0.6 * np.random.default_rng(seed).normal(size=(runs, tasks))), 2)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("seed", range(20))
def test_aggregates_are_rliables(shape, seed):
    scores = drawn(seed, *shape)
    for ours, theirs in (
        (mean, metrics.aggregate_mean),
        (median_over_tasks, metrics.aggregate_median),
        (interquartile_mean, metrics.aggregate_iqm),
    ):
        assert ours(scores) == pytest.approx(theirs(scores), **EXACT)
    gap = metrics.aggregate_optimality_gap(-scores, gamma=-1.1)
    assert optimality_gap(scores, 1.1) == pytest.approx(gap, **EXACT)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("seed", range(20))
def test_profiles_are_what_rliables_leave_above_tau(shape, seed):
    scores = drawn(seed, *shape)
    theirs, _ = library.create_performance_profile({"agent": scores}, TAUS, reps=2)
    ours = [share.value for share in performance_profile(scores, TAUS)]
    assert ours == pytest.approx(1 - theirs["agent"], **EXACT)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("seed", range(20))
def test_probabilities_of_improvement_are_rliables(shape, seed):
    x, y = drawn(seed, *shape), 1.2 * drawn(seed + 100, shape[0] + 2, shape[1])
    x[0], y[0] = 1.0, 1.0
    theirs = metrics.probability_of_improvement(-x, -y)
    assert probability_of_improvement(x, y) == pytest.approx(theirs, **EXACT)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        (mean, metrics.aggregate_mean),
        (median_over_tasks, metrics.aggregate_median),
        (interquartile_mean, metrics.aggregate_iqm),
        (lambda scores: np.mean(scores <= 1.3, (-2, -1)), lambda scores: np.mean(scores <= 1.3)),
        (probability_of_improvement, lambda x, y: metrics.probability_of_improvement(-x, -y)),
    ],
    ids=["mean", "median", "interquartile mean", "profile", "improvement"],
)
def test_percentile_intervals_are_rliables_but_for_chance(ours, theirs, shape):
    scores = [drawn(1, *shape)]
    if ours is probability_of_improvement:
        scores.append(1.2 * drawn(2, *shape))
    np.random.seed(1)  # which it draws from  # noqa: NPY002
    _, intervals = library.get_interval_estimates(
        {"agent": scores if len(scores) > 1 else scores[0]},
        lambda *arrays: np.array([theirs(*arrays)]),
        reps=RESAMPLES,
    )
    low, high = intervals["agent"][:, 0]
    # At a level a little lower and a little higher ours hold between them where its ends may be:
    # four standard errors of the share of resamples beyond an end.
    error = 4 * math.sqrt(0.025 * 0.975 * (1 / RESAMPLES + 1 / 9999))
    inner, outer = (
        bootstrap(ours, *scores, level=1 - 2 * (0.025 + sign * error), expanded=False)
        for sign in (1, -1)
    )
    assert outer.low <= low <= inner.low
    assert inner.high <= high <= outer.high
