"""The environment of one robot: Gymnasium's laws, and those of a trial."""

import subprocess
import sys
import warnings

import devlearn
import gymnasium
import numpy as np
import pytest
from conftest import refused
from devlearn import Circle, Mover, MoverPath, RobotDef, TrialConfig, World
from devlearn.envs import Navigate, NavigateVector
from gymnasium.utils.env_checker import check_env

CAREFUL = TrialConfig(robot=RobotDef(safety_margin=0.1))


def made(**asked):
    return gymnasium.make("devlearn/Navigate-v0", **asked).unwrapped


@pytest.mark.parametrize(
    "asked",
    [
        {},
        {"flat": True},
        {"observe": ["situation", "goal_distance"], "reward": "smf"},
        {"world": "office", "config": CAREFUL, "reward": "cost"},
        {"world": World(obstacles=[]), "config": TrialConfig(robot=RobotDef(sonar_count=0))},
        {"config": TrialConfig.adaptive(), "reward": "sparse", "render_mode": "rgb_array"},
        {"actions": "wheels"},
        {"actions": "wheels", "world": "office", "flat": True, "random_starts": True},
    ],
)
def test_gymnasium_s_checker_has_nothing_to_say(asked, monkeypatch):
    for display in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(display, raising=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(made(**asked))


class Script:
    """An agent of a trial that makes the motions it was given."""

    def __init__(self, motions):
        self.motions = iter(motions)

    def choose(self, observation):
        return next(self.motions)

    def observe(self, outcome):
        pass


@pytest.mark.parametrize("world", ["paper", "office"])
@pytest.mark.parametrize(
    "config",
    [
        TrialConfig(),
        TrialConfig.adaptive(),
        TrialConfig(clearance_source="sonar", walls_count=True, touch_cost=2.0),
    ],
)
def test_an_episode_is_what_a_trial_records_of_the_same_motions_to_the_bit(world, config):
    motions = np.random.default_rng(3).integers(5, size=400)
    record = devlearn.Trial(World.load(world), config, agent=Script(motions)).run(400, echoes=True)
    assert record.collided.any()
    env = made(world=world, config=config, reward="smf")
    env.reset(seed=0)
    for i, motion in enumerate(motions):
        seen, reward, terminated, truncated, info = env.step(motion)
        assert list(seen["pose"]) == [record[name][i + 1] for name in ("x", "y", "heading")]
        assert list(seen["sonars"]) == list(record.echoes[i])
        assert reward == info["smf"] == record.smf_used[i]
        assert info["cost"] == record.cost[i]
        assert info["collided"] == record.collided[i]
        assert info["goal_distance"] == record.goal_distance[i]
        assert info["clearance"] == record.clearance[i]
        assert terminated == record.arrived[i]
        assert not truncated
        if i + 1 < len(motions):
            assert seen["situation"] == record.situation[i + 1]
        if terminated:
            break


def test_an_episode_is_cut_after_the_step_limit_and_then_wants_a_reset():
    env = made(step_limit=3)
    env.reset(seed=0)
    assert [env.step(2)[3] for _ in range(3)] == [False, False, True]
    refused(lambda: env.step(2), "episode[0]", "one that has ended")
    env.reset()
    assert not env.step(2)[3]


def test_flat_observations_are_the_same_numbers_in_a_row():
    seen, _ = made().reset(seed=0)
    row, _ = made(flat=True).reset(seed=0)
    assert list(row) == [*seen["pose"], seen["situation"], *seen["sonars"]]
    only, _ = made(observe=("sonars", "pose"), flat=True).reset(seed=0)
    assert list(only) == [*seen["sonars"], *seen["pose"]]
    (distance,), info = made(observe=["goal_distance"], flat=True).reset(seed=0)
    assert distance == info["goal_distance"]


def test_what_was_observed_stays_as_it_was():
    env = made()
    seen, info = env.reset(seed=0)
    before = (seen["pose"].tolist(), info["action_mask"].tolist(), float(info["estimate"]))
    env.step(3)
    assert before == (seen["pose"].tolist(), info["action_mask"].tolist(), float(info["estimate"]))


def test_the_mask_is_what_the_safety_layer_allows_and_what_it_allows_does_not_touch():
    env = made(config=CAREFUL)
    _, info = env.reset(seed=0)
    env.action_space.seed(1)
    robot, some = devlearn.Robot(World.load("paper"), CAREFUL.robot), 0
    for _ in range(300):
        refuses = not info["action_mask"].all()
        some += refuses
        seen, _, over, _, info = env.step(env.action_space.sample(info["action_mask"]))
        assert info["action_mask"].dtype == np.int8
        assert (info["action_mask"] == robot.allowed(seen["pose"])).all()
        assert (env.action_masks() == info["action_mask"].astype(bool)).all()
        assert not (refuses and info["collided"])  # where nothing is safe, all is allowed
        assert not over
    assert some > 10


def test_a_step_at_wheel_speeds_is_the_robot_s():
    robot = devlearn.Robot(World.load("paper"))
    env = made(actions="wheels")
    seen, info = env.reset(seed=0)
    env.action_space.seed(2)
    assert "action_mask" not in info
    touched = 0
    for _ in range(400):
        left, right = action = env.action_space.sample() + 0.03  # forwards, on the whole
        action = np.clip(action, env.action_space.low, env.action_space.high)
        pose, collided = robot.drive_wheels(seen["pose"], *action)
        seen, _, over, _, info = env.step(action)
        assert tuple(seen["pose"]) == pose
        assert info["collided"] == collided
        touched += collided
        assert not over
    assert touched > 10


def test_wheels_are_as_fast_as_the_robot():
    for speed in (0.1, 0.3, 1 / 3, 2.0):
        env = made(actions="wheels", config=TrialConfig(robot=RobotDef(speed=speed)))
        assert env.action_space == gymnasium.spaces.Box(-speed, speed, (2,), dtype=np.float64)
        scaled = gymnasium.wrappers.RescaleAction(env, -1.0, 1.0)
        scaled.reset(seed=0)
        for action in ([1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]):
            scaled.step(np.array(action, dtype=np.float32))


@pytest.mark.parametrize(
    "action", [[0.1], [0.1, 0.1, 0.1], 0.1, 2, [0.11, 0], [0, np.nan], None, "left", [[0.1, 0.1]],
               [True, False], [[0.1], 0.1]]
)  # fmt: skip
def test_wheel_speeds_that_there_are_not_are_refused_and_nothing_moves(action):
    env = made(actions="wheels")
    env.reset(seed=0)
    said = refused(lambda: env.step(action), "action")
    assert said.allowed == "two numbers in [-0.1, 0.1] m/s"
    assert env.step([0.1, 0.1])[0]["pose"][0] == pytest.approx(World.load("paper").start.x + 0.05)


def test_masks_are_of_motions():
    refused(lambda: made(actions="wheels", config=CAREFUL), "RobotDef.safety_margin", "0.1")
    refused(lambda: made(actions="wheels").action_masks(), "actions", "'wheels'")


def test_a_reset_puts_the_robot_where_it_is_asked_to_be():
    env = made()
    seen, info = env.reset(options={"pose": (1.0, 2.0, 90.0)})
    assert list(seen["pose"]) == [1.0, 2.0, 90.0]
    x, y = World.load("paper").target
    assert info["goal_distance"] == pytest.approx(np.hypot(x - 1.0, y - 2.0))


@pytest.mark.parametrize("heading", [-90.0, 360.0, 765.0, -1e-20])
def test_a_heading_of_any_number_of_turns_is_observed_within_one(heading):
    turned = made(world=World(start=(1.0, 2.0, heading), target=(4.0, 4.0)))
    put = made()
    within = made()
    options = {"pose": (1.0, 2.0, heading % 360 if heading != -1e-20 else 0.0)}
    wanted = within.reset(options=options)[0]["pose"]
    for env, how in ((turned, {}), (put, {"options": {"pose": (1.0, 2.0, heading)}})):
        seen, _ = env.reset(seed=1, **how)
        assert env.observation_space.contains(seen)
        assert 0 <= seen["pose"][2] < 360
        assert (seen["pose"] == wanted).all()


def test_a_picture_is_drawn_without_a_display_and_follows_the_robot():
    env = made(render_mode="rgb_array")
    env.reset(seed=0)
    first = env.render()
    assert first.dtype == np.uint8
    assert first.shape[0] % 2 == first.shape[1] % 2 == 0
    assert first.shape[2] == 3
    assert (env.render() == first).all()
    env.step(2)
    moved = (env.render() != first).any(axis=2)
    assert 0 < moved.mean() < 0.05  # nothing but the robot and its way
    env.reset(seed=0)
    assert (env.render() == first).all()


def test_pictures_show_movers_where_they_are():
    path = MoverPath([(1.0, 4.0), (4.0, 4.0)], speed=0.5)
    world = World(movers=[Mover(Circle((0, 0), 0.3), path)])
    asked = {"world": world, "render_mode": "rgb_array"}
    env, envs = made(**asked), NavigateVector(2, **asked)
    env.reset(seed=0)
    envs.reset(seed=0)
    first = env.render()
    for _ in range(8):
        env.step(2)
        envs.step(np.array([2, 2]))
    # Where it was, and where it is: of 480 x 480 pixels.
    changed = (env.render() != first).any(axis=2)
    moved_by = 0.5 * 8 * TrialConfig().robot.sample_time
    for x in (1.0, 1.0 + moved_by):
        row, column = round(480 * (1 - 4.0 / 5)), round(480 * x / 5)
        assert changed[row - 5 : row + 5, column - 5 : column + 5].mean() > 0.9
    upper = slice(0, 240)  # without the robot, which has a way in one of them only
    assert all((frame[upper] == env.render()[upper]).all() for frame in envs.render())


def test_without_a_display_a_person_is_told_what_to_do_once_and_nothing_breaks():
    code = (
        "import devlearn.envs, gymnasium\n"
        "env = gymnasium.make('devlearn/Navigate-v0', render_mode='human')\n"
        "env.reset(seed=0)\n"
        "for _ in range(3): env.step(2)\n"
        "env.render()\n"
        "env.close()\n"
    )
    environment = {"PATH": "", "MPLCONFIGDIR": "/nonexistent"}
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, env=environment
    )
    assert run.returncode == 0, run.stderr
    assert run.stderr.count("nothing is shown: ") == 1
    assert run.stderr.count("render_mode='rgb_array'") == 1


@pytest.mark.parametrize(
    "asked, quantity",
    [
        ({"world": 3}, "path"),
        ({"world": "nowhere"}, ""),
        ({"config": {}}, "config"),
        ({"reward": "dense"}, "BatchConfig.reward"),
        ({"observe": []}, "observe"),
        ({"observe": "pose"}, "observe"),
        ({"observe": ["pose", "pose"]}, "observe"),
        ({"observe": ["camera"]}, "observe"),
        ({"observe": [["pose"]]}, "observe"),
        (
            {"observe": ["sonars"], "config": TrialConfig(robot=RobotDef(sonar_count=0))},
            "observe",
        ),
        ({"flat": 1}, "flat"),
        ({"actions": "motors"}, "actions"),
        ({"actions": None}, "actions"),
        ({"step_limit": 0}, "BatchConfig.step_limit"),
        ({"step_limit": 2.5}, "BatchConfig.step_limit"),
        ({"render_mode": "ansi"}, "render_mode"),
    ],
)
def test_what_no_environment_can_be_made_of_is_refused(asked, quantity):
    refused(lambda: Navigate(**asked), quantity)


@pytest.mark.parametrize("action", [-1, 5, 2.0, None, "left", [2], True])
def test_an_action_that_there_is_not_is_refused_and_nothing_moves(action):
    env = made()
    env.reset(seed=0)
    refused(lambda: env.step(action), "action")
    assert env.step(2)[0]["pose"][0] == pytest.approx(World.load("paper").start.x + 0.05)


def test_actions_as_policies_give_them_are_taken():
    for action in (2, np.int64(2), np.uint8(2), np.array(2)):
        env = made()
        env.reset(seed=0)
        assert not env.step(action)[4]["collided"]


@pytest.mark.parametrize("seed", [-1, 2**64, 1.5, "1", True])
def test_a_seed_that_is_none_is_refused(seed):
    refused(lambda: made().reset(seed=seed), "seed")


@pytest.mark.parametrize(
    "options, quantity",
    [
        ({"place": (1, 1, 0)}, "options"),
        ([], "options"),
        ({"pose": (1.0, 1.0)}, "options['pose']"),
        ({"pose": "start"}, "options['pose']"),
        ({"pose": (1.0, 1.0, np.nan)}, "pose.heading"),
        ({"pose": (-1.0, 1.0, 0.0)}, "pose.x"),
    ],
)
def test_options_that_there_are_not_are_refused(options, quantity):
    env = made()
    env.reset(seed=0)
    env.step(2)
    refused(lambda: env.reset(options=options), quantity)


def test_without_gymnasium_an_import_says_how_to_get_it():
    code = (
        "import sys; sys.modules['gymnasium'] = None\n"
        "import devlearn\n"
        "try:\n    import devlearn.envs\n"
        "except devlearn.errors.MissingExtra as error:\n    print(error)\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "devlearn.envs needs gymnasium" in run.stdout
    assert "pip install" in run.stdout
