"""An evaluation and situations of one's own in a trial."""

import copy
import functools
import math
import pathlib
import pickle
import re
import signal
import threading
import time

import devlearn
import numpy as np
import pytest
from conftest import differences, joined, refused
from devlearn import Learner, StateEvaluation, Trial, TrialConfig, World
from devlearn.analysis import preference_field, sef_field

EQ6 = StateEvaluation()


def eq6(senses):
    return EQ6(senses.goal_distance, senses.clearance)


def progress(senses):
    return -senses.goal_distance


def quadrants(senses):
    """Where the target lies, as the heading's quadrant."""
    return int(senses.pose.heading // 90)


class Gap:
    """Situations by clearance, in steps of so many metres."""

    def __init__(self, width):
        self.width = width

    def __call__(self, senses):
        return int(senses.clearance / self.width)


def history(trial):
    return joined([trial.free_learning(2000), trial.path_learning(10, 400)])


@pytest.mark.parametrize("preset", ["paper", "adaptive"])
def test_eq_6_and_the_grid_as_callables_make_the_same_history(paper, preset):
    config = getattr(TrialConfig, preset)()
    plain = Trial(paper, config, seed=5)
    grid = plain.grid
    own = Trial(paper, config, seed=5, evaluation=eq6, situations=lambda s: grid.situation(*s.pose))
    assert differences(history(plain), history(own)) == []


def test_a_callable_is_given_the_senses_that_the_record_tells(paper):
    seen = []

    def look(senses):
        seen.append(senses)
        return 0.0

    trial = Trial(paper, seed=1, evaluation=look)
    record = trial.run(20)
    assert [s.pose for s in seen[1:]] == [tuple(pose) for pose in record.path()[1:].tolist()]
    assert [s.goal_distance for s in seen[1:]] == record.goal_distance.tolist()
    assert [s.clearance for s in seen[1:]] == record.clearance.tolist()
    assert isinstance(seen[0], devlearn.Senses)
    assert isinstance(seen[0].pose, devlearn.Pose)


def test_a_table_is_looked_up_by_the_grids_situation(paper):
    grid = Trial(paper).grid
    table = np.arange(grid.count) / 8
    trial = Trial(paper, seed=1, evaluation=table)
    record = trial.run(100)
    ids = [grid.situation(*pose) for pose in record.path()[1:].tolist()]
    assert record.sef.tolist() == table[ids].tolist()
    assert trial.evaluation.tolist() == table.tolist()
    table[:] = 0
    assert trial.evaluation[8] == 1.0


def test_situations_may_be_made_of_echoes(paper):
    robot = devlearn.Robot(paper)

    def code(senses):
        echoes = np.asarray(robot.sonar(senses.pose))
        return int((echoes < 0.5) @ 2 ** np.arange(len(echoes)))

    trial = Trial(paper, seed=1, situations=code)
    record = trial.run(300, echoes=True)
    codes = (record.echoes < 0.5) @ 2 ** np.arange(record.echoes.shape[1])
    assert record.situation[1:].tolist() == codes[:-1].tolist()
    assert len(set(record.situation.tolist())) > 3
    assert set(trial.learner.situations()) == set(record.situation.tolist())


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (math.nan, "nan"), (math.inf, "inf"), (-2e300, "-2e+300"), ("1", "'1'"), (None, "None"),
        (10**400, None),
    ],
)  # fmt: skip
def test_what_is_no_sef_is_refused_and_the_trial_left_as_it_was(paper, value, shown):
    given = [0.0]
    trial = Trial(paper, seed=1, evaluation=lambda senses: given[0])
    trial.run(10)
    before = trial.pose, trial.round, trial.learner.to_bytes()
    given[0] = value
    error = refused(trial.step, value=shown)
    assert error.quantity.startswith(f"SEF by {__name__}:test_what_is_no_sef")
    assert (trial.pose, trial.round) == before[:2]
    assert trial.learner.pending is None
    assert trial.learner.explored_count == Learner.from_bytes(before[2]).explored_count
    given[0] = 1
    assert trial.step().sef == 1.0


@pytest.mark.parametrize("value", [-1, 2**63, 0.5, math.nan, "1", None, True])
def test_what_is_no_situation_is_refused_and_the_trial_left_as_it_was(paper, value):
    given = [0]
    trial = Trial(paper, seed=1, situations=lambda senses: given[0])
    trial.run(10)
    pose = trial.pose
    given[0] = value
    name = f"situation by {__name__}:test_what_is_no_situation"
    assert refused(trial.step).quantity.startswith(name)
    assert trial.pose == pose
    given[0] = 3.0
    trial.run(2)
    assert trial.learner.situations().tolist() == [0, 3]


def test_what_a_callable_raises_comes_through_and_what_was_finished_is_kept(paper):
    left = [30]

    def tired(senses):
        left[0] -= 1
        if left[0] < 0:
            raise LookupError("no reading")
        return -senses.goal_distance

    trial = Trial(paper, seed=2, evaluation=tired)
    with pytest.raises(LookupError, match="no reading"):
        trial.run(100)
    assert len(trial.interrupted) == 29
    assert trial.pose == tuple(trial.interrupted.path()[-1].tolist())
    left[0] = 1000
    assert len(trial.run(71)) == 71


def test_a_callable_that_moves_its_own_trial_is_refused_and_may_look_at_it(paper):
    moves = []

    def meddling(senses):
        if moves:
            assert trial.round == 1
            moves.pop()()
        return 0.0

    trial = Trial(paper, seed=2, evaluation=meddling)
    trial.run(3)
    pose = trial.pose
    for move in (trial.begin_round, trial.step, lambda: trial.run(1), trial.to_bytes):
        moves.append(move)
        refused(lambda: trial.step(), "Trial")
    assert trial.pose == pose


def test_ctrl_c_in_a_callable_ends_the_phase_and_keeps_what_was_finished(paper):
    def slow(senses):
        time.sleep(0.002)
        return -senses.goal_distance

    trial = Trial(paper, seed=2, evaluation=slow)
    main = threading.main_thread().ident
    timer = threading.Timer(0.1, lambda: signal.pthread_kill(main, signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        trial.run(100_000)
    timer.join()
    assert 0 < len(trial.interrupted) < 10_000
    assert len(trial.run(5)) == 5


@pytest.mark.parametrize(
    ("parts", "quantity"),
    [
        ({"evaluation": "sef"}, "evaluation"),
        ({"evaluation": EQ6}, "evaluation"),
        ({"evaluation": [[1.0, 2.0]]}, "evaluation"),
        ({"evaluation": [1.0, 2.0]}, "TrialParts.sef_table"),
        ({"evaluation": [1.0], "situations": quadrants}, "TrialParts.sef_table"),
        ({"evaluation": np.full(4800, np.nan)}, "TrialParts.sef_table[0]"),
        ({"situations": [1, 2]}, "situations"),
    ],
)
def test_what_is_no_part_is_refused(paper, parts, quantity):
    refused(lambda: Trial(paper, **parts), quantity)


def futures(trial, other):
    return differences(history(trial), history(other))


@pytest.mark.parametrize("evaluation", [progress, functools.partial(progress)])
def test_a_trial_goes_on_where_its_callables_are_given_again(paper, tmp_path, evaluation):
    trial = Trial(paper, seed=3, evaluation=evaluation, situations=Gap(0.1))
    trial.free_learning(500)
    path = tmp_path / "own.safetensors"
    trial.save(path)
    again = Trial.load(path, evaluation=evaluation, situations=Gap(0.1))
    assert again.evaluation is evaluation
    assert futures(trial, again) == []


def test_the_file_names_the_callables_and_refuses_others(paper, tmp_path):
    path = tmp_path / "own.safetensors"
    trial = Trial(paper, seed=3, evaluation=progress, situations=Gap(0.1))
    trial.save(path)
    refused(lambda: Trial.load(path), "own.evaluation", f"{__name__}:progress")
    refused(
        lambda: Trial.load(path, evaluation=eq6, situations=Gap(0.1)),
        "own.evaluation",
        f"{__name__}:progress",
    )
    refused(
        lambda: Trial.load(path, evaluation=progress, situations=quadrants),
        "own.situations",
        f"{__name__}:Gap",
    )
    refused(
        lambda: Trial.from_bytes(trial.to_bytes(), evaluation=progress),
        "own.situations",
        f"{__name__}:Gap",
    )
    Trial(paper).save(path)
    refused(lambda: Trial.load(path, evaluation=progress), "own.evaluation", "none")


def test_a_table_is_in_the_file(paper, tmp_path):
    path = tmp_path / "table.safetensors"
    table = np.random.default_rng(1).normal(size=4800)
    trial = Trial(paper, seed=3, evaluation=table)
    trial.free_learning(500)
    trial.save(path)
    again = Trial.load(path)
    assert again.evaluation.tolist() == table.tolist()
    assert futures(trial, again) == []
    refused(lambda: Trial.load(path, evaluation=table), "own.sef_table")


@pytest.mark.parametrize(
    "parts",
    [
        {"evaluation": progress, "situations": Gap(0.2)},
        {"situations": quadrants},
        {"evaluation": np.linspace(0, 1, 4800)},
    ],
)
@pytest.mark.parametrize(
    "through", [copy.deepcopy, copy.copy, lambda trial: pickle.loads(pickle.dumps(trial))]
)
def test_a_copied_or_pickled_trial_goes_on_alike(paper, parts, through):
    trial = Trial(paper, seed=3, **parts)
    trial.free_learning(300)
    assert futures(through(trial), trial) == []


def test_a_record_tells_of_its_trials_parts_and_is_read_without_them(paper, tmp_path):
    path = tmp_path / "own.safetensors"
    trial = Trial(paper, seed=3, evaluation=progress, situations=quadrants)
    record = trial.free_learning(50)
    trial.save(path, record)
    again = devlearn.Record.load(path)
    assert again == record
    assert again.provenance["evaluation"] == f"{__name__}:progress"
    assert again.provenance["situations"] == f"{__name__}:quadrants"
    table = Trial(paper, evaluation=np.zeros(4800)).run(1)
    assert table.provenance["evaluation"] == "table"
    assert "situations" not in table.provenance


def test_what_reads_eq_6_or_the_grid_refuses_a_trial_that_has_neither(paper):
    trial = Trial(paper, seed=3, evaluation=progress, situations=quadrants)
    record = trial.free_learning(50)
    for source in (trial, record):
        refused(functools.partial(sef_field, source), "evaluation")
        assert np.isfinite(sef_field(source, EQ6).sef).any()
        refused(functools.partial(preference_field, source, trial.learner), "situations")


def test_trials_with_callables_run_in_several_threads():
    world = World.load("paper")
    records = {}

    def run(seed):
        records[seed] = Trial(world, seed=seed, evaluation=progress).free_learning(2000)

    threads = [threading.Thread(target=run, args=(seed,)) for seed in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for seed, record in records.items():
        alone = Trial(world, seed=seed, evaluation=progress).free_learning(2000)
        assert differences(record, alone) == []


def test_the_guides_code_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    guide = (pathlib.Path(__file__).parents[2] / "docs" / "own_sef.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", guide, re.DOTALL)
    names = {}
    exec(code, names)
    trial, again = names["trial"], names["again"]
    assert again.evaluation is names["evaluation"]
    assert trial.learner.situations().max() < trial.situations.grid.count
    assert futures(trial, again) == []
