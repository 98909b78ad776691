"""The driver of the benchmarks: what it judges and flags, from figures that are given."""

import importlib
import math
import sys
from pathlib import Path

import pytest

BENCH = Path(__file__).resolve().parents[2] / "bench"


@pytest.fixture
def bench(monkeypatch):
    """The modules items and run."""
    monkeypatch.syspath_prepend(str(BENCH))
    yield importlib.import_module("items"), importlib.import_module("run")
    for name in ("items", "run"):
        sys.modules.pop(name, None)


def passes(**changed):
    """Three passes alike but for a little noise."""
    times = {
        "floor/move_and_5_rays": 100.0,
        "q_learning/4800": 10.0,
        "learner/replay": 15.0,
        "trial/closed_loop": 200.0,
        "box2d/5_raycasts_3m": 400.0,
    } | {name.replace("__", "/"): time for name, time in changed.items()}
    return [{name: time * noise for name, time in times.items()} for noise in (0.9, 1.0, 1.1)]


def result(run, **changed):
    made = passes(**changed)
    return {"items": run.judged(made, {}, {}), "instructions": {}, "passes": made}


def test_an_item_is_judged_by_the_median_of_the_ratios_within_a_pass(bench):
    _, run = bench
    rows = {row["what"]: row for row in run.judged(passes(), {}, {})}
    row = rows["replay of a free learning / Q loop"]
    assert row["value"] == pytest.approx(1.5)
    assert row["error"] == pytest.approx(0.0, abs=1e-12)  # what all of a pass share cancels
    assert row["holds"] is True
    slow = run.judged(passes(learner__replay=21.0), {}, {})
    assert [r["holds"] for r in slow if r["what"] == row["what"]] == [False]


def test_what_was_not_measured_neither_passes_nor_fails(bench):
    items, run = bench
    rows = run.judged(passes(), {}, {})
    missing = [row for row in rows if row["what"].startswith("start-up")]
    assert [(row["value"], row["holds"]) for row in missing] == [(None, None)]
    assert all(math.isnan(items.value_of(item, {})) for item in items.ITEMS)


def test_what_became_slower_beyond_noise_is_flagged_and_nothing_else(bench):
    _, run = bench
    before = result(run)
    assert list(run.slower(result(run), before)) == []
    assert list(run.slower(result(run, learner__replay=10.0), before)) == []
    flagged = list(run.slower(result(run, learner__replay=18.0), before))
    assert [line.partition(":")[0] for line in flagged] == [
        "replay of a free learning / Q loop",
        "learner/replay / floor",
    ]
    assert all("1.20 x as slow" in line for line in flagged)


def test_more_instructions_are_flagged_however_noisy_the_times(bench):
    _, run = bench
    now, before = result(run), result(run)
    before["instructions"] = {"learner/replay": 100.0, "trial/closed_loop": 100.0}
    now["instructions"] = {"learner/replay": 101.0, "trial/closed_loop": 100.0}
    assert list(run.slower(now, before)) == ["learner/replay: 1.010 x the instructions"]


def test_a_small_robot_finds_its_way_with_the_evaluation_scaled_and_not_with_the_defaults(
    monkeypatch,
):
    monkeypatch.syspath_prepend(str(BENCH))
    scaled = importlib.import_module("scaled_evaluation")
    for seed in range(1, 4):
        arrives, _, frozen = scaled.one(scaled.SCALED, seed)
        assert arrives
        assert frozen
        assert not scaled.one(scaled.DEFAULT, seed)[0]
