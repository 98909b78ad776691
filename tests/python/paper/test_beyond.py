"""Both presets in every world: runs as planned, and a table that says what they came to."""

import matplotlib
import numpy as np
import pytest
from devlearn import Trial, TrialConfig, World
from devlearn.paper import beyond

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


def test_a_planned_run_is_that_trial():
    plan = beyond.planned(["empty"], [3])
    assert [TrialConfig.from_dict(job["config"]) for job in plan] == [
        TrialConfig.paper(), TrialConfig.adaptive(),
    ]  # fmt: skip
    job = plan[1] | {"schedule": plan[1]["schedule"] | {"rounds": 30}}
    made = beyond.execute(job)
    trial = Trial(World.load("empty"), TrialConfig.adaptive(), seed=3)
    rounds = trial.path_learning(30).rounds
    assert made["steps"] == rounds["steps"].tolist()
    assert made["arrived"] == rounds["arrived"].tolist()
    assert made["total"] == int(np.sum(made["steps"]))


def test_runs_are_found_again_by_world_and_preset():
    runs = [{"n": i} for i in range(8)]
    found = beyond.by_world(["a", "b"], [1, 2], runs)
    assert found["a"]["adaptive"] == [{"n": 2}, {"n": 3}]
    assert found["b"]["paper"] == [{"n": 4}, {"n": 5}]
