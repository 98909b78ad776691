"""The paper's learner, the adaptive one and textbook agents, side by side.

All have the same body, situations, seeds and limits: the seven worlds that ship, seeds 200 to 229,
600 rounds of at most 10 000 steps. A run that ends a score of rounds of which none arrived stops
there, and counts as failed for the rest. `RandomAgent` is the floor, `ShortestPathAgent`, which has
the map, the bound; they do not learn, and make 100 and 20 rounds.

The paper's learner (preset `paper`) and the adaptive one are at their defaults. The settings of the
textbook agents come from a search (`--search`) that is the same for each: 12 settings, its defaults
and 11 drawn from the choices in `SEARCHED`, in the worlds similar:40 to similar:43, seeds 0 to 2,
300 rounds of at most 10 000 steps, a run ending after 100 000. The one of the least mean of
(steps of all rounds) / (rounds x shortest path) is taken, a round that failed or was not reached
counting as 10 000 steps. What was found is in side_by_side_settings.json.

    python bench/side_by_side.py FOLDER              runs what is missing, writes tables and figure
    python bench/side_by_side.py FOLDER --search     searches the settings anew, then the same;
                                                     --search KIND:SEED ... in other worlds

Stopped, both go on where they were.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from devlearn import (
    Random,
    RandomAgent,
    Robot,
    Trial,
    TrialConfig,
    World,
    agents,
    shortest_path,
    worlds,
)
from devlearn.experiments.runs import Journal, run_all
from devlearn.paper.measures import first_arrival, motions_by_round

ROUNDS, LIMIT, LAST, FREE = 600, 10_000, 20, 10_000  # rounds in scores of LAST
FIRST_SEED, SEEDS = 200, 30
SETTINGS = Path(__file__).with_name("side_by_side_settings.json")

# --- measures: functions of a run, which know nothing of how it was made -----------------------


class Run(NamedTuple):
    """Rounds of path learning, a value each, and what was before them."""

    steps: np.ndarray
    arrived: np.ndarray
    touches: np.ndarray  # steps that touched something
    path: np.ndarray  # equal numbers: equal motions
    shortest: int  # steps
    planned: int  # rounds; those that are missing count as failed
    before: int = 0  # steps of free learning that count
    found: int | None = None  # step of these that first arrived
    seconds: float = math.nan  # processor time of the rounds


def steps_to_first_arrival(run: Run) -> float:
    """Steps until the target is first reached; inf: never."""
    return run.found or _steps_until(run, run.arrived)


def steps_to_within(factor: float) -> Callable[[Run], float]:
    """Steps until the end of the first round of at most factor x shortest steps; inf: never."""
    return lambda run: _steps_until(run, run.arrived & (run.steps <= factor * run.shortest))


def _steps_until(run: Run, good: np.ndarray) -> float:
    return run.before + int(run.steps[: good.argmax() + 1].sum()) if good.any() else math.inf


def final_ratio(run: Run) -> float:
    """Median steps of the last 20 rounds over the shortest; a failed round is infinitely long."""
    return float(np.median(np.where(run.arrived, run.steps, np.inf)[-LAST:])) / run.shortest


def settled_from(run: Run) -> float:
    """The round from which on, for at least 20, all arrive by the same motions; inf: none."""
    other = np.flatnonzero((run.path != run.path[-1]) | ~run.arrived)
    first = int(other[-1]) + 1 if len(other) else 0
    return first + 1 if run.planned - first >= LAST and len(run.path) == run.planned else math.inf


def share_failed(run: Run) -> float:
    """Share of the rounds that did not arrive."""
    return 1 - int(run.arrived.sum()) / run.planned


def share_touching(run: Run) -> float:
    """Share of the steps of the last 20 rounds in which the body touched something."""
    return float(run.touches[-LAST:].sum() / run.steps[-LAST:].sum())


def nanoseconds(run: Run) -> float:
    """Processor time of a step, the body's and the record's included [ns]."""
    return 1e9 * run.seconds / int(run.steps.sum())


class Measure(NamedTuple):
    """A function of a run; how a value of it is written."""

    of: Callable[[Run], float]
    written: Callable[[float], str]


def _thousands(steps: float) -> str:
    return f"{steps / 1000:.1f} k"


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


MEASURES = {
    "steps to first arrival": Measure(steps_to_first_arrival, _thousands),
    "steps to 1.5 L": Measure(steps_to_within(1.5), _thousands),
    "steps to 1.25 L": Measure(steps_to_within(1.25), _thousands),
    "last path / L": Measure(final_ratio, "{:.2f}".format),
    "settled from round": Measure(settled_from, "{:.0f}".format),
    "failed rounds": Measure(share_failed, _percent),
    "touching": Measure(share_touching, _percent),
    "ns a step": Measure(nanoseconds, "{:.0f}".format),
}

# --- what is compared --------------------------------------------------------------------------

COUNTED, UNCOUNTED, NONE = "paper", "paper, free learning not counted", "paper, no free learning"
ADAPTIVE, FLOOR, BOUND = "AdaptiveLearner", "RandomAgent", "ShortestPathAgent"

_OF_VALUES = {
    "alpha": (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0),
    "gamma": (1.0, 0.99, 0.95),
    "epsilon": (0.0, 0.001, 0.003, 0.01, 0.03, 0.1),
    "first_value": ("estimate", "constant"),
    "shaping": ("none", "sef", "estimate"),
}
_OF_PLANNING = {**_OF_VALUES, "planning_steps": (5, 10, 20)}
SEARCHED: dict[str, dict[str, Sequence[Any]]] = {
    "QLearning": _OF_VALUES,
    "SarsaLambda": {
        **_OF_VALUES,
        "trace_decay": (0.9,),
        "traces": ("accumulating", "replacing"),
    },
    "DynaQ": _OF_PLANNING,
    "PrioritizedSweeping": {**_OF_PLANNING, "theta": (0.001, 0.01, 0.1, 1.0)},
    "LrtaStar": {
        "first_value": ("estimate", "constant"),
        "initial_value": tuple(range(-200, 1, 5)),
    },
    "RMax": {
        "m": (1, 2, 3, 5),
        "gamma": (1.0, 0.99, 0.95),
        "first_value": ("estimate", "constant"),
        "theta": (1e-6, 1e-3, 0.1, 1.0),
        "least_value": (-1000.0, -300.0),
    },
}
COMPARED = (COUNTED, UNCOUNTED, NONE, ADAPTIVE, *SEARCHED, FLOOR, BOUND)
FEWER_ROUNDS = {FLOOR: 100, BOUND: 20}


def trial_of(agent: str, settings: Mapping[str, Any], world: World, seed: int) -> Trial:
    """A trial of one of `COMPARED`."""
    if agent in (COUNTED, NONE):
        return Trial(world, TrialConfig.paper(), seed)
    if agent == ADAPTIVE:
        return Trial(world, TrialConfig.adaptive(), seed)
    if agent == FLOOR:
        return Trial(world, seed=seed, agent=RandomAgent(seed))
    if agent == BOUND:
        return Trial(world, seed=seed, agent=agents.ShortestPathAgent(Robot(world)))
    cls = getattr(agents, agent)
    return Trial(world, seed=seed, agent=cls(cls.Config(**settings), seed))


def world_of(name: str) -> World:
    """One that ships, or KIND:SEED."""
    kind, _, seed = name.partition(":")
    return World.random(kind, int(seed)) if seed else World.load(name)


# --- running -----------------------------------------------------------------------------------


def execute(job: Mapping[str, Any]) -> dict[str, Any]:
    """Makes a run: the fields of `Run` that are not in the job."""
    trial = trial_of(job["agent"], job["settings"], world_of(job["world"]), job["seed"])
    before, found = 0, None
    for _ in range(2 if job["agent"] == COUNTED else 0):
        arrival = first_arrival(free := trial.free_learning(FREE))
        if found is None and arrival is not None:
            found = before + arrival
        before += len(free)
    made: dict[str, list[int]] = {"steps": [], "arrived": [], "touches": [], "path": []}
    paths: dict[bytes, int] = {}
    seconds, missing = 0.0, job["rounds"]
    while missing and sum(made["steps"]) < job.get("most_steps", math.inf):
        start = time.process_time()
        record = trial.path_learning(min(LAST, missing), LIMIT)
        seconds += time.process_time() - start
        missing -= len(record.rounds)
        made["steps"] += record.rounds["steps"].tolist()
        made["arrived"] += record.rounds["arrived"].tolist()
        touches = np.add.reduceat(record.collided.astype(int), record.offsets()[:-1])
        made["touches"] += touches.tolist()
        made["path"] += [paths.setdefault(key, len(paths)) for key in motions_by_round(record)]
        if not any(made["arrived"][-LAST:]):
            break
    return {**made, "before": before, "found": found, "seconds": seconds}


def run_of(job: Mapping[str, Any], result: Mapping[str, Any], shortest: int) -> Run:
    """What `execute` made of a job."""
    arrays = {name: np.array(value) for name, value in result.items() if isinstance(value, list)}
    return Run(**{**result, **arrays, "shortest": shortest, "planned": job["rounds"]})


def shortest_of(names: Sequence[str]) -> dict[str, int]:
    """L of each world."""
    return {name: shortest_path(Robot(world_of(name))).steps or 0 for name in names}


# --- the search of settings --------------------------------------------------------------------

SEARCH_WORLDS, SEARCH_SEEDS = [f"similar:{i}" for i in range(40, 44)], range(3)
SEARCH_SETTINGS, SEARCH_ROUNDS, SEARCH_STEPS = 12, 300, 100_000


def drawn_settings(agent: str) -> list[dict[str, Any]]:
    """The settings that are tried, all different: the defaults, and others by chance."""
    random = Random(0, f"settings of {agent}")
    tried: list[dict[str, Any]] = [
        {"trace_decay": 0.9} if "trace_decay" in SEARCHED[agent] else {},
    ]
    while len(tried) < SEARCH_SETTINGS:
        these = {n: choices[random.index(len(choices))] for n, choices in SEARCHED[agent].items()}
        if these["first_value"] == "estimate":
            these.pop("initial_value", None)
        if these not in tried:
            tried.append(these)
    return tried


def cost(run: Run) -> float:
    """Steps of all rounds, over as many shortest paths."""
    steps = int(np.where(run.arrived, run.steps, LIMIT).sum())
    return (steps + LIMIT * (run.planned - len(run.steps))) / (run.planned * run.shortest)


def search(names: Sequence[str], journal: Journal, workers: int) -> dict[str, Any]:
    """For each agent the settings of the least cost in these worlds."""
    shortest = shortest_of(names)
    found: dict[str, Any] = {}
    for agent in SEARCHED:
        tried = drawn_settings(agent)
        jobs = [
            {"agent": agent, "settings": settings, "world": world, "seed": seed,
             "rounds": SEARCH_ROUNDS, "most_steps": SEARCH_STEPS}
            for settings in tried
            for world in names
            for seed in SEARCH_SEEDS
        ]  # fmt: skip
        results = run_all(execute, jobs, journal, workers=workers, what=f"settings of {agent}")
        costs = [cost(run_of(j, r, shortest[j["world"]])) for j, r in zip(jobs, results)]
        means = np.mean(np.reshape(costs, (len(tried), -1)), axis=1)
        best = int(means.argmin())
        found[agent] = {"settings": tried[best], "cost": round(float(means[best]), 3)}
        print(f"{agent}: {found[agent]}", flush=True)
    return found


# --- tables and figure -------------------------------------------------------------------------

Runs = dict[tuple[str, str], list[Run]]  # by agent and world


def percentiles(values: Sequence[float]) -> list[float]:
    """The 10th, the median, the 90th: each a value that occurs, as some are infinite."""
    return [float(v) for v in np.percentile(values, [10, 50, 90], method="nearest")]


def written(measure: Measure, runs: Sequence[Run], spread: bool = False) -> str:
    """Median, with its spread (10 to 90 %); in how many of the runs, where some have no value."""
    values = [measure.of(run) for run in runs]
    finite = sum(value < math.inf for value in values) / len(values)
    if not finite:
        return "never"
    share = "" if finite == 1 else f"in {100 * finite:.0f} %"
    low, middle, high = (
        measure.written(v) if v < math.inf else "never" for v in percentiles(values)
    )
    if middle == "never":
        return share
    text = f"{middle} ({low} to {high})" if spread and low != high else middle
    return f"{text}, {share}" if share else text


def table(corner: str, columns: Sequence[str], rows: Mapping[str, Sequence[str]]) -> str:
    """In Markdown."""
    lines = [[corner, *columns], ["---"] * (len(columns) + 1)]
    lines += [[row, *cells] for row, cells in rows.items()]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


BY_WORLD = ("steps to 1.25 L", "last path / L", "settled from round", "failed rounds")


def tables(runs: Runs, compared: Sequence[str], names: Sequence[str]) -> str:
    """All measures over all worlds; then some by world, with their spread."""
    everywhere = {
        agent: [
            written(measure, [run for name in names for run in runs[agent, name]])
            for measure in MEASURES.values()
        ]
        for agent in compared
    }
    text = ["All worlds, medians:\n", table("", list(MEASURES), everywhere)]
    for title in BY_WORLD:
        cells = {
            agent: [written(MEASURES[title], runs[agent, name], spread=True) for name in names]
            for agent in compared
        }
        text += [f"{title[0].upper()}{title[1:]}, median (10 to 90 %):\n", table("", names, cells)]
    return "\n".join(text)


def figure(runs: Runs, compared: Sequence[str], names: Sequence[str]) -> Any:
    """Steps to 1.25 L and the last path, a column a world, a line a learner: median, 10 to 90 %."""
    import matplotlib as mpl
    from devlearn.plots.style import BLUE, INK, STYLE, VERMILLION
    from matplotlib.figure import Figure

    learners = [agent for agent in compared if agent not in (FLOOR, BOUND)]
    colours = {COUNTED: VERMILLION, UNCOUNTED: VERMILLION, NONE: VERMILLION, ADAPTIVE: BLUE}
    shown = {
        "steps to 1.25 L": {1e2: "100", 1e3: "1 k", 1e4: "10 k", 1e5: "100 k", 1e6: "1 M"},
        "last path / L": {tick: f"{tick:g}" for tick in (1, 2, 4, 8, 16, 32)},
    }
    with mpl.rc_context(STYLE):
        drawn = Figure(figsize=(10.5, 5.0), layout="constrained")
        axes = drawn.subplots(2, len(names), sharex="row", sharey=True, squeeze=False)
        for row, (title, ticks) in zip(axes, shown.items()):
            finite: list[float] = []
            cells = {}
            for column, name in enumerate(names):
                for place, agent in enumerate(learners):
                    values = [MEASURES[title].of(run) for run in runs[agent, name]]
                    cells[column, place] = percentiles(values)
                    finite += [v for v in cells[column, place] if v < math.inf]
            left, right = 0.8 * min(finite), 1.25 * max(finite)
            never = 1.6 * right  # where what was never reached is drawn
            for (column, place), (low, middle, high) in cells.items():
                ax, colour = row[column], colours.get(learners[place], INK)
                known = middle < math.inf
                ax.plot([min(low, never), min(high, never)], [place] * 2, color=colour, gid="range")
                ax.plot(min(middle, never), place, color=colour, marker="o" if known else "x",
                        markersize=4.0, gid="median" if known else "never")  # fmt: skip
            for ax, name in zip(row, names):
                ax.set_xscale("log")
                ax.set_xlim(left, 1.25 * never)
                ax.axvspan(1.25 * right, 1.25 * never, color="#EEEEEE", linewidth=0, zorder=0)
                inside = [tick for tick in ticks if left <= tick <= right]
                ax.set_xticks(inside, [ticks[tick] for tick in inside])
                ax.set_xticks([], minor=True)
                ax.grid(axis="x", color="#DDDDDD", linewidth=0.5)
                ax.set_axisbelow(True)
                ax.set_title(name)
            row[len(names) // 2].set_xlabel(f"{title} (median, 10 to 90 %; x: never)")
            row[0].set_yticks(range(len(learners)), learners)
            row[0].set_ylim(len(learners) - 0.5, -0.5)
    return drawn


# --- the program -------------------------------------------------------------------------------


def main() -> None:
    """Runs what is missing; writes tables and figure."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--search", nargs="*", metavar="WORLD", help="search the settings anew")
    parser.add_argument("--worlds", nargs="+", default=worlds(), help="names, or KIND:SEED")
    parser.add_argument("--agents", nargs="+", default=COMPARED, choices=COMPARED)
    parser.add_argument("--seeds", type=int, default=SEEDS, help="how many, from 200 on")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--workers", type=int, default=1)
    asked = parser.parse_args()
    os.nice(10)
    journal = Journal(asked.folder / "side_by_side.jsonl")
    if asked.search is not None:
        found = search(asked.search or SEARCH_WORLDS, journal, asked.workers)
        SETTINGS.write_text(json.dumps(found, indent=2) + "\n")
    settings = json.loads(SETTINGS.read_text())
    shortest = shortest_of(asked.worlds)
    made = [COUNTED if agent == UNCOUNTED else agent for agent in asked.agents]  # the same runs
    jobs = [
        {"agent": agent, "settings": settings.get(agent, {}).get("settings", {}), "world": world,
         "seed": seed, "rounds": min(asked.rounds, FEWER_ROUNDS.get(agent, asked.rounds))}
        for agent in dict.fromkeys(made)
        for world in asked.worlds
        for seed in range(FIRST_SEED, FIRST_SEED + asked.seeds)
    ]  # fmt: skip
    results = run_all(execute, jobs, journal, workers=asked.workers, what="side by side")
    journal.close()
    runs: Runs = {}
    for job, result in zip(jobs, results):
        run = run_of(job, result, shortest[job["world"]])
        runs.setdefault((job["agent"], job["world"]), []).append(run)
        if job["agent"] == COUNTED:
            uncounted = run._replace(before=0, found=None)
            runs.setdefault((UNCOUNTED, job["world"]), []).append(uncounted)
    text = tables(runs, asked.agents, asked.worlds)
    (asked.folder / "side_by_side.md").write_text(text)
    figure(runs, asked.agents, asked.worlds).savefig(asked.folder / "side_by_side.png", dpi=120)
    print(text)


if __name__ == "__main__":
    main()
