"""Snapshots as Python and other people's tools see them; their laws are stated in C++."""

import copy
import pickle
from pathlib import Path

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import agents
from devlearn.record import POSE_COLUMNS, STEP_COLUMNS
from safetensors import safe_open
from safetensors.numpy import load_file


@pytest.fixture(scope="module")
def learner():
    trial = devlearn.Trial(devlearn.World.load("paper"), seed=5)
    trial.free_learning(5000)
    return trial.learner


def future(learner):
    """What a trial goes on to do with it."""
    trial = devlearn.Trial(devlearn.World.load("paper"), agent=learner)
    record = trial.free_learning(3000)
    return [record.situation.tobytes(), record.motion.tobytes(), record.smf.tobytes()]


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
@pytest.mark.parametrize(
    "make",
    [
        lambda trial: trial,
        lambda trial: trial.learner,
        lambda trial: trial.learner.explain(0),
        lambda trial: devlearn.AdaptiveLearner(seed=1),
        lambda trial: agents.QLearning(seed=1),
        lambda trial: devlearn.Random(1, "agent"),
        lambda trial: trial.config,
    ],
)
def test_what_can_be_pickled_can_by_every_protocol(make, protocol):
    made = make(devlearn.Trial(devlearn.World.load("paper"), seed=5))
    again = pickle.loads(pickle.dumps(made, protocol))
    assert type(again) is type(made)
    assert pickle.dumps(again) == pickle.dumps(made)


@pytest.mark.parametrize("through", ["file", "bytes", "pickle", "deepcopy"])
def test_a_learner_goes_on_equal_to_the_bit(learner, tmp_path, through):
    if through == "file":
        learner.save(tmp_path / "learner.safetensors")
        again = devlearn.Learner.load(tmp_path / "learner.safetensors")
    elif through == "bytes":
        again = devlearn.Learner.from_bytes(learner.to_bytes())
    elif through == "pickle":
        again = pickle.loads(pickle.dumps(learner))
    else:
        again = copy.deepcopy(learner)
    assert again.to_bytes() == learner.to_bytes()
    assert future(again) == future(learner.copy())


def test_other_tools_read_it(learner, tmp_path):
    path = tmp_path / "learner.safetensors"
    learner.save(path)
    arrays = load_file(path)
    assert np.array_equal(arrays["situation"], learner.situations())
    assert arrays["effective_count"].sum() == learner.effective_count == len(arrays["orientation"])
    first = 0
    for i, situation in enumerate(learner.situations()[:50]):
        lists = learner.situation(situation)
        assert arrays["motions"][i].tolist() == [
            *lists.effective,
            *lists.ineffective,
            *lists.unexplored,
        ]
        last = first + len(lists.effective)
        assert arrays["orientation"][first:last].tolist() == lists.orientation
        assert arrays["times_learned"][first:last].tolist() == lists.times_learned
        first = last
    with safe_open(path, "np") as file:
        metadata = file.metadata()
    assert metadata["format"] == "devlearn-learner"
    assert float(metadata["sigma"]) == learner.config.sigma


def test_its_size_is_close_to_that_of_its_data(learner):
    situations, effective = learner.situations_experienced, learner.effective_count
    data = situations * (8 + 2 + 2 + 2 * 5) + effective * (8 + 4) + 32
    assert data <= len(learner.to_bytes()) <= data + 2000


def test_a_damaged_file_is_refused_by_name(learner, tmp_path):
    path = tmp_path / "learner.safetensors"
    content = bytearray(learner.to_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(devlearn.FileError, match="damaged") as refusal:
        devlearn.Learner.load(path)
    assert refusal.value.file == str(path)
    assert refusal.value.field == "checksum"
    with pytest.raises(devlearn.FileError):
        devlearn.Learner.load(tmp_path / "nothing")


# --- a learner's memory as arrays -----------------------------------------------------------------


def test_a_memory_is_what_the_situations_hold(learner):
    memory = learner.memory()
    assert isinstance(memory, devlearn.LearnerMemory)
    count, motions = learner.situations_experienced, learner.config.motion_count
    effective = learner.effective_count
    shapes = [(count,), (count,), (count,), (count, motions), (effective,), (effective,)]
    assert [array.shape for array in memory] == shapes
    types = ["int64", "uint16", "uint16", "uint16", "float64", "uint32"]
    assert [str(array.dtype) for array in memory] == types
    ends = np.cumsum(memory.effective_count)
    for i in range(0, count, 17):
        lists = learner.situation(memory.situation[i])
        n, m = memory.effective_count[i], memory.ineffective_count[i]
        assert memory.motions[i, :n].tolist() == lists.effective
        assert memory.motions[i, n : n + m].tolist() == lists.ineffective
        assert memory.motions[i, n + m :].tolist() == lists.unexplored
        assert memory.orientation[ends[i] - n : ends[i]].tolist() == lists.orientation
        assert memory.times_learned[ends[i] - n : ends[i]].tolist() == lists.times_learned


def test_a_learner_made_of_a_memory_remembers_the_same_and_draws_anew(learner):
    again = devlearn.Learner.from_memory(learner.memory(), learner.config, seed=8)
    assert all(np.array_equal(a, b) for a, b in zip(again.memory(), learner.memory()))
    assert again.explored_count == learner.explored_count
    assert again.effective_count == learner.effective_count
    assert (again.seed, again.config) == (8, learner.config)
    assert future(again.copy()) != future(learner.copy())
    assert future(again.copy()) == future(
        devlearn.Learner.from_memory(learner.memory(), learner.config, seed=8)
    )


def test_the_arrays_are_copies_both_ways(learner):
    mine = learner.copy()
    memory = mine.memory()
    before = mine.to_bytes()
    memory.orientation[:] = 7.0
    memory.motions[:] = 0
    assert mine.to_bytes() == before
    memory = mine.memory()
    again = devlearn.Learner.from_memory(memory)
    whole = again.to_bytes()
    for array in memory:
        array[:] = 0
    assert again.to_bytes() == whole


@pytest.mark.parametrize(
    ("field", "harm", "quantity"),
    [
        ("situation", lambda a: a.__setitem__(1, a[0]), "memory.situation[1]"),
        ("situation", lambda a: a.__setitem__(2, -1), "memory.situation[2]"),
        ("motions", lambda a: a.__setitem__((0, 0), a[0, 1]), "memory.motions[0]"),
        ("orientation", lambda a: a.__setitem__(0, np.nan), "memory.orientation[0]"),
        ("orientation", lambda a: a.__setitem__(0, a[0] / 2), "memory.orientation[0]"),
        ("times_learned", lambda a: a.__setitem__(3, 0), "memory.times_learned[3]"),
        ("ineffective_count", lambda a: a.__setitem__(0, 9), "memory.ineffective_count[0]"),
        ("situation", lambda a: a[:-1], "memory.effective_count"),
        ("orientation", lambda a: a[:-1], "memory.orientation"),
        ("motions", lambda a: a[:, :-1], "memory.motions"),
        ("motions", lambda a: a.ravel(), "memory.motions"),
        ("motions", lambda a: a.astype(np.int64), "memory.motions"),
        ("times_learned", lambda a: a.tolist(), "memory.times_learned"),
    ],
)
def test_a_memory_that_breaks_a_law_is_refused_by_name(learner, field, harm, quantity):
    memory = learner.memory()
    harmed = harm(getattr(memory, field))
    if harmed is not None:
        memory = memory._replace(**{field: harmed})
    refused(lambda: devlearn.Learner.from_memory(memory, learner.config), quantity)


# --- trials ---------------------------------------------------------------------------------------


@pytest.fixture
def trial(paper):
    trial = devlearn.Trial(paper, seed=6)
    trial.free_learning(1500)
    trial.run(137)
    return trial


def history(trial):
    """What a trial goes on to do."""
    return devlearn.Record.concatenate(
        [trial.run(400), trial.free_learning(500), trial.path_learning(2, 300)]
    )


@pytest.mark.parametrize("through", ["file", "bytes", "pickle", "copy", "deepcopy"])
def test_a_trial_goes_on_equal_to_the_bit(trial, tmp_path, through):
    if through == "file":
        trial.save(tmp_path / "trial")
        again = devlearn.Trial.load(tmp_path / "trial")
    else:
        again = {
            "bytes": lambda: devlearn.Trial.from_bytes(trial.to_bytes()),
            "pickle": lambda: pickle.loads(pickle.dumps(trial)),
            "copy": lambda: copy.copy(trial),
            "deepcopy": lambda: copy.deepcopy(trial),
        }[through]()
    assert again.to_bytes() == trial.to_bytes()
    assert again.learner is not trial.learner
    assert (again.pose, again.round, again.seed) == (trial.pose, 1, 6)
    assert again.world.hash == trial.world.hash
    assert differences(history(again), history(trial)) == []


def test_a_round_of_path_learning_stopped_in_its_middle_is_finished_after_loading(paper, tmp_path):
    unbroken = devlearn.Trial(paper, seed=4)
    first = unbroken.free_learning(6000, echoes=True)
    whole = devlearn.Record.concatenate([first, unbroken.path_learning(9, 900, echoes=True)])
    assert whole.rounds["arrived"].sum() > 3

    class Stopping:
        """The paper's learner, who stops everything at a certain step."""

        def __init__(self, learner, steps):
            self.learner, self.steps = learner, steps

        def choose(self, observation):
            if self.steps == 0:
                raise KeyboardInterrupt
            return self.learner.choose(observation.situation)

        def observe(self, outcome):
            self.steps -= 1
            return self.learner.learn(outcome.smf)

    for steps in (6001, 6500, 7111):
        agent = Stopping(devlearn.Learner(seed=4), steps)
        trial = devlearn.Trial(paper, seed=4, agent=agent)
        record = trial.free_learning(6000, echoes=True)
        with pytest.raises(KeyboardInterrupt):
            trial.path_learning(9, 900, echoes=True)
        record = devlearn.Record.concatenate([record, trial.interrupted])
        assert len(record) == steps
        trial.save(tmp_path / "trial", record, without_agent=True)

        trial = devlearn.Trial.load(tmp_path / "trial", agent=agent.learner)
        record = devlearn.Record.load(tmp_path / "trial")
        left = 9 - (len(record.rounds) - 1)
        rest = [
            trial.finish_round(900 - int(record.rounds["steps"][-1]), echoes=True),
            trial.path_learning(left, 900, echoes=True),
        ]
        joined = devlearn.Record.concatenate([record, *rest])
        names = [n for n in (*STEP_COLUMNS, *POSE_COLUMNS, "rounds", "echoes")
                 if n not in ("explored_count", "effective_count")]  # fmt: skip
        assert differences(joined, whole, names) == []


def test_a_record_is_read_from_the_trials_file(trial, paper, tmp_path):
    record = trial.run(100, echoes=True)
    trial.save(tmp_path / "trial", record=record)
    again = devlearn.Record.load(tmp_path / "trial")
    assert differences(again, record) == []
    assert again.provenance == record.provenance
    assert devlearn.Trial.load(tmp_path / "trial").to_bytes() == trial.to_bytes()
    assert devlearn.Trial.from_bytes(trial.to_bytes(record)).to_bytes() == trial.to_bytes()
    arrays = load_file(tmp_path / "trial")
    assert np.array_equal(arrays["record.sef"], record.sef)
    assert arrays["record.collided"].dtype == np.bool_
    assert arrays["record.echoes"].shape == record.echoes.shape
    trial.save(tmp_path / "trial")
    with pytest.raises(devlearn.FileError, match="record: got nothing"):
        devlearn.Record.load(tmp_path / "trial")
    trial.learner.save(tmp_path / "learner")
    with pytest.raises(devlearn.FileError, match="format: got devlearn-learner"):
        devlearn.Record.load(tmp_path / "learner")


def test_a_record_saved_by_cpp_has_the_trials_provenance():
    folder = Path(__file__).parents[1] / "golden" / "snapshots"
    record = devlearn.Record.load(folder / "0.1.0_trial.safetensors")
    assert len(record) == 40
    assert record.provenance["agent"] == "learner"
    assert record.provenance["devlearn"] == "0.1.0"
    assert record.world.name == "open"


def test_record_and_trial_that_do_not_fit_are_refused(trial):
    refused(lambda: trial.to_bytes(7), "record", "7")
    record = trial.run(5)
    record.sef = record.sef[:-1]
    refused(lambda: trial.to_bytes(record), "record.sef", "4 values")
    record.sef = record.sef.astype(np.float32)
    refused(lambda: trial.to_bytes(record), "record.sef")


class ToAndFro:
    def __init__(self):
        self.steps = 0

    def choose(self, observation):
        return self.steps % observation.motion_count

    def observe(self, outcome):
        self.steps += 1


def test_an_agent_of_ones_own_is_refused_with_what_to_do_and_given_when_loading(paper, tmp_path):
    trial = devlearn.Trial(paper, agent=ToAndFro())
    trial.run(33)
    path = tmp_path / "trial"
    for saving in (lambda: trial.save(path), trial.to_bytes):
        error = refused(saving, "agent")
        assert "ToAndFro" in error.value
        assert "without_agent=True" in error.allowed
        assert "agent=" in error.allowed
    assert not path.exists()
    trial.save(path, without_agent=True)
    with pytest.raises(devlearn.FileError, match="agent: got none; expected"):
        devlearn.Trial.load(path)
    again = devlearn.Trial.load(path, agent=copy.copy(trial.agent))
    assert differences(again.run(50), trial.run(50)) == []


def test_an_agent_of_ones_own_is_pickled_and_copied_by_its_own_rules(paper):
    trial = devlearn.Trial(paper, agent=ToAndFro())
    trial.run(33)
    for again in (pickle.loads(pickle.dumps(trial)), copy.copy(trial), copy.deepcopy(trial)):
        assert again.agent is not trial.agent
        assert again.agent.steps == 33
        assert differences(again.run(9), copy.deepcopy(trial).run(9)) == []


def test_random_motions_go_on_as_they_would_have(paper):
    trial = devlearn.Trial(paper, agent=devlearn.RandomAgent(3))
    trial.run(50)
    again = devlearn.Trial.from_bytes(trial.to_bytes())
    pickled = pickle.loads(pickle.dumps(trial))
    expected = trial.run(50)
    assert differences(again.run(50), expected) == []
    assert differences(pickled.run(50), expected) == []


def test_what_shares_a_learner_shares_it_after_pickling(trial):
    again, learner = pickle.loads(pickle.dumps((trial, trial.learner)))
    assert again.learner is learner
    again, learner = copy.deepcopy((trial, trial.learner))
    assert again.learner is learner


def test_what_was_interrupted_and_other_attributes_are_copied_with_a_trial(trial):
    trial.interrupted = trial.run(3)
    trial.mine = [1]
    again = pickle.loads(pickle.dumps(trial))
    assert differences(again.interrupted, trial.interrupted) == []
    assert again.mine == [1]
    assert again.mine is not trial.mine


def test_a_trial_is_not_saved_in_the_middle_of_a_step(paper):
    class Saving(ToAndFro):
        def observe(self, outcome):
            trial.to_bytes(without_agent=True)

    trial = devlearn.Trial(paper, agent=Saving())
    refused(trial.step, "Trial", "a snapshot while a call is under way")


def test_a_damaged_trial_is_refused_by_name(trial, tmp_path):
    path = tmp_path / "trial"
    content = bytearray(trial.to_bytes())
    content[-5] ^= 1
    path.write_bytes(content)
    with pytest.raises(devlearn.FileError, match="damaged") as refusal:
        devlearn.Trial.load(path)
    assert refusal.value.file == str(path)
    with pytest.raises(devlearn.FileError):
        devlearn.Record.load(path)
    with pytest.raises(devlearn.FileError, match="No such file"):
        devlearn.Trial.load(tmp_path / "nothing")


# --- records --------------------------------------------------------------------------------------


def test_a_record_is_the_sum_of_its_parts(history):
    parts = [history.part(slice(i, i + 1)) for i in range(len(history.rounds))]
    assert [len(part) for part in parts] == history.rounds["steps"].tolist()
    assert differences(devlearn.Record.concatenate(parts), history) == []
    assert differences(history.part(slice(None)), history) == []
    assert len(history.part(slice(5, 2)).x) == 0
    refused(lambda: history.part(slice(0, 5, 2)), "entries")


def test_steps_of_one_round_in_several_calls_join_to_one_round(paper):
    trial, whole = devlearn.Trial(paper, seed=2), devlearn.Trial(paper, seed=2)
    parts = [trial.run(n) for n in (0, 7, 0, 30, 1)]
    trial.place(*trial.pose)  # a new round, though from where the other ended
    parts.append(trial.run(4))
    expected = whole.run(38)
    whole.place(*whole.pose)
    joined = devlearn.Record.concatenate(parts)
    assert joined.rounds["steps"].tolist() == [38, 4]
    assert differences(joined, devlearn.Record.concatenate([expected, whole.run(4)])) == []


@pytest.mark.parametrize("base", [devlearn.Learner, devlearn.RandomAgent])
def test_a_class_derived_from_ours_survives_with_all_that_it_has(base):
    derived = {devlearn.Learner: Logging, devlearn.RandomAgent: RandomLogging}[base]
    for again in (
        lambda a: pickle.loads(pickle.dumps(a)),
        copy.copy,
        copy.deepcopy,
        lambda a: a.copy() if base is devlearn.Learner else copy.copy(a),
    ):
        original = derived()
        original.log, original.me = [1, 2], original
        copied = again(original)
        assert type(copied) is derived
        assert copied is not original
        assert copied.log == [1, 2]
        copied.other = 3
        assert not hasattr(original, "other")
    deep = copy.deepcopy(original)
    assert deep.me is deep
    assert deep.log is not original.log
    trial = devlearn.Trial(devlearn.World.load("empty"), agent=original, seed=1)
    trial.free_learning(50)
    assert type(copy.deepcopy(trial).agent) is derived
    assert copy.deepcopy(trial).agent.log == [1, 2]


class Logging(devlearn.Learner):
    """Adds what it likes."""


class RandomLogging(devlearn.RandomAgent):
    """Likewise."""
