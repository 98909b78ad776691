"""Tables and numbers of the report."""

import math
from types import SimpleNamespace

import numpy as np
from devlearn.experiments.schedule import Schedule
from devlearn.paper import schedule, tables


def test_rounds_that_a_hopeless_run_was_not_given_count_as_failed(monkeypatch):
    monkeypatch.setattr(schedule, "SECTION_VI", Schedule(rounds=4, step_limit=90))
    runs = [{"round_steps": steps} for steps in ([10, 20, 30, 40], [20, 90], [30, 10, 20, 20])]
    low, median, high = tables.steps_over_runs(runs)
    assert median.tolist() == [20, 20, 30, 40]
    assert low.tolist() == [12, 12, 22, 24]
    assert high.tolist() == [28, 76, 78, 80]


def test_what_could_not_be_measured_is_null_in_json():
    given = {0.1: [math.nan, 1.0, "nan"], "inf": (math.inf, {"x": -math.inf}, 3, True, None)}
    expected = {"0.1": [None, 1.0, "nan"], "inf": [None, {"x": None}, 3, True, None]}
    assert tables.without_nan(given) == expected


def test_a_table_of_a_run_and_of_all_has_the_papers_rounds(monkeypatch):
    monkeypatch.setattr(schedule, "SECTION_VI", Schedule(rounds=3, step_limit=90))
    monkeypatch.setattr(tables, "PAPER_TABLE_1", {3: 194, 5: 149})
    rounds = np.array([(3, 7, True), (4, 8, True), (5, 9, True)],
                      dtype=[("round", "i4"), ("steps", "i8"), ("arrived", "?")])  # fmt: skip

    one = SimpleNamespace(paths=SimpleNamespace(rounds=rounds), trial=SimpleNamespace(seed=6))
    of_all = SimpleNamespace(runs=[{"round_steps": [10, 20, 30]}, {"round_steps": [20, 20, 50]}])
    head, *rows = tables.table_1(one, {"paper": of_all})
    assert head == ["round", "paper", "seed 6", "paper p10", "paper median", "paper p90"]
    assert rows == [[3, 194, 7, 11.0, 15.0, 19.0], [5, 149, 9, 32.0, 40.0, 48.0]]
