"""Section VI's runs as jobs: what is measured of them."""

import json

import devlearn
import numpy as np
import pytest
from devlearn import Kind, TrialConfig
from devlearn.experiments.schedule import Schedule
from devlearn.paper import jobs
from devlearn.paper.claims import claims
from devlearn.paper.places import new_starts
from devlearn.paper.schedule import run, useful_round


@pytest.fixture(scope="module")
def planned(paper):
    """A job of the learner with two new starts, and one of random motions."""
    config = TrialConfig.paper()
    starts = new_starts(paper, config, 2)
    learner = jobs.job(paper, config, 4, rounds=30, shortest=113, starts=starts)
    return learner, jobs.job(paper, config, 4, agent="random", rounds=1, shortest=113)


@pytest.fixture(scope="module")
def measured(planned):
    return [jobs.execute(job) for job in planned]


@pytest.fixture(scope="module")
def made(paper):
    """The learner's run of ``planned``, made anew."""
    return run(paper, TrialConfig.paper(), 4, Schedule(rounds=30))


def test_a_job_is_plain_values_and_gives_the_same_measures_from_json(planned, measured):
    for job, measures in zip(planned, measured):
        again = json.loads(json.dumps(job))
        assert again == job
        assert json.dumps(jobs.execute(again)) == json.dumps(measures)


def test_every_claim_is_measured_on_runs_and_on_its_control(measured):
    learner, random = measured
    # Of all runs together, or of runs with another sigma:
    together = {"habits_differ", "sigma_shortens_exploration", "small_sigma_finds_better"}
    for claim in claims():
        if (key := claim["id"]) not in together:
            assert key in learner, key
            assert f"control:{key}" in learner or key in random, key


def test_measures_of_rounds_are_those_of_the_runs_records(measured, made):
    m, rounds = measured[0], made.paths.rounds
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
    m, records = measured[0], [made.first, made.second, made.paths]
    kind, smf, motion, situation = (
        np.concatenate([getattr(r, name) for r in records])
        for name in ("kind", "smf_used", "motion", "situation")
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
    assert m["control:settled_path_is_short"] == m["first_arrival"] / 113
    touched = made.first.collided[: m["first_arrival"]].any()
    assert m["control:settled_path_is_free"] == (not touched)


def test_random_motions_are_measured_as_a_table_that_learns_nothing(measured, paper):
    m = measured[1]
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


def test_new_starts_are_measured_in_rounds_with_what_was_learned_and_without(
    planned, measured, paper, made
):
    needed = []
    for start, shortest in planned[0]["starts"]:
        record = useful_round(paper, TrialConfig.paper(), made.trial.learner, start, shortest)
        needed.append(41 if record is None else len(record.rounds))
    assert measured[0]["new_starts"] == needed
    assert len(measured[0]["control:new_starts"]) == 2
    assert measured[0]["control:new_starts"] != needed
