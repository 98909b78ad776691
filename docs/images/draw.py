"""Draws the pictures in this folder: .venv/bin/python docs/images/draw.py"""

import contextlib
import io
import runpy
import tempfile
from pathlib import Path

import devlearn
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from devlearn import plots
from devlearn.plots.panels import shared_legend
from devlearn.plots.style import BLACK
from PIL import Image

HERE = Path(__file__).resolve().parent
GALLERY = HERE.parent / "gallery"


def save(figure, name, dpi):
    """A figure as a small PNG."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=dpi)
    plt.close(figure)
    save_small(drawn, HERE / name)


def save_small(drawn, path):
    """As a PNG of 256 colours, a third as large, without the version of matplotlib."""
    image = (
        Image.open(drawn)
        .convert("RGB")
        .quantize(256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    )
    image.save(path, optimize=True)
    print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


def draw_gallery():
    """What each program of the gallery draws, for docs/gallery.md."""
    for program in sorted(GALLERY.glob("*.py")):
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            runpy.run_path(str(program))
            plt.close("all")
            save_small(f"{program.stem}.png", program.with_suffix(".png"))


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


def map_of_a_flat():
    """Shades of 160 x 140 cells of 5 cm, as a robot that drove through four rooms draws them."""
    shades = np.full((140, 160), 205, dtype=np.uint8)
    shades[10:130, 10:150] = 254
    walls = np.zeros(shades.shape, dtype=bool)
    for rows, columns in (
        ((10, 13), (10, 150)), ((127, 130), (10, 150)), ((10, 130), (10, 13)),
        ((10, 130), (147, 150)), ((62, 65), (10, 150)), ((10, 65), (70, 73)),
        ((65, 130), (98, 101)),
    ):  # fmt: skip
        walls[slice(*rows), slice(*columns)] = True
    for rows, columns in (((62, 65), (24, 40)), ((62, 65), (120, 136)), ((95, 113), (98, 101))):
        walls[slice(*rows), slice(*columns)] = False
    furniture = np.zeros(shades.shape, dtype=bool)
    for rows, columns in (
        ((20, 38), (50, 62)), ((13, 21), (90, 125)), ((36, 46), (100, 112)), ((86, 104), (40, 62)),
        ((118, 127), (13, 45)), ((80, 92), (118, 130)), ((40, 50), (13, 22)),
    ):  # fmt: skip
        furniture[slice(*rows), slice(*columns)] = True
    solid = walls | furniture
    around = solid.copy()
    for axis in (0, 1):
        around |= np.roll(solid, 1, axis) | np.roll(solid, -1, axis)
    noise = np.random.default_rng(1).random(shades.shape) < 0.15
    shades[solid | (around & noise)] = 0
    shades[:, :10] = shades[:, 150:] = shades[:10] = shades[130:] = 205
    # Nobody has looked through the walls, nor into what stands about.
    inside = furniture & np.roll(furniture, 3, 0) & np.roll(furniture, -3, 0)
    shades[inside & np.roll(furniture, 3, 1) & np.roll(furniture, -3, 1)] = 205
    return shades


def draw_map():
    """A map's image, the world made of it, and a way learned there, for docs/maps.md."""
    shades = map_of_a_flat()
    with tempfile.TemporaryDirectory() as folder:
        Image.fromarray(shades).save(Path(folder) / "flat.pgm")
        yaml = Path(folder) / "flat.yaml"
        yaml.write_text(
            "image: flat.pgm\nresolution: 0.05\norigin: [-4.0, -3.5, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
        )
        world = devlearn.World.from_ros_map(
            yaml, start=(-2.9, 2.2, -90), target=(2.6, -2.2), unknown="border"
        )
    config = devlearn.TrialConfig.adaptive()
    paths = devlearn.Trial(world, config, seed=1).path_learning(100)
    best = int(np.argmin(paths.rounds["steps"]))
    shortest = devlearn.shortest_path(devlearn.Robot(world)).steps
    print(f"flat: rounds of {paths.rounds['steps'].tolist()} steps, shortest {shortest}")

    figure, axes = plt.subplots(1, 3, figsize=(9.0, 3.1), layout="constrained", sharey=True)
    axes[0].imshow(shades, cmap="gray", vmin=0, vmax=255, extent=(-4, 4, -3.5, 3.5))
    axes[0].set(xlabel="x [m]", ylabel="y [m]", title="the map's image")
    plots.plot_world(world, ax=axes[1], sonar=False, legend=False)
    axes[1].set(ylabel="", title=f"the world: {sum(map(corners, world.obstacles))} corners")
    plots.plot_world(world, ax=axes[2], sonar=False, legend=False)
    plots.plot_trajectory(paths, ax=axes[2], entry=best, by=None, color=BLACK, world=False)
    axes[2].set(
        ylabel="",
        title=f"round {best + 1}: {paths.rounds['steps'][best]} steps, shortest {shortest}",
    )
    save(figure, "map.png", 120)


def corners(polygon):
    return len(polygon.corners) + sum(map(len, polygon.holes))


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


def draw_film():
    """Rounds of a robot that learns to find its way, for docs/films.md."""
    trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
    film = devlearn.animate(trial.path_learning(100), rounds="1,3,10,last", seconds=8, width=400)
    film.save(HERE / "film.gif")
    print(f"film.gif: {(HERE / 'film.gif').stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    matplotlib.use("Agg")
    with matplotlib.rc_context({**plots.STYLE, "axes.titlesize": 9}):
        draw_worlds()
        draw_kinds()
        draw_map()
        draw_readme()
    draw_film()
    draw_gallery()
