"""The schedule of an experiment: what comes next, how it ends and goes on; section VI's runs."""

from types import SimpleNamespace

import pytest
from conftest import differences, refused
from devlearn import RandomAgent, Record, Trial, TrialConfig, World
from devlearn.experiments.contenders import preset
from devlearn.experiments.schedule import Next, Schedule
from devlearn.paper import schedule
from devlearn.paper.places import new_starts
from devlearn.paper.schedule import run, settled_runs, useful_round

FAR = World(5, 5, (0.5, 0.5, 0), (4.5, 4.5))  # nothing is reached in two steps
NEAR = World(5, 5, (2.5, 2.5, 0), (2.9, 2.5))


def after(number, *rounds, arrived=False):
    """What a schedule asks of a trial in its round ``number``, and the rounds that were."""
    return SimpleNamespace(round=number, arrived=arrived), list(rounds)


# --- what comes next ------------------------------------------------------------------------------


def test_free_learning_comes_first_each_round_as_long_as_it_is_planned():
    planned = Schedule((7, 0), rounds=2, step_limit=9)
    assert planned.next(*after(0)) == Next(True, True, 7)
    assert planned.next(*after(1, (1, 3, False))) == Next(False, True, 4)
    assert planned.next(*after(1, (1, 3, True), arrived=True)) == Next(False, True, 4)
    assert planned.next(*after(1, (1, 7, False))) == Next(True, True, 0)


def test_a_round_of_path_learning_ends_at_the_target_or_the_limit():
    planned = Schedule((7,), rounds=2, step_limit=9)
    free = (1, 7, True)
    assert planned.next(*after(1, free, arrived=True)) == Next(True, False, 9, 2)
    assert planned.next(*after(2, free, (2, 4, False))) == Next(False, False, 5)
    for last, arrived in (((2, 9, False), False), ((2, 4, True), True)):
        assert planned.next(*after(2, free, last, arrived=arrived)) == Next(True, False, 9, 1)
    assert planned.next(*after(3, free, (2, 9, False), (3, 9, False))) is None


@pytest.mark.parametrize("planned", [Schedule((), 0), Schedule((0,), 0)])
def test_a_schedule_of_nothing_ends_at_once(planned):
    parts = [*planned.parts(Trial(FAR))]
    assert [part.rounds.tolist() for part in parts] == [[(1, 0, False, 0)]] * len(planned.free)


def test_so_many_rounds_are_run_at_once_as_leave_nothing_to_decide():
    planned = Schedule((), rounds=50, step_limit=9, hopeless=20)
    lost, won = (1, 9, False), (1, 4, True)
    assert planned.next(*after(0)).rounds == 20
    assert planned.next(*after(3, won, lost, lost)).rounds == 18
    assert planned.next(*after(3, lost, lost, won, arrived=True)).rounds == 20
    assert planned.next(*after(45, *[won] * 45, arrived=True)).rounds == 5
    assert planned.replace(hopeless=0).next(*after(0)).rounds == 50


def test_free_learning_makes_nothing_hopeless():
    planned = Schedule((5,) * 4, rounds=9, step_limit=9, hopeless=3)
    rounds = [(n, 5, False) for n in (1, 2, 3, 4)]
    assert planned.next(*after(4, *rounds)) == Next(True, False, 9, 3)


# --- how it ends ----------------------------------------------------------------------------------


def rounds_of(world, planned, agent=None):
    return Record.concatenate([*planned.parts(Trial(world, seed=1, agent=agent))]).rounds


@pytest.mark.parametrize(("rounds", "kept"), [(7, 7), (20, 20), (21, 20), (100, 20)])
def test_a_run_that_is_hopeless_ends_after_its_last_twenty_rounds_failed(rounds, kept):
    made = rounds_of(FAR, Schedule((10,), rounds, step_limit=2))
    assert made["steps"].tolist() == [10] + [2] * kept


def test_what_counts_are_the_failed_rounds_in_a_row():
    planned = Schedule((10,), 200, step_limit=60, hopeless=5)
    arrived = rounds_of(NEAR, planned, RandomAgent(2))["arrived"][1:].tolist()
    assert 20 < len(arrived) < 200
    in_a_row = [not any(arrived[i : i + 5]) for i in range(len(arrived) - 4)]
    assert in_a_row == [False] * (len(in_a_row) - 1) + [True]


def test_with_zero_no_run_is_hopeless():
    assert len(rounds_of(FAR, Schedule((), 45, step_limit=2, hopeless=0))) == 45


@pytest.mark.parametrize("hopeless", [0, 2, 5])
def test_the_history_is_the_same_in_parts_of_any_size(paper, hopeless):
    planned = Schedule((40, 30), rounds=9, step_limit=60, hopeless=hopeless)
    whole = Record.concatenate([*planned.parts(Trial(paper, seed=3))])
    for most in (1, 7, 60):
        parts = [*planned.parts(Trial(paper, seed=3), most=most)]
        assert max(map(len, parts)) <= most
        assert differences(Record.concatenate(parts), whole) == []


@pytest.mark.parametrize("stop", [0, 1, 5, 39, 40, 41, 70, 71, 100, 130, 131])
def test_a_schedule_goes_on_from_any_step_at_which_its_trial_was_saved(tmp_path, stop):
    planned = Schedule((40, 30), rounds=8, step_limit=60, hopeless=3)
    whole = Record.concatenate([*planned.parts(Trial(NEAR, seed=3))])
    trial, parts = Trial(NEAR, seed=3), []
    for part in planned.parts(trial, most=1):
        parts.append(part)
        if sum(map(len, parts)) >= stop:
            break
    done = Record.concatenate(parts)
    trial.save(tmp_path / "trial", done)
    again = Trial.load(tmp_path / "trial")
    rest = [*planned.parts(again, Record.load(tmp_path / "trial"))]
    assert differences(Record.concatenate([done, *rest]), whole) == []


@pytest.mark.parametrize(
    ("field", "values"),
    [
        ("free", [5, "5", (-1,), (10, 2**40 + 1), (1.0,), (True,)]),
        ("rounds", [-1, 2**30 + 1, 1.5, None, "3"]),
        ("step_limit", [0, 2**40 + 1, 1.5]),
        ("hopeless", [-1, 2**30 + 1, False]),
    ],
)
def test_numbers_that_are_none_are_refused(field, values):
    for value in values:
        refused(lambda value=value: Schedule(**{field: value}), f"Schedule.{field}")


def test_a_schedule_is_plain_values_and_back():
    planned = Schedule([1, 2], 3, 4, 5)
    assert (
        Schedule(**planned.to_dict())
        == planned
        == Schedule().replace(free=(1, 2), rounds=3, step_limit=4, hopeless=5)
    )


# --- section VI -----------------------------------------------------------------------------------


def test_a_run_is_two_rounds_of_free_learning_and_then_rounds_of_path_learning(paper):
    config = TrialConfig.step5()
    made = run(paper, config, 9, Schedule((300, 300), rounds=25, step_limit=900))
    trial = Trial(paper, config, 9)
    assert differences(made.first, trial.free_learning(300)) == []
    assert differences(made.second, trial.free_learning(300)) == []
    assert differences(made.paths, trial.path_learning(25, 900)) == []
    assert made.paths.rounds["round"].tolist() == list(range(3, 28))
    assert made.trial.learner.explored_count == trial.learner.explored_count


def test_an_unknown_preset_is_refused():
    assert preset("paper") == TrialConfig.paper()
    assert preset("step5") == TrialConfig.step5()
    refused(lambda: preset("step6"), "preset", "'step6'")


def test_settled_runs_are_those_that_settled_each_on_a_path_of_its_own(monkeypatch):
    habits = {1: None, 2: "a", 3: "a", 4: None, 5: "b", 6: "a", 7: "c"}
    monkeypatch.setattr(schedule, "run", lambda world, config, seed: SimpleNamespace(paths=seed))
    monkeypatch.setattr(schedule.measures, "habit", lambda paths: habits[paths])
    found = settled_runs(None, None)
    assert [next(found).paths for _ in range(3)] == [2, 5, 7]


@pytest.fixture(scope="module")
def learned(paper):
    """A learner after a run."""
    return run(paper, TrialConfig.paper(), 4, Schedule(rounds=30)).trial.learner


def test_rounds_from_a_new_start_end_with_one_that_is_useful(paper, learned):
    config = TrialConfig.paper()
    (start, shortest) = new_starts(paper, config, 1)[0]
    before = learned.explored_count
    record = useful_round(paper, config, learned, start, shortest)
    assert record.rounds["arrived"][-1]
    useful = (record.rounds["steps"] <= 1.5 * shortest) & record.rounds["arrived"]
    assert useful.tolist() == [False] * (len(useful) - 1) + [True]
    assert record.path(0)[0].tolist() == list(start)
    assert learned.explored_count == before  # it learned with a copy


def test_useful_is_at_most_one_and_a_half_times_the_shortest_path(paper, learned):
    config, learner = TrialConfig.paper(), learned
    start = new_starts(paper, config, 1)[0][0]
    first = useful_round(paper, config, learner, start, 10**6).rounds
    assert first["arrived"].tolist() == [False] * (len(first) - 1) + [True]
    steps = int(first["steps"][-1])
    enough = -(-steps * 2 // 3)  # the least whole number that makes so many steps useful
    useful = useful_round(paper, config, learner, start, enough)
    assert useful.rounds.tolist() == first.tolist()
    later = useful_round(paper, config, learner, start, enough - 1)
    assert later is None or len(later.rounds) > len(first)


@pytest.mark.parametrize(("in_a_row", "made_in_all"), [(3, 3), (99, 40)])
def test_a_robot_trapped_at_a_new_start_is_given_up(
    paper, learned, monkeypatch, in_a_row, made_in_all
):
    rounds = []

    class Watched(Trial):
        def finish_round(self, *arguments, **more):
            rounds.append(arguments)
            return super().finish_round(*arguments, **more)

    monkeypatch.setattr(schedule, "Trial", Watched)
    monkeypatch.setattr(schedule, "SECTION_VI", Schedule(step_limit=1))
    monkeypatch.setattr(schedule, "NEW_START_HOPELESS", in_a_row)
    assert useful_round(paper, TrialConfig.paper(), learned, (2.5, 3.0, 0.0), 50) is None
    assert rounds == [(1,)] * made_in_all
