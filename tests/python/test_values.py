"""What devlearn gives is a value: shown, compared, pickled and copied as one."""

import copy
import pickle

import devlearn
import numpy as np
import pytest
from devlearn import Robot, RobotDef, Trial, World, _core, agents, tasks


class Keeper:
    """Keeps what it is shown."""

    def choose(self, observation):
        self.observation = observation
        return int(np.flatnonzero(observation.allowed)[0]) if observation.allowed is not None else 2

    def observe(self, outcome):
        self.outcome = outcome


def kept():
    keeper = Keeper()
    robot = RobotDef(safety_margin=0.09)
    world = World(width=1.5, height=1.5, start=(0.22, 0.75, 180), target=(1.2, 1.2))
    Trial(world, devlearn.TrialConfig(robot=robot), agent=keeper).step()
    return keeper


VALUE_AGENTS = [agent for agent in vars(agents).values() if hasattr(agent, "Config")]
TASKS = [task for task in vars(tasks).values() if hasattr(task, "Config")]


def explanations():
    """What the agents that explain themselves say in their tasks."""
    attention = tasks.Attention()
    for task, agent in (
        (attention, agents.Iac(motors=attention.motors)),
        (tasks.Balance(), agents.OperantConditioning()),
        (tasks.Playroom(), agents.SalientEvents()),
        (tasks.Foraging(), agents.Appraisal()),
    ):
        tasks.run(task, agent, 1, step_limit=2000)
        task.begin(seed=1)
        seen = task.observation()
        agent.choose(seen)
        agent.cancel()
        why = agent.explain(seen if isinstance(agent, agents.Iac) else seen.situation)
        yield why
        yield from getattr(why, "options", getattr(why, "regions", []))[:1]


def things():
    world = World.load("paper")
    trial = Trial(world, seed=1)
    trial.run(200)
    adaptive = Trial(world, devlearn.TrialConfig.adaptive(), seed=1)
    adaptive.run(200)
    keeper = kept()
    assert keeper.observation.allowed is not None
    return {
        type(thing).__name__: thing
        for thing in (
            world, Robot(world), devlearn.SituationGrid(3, 4, origin=(1, 2)),
            devlearn.Random(3, "x"), trial.step(), trial.learner.explain(0, [True] * 4 + [False]),
            trial.learner.last_choice, devlearn.Choice(1), devlearn.Pose(1, 2, 3), RobotDef(),
            devlearn.Circle((1, 1), 1), devlearn.Rectangle((1, 1), (1, 1)),
            devlearn.Polygon([(1, 1), (2, 1), (2, 2)]), devlearn.Polyline([(1, 1), (2, 1)]),
            devlearn.StateEvaluation(),
            devlearn.LearnerConfig(), devlearn.TrialConfig(), devlearn.BatchConfig(),
            devlearn.NoiseDef(),
            trial.learner.situation(760),
            MOVER, MOVER.course, devlearn.MoverWalk(1, (1, 1), (2, 2), 3),
            devlearn.AdaptiveConfig(), adaptive.learner.last_choice,
            adaptive.learner.situation(760), adaptive.learner.last_choice.recollections[0],
            trial.learner.memory_use, keeper.observation, keeper.outcome, trial.run(3),
            *(agent.Config() for agent in VALUE_AGENTS), *(task.Config() for task in TASKS),
            tasks.TwoWheeledDef(), *explanations(),
        )
    }  # fmt: skip


MOVER = devlearn.Mover(devlearn.Circle((0, 0), 1), devlearn.MoverPath([(1, 1), (2, 1)], 0.1))
THINGS = things()
CORNERS = [(1, 1), (2, 1), (2, 2)]


@pytest.mark.parametrize("name", THINGS)
def test_it_is_the_same_after_pickling_and_copying(name):
    thing = THINGS[name]
    for again in (pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)):
        assert type(again) is type(thing)
        assert repr(again) == repr(thing)
        if name != "Robot":
            assert again == thing
        assert (again == 3) is False
    if name == "Robot":
        again = pickle.loads(pickle.dumps(thing))
        assert again.step((1, 1, 0), 2) == thing.step((1, 1, 0), 2)


def test_what_differs_is_not_equal():
    trial = Trial(World.load("paper"), seed=1)
    assert trial.step() != trial.step()
    assert devlearn.Random(1, "x") != devlearn.Random(2, "x")
    assert devlearn.SituationGrid(3) != devlearn.SituationGrid(4)
    assert trial.learner.explain(0) != trial.learner.explain(1)


@pytest.mark.parametrize(
    "name",
    [
        *THINGS,
        "Learner",
        "Trial",
        "RandomAgent",
        "ShortestPath",
        "Batch",
        "BatchRows",
        *(a.__name__ for a in VALUE_AGENTS),
    ],
)
def test_its_repr_says_more_than_where_it_lies(name):
    world = World.load("paper")
    more = {
        "Learner": devlearn.Learner(), "Trial": Trial(world), "RandomAgent": devlearn.RandomAgent(),
        "ShortestPath": devlearn.shortest_path(Robot(world)),
        "Batch": devlearn.Batch(world, 2), "BatchRows": devlearn.Batch(world, 2).rows,
        "ShortestPathAgent": agents.ShortestPathAgent(Robot(world)),
        **{agent.__name__: agent() for agent in VALUE_AGENTS},
    }  # fmt: skip
    text = repr({**THINGS, **more}[name])
    assert name in text
    assert " object at 0x" not in text


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: devlearn.Circle((1, 1), -1), "Circle.radius: got -1; expected in [0.01, 1000] m"),
        (lambda: devlearn.Circle((1, np.nan), 1), "Circle.center[1]: got nan"),
        (lambda: devlearn.Rectangle((1, 1), (1, 0)), "Rectangle.size[1]: got 0"),
        (lambda: devlearn.Rectangle((1, 1), (1, 1), 400), "Rectangle.angle: got 400"),
        (lambda: devlearn.Polygon([(1, 1), (2, 2)]), "Polygon.corners: got 2 corners"),
        (lambda: devlearn.Polygon([(1, 1), (2, 2), (3, np.inf)]), "Polygon.corners[2][1]: got inf"),
        (lambda: devlearn.Polygon(CORNERS, [[]]), "Polygon.holes[0]: got 0 corners"),
        (
            lambda: devlearn.Polygon(CORNERS, [CORNERS, [*CORNERS, (1, np.nan)]]),
            "Polygon.holes[1][3][1]: got nan",
        ),
        (
            lambda: devlearn.Polyline([(1, 1)]),
            "Polyline.points: got 1 points; expected 2 to 100000",
        ),
        (lambda: devlearn.Polyline([(1, 1), (np.inf, 1)]), "Polyline.points[1][0]: got inf"),
    ],
)
def test_a_shape_that_cannot_be_is_refused_where_it_is_made(make, says):
    with pytest.raises(devlearn.InvalidValue) as refused:
        make()
    assert str(refused.value).startswith(says)


def test_every_class_of_the_module_is_among_these():
    classes = {n for n, c in vars(_core).items() if isinstance(c, type) and not n.startswith("_")}
    others = {"Kind", "Event", "Learner", "Trial", "RandomAgent", "ShortestPath", "SituationMemory"}
    others |= {"AdaptiveLearner", "ShortestPathAgent", "Tally", "Batch", "BatchRows"}
    others |= {"Task", *(one.__name__ for one in (*VALUE_AGENTS, *TASKS))}
    assert classes <= {*THINGS, *others}
