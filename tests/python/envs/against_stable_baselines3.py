"""A stock agent learns in the environment: PPO of Stable-Baselines3. It brings PyTorch, so it is
run by itself, where it is installed:

    pytest tests/python/envs/against_stable_baselines3.py
"""

import devlearn
import devlearn.envs
import gymnasium
import numpy as np
import pytest

stable_baselines3 = pytest.importorskip("stable_baselines3")
torch = pytest.importorskip("torch")

# Three turns by 60 degrees, and on.
WORLD = devlearn.World(width=1.6, height=1.6, start=(0.3, 0.3, 180.0), target=(1.2, 1.2))


def made():
    asked = {"world": WORLD, "observe": ["pose"], "flat": True, "step_limit": 100}
    env = gymnasium.make("devlearn/Navigate-v0", **asked)
    return gymnasium.wrappers.RescaleObservation(env, np.float64(-1.0), np.float64(1.0))


def steps_of(choose):
    """Steps of an episode that arrived; None of one that did not."""
    env = made()
    seen, _ = env.reset(seed=0)
    for step in range(1, 101):
        seen, _, arrived, _, _ = env.step(choose(seen))
        if arrived:
            return step
    return None


def test_ppo_learns_the_way_that_random_motions_do_not_find():
    draw = np.random.default_rng(0)
    assert all(steps_of(lambda _: draw.integers(5)) is None for _ in range(5))
    torch.set_num_threads(1)  # what is this small takes longer on several
    several = stable_baselines3.common.env_util.make_vec_env(made, 8)
    agent = stable_baselines3.PPO(
        "MlpPolicy", several, seed=0, n_steps=128, batch_size=256, learning_rate=2e-3, gamma=0.95,
        device="cpu", policy_kwargs={"net_arch": [32, 32]},
    )  # fmt: skip
    agent.learn(30_000)
    assert steps_of(lambda seen: agent.predict(seen, deterministic=True)[0]) is not None


def test_stable_baselines3_s_checker_has_nothing_to_say():
    from stable_baselines3.common.env_checker import check_env

    for asked in ({}, {"flat": True}):
        check_env(gymnasium.make("devlearn/Navigate-v0", **asked).unwrapped)
