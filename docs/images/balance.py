"""Runs the study of docs/balance.md, prints its tables and draws its pictures.

    python docs/images/balance.py --search     # settings, on seeds 1000 to 1003
    python docs/images/balance.py [100]        # the study, on seeds 0 to 99

Runs are kept in out/balance, so that it goes on where it was stopped, and tables and pictures are
made again without them. Pictures are written beside this file.
"""

import os
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from devlearn import (
    AdaptiveConfig,
    AdaptiveLearner,
    Learner,
    LearnerConfig,
    Random,
    RandomAgent,
    agents,
    plots,
    tasks,
)
from devlearn.experiments import statistics
from devlearn.plots.bands import Band
from devlearn.plots.panels import panels, png
from devlearn.plots.style import BLUE, STYLE, VERMILLION
from devlearn.record import written_aside
from matplotlib import rc_context

HERE = Path(__file__).parent
OUT = Path("out/balance")
TRIALS, LAST = 300, 20
OTHER_SEEDS, TRIES = range(1000, 1004), 12
SAMPLE_TIME = tasks.Balance.Config().sample_time
UPRIGHT_ALONE = tasks.Balance.Config(sef_rate=0.0, sef_wheel_rate=0.0)


def paper(seed, **settings):
    """The paper's learner, in the reading `paper`."""
    return Learner(LearnerConfig(motion_count=5, **settings), seed)


def step5(seed, **settings):
    """The other reading."""
    return Learner(
        LearnerConfig(motion_count=5, on_negative="weaken", when_exhausted="wander", **settings),
        seed,
    )


def adaptive(seed, **settings):
    """The adaptive learner."""
    return AdaptiveLearner(AdaptiveConfig(motion_count=5, **settings), seed)


def of(kind):
    """One of devlearn.agents."""
    return lambda seed, **settings: kind(kind.Config(**settings), seed)


OF_PAPER = {
    "eta": (0.02, 0.05, 0.1, 0.3),
    "sigma": (0.1, 0.3, 0.5, 0.7, 0.9),
    "c1": (0.1, 0.5, 2.0),
}
OF_VALUES = {
    "alpha": (0.05, 0.1, 0.2, 0.5, 1.0),
    "gamma": (0.9, 0.95, 0.99, 1.0),
    "epsilon": (0.0, 0.001, 0.01, 0.1),
}
OF_AUTOMATA = {
    "reward_step": (0.01, 0.03, 0.1, 0.2, 0.3, 0.5),
    "penalty_step": (0.0, 0.001, 0.01, 0.03, 0.1, 0.3),
}
# Who takes part, with what the search draws from.
PARTIES = {
    "paper": (paper, OF_PAPER),
    "step5": (step5, OF_PAPER),
    "OperantConditioning": (of(agents.OperantConditioning), OF_AUTOMATA),
    "OperantConditioning, by reward": (
        lambda seed, **s: of(agents.OperantConditioning)(seed, reinforced_by="reward", **s),
        OF_AUTOMATA,
    ),
    "QLearning": (of(agents.QLearning), OF_VALUES),
    "QLearning, shaped by SEF": (
        lambda seed, **s: of(agents.QLearning)(seed, shaping="sef", **s),
        OF_VALUES,
    ),
    "adaptive": (
        adaptive,
        {"optimism": (1.1, 1.5, 3.0), "hold_limit": (1, 5, 20), "patience": (10, 1_000_000),
         "recollections": (5, 20, 50)},
    ),
    "RandomAgent": (lambda seed: RandomAgent(seed), {}),
}  # fmt: skip
# What the search found.
SETTINGS = {
    "paper": {"eta": 0.1, "sigma": 0.9, "c1": 0.1},
    "step5": {"eta": 0.3, "sigma": 0.1, "c1": 2.0},
    "OperantConditioning": {"reward_step": 0.5, "penalty_step": 0.0},
    "OperantConditioning, by reward": {},
    "QLearning": {"alpha": 0.2, "gamma": 1.0, "epsilon": 0.0},
    "QLearning, shaped by SEF": {"alpha": 0.5, "gamma": 0.95, "epsilon": 0.001},
    "adaptive": {"optimism": 3.0, "hold_limit": 1, "patience": 10, "recollections": 5},
    "RandomAgent": {},
}


def drawn(name):
    """The settings that are tried: the defaults, and others by chance."""
    choices = PARTIES[name][1]
    random = Random(0, f"settings of {name}")
    tried = [{}]
    while choices and len(tried) < TRIES:
        these = {key: some[random.index(len(some))] for key, some in choices.items()}
        if these not in tried:
            tried.append(these)
    return tried


def trials(name, settings, seed, config=None):
    """What became of each."""
    agent = PARTIES[name][0](seed, **settings)
    return tasks.run(tasks.Balance(config), agent, TRIALS, seed=seed)


def _job(job):
    return trials(*job)


def all_trials(jobs):
    """Of many, on all processors."""
    with ProcessPoolExecutor(int(os.environ.get("DEVLEARN_JOBS", os.cpu_count()))) as pool:
        return np.array(list(pool.map(_job, jobs)))


def search():
    """The settings of the most time stood in all trials, of each party."""
    for name in PARTIES:
        tried = drawn(name)
        jobs = [(name, settings, seed) for settings in tried for seed in OTHER_SEEDS]
        steps = all_trials(jobs)["steps"].reshape(len(tried), -1)
        means = steps.mean(1) * SAMPLE_TIME
        best = int(np.argmax(means))
        print(f"    {name!r}: {tried[best]},  # {means[best]:.1f} s, the defaults {means[0]:.1f} s")


def file_of(party, seed):
    """Where a run of the study is kept."""
    name, mark = party
    return OUT / f"{name}{mark}" / f"{seed}.npy"


def _keep(job):
    party, seed = job
    name, mark = party
    file = file_of(party, seed)
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        found = trials(name, SETTINGS[name], seed, UPRIGHT_ALONE if mark else None)
        with written_aside(file, "wb") as into:
            np.save(into, found)


def kept(parties, seeds):
    """What became of each trial of the study: of each party an array, seeds x trials."""
    jobs = [(party, seed) for seed in seeds for party in parties]
    with ProcessPoolExecutor(int(os.environ.get("DEVLEARN_JOBS", os.cpu_count()))) as pool:
        list(pool.map(_keep, jobs))
    return {party: np.array([np.load(file_of(party, seed)) for seed in seeds]) for party in parties}


def told(estimate, write):
    """A value with its 95 % interval."""
    value, low, high = map(write, (estimate.value, estimate.low, estimate.high))
    return value if value == low == high else f"{value} ({low} to {high})"


def row(name, episodes):
    """A line of the table."""
    stood = episodes["succeeded"]
    first = np.where(stood.any(1), stood.argmax(1) + 1.0, np.inf)
    median = statistics.estimate_median(first[:, None])
    last = statistics.estimate_mean(stood[:, -LAST:].mean(1)[:, None])
    count = lambda value: "never" if not np.isfinite(value) else f"{value:.0f}"  # noqa: E731
    share = lambda value: f"{100 * min(max(value, 0.0), 1.0):.1f} %"  # noqa: E731
    ever = f"{np.isfinite(first).sum()} of {len(first)}"
    time = f"{np.median(episodes['steps'][:, -LAST:].mean(1)) * SAMPLE_TIME:.1f} s"
    cells = [name, told(median, count), ever, told(last, share), time]
    return f"| {' | '.join(cells)} |"


HEAD = """| | first trial that stands 60 s, median | ever, of the runs | last 20 trials that stand, mean | last 20 trials, median of their means |
| --- | --- | --- | --- | --- |"""  # noqa: E501


def study(seeds):
    """Prints the tables and draws."""
    usual = [(name, "") for name in PARTIES]
    alone = [(name, ", angle alone") for name in ("paper", "step5", "OperantConditioning")]
    episodes = kept([*usual, *alone], seeds)
    print(f"seeds {seeds[0]} to {seeds[-1]}\n\n{HEAD}")
    for party in usual:
        print(row(party[0], episodes[party]))
    print(f"\nSEF of the angle alone:\n\n{HEAD}")
    for party in alone:
        print(row(party[0], episodes[party]))
    (HERE / "balance_curves.png").write_bytes(
        curves({name: episodes[name, mark] for name, mark in usual})
    )
    (HERE / "balance_trace.png").write_bytes(traces())


def curves(episodes):
    """The time stood over trials: median and quartiles over seeds."""
    x = np.arange(1, TRIALS + 1)
    bands = {
        name: Band(x, *np.quantile(of_each["steps"], (0.5, 0.25, 0.75), axis=0) * SAMPLE_TIME)
        for name, of_each in episodes.items()
    }
    axes = plots.plot_bands(bands, log="", xlabel="trial", ylabel="time stood [s]")
    axes.set_ylim(-2, 63)
    axes.figure.set_size_inches(8.2, 3.6)
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False, fontsize=8)
    return png(axes)


def lived(learner, task, seed, episode):
    """Times, angles [degrees] and distances [m] of a trial of the paper's learner, which learns."""
    task.begin(Random(seed, f"episode {episode}").next() % 2**31)
    states, arrived = [task.state], False
    while not arrived:
        motion = learner.choose(task.observation().situation).motion
        outcome = task.step(motion)
        learner.learn(outcome.smf)
        states.append(task.state)
        arrived = outcome.arrived
    states = np.array(states)
    rolled = np.deg2rad(states[:, 2]) * task.config.robot.wheel_radius
    return np.arange(len(states)) * SAMPLE_TIME, states[:, 0], rolled


def traces(seed=0):
    """The first trial and one after all others, of the reading step5."""
    task, learner = tasks.Balance(), step5(seed, **SETTINGS["step5"])
    before = lived(learner, task, seed, 0)
    tasks.run(task, learner, TRIALS - 1, seed=seed, first=1)
    after = lived(learner, task, seed, TRIALS)
    with rc_context(STYLE):
        figure, axes = panels(2, 2, height=3.4)
        for column, (title, (time, angle, rolled)) in enumerate(
            (("trial 1", before), (f"trial {TRIALS + 1}", after))
        ):
            above, below = axes[column], axes[2 + column]
            above.plot(time, angle, color=VERMILLION, linewidth=0.7)
            above.set(title=title, ylabel="angle [degrees]", ylim=(-16, 16))
            for limit in (-15, 15):
                above.axhline(limit, color="0.6", linewidth=0.6, linestyle=":")
            below.plot(time, rolled, color=BLUE, linewidth=0.7)
            below.set(xlabel="time [s]", ylabel="distance rolled [m]")
    return png(axes[0])


if __name__ == "__main__":
    if "--search" in sys.argv[1:]:
        search()
    else:
        study(range(int(sys.argv[1]) if sys.argv[1:] else 100))
