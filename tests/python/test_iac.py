"""Intelligent adaptive curiosity in a trial and in its task. What it learns is tested in C++."""

import copy
import pickle

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import FileError, RobotDef, Trial, TrialConfig, World, agents, tasks

EMPTY = World.load("empty")


def lived(agent, task, steps, seed=0):
    """The motions of so many steps."""
    task.begin(seed)
    motions = []
    for _ in range(steps):
        motions.append(agent.choose(task.observation()).motion)
        agent.observe(task.step(motions[-1]))
    return motions


def test_step_by_step_and_in_one_call_give_the_same_history():
    whole = Trial(EMPTY, agent=agents.Iac(seed=3))
    record = whole.free_learning(700)
    cut = Trial(EMPTY, agent=agents.Iac(seed=3))
    parts = [cut.free_learning(250), cut.run(1), cut.run(0), cut.run(449)]
    assert differences(devlearn.Record.concatenate(parts), record) == []
    assert pickle.dumps(whole.agent) == pickle.dumps(cut.agent)
    other = Trial(EMPTY, agent=agents.Iac(seed=4)).free_learning(700)
    assert "motion" in differences(other, record)


def test_what_is_saved_loaded_pickled_or_copied_goes_on_equal_to_the_bit(tmp_path):
    trial = Trial(EMPTY, agent=agents.Iac(agents.Iac.Config(neighbours=2), seed=3))
    trial.path_learning(rounds=3, step_limit=400)
    trial.run(77)
    trial.save(tmp_path / "trial.safetensors")
    others = [
        Trial.load(tmp_path / "trial.safetensors"),
        pickle.loads(pickle.dumps(trial)),
        trial.copy(),
        copy.deepcopy(trial),
    ]
    record = trial.path_learning(rounds=2, step_limit=300)
    for other in others:
        assert type(other.agent) is agents.Iac
        assert differences(other.path_learning(rounds=2, step_limit=300), record) == []
        assert pickle.dumps(other.agent) == pickle.dumps(trial.agent)


def test_only_motions_that_the_safety_layer_allows_are_chosen():
    world = World(width=1.5, height=1.5, start=(0.22, 0.75, 180), target=(1.2, 1.2))
    config = TrialConfig(robot=RobotDef(safety_margin=0.09))
    record = Trial(world, config, agent=agents.Iac(seed=2)).free_learning(500)
    robot = devlearn.Robot(world, config.robot)
    allowed = [robot.allowed(pose) for pose in zip(record.x, record.y, record.heading)]
    limits = [one for one in zip(allowed, record.motion) if not np.all(one[0])]
    assert limits
    assert all(mask[motion] for mask, motion in limits if np.any(mask))


def test_a_task_is_lived_through_as_by_hand():
    task = tasks.Attention(tasks.Attention.Config(steps=400))
    one, other = (agents.Iac(seed=1, motors=task.motors) for _ in range(2))
    episodes = tasks.run(task, one, 3, seed=5)
    assert episodes["steps"].tolist() == [400] * 3
    assert episodes["ended"].all() and episodes["succeeded"].all()
    assert not episodes["reward"].any()
    again = [tasks.run(task, other, 1, seed=5, first=i) for i in range(3)]
    assert np.array_equal(np.concatenate(again), episodes)
    assert pickle.dumps(one) == pickle.dumps(other)
    assert lived(one, task, 100) == lived(pickle.loads(pickle.dumps(other)), task, 100)


def test_an_explanation_tells_regions_and_chances_and_changes_nothing():
    task = tasks.Attention()
    agent = agents.Iac(seed=1, motors=task.motors)
    lived(agent, task, 700)
    state = pickle.dumps(agent)
    why = agent.explain(task.observation())
    assert pickle.dumps(agent) == state
    assert why.senses == [task.distance]
    assert sum(why.probability) == pytest.approx(1.0)
    best = max(why.progress)
    chances = np.array(why.probability)
    most = chances[np.array(why.progress) == best].sum()
    assert most >= 0.65
    known = {region.region: region for region in why.regions}
    for row, number, progress in zip(task.motors, why.region, why.progress):
        region = known[number]
        assert region.progress == progress
        point = np.array([task.distance, *row])
        assert np.all(point >= region.lower) and np.all(point < region.upper)
    assert str(why).count("\n") == 2 + len(why.regions)
    assert pickle.loads(pickle.dumps(why)) == why
    assert "exemplars" in repr(why.regions[0])


def test_regions_are_an_array_and_a_tree_that_can_be_printed():
    task = tasks.Attention()
    agent = agents.Iac(seed=1, motors=task.motors)
    assert len(agent.regions()) == 0 and agent.tree() == ""
    lived(agent, task, 1000)
    regions = agent.regions()
    leaves = regions[regions["split_dimension"] < 0]
    assert len(regions) == 2 * len(leaves) - 1
    assert leaves["exemplars"].sum() == 999
    assert regions["lower"].shape == (len(regions), 4)
    first = regions[0]
    assert first["split_dimension"] == 3  # the frequency
    assert regions["upper"][first["below"], 3] == first["split_value"]
    assert agent.tree().count("\n") == len(regions)
    assert agent.tree().startswith("0: split after 251 at ")


def test_a_prediction_is_what_will_be_sensed():
    task = tasks.Attention(tasks.Attention.Config(noise=0.0))
    agent = agents.Iac(seed=1, motors=task.motors)
    task.begin()
    assert agent.predict(task.observation(), 0) is None
    lived(agent, task, 2000)
    for motion in range(task.motion_count):
        if task.zone(motion) == 2:  # the toy comes
            assert agent.predict(task.observation(), motion) == pytest.approx([0.0], abs=0.2)


def test_motors_are_a_matrix_with_a_row_a_motion():
    agent = agents.Iac(motors=[[0.0, 1.0], [1.0, 0.0]])
    assert agent.motors.tolist() == [[0.0, 1.0], [1.0, 0.0]]
    assert agents.Iac().motors is None
    refused(lambda: agents.Iac(motors=[1.0, 2.0]), "motors")
    refused(lambda: agents.Iac(motors="text"), "motors")
    refused(lambda: agents.Iac(motors=[[np.nan]]), "motors")
    refused(lambda: agent.choose(devlearn.Observation(0, 3, senses=[0.0])), "motion_count")
    agent.choose(devlearn.Observation(0, 2, senses=[0.0]))
    refused(lambda: agent.explain(devlearn.Observation(0, 2, senses=[0.0, 1.0])), "senses")
    refused(lambda: agent.predict(devlearn.Observation(0, 2, senses=[0.0]), 2), "motion")
    default = agents.Iac()
    Trial(EMPTY, agent=default).run(1)
    assert default.motors.tolist() == [[0.0], [0.25], [0.5], [0.75], [1.0]]


def test_a_state_that_lacks_anything_is_refused_by_its_name():
    task = tasks.Attention()
    agent = agents.Iac(motors=task.motors)
    lived(agent, task, 600)
    state = agent.__getstate__()[0]
    for name in state:
        with pytest.raises(FileError, match=rf"state: (__metadata__\.)?{name}"):
            agents.Iac.__new__(agents.Iac).__setstate__(
                ({k: v for k, v in state.items() if k != name}, {})
            )


def test_attention_shows_where_its_robot_and_toy_are():
    task = tasks.Attention(tasks.Attention.Config(noise=0.0))
    task.begin(3)
    apart = np.hypot(task.robot[0] - task.toy[0], task.robot[1] - task.toy[1])
    assert task.distance == pytest.approx(apart)
    assert task.observation().senses.tolist() == [task.distance]
    assert task.motors.shape == (225, 3)
    assert [task.zone(motion) for motion in range(9)] == [0, 0, 0, 1, 1, 1, 2, 2, 2]
    refused(lambda: task.zone(225), "motion")
