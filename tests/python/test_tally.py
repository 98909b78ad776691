"""What a run came to, counted as its steps pass."""

import pickle
import threading
import time

import devlearn
import pytest
from conftest import refused
from devlearn import Event, Kind, RandomAgent, Record, Tally, Trial, TrialConfig
from devlearn.agents import QLearning, QLearningConfig
from hypothesis import given
from hypothesis import strategies as st

AGENTS = {
    "the paper's": lambda world, seed: Trial(world, seed=seed),
    "adaptive": lambda world, seed: Trial(world, TrialConfig.adaptive(), seed),
    "QLearning": lambda world, seed: Trial(
        world, seed=seed, agent=QLearning(QLearningConfig(), seed)
    ),
    "random": lambda world, seed: Trial(world, seed=seed, agent=RandomAgent(seed)),
}


def counted(record):
    """What a record comes to by plain counting, a dict a round; ``path`` as the motions."""
    rounds, first_smf, step = [], {}, 0
    explored_count = effective_count = 0
    for entry in record.rounds.tolist():
        steps = range(step, step + entry[1])
        step = steps.stop
        motions = record.motion[steps.start : steps.stop].tolist()
        arrivals = [i - steps.start + 1 for i in steps if record.arrived[i]]
        ineffective = [bool(record.smf_used[i] < 0) for i in steps]
        updates = [
            record.event[i] in (Event.EXTENSION, Event.ORIENTATION, Event.ABANDONMENT)
            for i in steps
        ]
        known = 0
        for i in steps:
            mapping = (int(record.situation[i]), int(record.motion[i]))
            known += mapping in first_smf and first_smf[mapping] < 0
            first_smf.setdefault(mapping, record.smf_used[i])
        if motions:
            explored_count = int(record.explored_count[step - 1])
            effective_count = int(record.effective_count[step - 1])
        rounds.append(
            {
                "round": entry[0],
                "steps": len(steps),
                "arrived": entry[2],
                "first_arrival": arrivals[0] if arrivals else 0,
                "touches": sum(bool(record.collided[i]) for i in steps),
                "cost": sum(record.cost[i] for i in steps),
                "path": tuple(motions),
                "explored": sum(record.kind[i] == Kind.EXPLORE for i in steps),
                "known_ineffective": known,
                "ineffective": sum(ineffective),
                "updates": sum(updates),
                "ineffective_updates": sum(u and i for u, i in zip(updates, ineffective)),
                "mappings": len(first_smf),
                "explored_count": explored_count,
                "effective_count": effective_count,
            }
        )
    return rounds


def check_counts(rounds, record):
    """Whether a tally's rounds are those that a record comes to."""
    expected = counted(record)
    assert len(rounds) == len(expected)
    assert rounds.dtype.names == tuple(expected[0])
    for name in rounds.dtype.names:
        if name != "path":
            assert rounds[name].tolist() == [entry[name] for entry in expected], name
    # Equal motions have equal fingerprints, and no others.
    paths = [entry["path"] for entry in expected]
    pairs = set(zip(paths, rounds["path"].tolist()))
    assert len(pairs) == len(set(paths)) == len({value for _, value in pairs})


def same(a, b):
    """Whether two tallies are equal, field by field."""
    assert a.rounds.dtype == b.rounds.dtype
    assert a.rounds.tobytes() == b.rounds.tobytes()


def wait_until_refused(call):
    for _ in range(2000):
        try:
            call()
        except devlearn.InvalidValue:
            return
        time.sleep(0.005)
    pytest.fail("never refused")


PHASE = st.one_of(
    st.tuples(st.just("run"), st.integers(0, 60)),
    st.tuples(st.just("free_learning"), st.integers(0, 400)),
    st.tuples(st.just("path_learning"), st.integers(0, 6), st.integers(1, 150)),
    st.tuples(st.just("finish_round"), st.integers(0, 100)),
)


@given(st.sampled_from(sorted(AGENTS)), st.integers(0, 50), st.lists(PHASE, min_size=1, max_size=6))
def test_whatever_is_run_is_counted_as_its_record_comes_to(name, seed, phases):
    world = devlearn.World.load("paper")
    trial, tally = AGENTS[name](world, seed), Tally()
    records = [getattr(trial, phase)(*counts, tally=tally) for phase, *counts in phases]
    record = Record.concatenate(records)
    if len(record.rounds):
        check_counts(tally.rounds, record)
    assert tally.steps == len(record)
    same(tally, Tally.of(record))


@pytest.mark.parametrize("name", AGENTS)
def test_a_whole_experiment_is_counted_as_its_record_comes_to(paper, name):
    trial, tally = AGENTS[name](paper, 3), Tally()
    record = Record.concatenate(
        [
            trial.free_learning(3000, tally=tally),
            trial.path_learning(60, 400, tally=tally),
        ]
    )
    check_counts(tally.rounds, record)
    same(tally, Tally.of(record))
    assert tally.rounds["touches"].sum() > 0


@pytest.mark.parametrize("name", AGENTS)
def test_records_of_rounds_only_have_the_same_tally(paper, name):
    full, brief = Tally(), Tally()
    for tally, rounds_only in ((full, False), (brief, True)):
        trial = AGENTS[name](paper, 2)
        trial.free_learning(500, tally=tally, rounds_only=rounds_only)
        trial.path_learning(10, 300, tally=tally, rounds_only=rounds_only)
    same(full, brief)


def test_a_run_that_is_stopped_and_goes_on_has_the_tally_of_one_that_was_not(paper):
    trial, tally, whole = Trial(paper, seed=4), Tally(), Tally()
    stop = threading.Event()
    timer = threading.Timer(0.05, stop.set)
    timer.start()
    trial.free_learning(10**9, stop=stop, tally=tally)
    timer.join()
    trial.run(500, tally=tally)
    Trial(paper, seed=4).free_learning(tally.steps, tally=whole)
    assert len(tally.rounds) == 1
    same(tally, whole)


def test_an_interrupted_round_that_is_finished_is_one_entry(paper):
    seen = 0

    class Agent:
        def choose(self, observation):
            nonlocal seen
            seen += 1
            if seen == 31:
                raise RuntimeError("once")
            return seen % 5

        def observe(self, outcome):
            pass

    trial, tally = Trial(paper, agent=Agent()), Tally()
    with pytest.raises(RuntimeError, match="once"):
        trial.path_learning(5, 10, tally=tally)
    first = trial.interrupted
    assert tally.steps == 30
    same(tally, Tally.of(first))
    second = trial.finish_round(6, tally=tally)
    record = Record.concatenate([first, second])
    assert len(tally.rounds) == len(record.rounds)
    check_counts(tally.rounds, record)
    same(tally, Tally.of(record))


def test_rounds_at_the_target_arrive_by_no_step():
    world = devlearn.World(start=(1, 1, 0), target=(1, 1))
    trial, tally = Trial(world), Tally()
    record = trial.path_learning(3, tally=tally)
    assert tally.rounds["arrived"].all()
    assert tally.rounds["steps"].tolist() == tally.rounds["first_arrival"].tolist() == [0, 0, 0]
    check_counts(tally.rounds, record)
    same(tally, Tally.of(record))


def test_situations_of_ones_own_may_be_as_large_as_ids_are(paper):
    def situations(senses):
        return 2**63 - 1 - int(senses.goal_distance * 8)

    trial, tally = Trial(paper, agent=RandomAgent(1), situations=situations), Tally()
    record = trial.free_learning(2000, tally=tally)
    assert record.situation.min() > 2**62
    check_counts(tally.rounds, record)


def test_a_tally_changes_no_history(paper):
    with_it = Trial(paper, seed=9).free_learning(2000, tally=Tally())
    assert Trial(paper, seed=9).free_learning(2000) == with_it


def test_rounds_are_a_copy_without_padding(paper):
    tally = Tally()
    Trial(paper, seed=1).path_learning(3, tally=tally)
    rounds = tally.rounds
    assert rounds.dtype.itemsize == sum(rounds.dtype[n].itemsize for n in rounds.dtype.names)
    rounds["steps"] = 0
    assert tally.steps == tally.rounds["steps"].sum() > 0


def test_a_tally_tells_each_of_its_fields_in_its_help():
    assert len(Tally().rounds) == Tally().steps == 0
    for name in Tally().rounds.dtype.names:
        assert f"``{name}``" in Tally.__doc__


def test_a_record_that_holds_no_steps_is_refused_and_so_is_what_is_none(paper):
    brief = Trial(paper).run(3, rounds_only=True)
    refused(lambda: Tally.of(brief), "record")
    for other in (None, 3, "record"):
        refused(lambda other=other: Tally.of(other), "record")
        if other is not None:
            refused(lambda other=other: Trial(paper).run(1, tally=other), "Trial.run.tally")


def test_a_tally_is_refused_while_another_threads_run_counts_into_it(paper):
    trial, tally, stop = Trial(paper, seed=1), Tally(), threading.Event()
    thread = threading.Thread(
        target=trial.run, args=(2**40,), kwargs={"tally": tally, "stop": stop, "rounds_only": True}
    )
    thread.start()
    try:
        wait_until_refused(lambda: tally.steps)
        other = Trial(paper, seed=2)
        refused(lambda: other.run(1, tally=tally), "Tally")
        refused(lambda: tally.rounds, "Tally")
        assert other.round == 0
    finally:
        stop.set()
        thread.join()
    assert tally.steps > 0


def test_a_tally_is_refused_to_a_run_within_the_run_that_counts_into_it(paper):
    tally, inner = Tally(), Trial(paper, seed=2)

    class Agent:
        def choose(self, observation):
            refused(lambda: inner.run(1, tally=tally), "Tally")
            return 0

        def observe(self, outcome):
            pass

    Trial(paper, agent=Agent()).run(3, tally=tally)
    assert tally.steps == 3
    inner.run(1, tally=tally)
    assert tally.steps == 4


def test_progress_may_read_the_tally_of_its_run(paper):
    tally, told = Tally(), []
    Trial(paper, seed=1).free_learning(
        300_000, tally=tally, rounds_only=True, progress=lambda *_: told.append(tally.steps)
    )
    assert told == sorted(told)
    assert told[-1] == tally.steps == 300_000


def test_a_tally_is_not_pickled():
    with pytest.raises(TypeError):
        pickle.dumps(Tally())
