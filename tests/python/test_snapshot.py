"""A learner's snapshot as Python and other people's tools see it; its laws are stated in C++."""

import copy
import pickle

import devlearn
import numpy as np
import pytest
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
