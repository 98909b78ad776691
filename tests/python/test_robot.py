"""The robot as Python sees it: its definition, Eq. 1 and 2, and its sonars."""

import copy
import json
import pickle
import time

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import Circle, Mover, MoverPath, Pose, Robot, RobotDef, World
from hypothesis import assume, given
from hypothesis import strategies as st

EMPTY = Robot(World())
poses = st.tuples(st.floats(0.5, 4.5), st.floats(0.5, 4.5), st.floats(-1e4, 1e4))


def test_the_default_robot_is_the_papers():
    robot = RobotDef()
    assert (robot.radius, robot.speed, robot.sample_time, robot.track) == (0.1, 0.1, 0.5, None)
    assert robot.steering_angles == [-60, -30, 0, 30, 60]
    assert (robot.sonar_count, robot.sonar_fov, robot.sonar_range) == (5, 180, 2)
    assert robot.sonar_angles() == [-90, -45, 0, 45, 90]
    assert Robot(World()).definition == robot


robots = st.builds(
    RobotDef,
    radius=st.floats(0.01, 10),
    speed=st.floats(1e-6, 1),
    sample_time=st.floats(1e-6, 1),
    track=st.none() | st.floats(0, 10, exclude_min=True),
    steering_angles=st.lists(st.floats(-360, 360), min_size=1, max_size=9),
    sonar_count=st.integers(0, 720),
    sonar_fov=st.floats(0, 360),
    sonar_range=st.floats(0.01, 100),
)


@given(robots)
def test_a_definition_survives_dict_json_pickle_and_copy(robot):
    for again in (
        RobotDef.from_dict(robot.to_dict()),
        RobotDef.from_dict(json.loads(json.dumps(robot.to_dict()))),
        pickle.loads(pickle.dumps(robot)),
        copy.deepcopy(robot),
        eval(repr(robot), {"RobotDef": RobotDef}),
        robot.replace(),
    ):
        assert again == robot
        assert hash(again) == hash(robot)
    assert robot.replace(radius=11 - robot.radius if robot.radius > 5 else 6) != robot
    assert len(robot.sonar_angles()) == robot.sonar_count


@given(poses, st.integers(0, 4))
def test_a_free_step_is_eq_1(pose, motion):
    after, collided = EMPTY.step(pose, motion)
    heading = np.mod(pose[2] + (-60, -30, 0, 30, 60)[motion], 360)
    assert not collided
    assert isinstance(after, Pose)
    assert abs((after.heading - heading + 180) % 360 - 180) < 1e-9
    assert abs(after.x - pose[0] - 0.05 * np.cos(np.radians(heading))) < 1e-12
    assert abs(after.y - pose[1] - 0.05 * np.sin(np.radians(heading))) < 1e-12


def test_a_wall_stops_the_body_and_is_a_collision():
    pose, collided = EMPTY.step((0.11, 2, 180), 2)
    assert collided
    assert 0.095 - 1e-6 <= pose.x <= 0.11
    assert pose.heading == 180
    assert EMPTY.step((0.11, 2, 0), 2) == ((0.16, 2, 0), False)


def test_steps_are_pure(paper):
    robot = Robot(paper)
    pose = (1.3, 1.02, 90.0)  # in front of a circle
    outcome = robot.step(pose, 3)
    for other in range(5):
        robot.step((0.11, 0.11, 225), other)
        assert robot.step(pose, 3) == outcome
        assert Robot(paper).step(pose, 3) == outcome


def test_eq_2_gives_the_wheels_their_speeds():
    robot = Robot(World())
    assert robot.drive_speeds == (0.1, 0.1)
    for motion, angle in enumerate((-60, -30, 0, 30, 60)):
        left, right = robot.turn_speeds(motion)
        assert left == -right
        assert right == pytest.approx(np.radians(angle) * 0.1 / (2 * 0.5), abs=1e-15)
    wide = Robot(World(), RobotDef(track=0.3))
    assert wide.turn_speeds(4)[1] == pytest.approx(np.radians(60) * 0.3)


speeds = st.floats(-1, 1)


@given(poses, speeds, speeds, st.floats(0.05, 0.5))
def test_constant_wheel_speeds_lead_to_the_end_of_their_arc(pose, left, right, track):
    robot = Robot(World(), RobotDef(track=track, sample_time=0.4))
    assume(abs(left - right) > 1e-3)
    after, collided = robot.drive_wheels(pose, left, right)
    assert not collided
    # About the centre of the arc, on the line through both wheels.
    turn = 0.4 * (right - left) / track
    radius = 0.5 * track * (right + left) / (right - left)
    heading = np.radians(pose[2])
    x = pose[0] + radius * (np.sin(heading + turn) - np.sin(heading))
    y = pose[1] - radius * (np.cos(heading + turn) - np.cos(heading))
    assert np.hypot(after.x - x, after.y - y) < 1e-9
    assert abs((after.heading - pose[2] - np.degrees(turn) + 180) % 360 - 180) < 1e-9


@given(poses, speeds, speeds)
def test_the_same_wheel_speeds_backwards_lead_back(pose, left, right):
    there, _ = EMPTY.drive_wheels(pose, left, right)
    back, _ = EMPTY.drive_wheels(there, -left, -right)
    assert np.hypot(back.x - pose[0], back.y - pose[1]) < 1e-12
    assert abs((back.heading - pose[2] + 180) % 360 - 180) < 1e-9


@given(poses, st.integers(0, 4), st.none() | st.floats(0.05, 0.5))
def test_the_wheel_speeds_of_eq_2_one_after_the_other_are_the_motion(pose, motion, track):
    robot = Robot(World(), RobotDef(track=track))
    turned, _ = robot.drive_wheels(pose, *robot.turn_speeds(motion))
    assert (turned.x, turned.y) == (pose[0], pose[1])
    after, _ = robot.drive_wheels(turned, *robot.drive_speeds)
    expected, _ = robot.step(pose, motion)
    assert np.hypot(after.x - expected.x, after.y - expected.y) < 1e-12
    assert abs((after.heading - expected.heading + 180) % 360 - 180) < 1e-9


@given(poses)
def test_equal_wheel_speeds_drive_as_the_motion_that_does_not_turn(pose):
    assert EMPTY.drive_wheels(pose, 0.1, 0.1) == EMPTY.step(pose, 2)


def test_a_wall_stops_wheels_forwards_and_backwards_and_the_heading_is_the_arc_s():
    for heading, sign in ((180, 1), (0, -1)):
        pose, collided = EMPTY.drive_wheels((0.11, 2, heading), 0.06 * sign, 0.1 * sign)
        assert collided
        assert 0.095 - 1e-6 <= pose.x <= 0.11
        turn = np.degrees(0.5 * sign * 0.04 / 0.1)
        assert pose.heading == pytest.approx((heading + turn) % 360)
    pose, collided = EMPTY.drive_wheels((0.12, 2, 180), -0.1, 0.1)  # turns on the spot
    assert (pose.x, pose.y, collided) == (0.12, 2, False)


@pytest.mark.parametrize(
    "speeds", [(2.1, 2.1), (-3, -1.5), (np.nan, 0), (0, np.inf), (-np.inf, np.inf)]
)
def test_wheel_speeds_that_lead_further_than_a_step_may_are_refused(speeds):
    refused(lambda: EMPTY.drive_wheels((1, 1, 0), *speeds), "mean of the wheel speeds")


def test_wheels_that_turn_beyond_all_numbers_and_places_without_room_are_refused():
    slim = Robot(World(), RobotDef(track=1e-320))
    refused(lambda: slim.drive_wheels((1, 1, 0), -1, 1), "turn of the wheel speeds")
    refused(lambda: EMPTY.drive_wheels((0, 1, 0), 0.1, 0.1), "pose")


def test_what_moves_is_looked_at_when_wheels_drive_and_when_anything_does():
    patrol = Mover(Circle((0, 0), 0.2), MoverPath([(4, 1), (1, 1)], 0.1, "stop"))
    robot = Robot(World(movers=[patrol]))
    for drive in (
        lambda time: robot.drive_wheels((1.4, 1, 0), 0.1, 0.1, time),
        lambda time: robot.drive((1.4, 1, 0), 0.0, 0.1, time),
    ):
        assert drive(0.0) == robot.step((1.4, 1, 0), 2) == ((1.45, 1, 0), False)
        assert drive(27.0) == robot.step((1.4, 1, 0), 2, 27.0)
        assert drive(27.0)[1]


def test_echoes_are_an_array_and_end_at_walls_and_at_the_range():
    echoes = EMPTY.sonar((1, 2, 0))
    assert echoes.dtype == np.float64
    assert echoes == pytest.approx([1.9, 2, 2, 2, 2], abs=1e-5)
    assert EMPTY.sonar((1, 2, 180)) == pytest.approx(
        [2, np.sqrt(2) - 0.1, 0.9, np.sqrt(2) - 0.1, 1.9], abs=1e-5
    )
    around = Robot(World(), RobotDef(sonar_count=4, sonar_fov=360, sonar_range=9)).sonar((1, 2, 0))
    assert around == pytest.approx([0.9, 1.9, 3.9, 2.9], abs=1e-5)
    assert Robot(World(), RobotDef(sonar_count=0)).sonar((1, 2, 0)).shape == (0,)
    echoes[:] = 7  # the caller's own
    assert EMPTY.sonar((1, 2, 0))[0] != 7


def test_poses_are_any_three_numbers():
    expected = EMPTY.step((1, 2, 0), 2)
    for pose in ([1, 2, 0], np.array([1, 2, 0]), np.array([1, 2, 0], np.float32), Pose(1, 2, 0)):
        assert EMPTY.step(pose, 2) == EMPTY.step(pose, np.int16(2)) == expected
        assert (EMPTY.sonar(pose) == EMPTY.sonar((1, 2, 0))).all()
    x, y, heading = expected[0]
    assert expected[0]._replace(x=0).y == y


@pytest.mark.parametrize(
    "pose", [(1, 2), (1, 2, 3, 4), "123", ("1", "2", "3"), None, 3, {1, 2, 3}, 1j]
)
def test_what_is_no_pose_is_a_type_error(pose):
    for call in (lambda: EMPTY.step(pose, 0), lambda: EMPTY.sonar(pose)):
        with pytest.raises(TypeError):
            call()


@pytest.mark.parametrize(
    ("pose", "quantity"),
    [
        ((float("nan"), 2, 0), "pose.x"),
        ((2, float("inf"), 0), "pose.y"),
        ((2, 2, float("nan")), "pose.heading"),
        ((-1, 2, 0), "pose.x"),
        ((2, 6, 0), "pose.y"),
        ((0.05, 2, 0), "pose"),
        ((1e300, 2, 0), "pose.x"),
    ],
)
def test_a_pose_that_cannot_be_is_refused_by_name(pose, quantity):
    refused(lambda: EMPTY.step(pose, 0), quantity)
    refused(lambda: EMPTY.sonar(pose), quantity)


@pytest.mark.parametrize("motion", [-1, 5, 2**31, -(2**31) - 1, 2**64, 10**30])
def test_a_motion_outside_m_is_refused_by_name(motion):
    refused(lambda: EMPTY.step((1, 2, 0), motion), "motion", str(motion))
    refused(lambda: EMPTY.turn_speeds(motion), "motion", str(motion))


def test_the_shortest_path_is_a_way_of_the_robots_own(paper):
    robot = Robot(paper)
    way = devlearn.shortest_path(robot).poses
    assert way.shape[1] == 3
    assert tuple(way[0]) == paper.start
    assert np.hypot(*(way[-1, :2] - paper.target)) <= 0.1
    for pose, after in zip(way[:-1], way[1:]):
        outcomes = [robot.step(pose, motion) for motion in range(5)]
        assert any(not hit and np.allclose(p, after, atol=1e-9) for p, hit in outcomes)


def opened(width, gap):
    """An arena of this width with a wall through its middle, and a gap at its end."""
    wall = devlearn.Rectangle(((width - gap) / 2, width / 2), (width - gap, 0.1))
    far = width - 1
    return World(width, width, (0.5, 0.5, 0), (far, far), [wall])


def is_way_of(robot, path):
    """Whether every step is one that the robot can make, without touching anything."""
    for pose, after in zip(path.poses[:-1], path.poses[1:]):
        ways = [robot.step(pose, motion) for motion in range(5)]
        if not any(not hit and np.allclose(p, after, atol=1e-9) for p, hit in ways):
            return False
    return True


@pytest.mark.parametrize(("width", "target", "steps"), [(10, 9.5, 262), (100, 99, 2883)])
def test_the_shortest_path_through_an_open_arena_is_found_at_once_whatever_its_size(
    width, target, steps
):
    robot = Robot(World(width, width, target=(target, target)))
    started = time.monotonic()
    path = devlearn.shortest_path(robot)
    assert time.monotonic() - started < 10  # 0.2 s on a machine that does nothing else
    assert (path.steps, path.lower_bound, path.exact) == (steps, steps, True)
    assert path.poses.shape == (steps + 1, 3)
    assert is_way_of(robot, path)


def test_no_way_of_the_robots_headings_is_shorter_than_the_shortest_path():
    """Straight on along one of its headings it is the distance, rounded up to steps."""
    for heading in (0, 30, 90, 210):
        angle = np.radians(heading)
        start = (50, 50, heading)
        target = (50 + 40.02 * np.cos(angle), 50 + 40.02 * np.sin(angle))
        path = devlearn.shortest_path(Robot(World(100, 100, start, target)))
        assert (path.steps, path.exact) == (np.ceil((40.02 - 0.1) / 0.05), True)


@pytest.mark.parametrize("width", [10, 40, 100])
def test_where_the_search_gives_up_a_way_and_a_bound_are_given(width):
    robot = Robot(opened(width, 1.0))
    path = devlearn.shortest_path(robot)
    corner = width - 1.1 - 0.5, width / 2 - 0.5  # the wall's end, with room for the body
    straight = np.hypot(*corner) + (width / 2 - 1)
    assert path.lower_bound <= path.steps <= 1.1 * straight / 0.05
    assert path.exact == (path.lower_bound == path.steps)
    assert is_way_of(robot, path)


def test_where_there_is_no_way_that_is_known_at_once():
    robot = Robot(opened(100, 0.0))
    started = time.monotonic()
    path = devlearn.shortest_path(robot)
    assert time.monotonic() - started < 10
    assert (path.steps, path.lower_bound, path.exact) == (None, None, True)
    assert path.poses.shape == (0, 3)


@pytest.mark.parametrize("gap", [0.0, 0.15, 0.19])
def test_a_gap_too_narrow_for_the_body_is_no_way(gap):
    robot = Robot(opened(10, gap))
    assert not devlearn.may_reach_target(robot)
    assert devlearn.shortest_path(robot).steps is None


@pytest.mark.parametrize("world", devlearn.worlds())
def test_where_there_is_a_way_the_target_may_be_reached(world):
    robot = Robot(World.load(world))
    assert devlearn.shortest_path(robot).exact
    assert devlearn.may_reach_target(robot)


def test_who_stands_at_the_target_has_no_step_to_go(paper):
    robot = Robot(paper)
    path = devlearn.shortest_path(robot, (*paper.target, 0))
    assert (path.steps, path.lower_bound, path.exact, len(path.poses)) == (0, 0, True, 1)
    assert devlearn.may_reach_target(robot, (*paper.target, 0))


def test_motions_that_do_not_lead_there_are_no_way():
    straight = Robot(
        World(start=(1, 1, 0), target=(4, 4)), devlearn.RobotDef(steering_angles=[0.0])
    )
    assert devlearn.may_reach_target(straight)  # by motions of any kind
    path = devlearn.shortest_path(straight)
    assert (path.steps, path.exact) == (None, True)


@pytest.mark.parametrize("call", [devlearn.shortest_path, devlearn.may_reach_target])
def test_a_start_or_radius_that_cannot_be_is_refused_by_name(call, paper):
    refused(lambda: call(Robot(paper), (0, 0, 0)), "start")
    refused(lambda: call(Robot(paper), goal_radius=0), "goal_radius")
    refused(lambda: call(Robot(paper), goal_radius=np.nan), "goal_radius")
