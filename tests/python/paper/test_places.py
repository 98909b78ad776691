"""The worlds and starts that section VI draws."""

import math

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import Robot, Trial, TrialConfig, World, shortest_path
from devlearn.paper import places


def outline(obstacle):
    """Points of an obstacle's outline: corners, or places around a circle."""
    if isinstance(obstacle, devlearn.Polygon):
        return list(obstacle.corners)
    x, y = obstacle.center
    if isinstance(obstacle, devlearn.Circle):
        around = np.linspace(0, 2 * np.pi, 72)
        return [(x + obstacle.radius * np.cos(a), y + obstacle.radius * np.sin(a)) for a in around]
    c, s = np.cos(np.radians(obstacle.angle)), np.sin(np.radians(obstacle.angle))
    half = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) * obstacle.size / 2
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in half]


def test_a_similar_world_is_the_same_at_every_call_and_another_for_another_number():
    texts = [places.similar_world(i).to_json() for i in (1, 2, 3, 1)]
    assert texts[0] == texts[3]
    assert len(set(texts)) == 3


@pytest.mark.parametrize("index", range(1, 7))
def test_in_a_similar_world_start_and_target_are_free_and_there_is_a_way(index, paper):
    world = places.similar_world(index)
    assert (world.start, world.target) == (paper.start, paper.target)
    assert world.clearance(*world.start[:2], walls_count=True) > 0.2
    assert world.clearance(*world.target, walls_count=True) > 0.2
    assert len(shortest_path(Robot(world))) > 1


@pytest.mark.parametrize("index", range(1, 21))
def test_obstacles_of_a_similar_world_have_the_papers_sizes_and_a_way_between_them(index, paper):
    world = places.similar_world(index)
    for moved, original in zip(world.obstacles, paper.obstacles):
        assert type(moved) is type(original)
        size, other = (np.ptp(_distances(o)) for o in (moved, original))
        assert size == pytest.approx(other)
        assert _distances(moved) == pytest.approx(_distances(original))
        others = [o for o in world.obstacles if o != moved]
        assert len(others) == 7
        alone = World(5, 5, world.start, world.target, others)
        assert min(float(alone.clearance(x, y)) for x, y in _inside(outline(moved))) >= 0.35


def _distances(obstacle):
    points = outline(obstacle)
    return [math.dist(p, q) for p in points for q in points]


def _inside(points):
    return [(min(max(x, 0.0), 5.0), min(max(y, 0.0), 5.0)) for x, y in points]


def test_new_starts_are_free_far_and_timed_by_the_shortest_path(paper):
    config = TrialConfig.paper()
    starts = places.new_starts(paper, config)
    assert len(starts) == 8
    for pose, steps in starts:
        assert paper.clearance(pose.x, pose.y, walls_count=True) >= 0.15
        assert math.dist(pose[:2], paper.target) >= 1.5
        assert math.dist(pose[:2], paper.start[:2]) >= 1.5
        assert pose.heading % 30 == 0
        assert steps == len(shortest_path(Robot(paper), pose)) - 1
        Trial(paper.with_start(pose))
    assert len({pose.heading for pose, _ in starts}) > 2


def test_new_starts_are_the_same_at_every_call_and_fewer_are_the_first(paper):
    config = TrialConfig.paper()
    starts = places.new_starts(paper, config)
    assert places.new_starts(paper, config) == starts
    assert places.new_starts(paper, config, 3) == starts[:3]


def test_a_world_without_room_for_new_starts_is_refused():
    small = World(2, 2, (0.5, 0.5, 0), (1.5, 1.5))
    refused(lambda: places.new_starts(small, TrialConfig()), "world", "0 new starts")
