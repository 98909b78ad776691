"""The figures of section VI, each composed of plots of freshly made runs.

Figures 6 to 9 show the runs of seeds 1 to 4; figures 10 to 12 those of the first seeds that
settled, each on a path of its own, since the paper shows such runs. All are of the `paper` preset.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .. import plots
from .._core import Learner, Trial, TrialConfig, World
from .._files import made_folder
from ..analysis.episodes import find_entry_and_window, find_episodes
from ..errors import InvalidValue
from ..plots.panels import Figure, panels, shared_legend, write_picture
from ..plots.style import BLACK, BLUE, VERMILLION, styled
from ..record import Record, written_aside
from . import measures, places, schedule, tables


class Drawn(NamedTuple):
    """A figure with its file's name and its caption."""

    name: str
    figure: Figure
    caption: str


class Gallery:
    """Draws the figures; the runs behind them are made when first needed, once."""

    def __init__(self, world: World | None = None, config: TrialConfig | None = None) -> None:
        self.world = world or World.load("paper")
        self.config = config or TrialConfig.paper()

    @cached_property
    def four(self) -> list[schedule.Run]:
        """Two rounds of free learning of seeds 1 to 4."""
        free = schedule.SECTION_VI.replace(rounds=1)
        return [schedule.run(self.world, self.config, seed, free) for seed in (1, 2, 3, 4)]

    @cached_property
    def long(self) -> schedule.Run:
        """The first of the four with all its rounds of path learning."""
        return schedule.run(self.world, self.config, 1)

    @cached_property
    def settled(self) -> list[schedule.Run]:
        """The first three runs that settled, on different paths."""
        return list(itertools.islice(schedule.settled_runs(self.world, self.config), 3))

    @cached_property
    def shortest(self) -> int:
        """Steps of the shortest path from the start."""
        return places.shortest(self.world, self.config)

    @styled
    def draw(self, number: int) -> list[Drawn]:
        """The figures of a number of the paper's; 0 stands for those beyond it."""
        return FIGURES[number](self)

    # --- the paper's figures ----------------------------------------------------------------------

    def _world(self) -> list[Drawn]:
        figure, ax = panels(1, 1)
        plots.plot_world(self.world, ax=ax[0], robot=self.config.robot)
        return [
            Drawn(
                "fig02_world",
                figure,
                "The simulation environment: obstacles, the robot with its heading and its five "
                "sonar rays at the start, and the target. The paper gives a picture only; this "
                "arrangement stands in for it.",
            )
        ]

    def _sef(self) -> list[Drawn]:
        figure, axes = panels(1, 2, projections=["3d"])
        plots.plot_sef_surface(self.world, ax=axes[0])
        plots.plot_sef(self.world, ax=axes[1])
        return [
            Drawn(
                "fig04_sef",
                figure,
                "The SEF energy over the arena (Eq. 6): as a surface and as a map. It is highest "
                "at the target and falls steeply at obstacles, where the drawing is cut off.",
            )
        ]

    def _free_learning(self) -> list[Drawn]:
        arrivals = [measures.first_arrival(made.first) for made in self.four]
        return [
            Drawn(
                "fig06_free_learning",
                self._four_paths([made.first for made in self.four]),
                "Four free-learning processes of 10 000 steps (seeds 1 to 4). The target was first "
                f"reached after {_listed(arrivals)} steps.",
            )
        ]

    def _counts(self) -> list[Drawn]:
        figure, ax = panels(1, 1, height=2.6, width=4.2)
        record = self.four[0].first
        plots.plot_counts(record, ax=ax[0])
        late = measures.change_after(record.explored_count, 3000)
        return [
            Drawn(
                "fig07_counts",
                figure,
                "Mappings explored (NUM_RM) and effective (NUM_M) during the free learning of "
                f"Fig. 6(a). After step 3000 NUM_RM still gains {late:.0%} of its final value.",
            )
        ]

    def _episodes(self) -> list[Drawn]:
        record = self.four[0].first
        found = find_episodes(record)
        figure, ax = panels(1, 1, height=2.8, width=4.8)
        plots.plot_episodes(record, ax=ax[0])
        missing = "".join(sorted(kind for kind, where in found.items() if where is None))
        drawn = [
            Drawn(
                "fig08_episodes",
                figure,
                "The first 30 steps of Fig. 7, with the paper's four kinds of episode: a, an "
                "effective motion is explored; b, ineffective ones are explored; c, effective ones "
                "are exploited; d, reduction development removes one."
                + (f" Absent from this window: {', '.join(missing)}." if missing else ""),
            )
        ]
        phases = {"this round": record, "round 2": self.four[0].second}
        phases["path learning"] = self.long.paths
        for kind in missing:
            places = [
                (phase, searched, place)
                for phase, searched in phases.items()
                if (place := find_entry_and_window(searched, kind)) is not None
            ]
            if not places:
                drawn[0] = drawn[0]._replace(caption=drawn[0].caption + f" {kind} never occurs.")
                continue
            phase, searched, (entry, window) = places[0]
            figure, ax = panels(1, 1, height=2.8, width=4.8)
            plots.plot_episodes(searched, ax=ax[0], entry=entry, window=window)
            drawn.append(
                Drawn(
                    f"fig08_episode_{kind}",
                    figure,
                    f"Episode {kind}, absent from the first 30 steps, where the same run first has "
                    f"one: in {phase}, round {searched.rounds['round'][entry]}, steps "
                    f"{window[0] + 1} to {window[1]}.",
                )
            )
        return drawn

    def _second_rounds(self) -> list[Drawn]:
        pairs = [
            (measures.first_arrival(m.first), measures.first_arrival(m.second)) for m in self.four
        ]
        arrivals = "; ".join(f"{_or_never(a)}, then {_or_never(b)}" for a, b in pairs)
        return [
            Drawn(
                "fig09_second_round",
                self._four_paths([made.second for made in self.four]),
                "The second rounds of the four runs of Fig. 6, with what was learned in the first. "
                f"Steps to the target, first and second round: {arrivals}.",
            )
        ]

    def _path_optimisation(self) -> list[Drawn]:
        paths = self.settled[0].paths
        numbers = paths.rounds["round"]
        settled = measures.settled_round(paths)
        chosen = [n for n in (3, 33, 95, 202, 341, int(numbers[-1])) if n in numbers]
        figure, axes = panels(2, 3, height=5.2)
        for number, ax in zip(chosen, axes):
            entry = int(np.flatnonzero(numbers == number)[0])
            plots.plot_trajectory(paths, ax=ax, entry=entry, legend=False, title=False)
            ax.set_title(f"round {number}: {paths.rounds['steps'][entry]} steps")
        shared_legend(figure, axes)
        rounds, ax = panels(1, 1, height=2.8, width=4.8)
        plots.plot_rounds(paths, ax=ax[0], shortest=self.shortest, settled=settled)
        seed = self.settled[0].trial.seed
        return [
            Drawn(
                "fig10_path_optimisation",
                figure,
                f"Path learning of seed {seed}, the first that settled: some of its rounds.",
            ),
            Drawn(
                "fig10_rounds",
                rounds,
                f"Steps of every round of the same run; settled from round {settled} on at "
                f"{paths.rounds['steps'][-1]} steps, the shortest possible being {self.shortest}.",
            ),
        ]

    def _habits(self) -> list[Drawn]:
        others = self.settled[1:]
        figure, axes = panels(1, len(others), height=3.2, width=4.8)
        for made, ax in zip(others, axes):
            plots.plot_trajectory(made.paths, ax=ax, entry=-1, legend=False, title=False)
            ax.set_title(f"seed {made.trial.seed}: {made.paths.rounds['steps'][-1]} steps")
        shared_legend(figure, axes)
        return [
            Drawn(
                "fig11_habits",
                figure,
                "Other habits: the paths on which the next two seeds settled.",
            )
        ]

    def _new_starts(self) -> list[Drawn]:
        learner = self.settled[0].trial.learner
        assert isinstance(learner, Learner)
        figure, axes = panels(1, 4, height=2.4)
        needed = []
        for (pose, shortest), ax in zip(places.new_starts(self.world, self.config, 4), axes):
            rounds = schedule.useful_round(self.world, self.config, learner, pose, shortest)
            if rounds is None:
                plots.plot_world(self.world.with_start(pose), ax=ax, sonar=False, legend=False)
                ax.set_title(f"not in {schedule.NEW_START_ROUNDS} rounds")
                needed.append("none")
                continue
            plots.plot_trajectory(rounds, ax=ax, entry=-1, legend=False, title=False)
            steps = rounds.rounds["steps"][-1]
            ax.set_title(f"round {len(rounds.rounds)}: {steps} steps\n(shortest {shortest})")
            needed.append(str(len(rounds.rounds)))
        shared_legend(figure, axes)
        return [
            Drawn(
                "fig12_new_starts",
                figure,
                "New starts with what the run of Fig. 10 had learned: the first round within 1.5 "
                f"times the shortest path. Rounds needed: {', '.join(needed)}.",
            )
        ]

    def _beyond(self) -> list[Drawn]:
        made = self.settled[0]
        preferences, ax = panels(1, 1, width=4.8, height=4.4)
        plots.plot_preferences(made.trial, ax=ax[0])
        kinds, ax = panels(1, 1, width=4.2, height=4.2)
        plots.plot_trajectory(self.four[0].first, ax=ax[0])
        return [
            Drawn(
                "preferences",
                preferences,
                "What the run of Fig. 10 prefers: for each cell the mean direction of the motions "
                "with the highest orientation.",
            ),
            Drawn(
                "kinds",
                kinds,
                "The free learning of Fig. 6(a), coloured by why each motion was chosen: explored, "
                "exploited, or drawn because everything had been tried in vain.",
            ),
        ]

    def _four_paths(self, records: Sequence[Record]) -> Figure:
        figure, axes = panels(1, 4, height=2.5)
        for letter, record, ax in zip("abcd", records, axes):
            plots.plot_trajectory(record, ax=ax, legend=False, title=False)
            ax.set_title(f"({letter})")
        shared_legend(figure, axes)
        return figure


# By the paper's numbers; 0 for what the paper does not draw.
FIGURES: Mapping[int, Callable[[Gallery], list[Drawn]]] = {
    2: Gallery._world,
    4: Gallery._sef,
    6: Gallery._free_learning,
    7: Gallery._counts,
    8: Gallery._episodes,
    9: Gallery._second_rounds,
    10: Gallery._path_optimisation,
    11: Gallery._habits,
    12: Gallery._new_starts,
    0: Gallery._beyond,
}


def save_figure(folder: Path, drawn: Drawn) -> list[Path]:
    """Write a figure as PNG and SVG; returns the files. Raises FileError."""
    made_folder(folder)
    paths = [folder / f"{drawn.name}.{kind}" for kind in ("png", "svg")]
    for path in paths:
        with written_aside(path, "wb") as file:
            write_picture(drawn.figure, file, path.suffix[1:], drawn.name)
    return paths


def draw_figure(output: str | os.PathLike[str], number: int) -> list[Path]:
    """Draw one figure of the paper (0: those beyond it), and nothing else; returns the files.

    Raises InvalidValue, FileError.
    """
    if number not in FIGURES:
        known = ", ".join(map(str, FIGURES))
        raise InvalidValue("figure", number, f"one of {known} (0: what the paper does not draw)")
    folder = Path(output) / "figures"
    return [path for drawn in Gallery().draw(number) for path in save_figure(folder, drawn)]


# --- statistics over the seeds --------------------------------------------------------------------


@styled
def draw_rounds_over_seeds(runs_by_preset: Mapping[str, Sequence[Mapping[str, Any]]]) -> Drawn:
    """Steps by round, median and 10th to 90th percentile of the runs, beside the paper's."""
    figure, (ax,) = panels(1, 1, width=4.8, height=3.0)
    styles = [(BLUE, "-"), (VERMILLION, "--")]
    for (name, runs), (color, line) in zip(runs_by_preset.items(), styles):
        low, median, high = tables.steps_over_runs(runs)
        rounds = np.arange(3, 3 + len(median))
        ax.fill_between(rounds, low, high, color=color, alpha=0.18, linewidth=0)
        ax.plot(rounds, median, line, color=color, label=f"{name}: median, 10-90 %")
    ax.plot(
        list(tables.PAPER_TABLE_1), list(tables.PAPER_TABLE_1.values()), "o", color=BLACK,
        markersize=3.5, label="Table 1 of the paper",
    )  # fmt: skip
    ax.set_yscale("log")
    ax.set_xlabel("round")
    ax.set_ylabel("steps of the round")
    ax.legend()
    return Drawn(
        "rounds_over_seeds",
        figure,
        "Steps by round over all seeds, beside the one run that the paper tabulates.",
    )


@styled
def draw_sigmas(by_sigma: Mapping[float, Sequence[Mapping[str, Any]]]) -> Drawn:
    """When runs settle, and how long their last rounds are, by sigma."""
    figure, axes = panels(1, 2, height=2.8)
    for ax, measure, label in zip(
        axes,
        ("settled_early", "last_steps"),
        ("settled from round (603: not)", "steps, mean of last 20 rounds"),
    ):
        values = {f"{sigma:g}": [run[measure] for run in runs] for sigma, runs in by_sigma.items()}
        plots.plot_distribution(values, ax=ax, ylabel=label)
        ax.set_xlabel("sigma (Eq. 7)")
    axes[1].set_yscale("log")
    return Drawn("sigmas", figure, "The weight of orientation against curiosity, over all seeds.")


@styled
def draw_run(trial: Trial, paths: Record) -> Drawn:
    """One run at a glance: its last path, what it prefers, and the steps of its rounds."""
    count = 3 if len(paths.rounds) else 1
    figure, axes = panels(1, count, width=3.6 * count, height=3.6)
    if len(paths.rounds):
        plots.plot_trajectory(paths, ax=axes[1], entry=-1)
        plots.plot_rounds(paths, ax=axes[2], settled=measures.settled_round(paths))
    if trial.learner is not None:
        plots.plot_preferences(trial, ax=axes[0])
    return Drawn("overview", figure, "One run: what it prefers, its last path, its rounds.")


def _or_never(step: int | None) -> str:
    return "never" if step is None else str(step)


def _listed(steps: Sequence[int | None]) -> str:
    *head, last = map(_or_never, steps)
    return f"{', '.join(head)} and {last}"
