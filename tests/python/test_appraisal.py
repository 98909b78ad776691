"""Appraisal, and the foraging scenarios. What they do is tested in C++."""

import pickle

import numpy as np
import pytest
from conftest import refused
from devlearn import Trial, World, agents, tasks

SCENARIOS = [
    "moving_preys", "persistence", "prey_season", "poisoned_season", "hunger_thirst", "lairs",
]  # fmt: skip
each_scenario = pytest.mark.parametrize("scenario", SCENARIOS)


def foraging(scenario):
    return tasks.Foraging(tasks.Foraging.Config(scenario=scenario))


def curious():
    config = agents.Appraisal.Config(novelty=0.4, control=-0.1, valence=0.2, external=-0.3)
    return agents.Appraisal(config, seed=2)


def test_an_explanation_is_what_the_weights_make_of_the_appraisals():
    agent = agents.Appraisal(
        agents.Appraisal.Config(novelty=0.1, motivation=0.2, valence=0.2, external=0.2), seed=1
    )
    assert agent.explain(0) is None
    record = Trial(World.load("empty"), agent=agent).free_learning(3000)
    situation = int(record.situation[-1])
    before = pickle.dumps(agent)
    why = agent.explain(situation)
    assert pickle.dumps(agent) == before
    reward = (
        0.1 * np.array(why.novelty)
        + 0.2 * why.motivation
        - 0.3 * np.array(why.control)
        + 0.2 * np.array(why.valence)
        + 0.2 * np.array(why.external)
    )
    assert why.reward == pytest.approx(reward)
    assert why.value == [agent.value(situation, motion) for motion in range(5)]
    here = record.motion[record.situation == situation]
    assert why.visits == np.bincount(here, minlength=5).tolist()
    assert why.epsilon == agent.epsilon == pytest.approx(1.0001**-3000)
    assert why.config == agent.config
    assert agent.explain(why.goal).motivation == 1.0
    assert pickle.loads(pickle.dumps(why)) == why
    assert why == agent.explain(situation) != agent.explain(why.goal)
    assert repr(why).startswith(f"<devlearn.agents.AppraisalExplanation: situation {situation}, ")
    lines = str(why).splitlines()
    assert lines[0].startswith(f"situation {situation}: epsilon 0.741, goal {why.goal}")
    assert len(lines) == 3 + 5
    refused(lambda: agent.explain(-1), "situation")


def test_each_weight_lies_between_minus_one_and_one():
    for name in ("novelty", "motivation", "control", "valence", "external"):
        assert agents.Appraisal.Config.fields()[name]["range"] == "in [-1, 1]"
        refused(lambda n=name: agents.Appraisal.Config(**{n: 1.1}), f"AppraisalConfig.{name}")


@each_scenario
def test_foraging_in_one_call_equals_the_loop_by_hand(scenario):
    whole = tasks.run(foraging(scenario), (agent := curious()), 1, seed=3, step_limit=2000)
    task, twin = foraging(scenario), curious()
    first = tasks.run(task, twin, 1, seed=3, step_limit=1)
    total = first["reward"][0]
    for _ in range(1999):
        outcome = task.step(twin.choose(task.observation()).motion)
        twin.observe(outcome)
        total += outcome.reward
        assert not outcome.arrived
        assert outcome.event == (0 if outcome.reward else -1)
    assert total == pytest.approx(whole["reward"][0])
    assert not whole["ended"][0]
    assert agent.explain(task.observation().situation).value == (
        twin.explain(task.observation().situation).value
    )


@each_scenario
def test_a_foraging_grid_is_drawn_and_its_cell_is_the_situation(scenario):
    task = foraging(scenario)
    refused(task.drawn, "drawn")
    task.begin(seed=1)
    rows = task.drawn().splitlines()
    row = next(i for i, cells in enumerate(rows) if "F" in cells)
    cell = row * len(rows[0]) + rows[row].index("F")
    assert task.observation().situation // 16 == cell
    assert task.situation_count == 16 * len(rows) * len(rows[0])
    assert task.motion_count == (6 if scenario == "lairs" else 4)
    assert repr(task) == f"<devlearn.tasks.Foraging: {task.config!r}>"
    assert not task.succeeded
    refused(lambda: task.step(6), "motion")


def test_a_scenario_that_there_is_not_is_refused_by_its_names():
    refused(lambda: tasks.Foraging.Config(scenario="garden"), "ForagingConfig.scenario", "'garden'")
    refused(lambda: tasks.Foraging.Config(season=0), "ForagingConfig.season")
