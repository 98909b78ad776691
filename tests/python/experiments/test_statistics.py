"""Statistics of few runs: what books and scipy say, what infinite scores do, what is covered."""

import math

import numpy as np
import pytest
import scipy.stats
from conftest import refused
from devlearn.experiments.statistics import (
    Estimate,
    bootstrap,
    difference,
    estimate_improvement,
    estimate_mean,
    estimate_median,
    estimate_share,
    interquartile_mean,
    mean,
    median,
    median_over_tasks,
    optimality_gap,
    performance_profile,
    probability_of_improvement,
    ratio,
)

INF = math.inf
EVERYTHING = (-INF, INF)


def ends(estimate):
    return estimate.low, estimate.high


def column(*values):
    """Scores of one task."""
    return np.array(values, dtype=float)[:, None]


def drawn(seed, *shape, spread=0.6):
    """Skewed positive scores, as steps are."""
    return np.exp(spread * np.random.default_rng(seed).normal(size=shape))


def covered(intervals, truth):
    """Share of intervals that hold the true value."""
    return np.mean([low <= truth <= high for low, high in intervals])


# --- aggregates -----------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(1, 1), (2, 1), (3, 2), (5, 7), (30, 3)])
def test_the_interquartile_mean_is_scipys_trimmed_mean_of_runs_and_tasks(shape):
    scores = drawn(1, *shape)
    trimmed = scipy.stats.trim_mean(scores, 0.25, axis=None)
    assert interquartile_mean(scores) == pytest.approx(trimmed, rel=1e-14)


def test_aggregates_of_many_arrays_at_once_are_those_of_each():
    many, others = drawn(2, 6, 5, 3), drawn(3, 6, 4, 3)
    for of in (mean, median, median_over_tasks, interquartile_mean):
        assert np.array_equal(of(many), [of(scores) for scores in many])
    assert np.array_equal(
        probability_of_improvement(many, others),
        [probability_of_improvement(x, y) for x, y in zip(many, others)],
    )
    gaps = [optimality_gap(scores, 1.0) for scores in many]
    assert np.array_equal(optimality_gap(many, 1.0), gaps)


def test_the_median_over_tasks_is_that_of_their_means():
    scores = [[1.0, 10.0, 100.0], [3.0, 10.0, 500.0], [8.0, 13.0, 600.0]]
    assert median_over_tasks(scores) == 11.0
    assert median(scores) == 10.0


def test_what_is_better_than_the_target_makes_up_for_nothing():
    assert optimality_gap(column(0.2, 1.0, 1.5, 2.0), 1.0) == pytest.approx(1.5 / 4)


@pytest.mark.parametrize("never", range(13))
def test_the_interquartile_mean_is_infinite_if_more_than_a_quarter_is_and_the_median_if_half_is(
    never,
):
    scores = np.arange(1.0, 13.0)
    scores[12 - never :] = INF
    scores = scores.reshape(4, 3)
    assert (interquartile_mean(scores) == INF) == (never > 3)
    assert (median(scores) == INF) == (never >= 6)
    assert (mean(scores) == INF) == (never > 0)
    assert not np.isnan([interquartile_mean(scores), median(scores), mean(scores)]).any()


def test_the_median_over_tasks_is_infinite_if_half_of_the_tasks_hold_a_run_that_is():
    assert median_over_tasks([[1.0, 2.0, INF], [1.0, 2.0, 3.0]]) == 2.0
    assert median_over_tasks([[1.0, INF, INF], [1.0, 2.0, 3.0]]) == INF


# --- shares ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("count", "n", "low", "high"),
    [
        (81, 263, 0.2527, 0.3676),
        (15, 148, 0.0578, 0.1617),
        (0, 20, 0.0000, 0.1684),
        (1, 29, 0.0009, 0.1776),
    ],
)
def test_the_interval_of_a_share_is_as_newcombe_1998_prints_it(count, n, low, high):
    estimate = estimate_share(count, n)
    assert (round(estimate.low, 4), round(estimate.high, 4)) == (low, high)
    assert (estimate.value, estimate.n, estimate.level) == (count / n, n, 0.95)


@pytest.mark.parametrize("level", [0.8, 0.95, 0.99])
def test_the_interval_of_a_share_is_scipys_exact_one(level):
    for n in (1, 2, 7, 30):
        for count in range(n + 1):
            exact = scipy.stats.binomtest(count, n).proportion_ci(level, method="exact")
            assert ends(estimate_share(count, n, level=level)) == pytest.approx(
                (exact.low, exact.high), rel=1e-9, abs=1e-12
            )


@pytest.mark.parametrize("n", [5, 10, 30])
def test_the_interval_of_a_share_covers_every_share_at_the_level_or_above(n):
    intervals = np.array([ends(estimate_share(count, n)) for count in range(n + 1)])
    shares = np.linspace(0, 1, 401)
    holds = (intervals[:, :1] <= shares) & (shares <= intervals[:, 1:])
    chances = scipy.stats.binom.pmf(np.arange(n + 1)[:, None], n, shares)
    coverage = (holds * chances).sum(0)
    assert coverage.min() >= 0.95
    assert coverage.min() < 0.98  # and no wider than need be


# --- median ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("n", "first", "last"),
    [(6, 1, 6), (9, 2, 8), (10, 2, 9), (15, 4, 12), (20, 6, 15), (25, 8, 18)],
)
def test_the_interval_of_a_median_is_between_the_ranks_that_tables_print(n, first, last):
    values = np.arange(1.0, n + 1)
    shuffled = np.random.default_rng(1).permutation(values)
    assert ends(estimate_median(shuffled[:, None])) == (first, last)


@pytest.mark.parametrize("n", [6, 7, 12, 30])
@pytest.mark.parametrize("level", [0.8, 0.95])
def test_the_interval_of_a_median_is_scipys_of_a_quantile(n, level):
    scores = drawn(n, n, 1)
    # Each of its sides at the level's half is one side of a test.
    below = scipy.stats.quantile_test(scores[:, 0], p=0.5, alternative="less")
    above = scipy.stats.quantile_test(scores[:, 0], p=0.5, alternative="greater")
    one_sided = (1 + level) / 2
    expected = (
        above.confidence_interval(one_sided).low,
        below.confidence_interval(one_sided).high,
    )
    assert ends(estimate_median(scores, level=level)) == expected


@pytest.mark.parametrize("n", range(1, 6))
def test_five_runs_or_fewer_have_no_interval_of_a_median_at_95_percent_and_say_so(n):
    estimate = estimate_median(drawn(1, n, 1))
    assert ends(estimate) == EVERYTHING
    assert estimate.vacuous
    assert estimate.value == median(drawn(1, n, 1))
    assert not estimate_median(drawn(1, 6, 1)).vacuous


@pytest.mark.parametrize("n", range(2, 6))
def test_the_whole_range_of_few_runs_is_an_interval_at_the_level_that_they_can_give(n):
    scores = drawn(1, n, 1)
    can_give = 1 - 0.5 ** (n - 1)
    assert ends(estimate_median(scores, level=can_give)) == (scores.min(), scores.max())
    assert estimate_median(scores, level=can_give + 0.001).vacuous


def test_the_interval_of_a_median_ends_at_runs_that_never_arrived():
    estimate = estimate_median(column(*range(1, 9), INF, INF))
    assert (estimate.value, *ends(estimate)) == (5.5, 2, INF)
    assert not estimate.vacuous
    all_failed = estimate_median(column(*[INF] * 10))
    assert (all_failed.value, *ends(all_failed)) == (INF, INF, INF)


# --- mean -----------------------------------------------------------------------------------------


def test_the_interval_of_a_mean_of_student_s_hours_of_sleep_is_as_printed():
    hours = column(1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4)
    estimate = estimate_mean(hours)
    assert estimate.value == pytest.approx(1.58)
    assert ends(estimate) == pytest.approx((0.7001142, 2.4598858), abs=1e-7)
    assert estimate.n == 10


def test_the_interval_of_a_mean_over_two_tasks_is_welch_s():
    scores = drawn(4, 8, 2) * [1.0, 20.0]
    welch = scipy.stats.ttest_ind(scores[:, 0], -scores[:, 1], equal_var=False)
    interval = welch.confidence_interval(0.9)
    expected = (interval.low / 2, interval.high / 2)
    assert ends(estimate_mean(scores, level=0.9)) == pytest.approx(expected, rel=1e-10)


def test_no_interval_of_a_mean_is_told_of_one_run_or_where_a_run_never_arrived():
    assert estimate_mean([[1.0, 2.0]]) == Estimate(1.5, *EVERYTHING, 1, 0.95)
    assert estimate_mean(column(1.0, 2.0, INF)) == Estimate(INF, *EVERYTHING, 3, 0.95)


# --- profiles -------------------------------------------------------------------------------------


def test_a_profile_is_the_share_of_runs_within_each_tau_averaged_over_tasks():
    scores = np.array([[1.0, 4.0], [2.0, INF], [2.0, 8.0]])
    taus = [0.5, 1.0, 2.0, 7.0, 8.0, INF]
    profile = performance_profile(scores, taus)
    expected = [np.mean([np.mean(task <= tau) for task in scores.T]) for tau in taus]
    assert [share.value for share in profile] == pytest.approx(expected)
    assert {(share.n, share.level) for share in profile} == {(3, 0.95)}
    assert ends(profile[3]) == ends(estimate_share(4, 6))


# --- probability of improvement -------------------------------------------------------------------


def test_the_probability_of_improvement_is_mann_and_whitney_s_u_over_the_pairs():
    random = np.random.default_rng(5)
    x, y = random.integers(0, 6, (9, 4)) * 1.0, random.integers(1, 7, (7, 4)) * 1.0  # with ties
    u = [scipy.stats.mannwhitneyu(y[:, k], x[:, k]).statistic for k in range(4)]
    assert probability_of_improvement(x, y) == pytest.approx(np.mean(u) / (9 * 7), rel=1e-12)
    assert probability_of_improvement(x, y) + probability_of_improvement(y, x) == pytest.approx(1)


def test_two_runs_that_never_arrived_are_equals():
    assert probability_of_improvement(column(INF, INF), column(INF, INF)) == 0.5
    assert probability_of_improvement(column(1.0, INF), column(INF, INF)) == 0.75


def hanley_and_mcneil(p, n, m):
    """Variance of the area under a curve, as of 1982."""
    q1, q2 = p / (2 - p), 2 * p**2 / (1 + p)
    return (p * (1 - p) + (n - 1) * (q1 - p**2) + (m - 1) * (q2 - p**2)) / (n * m)


@pytest.mark.parametrize("tasks", [1, 4])
@pytest.mark.parametrize("level", [0.8, 0.95])
def test_the_interval_of_an_improvement_ends_where_the_variance_there_says(tasks, level):
    x, y = drawn(6, 8, tasks), 1.5 * drawn(7, 8, tasks)
    estimate = estimate_improvement(x, y, level=level)
    z = scipy.stats.norm.ppf((1 + level) / 2)
    assert 0 < estimate.low < estimate.value < estimate.high < 1
    for end in ends(estimate):
        reach = z * math.sqrt(hanley_and_mcneil(end, 8, 8) / tasks)
        assert abs(end - estimate.value) == pytest.approx(reach, rel=1e-9)


def test_the_intervals_of_x_over_y_and_of_y_over_x_are_mirrored():
    x, y = drawn(8, 6, 3), 2 * drawn(9, 11, 3)
    one, other = estimate_improvement(x, y), estimate_improvement(y, x)
    assert ends(one) == pytest.approx((1 - other.high, 1 - other.low), rel=1e-9)
    assert one.n == other.n == 6


def test_few_runs_that_are_all_better_do_not_prove_that_all_ever_will_be():
    better, worse = drawn(1, 5, 1), 100 + drawn(2, 5, 1)
    estimate = estimate_improvement(better, worse)
    assert estimate.value == 1.0
    assert 0.5 < estimate.low < 0.8
    assert estimate.high == pytest.approx(1.0, abs=1e-12)
    assert ends(bootstrap(probability_of_improvement, better, worse)) == (1.0, 1.0)


def test_a_paired_improvement_is_the_share_of_seeds_that_are_better():
    x, y = (
        np.array([[1.0, 5.0], [2.0, INF], [4.0, 3.0]]),
        np.array([[2.0, 4.0], [3.0, INF], [4.0, 9.0]]),
    )
    estimate = estimate_improvement(x, y, paired=True)
    assert estimate.value == pytest.approx((3 + 2 / 2) / 6)
    assert ends(estimate) == pytest.approx(ends(estimate_share(4, 6)))
    assert estimate.n == 3


# --- bootstrap ------------------------------------------------------------------------------------


def test_equal_seeds_give_equal_intervals_and_others_do_not():
    scores = drawn(1, 10, 3)
    one = bootstrap(interquartile_mean, scores, seed=3)
    assert one == bootstrap(interquartile_mean, scores, seed=3)
    assert ends(one) != ends(bootstrap(interquartile_mean, scores, seed=4))
    assert one.value == interquartile_mean(scores)
    assert (one.n, one.level) == (10, 0.95)


def within_chance(interval_at, resamples, others, expected, level=0.95):
    """Whether an interval of another's resamples is as far from ours as chance has it.

    Ours at a level a little lower and a little higher hold between them where its ends may be: four
    standard errors of the share of resamples beyond an end.
    """
    tail = (1 - level) / 2
    error = 4 * math.sqrt(tail * (1 - tail) * (1 / resamples + 1 / others))
    inner, outer = (interval_at(1 - 2 * (tail + sign * error)) for sign in (1, -1))
    return outer.low <= expected[0] <= inner.low and inner.high <= expected[1] <= outer.high


def scipys(statistic, *samples, **options):
    """Its percentile interval of one task."""
    found = scipy.stats.bootstrap(
        samples, statistic, method="percentile", n_resamples=9999,
        random_state=np.random.default_rng(1), **options,
    )  # fmt: skip
    return found.confidence_interval


def test_the_percentile_interval_of_one_task_is_scipys():
    scores = drawn(3, 30, 1)
    expected = scipys(np.mean, scores[:, 0])
    assert within_chance(
        lambda level: bootstrap(mean, scores, level=level, expanded=False), 9999, 9999, expected
    )


@pytest.mark.parametrize("paired", [False, True])
def test_the_percentile_interval_of_a_difference_is_scipys_paired_or_not(paired):
    x = drawn(3, 30, 1)
    y = x + 0.2 * drawn(4, 30, 1)
    expected = scipys(
        lambda x, y, axis: np.mean(x, axis) - np.mean(y, axis), x[:, 0], y[:, 0],
        paired=paired, vectorized=True,
    )  # fmt: skip
    assert within_chance(
        lambda level: bootstrap(
            difference(mean), x, y, paired=paired, level=level, expanded=False
        ),
        9999, 9999, expected,
    )  # fmt: skip


def test_the_runs_of_one_task_are_never_drawn_for_another():
    scores = np.tile([1.0, 10.0, 100.0], (8, 1))
    assert ends(bootstrap(mean, scores)) == (37.0, 37.0)


def test_the_tasks_are_drawn_independently():
    # Drawn alike, the sum of the two would be the same in every resample.
    one = drawn(1, 10, 1)
    scores = np.hstack([one, 5 - one])
    estimate = bootstrap(mean, scores)
    assert estimate.low < estimate.value - 0.01
    assert estimate.value + 0.01 < estimate.high


def test_the_same_seeds_are_drawn_for_both_of_a_pair():
    x = drawn(2, 10, 3)
    apart = bootstrap(difference(mean), x, x + 3)
    assert apart.low < -3.01 < -2.99 < apart.high
    paired = bootstrap(difference(mean), x, x + 3, paired=True)
    assert (paired.value, *ends(paired)) == pytest.approx((-3, -3, -3))
    half = bootstrap(ratio(interquartile_mean), x, 2 * x, paired=True)
    assert (half.value, *ends(half)) == pytest.approx((0.5, 0.5, 0.5))


def test_the_expanded_interval_is_the_percentile_one_at_the_level_that_student_s_t_asks_for():
    scores = drawn(5, 6, 2)
    t = scipy.stats.t.ppf(0.975, 2 * 5)
    tail = scipy.stats.norm.cdf(-math.sqrt(6 / 5) * t)
    wider = bootstrap(mean, scores, level=1 - 2 * tail, expanded=False)
    assert ends(bootstrap(mean, scores)) == ends(wider)


def test_resamples_of_two_runs_have_the_chances_that_counting_gives():
    # 0, 1/2 and 1 in a quarter, half and a quarter of them.
    scores = column(0.0, 1.0)
    for level, expected in ((0.4, (0.5, 0.5)), (0.6, (0.0, 1.0))):
        assert ends(bootstrap(mean, scores, level=level, expanded=False)) == expected


def test_the_interval_of_few_runs_is_vacuous_where_no_resample_lies_beyond_its_ends():
    assert bootstrap(mean, [[1.0, 2.0]]).vacuous
    assert bootstrap(mean, [[1.0, 2.0]], expanded=False).vacuous
    assert bootstrap(mean, drawn(1, 3, 1)).vacuous
    assert not bootstrap(mean, drawn(1, 5, 1)).vacuous
    assert bootstrap(mean, drawn(1, 30, 1), resamples=30).vacuous


def test_intervals_of_runs_that_never_arrived_are_infinite_and_never_nan():
    scores = column(*range(1, 9), INF, INF)
    estimate = bootstrap(interquartile_mean, scores)
    assert estimate.value == 5.5
    assert 1 < estimate.low < 5.5
    assert estimate.high == INF
    never = bootstrap(interquartile_mean, column(*[INF] * 10))
    assert (never.value, *ends(never)) == (INF, INF, INF)


def test_a_difference_of_what_is_infinite_in_both_has_no_value_and_may_be_anything():
    never = column(*[INF] * 6)
    for of in (difference(median), ratio(median)):
        estimate = bootstrap(of, never, never)
        assert math.isnan(estimate.value)
        assert estimate.vacuous
    # It has none in some of the resamples of these, in more than lie beyond an end.
    often = column(1, 2, 3, 4, 5, INF, INF)
    estimate = bootstrap(difference(median), often, often + 10)
    assert estimate.value == -10
    assert estimate.vacuous
    # Of one that always arrives it is open to one side only.
    one_sided = bootstrap(difference(median), column(*range(1, 8)), often)
    assert -INF == one_sided.low < one_sided.high < INF


# --- coverage, of samples that are drawn by chance ------------------------------------------------


def coverage(estimate, truth, runs, tasks=1, repetitions=600):
    """Of intervals of skewed scores."""
    samples = drawn(runs, repetitions, runs, tasks)
    return covered([ends(estimate(scores)) for scores in samples], truth)


@pytest.mark.parametrize("n", [5, 10, 30])
def test_t_intervals_of_normal_scores_cover_their_mean_as_often_as_the_level_says(n):
    samples = np.random.default_rng(n).normal(3.0, 2.0, (1000, n, 1))
    assert 0.93 <= covered([ends(estimate_mean(scores)) for scores in samples], 3.0) <= 0.97


@pytest.mark.parametrize(("n", "exact"), [(6, 1 - 2 / 2**6), (10, 0.9785), (30, 0.9572)])
def test_intervals_of_a_median_cover_it_as_often_as_tables_say(n, exact):
    # The median of exp(0.6 z) is 1.
    repetitions = 1500
    error = 3 * math.sqrt(exact * (1 - exact) / repetitions)
    assert abs(coverage(estimate_median, 1.0, n, repetitions=repetitions) - exact) < error


def test_intervals_of_a_median_and_a_profile_of_unlike_tasks_cover_them_at_the_level_or_above():
    # Half of all scores are below 1: none of the first task, all of the last.
    factors = np.array([5.0, 1.0, 0.2])
    samples = drawn(4, 600, 4, 3, spread=0.1) * factors
    assert covered([ends(estimate_median(scores)) for scores in samples], 1.0) >= 0.95
    bands = [ends(performance_profile(scores, [1.0])[0]) for scores in samples]
    assert covered(bands, 0.5) >= 0.95


@pytest.mark.parametrize("n", [5, 10, 30])
@pytest.mark.parametrize("shift", [0.5, 1.0])
def test_intervals_of_an_improvement_cover_it_as_often_as_the_level_says(n, shift):
    # Of two normal scores, P(X < Y) is Phi(shift / sqrt(2)).
    random = np.random.default_rng(n)
    truth = scipy.stats.norm.cdf(shift / math.sqrt(2))
    intervals = [
        ends(estimate_improvement(random.normal(0, 1, (n, 1)), random.normal(shift, 1, (n, 1))))
        for _ in range(800)
    ]
    assert 0.93 <= covered(intervals, truth) <= 0.98


def test_expanded_bootstrap_intervals_of_few_runs_cover_more_than_percentile_ones():
    truth = math.exp(0.6**2 / 2)
    samples = drawn(9, 400, 5, 1)
    expanded, percentile = (
        covered(
            [
                ends(bootstrap(mean, scores, expanded=expanded, resamples=1999, seed=i))
                for i, scores in enumerate(samples)
            ],
            truth,
        )
        for expanded in (True, False)
    )
    # Both cover too little, as the docstring says.
    assert percentile < 0.84
    assert 0.86 < expanded < 0.93


# --- what is refused ------------------------------------------------------------------------------

GOOD = [[1.0, 2.0], [3.0, 4.0]]
NAN = [[1.0, math.nan], [3.0, 4.0]]
BAD_SCORES = {
    "NaN": NAN,
    "-inf": [[1.0, -INF]],
    "one axis": [1.0, 2.0],
    "no runs": np.empty((0, 3)),
    "no tasks": np.empty((3, 0)),
    "ragged": [[1.0], [1.0, 2.0]],
    "words": [["a", "b"]],
}
OF_SCORES = {
    "mean": mean,
    "median": median,
    "median_over_tasks": median_over_tasks,
    "interquartile_mean": interquartile_mean,
    "optimality_gap": lambda scores: optimality_gap(scores, 1.0),
    "x": lambda scores: probability_of_improvement(scores, GOOD),
    "y": lambda scores: probability_of_improvement(GOOD, scores),
    "estimate_mean": estimate_mean,
    "estimate_median": estimate_median,
    "performance_profile": lambda scores: performance_profile(scores, [1.0]),
    "estimate_improvement": lambda scores: estimate_improvement(GOOD, scores),
    "bootstrap": lambda scores: bootstrap(mean, scores),
}


@pytest.mark.parametrize("scores", BAD_SCORES)
@pytest.mark.parametrize("of", OF_SCORES)
def test_scores_that_are_none_are_refused(of, scores):
    refused(lambda: OF_SCORES[of](BAD_SCORES[scores]))


@pytest.mark.parametrize("level", [0, 1, -0.5, 95, math.nan, "0.95", None])
def test_a_level_is_above_0_and_below_1(level):
    for of in (
        lambda: estimate_share(1, 2, level=level),
        lambda: estimate_median(GOOD, level=level),
        lambda: estimate_mean(GOOD, level=level),
        lambda: performance_profile(GOOD, [1.0], level=level),
        lambda: estimate_improvement(GOOD, GOOD, level=level),
        lambda: bootstrap(mean, GOOD, level=level),
    ):
        refused(of, "level", str(level))


THREE = [[1.0, 2.0, 3.0]]
LONGER = [[1.0, 2.0]] * 3


@pytest.mark.parametrize(
    ("call", "quantity", "value"),
    [
        (lambda: probability_of_improvement(GOOD, THREE), "tasks", "2 and 3"),
        (lambda: estimate_improvement(GOOD, THREE), "tasks", "2 and 3"),
        (lambda: estimate_improvement(GOOD, LONGER, paired=True), "runs", "2 and 3"),
        (lambda: bootstrap(difference(mean), GOOD, THREE), "tasks", "2 and 3"),
        (lambda: bootstrap(difference(mean), GOOD, LONGER, paired=True), "runs", "2 and 3"),
        (lambda: bootstrap(mean, [GOOD]), "shape of scores[0]", "(1, 2, 2)"),
        (lambda: bootstrap(mean), "scores", "none"),
        (lambda: bootstrap(np.mean, GOOD), "shape of the statistic", "()"),
        (lambda: ratio(mean)(GOOD, [[-2.0]]), "statistic of a ratio", "-2.0"),
        (lambda: bootstrap(mean, GOOD, resamples=0), "resamples", "0"),
        (lambda: bootstrap(mean, GOOD, resamples=10.5), "resamples", "10.5"),
        (lambda: bootstrap(mean, GOOD, seed=-1), "seed", "-1"),
        (lambda: bootstrap(mean, GOOD, seed=None), "seed", "None"),
        (lambda: estimate_share(3, 2), "count", "3"),
        (lambda: estimate_share(-1, 2), "count", "-1"),
        (lambda: estimate_share(math.nan, 2), "count", "nan"),
        (lambda: estimate_share(0, 0), "n", "0"),
        (lambda: estimate_share(1, 2.5), "n", "2.5"),
        (lambda: optimality_gap(GOOD, INF), "target", "inf"),
        (lambda: performance_profile(GOOD, []), "tau", "(0,)"),
        (lambda: performance_profile(GOOD, 1.0), "tau", "()"),
        (lambda: performance_profile(GOOD, [math.nan]), "tau", "NaN"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name(call, quantity, value):
    refused(call, quantity, value)
