"""Both presets in every world: runs as planned, and a table that says what they came to."""

import matplotlib
import numpy as np
import pytest
from devlearn import Robot, Tally, Trial, TrialConfig, World, shortest_path, sweep
from devlearn.experiments.schedule import Schedule
from devlearn.paper import beyond, measures, schedule

matplotlib.use("Agg")


def run_of(steps, arrived, settled, total=1000):
    return {"steps": steps, "arrived": arrived, "settled": settled, "total": total}


@pytest.fixture
def found():
    good = run_of([500] * 30 + [110] * 570, [True] * 600, 31, 90_000)
    late = run_of([500] * 30 + [120] * 569 + [10_000], [True] * 599 + [False], None, 91_000)
    hopeless = run_of([10_000] * 20, [False] * 20, None, 220_000)
    return {"here": {"paper": [hopeless] * 3, "adaptive": [good, good, late]}}


def test_the_table_says_what_each_preset_came_to(found):
    head, row = beyond.table(found, {"here": 100})
    assert head[:2] == ["world", "shortest path"]
    assert row == [
        "here", "100", "fails", "0 of 3", "100.0%", "220 thousand",
        "1.10", "2 of 3, 31", "0.1%", "90 thousand",
    ]  # fmt: skip


def test_a_run_that_ended_early_failed_in_the_rounds_left_out(found):
    figure = beyond.draw(found, {"here": 100}).figure
    lines = {line.get_label(): line.get_ydata() for line in figure.axes[0].get_lines()}
    assert (lines["paper"] == 10_000).all()
    assert lines["adaptive"][0] == 500
    assert lines["adaptive"][-1] == 110
    assert list(lines["shortest path"]) == [100, 100]


def test_the_runs_are_found_again_by_world_and_preset(tmp_path, monkeypatch):
    monkeypatch.setattr(schedule, "SECTION_VI", Schedule((200, 200), rounds=45, step_limit=400))
    worlds = ["empty", "corridor"]
    plan = beyond.planned(worlds, [3, 4])
    found, shortest = beyond.results(plan, sweep([*plan.values()], tmp_path / "r.sqlite"))
    assert list(found) == list(shortest) == worlds
    for name in worlds:
        world = World.load(name)
        assert (
            shortest[name]
            == shortest_path(Robot(world), goal_radius=TrialConfig().goal_radius).steps
        )
        assert list(found[name]) == ["paper", "adaptive"]
        for seed, made in zip((3, 4), found[name]["adaptive"]):
            paths = Trial(world, TrialConfig.adaptive(), seed=seed).path_learning(45, 400)
            assert made["steps"] == paths.rounds["steps"].tolist()
            assert made["arrived"] == paths.rounds["arrived"].tolist()
            assert made["settled"] == measures.settled_round(paths)
            assert made["total"] == len(paths)
        for seed, made in zip((3, 4), found[name]["paper"]):
            trial = Trial(world, TrialConfig.paper(), seed=seed)
            free = [trial.free_learning(200) for _ in range(2)]
            paths = trial.path_learning(len(made["steps"]), 400)
            assert made["steps"] == paths.rounds["steps"].tolist()
            assert made["total"] == sum(map(len, free)) + len(paths)


def test_rounds_are_counted_from_the_first_of_path_learning_and_forty_make_a_habit():
    rounds = np.zeros(44, Tally().rounds.dtype)
    rounds["round"], rounds["steps"], rounds["arrived"] = np.arange(1, 45), 7, True
    rounds["path"][:4] = [1, 2, 3, 4]
    assert beyond.measure(rounds, 2)["settled"] == 3
    rounds["path"][4] = 5
    assert beyond.measure(rounds, 2)["settled"] is None
    assert beyond.measure(rounds, 2)["total"] == 44 * 7
    assert beyond.measure(rounds, 2)["steps"] == [7] * 42
