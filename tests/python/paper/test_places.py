"""The starts that section VI draws."""

import math

from conftest import refused
from devlearn import Robot, Trial, TrialConfig, World, shortest_path
from devlearn.paper import places


def test_new_starts_are_free_far_and_timed_by_the_shortest_path(paper):
    config = TrialConfig.paper()
    starts = places.new_starts(paper, config)
    assert len(starts) == 8
    for pose, steps in starts:
        assert paper.clearance(pose.x, pose.y, walls_count=True) >= 0.15
        assert math.dist(pose[:2], paper.target) >= 1.5
        assert math.dist(pose[:2], paper.start[:2]) >= 1.5
        assert pose.heading % 30 == 0
        assert steps == shortest_path(Robot(paper), pose).steps
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


def test_new_starts_of_a_world_elsewhere_are_the_same_but_for_the_shift(paper):
    there = World(
        paper.width,
        paper.height,
        (paper.start.x + 256, paper.start.y - 128, paper.start.heading),
        (paper.target[0] + 256, paper.target[1] - 128),
        origin=(256, -128),
    )
    here = World(paper.width, paper.height, paper.start, paper.target)
    config = TrialConfig.paper()
    for (pose, steps), (other, same) in zip(
        places.new_starts(here, config, 2), places.new_starts(there, config, 2)
    ):
        assert math.dist((pose.x + 256, pose.y - 128), other[:2]) < 1e-9
        assert (other.heading, same) == (pose.heading, steps)
