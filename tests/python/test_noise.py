"""Senses that err: by chance, and by what sonars are."""

import json
import math
from pathlib import Path

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import (
    FileError,
    InvalidValue,
    NoiseDef,
    Pose,
    RandomAgent,
    Rectangle,
    Robot,
    RobotDef,
    Trial,
    TrialConfig,
    World,
)

ALL = NoiseDef(
    turn=3, drive=0.005, slip=0.05, odometry_turn=0.5, odometry_drive=0.02,
    echo=0.02, bearing=2, dropout=0.1,
)  # fmt: skip
ROOM = World(40, 40, start=(20, 20, 0), target=(1, 1))
PRESETS = (TrialConfig(), TrialConfig.adaptive())


def config(noise, preset=None, **changes):
    return (preset or TrialConfig()).replace(noise=noise, **changes)


def wander(noise, steps=4000, world=ROOM, seed=1, **changes):
    """Random motions; about their means, the steps are independent."""
    trial = Trial(world, config(noise, **changes), seed, agent=RandomAgent(seed))
    return trial.free_learning(steps)


def moves(record):
    """(turn, way) of each step of a record of one round."""
    turn = (np.diff(record.heading) + 180) % 360 - 180
    return turn, np.hypot(np.diff(record.x), np.diff(record.y))


def within_error(values, mean, deviation):
    """Whether a sample's mean and deviation are within four standard errors of these."""
    n = len(values)
    assert abs(values.mean() - mean) < 4 * deviation / math.sqrt(n)
    assert abs(values.std() - deviation) < 4 * deviation / math.sqrt(2 * n)


def test_without_noise_nothing_is_drawn_and_the_history_is_as_ever(paper):
    quiet = Trial(paper, config(NoiseDef()), seed=3).free_learning(500)
    assert not differences(quiet, Trial(paper, seed=3).free_learning(500))
    assert (quiet.true_situation == quiet.situation).all()


@pytest.mark.parametrize("preset", PRESETS)
def test_one_call_step_by_step_pieces_and_snapshots_give_one_history(paper, preset, tmp_path):
    noisy = config(ALL, preset, clearance_source="sonar", walls_count=True)
    whole = Trial(paper, noisy, seed=5).free_learning(600)
    stepped = Trial(paper, noisy, seed=5)
    stepped.begin_round()
    for i in range(600):
        step = stepped.step()
        assert (step.situation, step.true_situation) == (
            whole.situation[i],
            whole.true_situation[i],
        )
        assert step.pose == (whole.x[i + 1], whole.y[i + 1], whole.heading[i + 1])
    halves = Trial(paper, noisy, seed=5)
    first = halves.free_learning(250)
    halves.save(tmp_path / "half.safetensors")
    again = Trial.load(tmp_path / "half.safetensors")
    assert again.estimated_pose == halves.estimated_pose != halves.pose
    joined = devlearn.Record.concatenate([first, again.run(350)])
    assert not differences(whole, joined)


def test_what_is_recorded_changes_nothing(paper):
    noisy = config(ALL)
    plain = Trial(paper, noisy, seed=2).free_learning(400)
    heard = Trial(paper, noisy, seed=2).free_learning(400, echoes=True)
    assert not differences(plain, heard, list(plain))


def test_noise_does_not_shift_what_an_agent_draws():
    spoiled = wander(NoiseDef(turn=5, drive=0.01, odometry_turn=1))
    assert (spoiled.motion == wander(NoiseDef()).motion).all()


def test_seeds_differ_in_their_noise():
    one, other = (Trial(ROOM, config(ALL), s, agent=RandomAgent(1)) for s in (1, 2))
    assert differences(one.free_learning(50), other.free_learning(50), ["x"])


def test_turns_and_drives_err_by_their_deviations():
    record = wander(NoiseDef(turn=2, drive=0.004))
    turn, way = moves(record)
    angles = np.array(RobotDef().steering_angles)
    within_error(turn - angles[record.motion], 0, 2)
    within_error(way, 0.05, 0.004)


def test_a_drive_never_goes_backwards():
    record = wander(NoiseDef(drive=1))
    ahead = np.diff(record.x) * np.cos(np.radians(record.heading[1:]))
    ahead += np.diff(record.y) * np.sin(np.radians(record.heading[1:]))
    free = ahead[~record.collided]
    assert -1e-12 < free.min()
    assert free.max() <= 1 + 1e-12


def test_a_slip_makes_a_motion_drawn_evenly():
    record = wander(NoiseDef(slip=0.3), steps=20_000)
    made = np.searchsorted(RobotDef().steering_angles, np.round(moves(record)[0]))
    other = made != record.motion
    share = 0.3 * 4 / 5  # a fifth of the draws is the motion that was chosen
    assert abs(other.mean() - share) < 4 * math.sqrt(share * (1 - share) / len(other))
    assert (record.collided == 0).all()


def test_odometry_drifts_from_the_pose_and_is_right_again_where_the_robot_is_put():
    noise = NoiseDef(odometry_turn=1, odometry_drive=0.05)
    errors = []
    for seed in range(60):
        trial = Trial(ROOM, config(noise), seed, agent=RandomAgent(seed))
        trial.run(25)
        errors.append((trial.estimated_pose.heading - trial.pose.heading + 180) % 360 - 180)
        trial.begin_round()
        assert trial.estimated_pose == trial.pose == ROOM.start
    within_error(np.array(errors), 0, 5)  # of 25 steps of 1 degree


def test_odometry_knows_what_the_body_did_where_it_slid_along_a_wall():
    world = World(5, 5, start=(0.5, 0.15, -30), target=(4, 4))
    exact = Trial(world, config(NoiseDef(odometry_turn=1e-12)), agent=Ahead())
    record = exact.free_learning(40)
    assert record.collided.any()
    assert np.allclose(exact.estimated_pose, exact.pose, atol=1e-9)


class Ahead:
    """Straight on."""

    def choose(self, observation):
        return 2

    def observe(self, outcome):
        pass


def test_the_robot_acts_on_its_estimate_and_arrives_by_its_pose(paper):
    noise = NoiseDef(odometry_turn=2, odometry_drive=0.1)
    trial = Trial(paper, config(noise), seed=1)
    record = trial.free_learning(5000)
    poses = np.column_stack([record.x, record.y, record.heading])
    truly = [trial.grid.situation(Pose(*pose)) for pose in poses[:-1]]
    assert (record.true_situation == truly).all()
    assert 0.05 < (record.situation != record.true_situation).mean()
    distance = np.hypot(record.x[1:] - paper.target[0], record.y[1:] - paper.target[1])
    assert (record.arrived == (distance <= 0.1)).all()
    assert not np.allclose(distance, record.goal_distance, atol=0.05)


def test_an_estimate_outside_the_arena_is_in_the_nearest_cell():
    world = World(1, 1, start=(0.5, 0.5, 0), target=(0.9, 0.9))
    record = wander(NoiseDef(odometry_drive=1, odometry_turn=20), world=world, steps=2000)
    assert record.situation.min() >= 0


def test_echoes_err_by_their_deviation_and_some_are_lost():
    noise = NoiseDef(echo=0.03, dropout=0.2)
    trial = Trial(World(3, 3, start=(1.5, 1.5, 0), target=(1, 1)), config(noise), agent=Still())
    robot = RobotDef(speed=1e-9)
    trial = Trial(trial.world, config(noise, robot=robot), agent=Still())
    heard = trial.free_learning(3000, echoes=True).echoes[:, 2]  # ahead: 1.4 m
    lost = heard == robot.sonar_range
    assert abs(lost.mean() - 0.2) < 4 * math.sqrt(0.2 * 0.8 / len(lost))
    within_error(heard[~lost], 1.4, 0.03)


class Still(Ahead):
    """With next to no speed."""


def test_a_sonar_that_looks_aside_hears_what_is_there():
    noise = NoiseDef(bearing=5)
    trial = Trial(
        World(3, 3, start=(1.5, 1.5, 0), target=(1, 1)),
        config(noise, robot=RobotDef(speed=1e-9)),
        agent=Still(),
    )
    heard = trial.free_learning(3000, echoes=True).echoes[:, 2]
    aside = np.degrees(np.arccos(np.minimum(1.5 / (heard + 0.1), 1)))  # the wall is 1.5 m ahead
    within_error(aside**2, 25, 25 * math.sqrt(2))


def test_clearance_by_sonar_is_what_was_heard(paper):
    noisy = config(ALL, clearance_source="sonar", walls_count=True)
    record = Trial(paper, noisy, seed=4).free_learning(300, echoes=True)
    assert np.allclose(record.clearance, record.echoes.min(axis=1) + 0.1, atol=0)


# --- what sonars are -----------------------------------------------------------------------------


def test_a_cone_hears_the_nearest_of_its_rays(paper):
    cone = Robot(paper, RobotDef(sonar_count=1, sonar_beam=30, sonar_rays=7))
    single = Robot(paper, RobotDef(sonar_count=1))
    for x, y, heading in ((0.5, 0.5, 10), (2.5, 1.4, 77), (4.6, 0.4, 200), (1.9, 3.1, 301)):
        rays = [single.sonar(Pose(x, y, heading + 5 * i))[0] for i in range(-3, 4)]
        assert cone.sonar(Pose(x, y, heading))[0] == pytest.approx(min(rays), abs=1e-6)


def test_a_slanting_wall_throws_the_sound_elsewhere():
    world = World(5, 5)  # the wall ahead is 1 m from the rim
    robot = Robot(world, RobotDef(sonar_count=1, sonar_specular=25))
    for aside in (0, 10, 24, 26, 40):
        heard = robot.sonar(Pose(3.9, 2.5, aside))[0]
        expected = 1.1 / math.cos(math.radians(aside)) - 0.1 if aside < 25 else 2.0
        assert heard == pytest.approx(expected, abs=1e-5)


def test_near_echoes_are_told_as_the_least_range_and_lost_in_the_blind_time():
    world = World(5, 5)
    ahead = {d: Pose(4.9 - d, 2.5, 0) for d in (0.05, 0.2, 0.4)}
    least = Robot(world, RobotDef(sonar_count=1, sonar_least_range=0.1))
    blind = Robot(world, RobotDef(sonar_count=1, sonar_blind_time=0.3 / 171.5))
    for distance, pose in ahead.items():
        assert least.sonar(pose)[0] == pytest.approx(max(distance, 0.1), abs=1e-6)
        assert blind.sonar(pose)[0] == pytest.approx(distance if distance > 0.3 else 2, abs=1e-6)


def test_a_drive_of_any_turn_and_speed_is_eq_1_where_the_way_is_free():
    robot = Robot(World())
    pose, collided = robot.drive(Pose(2.5, 2.5, 10), turn=12.5, speed=0.3)
    ahead = math.radians(22.5)
    assert not collided
    assert pose.heading == 22.5
    assert pose.x == pytest.approx(2.5 + 0.15 * math.cos(ahead), abs=1e-15)
    assert pose.y == pytest.approx(2.5 + 0.15 * math.sin(ahead), abs=1e-15)
    for motion, turn in enumerate(RobotDef().steering_angles):
        for start in (Pose(2.5, 2.5, 10), Pose(0.12, 2, 190), Pose(0.12, 0.11, 200)):
            assert robot.drive(start, turn, 0.1) == robot.step(start, motion)


def test_a_drive_of_no_speed_turns_on_the_spot_but_for_the_skin_of_what_it_touches():
    robot = Robot(World())
    assert robot.drive(Pose(2.5, 2.5, 0), turn=77, speed=0) == (Pose(2.5, 2.5, 77), False)
    pose, _ = robot.drive(Pose(0.1, 2.5, 0), turn=77, speed=0)
    assert (pose.y, pose.heading) == (2.5, 77)
    assert 0.1 <= pose.x <= 0.11


@pytest.mark.parametrize(
    ("turn", "speed", "quantity"),
    [(math.nan, 0.1, "turn"), (math.inf, 0.1, "turn"), (0, -0.1, "speed"), (0, 2.1, "speed"),
     (0, math.nan, "speed")],
)  # fmt: skip
def test_a_drive_out_of_range_is_refused_by_name(turn, speed, quantity):
    refused(lambda: Robot(World()).drive(Pose(2.5, 2.5, 0), turn, speed), quantity)


# --- files ---------------------------------------------------------------------------------------


def test_a_robot_is_what_its_file_says(tmp_path):
    robot = RobotDef(radius=0.2, steering_angles=[-45, 0, 45], sonar_beam=15, track=0.3)
    (tmp_path / "robot.json").write_text(json.dumps(robot.to_dict()))
    assert RobotDef.load(tmp_path / "robot.json") == robot
    (tmp_path / "part.json").write_text('{"radius": 0.2}')
    assert RobotDef.load(tmp_path / "part.json") == RobotDef(radius=0.2)


@pytest.mark.parametrize(
    ("text", "said"),
    [('{"radius": -1}', "radius"), ('{"wheels": 2}', "wheels"), ("[]", ""), ("{", "")],
)
def test_a_robot_file_that_is_wrong_is_refused_by_field(tmp_path, text, said):
    (tmp_path / "robot.json").write_text(text)
    with pytest.raises(FileError, match=f"robot.json.*{said}"):
        RobotDef.load(tmp_path / "robot.json")


def test_the_schema_of_robots_has_the_fields_and_their_defaults():
    jsonschema = pytest.importorskip("jsonschema")
    schema = json.loads((Path(devlearn.__file__).parent / "robot.schema.json").read_text())
    fields = RobotDef.fields()
    assert set(schema["properties"]) == set(fields)
    for name, field in fields.items():
        default = field["default"]
        assert schema["properties"][name]["default"] == default, name
    jsonschema.validate(RobotDef().to_dict(), schema)
    jsonschema.validate({}, schema)
    for wrong in ({"radius": 0}, {"wheels": 2}, {"steering_angles": []}, {"speed": 0}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(wrong, schema)


@pytest.mark.parametrize("field", list(NoiseDef.fields()))
def test_noise_out_of_range_is_refused_by_name(field):
    for value in (-1e-9, 91, math.nan):
        refused(lambda value=value: NoiseDef(**{field: value}), f"NoiseDef.{field}")


def test_a_least_range_beyond_the_range_is_refused():
    with pytest.raises(InvalidValue, match=r"RobotDef\.sonar_least_range: got 3; .*\[0, 2\] m"):
        RobotDef(sonar_least_range=3)


def test_an_older_reader_is_told_that_there_is_noise(paper, tmp_path):
    Trial(paper, config(ALL)).save(tmp_path / "noisy")
    Trial(paper).save(tmp_path / "plain")
    versions = [
        json.loads(data[8 : 8 + int.from_bytes(data[:8], "little")])["__metadata__"][
            "format_version"
        ]
        for data in ((tmp_path / name).read_bytes() for name in ("plain", "noisy"))
    ]
    assert versions == ["1", "3"]


def test_a_wall_of_obstacles_is_met_by_noisy_motions_without_end():
    world = World(2, 2, start=(0.5, 0.5, 0), target=(1.8, 1.8),
                  obstacles=[Rectangle((1, 1), (0.3, 0.3))])  # fmt: skip
    record = wander(NoiseDef(turn=90, drive=0.5), world=world, steps=5000)
    robot = Robot(world)
    for pose in zip(record.x, record.y, record.heading):
        robot.sonar(Pose(*pose))  # refuses where the body does not fit
    assert record.collided.any()
