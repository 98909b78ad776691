"""The claims: their file, and how runs are judged by it."""

import copy
import math

import numpy as np
import pytest
from devlearn import RandomAgent, Trial, TrialConfig
from devlearn.experiments.job import run_of
from devlearn.experiments.schedule import Schedule
from devlearn.paper import sweeps
from devlearn.paper.claims import Results, aggregate, claims, judge

FIELDS = {"id", "section", "claim", "measure", "unit", "aggregate", "criterion", "control"}
TOGETHER = {"habits_differ", "sigma_shortens_exploration", "small_sigma_finds_better"}


def by_id(results):
    return {verdict.claim["id"]: verdict for verdict in judge(results)}


def measures(**values):
    """What a run measures, all of it the best there is, or as said."""
    best = {
        claim["id"]: claim["criterion"]["bound"]
        for claim in claims()
        if claim["id"] not in TOGETHER
    }
    best |= {"late_increases_explore": [1, 1], "habit": None, "last_steps": 150.0}
    return best | values


def results(runs=None, random=None, **more):
    runs = [measures()] if runs is None else runs
    random = [measures()] if random is None else random
    sigmas = dict.fromkeys((0.1, 0.3, 0.7), runs)
    given = {
        "runs": runs, "random": random, "similar": runs, "similar_random": random,
        "by_sigma": sigmas, "reseeded": runs,
    }  # fmt: skip
    return Results(**(given | more))


# --- the file -------------------------------------------------------------------------------------


def test_every_claim_has_every_field_and_says_something_in_it():
    assert len(claims()) >= 20
    for claim in claims():
        assert set(claim) - {"by_definition"} == FIELDS
        assert set(claim["criterion"]) == {"op", "bound"}
        for field in FIELDS - {"criterion"}:
            assert isinstance(claim[field], str)
            assert claim[field].strip() == claim[field] != ""


def test_what_holds_or_fails_by_definition_is_marked_with_its_reason():
    marked = {c["id"]: c["by_definition"] for c in claims() if "by_definition" in c}
    assert {key: fixed["part"] for key, fixed in marked.items()} == {
        "ineffective_explored_once": "claim",
        "fewer_mappings": "control",
    }
    assert all(fixed["reason"].endswith(".") for fixed in marked.values())


def test_ids_are_unique():
    ids = [claim["id"] for claim in claims()]
    assert len(set(ids)) == len(ids)


def test_criteria_are_finite_numbers_with_a_known_comparison_and_aggregate():
    for claim in claims():
        assert claim["aggregate"] in ("median", "mean", "max", "pooled", "value")
        assert claim["criterion"]["op"] in (">=", "<=")
        bound = claim["criterion"]["bound"]
        assert type(bound) in (int, float)
        assert math.isfinite(bound)


def test_claims_are_read_anew_so_that_nobody_can_bend_them():
    claims()[0]["criterion"]["bound"] = -1
    assert claims()[0]["criterion"]["bound"] == 0.8


# --- aggregates -----------------------------------------------------------------------------------


def test_the_median_leaves_out_runs_without_a_value():
    figure = aggregate([1, None, 3, 10, None], "median")
    assert figure == (3.0, 1.4, 8.6, 3)


def test_the_mean_of_yes_and_no_is_the_share_of_yes():
    assert aggregate([True, False, True, True], "mean").value == 0.75


def test_the_largest_is_of_any_run():
    assert aggregate([0, 7, 3], "max").value == 7


def test_pooled_is_hits_over_cases_of_all_runs_not_a_mean_of_shares():
    figure = aggregate([[1, 1], [0, 3], [0, 0], None], "pooled")
    assert figure.value == 0.25
    assert figure.runs == 2  # runs without cases have no share
    assert (figure.low, figure.high) == pytest.approx((0.1, 0.9))


def test_a_run_may_hold_several_values_and_each_counts():
    figure = aggregate([[1, 2], [3, 41]], "median")
    assert (figure.value, figure.runs) == (2.5, 4)


@pytest.mark.parametrize("how", ["median", "mean", "max", "pooled"])
@pytest.mark.parametrize("values", [[], [None, None]])
def test_of_nothing_there_is_no_figure(how, values):
    figure = aggregate(values, how)
    assert math.isnan(figure.value)
    assert (figure.low, figure.high, figure.runs) == (None, None, 0)


def test_pooled_without_any_case_is_no_figure():
    assert math.isnan(aggregate([[0, 0], [0, 0]], "pooled").value)


# --- judging --------------------------------------------------------------------------------------


def test_a_claim_holds_at_its_bound_and_not_beyond():
    for claim in claims():
        key, bound = claim["id"], claim["criterion"]["bound"]
        if key in TOGETHER or claim["aggregate"] == "pooled":
            continue
        worse = -1e-9 if claim["criterion"]["op"] == ">=" else 1e-9
        assert by_id(results([measures(**{key: bound})]))[key].holds, key
        assert not by_id(results([measures(**{key: bound + worse})]))[key].holds, key


def test_what_could_not_be_measured_never_holds():
    runs = [measures(**{key: None for key in measures() if key not in ("habit", "last_steps")})]
    runs[0]["settled_early"] = math.nan
    for key, verdict in by_id(results(runs)).items():
        if key not in ("habits_differ", "small_sigma_finds_better"):
            assert math.isnan(verdict.figure.value), key
        assert not verdict.holds, key


def test_every_claim_is_judged_once_in_the_order_of_the_file():
    assert [v.claim["id"] for v in judge(results())] == [claim["id"] for claim in claims()]


def test_a_control_that_the_runs_themselves_measure_goes_before_random_motions():
    runs = [measures(**{"new_starts": 3, "control:new_starts": 30})]
    verdict = by_id(results(runs, [measures(new_starts=99)]))["new_starts"]
    assert (verdict.figure.value, verdict.control.value) == (3, 30)
    assert verdict.holds
    assert not verdict.control_holds


def test_other_controls_are_random_motions():
    random = [measures(stays_at_target=0.01), measures(stays_at_target=0.03)]
    verdict = by_id(results([measures(stays_at_target=0.9)], random))["stays_at_target"]
    assert (verdict.figure.value, verdict.control.value) == (0.9, 0.02)
    assert (verdict.holds, verdict.control_holds) == (True, False)


def test_similar_worlds_are_judged_on_runs_in_similar_worlds():
    given = results(
        [measures(similar_worlds=True)],
        [measures(similar_worlds=True)],
        similar=[measures(similar_worlds=False), measures(similar_worlds=True)],
        similar_random=[measures(similar_worlds=False)],
    )
    verdict = by_id(given)["similar_worlds"]
    assert (verdict.figure.value, verdict.control.value) == (0.5, 0)


def test_habits_are_different_paths_over_runs_that_settled():
    runs = [measures(habit=habit) for habit in ("a", "b", "a", None, "c")]
    verdict = by_id(results(runs))["habits_differ"]
    assert verdict.figure[0] == 0.75
    assert verdict.figure.runs == 4
    assert verdict.control.value == 0  # no random run settled
    assert not verdict.control_holds


def test_sigmas_are_compared_by_medians_and_the_control_by_other_seeds():
    def runs(settled, last):
        return [measures(settled_early=s, last_steps=x) for s, x in zip(settled, last)]

    by_sigma = {
        0.7: runs((100, 200, 300), (160, 170, 180)),
        0.1: runs((400, 500, 603), (140, 153, 160)),
        0.3: runs((100, 250, 900), (100, 150, 160)),
    }
    reseeded = runs((200, 300, 400), (200, 200, 200))
    verdicts = by_id(results(by_sigma=by_sigma, reseeded=reseeded))
    sooner, better = (
        verdicts[key] for key in ("sigma_shortens_exploration", "small_sigma_finds_better")
    )
    assert sooner.figure.value == pytest.approx(200 / 500)
    assert sooner.control.value == pytest.approx(300 / 250)
    assert better.figure.value == pytest.approx(153 / 170)
    assert better.control.value == pytest.approx(150 / 200)
    assert (sooner.holds, better.holds) == (True, True)


def test_real_runs_give_every_claim_a_figure_and_a_control(paper):
    def run(seed, agent=None):
        trial = Trial(paper, TrialConfig.paper(), seed, agent)
        return run_of(trial, Schedule(rounds=6), record=True)

    learned = [run(seed) for seed in (1, 2)]
    runs = [{**sweeps.claims(made), **sweeps.new_starts(made)} for made in learned]
    given = copy.deepcopy(results(runs, [sweeps.claims(run(1, RandomAgent(1)))]))
    for key, verdict in by_id(given).items():
        if key in ("late_increases_explore", "settled_path_is_short"):
            continue  # six rounds need not have any
        assert np.isfinite(verdict.figure.value), key
        assert np.isfinite(verdict.control.value), key
