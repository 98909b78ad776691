"""Steps a second of devlearn/Navigate-v0, in batches of several sizes: the native vector
environment against the plain batch call of the same steps, against Gymnasium's own vector around
single ones, and against environments of other libraries where they are installed.

vector_environment.py [SECONDS]   how long each measurement takes (default: 1)
"""

from __future__ import annotations

import importlib.metadata
import itertools
import os
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import devlearn.envs
import gymnasium
import numpy as np

COUNTS = (1, 64, 1024)
PASSES = 5
WITHOUT_SONARS = {"observe": ("pose", "situation")}

Stepper = Callable[[], object]


def steps_a_second(step: Stepper, count: int, seconds: float) -> float:
    """Of a call that steps so many environments, in processor time, of all threads."""
    for _ in range(3):
        step()
    calls, began = 0, time.process_time()
    while (taken := time.process_time() - began) < seconds:
        for _ in range(max(1, 64 // count)):
            step()
            calls += 1
    return calls * count / taken


def drawn(count: int, motions: int) -> Iterator[np.ndarray]:
    """Actions of so many environments, the same each time."""
    return itertools.cycle(np.random.default_rng(1).integers(motions, size=(1024, count)))


# --- ours -----------------------------------------------------------------------------------------


def plain(count: int, sonars: bool) -> Stepper:
    """The batch call alone."""
    episodes = devlearn.BatchConfig(sonars=sonars)
    batch = devlearn.Batch(devlearn.World.load("paper"), count, episodes=episodes)
    actions = drawn(count, 5)
    return lambda: batch.step(next(actions))


def stepped(envs: Any, count: int) -> Stepper:
    """A vector environment of Gymnasium's kind."""
    envs.reset(seed=0)
    actions = drawn(count, 5)
    return lambda: envs.step(next(actions))


def native(count: int, sonars: bool) -> Stepper:
    """The native vector environment."""
    envs = gymnasium.make_vec(
        "devlearn/Navigate-v0",
        count,
        vectorization_mode="vector_entry_point",
        **({} if sonars else WITHOUT_SONARS),
    )
    return stepped(envs, count)


def synchronous(count: int, sonars: bool) -> Stepper:
    """Gymnasium's own vector around single environments."""
    asked = {} if sonars else WITHOUT_SONARS
    one = lambda: devlearn.envs.Navigate(**asked)  # noqa: E731
    return stepped(gymnasium.vector.SyncVectorEnv([one] * count), count)


def of_ours(seconds: float) -> None:
    """A table: medians of passes in which all are measured in turn."""
    print("| environments | sonars | batch call | native vector | of it | sync vector | of it |")
    print("|---|---|---|---|---|---|---|")
    for sonars, count in itertools.product((False, True), COUNTS):
        made = [kind(count, sonars) for kind in (plain, native, synchronous)]
        passes = [
            [steps_a_second(step, count, seconds / PASSES) for step in made] for _ in range(PASSES)
        ]
        call, vector, sync = (statistics.median(column) for column in zip(*passes))
        ratios = [statistics.median(p[0] / p[i] for p in passes) for i in (1, 2)]
        print(
            f"| {count} | {'5' if sonars else 'none'} | {call:,.0f} | {vector:,.0f} | "
            f"{ratios[0]:.2f} x | {sync:,.0f} | {ratios[1]:.1f} x |"
        )


# --- others ---------------------------------------------------------------------------------------


def gymnasium_cart_pole(count: int) -> Stepper:
    """Gymnasium's CartPole, written in numpy for a vector."""
    envs = gymnasium.make_vec("CartPole-v1", count, vectorization_mode="vector_entry_point")
    envs.reset(seed=0)
    actions = drawn(count, 2)
    return lambda: envs.step(next(actions))


def envpool_cart_pole(count: int) -> Stepper:
    """EnvPool's CartPole, in C++."""
    import envpool

    envs = envpool.make("CartPole-v1", env_type="gymnasium", num_envs=count, num_threads=1)
    envs.reset()
    actions = drawn(count, 2)
    return lambda: envs.step(next(actions))


def pufferlib_ocean(count: int) -> Stepper:
    """PufferLib's Ocean: agents that drive to targets, in C."""
    from pufferlib.ocean.target.target import Target

    # Eight agents an environment, each with its own observations and actions.
    envs = Target(num_envs=max(1, count // 8), num_agents=min(count, 8))
    envs.reset(seed=0)
    shape = np.shape(envs.action_space.sample())
    actions = itertools.cycle(
        np.random.default_rng(1).integers(3, size=(64, *shape)).astype(np.int32)
    )
    return lambda: envs.step(next(actions))


NAVGROUND_SCENARIO = """
type: Cross
side: 20
agent_margin: 0.1
groups:
  - type: thymio
    number: {count}
    radius: 0.1
    control_period: 0.1
    behavior: {{type: HL, optimal_speed: 0.1, horizon: 2.0}}
    kinematics: {{type: 2WDiff, wheel_axis: 0.094, max_speed: 0.14}}
    state_estimation: {{type: Bounded, range: 2.0}}
"""


def navground_world(count: int) -> Stepper:
    """navground: agents of one world among each other, in C++; a step of the world steps all."""
    from navground import sim

    scenario = sim.load_scenario(NAVGROUND_SCENARIO.format(count=count))
    world = sim.World()
    scenario.init_world(world, seed=0)
    return lambda: world.update(0.1)


IR_SIM_WORLD = """
world: {height: 5, width: 5, step_time: 0.5, control_mode: auto, collision_mode: stop}
robot:
  - kinematics: {name: diff}
    shape: {name: circle, radius: 0.1}
    state: [0.5, 0.5, 0]
    goal: [4.5, 4.5, 0]
    sensors: [{type: lidar2d, range_min: 0, range_max: 2, angle_range: 3.14, number: 5}]
obstacle:
  - {shape: {name: circle, radius: 0.3}, state: [2.5, 2.5, 0]}
"""


def ir_sim_world(count: int) -> Stepper:
    """IR-SIM: a differential-drive robot among obstacles, in Python; worlds one after the other."""
    import tempfile

    import irsim

    with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False) as file:
        file.write(IR_SIM_WORLD)
    made = [irsim.make(file.name, display=False, disable_all_plot=True) for _ in range(count)]
    os.unlink(file.name)
    action = np.array([[0.1], [0.2]])

    def step() -> None:
        for env in made:
            env.step(action)

    return step


OTHERS: dict[str, tuple[Callable[[int], Stepper], str, tuple[int, ...]]] = {
    "Gymnasium, CartPole in numpy": (gymnasium_cart_pole, "gymnasium", COUNTS),
    "EnvPool, CartPole in C++": (envpool_cart_pole, "envpool", COUNTS),
    "PufferLib's Ocean, Target in C": (pufferlib_ocean, "pufferlib", COUNTS),
    "navground, robots in one world": (navground_world, "navground", (1, 64)),
    "IR-SIM, a robot with a lidar of 5": (ir_sim_world, "ir-sim", (1,)),
}


def of_others(seconds: float) -> None:
    """A table: steps of single environments, or agents, a second."""
    print("| | version | " + " | ".join(map(str, COUNTS)) + " |")
    print("|---|---|" + "---|" * len(COUNTS))
    for name, (made, package, counts) in OTHERS.items():
        try:
            version = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            print(f"| {name} | not installed | |")
            continue
        cells = []
        for count in COUNTS:
            if count not in counts:
                cells.append("")
                continue
            try:
                cells.append(f"{steps_a_second(made(count), count, seconds):,.0f}")
            except Exception as error:  # of somebody else's code, whatever it is
                cells.append(f"failed: {type(error).__name__}: {error}")
        print(f"| {name} | {version} | {' | '.join(cells)} |")


def main() -> None:
    """Measures."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    print(f"Steps a second of processor time, Gymnasium {gymnasium.__version__}\n")
    of_ours(seconds)
    print()
    of_others(seconds)


if __name__ == "__main__":
    main()
