"""The robot that learns to stand, from Python. Its mechanics and laws are tested in C++."""

import pathlib
import re

import numpy as np
import pytest
from conftest import refused
from devlearn import Learner, LearnerConfig, RandomAgent, tasks

DOCS = pathlib.Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize("page", ["balance.md", "tasks.md"])
def test_the_guides_code_runs(page):
    names = {}
    for code in re.findall(r"```python\n(.*?)```", (DOCS / page).read_text("utf-8"), re.DOTALL):
        exec(code, names)
    assert names["trials"]["steps"].max() > 3 * names["trials"]["steps"][:5].mean()


def test_a_state_is_four_numbers_as_the_senses():
    task = tasks.Balance()
    state = [3.0, -20.0, 90.0, 45.0]
    task.begin_at(state)
    assert task.state == pytest.approx(state)
    assert task.observation().senses.tolist() == task.state.tolist()
    assert task.observation().situation == task.situation_of(task.state)
    assert task.observation().sef == task.sef_of(task.state)
    lean = 3.0 - 0.07 * 20.0 + 0.02 * 45.0
    assert task.sef_of(state) == pytest.approx(-20.0 * (lean / 15.0) ** 2)
    assert task.situation_count == 245
    assert {task.situation_of([a, 0, 0, 0]) for a in np.arange(-15, 15)} == {
        17 + 35 * i for i in range(7)
    }
    refused(lambda: task.begin_at([16, 0, 0, 0]), "angle")
    refused(lambda: task.begin_at([0, 0, 0]))
    refused(lambda: task.step(5), "motion")
    task.step(2)
    assert task.time == pytest.approx(0.02)


def test_what_does_not_fit_together_is_refused():
    config = tasks.Balance.Config(angle_edges=[1.0, 0.5])
    refused(lambda: tasks.Balance(config), "BalanceConfig.angle_edges")
    refused(lambda: tasks.Balance.Config(robot=tasks.TwoWheeledDef(wheel_radius=0.0)))
    refused(lambda: tasks.Balance.Config(torques=[]), "BalanceConfig.torques")


def test_runs_in_pieces_equal_one_in_one_call():
    whole, cut = (Learner(LearnerConfig(motion_count=5), seed=4) for _ in range(2))
    one = tasks.run(tasks.Balance(), whole, 12, seed=3)
    task = tasks.Balance()
    parts = [tasks.run(task, cut, 5, seed=3), tasks.run(task, cut, 7, seed=3, first=5)]
    assert np.concatenate(parts).tolist() == one.tolist()
    assert cut.to_bytes() == whole.to_bytes()


def test_a_fall_costs_and_a_short_while_is_stood():
    fallen = tasks.run(tasks.Balance(), RandomAgent(1), 20, seed=1)
    assert not fallen["succeeded"].any()
    assert fallen["ended"].all()
    assert (fallen["reward"] == -100.0).all()
    short = tasks.Balance(tasks.Balance.Config(duration=0.06))
    stood = tasks.run(short, RandomAgent(1), 20, seed=1)
    assert stood["succeeded"].all()
    assert (stood["reward"] == 0.0).all()
