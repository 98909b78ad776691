"""Section VI's runs: the worlds and starts drawn for them, how they end, what is measured."""

import json
import math
from types import SimpleNamespace

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import Kind, Robot, Trial, TrialConfig, World, shortest_path
from devlearn.paper import schedule
from devlearn.paper.claims import claims

HOPELESS = {"free_steps": 10, "step_limit": 2}  # nothing is reached in two steps from afar


@pytest.fixture(scope="module")
def jobs(paper):
    """A job of the learner with two new starts, and one of random motions."""
    config = TrialConfig.paper()
    starts = schedule.new_starts(paper, config, 2)
    learner = schedule.job(paper, config, 4, rounds=30, shortest=113, starts=starts)
    return learner, schedule.job(paper, config, 4, agent="random", rounds=1, shortest=113)


@pytest.fixture(scope="module")
def measured(jobs):
    return [schedule.execute(job) for job in jobs]


@pytest.fixture(scope="module")
def made(paper):
    """The learner's run of ``jobs``, made anew."""
    return schedule.run(paper, TrialConfig.paper(), 4, rounds=30)


# --- worlds and starts ----------------------------------------------------------------------------


def outline(obstacle):
    """Points of an obstacle's outline: corners, or places around a circle."""
    if isinstance(obstacle, devlearn.Polygon):
        return list(obstacle.corners)
    x, y = obstacle.center
    if isinstance(obstacle, devlearn.Circle):
        around = np.linspace(0, 2 * np.pi, 72)
        return [(x + obstacle.radius * np.cos(a), y + obstacle.radius * np.sin(a)) for a in around]
    c, s = np.cos(np.radians(obstacle.angle)), np.sin(np.radians(obstacle.angle))
    half = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) * obstacle.size / 2
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in half]


def test_a_similar_world_is_the_same_at_every_call_and_another_for_another_number():
    texts = [schedule.similar_world(i).to_json() for i in (1, 2, 3, 1)]
    assert texts[0] == texts[3]
    assert len(set(texts)) == 3


@pytest.mark.parametrize("index", range(1, 7))
def test_in_a_similar_world_start_and_target_are_free_and_there_is_a_way(index, paper):
    world = schedule.similar_world(index)
    assert (world.start, world.target) == (paper.start, paper.target)
    assert world.clearance(*world.start[:2], walls_count=True) > 0.2
    assert world.clearance(*world.target, walls_count=True) > 0.2
    assert len(shortest_path(Robot(world))) > 1


@pytest.mark.parametrize("index", range(1, 21))
def test_obstacles_of_a_similar_world_have_the_papers_sizes_and_a_way_between_them(index, paper):
    world = schedule.similar_world(index)
    for moved, original in zip(world.obstacles, paper.obstacles):
        assert type(moved) is type(original)
        size, other = (np.ptp(_distances(o)) for o in (moved, original))
        assert size == pytest.approx(other)
        assert _distances(moved) == pytest.approx(_distances(original))
        others = [o for o in world.obstacles if o != moved]
        assert len(others) == 7
        alone = World(5, 5, world.start, world.target, others)
        assert min(float(alone.clearance(x, y)) for x, y in _inside(outline(moved))) >= 0.35


def _distances(obstacle):
    points = outline(obstacle)
    return [math.dist(p, q) for p in points for q in points]


def _inside(points):
    return [(min(max(x, 0.0), 5.0), min(max(y, 0.0), 5.0)) for x, y in points]


def test_new_starts_are_free_far_and_timed_by_the_shortest_path(paper):
    config = TrialConfig.paper()
    starts = schedule.new_starts(paper, config)
    assert len(starts) == 8
    for pose, steps in starts:
        assert paper.clearance(pose.x, pose.y, walls_count=True) >= 0.15
        assert math.dist(pose[:2], paper.target) >= 1.5
        assert math.dist(pose[:2], paper.start[:2]) >= 1.5
        assert pose.heading % 30 == 0
        assert steps == len(shortest_path(Robot(paper), pose)) - 1
        Trial(paper.with_start(pose))
    assert len({pose.heading for pose, _ in starts}) > 2


def test_new_starts_are_the_same_at_every_call_and_fewer_are_the_first(paper):
    config = TrialConfig.paper()
    starts = schedule.new_starts(paper, config)
    assert schedule.new_starts(paper, config) == starts
    assert schedule.new_starts(paper, config, 3) == starts[:3]


def test_a_world_without_room_for_new_starts_is_refused():
    small = World(2, 2, (0.5, 0.5, 0), (1.5, 1.5))
    refused(lambda: schedule.new_starts(small, TrialConfig()), "world", "0 new starts")


# --- runs -----------------------------------------------------------------------------------------


def test_a_run_is_two_rounds_of_free_learning_and_then_rounds_of_path_learning(paper):
    config = TrialConfig.step5()
    made = schedule.run(paper, config, 9, rounds=25, free_steps=300, step_limit=900)
    trial = Trial(paper, config, 9)
    assert differences(made.first, trial.free_learning(300)) == []
    assert differences(made.second, trial.free_learning(300)) == []
    assert differences(made.paths, trial.path_learning(25, 900)) == []
    assert made.paths.rounds["round"].tolist() == list(range(3, 28))
    assert made.trial.learner.explored_count == trial.learner.explored_count


@pytest.mark.parametrize(("rounds", "kept"), [(7, 7), (20, 20), (21, 20), (100, 20)])
def test_a_run_that_is_hopeless_ends_after_twenty_failed_rounds(paper, rounds, kept):
    made = schedule.run(paper, TrialConfig(), 1, rounds=rounds, **HOPELESS)
    assert len(made.paths.rounds) == kept
    assert not made.paths.rounds["arrived"].any()
    assert (made.paths.rounds["steps"] == 2).all()


def test_a_run_in_which_a_round_arrives_goes_on():
    near = World(5, 5, (2.5, 2.5, 0), (2.5 + 0.4, 2.5))
    made = schedule.run(near, TrialConfig(), 1, rounds=45, free_steps=10, step_limit=60)
    assert made.paths.rounds["arrived"].any()
    assert len(made.paths.rounds) == 45


def test_an_unknown_preset_is_refused():
    assert schedule.preset("paper") == TrialConfig.paper()
    assert schedule.preset("step5") == TrialConfig.step5()
    refused(lambda: schedule.preset("step6"), "preset", "'step6'")


def test_settled_runs_are_those_that_settled_each_on_a_path_of_its_own(monkeypatch):
    habits = {1: None, 2: "a", 3: "a", 4: None, 5: "b", 6: "a", 7: "c"}
    monkeypatch.setattr(schedule, "run", lambda world, config, seed: SimpleNamespace(paths=seed))
    monkeypatch.setattr(schedule.measures, "habit", lambda paths: habits[paths])
    found = schedule.settled_runs(None, None)
    assert [next(found).paths for _ in range(3)] == [2, 5, 7]


# --- measures -------------------------------------------------------------------------------------


def test_a_job_is_plain_values_and_gives_the_same_measures_from_json(jobs, measured):
    for job, measures in zip(jobs, measured):
        again = json.loads(json.dumps(job))
        assert again == job
        assert json.dumps(schedule.execute(again)) == json.dumps(measures)


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
    made = schedule.run(paper, TrialConfig.paper(), 4, agent=devlearn.RandomAgent(4), rounds=1)
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


# --- new starts -----------------------------------------------------------------------------------


def test_rounds_from_a_new_start_end_with_one_that_is_useful(paper, made):
    config = TrialConfig.paper()
    (start, shortest) = schedule.new_starts(paper, config, 1)[0]
    before = made.trial.learner.explored_count
    record = schedule.useful_round(paper, config, made.trial.learner, start, shortest)
    assert record.rounds["arrived"][-1]
    useful = (record.rounds["steps"] <= 1.5 * shortest) & record.rounds["arrived"]
    assert useful.tolist() == [False] * (len(useful) - 1) + [True]
    assert record.path(0)[0].tolist() == list(start)
    assert made.trial.learner.explored_count == before  # it learned with a copy


def test_useful_is_at_most_one_and_a_half_times_the_shortest_path(paper, made):
    config, learner = TrialConfig.paper(), made.trial.learner
    start = schedule.new_starts(paper, config, 1)[0][0]
    first = schedule.useful_round(paper, config, learner, start, 10**6).rounds
    assert first["arrived"].tolist() == [False] * (len(first) - 1) + [True]
    steps = int(first["steps"][-1])
    enough = -(-steps * 2 // 3)  # the least whole number that makes so many steps useful
    useful = schedule.useful_round(paper, config, learner, start, enough)
    assert useful.rounds.tolist() == first.tolist()
    later = schedule.useful_round(paper, config, learner, start, enough - 1)
    assert later is None or len(later.rounds) > len(first)


def test_new_starts_are_measured_in_rounds_with_what_was_learned_and_without(
    jobs, measured, paper, made
):
    needed = []
    for start, shortest in jobs[0]["starts"]:
        record = schedule.useful_round(
            paper, TrialConfig.paper(), made.trial.learner, start, shortest
        )
        needed.append(41 if record is None else len(record.rounds))
    assert measured[0]["new_starts"] == needed
    assert len(measured[0]["control:new_starts"]) == 2
    assert measured[0]["control:new_starts"] != needed


@pytest.mark.parametrize(("in_a_row", "made_in_all"), [(3, 3), (99, 40)])
def test_a_robot_trapped_at_a_new_start_is_given_up(
    paper, made, monkeypatch, in_a_row, made_in_all
):
    rounds = []

    class Watched(Trial):
        def path_learning(self, *arguments):
            rounds.append(arguments)
            return super().path_learning(*arguments)

    monkeypatch.setattr(schedule, "Trial", Watched)
    monkeypatch.setattr(schedule, "STEP_LIMIT", 1)
    monkeypatch.setattr(schedule, "TRAPPED_ROUNDS", in_a_row)
    config, learner = TrialConfig.paper(), made.trial.learner
    assert schedule.useful_round(paper, config, learner, (2.5, 3.0, 0.0), 50) is None
    assert rounds == [(1, 1)] * made_in_all
