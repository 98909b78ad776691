"""Whatever is given to whatever is public is taken, or refused by name and in words."""

import inspect
import pickle

import devlearn
import numpy as np
import pytest
from devlearn import (
    InvalidValue,
    Learner,
    LearnerConfig,
    Robot,
    Trial,
    TrialConfig,
    World,
    WrongType,
    _core,
    agents,
    tasks,
)

WORLD = World.load("empty")


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: Trial("paper"), "Trial.world: got 'paper'; expected a World, as World.load(name)"),
        (lambda: Trial(WORLD, 3), "Trial.config: got 3; expected a TrialConfig or None"),
        (
            lambda: Trial(WORLD).free_learning("10"),
            "Trial.free_learning.steps: got '10'; expected a",
        ),
        (lambda: Trial(WORLD, seed=None), "Trial.seed: got None; expected a whole number"),
        (lambda: Trial(), "Trial.world: got nothing; expected a World"),
        (lambda: Learner(2), "Learner.config: got 2; expected a LearnerConfig or None"),
        (lambda: Learner(motion_count=2), "which is a field of LearnerConfig; there are config"),
        (
            lambda: TrialConfig(sigma=0.3),
            "TrialConfig.sigma: got 0.3; expected no argument of this",
        ),
        (lambda: TrialConfig(learner={}), "TrialConfig.learner: got {}; expected a LearnerConfig"),
        (lambda: LearnerConfig(eta="x"), "LearnerConfig.eta: got 'x'; expected a number"),
        (
            lambda: World(start=(1, 1)),
            "World.start: got (1, 1); expected three numbers: x, y [m] an",
        ),
        (
            lambda: World(obstacles=[3]),
            "World.obstacles: got [3]; expected a list, each a Circle or",
        ),
        (
            lambda: devlearn.Circle((1, 2, 3), 1),
            "Circle.center: got (1, 2, 3); expected two numbers",
        ),
        (
            lambda: devlearn.Polygon([(1, 2), (3,)]),
            "Polygon.corners: got [(1, 2), (3,)]; expected a",
        ),
        (
            lambda: devlearn.Polygon([(1, 2), (3, 2), (3, 3)], holes=[[(2, 2), 5]]),
            "Polygon.holes: got [[(2, 2), 5]]; expected a list, each a list, each two numbers",
        ),
        (
            lambda: devlearn.Polyline([(1, 2), (3,)]),
            "Polyline.points: got [(1, 2), (3,)]; expected a list, each two numbers",
        ),
        (lambda: devlearn.shortest_path(WORLD), "expected a Robot, as Robot(world) makes"),
        (
            lambda: Robot(WORLD).step((1, 2), 1),
            "Robot.step.pose: got (1, 2); expected three numbers",
        ),
        (lambda: WORLD.clearance("a", 1), "World.clearance.x: got 'a'; expected a number"),
        (lambda: devlearn.direction("x"), "direction."),
        (lambda: World.load(3), "path: got 3; expected text, bytes or an os.PathLike"),
        (lambda: Learner.load(None), "path: got None; expected text"),
        (lambda: Trial(WORLD).save(1.5), "path: got 1.5; expected text"),
        (lambda: devlearn.Record.load(3), "path: got 3; expected text"),
        (lambda: devlearn.StateEvaluation.scaled("5", 1), "StateEvaluation.scaled.arena: got '5'"),
        (
            lambda: World.random("clutter", "1"),
            "World.random.seed: got '1'; expected a whole number",
        ),
    ],
)
def test_a_mistake_is_told_by_argument_value_and_what_is_wanted(call, says):
    with pytest.raises(WrongType) as refused:
        call()
    assert says in str(refused.value)
    assert isinstance(refused.value, (InvalidValue, TypeError, ValueError))
    assert "incompatible" not in str(refused.value)
    again = pickle.loads(pickle.dumps(refused.value))
    assert (type(again), str(again)) == (WrongType, str(refused.value))


def test_fractions_are_no_whole_numbers_and_whole_floats_are():
    with pytest.raises(InvalidValue, match="SituationGrid.columns: got 0.25; expected a whole"):
        devlearn.SituationGrid(5, 5, 0.25)
    assert LearnerConfig(motion_count=3.0).motion_count == 3
    assert len(Trial(WORLD).run(np.float64(10))) == 10
    learner = Learner()
    assert learner.choose(4.0)
    assert learner.learn(1.0).situation == 4


class Stubborn:
    """Whatever is asked of it, it refuses."""

    def __repr__(self):
        raise RuntimeError("no repr")


ODD = [
    None, "text", "\ud800", b"bytes", object(), Stubborn(), (), (1, 2), [1, "b"], 0.5, -1, 10**400,
    float("nan"), float("inf"), True, {}, {"a": 1}, 1j, np.zeros((2, 2)), np.array(["a"]), WORLD,
    LearnerConfig(), int, lambda: None,
]  # fmt: skip


# What is only had from a call has no constructor, and says so.
RESULTS = {
    "AdaptiveExplanation", "AdaptiveMemory", "AppraisalExplanation", "BatchRows", "ChoiceTrace",
    "ConditioningExplanation",
    "Explanation", "MemoryUse", "Recollection", "ShortestPath", "SituationMemory", "Step", "Task",
    "OptionView", "SalientEventsExplanation",
    "IacExplanation", "IacRegion",
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(RESULTS))
def test_a_result_cannot_be_made_by_hand(name):
    with pytest.raises(TypeError, match=f"{name}: No constructor defined"):
        getattr(_core, name)(1)


def public():
    """Every function, method and class of the compiled module, with how to get a bound one."""
    instances = {
        "Learner": Learner(), "World": WORLD, "Robot": Robot(WORLD), "Trial": Trial(WORLD),
        "Random": devlearn.Random(1, "x"), "SituationGrid": devlearn.SituationGrid(),
        "StateEvaluation": devlearn.StateEvaluation(), "LearnerConfig": LearnerConfig(),
        "TrialConfig": TrialConfig(), "RobotDef": devlearn.RobotDef(),
        "RandomAgent": devlearn.RandomAgent(), "Batch": devlearn.Batch(WORLD, 2),
        **{
            name: agent(Robot(WORLD)) if name == "ShortestPathAgent" else agent()
            for name, agent in vars(agents).items()
            if name in agents.__all__ and name not in RESULTS
        },
        **{
            name: task()
            for name, task in vars(tasks).items()
            if inspect.isclass(task) and issubclass(task, tasks.Task) and task is not tasks.Task
        },
        "AdaptiveLearner": devlearn.AdaptiveLearner(), "AdaptiveConfig": devlearn.AdaptiveConfig(),
    }  # fmt: skip
    for name in dir(_core):
        thing = getattr(_core, name)
        if name.startswith("_") or not callable(thing):
            continue
        if name not in RESULTS:
            yield name, thing
        if inspect.isclass(thing) and name in instances:
            for method in dir(thing):
                if not method.startswith("_"):
                    bound = getattr(instances[name], method)
                    if callable(bound) and method not in ("save", "save_csv"):
                        yield f"{name}.{method}", bound


# Files are written to what they are told; threads.py's are its own.
LEAVE = {"write_file", "Kind", "Event"}


@pytest.mark.parametrize(("name", "call"), [p for p in public() if p[0] not in LEAVE])
def test_no_odd_argument_is_met_with_a_list_of_signatures(name, call, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    one = [(odd,) for odd in ODD]
    two = [(odd, odd) for odd in ODD] + [(1, odd) for odd in ODD]
    for arguments in [*one, *two, (1,) * 12]:
        try:
            call(*arguments)
        except (InvalidValue, OverflowError, MemoryError):
            pass
        except (TypeError, RuntimeError, UnicodeError) as error:
            # What an object of the caller's raises itself passes through.
            assert "incompatible" not in str(error), (name, arguments)
            assert "supported" not in str(error), (name, arguments)
    with pytest.raises(InvalidValue, match=r"no argument of this name|expected none|unknown field"):
        call(**{"no such": 1})
