"""The learner as Python sees it: its names, its refusals, its copies and its golden history."""

import contextlib
import copy
import gc
import pathlib
import pickle
import sys

import devlearn
import numpy as np
import pytest
from devlearn import Event, Kind, Learner, LearnerConfig
from hypothesis import given, settings
from hypothesis import strategies as st

GOLDEN = pathlib.Path(__file__).parents[1] / "golden"

situations = st.integers(0, 2**63 - 1)
seeds = st.integers(0, 2**64 - 1)
finite = st.floats(allow_nan=False, allow_infinity=False)
fractions = st.floats(0, 1, exclude_min=True, exclude_max=True)
configs = st.builds(
    LearnerConfig,
    motion_count=st.integers(1, 9),
    eta=fractions,
    sigma=fractions,
    c1=st.floats(0, 1e6),
    c2=st.floats(-1e6, 1e6),
    on_negative=st.sampled_from(["abandon", "weaken"]),
    when_exhausted=st.sampled_from(["retry", "wander"]),
)


def for_all(*strategies):
    """Properties with the same examples in every run, however slow the machine."""
    return lambda test: settings(deadline=None, derandomize=True)(given(*strategies)(test))


def lists(learner, situation):
    memory = learner.situation(situation)
    return (
        memory.effective,
        memory.ineffective,
        memory.unexplored,
        memory.orientation,
        memory.times_learned,
    )


def state(learner):
    """Everything that a learner shows of itself."""
    pending = learner.pending
    return (
        learner.config,
        learner.seed,
        pending and (pending.motion, pending.kind),
        learner.explored_count,
        learner.effective_count,
        learner.situations_experienced,
        [(s, lists(learner, s)) for s in learner.situations().tolist()],
    )


def history(learner, steps, seed=0):
    """What a learner does in some steps of a random task."""
    random = np.random.default_rng(seed)
    done = []
    for _ in range(steps):
        choice = learner.choose(random.integers(9))
        development = learner.learn(random.normal(0.5, 3))
        done.append((choice.motion, choice.kind, development.event, development.reduced))
    return done


def refused(quantity, value, call, *args, **kwargs):
    """Checks that a call is refused, by name and value, as a ValueError."""
    with pytest.raises(devlearn.InvalidValue) as caught:
        call(*args, **kwargs)
    error = caught.value
    assert isinstance(error, ValueError)
    assert (error.quantity, error.value) == (quantity, value)
    assert error.allowed
    assert str(error) == f"{quantity}: got {value}; expected {error.allowed}"


# --- configuration -------------------------------------------------------------------------------


def test_the_defaults_are_the_papers():
    paper = {
        "motion_count": 5,
        "eta": 0.05,
        "sigma": 0.3,
        "c1": 0.5,
        "c2": 1.0,
        "on_negative": "abandon",
        "when_exhausted": "retry",
    }
    assert LearnerConfig().to_dict() == LearnerConfig.paper().to_dict() == paper
    step5 = {**paper, "on_negative": "weaken", "when_exhausted": "wander"}
    assert LearnerConfig.step5().to_dict() == step5
    assert LearnerConfig.step5() == LearnerConfig(**step5) != LearnerConfig.paper()
    assert Learner().config == LearnerConfig.paper()
    assert Learner().seed == 0


@for_all(configs)
def test_a_configuration_survives_its_dict_to_the_bit(config):
    assert LearnerConfig.from_dict(config.to_dict()) == config
    assert LearnerConfig(**config.to_dict()) == config
    assert Learner(config).config == config


@for_all(configs)
def test_a_configuration_survives_pickling_and_copying_to_the_bit(config):
    assert pickle.loads(pickle.dumps(config)) == config
    assert copy.deepcopy(config) == config


def test_a_dict_may_leave_out_fields_but_not_invent_them():
    assert LearnerConfig.from_dict({}) == LearnerConfig()
    assert LearnerConfig.from_dict({"sigma": 0.6}) == LearnerConfig(sigma=0.6)
    with pytest.raises(devlearn.InvalidValue) as caught:
        LearnerConfig.from_dict({"sigmma": 0.6})
    assert caught.value.quantity == "LearnerConfig.sigmma"
    assert "sigma" in caught.value.allowed


@pytest.mark.parametrize(
    ("field", "bad"),
    [
        *[("motion_count", bad) for bad in (0, -1, 65536)],
        *[("eta", bad) for bad in (0.0, 1.0, -0.5, float("nan"), float("inf"))],
        *[("sigma", bad) for bad in (0.0, 1.0, 1.5, float("nan"), -float("inf"))],
        *[("c1", bad) for bad in (-0.1, 1000001.0, float("nan"), float("inf"))],
        *[("c2", bad) for bad in (-1000001.0, 1000001.0, float("nan"))],
    ],
)
def test_a_parameter_out_of_its_range_is_refused_by_name(field, bad):
    value = f"{bad:g}" if abs(bad) < 1e5 or bad != bad else str(bad).removesuffix(".0")
    refused(f"LearnerConfig.{field}", value, LearnerConfig, **{field: bad})
    refused(f"LearnerConfig.{field}", value, LearnerConfig.from_dict, {field: bad})


@pytest.mark.parametrize("field", ["on_negative", "when_exhausted"])
def test_an_unknown_option_is_refused_by_name(field):
    refused(f"LearnerConfig.{field}", "'forget'", LearnerConfig, **{field: "forget"})


# --- the loop ------------------------------------------------------------------------------------


def test_the_names_that_scripts_rely_on():
    learner = Learner(config=LearnerConfig(motion_count=4), seed=3)
    choice = learner.choose(situation=17)
    assert choice.kind is Kind.EXPLORE
    assert learner.pending == choice
    development = learner.learn(smf=1.0, motion=2)
    assert (development.situation, development.motion) == (17, 2)
    assert (development.event, development.reduced) == (Event.EXTENSION, 0)
    assert learner.update(situation=17, motion=0, smf=-1.0).event is Event.REJECTION
    assert lists(learner, 17) == ([2], [0], [1, 3], [1.0], [1])
    assert learner.choose(5) is not None
    assert learner.cancel() is None
    assert learner.pending is None
    assert learner.situations().tolist() == [17, 5]
    assert learner.situations().dtype == np.int64
    assert learner.reserve(situations=1000) is None
    counts = learner.explored_count, learner.effective_count, learner.situations_experienced
    assert counts == (2, 1, 2)
    assert learner.seed == 3
    assert learner.config == LearnerConfig(motion_count=4)


def test_kinds_and_events_have_the_numbers_of_records():
    assert [(kind.name, int(kind)) for kind in Kind] == [
        ("EXPLORE", 0),
        ("EXPLOIT", 1),
        ("EXHAUSTED", 2),
        ("UNSTATED", 3),
        ("HABIT", 4),
        ("DEVIATION", 5),
        ("HELD", 6),
    ]
    assert [(event.name, int(event)) for event in Event] == [
        ("NOTHING", 0),
        ("EXTENSION", 1),
        ("REJECTION", 2),
        ("ORIENTATION", 3),
        ("ABANDONMENT", 4),
    ]


@for_all(configs, seeds, st.lists(st.tuples(st.integers(0, 3), finite), max_size=60))
def test_the_proofs_hold_whatever_is_experienced(config, seed, experience):
    learner = Learner(config, seed)
    for situation, smf in experience:
        choice = learner.choose(situation)
        learner.learn(smf)
        effective, ineffective, unexplored, orientation, times_learned = lists(learner, situation)
        assert sorted(effective + ineffective + unexplored) == list(range(config.motion_count))
        assert all(0 <= o <= 1 for o in orientation)
        assert not orientation or abs(sum(orientation) - 1) <= 1e-9
        assert len(orientation) == len(times_learned) == len(effective)
        assert choice.motion not in unexplored
    everywhere = [lists(learner, s) for s in learner.situations().tolist()]
    assert learner.effective_count == sum(len(e) for e, *_ in everywhere)
    assert learner.explored_count == sum(len(e) + len(i) for e, i, *_ in everywhere)


@for_all(situations)
def test_looking_at_a_situation_creates_nothing(situation):
    learner = Learner()
    before = state(learner)
    assert lists(learner, situation) == ([], [], [0, 1, 2, 3, 4], [], [])
    assert state(learner) == before
    learner.choose(situation)
    assert learner.situations().tolist() == [situation]


@for_all(st.integers(0, 1000))
def test_what_is_shown_of_a_situation_is_a_copy(seed):
    learner = Learner(seed=seed)
    history(learner, 30)
    memory = learner.situation(0)
    before = state(learner)
    memory.effective.append(99)
    memory.orientation.clear()
    learner.situations()[:] = -1
    assert state(learner) == before


@pytest.mark.parametrize(
    "integer",
    [np.int8, np.uint8, np.int32, np.uint32, np.int64, np.uint64],
    ids=lambda t: t.__name__,
)
def test_numpys_whole_numbers_and_floats_are_as_good_as_pythons(integer):
    ours, theirs = Learner(seed=integer(7)), Learner(seed=7)
    for situation in range(50):
        assert ours.choose(integer(situation)) == theirs.choose(situation)
        ours.learn(np.float64(1.5), motion=integer(3))
        theirs.learn(1.5, motion=3)
        ours.update(integer(situation), integer(1), np.float32(-0.5))
        theirs.update(situation, 1, -0.5)
        assert lists(ours, integer(situation)) == lists(theirs, situation)
    assert state(ours) == state(theirs)


class Cautious(Learner):
    """Asks its class for what it does."""

    def choose(self, situation):
        return super().choose(situation)

    def learn(self, smf, motion=None):
        return super().learn(smf) if motion is None else super().learn(smf, motion)


@pytest.mark.parametrize(
    ("kind", "choose", "learn"),
    [
        (Learner, lambda it, s: it.choose(situation=s), lambda it, smf: it.learn(smf=smf)),
        (Learner, Learner.choose, Learner.learn),
        (Learner, lambda it, s: it.choose(np.int64(s)), lambda it, smf: it.learn(np.float64(smf))),
        (Learner, lambda it, s: it.choose(s), lambda it, smf: it.learn(smf, motion=None)),
        (Learner, lambda it, s: it.choose(s), lambda it, smf: it.learn(smf, it.pending.motion)),
        (Cautious, lambda it, s: it.choose(s), lambda it, smf: it.learn(smf)),
    ],
    ids=["by keyword", "by the class", "numpy's numbers", "none", "its motion", "a subclass"],
)
def test_however_choose_and_learn_are_called_the_history_is_the_same(kind, choose, learn):
    plain, other = Learner(seed=4), kind(seed=4)
    random = np.random.default_rng(4)
    for _ in range(500):
        situation, smf = int(random.integers(9)), float(random.normal(0.5, 3))
        assert choose(other, situation) == plain.choose(situation)
        assert learn(other, smf) == plain.learn(smf)
    assert state(other) == state(plain)


def test_results_are_named_tuples_that_nothing_changes():
    learner = Learner(seed=1)
    choice = learner.choose(7)
    development = learner.learn(1.0)
    motion, kind = choice
    assert (motion, kind) == (choice.motion, choice.kind) == (choice.motion, Kind.EXPLORE)
    assert development == devlearn.Development(7, motion, Event.EXTENSION, 0, 1, 1)
    assert choice == devlearn.Choice(motion, Kind.EXPLORE) != devlearn.Choice(motion)
    assert repr(choice) == f"Choice(motion={motion}, kind={Kind.EXPLORE!r})"
    assert repr(development) == (
        f"Development(situation=7, motion={motion}, event={Event.EXTENSION!r}, reduced=0, "
        "explored_count=1, effective_count=1, value=None)"
    )
    for result in (choice, development):
        assert pickle.loads(pickle.dumps(result)) == copy.deepcopy(result) == result
        assert hash(result) == hash(tuple(result))
        with pytest.raises(AttributeError):
            result.motion = 3


def test_a_choice_that_is_kept_stays_what_it_was_however_many_motions_there_are():
    learner = Learner(LearnerConfig(motion_count=300), seed=2)
    kept = []
    for situation in (0, 1):
        for _ in range(300):
            choice = learner.choose(situation)
            kept.append((choice, choice.motion, choice.kind))
            learner.learn(-1.0)
    assert all(type(choice) is devlearn.Choice for choice, *_ in kept)
    assert all((choice.motion, choice.kind) == (motion, kind) for choice, motion, kind in kept)
    assert sorted(motion for _, motion, _ in kept) == sorted([*range(300)] * 2)


def test_choosing_and_learning_leaves_nothing_behind():
    learner = Learner(seed=3)
    learner.reserve(100)

    def steps(count):
        for n in range(count):
            learner.choose(1000 + n % 100)
            learner.learn(smf=0.5 if n % 3 else -0.5)
            learner.choose(1000 + n % 100)
            learner.learn(1.5 - n % 4)
            if n % 100 == 0:
                for bad in ((lambda: learner.learn(1.0)), (lambda: learner.choose("x"))):
                    with contextlib.suppress(TypeError, devlearn.InvalidValue):
                        bad()

    steps(10_000)  # whatever is made once is made
    gc.collect()
    before = sys.getallocatedblocks()
    steps(20_000)
    gc.collect()
    assert sys.getallocatedblocks() - before < 200


@for_all(situations, st.integers(0, 4), finite)
def test_an_update_leaves_a_waiting_choice_waiting(situation, motion, smf):
    learner = Learner()
    choice = learner.choose(3)
    learner.update(situation, motion, smf)
    assert learner.pending == choice
    assert learner.learn(0.0).situation == 3


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("waiting", [False, True])
def test_what_is_refused_changes_nothing(waiting):
    learner = Learner(seed=5)
    history(learner, 100)
    if waiting:
        learner.choose(2)
    twin = copy.copy(learner)
    before = state(learner)
    for bad in (-1, -(2**63), 2**63, 10**30):
        refused("situation", str(bad), learner.update, bad, 0, 1.0)
        refused("situation", str(bad), learner.situation, bad)
        if not waiting:
            refused("situation", str(bad), learner.choose, bad)
    for bad in (-1, 5, 2**31, -(10**30)):
        refused("motion", str(bad), learner.update, 0, bad, 1.0)
        if waiting:
            refused("motion", str(bad), learner.learn, 1.0, bad)
    for bad in (float("nan"), float("inf"), -float("inf")):
        refused("smf", str(bad), learner.update, 0, 0, bad)
        if waiting:
            refused("smf", str(bad), learner.learn, bad)
    if waiting:
        second = "a second choice before the first met its outcome"
        refused("Learner.choose", second, learner.choose, 0)
    else:
        none = "no choice that waits for its outcome"
        refused("Learner.learn", none, learner.learn, 1.0)
        refused("Learner.learn", none, learner.learn, 1.0, 2)
        refused("Learner.cancel", none, learner.cancel)
    assert state(learner) == before
    if waiting:
        learner.learn(1.0)
        twin.learn(1.0)
    assert history(learner, 300) == history(twin, 300)


@pytest.mark.parametrize("bad", [-1, 2**32 - 1, 10**30])
def test_a_reservation_out_of_its_range_is_refused(bad):
    refused("situations", str(bad), Learner().reserve, bad)


@pytest.mark.parametrize("bad", [-1, 2**64, 10**30])
def test_a_seed_out_of_its_range_is_refused(bad):
    refused("seed", str(bad), Learner, seed=bad)


@pytest.mark.parametrize("nonsense", ["3", None, 3.5, [3], True, float("nan")])
def test_what_is_no_whole_number_is_no_situation(nonsense):
    learner = Learner()
    for call in (learner.choose, learner.situation):
        with pytest.raises(devlearn.InvalidValue, match="situation: got .*; expected a whole num"):
            call(nonsense)
    assert learner.pending is None
    assert learner.situations_experienced == 0


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda it: it.choose(), "choose.situation: got nothing; expected a whole number"),
        (
            lambda it: it.choose(3, None, 4),
            "choose: got 3 arguments; expected at most 2: situation",
        ),
        (lambda it: it.choose(3, situation=3), "choose.situation: got two values; expected one"),
        (
            lambda it: it.choose(3, place=3),
            "choose.place: got 3; expected no argument of this name",
        ),
        (lambda it: it.choose([3]), "choose.situation: got [3]; expected a whole number"),
        (lambda it: it.learn(), "learn.smf: got nothing; expected a number"),
        (lambda it: it.learn(1.0, 2, 3), "learn: got 3 arguments; expected at most 2: smf, motion"),
        (lambda it: it.learn(1.0, smf=1.0), "learn.smf: got two values; expected one"),
        (lambda it: it.learn(1.0, momentum=1), "there are smf, motion"),
        (lambda it: it.learn("1"), "learn.smf: got '1'; expected a number"),
        (lambda it: it.learn(None), "learn.smf: got None; expected a number"),
        (lambda it: it.learn(1.0, "2"), "learn.motion: got '2'; expected a whole number or None"),
    ],
)
@pytest.mark.parametrize("waiting", [False, True])
def test_wrong_arguments_are_refused_with_the_right_ones(call, says, waiting):
    learner = Learner()
    if waiting:
        learner.choose(3)
    before = state(learner)
    with pytest.raises(devlearn.WrongType) as refusal:
        call(learner)
    assert isinstance(refusal.value, TypeError)
    assert str(refusal.value).startswith("Learner.")
    assert says in str(refusal.value)
    assert state(learner) == before


def test_methods_are_of_learners_only():
    for method in (Learner.choose, Learner.learn):
        for other in (None, 3, LearnerConfig(), Learner):
            with pytest.raises(TypeError):
                method(other, 1)


# --- same seed, same history ---------------------------------------------------------------------


@for_all(configs, seeds)
def test_copies_are_independent_and_go_on_alike(config, seed):
    original = Learner(config, seed)
    history(original, 40, seed=1)
    original.choose(2)
    for copied in (copy.copy(original), copy.deepcopy(original), original.copy()):
        assert state(copied) == state(original)
        twin = copy.copy(original)
        before = state(original)
        copied.learn(1.0)
        assert state(original) == before
        twin.learn(1.0)
        assert history(copied, 40, seed=2) == history(twin, 40, seed=2)
        assert state(copied) == state(twin)


@for_all(configs, seeds)
def test_the_same_seed_gives_the_same_history(config, seed):
    ours, theirs = Learner(config, seed), Learner(config, seed)
    theirs.reserve(5000)
    assert history(ours, 100) == history(theirs, 100)
    assert state(ours) == state(theirs)


def test_another_seed_gives_another_history():
    assert history(Learner(seed=1), 50) != history(Learner(seed=2), 50)


def golden_history(config):
    """The world-free history of tests/golden/README.md, line by line."""

    def smf(situation, motion, t):
        of_mapping = (7 * situation**2 + 29 * motion + 13 * situation * motion) % 41 - 16
        return of_mapping + ((5 * t * t + 3 * t) % 17 - 8) / 4

    def developed(what, situation, development):
        counts = learner.explored_count, learner.effective_count
        values = (situation, development.motion, development.event, development.reduced, *counts)
        orientation = [o.hex() for o in learner.situation(situation << 57).orientation]
        return " ".join([what, *(str(int(value)) for value in values), *orientation])

    learner = Learner(config, seed=2020)
    situation = 0
    for t in range(5000):
        choice = learner.choose(situation << 57)
        yield f"choose {situation} {choice.motion} {int(choice.kind)}"
        ran = choice.motion
        if t % 11 == 10:
            learner.cancel()
        elif t % 13 == 12:
            ran = (ran + 1) % config.motion_count
            yield developed("learn", situation, learner.learn(smf(situation, ran, t), ran))
        else:
            yield developed("learn", situation, learner.learn(smf(situation, ran, t)))
        if t % 7 == 6:
            other, motion = (3 * situation + 1) % 37, t % config.motion_count
            development = learner.update(other << 57, motion, smf(other, motion, t))
            yield developed("update", other, development)
        situation = (3 * situation + 7 * ran + 1 + t % 2) % 37
    for situation in learner.situations().tolist():
        memory = learner.situation(situation)
        columns = memory.effective, memory.ineffective, memory.unexplored, memory.times_learned
        texts = [f"situation {situation}", *(" ".join(map(str, c)) for c in columns)]
        orientation = " ".join(o.hex() for o in memory.orientation)
        yield " ".join(" | ".join([*texts, orientation]).split())


@pytest.mark.parametrize("preset", ["paper", "step5"])
def test_python_repeats_the_golden_history_of_cpp_to_the_last_bit(preset):
    golden = (GOLDEN / f"learner_{preset}.txt").read_text().splitlines()
    lines = list(golden_history(getattr(LearnerConfig, preset)()))
    cut = golden.index("...")
    first, last = golden[1:cut], golden[cut + 1 :]
    assert lines[: len(first)] == first
    assert lines[-len(last) :] == last
    digest = 0xCBF29CE484222325  # FNV-1a
    for byte in "".join(line + "\n" for line in lines).encode():
        digest = (digest ^ byte) * 0x100000001B3 % 2**64
    assert golden[0] == f"hash {digest:016x} of {len(lines)} lines"


def test_an_explanation_and_the_trace_of_the_last_choice_say_why(paper):
    trial = devlearn.Trial(paper, seed=2)
    learner = trial.learner
    assert learner.last_choice is None
    trial.free_learning(2000)
    before = learner.to_bytes()
    for situation in learner.situations()[:100]:
        why = learner.explain(situation)
        memory = learner.situation(situation)
        assert why.memory.effective == memory.effective
        assert sum(why.probability) == pytest.approx(1.0)
        assert why.explore + why.exploit + why.exhausted == pytest.approx(1.0)
        assert len(why.op_plain) == len(why.op_curious) == len(why.winner) == len(memory.effective)
        assert len(str(why).splitlines()) == 2 + learner.config.motion_count
    assert learner.to_bytes() == before
    step = trial.step()
    trace = learner.last_choice
    assert (trace.choice.motion, trace.choice.kind) == (step.motion, step.kind)
    assert trace.explanation.situation == step.situation
    assert str(trace).startswith(f"motion {step.motion}, ")


def test_the_memory_in_use_is_told_with_what_is_spare():
    learner = devlearn.Learner()
    for situation in range(10_000):
        learner.update(situation, 0, 1.0)
    assert 82 * 10_000 <= learner.memory_use.used <= 96 * 10_000
    learner.reserve(100_000)
    assert learner.memory_use.spare >= 88 * 90_000


# --- motions that are not allowed, what is best, what is forgotten ---


def test_motions_that_are_not_allowed_are_never_named():
    learner = Learner(seed=1)
    for allowed in ([True, False, False, True, False], np.array([0, 1, 1, 0, 0], bool)):
        for i in range(300):
            assert allowed[learner.choose(i % 5, allowed).motion]
            assert learner.last_choice.explanation.allowed == list(allowed)
            learner.learn(0.3 - (i % 3) * 0.2)


@pytest.mark.parametrize(
    "allowed",
    [
        [1, 0, 1, 0, 1],
        [True, 0.0, True, True, True],
        "yes!!",
        3,
        [[True] * 5],
        [None] * 5,
        object(),
    ],
)
def test_what_is_allowed_must_be_bools(allowed):
    learner = Learner()
    with pytest.raises(
        devlearn.InvalidValue, match="^allowed: got .*; expected None, or bools, one a motion"
    ):
        learner.choose(1, allowed)
    with pytest.raises(devlearn.InvalidValue, match="^allowed: "):
        learner.explain(1, allowed)
    assert learner.situations_experienced == 0


@pytest.mark.parametrize(
    ("allowed", "message"),
    [([False] * 5, "allowed: got no motion"), ([True] * 4, "allowed: got 4 values; expected 5")],
)
def test_what_allows_nothing_or_is_not_of_its_motions_is_refused(allowed, message):
    learner = Learner()
    with pytest.raises(devlearn.InvalidValue, match=message):
        learner.choose(1, allowed)
    assert learner.pending is None
    assert learner.situations_experienced == 0


def test_the_best_motion_needs_no_draw():
    learner = Learner(seed=2)
    assert learner.best(7) is None
    learner.update(7, 3, 1.0)
    learner.update(7, 1, 1.0)
    learner.update(7, 1, 5.0)
    before = learner.to_bytes()
    assert learner.best(7) == 1
    assert learner.to_bytes() == before


def test_what_is_forgotten_is_as_if_never_experienced():
    learner = Learner()
    for situation in (4, 5, 6):
        learner.update(situation, 0, 1.0)
    assert learner.forget(4)
    assert not learner.forget(4)
    assert list(learner.situations()) == [6, 5]
    assert (learner.explored_count, learner.effective_count) == (2, 2)
    assert learner.situation(4).unexplored == [0, 1, 2, 3, 4]
    learner.choose(5)
    with pytest.raises(devlearn.InvalidValue, match="in which a choice waits"):
        learner.forget(5)


def test_a_learner_that_may_not_grow_refuses_a_situation_too_many():
    learner = Learner()
    learner.reserve(10, touch=True)
    learner.refuse_growth()
    room = learner.room
    for situation in range(room):
        learner.update(situation, 0, 1.0)
    with pytest.raises(
        devlearn.InvalidValue, match=f"situations: got {room + 1}; expected at most {room}"
    ):
        learner.choose(room)
    assert learner.forget(0)
    learner.choose(room)
