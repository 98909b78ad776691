"""The environment of many robots: each row is the environment of one."""

import contextlib
import threading

import gymnasium
import numpy as np
import pytest
from conftest import refused
from devlearn import (
    Batch,
    BatchConfig,
    Circle,
    Mover,
    MoverPath,
    MoverWalk,
    NoiseDef,
    Rectangle,
    Robot,
    RobotDef,
    TrialConfig,
    World,
    may_reach_target,
)
from devlearn.envs import Navigate, NavigateVector
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.vector.utils import iterate

VARIANTS = {
    "as it is": {},
    "flat": {"flat": True, "reward": "cost"},
    "adaptive": {"config": TrialConfig.adaptive(), "world": "office", "reward": "smf"},
    "careful": {"config": TrialConfig(robot=RobotDef(safety_margin=0.1)), "reward": "sparse"},
    "by sonar": {"config": TrialConfig(clearance_source="sonar", walls_count=True)},
    "noisy": {
        "config": TrialConfig(
            noise=NoiseDef(turn=5.0, drive=0.01, odometry_turn=2.0, odometry_drive=0.1, echo=0.1)
        )
    },
    "from anywhere": {"random_starts": True},
    "moving": {
        "world": World(
            start=(4.2, 4.2, 45.0),
            obstacles=[Circle((3.4, 4.0), 0.2)],
            movers=[
                Mover(Circle((0, 0), 0.2), MoverPath([(4.7, 3.2), (3.0, 4.6)], 0.08, "back")),
                Mover(Rectangle((0, 0), (0.3, 0.2)), MoverWalk(4, (1, 1), (3.6, 3.6), 15)),
            ],
        ),
        "config": TrialConfig(walls_count=True),
    },
    "moving, from anywhere": {
        "world": World(
            start=(4.2, 4.2, 45.0),
            movers=[
                Mover(Rectangle((0, 0), (3.0, 2.0)), MoverPath([(1.5, 1), (1.5, 3)], 0.2, "back"))
            ],
        ),
        "random_starts": True,
    },
    "by wheels": {"actions": "wheels"},
    "by noisy wheels": {
        "actions": "wheels",
        "config": TrialConfig(noise=NoiseDef(turn=5.0, drive=0.01, slip=0.1, odometry_turn=2.0)),
    },
    "deaf": {"config": TrialConfig(robot=RobotDef(sonar_count=0)), "observe": ["situation"]},
}
# Near enough that a drawn walk arrives now and then.
NEAR = World(start=(4.2, 4.2, 45.0))
each_mode = pytest.mark.parametrize("mode", ["next_step", "same_step"])
each_variant = pytest.mark.parametrize("variant", VARIANTS)


def equal(a, b):
    """Whether two of what Gymnasium gives are equal to the bit, whatever is in them."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(equal(a[key], b[key]) for key in a)
    if isinstance(a, tuple) or (isinstance(a, np.ndarray) and a.dtype == object):
        return len(a) == len(b) and all(map(equal, a, b))
    a, b = np.asarray(a), np.asarray(b)
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def asked_of(variant):
    return {"world": NEAR, "step_limit": 60, **VARIANTS[variant]}


def made(num_envs, **asked):
    return gymnasium.make_vec(
        "devlearn/Navigate-v0", num_envs, vectorization_mode="vector_entry_point", **asked
    )


def walks(variant, seed, steps, count):
    random = np.random.default_rng(seed)
    if VARIANTS[variant].get("actions") == "wheels":
        return random.uniform(0.0, 0.1, size=(steps, count, 2))
    return random.integers(5, size=(steps, count))


@each_mode
@each_variant
def test_all_that_it_gives_is_what_gymnasium_s_own_vector_around_single_ones_gives(variant, mode):
    asked = asked_of(variant)
    envs = made(4, autoreset_mode=mode, **asked)
    own = SyncVectorEnv([lambda: Navigate(**asked)] * 4, autoreset_mode=AutoresetMode[mode.upper()])
    assert envs.observation_space == own.observation_space
    assert envs.action_space == own.action_space
    assert envs.metadata["autoreset_mode"] == own.metadata["autoreset_mode"]
    assert equal(envs.reset(seed=11), own.reset(seed=11))
    ends = np.zeros(2, dtype=int)
    for actions in walks(variant, 2, 300, 4):
        ours, theirs = envs.step(actions), own.step(actions)
        assert all(map(equal, ours, theirs))
        ends += ours[2].sum(), ours[3].sum()
    assert ends[1] > 4  # autoresets after a limit
    assert ends[0] > 0 or variant == "adaptive" or "from anywhere" in variant  # after arrivals
    assert equal(envs.reset(), own.reset())  # draws go on
    assert equal(envs.reset(seed=[5, None, 7, 1]), own.reset(seed=[5, None, 7, 1]))


@each_variant
def test_a_row_is_the_single_environment_of_seed_s_plus_i(variant):
    asked = asked_of(variant)
    envs, s, i = made(3, **asked), 20, 2
    alone = gymnasium.make("devlearn/Navigate-v0", **asked)
    observations, _ = envs.reset(seed=s)
    seen, _ = alone.reset(seed=s + i)
    over, episodes = False, 0
    for actions in walks(variant, 4, 300, 3):
        rows, rewards, terminated, truncated, _ = envs.step(actions)
        if over:
            seen, reward, over = alone.reset()[0], 0.0, False
            assert not (terminated[i] or truncated[i])
            episodes += 1
        else:
            seen, reward, arrived, cut, _ = alone.step(actions[i])
            assert (arrived, cut) == (terminated[i], truncated[i])
            over = arrived or cut
        row = list(iterate(envs.observation_space, rows))[i]
        assert equal(row, seen)
        assert rewards[i] == reward
    assert episodes > 2


def test_the_mode_of_autoreset_is_declared():
    assert made(2).metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    for mode in AutoresetMode:
        assert made(2, autoreset_mode=mode).metadata["autoreset_mode"] is mode


def test_without_autoreset_those_of_a_mask_are_reset_and_the_others_stay():
    envs = made(3, autoreset_mode="disabled", step_limit=2)
    envs.reset(seed=0)
    envs.step([2, 2, 2])
    mask = np.array([False, True, False])
    seen, _ = envs.reset(options={"reset_mask": mask})
    assert (seen["pose"][0] != seen["pose"][1]).any()
    assert (seen["pose"][0] == seen["pose"][2]).all()
    *_, truncated, _ = envs.step([2, 2, 2])
    assert list(truncated) == [True, False, True]
    refused(lambda: envs.step([2, 2, 2]), "episode[0]")
    envs.reset(options={"reset_mask": truncated})
    *_, truncated, _ = envs.step([2, 2, 2])
    assert list(truncated) == [False, True, False]


def test_robots_begin_where_they_are_asked_to():
    envs = made(2)
    seen, _ = envs.reset(options={"pose": (1.0, 2.0, 90.0)})
    assert seen["pose"].tolist() == [[1.0, 2.0, 90.0]] * 2
    poses = [[1.0, 2.0, 0.0], [2.5, 0.5, 30.0]]
    assert envs.reset(options={"pose": poses})[0]["pose"].tolist() == poses


def test_what_was_observed_stays_as_it_was_unless_views_were_asked_for():
    for copy in (True, False):
        envs = made(2, copy=copy)
        seen, _ = envs.reset(seed=0)
        before = seen["pose"].tolist()
        envs.step([2, 2])
        assert (seen["pose"].tolist() == before) is copy
        refuses = pytest.raises(ValueError, match="read-only")
        with contextlib.nullcontext() if copy else refuses:
            seen["pose"][0] = 0.0


def test_pictures_are_those_of_the_single_environment_at_its_start():
    envs = made(2, render_mode="rgb_array")
    envs.reset(seed=0)
    first, second = envs.render()
    assert first.dtype == np.uint8
    assert (first == second).all()
    assert made(2).render() is None


@pytest.mark.parametrize(
    "asked, quantity",
    [
        ({"num_envs": 0}, "Batch.count"),
        ({"num_envs": 2**20 + 1}, "Batch.count"),
        ({"num_envs": 2.5}, "Batch.count"),
        ({"autoreset_mode": "later"}, "autoreset_mode"),
        ({"autoreset_mode": None}, "autoreset_mode"),
        ({"copy": 1}, "copy"),
        ({"render_mode": "human"}, "render_mode"),
        ({"reward": "dense"}, "BatchConfig.reward"),
        ({"observe": ["camera"]}, "observe"),
    ],
)
def test_what_no_vector_can_be_made_of_is_refused(asked, quantity):
    refused(lambda: NavigateVector(**asked), quantity)


@pytest.mark.parametrize(
    "actions, quantity",
    [
        ([2], "motions"),
        ([2, 2, 2], "motions"),
        (2, "motions"),
        ([2.0, 2.0], "motions"),
        ([[2], [2]], "motions"),
        (None, "motions"),
        (["left", "right"], "motions"),
        ([True, False], "motions"),
        ([2, 5], "motion[1]"),
        ([-1, 2], "motion[0]"),
        (np.array([2**64 - 1, 2], dtype=np.uint64), "motion[0]"),
    ],
)
def test_actions_that_there_are_not_are_refused_and_nothing_is_stepped(actions, quantity):
    envs = made(2)
    before, _ = envs.reset(seed=0)
    refused(lambda: envs.step(actions), quantity)
    after = envs.step([2, 2])[0]
    assert np.allclose(after["pose"][:, 0] - before["pose"][:, 0], 0.05)


@pytest.mark.parametrize("seed", [-1, 2**64 - 1, 1.5, "12", [1], [1, -1], True])
def test_seeds_that_are_none_are_refused(seed):
    refused(lambda: made(2).reset(seed=seed), "seed")


@pytest.mark.parametrize(
    "options, quantity",
    [
        ({"mask": [True, True]}, "options"),
        ({"reset_mask": [True]}, "options['reset_mask']"),
        ({"reset_mask": [1, 0]}, "options['reset_mask']"),
        ({"reset_mask": [False, False]}, "options['reset_mask']"),
        ({"pose": [[1.0, 1.0, 0.0]] * 3}, "options['pose']"),
        ({"pose": [1.0, 1.0]}, "options['pose']"),
    ],
)
def test_options_that_there_are_not_are_refused(options, quantity):
    refused(lambda: made(2).reset(options=options), quantity)


@pytest.mark.parametrize("seed", [None, 1, [None, 1, 1], [1, 1, None]])
def test_where_one_pose_does_not_fit_nobody_is_reset_seeded_or_not(seed):
    asked, left = made(3), made(3)
    for envs in (asked, left):
        envs.reset(seed=1)
        envs.step([0, 1, 2])
    poses = [(1.0, 1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)]
    refused(lambda: asked.reset(seed=seed, options={"pose": poses}), "pose.x")
    assert (asked.step([2, 2, 2])[0]["pose"] == left.step([2, 2, 2])[0]["pose"]).all()


# --- the batch itself -----------------------------------------------------------------------------


def test_a_batch_is_stepped_without_the_gil_and_by_one_thread_at_a_time():
    batch = Batch(World.load("paper"), 20_000, episodes=BatchConfig(sonars=True))
    motions = np.full(20_000, 2)
    others, refusals, going = 0, 0, threading.Event()

    def step():
        going.set()
        batch.step(motions)

    thread = threading.Thread(target=step)
    thread.start()
    going.wait()
    while thread.is_alive():
        others += 1  # this thread runs meanwhile
        try:
            batch.step(motions[:1])
        except ValueError as error:
            refusals += "another thread" in str(error)
    thread.join()
    assert others > 1
    assert refusals > 0


def test_the_arrays_of_a_batch_outlive_it_and_nobody_writes_to_them():
    batch = Batch(World.load("paper"), 2, seed=2**64 - 1)
    poses, reward = batch.rows.pose, batch.reward
    assert len(batch) == 2
    assert poses.shape == (2, 3)
    assert batch.poses().tolist() == poses.tolist()
    assert batch.times().tolist() == [0.0, 0.0]
    batch.step([2, 3])
    assert batch.times().tolist() == 2 * [batch.config.robot.sample_time]
    assert (poses == batch.rows.pose).all()
    del batch
    assert poses[0, 0] > 0.0
    for array in (poses, reward):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


@pytest.mark.parametrize(
    "actions, quantity",
    [
        ([[0.1, 0.1]], "wheel_speeds"),
        ([0.1, 0.1], "wheel_speeds"),
        ([[0.1, 0.1, 0.1]] * 2, "wheel_speeds"),
        ([[True, True]] * 2, "wheel_speeds"),
        (None, "wheel_speeds"),
        ([[0.1, 0.1], [0.11, 0.1]], "wheel_speeds.left[1]"),
        ([[0.1, -0.11], [0.1, 0.1]], "wheel_speeds.right[0]"),
        ([[0.1, 0.1], [0.1, np.nan]], "wheel_speeds.right[1]"),
    ],
)
def test_wheel_speeds_that_there_are_not_are_refused_and_nothing_is_stepped(actions, quantity):
    envs = made(2, actions="wheels")
    before, _ = envs.reset(seed=0)
    refused(lambda: envs.step(actions), quantity)
    after, *_ = envs.step(np.zeros((2, 2)))
    assert (after["pose"] == before["pose"]).all()


@pytest.mark.parametrize(
    "asked, quantity",
    [
        ({"seeds": [1, 2]}, "seeds"),
        ({"seeds": np.array([1.0, 2.0])}, "seeds"),
        ({"which": np.array([1, 0])}, "which"),
        ({"poses": [[1.0, 1.0, 0.0]]}, "poses"),
    ],
)
def test_a_reset_of_a_batch_that_does_not_fit_is_refused(asked, quantity):
    refused(lambda: Batch(World.load("paper"), 2).reset(**asked), quantity)


def test_draws_are_those_of_the_seed_and_go_on_over_episodes():
    noisy = VARIANTS["noisy"]["config"]
    envs = made(2, config=noisy, step_limit=5)
    envs.reset(seed=3)
    first = [envs.step([2, 2])[0]["pose"].tolist() for _ in range(12)]
    assert first[0][0] != first[0][1]  # seeds 3 and 4
    assert first[0] != first[6]  # the first steps of two episodes
    envs.reset(seed=3)
    assert [envs.step([2, 2])[0]["pose"].tolist() for _ in range(12)] == first
    envs.reset()
    assert envs.step([2, 2])[0]["pose"].tolist() != first[0]
    envs.reset(seed=4)
    assert envs.step([2, 2])[0]["pose"].tolist()[0] == first[0][1]


def test_starts_are_drawn_among_the_poses_that_may_get_to_the_target():
    # A pocket to the right, from which no way leads.
    wall = Rectangle((2.0, 1.0), (0.1, 2.2))
    world = World(width=3, height=2, start=(0.5, 0.5, 0), target=(1.0, 1.5), obstacles=[wall])
    robot = Robot(world)
    envs = made(4, world=world, random_starts=True, step_limit=1)
    seen, info = envs.reset(seed=1)
    starts = [*seen["pose"]]
    for _ in range(200):
        seen, *_, info = envs.step([2] * 4)
        if "smf" in info:
            continue
        starts += [*seen["pose"]]
        assert (info["goal_distance"] > 0.1).all()
    assert len(starts) > 400
    for start in starts[:100]:
        assert may_reach_target(robot, start)
    x, y, heading = np.array(starts).T
    assert max(x) < 1.85
    for values, low, high in ((x, 0.1, 1.85), (y, 0.1, 1.9), (heading, 0.0, 360.0)):
        counts, _ = np.histogram(values, 4, (low, high))
        assert counts.sum() == len(starts)
        assert counts.min() > 0.15 * len(starts)
    with pytest.raises(ValueError, match="no place leads to"):
        shut = [Rectangle((1.0, 1.5), (0.3, 0.1)), Rectangle((1.0, 1.2), (0.5, 0.1))]
        shut += [Rectangle((0.75, 1.4), (0.1, 0.6)), Rectangle((1.25, 1.4), (0.1, 0.6))]
        made(
            1,
            world=World(width=3, height=2, target=(1.0, 1.35), obstacles=shut),
            random_starts=True,
        )
