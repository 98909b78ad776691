"""The pictures of the page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from .. import plots
from ..experiments import statistics
from ..experiments.measures import MEASURES, NEAR
from ..experiments.statistics import Estimate
from ..plots.bands import Band
from ..plots.looks import swatch
from ..plots.panels import Axes, figure_of, png
from . import maps, tables
from .compared import Compared, Contender
from .curves import can_be_drawn, learning_curves
from .tables import improvement, mean, percent
from .worst import Worst

_PIXELS = 108  # an inch, on the page, on which three stand side by side
_TAUS = 80


class Picture(NamedTuple):
    """A picture with its caption."""

    png: bytes
    width: int
    """On the page [pixels]; where that is too wide it is made smaller."""
    caption: str


def picture(axes: Axes, caption: str) -> Picture:
    """Of the figure that these axes are in."""
    return Picture(png(axes), round(figure_of(axes).get_figwidth() * _PIXELS), caption)


def swatches(contenders: Sequence[Contender]) -> dict[str, Picture]:
    """By contender: how it is drawn in every picture."""
    return {one.name: picture(swatch(one.look), one.name) for one in contenders}


def of_seeds(compared: Compared) -> str:
    """How many runs, in words."""
    seeds = compared.seeds
    together = seeds == [*range(seeds[0], seeds[-1] + 1)] and len(seeds) > 1
    named = f"{seeds[0]} to {seeds[-1]}" if together else ", ".join(map(str, seeds))
    return f"n = {len(seeds)} (seeds {named})"


def learning(compared: Compared) -> Iterator[tuple[str, Picture]]:
    """Learning curves, a world each."""
    looks = {one.name: one.look for one in compared.learners}
    for world in compared.worlds if can_be_drawn(compared) else ():
        bands = learning_curves(compared, world)
        if bands:
            axes = plots.plot_bands(
                bands, looks=looks, xlabel="steps, free learning counted",
                ylabel="steps of a round / shortest path", title=world,
            )  # fmt: skip
            yield world, picture(axes, world)


def profiles(compared: Compared) -> Iterator[Picture]:
    """Shares of the runs that end, or get, so near; over all worlds."""
    runs = f"{len(compared.worlds)} worlds x {of_seeds(compared)}; band: 95 % interval"
    shown: Sequence[tuple[str, str, str]] = (
        ("last_ratio", "last rounds / shortest path", "Share of the runs whose last 20 rounds, in "
         "the median, take at most so many times the shortest path"),
        ("within_1_25", "steps, free learning counted", "Share of the runs that had made a round "
         f"within {NEAR} of the shortest path by so many steps"),
    )  # fmt: skip
    for measure, xlabel, caption in shown:
        scores = {one.name: compared.scores(one, measure) for one in compared.learners}
        known = {name: values for name, values in scores.items() if values is not None}
        finite = np.concatenate([v[np.isfinite(v)] for v in known.values()] or [np.empty(0)])
        if not len(finite):
            continue
        taus = np.geomspace(finite.min() / 1.02, finite.max() * 1.02, _TAUS)
        bands = {}
        for name, values in known.items():
            shares = statistics.performance_profile(values, taus)
            ends = np.array([(share.value, share.low, share.high) for share in shares]).T
            bands[name] = Band(taus, *ends)
        axes = plots.plot_bands(
            bands, looks={one.name: one.look for one in compared.learners}, log="x", shares=True,
            xlabel=xlabel, ylabel="share of the runs",
        )  # fmt: skip
        yield picture(axes, f"{caption}: {runs}.")


def improvements(compared: Compared, references: Sequence[Contender]) -> Iterator[Picture]:
    """How likely each is better than a reference."""
    looks = {one.name: one.look for one in compared.contenders}
    for reference in references:
        for measure in ("within_1_25", "last_ratio"):
            found = {
                one.name: improvement(compared, one, reference, measure)
                for one in compared.learners
                if one is not reference
            }
            rows = {name: _ends(e) for name, e in found.items() if e is not None}
            if not rows:
                continue
            axes = plots.plot_intervals(
                rows, looks=looks, bound=0.5, limits=(0.0, 1.0), shares=True,
                xlabel=f"better than {reference.name}", title=tables.BRIEFLY[measure],
            )  # fmt: skip
            yield picture(
                axes,
                f"How often each has less than {reference.name} in the same world with the same "
                f"seed, ties by half: {len(compared.worlds)} worlds x {of_seeds(compared)}; 95 % "
                "intervals. Right of the middle: better than it, more often than not.",
            )


def wastes(compared: Compared) -> Iterator[Picture]:
    """The two wastes."""
    for measure in ("learning_waste", "computing_waste"):
        rows = {}
        for one in compared.contenders:
            scores = compared.scores(one, measure)
            if scores is not None:
                rows[one.name] = _ends(mean(scores))
        if rows:
            axes = plots.plot_intervals(
                rows, looks={one.name: one.look for one in compared.contenders}, shares=True,
                limits=(0.0, 1.0), xlabel=MEASURES[measure].doc, title=measure.replace("_", " "),
            )  # fmt: skip
            yield picture(
                axes,
                f"Means over {len(compared.worlds)} worlds x {of_seeds(compared)}, with 95 % "
                "intervals.",
            )


def _ends(found: Estimate) -> tuple[float, float, float]:
    return found.value, found.low, found.high


def generalisation(compared: Compared) -> Iterator[tuple[str, list[Picture]]]:
    """A world's maps, one of each that learns, where they were made."""
    if maps.REACH not in compared.frame:
        return
    for world in compared.worlds:
        drawn = []
        for one in compared.learners:
            runs = compared.runs(one, world)
            runs = runs[runs[maps.REACH].notna() & runs["error"].isna()]
            if not len(runs):
                continue
            trial = compared.trial(int(runs["run"].iloc[0]))
            found = maps.map_of(runs[maps.REACH].tolist(), trial)
            if not np.isfinite(found.arrived).all():
                continue
            axes = plots.plot_cells(
                trial, found.ratio, limits=(1.0, float(maps.MOST)), log=True,
                label="steps / shortest path", title=one.name,
            )  # fmt: skip
            shares = ", ".join(map(percent, found.arrived))
            seeds = ", ".join(map(str, runs["seed"]))
            caption = f"{one.name}: arrives from {shares} of all starts (a run each, seed {seeds})."
            drawn.append(picture(axes, caption))
        if drawn:
            yield world, drawn


def worst(run: Worst) -> Picture:
    """The last round of a run."""
    axes = plots.plot_trajectory(run.record, entry=-1, by="time", title=False)
    _, steps, arrived, _ = run.record.rounds[-1]
    outcome = "arrived" if arrived else "not arrived"
    return picture(
        axes,
        f"{run.contender.name} in {run.world}, seed {run.seed}: the last of its {run.rounds} "
        f"rounds, {steps} steps, {outcome}; {percent(run.failed)} of its rounds failed.",
    )
