"""Fields over the arena: SEF, and what a learner prefers."""

import math

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import StateEvaluation, World
from devlearn.analysis.fields import preference_field, sef_field


def test_sef_is_that_of_each_point_of_the_mesh(paper):
    evaluation = StateEvaluation(a1=10.0)
    field = sef_field(paper, evaluation, points=11)
    assert field.sef.shape == (11, 11)
    np.testing.assert_allclose(field.x, np.linspace(0, paper.width, 11))
    for row, column in np.ndindex(11, 11):
        x, y = field.x[column], field.y[row]
        goal = math.hypot(x - paper.target[0], y - paper.target[1])
        expected = evaluation(goal, paper.clearance(x, y))
        assert field.sef[row, column] == pytest.approx(expected, rel=1e-12)


def test_a_record_gives_sef_by_its_own_configuration(paper):
    config = devlearn.TrialConfig(walls_count=True, evaluation=StateEvaluation(a1=12.0))
    record = devlearn.Trial(paper, config).run(1)
    own, default = sef_field(record, points=5), sef_field(paper, points=5)
    explicit = sef_field(paper, config.evaluation, True, 5)
    np.testing.assert_array_equal(own.sef, explicit.sef)
    assert (own.sef != default.sef).any()


def test_the_mesh_of_an_oblong_arena_is_as_fine_both_ways():
    field = sef_field(World(4, 2, (0.5, 0.5, 0), (3.5, 1.5)), points=9)
    assert (len(field.x), len(field.y)) == (9, 5)
    assert np.diff(field.x) == pytest.approx(0.5) and np.diff(field.y) == pytest.approx(0.5)


def test_the_floor_lies_half_the_targets_range_below_its_least_or_at_the_least_sef(paper):
    field, open_field = sef_field(paper, points=51), sef_field(World(), points=51)
    goal = np.hypot(*np.meshgrid(field.x - paper.target[0], field.y - paper.target[1]))
    term = np.asarray(StateEvaluation()(goal, np.full_like(goal, np.inf)))
    assert field.floor == pytest.approx(term.min() - 0.5 * np.ptp(term))
    assert field.sef.min() < field.floor
    assert open_field.floor == open_field.sef.min()  # no obstacles, no pits
    assert sef_field(paper, points=5, floor=3.0).floor == 3.0


def test_a_mesh_of_one_point_is_refused(paper):
    refused(lambda: sef_field(paper, points=1), "points", "1")


def learned(*outcomes):
    """A learner, a grid of 0.25 m, and for each (pose, motion, smf) an update."""
    grid = devlearn.SituationGrid()
    learner = devlearn.Learner(seed=0)
    for pose, motion, smf in outcomes:
        learner.update(grid.situation(*pose), motion, smf)
    return learner, grid


def test_an_arrow_points_where_the_preferred_motion_leads():
    # Heading 90 degrees, motion 1 turns by -30.
    learner, grid = learned(((0.3, 0.3, 90.0), 1, 1.0))
    field = preference_field(devlearn.World(), learner, grid=grid)
    assert (field.x.item(), field.y.item()) == (0.375, 0.375)
    np.testing.assert_allclose((field.u.item(), field.v.item()), (0.5, math.sqrt(0.75)), atol=1e-12)
    assert field.times.item() == 1


def test_the_motion_of_the_highest_orientation_is_the_preferred_one():
    learner, grid = learned(
        ((0.3, 0.3, 0.0), 0, 1.0), ((0.3, 0.3, 0.0), 4, 1.0), ((0.3, 0.3, 0.0), 4, 5.0)
    )
    field = preference_field(devlearn.World(), learner, grid=grid)
    assert math.degrees(math.atan2(field.v.item(), field.u.item())) == pytest.approx(60.0)


def test_headings_that_disagree_shorten_the_arrow():
    # Straight on, to the east and to the north, equally often; then to the west.
    east, north = ((0.3, 0.3, 0.0), 2, 1.0), ((0.3, 0.3, 90.0), 2, 1.0)
    learner, grid = learned(east, north)
    field = preference_field(devlearn.World(), learner, grid=grid)
    np.testing.assert_allclose((field.u.item(), field.v.item()), (0.5, 0.5), atol=1e-12)
    learner, grid = learned(east, ((0.3, 0.3, 180.0), 2, 1.0))
    field = preference_field(devlearn.World(), learner, grid=grid)
    np.testing.assert_allclose((field.u.item(), field.v.item()), (0, 0), atol=1e-12)


def test_what_was_learned_more_often_weighs_more():
    east, north = ((0.3, 0.3, 0.0), 2, 1.0), ((0.3, 0.3, 90.0), 2, 1.0)
    learner, grid = learned(east, north, north, north)
    field = preference_field(devlearn.World(), learner, grid=grid)
    np.testing.assert_allclose((field.u.item(), field.v.item()), (0.25, 0.75), atol=1e-12)
    assert field.times.item() == 4


def test_the_grid_is_the_trials_where_none_is_given():
    world = devlearn.World.load("office")
    trial = devlearn.Trial(world, seed=0)
    trial.run(500)
    without = preference_field(world, trial.learner, config=trial.config)
    given = preference_field(world, trial.learner, grid=trial.grid, config=trial.config)
    for a, b in zip(without, given):
        np.testing.assert_array_equal(a, b)


def test_situations_or_motions_that_are_not_the_trials_are_refused():
    for count, situation, quantity in (
        (5, 10**12, "situation"),
        (9, 0, "learner.config.motion_count"),
        (3, 0, "learner.config.motion_count"),
    ):
        learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=count), seed=0)
        learner.update(situation, count - 1, 1.0)
        trial = devlearn.Trial(World())
        refused(lambda given=(trial, learner): preference_field(*given), quantity)


# Neither of a whole number of cells, nor as wide as high, nor of the paper's grid and motions.
OTHER = devlearn.TrialConfig(
    cell_size=0.4,
    heading_bins=7,
    robot=devlearn.RobotDef(steering_angles=[-90, 0, 90]),
    learner=devlearn.LearnerConfig(motion_count=3),
)
OBLONG = World(5.1, 3.3, start=(1, 1, 0), target=(4, 2))


def test_a_trial_and_its_record_know_the_grid_and_the_motions_that_were_learned_on():
    trial = devlearn.Trial(OBLONG, OTHER, seed=0)
    record = trial.run(800)
    learner = trial.learner
    expected = preference_field(OBLONG, learner, grid=trial.grid, config=OTHER)
    assert len(expected.x) > 10
    for field in (
        preference_field(trial),
        preference_field(trial, learner),
        preference_field(record, learner),
        preference_field(OBLONG, learner, config=OTHER),
    ):
        for a, b in zip(field, expected):
            np.testing.assert_array_equal(a, b)


def test_where_the_grid_or_the_learner_cannot_be_known_that_is_said():
    trial = devlearn.Trial(World(), seed=0)
    trial.run(10)
    error = refused(lambda: preference_field(World(), trial.learner), "grid")
    assert "World alone" in error.value
    assert all(way in error.allowed for way in ("Trial", "Record", "grid=", "config="))
    straying = devlearn.Trial(World(), seed=0, agent=devlearn.RandomAgent(1))
    for source in (straying, straying.run(1), World()):
        refused(lambda source=source: preference_field(source), "learner", "none")
