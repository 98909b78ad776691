"""Episodes of tasks, as devlearn.tasks.run lives through them."""

import threading

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import Learner, LearnerConfig, Outcome, RandomAgent, agents, tasks


def names():
    return sorted(
        name
        for name, task in vars(tasks).items()
        if isinstance(task, type) and issubclass(task, tasks.Task) and task is not tasks.Task
    )


class Told:
    """Motions in turn, of Python; keeps what it is told."""

    def __init__(self, breaks_at=None):
        self.breaks_at, self.chosen, self.calls, self.outcomes = breaks_at, 0, [], []

    def begin_round(self):
        self.calls.append("begin")

    def choose(self, observation):
        if self.chosen == self.breaks_at:
            raise ZeroDivisionError
        self.chosen += 1
        motions = range(observation.motion_count)
        if observation.allowed is not None:
            motions = np.flatnonzero(observation.allowed)
        return int(motions[self.chosen % len(motions)])

    def observe(self, outcome):
        assert isinstance(outcome, Outcome)
        self.outcomes.append(outcome)

    def end_round(self, arrived):
        self.calls.append(arrived)


@pytest.mark.parametrize("name", names())
def test_every_task_in_one_call_equals_the_loop_by_hand(name):
    task = getattr(tasks, name)()
    episodes = tasks.run(task, RandomAgent(seed=4), 3, seed=7, step_limit=400)
    agent, other = RandomAgent(seed=4), getattr(tasks, name)()
    for number, episode in enumerate(episodes):
        other.begin(devlearn.Random(7, f"episode {number}").next() % 2**31)
        total, steps, ended = 0.0, 0, False
        while not ended and steps < 400:
            outcome = other.step(agent.choose(other.observation()).motion)
            agent.observe(outcome)
            total, steps, ended = total + outcome.reward, steps + 1, outcome.arrived
        assert episode.tolist() == (total, steps, ended, ended and other.succeeded)


@pytest.mark.parametrize("name", names())
def test_every_task_refuses_what_it_is_not_asked_in_its_turn(name):
    task = getattr(tasks, name)()
    refused(task.observation, "observation")
    refused(lambda: task.step(0), "step")
    task.begin(seed=1)
    before = task.observation()
    for motion in (-1, task.motion_count):
        refused(lambda motion=motion: task.step(motion), "motion")
    assert task.observation() == before


@pytest.mark.parametrize("name", names())
def test_all_chance_in_every_task_follows_from_the_seed(name):
    def life(seed):
        task, told = getattr(tasks, name)(), Told()
        tasks.run(task, told, 2, seed=seed, step_limit=300)
        return told.outcomes

    assert life(3) == life(3)


def test_an_agent_of_python_lives_in_rounds_and_is_told_how_they_ended():
    told = Told()
    episodes = tasks.run(tasks.Balance(), told, 3)
    assert len(told.outcomes) == episodes["steps"].sum() == told.chosen
    assert told.calls == ["begin", False] * 3
    assert (
        [outcome.arrived for outcome in told.outcomes].count(True) == episodes["ended"].sum() == 3
    )
    assert episodes["reward"].sum() == sum(outcome.reward for outcome in told.outcomes)


def test_the_paper_s_learner_is_shared_with_the_run():
    task = tasks.Balance()
    learner = Learner(LearnerConfig(motion_count=task.motion_count), seed=1)
    steps = tasks.run(task, learner, 5)["steps"].sum()
    assert 0 < learner.explored_count <= steps


def test_what_was_finished_is_kept_where_an_agent_raises():
    task = tasks.Balance()
    whole = tasks.run(task, Told(), 50)
    assert task.interrupted is None
    at = int(whole["steps"][:20].sum()) + 1
    with pytest.raises(ZeroDivisionError):
        tasks.run(task, Told(breaks_at=at), 50)
    assert np.array_equal(task.interrupted, whole[:20])


def test_a_run_is_stopped_and_goes_on_from_the_episode_it_did_not_finish():
    class Stop:
        asked = 0

        def is_set(self):
            self.asked += 1
            return self.asked > 3

    agent, task = agents.QLearning(seed=1), tasks.Foraging()
    told = []
    episodes = tasks.run(
        task, agent, 10**9, step_limit=100, stop=Stop(), progress=lambda *done: told.append(done)
    )
    assert 0 < len(episodes) < 10**9
    assert all(total == 10**9 and 0 <= done <= len(episodes) for done, total in told)
    rest = tasks.run(task, agent, 3, first=len(episodes), step_limit=100)
    assert len(rest) == 3


def test_progress_is_told_at_the_end():
    told = []
    tasks.run(tasks.Balance(), RandomAgent(), 4, progress=lambda *done: told.append(done))
    assert told[-1] == (4, 4)


def test_a_task_under_way_in_another_thread_is_refused():
    stop, task, agent = threading.Event(), tasks.Foraging(), agents.QLearning()
    run = threading.Thread(target=lambda: tasks.run(task, agent, 10**9, stop=stop))
    run.start()
    try:
        while not stop.wait(0.01):
            try:
                task.begin(seed=1)
            except devlearn.InvalidValue as error:
                assert "another thread" in str(error)
                break
        refused(lambda: tasks.run(tasks.Foraging(), agent, 1), "QLearning")
    finally:
        stop.set()
        run.join()
    task.begin(seed=1)


@pytest.mark.parametrize(
    ("bad", "says"),
    [
        ({"episodes": -1}, "episodes"),
        ({"seed": -1}, "seed"),
        ({"first": -1}, "first"),
        ({"first": 2**63 - 1}, "first"),
        ({"step_limit": 0}, "step_limit"),
        ({"step_limit": None}, "run_episodes.step_limit"),
    ],
)
def test_a_run_without_end_or_of_nothing_is_refused_before_it_begins(bad, says):
    told = Told()
    refused(lambda: tasks.run(tasks.Foraging(), told, **{"episodes": 1, **bad}), says)
    assert told.calls == []
