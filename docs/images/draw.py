"""Draws the pictures in this folder: .venv/bin/python docs/images/draw.py"""

import io
from pathlib import Path

import devlearn
import matplotlib
import matplotlib.pyplot as plt
from devlearn import plots
from devlearn.plots.panels import shared_legend
from devlearn.plots.style import BLACK
from PIL import Image

HERE = Path(__file__).resolve().parent


def save(figure, name, dpi):
    """As a PNG of 256 colours, a third as large, without the version of matplotlib."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dpi)
    plt.close(figure)
    image = (
        Image.open(drawn)
        .convert("RGB")
        .quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    )
    image.save(HERE / name, optimize=True)
    print(f"{name}: {(HERE / name).stat().st_size / 1000:.0f} kB")


def draw_worlds():
    """Every world that ships, for docs/worlds.md."""
    for name in devlearn.worlds():
        save(plots.plot_world(devlearn.World.load(name)).figure, f"world_{name}.png", 110)


def draw_kinds():
    """One world of each kind that is drawn by chance, at three difficulties."""
    for kind in ("similar", "clutter", "corridors", "rooms", "traps"):
        figure, axes = plt.subplots(1, 3, figsize=(6.0, 2.5), layout="constrained")
        figure.get_layout_engine().set(h_pad=0.08)
        for ax, difficulty in zip(axes, (0.0, 0.5, 1.0)):
            world = devlearn.World.random(kind, 1, difficulty=difficulty)
            plots.plot_world(world, ax=ax, sonar=False, legend=False)
            ax.set_title(f"difficulty {difficulty:g}")
            ax.set(xlabel="", ylabel="", xticks=[], yticks=[])
        shared_legend(figure, axes)
        save(figure, f"kind_{kind}.png", 110)


def draw_readme():
    """From wandering to a path of its own: the head of the README."""
    trial = devlearn.Trial(devlearn.World.load("paper"), seed=0)
    first = trial.free_learning(10_000)
    trial.free_learning(10_000)
    paths = trial.path_learning(600)

    figure = plt.figure(figsize=(8.0, 3.2))
    axes = [
        figure.add_axes((left / 8.0, 0.62 / 3.2, 2.35 / 8.0, 2.35 / 3.2))
        for left in (0.37, 2.98, 5.59)
    ]
    plots.plot_trajectory(first, ax=axes[0], legend=False)
    plots.plot_preferences(trial, ax=axes[1], colorbar=False, legend=False)
    plots.plot_sef(trial.world, ax=axes[2], colorbar=False, legend=False)
    plots.plot_trajectory(paths, ax=axes[2], entry=-1, by=None, color=BLACK, world=False)
    axes[2].lines[-1].set_linewidth(2.0)
    titles = (
        "its first round: exploring",
        "what it learned to prefer",
        f"its last round: {paths.rounds['steps'][-1]} steps",
    )
    for ax, title in zip(axes, titles):
        ax.set_title(title)
    for ax in axes[1:]:
        ax.set_ylabel("")
        ax.set_yticks([])
    shared_legend(figure, axes)
    save(figure, "readme.png", 150)


if __name__ == "__main__":
    matplotlib.use("Agg")
    with matplotlib.rc_context({**plots.STYLE, "axes.titlesize": 9}):
        draw_worlds()
        draw_kinds()
        draw_readme()
