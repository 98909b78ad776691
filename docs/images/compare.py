"""Writes the tables and pictures of docs/comparison.md and docs/what-holds.md from results.

    python docs/images/compare.py out/compare/results.sqlite

Tables in Markdown are printed; pictures are written beside this file.
"""

import sys
from pathlib import Path

import numpy as np
from devlearn import Results, plots
from devlearn.comparison import figures, tables
from devlearn.comparison.compared import Compared
from devlearn.experiments import statistics
from devlearn.experiments.measures import MEASURES
from devlearn.plots.bands import Band
from devlearn.plots.panels import png

OPEN = ("paper", "corridor", "empty")
HERE = Path(__file__).parent


def cell(found, write):
    """A value with its interval."""
    told = tables.told(found, write)
    return told.text if told.text == told.spread.partition(" to ")[0] == told.spread.partition(
        " to ")[2] else f"{told.text} ({told.spread})"  # fmt: skip


def table(corner, columns, rows):
    """In Markdown."""
    lines = [[corner, *columns], ["---"] * (len(columns) + 1), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def first(compared):
    """The first table of the page."""
    rows = []
    for one in compared.contenders:
        found = [(tables.estimate(compared, one, column), column) for column in tables.FIRST]
        rows.append([one.name, *(cell(e, column.write) for e, column in found)])
    heads = [f"{column.title}, {column.of}" for column in tables.FIRST]
    return table("", heads, rows)


def by_world(compared, measure):
    """Medians of a measure in each of the worlds that ship, and of all similar ones."""
    similar = [world for world in compared.worlds if ":" in world]
    groups = {world: [world] for world in compared.worlds if world not in similar}
    groups["similar"] = similar
    rows = []
    for one in compared.learners:
        cells = []
        for worlds in groups.values():
            scores = compared.scores(one, measure, worlds)
            write = lambda value: tables.written(MEASURES[measure], value)  # noqa: E731
            cells.append(cell(statistics.estimate_median(scores), write))
        rows.append([one.name, *cells])
    return table("", [*groups], rows)


def wastes(compared, reference):
    """Both wastes in open worlds and in the others, and how many times the reference's."""
    open_worlds = [w for w in compared.worlds if w in OPEN or w.startswith("similar:")]
    others = [w for w in compared.worlds if w not in open_worlds]
    rows = []
    for one in compared.contenders:
        cells = []
        for measure in ("learning_waste", "computing_waste"):
            for worlds in (open_worlds, others):
                scores = compared.scores(one, measure, worlds)
                theirs = compared.scores(reference, measure, worlds)
                share = tables.percent(scores.mean())
                if one is reference:
                    cells.append(f"{share}, 1")
                    continue
                ratio = statistics.bootstrap(
                    statistics.ratio(statistics.mean), scores, theirs, paired=True
                )
                cells.append(f"{share}, {cell(ratio, '{:.2f}'.format)}")
        rows.append([one.name, *cells])
    heads = [
        f"{w} waste, {where}" for w in ("learning", "computing") for where in ("open", "other")
    ]
    return table("", heads, rows)


def main():
    """Prints and draws."""
    compared = Compared(Results(sys.argv[1]))
    print(f"{len(compared.worlds)} worlds, {figures.of_seeds(compared)}\n")
    print(first(compared))
    for measure in ("within_1_25", "last_ratio", "settled_round", "failed_share"):
        print(f"### {MEASURES[measure].doc}\n\n{by_world(compared, measure)}")
    paper = [one for one in compared.contenders if one.agent == "paper"]
    for reference in paper:
        print(f"### wastes, and how many times those of {reference.name}\n")
        print(wastes(compared, reference))
    adaptive = next(one for one in compared.contenders if one.agent == "adaptive")
    learning, computing = figures.wastes(compared)
    for name, drawn in (
        ("compare_last", last(compared)),
        ("compare_pairs", next(figures.improvements(compared, [adaptive])).png),
        ("compare_learning_waste", learning.png),
        ("compare_computing_waste", computing.png),
    ):
        (HERE / f"{name}.png").write_bytes(drawn)


def last(compared):
    """How many runs end within so many times the shortest path, with a legend."""
    taus = np.geomspace(1, 12, 120)
    bands = {}
    for one in compared.learners:
        profile = statistics.performance_profile(compared.scores(one, "last_ratio"), taus)
        bands[one.name] = Band(taus, *np.array([(e.value, e.low, e.high) for e in profile]).T)
    axes = plots.plot_bands(
        bands, looks={one.name: one.look for one in compared.learners}, log="x", shares=True,
        xlabel="last rounds / shortest path", ylabel="share of the runs",
    )  # fmt: skip
    axes.figure.set_size_inches(8.2, 3.6)
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False, fontsize=8)
    return png(axes)


if __name__ == "__main__":
    main()
