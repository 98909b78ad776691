"""A map of a building, imported, loaded and driven in: the table of docs/maps.md.

    .venv/bin/python bench/building.py --output out/building [--map MAP.yaml]

Makes a map of 2000 x 2000 cells of 5 cm: rooms of 4 to 8 m along corridors, doors of 0.9 m,
furniture, noise of a cell along the walls, unknown space around. Takes a minute of one core.
"""

from __future__ import annotations

import argparse
import time
from functools import partial
from pathlib import Path

import devlearn
import numpy as np
from devlearn.maps import import_ros_map
from PIL import Image

FREE, OCCUPIED, UNKNOWN = 254, 0, 205
STEPS = 200_000


def building(side: int = 2000, seed: int = 1) -> np.ndarray:
    """Shades of cells of 5 cm, as a robot that drove through all rooms would have drawn them."""
    random = np.random.default_rng(seed)
    shades = np.full((side, side), UNKNOWN, dtype=np.uint8)
    margin, corridor, wall, door = 40, 44, 4, 18
    shades[margin:-margin, margin:-margin] = FREE
    walls = np.zeros((side, side), dtype=bool)
    walls[margin : margin + wall, margin:-margin] = walls[
        -margin - wall : -margin, margin:-margin
    ] = True
    walls[margin:-margin, margin : margin + wall] = walls[
        margin:-margin, -margin - wall : -margin
    ] = True
    # Bands of rooms on both sides of corridors that lead all through, joined at both ends.
    low = margin + wall
    while low < side - margin - 260:
        for begin, end, towards in (
            (low, low + 110, low + 110),
            (low + 114 + corridor, low + 224 + corridor, low + 110 + corridor),
        ):
            walls[towards : towards + wall, margin + corridor : -margin - corridor] = True
            column = margin + corridor
            while column < side - margin - corridor - 60:
                width = int(random.integers(80, 160))
                last = min(column + width, side - margin - corridor)
                walls[begin:end, column : column + wall] = True
                middle = int(
                    random.integers(column + wall + 4, max(last - door - 4, column + wall + 5))
                )
                walls[towards : towards + wall, middle : middle + door] = False
                for _ in range(int(random.integers(1, 6))):
                    height, breadth = random.integers(6, 28, 2)
                    y = int(random.integers(begin + 8, max(begin + 9, end - height - 8)))
                    x = int(random.integers(column + 8, max(column + 9, last - breadth - 8)))
                    walls[y : y + height, x : x + breadth] = True
                column = last
        walls[
            low + 224 + corridor : low + 228 + corridor, margin + corridor : -margin - corridor
        ] = True
        low += 228 + corridor
    # A cell on or off along the walls, as a laser makes it.
    edge = walls ^ (
        np.roll(walls, 1, 0) | np.roll(walls, -1, 0) | np.roll(walls, 1, 1) | np.roll(walls, -1, 1)
    )
    noise = random.random(walls.shape) < 0.12
    shades[walls | (edge & noise)] = OCCUPIED
    return shades


def write(folder: Path) -> Path:
    """The map's YAML."""
    folder.mkdir(parents=True, exist_ok=True)
    Image.fromarray(building()).save(folder / "building.pgm")
    yaml = folder / "building.yaml"
    yaml.write_text(
        "image: building.pgm\nresolution: 0.05\norigin: [-50.0, -50.0, 0.0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return yaml


def seconds(call, *arguments):
    """Of processor time that a call takes, and what it gives."""
    begun = time.process_time()
    result = call(*arguments)
    return time.process_time() - begun, result


def free_learning(world, **how):
    return devlearn.Trial(world, seed=1, **how).free_learning(STEPS)


def steps(world):
    """Nanoseconds a step of free learning, and the share of steps that touch something."""
    for who, how in (
        ("preset paper", {}),
        ("adaptive", {"config": devlearn.TrialConfig.adaptive()}),
        ("random motions", {"agent": devlearn.RandomAgent(5)}),
    ):
        took, record = min(
            (seconds(partial(free_learning, world, **how)) for _ in range(3)), key=first
        )
        print(f"  {who}: {took / STEPS * 1e9:.0f} ns a step, {record['collided'].mean():.1%} touch")


def first(pair):
    return pair[0]


def measure(path, folder):
    took, made = seconds(import_ros_map, path)
    print(
        f"{path.name}: {made.columns} x {made.rows} cells imported in {took:.2f} s; "
        f"{made.outlines} outlines, {made.holes} holes, {made.corners} corners, error "
        f"{made.error:.3g} m, free {made.free_area:.0f} m^2"
    )
    file = folder / f"{path.stem}.json"
    made.world.save(file)
    took, world = seconds(devlearn.World.load, file)
    print(f"  loaded in {took:.2f} s from {file.stat().st_size / 1e6:.1f} MB")
    steps(world)
    robot = devlearn.Robot(world)
    took, _ = seconds(devlearn.may_reach_target, robot)
    print(f"  found to have a way in {took:.2f} s")
    took, found = seconds(devlearn.shortest_path, robot)
    print(f"  shortest path in {took:.2f} s: {found.lower_bound} to {found.steps} steps")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=Path("out/building"))
    parser.add_argument("--map", type=Path, help="another map, too")
    options = parser.parse_args()
    print("world paper:")
    steps(devlearn.World.load("paper"))
    for path in [write(options.output), *([options.map] if options.map else [])]:
        measure(path, options.output)


if __name__ == "__main__":
    main()
