"""Whoever chooses in a trial: the paper's learner, random motions, or an agent in Python."""

import copy
import pathlib
import pickle
import re

import devlearn
import numpy as np
import pytest
from conftest import differences, joined, refused
from devlearn import (
    Choice,
    Development,
    Event,
    InvalidValue,
    Kind,
    Learner,
    LearnerConfig,
    Observation,
    Outcome,
    RandomAgent,
    Trial,
    TrialConfig,
    World,
    agents,
)


class Loop:
    """Motions in turn; keeps what it is told."""

    def __init__(self, answer=lambda n: n % 5):
        self.answer = answer
        self.asked, self.told, self.cancelled = [], [], 0

    def choose(self, observation):
        self.asked.append(observation)
        return self.answer(len(self.asked) - 1)

    def observe(self, outcome):
        self.told.append(outcome)

    def cancel(self):
        self.cancelled += 1


class Paper:
    """The paper's learner, by way of Python."""

    def __init__(self, config, seed):
        self.learner = Learner(config, seed)

    def choose(self, observation):
        return self.learner.choose(observation.situation)

    def observe(self, outcome):
        return self.learner.learn(outcome.smf)


# --- the paper's learner -------------------------------------------------------------------------


def test_a_learner_given_is_shared_and_goes_on(paper):
    learner = Learner(seed=3)
    first = Trial(paper, agent=learner)
    record = first.free_learning(400)
    assert first.learner is first.agent is learner
    assert learner.explored_count == record.explored_count[-1] > 0
    second = Trial(paper, seed=99, agent=learner)
    assert second.free_learning(10).explored_count[0] >= record.explored_count[-1]


def test_the_history_depends_on_the_learners_seed_alone(paper):
    own = Trial(paper, seed=3).free_learning(1000)
    given = Trial(paper, seed=99, agent=Learner(seed=3)).free_learning(1000)
    assert differences(own, given) == []


def test_a_copied_learner_goes_on_alike_and_apart(paper):
    trial = Trial(paper, seed=3)
    trial.free_learning(500)
    copied = trial.learner.copy()
    explored = trial.learner.explored_count
    twin = Trial(paper, agent=copied).free_learning(500)
    assert trial.learner.explored_count == explored
    assert (
        differences(trial.free_learning(500), twin, ["motion", "sef", "x", "explored_count"]) == []
    )


def test_a_learner_with_other_motions_is_refused(paper):
    four = Learner(LearnerConfig(motion_count=4))
    refused(lambda: Trial(paper, agent=four), "Trial.agent.config.motion_count", "4")


def test_other_motions_need_no_more_than_a_configuration(paper):
    config = TrialConfig(
        learner=LearnerConfig(motion_count=3),
        robot=devlearn.RobotDef(steering_angles=[-45, 0, 45]),
        heading_bins=8,
    )
    record = Trial(paper, config, seed=1).free_learning(500)
    assert set(record.motion.tolist()) == {0, 1, 2}
    assert set((record.heading % 45).tolist()) == {0}


def test_a_learner_that_waits_for_its_outcome_is_refused_and_can_be_freed(paper):
    learner = Learner(seed=1)
    learner.choose(7)
    trial = Trial(paper, agent=learner)
    refused(trial.step, "Learner.choose")
    assert (trial.pose, trial.round) == (paper.start, 0)
    learner.cancel()
    assert trial.step().kind == Kind.EXPLORE
    assert learner.pending is None


def test_a_learner_of_another_kind_in_python_is_heard(paper):
    class Stubborn(Learner):
        def choose(self, observation):
            return 4

        def observe(self, outcome):
            pass

    assert set(Trial(paper, agent=Stubborn()).run(50).motion.tolist()) == {4}


# --- random motions ------------------------------------------------------------------------------


def test_random_motions_are_seeded_and_learn_nothing(paper):
    first, second, third = (
        Trial(paper, agent=RandomAgent(seed)).free_learning(2000) for seed in (1, 1, 2)
    )
    assert differences(first, second) == []
    assert "motion" in differences(first, third)
    assert set(np.unique(first.motion)) == set(range(5))
    assert not first.explored_count.any()
    assert (first.kind == Kind.UNSTATED).all()
    assert first.provenance["agent"] == "devlearn._core.RandomAgent"


# --- agents in Python ----------------------------------------------------------------------------


def test_the_learner_by_way_of_python_gives_the_same_history(paper):
    config = TrialConfig.step5()
    own = Trial(paper, config, seed=6).free_learning(1500)
    by_python = Trial(paper, config, agent=Paper(config.learner, 6)).free_learning(1500)
    assert differences(own, by_python) == []


def test_an_agent_is_told_what_the_record_says(paper):
    agent = Loop()
    trial = Trial(paper, agent=agent)
    record = trial.free_learning(300)
    assert trial.agent is agent
    assert trial.learner is None
    assert (record.motion == np.arange(300) % 5).all()
    assert (record.kind == Kind.UNSTATED).all()
    assert [o.situation for o in agent.asked] == record.situation.tolist()
    assert [o.pose for o in agent.asked] == [tuple(p) for p in record.path()[:-1]]
    assert [o.sef for o in agent.asked[1:]] == record.sef[:-1].tolist()
    assert [o.goal_distance for o in agent.asked[1:]] == record.goal_distance[:-1].tolist()
    assert [o.clearance for o in agent.asked[1:]] == record.clearance[:-1].tolist()
    assert {o.motion_count for o in agent.asked} == {5}
    assert [o.situation for o in agent.told[:-1]] == record.situation[1:].tolist()
    assert [o.sef for o in agent.told] == record.sef.tolist()
    assert [o.smf for o in agent.told] == record.smf_used.tolist()
    assert [o.collided for o in agent.told] == record.collided.tolist()
    assert [o.arrived for o in agent.told] == record.arrived.tolist()
    assert agent.cancelled == 0


@pytest.mark.parametrize(
    ("answer", "kind"),
    [
        (3, Kind.UNSTATED),
        (np.int64(3), Kind.UNSTATED),
        (np.uint8(3), Kind.UNSTATED),
        (Choice(3), Kind.UNSTATED),
        (Choice(3, Kind.EXPLOIT), Kind.EXPLOIT),
        (Choice(motion=3, kind=Kind.EXPLORE), Kind.EXPLORE),
    ],
)
def test_an_agent_answers_with_an_index_or_a_choice(paper, answer, kind):
    step = Trial(paper, agent=Loop(lambda n: answer)).step()
    assert (step.motion, step.kind) == (3, kind)


@pytest.mark.parametrize(
    ("answer", "value"),
    [
        (5, "5"),
        (-1, "-1"),
        (2**31, str(2**31)),
        (10**30, str(10**30)),
        (Choice(5), "5"),
        (Choice(-7), "-7"),
        (Choice(2**31), str(2**31)),
        (Choice(2.5), "2.5"),
        (Choice(2, 1), "Choice(motion=2, kind=1)"),
        ((2, Kind.EXPLORE), "(2, <Kind.EXPLORE: 0>)"),
        (2.0, "2.0"),
        (None, "None"),
        ("2", "'2'"),
        (float("nan"), "nan"),
        ([1], "[1]"),
        (np.array([1, 2]), "[1 2]"),
        (np.array(2.7), "2.7"),
        (Choice(np.array(2.0)), "2.0"),
        (Choice(np.float32(2.5)), "2.5"),
        pytest.param(10**5000, "a value of <class 'int'>", id="huge"),
        ("x" * 200, "'" + "x" * 159 + "..."),
    ],
)
def test_any_other_answer_is_refused_and_the_trial_left_as_it_was(paper, answer, value):
    agent = Loop(lambda n: 2 if n < 3 else answer)
    trial = Trial(paper, agent=agent)
    error = refused(lambda: trial.free_learning(10), value=value)
    assert "motion" in error.quantity or "choice" in error.quantity
    assert len(trial.interrupted) == len(agent.told) == 3
    assert trial.pose == tuple(trial.interrupted.path()[-1])


@pytest.mark.parametrize(
    "development",
    [
        Development(0, 0, 77, 0),
        Development(0, 0, None, 0),
        Development(0, 0, Event.NOTHING, 0.5),
        Development(0, 0, Event.NOTHING, -1),
        Development(0, 0, Event.NOTHING, 2**31),
        Development(0, 0, Event.NOTHING, 0, -1),
        Development(0, 0, Event.NOTHING, 0, 0, -1),
    ],
)
def test_a_development_that_no_record_holds_is_refused(paper, development):
    agent = Loop()
    agent.observe = lambda outcome: development
    trial = Trial(paper, agent=agent)
    error = refused(trial.step)
    assert error.quantity.startswith("agent's development")
    assert (trial.pose, trial.round) == (paper.start, 0)


def test_an_agent_hears_that_its_motion_was_refused(paper):
    agent = Loop(lambda n: 5)
    trial = Trial(paper, agent=agent)
    refused(trial.step, "agent's motion", "5")
    assert agent.cancelled == 1
    refused(trial.step)
    assert agent.cancelled == 2


class Unlucky(Loop):
    """Raises once, in one of its methods, at some step."""

    def __init__(self, method, error, at=7):
        super().__init__()
        self.method, self.error, self.at = method, error, at

    def fail(self, method):
        if method == self.method and len(self.told) == self.at and self.error is not None:
            error, self.error = self.error, None
            raise error

    def choose(self, observation):
        self.fail("choose")
        return super().choose(observation)

    def observe(self, outcome):
        self.fail("observe")
        super().observe(outcome)


class Surprise(BaseException):
    pass


@pytest.mark.parametrize("method", ["choose", "observe"])
@pytest.mark.parametrize(
    "error", [RuntimeError("no"), KeyboardInterrupt(), Surprise(1), SystemExit]
)
def test_what_an_agent_raises_comes_through_and_what_was_finished_is_kept(paper, method, error):
    agent = Unlucky(method, error)
    trial = Trial(paper, agent=agent)
    kind = error if isinstance(error, type) else type(error)
    with pytest.raises(kind) as caught:
        trial.free_learning(100, echoes=True)
    if not isinstance(error, type):
        assert caught.value is error
    record = trial.interrupted
    assert len(record) == 7
    assert record.echoes.shape == (7, 5)
    assert record.path().shape == (8, 3)
    assert trial.pose == tuple(record.path()[-1])
    assert trial.round == 1
    assert trial.run(5).path()[0].tolist() == list(trial.pose) or len(agent.told) == 12


def test_an_agent_that_raises_in_a_step_leaves_the_trial_as_it_was(paper):
    trial = Trial(paper, agent=Unlucky("observe", ZeroDivisionError(), at=0))
    with pytest.raises(ZeroDivisionError):
        trial.step()
    assert (trial.pose, trial.round, trial.arrived) == (paper.start, 0, False)
    assert trial.step().round == 1


@pytest.mark.parametrize(
    "call",
    [
        lambda trial: trial.step(),
        lambda trial: trial.run(1),
        lambda trial: trial.free_learning(1),
        lambda trial: trial.path_learning(1),
        lambda trial: trial.begin_round(),
        lambda trial: trial.place(2, 1.5, 0),
    ],
)
@pytest.mark.parametrize("method", ["choose", "observe"])
def test_an_agent_that_moves_its_own_trial_is_refused(paper, call, method):
    agent = Loop()
    trial = Trial(paper, agent=agent)

    def back(self_argument):
        call(trial)

    setattr(agent, method, back)
    refused(trial.step, "Trial")
    refused(lambda: trial.run(5), "Trial")
    assert trial.pose == paper.start


def test_an_agent_may_look_at_its_trial(paper):
    agent = Loop(lambda n: int(trial.grid.situation(*trial.pose)) % 5)
    trial = Trial(paper, agent=agent)
    record = trial.free_learning(50)
    assert (record.motion == record.situation % 5).all()


@pytest.mark.parametrize("agent", [3, "x", object(), [], lambda o: 1, {"choose": 1}])
def test_what_is_no_agent_is_refused(paper, agent):
    refused(lambda: Trial(paper, agent=agent), "agent")


def test_provenance_names_the_agent(paper):
    assert Trial(paper, agent=Loop()).run(1).provenance["agent"] == f"{__name__}.Loop"
    assert Trial(paper).run(1).provenance["agent"] == "devlearn._core.Learner"


# --- rounds --------------------------------------------------------------------------------------


class Diary(Loop):
    """Drives straight on and keeps a letter of each call: begun, step, True or False at the end."""

    def __init__(self):
        super().__init__(lambda n: 2)
        self.text = ""

    def begin_round(self):
        self.text += "b"

    def observe(self, outcome):
        self.text += "s"

    def end_round(self, arrived):
        assert isinstance(arrived, bool)
        self.text += "T" if arrived else "F"


def test_an_agent_is_told_where_rounds_begin_and_end():
    diary = Diary()
    trial = Trial(World(start=(1, 1, 0), target=(1.475, 1)), agent=diary)
    assert not trial.round_open
    trial.step()
    trial.run(2)
    assert trial.round_open
    trial.free_learning(10)
    trial.path_learning(2)
    assert not trial.round_open
    trial.path_learning(2, step_limit=3)
    trial.finish_round(9)
    trial.place(3, 3, 90)
    assert diary.text == "bsssFb" + 10 * "s" + "F" + 2 * ("b" + 8 * "s" + "T") + (
        "bsssFbsss" + 5 * "s" + "Tb"
    )


@pytest.mark.parametrize("method", ["begin_round", "end_round"])
def test_an_agent_that_raises_where_a_round_begins_or_ends_leaves_the_trial_as_it_was(
    paper, method
):
    agent = Diary()
    trial = Trial(paper, agent=agent)
    trial.run(3)
    before = (trial.pose, trial.round)
    setattr(agent, method, lambda *_: 1 / 0)
    for call in (trial.begin_round, lambda: trial.free_learning(5), lambda: trial.path_learning(1)):
        with pytest.raises(ZeroDivisionError):
            call()
        assert (trial.pose, trial.round) == before
    delattr(agent, method)
    trial.begin_round()
    assert agent.text == "bsssFb"


def test_what_an_agent_is_told_shows_itself(paper):
    agent = Loop()
    Trial(paper, agent=agent).step()
    (asked,), (told,) = agent.asked, agent.told
    assert asked.estimate == asked.goal_distance / (0.1 * 0.5)
    assert (told.cost, told.reward) == (1, -1)
    assert repr(asked).startswith(
        "<devlearn.Observation: situation 504, pose (0.51, 0.515, 0), sef"
    )
    assert f"estimate {asked.estimate:.4g}, motion_count 5>" in repr(asked)
    assert repr(told).startswith(f"<devlearn.Outcome: situation {told.situation}, sef")
    assert "cost 1, reward -1, event -1>" in repr(told)


def test_a_trial_tells_of_arrivals_and_touches_as_salient_events(paper):
    random = devlearn.Random(2, "motions")
    agent = Loop(lambda n: random.index(5))
    Trial(paper, agent=agent).path_learning(2)
    told = {(outcome.arrived, outcome.collided, outcome.event) for outcome in agent.told}
    assert {(arrived, event) for arrived, _, event in told if arrived} == {(True, 0)}
    assert {told for told in told if not told[0]} == {(False, True, 1), (False, False, -1)}


def test_what_is_sensed_as_numbers_is_the_observation_s_own_and_kept_with_it():
    sensed = np.array([0.5, -2.0])
    seen = Observation(3, 5, senses=sensed)
    sensed[0] = seen.senses[1] = 7.0
    assert seen.senses.tolist() == [0.5, -2.0]
    assert pickle.loads(pickle.dumps(seen)) == seen != Observation(3, 5, senses=[0.5])
    assert Observation(3, 5).senses is None


def test_senses_and_events_out_of_range_are_refused():
    with pytest.raises(devlearn.InvalidValue, match=r"senses.*nan.*finite"):
        Observation(3, 5, senses=[0.0, float("nan")])
    for event in (-2, 64):
        with pytest.raises(devlearn.InvalidValue, match=rf"event.*{event}.*\[-1, 63\]"):
            Outcome(3, event=event)


# --- saved ---------------------------------------------------------------------------------------


class QLearner:
    """Tabular Q-learning in a few lines."""

    def __init__(self, seed, epsilon=0.1):
        self.random = devlearn.Random(seed, "q")
        self.epsilon, self.rounds, self.last, self.greedy = epsilon, 0, -1, True
        self.values = np.zeros((4800, 5))

    def begin_round(self):
        self.rounds += 1

    def choose(self, observation):
        self.last = observation.situation
        self.greedy = self.random.uniform() >= self.epsilon
        values = self.values[self.last]
        self.motion = int(values.argmax()) if self.greedy else self.random.index(5)
        return self.motion

    def observe(self, outcome):
        after = 0.0 if outcome.arrived else self.values[outcome.situation].max()
        error = outcome.reward - 5 * outcome.collided + after - self.values[self.last, self.motion]
        self.values[self.last, self.motion] += 0.5 * error

    def end_round(self, arrived):
        self.epsilon *= 0.9 if arrived else 1.0

    def state(self):
        return {
            "random": self.random.state,
            "values": self.values,
            "epsilon": self.epsilon,
            "rounds": self.rounds,
            "greedy": self.greedy,
            "name": "café",
        }

    @classmethod
    def from_state(cls, state):
        assert state["name"] == "café"
        assert [type(state[n]) for n in ("epsilon", "rounds", "greedy")] == [float, int, bool]
        agent = cls(0, state["epsilon"])
        agent.random = devlearn.Random.from_state(state["random"])
        agent.values, agent.rounds = state["values"], state["rounds"]
        return agent


def lived(world):
    trial = Trial(world, agent=QLearner(3))
    trial.free_learning(1500)
    trial.path_learning(2, step_limit=700)
    trial.run(137)
    return trial


def future(trial):
    return joined([trial.run(400), trial.path_learning(3, step_limit=500), trial.free_learning(99)])


@pytest.mark.parametrize("through", ["file", "bytes", "pickle", "copy"])
def test_a_trial_with_an_agent_in_python_goes_on_equal_to_the_bit(paper, tmp_path, through):
    trial = lived(paper)
    if through == "file":
        trial.save(tmp_path / "trial")
        again = Trial.load(tmp_path / "trial", agent=QLearner)
    else:
        again = {
            "bytes": lambda: Trial.from_bytes(trial.to_bytes(), agent=QLearner),
            "pickle": lambda: pickle.loads(pickle.dumps(trial)),
            "copy": lambda: copy.copy(trial),
        }[through]()
    assert again.agent is not trial.agent
    assert again.round_open
    assert again.to_bytes() == trial.to_bytes()
    assert differences(future(again), future(trial)) == []
    assert (again.agent.rounds, again.agent.epsilon) == (trial.agent.rounds, trial.agent.epsilon)
    assert again.to_bytes() == trial.to_bytes()


def test_a_path_learning_interrupted_anywhere_is_finished_after_loading_as_if_it_never_was():
    world = World(2, 2, (0.5, 0.5, 0), (0.9, 0.7))
    config = TrialConfig(goal_radius=0.2)
    unbroken = Trial(world, config, agent=QLearner(1))
    whole = unbroken.path_learning(4, step_limit=300)
    assert whole.rounds["arrived"].any()
    stops = {1, 2, len(whole) // 3, *np.cumsum(whole.rounds["steps"])[:-1].tolist()}

    class Stopped(QLearner):
        def choose(self, observation):
            if self.stop == 0:
                raise KeyboardInterrupt
            self.stop -= 1
            return super().choose(observation)

    Stopped.__qualname__ = "QLearner"
    for stop in stops:
        agent = Stopped(1)
        agent.stop = stop
        trial = Trial(world, config, agent=agent)
        with pytest.raises(KeyboardInterrupt):
            trial.path_learning(4, step_limit=300)
        records = [trial.interrupted]
        trial = Trial.from_bytes(trial.to_bytes(), agent=QLearner)
        rounds = records[0].rounds
        left = 300 - int(rounds["steps"][-1])
        records += [
            trial.finish_round(left),
            trial.path_learning(4 - len(rounds), step_limit=300),
        ]
        record = devlearn.Record.concatenate(records)
        assert differences(record, whole) == [], stop
        assert trial.agent.rounds == unbroken.agent.rounds == 4
        assert trial.to_bytes().count(b"QLearner") == 1


def test_the_file_names_the_class_and_nothing_is_imported_by_it(paper, tmp_path):
    path = tmp_path / "trial"
    trial = Trial(paper, agent=QLearner(1))
    trial.save(path)
    assert f'"agent":"{__name__}:QLearner"'.encode() in path.read_bytes()
    with pytest.raises(devlearn.FileError, match=f"agent: got {__name__}:QLearner; expected learn"):
        Trial.load(path)

    class Other(QLearner):
        pass

    with pytest.raises(devlearn.FileError, match="agent: got .*:QLearner; expected one of .*Other"):
        Trial.load(path, agent=Other)
    Trial(paper).save(path)
    with pytest.raises(devlearn.FileError, match="agent: got learner; expected one of QLearner"):
        Trial.load(path, agent=QLearner)
    learner = type("learner", (QLearner,), {})
    with pytest.raises(devlearn.FileError, match="agent: got learner; expected one of learner"):
        Trial.load(path, agent=learner)
    refused(lambda: Trial.load(path, agent=Loop), "agent")
    refused(lambda: Trial.load(path, agent=7), "agent")
    agent = QLearner(2)
    assert Trial.load(path, agent=agent).agent is agent


@pytest.mark.parametrize(
    ("state", "quantity"),
    [
        (None, "agent.state()"),
        ([], "agent.state()"),
        ({1: np.zeros(3)}, "agent.state()"),
        ({"q": None}, "agent.state()['q']"),
        ({"q": [1.0, 2.0]}, "agent.state()['q']"),
        ({"q": [0] * 10**5}, "agent.state()['q']"),
        ({"q": np.zeros(3, np.float32)}, "agent.state()['q']"),
        ({"q": np.zeros(3, np.int16)}, "agent.state()['q']"),
        ({"q": np.zeros(3, complex)}, "agent.state()['q']"),
        ({"q": np.array(["a"])}, "agent.state()['q']"),
        ({"q": np.array([None])}, "agent.state()['q']"),
        ({"q": 2**64}, "agent.state()['q']"),
        ({"q": b"bytes"}, "agent.state()['q']"),
        pytest.param({"q": 10**5000}, "agent.state()['q']", id="huge"),
        ({"q": np.ma.array([1.0, 2.0], mask=[False, True])}, "agent.state()['q']"),
        ({"q": "\ud800"}, "agent.state()['q']"),
        ({"\ud800": 1.0}, "agent.state()"),
    ],
)
def test_a_state_that_no_file_holds_is_refused_by_its_key(paper, tmp_path, state, quantity):
    class Odd(QLearner):
        def state(self):
            return state

    trial = Trial(paper, agent=Odd(1))
    error = refused(lambda: trial.save(tmp_path / "trial"), quantity)
    assert len(error.value) < 300
    assert not (tmp_path / "trial").exists()


@pytest.mark.parametrize(
    "value",
    [
        *(np.arange(6).reshape(2, 3).astype(t) for t in ("f8", "i8", "u8", "i4", "u4", "u2", "u1")),
        np.array([[True], [False]]),
        np.zeros((0, 3)),
        np.arange(12.0).reshape(3, 4).T[::2],
        np.array([-0.0, np.nan, np.inf, 5e-324], ">f8"),
        0.1,
        -(2**63),
        2**64 - 1,
        True,
        np.float64(0.3),
        "caf\u00e9 \U0001f600\n",
        "",
    ],
)
def test_a_state_comes_back_to_the_bit(paper, value):
    class Keeping(QLearner):
        def __init__(self, kept):
            self.kept = kept

        def state(self):
            return {"kept": self.kept}

        @classmethod
        def from_state(cls, state):
            return cls(state["kept"])

    trial = Trial(paper, agent=Keeping(value))
    kept = Trial.from_bytes(trial.to_bytes(), agent=Keeping).agent.kept
    if isinstance(value, np.ndarray):
        expected = value.astype(value.dtype.newbyteorder("="), order="C")
        assert (kept.dtype, kept.shape) == (expected.dtype, expected.shape)
        assert kept.tobytes() == expected.tobytes()
        assert kept.flags.writeable
    else:
        assert (type(kept), kept) == (type(np.asarray(value).item()), value)


def test_what_from_state_raises_comes_through(paper):
    class Picky(QLearner):
        @classmethod
        def from_state(cls, state):
            return state["q"]

    trial = Trial(paper, agent=Picky(1))
    with pytest.raises(KeyError, match="'q'"):
        Trial.from_bytes(trial.to_bytes(), agent=Picky)
    Picky.from_state = lambda state: 7
    with pytest.raises(devlearn.FileError, match="agent: got 7"):
        Trial.from_bytes(trial.to_bytes(), agent=Picky)


def test_a_generator_goes_on_from_its_state():
    random = devlearn.Random(7, "mine")
    random.next()
    again = devlearn.Random.from_state(random.state)
    assert random.state.dtype == np.uint64
    pickled = pickle.loads(pickle.dumps(random))
    expected = [random.next() for _ in range(9)]
    assert [again.next() for _ in range(9)] == expected
    assert [pickled.next() for _ in range(9)] == expected
    refused(lambda: devlearn.Random.from_state(np.zeros(4, np.uint64)), "state", "all zeros")
    refused(lambda: devlearn.Random.from_state(np.ones(4)), "state")
    refused(lambda: devlearn.Random.from_state(np.ones(5, np.uint64)), "state")


def test_the_guides_code_runs_and_its_agent_is_saved_as_it_stands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    guide = (pathlib.Path(__file__).parents[2] / "docs" / "agents.md").read_text(encoding="utf-8")
    agent, textbook, by_hand, conditioning, long_run = re.findall(
        r"```python\n(.*?)```", guide, re.DOTALL
    )
    names = {}
    exec(long_run, names)
    assert 0 < names["records"][0].rounds["steps"][0] < 10**9
    exec(agent, names)
    trial, again = names["trial"], names["again"]
    assert (again.agent.values == trial.agent.values).all()
    assert differences(again.run(200), trial.run(200)) == []
    exec(textbook, names)
    assert names["agent"].value(int(names["paths"].situation[0]), 2) < 0.0
    exec(conditioning, names)
    assert names["agent"].mean_entropy() < np.log2(5)
    exec(by_hand, names)
    assert names["agent"].value(19, 1) == pytest.approx(-1.0)


# --- motions that are not allowed ---


def cautious(margin, agent=None):
    robot = devlearn.RobotDef(safety_margin=margin)
    return Trial(World.load("clutter"), TrialConfig(robot=robot), seed=5, agent=agent)


@pytest.mark.parametrize("agent", [None, RandomAgent(5)], ids=["learner", "random"])
def test_a_safety_margin_is_kept_wherever_a_motion_can_keep_it(agent):
    trial = cautious(0.02, copy.copy(agent))
    robot = devlearn.Robot(trial.world, trial.config.robot)
    collisions = refused_somewhere = 0
    for _ in range(3000):
        allowed = robot.allowed(trial.pose)
        step = trial.step()
        assert allowed[step.motion]
        if not allowed.all():
            refused_somewhere += 1
            assert not step.collided
            assert trial.world.clearance(*trial.pose[:2], walls_count=True) > 0.1 + 0.02
        collisions += step.collided
    assert refused_somewhere > 100
    # The same robot without such a layer bumps into things often.
    free = Trial(trial.world, seed=5, agent=copy.copy(agent)).run(3000)
    assert 5 * collisions < free.collided.sum()


def test_where_no_motion_keeps_the_margin_every_one_is_allowed():
    world = World(width=1, height=1, start=(0.5, 0.5, 0), target=(0.2, 0.2))
    robot = devlearn.Robot(world, devlearn.RobotDef(safety_margin=0.5))
    assert robot.allowed((0.5, 0.5, 0)).all()
    assert devlearn.Robot(world).allowed((0.15, 0.5, 180)).all()
    with pytest.raises(devlearn.InvalidValue, match="pose"):
        robot.allowed((float("nan"), 0.5, 0))


def test_a_robot_that_says_what_it_can_do_has_one_history_in_steps_calls_and_when_resumed():
    whole, resumed, stepped = cautious(0.05), cautious(0.05), cautious(0.05)
    motions = list(whole.run(400).motion)
    first = list(resumed.run(150).motion)
    resumed = Trial.from_bytes(resumed.to_bytes())
    assert resumed.config.robot.safety_margin == 0.05
    assert first + list(resumed.run(250).motion) == motions
    assert [stepped.step().motion for _ in range(400)] == motions
    assert whole.to_bytes() == resumed.to_bytes() == stepped.to_bytes()


def test_an_agent_sees_what_is_allowed_and_is_refused_what_is_not():
    seen = []

    class Last:
        def choose(self, observation):
            seen.append(observation)
            return 2

        def observe(self, outcome):
            pass

    robot = devlearn.RobotDef(safety_margin=0.05)
    world = World(width=2, height=2, start=(1, 1, 180), target=(0.2, 0.2))
    trial = Trial(world, TrialConfig(robot=robot), agent=Last())
    with pytest.raises(devlearn.InvalidValue, match="agent's motion: got 2; expected one that"):
        trial.run(1000)
    pose = trial.pose
    del trial
    assert seen[0].allowed is None
    assert seen[-1].allowed.dtype == bool
    assert not seen[-1].allowed[2]
    assert list(seen[-1].allowed) == list(devlearn.Robot(world, robot).allowed(pose))


@pytest.mark.parametrize("base", [Learner, RandomAgent, agents.QLearning, agents.RMax])
def test_a_learner_whose_choice_is_redefined_is_refused_as_it_would_not_be_asked(base):
    class Own(base):
        def choose(self, *_):
            return 1

    world = World.load("empty")
    with pytest.raises(InvalidValue, match=r"agent: got .*; expected one whose choose is not"):
        Trial(world, agent=Own())

    class Named(base):
        """Adds nothing."""

    assert len(Trial(world, agent=Named()).free_learning(10)) == 10
