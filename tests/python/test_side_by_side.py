"""The comparison of agents: its measures of a run made by hand, and that it runs."""

import importlib
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

BENCH = Path(__file__).resolve().parents[2] / "bench"


@pytest.fixture
def compare(monkeypatch):
    """The module side_by_side."""
    monkeypatch.syspath_prepend(str(BENCH))
    yield importlib.import_module("side_by_side")
    sys.modules.pop("side_by_side", None)


def made(compare, steps, *, failed=(), paths=None, **more):
    """A run of these steps a round; the shortest path has 100, a tenth of the steps touch."""
    steps = np.array(steps)
    arrived = np.ones(len(steps), dtype=bool)
    arrived[list(failed)] = False
    path = np.array(paths) if paths is not None else np.arange(len(steps))
    whole = {"shortest": 100, "planned": len(steps), **more}
    return compare.Run(steps, arrived, steps // 10, path, **whole)


def measured(compare, run):
    return {name: measure.of(run) for name, measure in compare.MEASURES.items()}


def test_each_measure_has_the_value_that_a_run_made_by_hand_has(compare):
    # A failed round may be short without being good.
    steps = [120, 1000, 400, 150, 125] + [110] * 25
    paths = [0, 1, 2, 3, 4, 5, 5] + [6] * 23
    run = made(compare, steps, failed=[0], paths=paths, seconds=2e-6)
    assert measured(compare, run) == {
        "steps to first arrival": 1120,
        "steps to 1.5 L": 1670,
        "steps to 1.25 L": 1795,
        "last path / L": 1.1,
        "settled from round": 8,
        "failed rounds": pytest.approx(1 / 30),
        "touching": pytest.approx(0.1),
        "ns a step": pytest.approx(2000 / 4545),
    }


def test_free_learning_counts_before_the_rounds_and_may_arrive_first(compare):
    run = made(compare, [110] * 20, before=20_000, found=1234)
    values = measured(compare, run)
    assert values["steps to first arrival"] == 1234
    assert values["steps to 1.25 L"] == 20_110
    assert compare.steps_to_first_arrival(run._replace(found=None)) == 20_110


def test_what_a_run_never_reached_is_infinite(compare):
    hopeless = made(compare, [10_000] * 20, failed=range(20), paths=[0] * 20, planned=600)
    values = measured(compare, hopeless)
    reached = ("steps to first arrival", "steps to 1.5 L", "steps to 1.25 L", "last path / L")
    assert {values[name] for name in (*reached, "settled from round")} == {math.inf}
    assert values["failed rounds"] == 1


def test_a_run_has_settled_only_if_at_least_20_last_rounds_arrive_alike(compare):
    same = [7] * 30
    assert compare.settled_from(made(compare, [110] * 30, paths=same)) == 1
    assert compare.settled_from(made(compare, [110] * 30, paths=same, failed=[9])) == 11
    assert compare.settled_from(made(compare, [110] * 30, paths=same, failed=[10])) == math.inf
    assert compare.settled_from(made(compare, [110] * 30, paths=[*same[1:], 8])) == math.inf


def test_half_of_the_last_rounds_failed_is_no_last_path(compare):
    assert compare.final_ratio(made(compare, [110] * 20, failed=range(9))) == 1.1
    assert compare.final_ratio(made(compare, [110] * 20, failed=range(11))) == math.inf


def test_rounds_that_were_not_reached_cost_as_much_as_failed_ones(compare):
    assert compare.cost(made(compare, [150, 250])) == 2
    assert compare.cost(made(compare, [150], planned=2)) == (150 + compare.LIMIT) / 200


def test_the_search_tries_as_many_different_settings_of_each_agent_and_all_are_taken(compare):
    for agent in compare.SEARCHED:
        tried = compare.drawn_settings(agent)
        assert len(tried) == compare.SEARCH_SETTINGS
        assert len({json.dumps(settings, sort_keys=True) for settings in tried}) == len(tried)
        for settings in tried:
            compare.trial_of(agent, settings, compare.World.load("empty"), 0)
    committed = json.loads(compare.SETTINGS.read_text())
    assert set(committed) == set(compare.SEARCHED)
    for agent, chosen in committed.items():
        assert chosen["settings"] in compare.drawn_settings(agent)


def test_the_script_compares_two_agents_and_goes_on_where_it_was(tmp_path):
    command = [sys.executable, str(BENCH / "side_by_side.py"), str(tmp_path), "--rounds", "25",
               "--worlds", "empty", "--agents", "AdaptiveLearner", "ShortestPathAgent",
               "--seeds", "1"]  # fmt: skip

    def run():
        subprocess.run(command, check=True, capture_output=True)
        return (tmp_path / "side_by_side.md").read_text()

    text = run()
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines()]
    bound = next(row for row in rows if row[:1] == ["ShortestPathAgent"])
    assert bound[4:7] == ["1.00", "1", "0.0 %"]
    assert [row[0] for row in rows if row].count("AdaptiveLearner") == 5
    assert (tmp_path / "side_by_side.png").stat().st_size > 10_000
    journal = (tmp_path / "side_by_side.jsonl").read_bytes()
    assert run() == text
    assert (tmp_path / "side_by_side.jsonl").read_bytes() == journal
