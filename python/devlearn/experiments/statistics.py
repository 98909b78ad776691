"""Statistics of few runs: aggregates of scores over runs and tasks, each with its interval.

Scores are arrays of shape (runs, tasks): a row a seed, a column a world. Lower is better, as it is
of steps; where higher is better, give ``-scores``. A run that never arrived is ``inf`` and stays
one: no run is left out. NaN and ``-inf`` are refused, as is all bad input, by InvalidValue.

What is reported, and why, follows Agarwal, Schwarzer, Castro, Courville and Bellemare, "Deep
reinforcement learning at the edge of the statistical precipice", NeurIPS 2021, whose library is
rliable; where intervals differ from theirs, as they must for few runs, docs/statistics.md says how.

The tasks are taken as they are: an interval is about other runs in the same worlds, not about
other worlds.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..errors import InvalidValue, MissingExtra

try:
    from scipy import stats
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.experiments.statistics", "scipy", "experiments") from error

__all__ = [
    "Estimate",
    "bootstrap",
    "difference",
    "estimate_improvement",
    "estimate_mean",
    "estimate_median",
    "estimate_share",
    "interquartile_mean",
    "mean",
    "median",
    "median_over_tasks",
    "optimality_gap",
    "performance_profile",
    "probability_of_improvement",
    "ratio",
]

Array = npt.NDArray[np.float64]
Statistic = Callable[..., npt.ArrayLike]

_BLOCK = 2**17  # scores of the resamples that are held at once; of pairs of runs there are more


@dataclass(frozen=True)
class Estimate:
    """A value and the interval that holds the true one at the given level.

    Where there are too few runs to tell an interval at this level, it is all numbers, ``-inf`` to
    ``inf``, and ``vacuous``.
    """

    value: float
    """inf where too many runs never arrived; NaN where it would be inf - inf, or inf / inf."""
    low: float
    """Lower end of the interval, -inf where it is open."""
    high: float
    """Upper end of the interval, inf where it is open or ends at runs that never arrived."""
    n: int
    """Of how many runs a task, of two agents the fewer; of a share, of how many trials."""
    level: float
    """Share of all such intervals that hold the true value, such as 0.95."""

    @property
    def vacuous(self) -> bool:
        """Whether the interval says nothing."""
        return self.low == -math.inf and self.high == math.inf


# --- aggregates -----------------------------------------------------------------------------------
# Of one array of scores, or of many at once: they take (..., runs, tasks) and give (...).


def mean(scores: npt.ArrayLike) -> Array:
    """Mean over runs and tasks, of scores (..., runs, tasks); inf if any score is."""
    return np.asarray(_stack(scores).mean((-2, -1)))


def median(scores: npt.ArrayLike) -> Array:
    """Median over runs and tasks, of scores (..., runs, tasks); inf if half of them are, or more.

    This is not rliable's "median", which is ``median_over_tasks``.
    """
    return np.asarray(np.median(_pooled(scores), -1))


def median_over_tasks(scores: npt.ArrayLike) -> Array:
    """Median over the tasks of their means over runs, of scores (..., runs, tasks).

    The "median" of Agarwal et al. and of rliable. A single run that is inf makes its task's mean
    inf; of a single task it is the mean.
    """
    return np.asarray(np.median(_stack(scores).mean(-2), -1))


def interquartile_mean(scores: npt.ArrayLike) -> Array:
    """Mean of the middle half of all scores (..., runs, tasks), as a trimmed mean.

    Of N = runs x tasks scores the floor(N / 4) lowest and as many highest are left out. It is inf
    if more than floor(N / 4) of them are: more than a quarter.
    """
    pooled = _pooled(scores)
    count = pooled.shape[-1]
    cut = count // 4
    parted = np.partition(pooled, (cut, count - cut - 1), -1)
    return np.asarray(parted[..., cut : count - cut].mean(-1))


def optimality_gap(scores: npt.ArrayLike, target: float) -> Array:
    """By how much scores (..., runs, tasks) miss a target: mean of max(score - target, 0).

    What is better than the target makes up for nothing. rliable's, with lower taken for better.
    """
    _require(_real(target) and math.isfinite(target), "target", target, "a finite number")
    return np.asarray(np.maximum(_stack(scores) - target, 0.0).mean((-2, -1)))


def difference(statistic: Statistic) -> Statistic:
    """The statistic of x minus that of y: a function (x, y) for ``bootstrap``.

    NaN where both are inf.
    """
    return lambda x, y: np.subtract(statistic(x), statistic(y))


def ratio(statistic: Statistic) -> Statistic:
    """The statistic of x over that of y, neither below 0: a function (x, y) for ``bootstrap``.

    NaN where both are inf, or 0.
    """

    def of(x: Array, y: Array) -> Array:
        over, under = np.asarray(statistic(x)), np.asarray(statistic(y))
        lowest = min(over.min(), under.min())
        _require(not lowest < 0, "statistic of a ratio", lowest, ">= 0")
        return np.asarray(np.divide(over, under))

    return of


def probability_of_improvement(x: npt.ArrayLike, y: npt.ArrayLike) -> Array:
    """P(X < Y) + P(X = Y) / 2, of a run of x and one of y in the same task, averaged over tasks.

    x: (..., runs of x, tasks), y: (..., runs of y, tasks). It is Mann and Whitney's U of each task
    over the number of pairs. Two runs that never arrived are equals.
    """
    x, y = _same_tasks(_stack(x, "x"), _stack(y, "y"))
    return np.asarray(_wins(x[..., :, None, :], y[..., None, :, :]).mean((-3, -2, -1)))


def _wins(x: Array, y: Array) -> Array:
    return np.asarray((x < y) + 0.5 * (x == y))


# --- intervals ------------------------------------------------------------------------------------


def estimate_share(count: float, n: int, *, level: float = 0.95) -> Estimate:
    """A share count / n of n trials, with the interval of Clopper and Pearson (1934).

    It covers the true share at the level or above for every share and every n. (Wilson's is
    shorter, and covers less than the level for some shares, those near 0 and 1 above all, which are
    the usual ones here.) A trial may count in part, as a tie does by half: what lies between 0 and
    1 varies less than what is 0 or 1 with the same mean, so the interval holds.
    """
    _level(level)
    _require(_whole(n) and n >= 1, "n", n, "a whole number >= 1")
    _require(_real(count) and 0 <= count <= n, "count", count, f"0 to n, {n}")
    tail = (1 - level) / 2
    low = stats.beta.ppf(tail, count, n - count + 1) if count > 0 else 0.0
    high = stats.beta.isf(tail, count + 1, n - count) if count < n else 1.0
    return Estimate(float(count / n), float(low), float(high), int(n), level)


def estimate_median(scores: npt.ArrayLike, *, level: float = 0.95) -> Estimate:
    """Median over runs and tasks, with the exact interval between order statistics.

    Of N = runs x tasks scores in order, from the l-th to the (N + 1 - l)-th, where l is the largest
    with P(B < l) <= (1 - level) / 2 and B binomial (N, 1/2). For every distribution, inf included,
    it covers the true median at the level or above; of several tasks, the median of their mixture
    (Hoeffding 1956: a sum of unequal trials varies less than one of equal ones). At 95 % this takes
    six scores; for fewer it is vacuous.
    """
    scores = _scores(scores)
    _level(level)
    ordered = np.sort(scores, None)
    below = stats.binom.cdf(np.arange(ordered.size), ordered.size, 0.5)
    rank = int(np.searchsorted(below, (1 - level) / 2, side="right"))
    return Estimate(float(median(scores)), *_between(ordered, rank), len(scores), level)


def estimate_mean(scores: npt.ArrayLike, *, level: float = 0.95) -> Estimate:
    """Mean over runs and tasks, with Student's t interval.

    Of several tasks the standard error is that of a mean over strata, sqrt(sum s_k^2 / n) / tasks,
    with the degrees of freedom of Welch and Satterthwaite. Exact for one task of normal scores;
    vacuous for one run, and where a score is inf.
    """
    scores = _scores(scores)
    _level(level)
    n, tasks = scores.shape
    value = float(mean(scores))
    if n == 1 or value == math.inf:
        return Estimate(value, -math.inf, math.inf, n, level)
    variances = scores.var(0, ddof=1)
    total = variances.sum()
    shares = variances / total if total > 0 else np.full(tasks, 1 / tasks)
    freedom = (n - 1) / np.sum(shares**2)
    half = stats.t.isf((1 - level) / 2, freedom) * math.sqrt(total / n) / tasks
    return Estimate(value, value - half, value + half, n, level)


def performance_profile(
    scores: npt.ArrayLike, tau: npt.ArrayLike, *, level: float = 0.95
) -> tuple[Estimate, ...]:
    """Share of the scores that are <= tau, over runs and tasks, for each of some values of tau.

    The bands are the intervals of ``estimate_share``, one a tau: of several tasks, too, they cover
    the share at the level or above (Hoeffding 1956), and where all or none of few runs are <= tau
    they are as wide as they must be, where a bootstrap's width is 0.
    """
    scores = _scores(scores)
    taus = _numbers(tau, "tau")
    _require(taus.ndim == 1 and taus.size > 0, "tau", taus.shape, "a sequence of numbers")
    _require(not np.isnan(taus).any(), "tau", "NaN", "numbers")
    counts = np.searchsorted(np.sort(scores, None), taus, side="right")
    return tuple(_pooled_share(count, scores, level) for count in counts)


def _pooled_share(count: float, scores: Array, level: float) -> Estimate:
    share = estimate_share(count, scores.size, level=level)
    return Estimate(share.value, share.low, share.high, len(scores), level)


def estimate_improvement(
    x: npt.ArrayLike, y: npt.ArrayLike, *, paired: bool = False, level: float = 0.95
) -> Estimate:
    """``probability_of_improvement`` of x over y, with an interval that few runs do not empty.

    x: (runs of x, tasks), y: (runs of y, tasks). The interval is Newcombe's (2006, method 5):
    the probabilities p with ``|P - p| <= z sqrt(V(p))``, where V is the variance of P that Hanley
    and McNeil (1982) give, over the number of tasks. Where every run of x is better than every run
    of y it reaches from below 1 to 1; a bootstrap's width would be 0.

    paired: run i of x and run i of y have the same seed. Then it is the share of the pairs in which
    x is better, ties by half, with the interval of ``estimate_share``.
    """
    x, y = _samples((x, y), ("x", "y"), paired)
    _level(level)
    n, m, tasks = len(x), len(y), x.shape[1]
    if paired:
        return _pooled_share(float(_wins(x, y).sum()), x, level)
    value = float(probability_of_improvement(x, y))
    # (P - p)^2 = z^2 V(p), with V's denominators, (2 - p)(1 + p), multiplied out: of its four roots
    # one is below 0 and one above 1.
    p = np.polynomial.Polynomial([0, 1])
    denominators = (2 - p) * (1 + p)
    spread = denominators + ((n + m) / 2 - 1) * ((1 - p) * (1 + p) + p * (2 - p))
    z = stats.norm.isf((1 - level) / 2)
    excess = (value - p) ** 2 * denominators - z**2 / (n * m * tasks) * p * (1 - p) * spread
    low, high = np.clip(np.sort(excess.roots().real)[1:3], 0.0, 1.0)
    return Estimate(value, float(low), float(high), min(n, m), level)


# --- bootstrap ------------------------------------------------------------------------------------


def bootstrap(
    statistic: Statistic,
    *scores: npt.ArrayLike,
    paired: bool = False,
    level: float = 0.95,
    expanded: bool = True,
    resamples: int = 9999,
    seed: int = 0,
) -> Estimate:
    """Any statistic of the scores of one agent or several, with its stratified bootstrap interval.

    statistic: a function of as many arrays (..., runs, tasks) as there are scores that gives one of
    (...), such as ``interquartile_mean``. scores: (runs, tasks) each, with the same tasks. The runs
    of each task are drawn anew, independently of the other tasks' and other agents'. paired: run i
    has the same seed in all of them, and the same runs are drawn for all. Equal seeds give equal
    intervals.

    The interval is between two order statistics of the resamples. expanded: Hesterberg's (2015),
    between the quantiles Phi(-+ sqrt(n / (n - 1)) t) where t is Student's of the level with
    tasks (n - 1) degrees of freedom, n being the least number of runs. Otherwise the percentile
    interval, which is rliable's. It is too short for few runs: at 95 % it covered the true mean of
    skewed scores in 81 % of samples of five runs of one task, the expanded one in 91 %. BCa covers
    hardly more (it corrects skewness, not width), and it and a studentised one have no value where
    scores are inf.

    Where too few resamples lie beyond such a quantile, the interval is vacuous: so it is of three
    runs of one task, or fewer. A statistic that has no value in a resample (inf - inf) may have any
    there, which can open either end. Where all resamples are equal the width is 0, which says
    little: prefer what is exact.
    """
    samples = _samples(scores, tuple(f"scores[{i}]" for i in range(len(scores))), paired)
    _level(level)
    _require(_whole(resamples) and resamples >= 1, "resamples", resamples, "a whole number >= 1")
    _require(_whole(seed) and seed >= 0, "seed", seed, "a whole number >= 0")
    n = min(len(sample) for sample in samples)
    values = _resampled(statistic, samples, paired, resamples, np.random.default_rng(seed))
    undefined = np.isnan(values)
    rank = 0  # of one run nothing is known
    if n > 1:
        tail = (1 - level) / 2
        if expanded:
            t = stats.t.isf(tail, samples[0].shape[1] * (n - 1))
            tail = float(stats.norm.sf(math.sqrt(n / (n - 1)) * t))
        # 1 - 0.9 is a little below 0.1.
        rank = math.floor(tail * (resamples + 1) + 1e-9)
    low, _ = _between(np.sort(np.where(undefined, -math.inf, values)), rank)
    _, high = _between(np.sort(np.where(undefined, math.inf, values)), rank)
    return Estimate(float(_applied(statistic, samples)), low, high, n, level)


def _resampled(
    statistic: Statistic,
    samples: list[Array],
    paired: bool,
    resamples: int,
    random: np.random.Generator,
) -> Array:
    """The statistic of each resample."""
    size = max(1, _BLOCK // sum(sample.size for sample in samples))
    blocks = []
    for start in range(0, resamples, size):
        count = min(size, resamples - start)
        drawn = [
            random.integers(len(sample), size=(count, *sample.shape))
            for sample in samples[: 1 if paired else None]
        ]
        arrays = [
            np.take_along_axis(sample[None], drawn[0 if paired else i], 1)
            for i, sample in enumerate(samples)
        ]
        blocks.append(_applied(statistic, arrays))
    return np.concatenate(blocks)


def _applied(statistic: Statistic, arrays: list[Array]) -> Array:
    # Where two infinite values meet, NaN is the answer, and no accident.
    with np.errstate(invalid="ignore", divide="ignore"):
        values = np.asarray(statistic(*arrays), dtype=np.float64)
    expected = arrays[0].shape[:-2]
    wanted = f"{expected}: a function of arrays (..., runs, tasks) gives one of (...)"
    _require(values.shape == expected, "shape of the statistic", values.shape, wanted)
    return values


def _between(ordered: Array, rank: int) -> tuple[float, float]:
    """The values of a rank, from 1, from below and from above; rank 0 is beyond all of them."""
    if rank == 0:
        return -math.inf, math.inf
    return float(ordered[rank - 1]), float(ordered[-rank])


# --- what is refused ------------------------------------------------------------------------------


def _require(holds: object, quantity: str, value: object, allowed: str) -> None:
    if not holds:
        raise InvalidValue(quantity, value, allowed)


def _whole(value: object) -> bool:
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def _real(value: object) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def _level(level: float) -> None:
    _require(_real(level) and 0 < level < 1, "level", level, "above 0 and below 1")


def _numbers(values: npt.ArrayLike, name: str) -> Array:
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InvalidValue(name, values, "an array of numbers") from None


def _stack(scores: npt.ArrayLike, name: str = "scores") -> Array:
    array = _numbers(scores, name)
    _require(array.ndim >= 2 and array.size > 0, f"shape of {name}", array.shape,
             "(..., runs, tasks), none of them 0")  # fmt: skip
    _require(not np.isnan(array).any(), name, "NaN", "finite numbers, or inf")
    _require(array.min() > -math.inf, name, "-inf", "finite numbers, or inf")
    return array


def _pooled(scores: npt.ArrayLike) -> Array:
    array = _stack(scores)
    return array.reshape(*array.shape[:-2], -1)


def _scores(scores: npt.ArrayLike, name: str = "scores") -> Array:
    array = _stack(scores, name)
    _require(array.ndim == 2, f"shape of {name}", array.shape, "(runs, tasks)")
    return array


def _same_tasks(x: Array, y: Array) -> tuple[Array, Array]:
    _require(x.shape[-1] == y.shape[-1], "tasks", f"{x.shape[-1]} and {y.shape[-1]}",
             "the same tasks of both")  # fmt: skip
    return x, y


def _samples(
    scores: tuple[npt.ArrayLike, ...], names: tuple[str, ...], paired: bool
) -> list[Array]:
    _require(scores, "scores", "none", "the scores of an agent or more")
    samples = [_scores(array, name) for array, name in zip(scores, names)]
    for other in samples[1:]:
        _same_tasks(samples[0], other)
        _require(not paired or len(other) == len(samples[0]), "runs",
                 f"{len(samples[0])} and {len(other)}", "pairs: as many runs of each")  # fmt: skip
    return samples
