"""The field of least steps against the search from a single start."""

import math

import numpy as np
import pytest
from conftest import refused
from devlearn import Rectangle, Robot, RobotDef, World, shortest_path
from devlearn.analysis import WayField


@pytest.mark.parametrize("name", ["empty", "paper", "corridor"])
def test_it_is_within_two_steps_of_the_search_from_each_start(name):
    world = World.load(name)
    robot = Robot(world)
    field = WayField(robot)
    random = np.random.default_rng(7)
    starts = np.column_stack([
        random.uniform(0, world.width, 150), random.uniform(0, world.height, 150),
        30 * random.integers(0, 12, 150),
    ])  # fmt: skip
    fits = (
        world.clearance(starts[:, 0], starts[:, 1], walls_count=True) > 0.13
    )  # where it fits narrowly, more
    starts = starts[fits][:25]
    least = field.steps(*starts.T)
    exact = [shortest_path(robot, start).steps for start in starts]
    assert np.abs(least - exact).max() <= 2
    assert np.abs(np.mean(least - exact)) <= 0.5


def test_at_the_target_there_is_nothing_left_to_do():
    world = World.load("empty")
    field = WayField(Robot(world))
    x, y = world.target
    assert field.steps([x, x, x + 0.09], [y] * 3, [0, 90, 330]).tolist() == [0, 0, 0]
    assert field.steps(x + 0.2, y, 180) > 0


def test_where_there_is_no_way_it_is_infinite():
    wall = Rectangle((2.0, 2.5), (0.2, 5.0))
    world = World(5, 5, (1, 1, 0), (4, 4), obstacles=[wall])
    field = WayField(Robot(world))
    assert math.isinf(field.steps(1.0, 1.0, 0.0)) and field.steps(3.0, 1.0, 0.0) < 120


def test_other_motions_lead_to_other_headings():
    body = RobotDef(steering_angles=[-45.0, 0.0, 45.0])
    robot = Robot(World.load("empty"), body)
    field = WayField(robot, headings=4)
    starts = [(1.0, 1.0, 0.0), (4.0, 1.0, 90.0), (1.0, 4.0, 45.0)]
    exact = [shortest_path(robot, start).steps for start in starts]
    assert np.abs(field.steps(*np.array(starts).T) - exact).max() <= 2


def test_motions_that_lead_to_too_many_headings_are_refused():
    robot = Robot(World.load("empty"), RobotDef(steering_angles=[0.0, 0.7]))
    refused(lambda: WayField(robot), "steering_angles", "[0.0, 0.7]")
