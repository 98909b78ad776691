"""Tasks of devlearn as environments of Gymnasium."""

import pickle
import warnings

import gymnasium
import numpy as np
import pytest
from conftest import refused
from devlearn import agents, tasks
from devlearn.envs import LearnerOn, TaskEnv
from gymnasium.utils.env_checker import check_env

IDS = [
    "devlearn/Attention-v0",
    "devlearn/Balance-v0",
    "devlearn/Foraging-v0",
    "devlearn/Playroom-v0",
]


@pytest.mark.parametrize("name", IDS[:-1])  # it makes motions that the playroom does not allow
def test_gymnasium_s_checker_has_nothing_to_say(name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(name).unwrapped)


@pytest.mark.parametrize("name", IDS)
def test_a_learner_on_the_environment_lives_as_one_in_the_task(name):
    env = gymnasium.make(name).unwrapped
    kind = type(env.task)
    one, other = agents.QLearning(seed=3), agents.QLearning(seed=3)
    situations = None
    if isinstance(env.observation_space, gymnasium.spaces.Dict):
        situations = lambda seen: int(seen["situation"])  # noqa: E731
    on = LearnerOn(env, one, situations=situations)
    episodes = on.run(15, seed=8, step_limit=500)
    told = tasks.run(kind(), other, 15, seed=8, step_limit=500)
    assert episodes["steps"].tolist() == told["steps"].tolist()
    assert episodes["return"].tolist() == told["reward"].tolist()
    assert episodes["terminated"].tolist() == told["ended"].tolist()
    assert pickle.dumps(one) == pickle.dumps(other)


def test_a_step_tells_what_the_task_s_outcome_does_and_the_last_one_whether_it_succeeded():
    config = tasks.Balance.Config(duration=0.2)
    env = gymnasium.make("devlearn/Balance-v0", config=config).unwrapped
    task = tasks.Balance(config)
    for torque, succeeds in ((2, True), (4, False)):
        seen, info = env.reset(seed=5)
        task.begin(5)
        assert seen["situation"] == task.observation().situation
        assert seen["senses"].tolist() == task.observation().senses.tolist()
        assert info == {"sef": task.observation().sef, "estimate": 1.0}
        terminated = False
        while not terminated:
            seen, reward, terminated, truncated, info = env.step(np.int64(torque))
            outcome = task.step(torque)
            assert seen["situation"] == outcome.situation
            assert reward == outcome.reward
            assert terminated == outcome.arrived
            assert not truncated
            for key in ("sef", "smf", "cost", "collided", "event", "estimate"):
                assert info[key] == getattr(outcome, key)
            assert info["succeeded"] == (outcome.arrived and task.succeeded)
        assert info["succeeded"] is succeeds
        refused(lambda: env.step(0), "step")


def test_a_task_is_shared_and_what_is_none_is_refused():
    task = tasks.Balance()
    env = TaskEnv(task)
    assert env.task is task
    refused(lambda: env.step(0), "step")
    env.reset(seed=1)
    refused(lambda: env.step(5), "motion", "5")
    refused(lambda: env.step(0.5), "action")
    refused(lambda: env.reset(options={"pose": 1}), "options")
    refused(lambda: env.reset(seed=-1), "seed")
    refused(lambda: TaskEnv("Task"), "task")
    refused(lambda: TaskEnv("Nothing"), "task")
    refused(lambda: TaskEnv(3), "task")
    refused(lambda: TaskEnv(task, config=tasks.Balance.Config()), "config")
