"""How well does the adaptive learner find its way? Criteria, and what came of them.

Runs of 600 rounds of at most 10 000 steps, without free learning, seeds from 100 on, in the seven
worlds that ship and in the similar worlds 20 to 39; the learner in three forms: by its first part
alone (`refine` off), by its defaults, and with curious rounds. Control: the paper's learner, with
its two times 10 000 steps of free learning before, which ends after 20 failed rounds in a row.

Held good, as said before it was run, of the defaults:

- no round fails after round 20;
- at least 99 % of the runs settle: from some round on, for at least 20, all motions are the same;
- the last path over the shortest is, in the median of each world, at most 1.06 (`clutter` 1.08,
  `slalom` 1.11), and at most 1.035 in the median over all runs;
- the median of all steps is at most that of the paper's learner in each world that this one solves
  (in most runs, each of the last 20 rounds arrives).

With curious rounds a round in some ten deviates for good; there, "settles" means that the habit no
longer changes for at least 20 rounds, and the last path is the habit's.

    python bench/adaptive_quality.py FOLDER [SEEDS] [WORKERS]     goes on where it was stopped
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
from devlearn import Results, Trial, sweep, worlds
from devlearn.experiments.measures import Run
from devlearn.experiments.spec import Spec, read

ROUNDS, LIMIT, LATE, SAME, FIRST_SEED = 600, 10_000, 20, 20, 100
MOST = {"clutter": 1.08, "slalom": 1.11}
NAMES = [*worlds(), *(f"similar:{i}" for i in range(20, 40))]


def forms(seeds: int) -> dict[str, Spec]:
    """What is run, by form."""
    numbers = f"{FIRST_SEED}-{FIRST_SEED + seeds - 1}"
    common = {"worlds": NAMES, "seeds": numbers, "rounds": ROUNDS, "step_limit": LIMIT,
              "keep": "rounds"}  # fmt: skip

    def adaptive(**settings: Any) -> dict[str, Any]:
        alone = {"free": [], "hopeless": 0, "agents": ["adaptive"]}
        return {**common, **alone, "settings": {"adaptive": settings}}

    return {
        "first part": read(adaptive(refine=False)),
        "defaults": read(adaptive()),
        "curious": read({**adaptive(curious_every=10), "measures": ["adaptive_quality:habit"]}),
        "paper": read({**common, "agents": ["paper"]}),
    }


def habit(run: Run) -> int | None:
    """From which round on the habit no longer changed; None where it still did."""
    trial = Trial(run.trial.world, run.trial.config, run.trial.seed)  # once more, to look at it
    learner: Any = trial.learner
    costs = []
    for _ in range(ROUNDS):
        trial.path_learning(1, LIMIT, rounds_only=True)
        costs.append(learner.habit_cost)
    changed = [i for i in range(1, ROUNDS) if costs[i] != costs[i - 1]]
    return changed[-1] + 1 if changed and changed[-1] < ROUNDS - SAME else None


def measured(row: dict[str, Any], rounds: Any, form: str) -> dict[str, Any]:
    """What the criteria need of a run."""
    paths = rounds[len(json.loads(row["schedule"])["free"]) :]
    failed = (np.flatnonzero(~paths["arrived"]) + 1).tolist()
    last = paths[-1]
    if form == "paper":
        solved = len(paths) == ROUNDS and not any(n > ROUNDS - LATE for n in failed)
        return {"last": int(last["steps"]), "solved": solved, "failed": failed,
                "total": int(row["steps"])}  # fmt: skip
    settled = row["adaptive_quality:habit"] if form == "curious" else row["settled_round"]
    steps = np.median(paths["steps"][-5 * SAME :]) if form == "curious" else last["steps"]
    return {
        "last": int(steps),
        "settled": None if settled in (None, math.inf) else int(settled),
        "failed": failed,
        "total": int(row["steps"]),
        "first": row["first_arrival"],
        "touching": int(last["touches"]) / max(1, int(last["steps"])),
    }


def table(results: dict[tuple[str, str], list[dict[str, Any]]], shortest: dict[str, int]) -> bool:
    """Prints what came, and whether the criteria hold."""
    good = True

    def judged(holds: bool, text: str) -> None:
        nonlocal good
        good = good and holds
        print(f"{'holds' if holds else 'FAILS'}: {text}")

    print(
        f"{'world':12} {'form':11} n    ratio (10-90 %)        settled from   late  total   first"
    )
    for (name, form), runs in results.items():
        ratios = np.array([r["last"] for r in runs]) / shortest[name]
        low, middle, high = np.percentile(ratios, [10, 50, 90])
        totals = np.median([r["total"] for r in runs])
        late = sum(1 for r in runs for n in r["failed"] if n > LATE)
        if form == "paper":
            solved = sum(r["solved"] for r in runs)
            print(f"{name:12} {form:11} {len(runs):4} {middle:.3f} ({low:.3f}-{high:.3f})"
                  f"  solved {solved:4}            {late:5} {totals / 1e3:6.0f}k")  # fmt: skip
            continue
        settled = [r["settled"] for r in runs if r["settled"] is not None]
        print(f"{name:12} {form:11} {len(runs):4} {middle:.3f} ({low:.3f}-{high:.3f})"
              f"  {len(settled):4}, {np.median(settled):4.0f}           {late:5}"
              f" {totals / 1e3:6.0f}k {np.median([r['first'] for r in runs]) / 1e3:6.1f}k"
              f"  touching {np.mean([r['touching'] for r in runs]):.3f}")  # fmt: skip
    for form in ("first part", "defaults", "curious"):
        of_form = {name: runs for (name, f), runs in results.items() if f == form}
        runs = [r for each in of_form.values() for r in each]
        late = [(name, r) for name, each in of_form.items() for r in each
                if any(n > LATE for n in r["failed"])]  # fmt: skip
        settled = sum(r["settled"] is not None for r in runs)
        ratios = [r["last"] / shortest[name] for name, each in of_form.items() for r in each]
        print(f"\n{form}: {len(runs)} runs, ratio {np.median(ratios):.4f}, settled {settled}, "
              f"runs that fail late {len(late)}")  # fmt: skip
        if form != "defaults":
            continue
        judged(not late, f"no round fails after round {LATE}")
        judged(settled >= 0.99 * len(runs), f"{settled} of {len(runs)} runs settle")
        for name, each in of_form.items():
            most = MOST.get(name, 1.06)
            ratio = np.median([r["last"] for r in each]) / shortest[name]
            judged(ratio <= most, f"{name}: {ratio:.3f} <= {most}")
        judged(np.median(ratios) <= 1.035, f"over all: {np.median(ratios):.4f} <= 1.035")
        for name, each in of_form.items():
            control = results[name, "paper"]
            if 2 * sum(r["solved"] for r in control) <= len(control):
                continue
            ours, theirs = (np.median([r["total"] for r in rs]) for rs in (each, control))
            judged(ours <= theirs, f"{name}: {ours / 1e3:.0f}k <= {theirs / 1e3:.0f}k steps in all")
    return good


def main() -> None:
    """Runs what is missing, and prints."""
    folder = Path(sys.argv[1])
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    workers = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    asked = forms(seeds)
    file: Results = sweep([*asked.values()], folder / "adaptive_quality.sqlite", workers=workers)
    results: dict[tuple[str, str], list[dict[str, Any]]] = {
        (name, form): [] for name in NAMES for form in asked
    }
    shortest = {}
    for form, spec in asked.items():
        for row in file.rows(spec.jobs()):
            run = measured(row, file.rounds(row["run"]), form)
            results[row["world"], form].append(run)
            shortest[row["world"]] = row["shortest"]
            if form == "defaults" and (run["settled"] is None or run["failed"][-1:] > [LATE]):
                print("exception:", row["world"], row["seed"], json.dumps(run))
    sys.exit(0 if table(results, shortest) else 1)


if __name__ == "__main__":
    main()
