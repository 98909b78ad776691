"""Section VI's runs as sweeps: what is planned, and what is measured of a run."""

import json

import devlearn
import numpy as np
import pytest
from devlearn import Event, Kind, Trial, TrialConfig, sweep
from devlearn.experiments.job import execute, run_of
from devlearn.experiments.schedule import Schedule
from devlearn.experiments.spec import Together
from devlearn.paper import measures, schedule, sweeps
from devlearn.paper.claims import claims
from devlearn.paper.places import new_starts
from devlearn.paper.schedule import run, useful_round

STARTS = ("new_starts", "control:new_starts")


@pytest.fixture(scope="module")
def learner(paper):
    """A run of the learner, short."""
    return run_of(Trial(paper, TrialConfig.paper(), 4), Schedule(rounds=30), record=True)


@pytest.fixture(scope="module")
def random(paper):
    """A run of random motions."""
    trial = Trial(paper, TrialConfig.paper(), 4, devlearn.RandomAgent(4))
    return run_of(trial, Schedule(rounds=1), record=True)


@pytest.fixture(scope="module")
def measured(learner):
    return sweeps.claims(learner)


@pytest.fixture(scope="module")
def made(paper):
    """The learner's run made anew, and not by a sweep."""
    return run(paper, TrialConfig.paper(), 4, Schedule(rounds=30))


def jobs_of(specs):
    return [*Together(specs).jobs()]


# --- what is planned ------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", ["paper", "step5"])
def test_the_runs_are_those_that_the_claims_are_about(preset):
    plan = sweeps.planned(preset, range(1, 4))

    def of(specs):
        return [
            (job.world, job.agent, job.settings, job.seed, job.schedule.rounds)
            for job in jobs_of(specs)
        ]

    seeds = (1, 2, 3)
    assert of(plan.runs) == [("paper", preset, {}, seed, 600) for seed in seeds]
    assert of(plan.random) == [("paper", "RandomAgent", {}, seed, 60) for seed in seeds]
    assert of(plan.similar) == [(f"similar:{seed}", preset, {}, seed, 100) for seed in seeds]
    assert of(plan.similar_random) == [
        (f"similar:{seed}", "RandomAgent", {}, seed, 20) for seed in seeds
    ]
    assert of(plan.reseeded) == [("paper", preset, {}, 1000 + seed, 600) for seed in seeds]
    assert list(plan.by_sigma) == list(schedule.SIGMAS[preset])
    for sigma, specs in plan.by_sigma.items():
        settings = {} if sigma == 0.3 else {"sigma": sigma}
        assert of(specs) == [("paper", preset, settings, seed, 600) for seed in seeds]
    everything = jobs_of(plan.all())
    assert {(*job.schedule.free, job.schedule.step_limit, job.schedule.hopeless)
            for job in everything} == {(10_000, 10_000, 10_000, 20)}  # fmt: skip
    assert len(everything) == 3 * (5 + len(plan.by_sigma) - 1)


def test_random_motions_are_run_once_for_all_presets():
    plans = [sweeps.planned(preset, [1]) for preset in ("paper", "step5")]
    assert len(jobs_of([*plans[0].random, *plans[1].random])) == 1
    assert len(jobs_of([*plans[0].similar_random, *plans[1].similar_random])) == 1


def test_a_planned_run_is_that_trial_measured(learner, monkeypatch):
    monkeypatch.setattr(schedule, "SECTION_VI", Schedule(rounds=30))
    [job] = jobs_of(sweeps.planned("paper", [4]).runs)
    row = execute(job)
    assert json.loads(row.measures[sweeps.CLAIMS]) == sweeps.claims(learner)
    assert len(json.loads(row.measures[sweeps.NEW_STARTS])["new_starts"]) == 8


def test_what_came_of_the_runs_is_found_again_by_preset_and_part(tmp_path, monkeypatch):
    monkeypatch.setattr(schedule, "SECTION_VI", Schedule((3001, 50), 3, step_limit=40))
    monkeypatch.setattr(schedule, "NEW_START_ROUNDS", 1)
    seeds = (2, 1)
    plans = {preset: sweeps.planned(preset, seeds) for preset in schedule.READINGS}
    asked = [spec for plan in plans.values() for spec in plan.all()]
    file = sweep(asked, tmp_path / "runs.sqlite", workers=1)
    for plan in plans.values():
        results = sweeps.results(plan, file)
        for part, specs in plan.by_sigma.items():
            assert results.by_sigma[part] == [made_again(job) for job in jobs_of(specs)]
        for part in ("runs", "random", "similar", "similar_random", "reseeded"):
            again = [made_again(job) for job in jobs_of(getattr(plan, part))]
            assert getattr(results, part) == again


def made_again(job):
    measured = execute(job).measures
    return {key: value for own in job.measures for key, value in json.loads(measured[own]).items()}


# --- what is measured -----------------------------------------------------------------------------


def test_every_claim_is_measured_on_runs_and_on_its_control(measured, random):
    measured, control = measured | dict.fromkeys(STARTS), sweeps.claims(random)
    # Of all runs together, or of runs with another sigma:
    together = {"habits_differ", "sigma_shortens_exploration", "small_sigma_finds_better"}
    for claim in claims():
        if (key := claim["id"]) not in together:
            assert key in measured, key
            assert f"control:{key}" in measured or key in control, key


def test_measures_of_rounds_are_those_of_the_runs_records(measured, made):
    m, rounds = measured, made.paths.rounds
    arrivals = [np.flatnonzero(r.arrived)[0] + 1 for r in (made.first, made.second)]
    cells = [len(set(zip(*np.divmod(r.situation // 12, 20)))) for r in (made.first, made.second)]
    last = made.paths.steps_of(-1)
    assert m["round_steps"] == rounds["steps"].tolist()
    assert m["round_arrived"] == rounds["arrived"].tolist()
    assert m["first_arrival"] == arrivals[0]
    assert m["arrives_sooner"] == arrivals[1] / arrivals[0]
    assert m["wanders_less"] == cells[1] / cells[0]
    assert m["stays_at_target"] == np.mean(made.first.goal_distance[8000:] <= 0.6)
    assert m["rounds_shorten"] == rounds["steps"][10:].mean() / rounds["steps"][:20].mean()
    assert m["last_steps"] == rounds["steps"][10:].mean()
    assert m["settled_path_is_short"] == rounds["steps"][-1] / 113
    assert m["no_collision"] == np.mean(made.first.collided)
    assert m["settled_path_is_free"] == (not made.paths.collided[last].any())
    assert m["similar_worlds"] == rounds["arrived"][10:].all()
    assert m["every_round_arrives"] == 0
    # Thirty rounds are too few to settle; the round after all of them stands for never.
    assert (m["settles"], m["settled_early"], m["habit"]) == (False, 603, None)


def test_measures_of_learning_are_those_of_the_runs_records(measured, made):
    m, records = measured, [made.first, made.second, made.paths]
    kind, smf, motion, situation, event = (
        np.concatenate([getattr(r, name) for r in records])
        for name in ("kind", "smf_used", "motion", "situation", "event")
    )
    explored = list(zip(situation[kind == Kind.EXPLORE], motion[kind == Kind.EXPLORE]))
    counts = made.first.explored_count, made.first.effective_count
    assert m["mappings_explored"] == len(set(explored)) == made.paths.explored_count[-1]
    assert m["ineffective_explored_once"] == len(explored) - len(set(explored)) == 0
    assert m["mappings_effective"] == made.paths.effective_count[-1]
    assert m["fewer_mappings"] == made.paths.effective_count[-1] / 24_000
    assert m["explored_count_settles"] == 1 - counts[0][2999] / counts[0][-1]
    assert m["effective_count_settles"] == abs(1 - counts[1][2999] / counts[1][-1])
    assert m["exploited_are_effective"] == np.mean(smf[kind == Kind.EXPLOIT] < 0)
    assert m["learning_waste_is_small"] == np.mean(kind == Kind.EXHAUSTED)
    updates = np.isin(event, [Event.EXTENSION, Event.ORIENTATION, Event.ABANDONMENT])
    assert m["computing_waste_is_small"] == np.mean(smf[updates] < 0)
    assert m["control:settled_path_is_short"] == m["first_arrival"] / 113
    touched = made.first.collided[: m["first_arrival"]].any()
    assert m["control:settled_path_is_free"] == (not touched)


def test_a_run_that_settled_is_told_by_its_round_and_its_habit(learner, monkeypatch):
    monkeypatch.setattr(measures, "SETTLED_ROUNDS", 1)
    m = sweeps.claims(learner)
    paths = learner.record.part(slice(2, None))
    assert (m["settles"], m["settled_early"]) == (True, measures.settled_round(paths, least=1))
    assert m["habit"] == measures.path_name(paths)


def test_random_motions_are_measured_as_a_table_that_learns_nothing(random, paper):
    m = sweeps.claims(random)
    made = run(paper, TrialConfig.paper(), 4, Schedule(rounds=1), agent=devlearn.RandomAgent(4))
    records = [made.first, made.second, made.paths]
    seen, again, failed = {}, 0, 0
    for record in records:
        for key, smf in zip(zip(record.situation, record.motion), record.smf_used):
            again += seen.get(key, 0) < 0
            failed += smf < 0
            seen.setdefault(key, smf)
    steps = sum(map(len, records))
    assert m["ineffective_explored_once"] == again > 1000
    assert m["learning_waste_is_small"] == again / steps
    assert m["exploited_are_effective"] == m["computing_waste_is_small"] == failed / steps
    first = list(zip(made.first.situation, made.first.motion))
    grown = len(set(first)) - len(set(first[:3000]))
    assert m["explored_count_settles"] == pytest.approx(grown / len(set(first)))
    assert "mappings_explored" not in m


def test_new_starts_are_measured_in_rounds_with_what_was_learned_and_without(learner, paper, made):
    measured = sweeps.new_starts(learner)
    needed = []
    for start, shortest in new_starts(paper, TrialConfig.paper()):
        record = useful_round(paper, TrialConfig.paper(), made.trial.learner, start, shortest)
        needed.append(41 if record is None else len(record.rounds))
    assert measured["new_starts"] == needed
    assert len(measured["control:new_starts"]) == 8
    assert measured["control:new_starts"] != needed
