"""Bad input: every refusal is an InvalidValue or a TypeError, whole, and changes nothing."""

import concurrent.futures
import copy
import json
import multiprocessing
import pickle

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import (
    Choice,
    Circle,
    FileError,
    InvalidValue,
    Kind,
    Learner,
    LearnerConfig,
    Polygon,
    Polyline,
    Random,
    RandomAgent,
    Record,
    Rectangle,
    Robot,
    RobotDef,
    SituationGrid,
    StateEvaluation,
    Trial,
    TrialConfig,
    World,
)
from hypothesis import example, given, settings
from hypothesis import strategies as st

# --- the two exceptions --------------------------------------------------------------------------


def test_a_refusal_says_quantity_value_and_what_is_allowed():
    error = refused(lambda: LearnerConfig(sigma=2), "LearnerConfig.sigma", "2")
    assert error.allowed == "in (0, 1)"
    assert str(error) == "LearnerConfig.sigma: got 2; expected in (0, 1)"
    assert type(error) is InvalidValue
    assert not isinstance(error, OSError)


def test_a_files_refusal_says_file_and_field_too_and_is_an_oserror():
    with pytest.raises(FileError) as caught:
        World.from_json('{"format": "x"}')
    error = caught.value
    assert isinstance(error, (InvalidValue, OSError))
    assert isinstance(error, ValueError)
    assert (error.file, error.field, error.quantity) == ("JSON text", "format", "format")
    assert error.value == '"x"'
    assert error.filename == "JSON text"
    assert error.errno is None
    assert str(error) == f'JSON text: format: got "x"; expected {error.allowed}'


ERRORS = [
    InvalidValue("a", 3, "b"),
    InvalidValue("", None, ""),
    FileError("file", "field", "value", "allowed"),
    FileError("file", "", 2, "allowed"),
]


@pytest.mark.parametrize("kind", ["", "paper", None, 1, ["adaptive"]])
def test_a_learner_of_no_known_kind_is_refused_by_name(kind):
    fields = {"learner": {"kind": kind}}
    error = refused(lambda: devlearn.TrialConfig.from_dict(fields), "TrialConfig.learner.kind")
    assert error.value == repr(kind)


@pytest.mark.parametrize("error", ERRORS)
def test_errors_survive_pickling_and_copying(error):
    error.add_note("noted") if hasattr(error, "add_note") else None
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        for again in (
            pickle.loads(pickle.dumps(error, protocol)),
            copy.copy(error),
            copy.deepcopy(error),
        ):
            assert type(again) is type(error)
            assert str(again) == str(error)
            for name in ("quantity", "value", "allowed", "file", "field", "filename", "args"):
                assert getattr(again, name, None) == getattr(error, name, None)


def refuse_in_a_process(what):
    if what == "file":
        World.load("/nowhere/at all")
    return Trial(World(), seed=1).run(-1)


def test_errors_come_back_whole_from_a_process_pool():
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as pool:
        for what, kind, quantity in (("file", FileError, ""), ("value", InvalidValue, "steps")):
            with pytest.raises(kind) as caught:
                pool.submit(refuse_in_a_process, what).result(timeout=60)
            assert type(caught.value) is kind
            assert caught.value.quantity == quantity


def test_an_unpicklable_value_is_told_as_text():
    error = pickle.loads(pickle.dumps(InvalidValue("agent", lambda: 0, "an agent")))
    assert "lambda" in error.value


# --- configurations ------------------------------------------------------------------------------

PRESETS = [TrialConfig.paper(), TrialConfig.step5()]
CONFIGS = [
    *PRESETS,
    TrialConfig(
        learner=LearnerConfig(motion_count=3, eta=0.1, c1=0, on_negative="weaken"),
        evaluation=StateEvaluation(a1=-1.5, a5=0),
        robot=RobotDef(track=0.2, steering_angles=[-10, 0.1, 10], sonar_fov=360),
        clearance_source="sonar",
        walls_count=True,
        goal_radius=0.30000000000000004,
        cell_size=1 / 3,
        heading_bins=36,
    ),
]


@pytest.mark.parametrize("config", CONFIGS)
def test_a_configuration_survives_dict_json_pickle_copy_and_repr(config):
    for again in (
        TrialConfig.from_dict(config.to_dict()),
        TrialConfig.from_dict(json.loads(json.dumps(config.to_dict()))),
        pickle.loads(pickle.dumps(config)),
        copy.copy(config),
        copy.deepcopy(config),
        eval(repr(config), {name: getattr(devlearn, name) for name in devlearn.__all__}),
        config.replace(),
        config.replace(**config.to_dict()),
    ):
        assert again == config
        assert hash(again) == hash(config)
        assert again.to_dict() == config.to_dict()


def test_presets_differ_in_two_options_and_every_field_counts():
    paper, step5 = (preset.to_dict() for preset in PRESETS)
    assert TrialConfig() == PRESETS[0]
    assert PRESETS[0] != PRESETS[1]
    paper["learner"] |= {"on_negative": "weaken", "when_exhausted": "wander"}
    assert paper == step5
    for changes in (
        {"learner": LearnerConfig(eta=0.1)},
        {"evaluation": StateEvaluation(a1=1)},
        {"robot": RobotDef(radius=0.2)},
        {"walls_count": True},
        {"walls_count": True, "clearance_source": "sonar"},
        {"goal_radius": 0.2},
        {"cell_size": 0.5},
        {"heading_bins": 8},
    ):
        assert TrialConfig().replace(**changes) != TrialConfig()
        assert TrialConfig(**changes) == TrialConfig().replace(**changes)


@pytest.mark.parametrize("kind", [LearnerConfig, StateEvaluation, RobotDef, TrialConfig])
def test_unknown_fields_are_refused_by_name(kind):
    refused(lambda: kind.from_dict({"colour": 1}), f"{kind.__name__}.colour", "an unknown field")
    refused(lambda: kind().replace(colour=1), f"{kind.__name__}.colour")
    refused(lambda: kind.from_dict({3: 1}), f"{kind.__name__}.3")
    with pytest.raises(TypeError):
        kind(colour=1)
    for nothing in (None, 3, "x", [("eta", 1)]):
        with pytest.raises(TypeError):
            kind.from_dict(nothing)


def test_unknown_fields_are_refused_at_any_depth():
    fields = TrialConfig().to_dict()
    fields["robot"]["wheels"] = 3
    refused(lambda: TrialConfig.from_dict(fields), "RobotDef.wheels")


NAN, INF = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("kind", "quantity", "field", "bad"),
    [
        *[(LearnerConfig, "LearnerConfig.eta", "eta", v) for v in (0, 1, -1, NAN, INF)],
        *[(LearnerConfig, "LearnerConfig.sigma", "sigma", v) for v in (0, 1, NAN)],
        *[(LearnerConfig, "LearnerConfig.c1", "c1", v) for v in (-1, 1.1e6, NAN)],
        *[(LearnerConfig, "LearnerConfig.c2", "c2", v) for v in (INF, NAN)],
        *[
            (LearnerConfig, "LearnerConfig.motion_count", "motion_count", v)
            for v in (0, -1, 65536, 2**31, 2**64, -(10**30))
        ],
        *[(LearnerConfig, "LearnerConfig.on_negative", "on_negative", v) for v in ("", "Abandon")],
        *[(LearnerConfig, "LearnerConfig.when_exhausted", "when_exhausted", "x\0")],
        *[(RobotDef, "RobotDef.radius", "radius", v) for v in (0, 0.009, 11, NAN, INF)],
        *[(RobotDef, "RobotDef.speed", "speed", v) for v in (0, -1, 11, NAN)],
        *[(RobotDef, "RobotDef.sample_time", "sample_time", v) for v in (0, 11, NAN)],
        *[(RobotDef, "RobotDef.speed * sample_time", "speed", v) for v in (9,)],
        *[(RobotDef, "RobotDef.track", "track", v) for v in (0, -1, 11, NAN)],
        *[(RobotDef, "RobotDef.steering_angles", "steering_angles", v) for v in ([], ())],
        *[
            (RobotDef, "RobotDef.steering_angles[1]", "steering_angles", v)
            for v in ([0, NAN], [0, 361])
        ],
        *[(RobotDef, "RobotDef.sonar_count", "sonar_count", v) for v in (-1, 721, 2**31, 2**70)],
        *[(RobotDef, "RobotDef.sonar_fov", "sonar_fov", v) for v in (-1, 361, NAN)],
        *[(RobotDef, "RobotDef.sonar_range", "sonar_range", v) for v in (0, 101, NAN)],
        *[(TrialConfig, "TrialConfig.goal_radius", "goal_radius", v) for v in (0, 101, NAN)],
        *[(TrialConfig, "TrialConfig.cell_size", "cell_size", v) for v in (0, 1001, NAN)],
        *[
            (TrialConfig, "TrialConfig.heading_bins", "heading_bins", v)
            for v in (0, 3601, 2**31, -(2**64))
        ],
        *[(TrialConfig, "TrialConfig.clearance_source", "clearance_source", "echo")],
    ],
)
def test_a_field_out_of_range_is_refused_by_name(kind, quantity, field, bad):
    config = kind()
    refused(lambda: kind(**{field: bad}), quantity)
    refused(lambda: kind.from_dict({field: bad}), quantity)
    refused(lambda: config.replace(**{field: bad}), quantity)
    assert config == kind()


def test_motions_and_steering_angles_agree_or_are_refused():
    refused(
        lambda: TrialConfig(learner=LearnerConfig(motion_count=4)),
        "TrialConfig.learner.motion_count",
        "4",
    )


# --- whole numbers -------------------------------------------------------------------------------

SEEDED = [
    lambda seed: Learner(seed=seed).seed,
    lambda seed: Trial(World(), seed=seed).seed,
    lambda seed: Random(seed, "x").next() and seed,
    lambda seed: RandomAgent(seed) and seed,
]


@pytest.mark.parametrize("make", SEEDED)
def test_seeds_are_all_whole_numbers_of_64_bits(make):
    for seed in (0, 1, 2**63, 2**64 - 1, np.uint64(2**64 - 1), np.int8(5), 3.0, np.float64(4)):
        assert make(seed) == seed
    for seed in (-1, 2**64, -(2**63), 10**100, np.int64(-1)):
        refused(lambda seed=seed: make(seed), "seed", str(seed))
    for seed in (1.5, NAN, INF, True):
        refused(lambda seed=seed: make(seed), "seed", str(seed))
    for seed in ("1", b"1", None, [1], 1j):
        with pytest.raises(devlearn.WrongType, match=r"seed: got .*; expected a whole number"):
            make(seed)


@pytest.mark.parametrize("count", [0, -1, 2**32, 2**64, -(10**30)])
def test_counts_to_draw_from_are_refused_out_of_range(count):
    random = Random(1, "x")
    refused(lambda: random.index(count), "count", str(count))
    assert random.next() == Random(1, "x").next()


@pytest.mark.parametrize("count", [-1, 2**32 - 1, 2**64, 10**30])
def test_reservations_out_of_range_are_refused(count):
    refused(lambda: Learner().reserve(count), "situations", str(count))


# --- anything at all -----------------------------------------------------------------------------

ODD = [
    None,
    True,
    "",
    "paper",
    "\0",
    "\ud800",
    b"\xff",
    NAN,
    INF,
    -INF,
    -0.0,
    5e-324,
    1e308,
    -1,
    0,
    3,
    2**31,
    2**32,
    2**62,
    2**63,
    2**64,
    -(2**31) - 1,
    -(2**63) - 1,
    10**400,
    1j,
    (),
    [],
    {},
    {"eta": 0.5},
    (1, 2),
    (1, 2, 3),
    (1, 2, NAN),
    ("1", "2"),
    [[1, 2]] * 3,
    [None],
    range(10**6),
    object(),
    int,
    lambda: 0,
    np.float32(2),
    np.int64(2),
    np.bool_(True),
    np.datetime64("NaT"),
    np.array(2.0),
    np.array([1.0, 2.0]),
    np.array([1, 2, 3]),
    np.array([NAN]),
    np.array(["a"]),
    np.empty(0),
    Kind.EXPLORE,
    Choice(1),
    Circle((1, 1), 0.2),
    LearnerConfig(),
    TrialConfig(),
    World(),
    Learner(),
]
anything = st.one_of(
    st.sampled_from(ODD),
    st.floats(),
    st.integers(-100, 100) | st.integers(),
    st.text(max_size=20),
    st.binary(max_size=20),
    st.lists(st.floats() | st.none(), max_size=4),
    st.tuples(st.floats(), st.floats()),
    st.tuples(st.floats(), st.floats(), st.floats()),
    st.dictionaries(st.text(max_size=8), st.floats(), max_size=3),
)


def brief(steps):
    """A run of a million steps is allowed and takes its time."""
    return 3 if isinstance(steps, int) and 1000 < steps <= 2**40 else steps


def trial():
    return Trial(World.load("paper"), seed=1)


# Each call with arguments that it takes.
CALLS = [
    (LearnerConfig, (5, 0.05, 0.3, 0.5, 1.0, "abandon", "retry")),
    (LearnerConfig.from_dict, ({},)),
    (lambda *a: LearnerConfig().replace(eta=a[0], c1=a[1]), (0.5, 1)),
    (Learner, (LearnerConfig(), 3)),
    (lambda *a: Learner().choose(*a), (3,)),
    (lambda *a: chosen().learn(*a), (1.0, 2)),
    (lambda *a: Learner().update(*a), (3, 2, 1.0)),
    (lambda *a: Learner().situation(*a), (3,)),
    (lambda *a: Random(*a).index(3), (3, "x")),
    (lambda *a: Random(1, "x").index(*a), (3,)),
    (Choice, (3, Kind.EXPLORE)),
    (SituationGrid, (5.0, 5.0, 20, 20, 12)),
    (lambda *a: SituationGrid().situation(*a), (1.0, 2.0, 3.0)),
    (lambda *a: SituationGrid().centre(*a), (3,)),
    (StateEvaluation, (20, 0.3, 0.2, 5, 12)),
    (lambda *a: StateEvaluation()(*a), (1.0, 2.0)),
    (Circle, ((1, 1), 0.2)),
    (Rectangle, ((1, 1), (0.2, 0.3), 4)),
    (Polygon, ([(1, 1), (2, 1), (2, 2)], [[(1.5, 1.1), (1.8, 1.1), (1.8, 1.3)]])),
    (Polyline, ([(1, 1), (2, 1), (2, 2)],)),
    (World, (5, 5, (0.5, 0.5, 0), (4.5, 4.5), [], "name", "description")),
    (lambda *a: World(obstacles=[*a]), (Circle((2, 2), 0.2),)),
    (lambda *a: World(obstacles=[Circle(*a)]), ((2, 2), 0.2)),
    (lambda *a: World(obstacles=[Rectangle(*a)]), ((2, 2), (0.2, 0.3), 4)),
    (lambda *a: World(obstacles=[Polygon([*a])]), ((2, 2), (3, 2), (3, 3))),
    (
        lambda *a: World(obstacles=[Polygon([(2, 2), (3, 2), (3, 3)], [[*a]])]),
        ((2.5, 2.1), (2.8, 2.1), (2.8, 2.3)),
    ),
    (lambda *a: World(obstacles=[Polyline([*a])]), ((2, 2), (3, 2), (3, 3))),
    (World.load, ("paper",)),
    (World.from_json, (World().to_json(),)),
    (lambda *a: World().with_start(*a), ((1, 1, 0),)),
    (lambda *a: World.load("paper").clearance(*a), (1.0, 2.0, True)),
    (RobotDef, (0.1, 0.1, 0.5, 0.1, (-60, 0, 60), 5, 180, 2.0)),
    (RobotDef.from_dict, ({},)),
    (Robot, (World(), RobotDef())),
    (lambda *a: Robot(World()).step(*a), ((1, 1, 0), 2)),
    (lambda *a: Robot(World()).sonar(*a), ((1, 1, 0),)),
    (lambda *a: Robot(World()).turn_speeds(*a), (2,)),
    (
        TrialConfig,
        (LearnerConfig(), StateEvaluation(), RobotDef(), "geometric", True, 0.1, 0.25, 12),
    ),
    (TrialConfig.from_dict, ({},)),
    (Trial, (World(), TrialConfig(), 3, None)),
    (lambda *a: trial().run(brief(a[0]), echoes=a[1]), (3, True)),
    (lambda *a: trial().free_learning(brief(a[0]), echoes=a[1]), (3, True)),
    (lambda *a: trial().path_learning(brief(a[0]), brief(a[1]), echoes=a[2]), (2, 3, True)),
    (lambda *a: trial().place(*a), (2, 1.5, 0)),
    (Record, ({}, {})),
    (Record.load, ("/nowhere/at all",)),
]


def chosen():
    learner = Learner()
    learner.choose(3)
    return learner


def answers(call, arguments):
    """Whether a call succeeds; fails where it raises anything but a refusal."""
    try:
        call(*arguments)
    except InvalidValue as error:
        assert error.allowed
        assert str(error).endswith(f": got {error.value}; expected {error.allowed}")
        return False
    except TypeError:
        return False
    return True


def test_the_calls_to_be_tried_are_right_to_begin_with():
    refusals = [call for call, arguments in CALLS if not answers(call, arguments)]
    assert len(refusals) == 2  # Record's


@pytest.mark.parametrize("odd", range(len(ODD)))
def test_no_odd_argument_does_worse_than_be_refused(odd):
    for call, arguments in CALLS:
        for i in range(len(arguments)):
            answers(call, (*arguments[:i], ODD[odd], *arguments[i + 1 :]))


@settings(max_examples=400)
@given(st.sampled_from(CALLS), st.data())
@example((CALLS[0][0], (None,) * 7), None)
def test_no_argument_at_all_does_worse_than_be_refused(call_and_arguments, data):
    call, arguments = call_and_arguments
    if data is not None:
        arguments = [data.draw(anything | st.just(a)) for a in arguments]
    answers(call, arguments)


def test_a_refused_call_leaves_trial_and_learner_as_they_were(paper):
    plain, tried = Trial(paper, seed=1), Trial(paper, seed=1)
    motions = []
    for odd in ODD:
        for call in (
            lambda odd=odd: tried.place(odd, -9, odd),
            lambda odd=odd: tried.run("x", echoes=odd),
            lambda odd=odd: tried.path_learning(odd, -1),
            lambda odd=odd: tried.learner.choose("x"),
            lambda odd=odd: tried.learner.update(-1, odd, odd),
            lambda odd=odd: tried.learner.update(1, 99, odd),
            lambda odd=odd: tried.learner.learn(odd),
            tried.learner.cancel,
        ):
            assert not answers(call, ())
        motions.append(tried.step().motion)
    assert motions == plain.run(len(ODD)).motion.tolist()
    assert tried.round == 1
    assert tried.interrupted is None
