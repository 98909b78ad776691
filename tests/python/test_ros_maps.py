"""Worlds from maps of ROS's map_server: how cells are read, traced, placed, and refused."""

import json
import math
import struct
import subprocess
import sys
import time
import zlib

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import FileError, Robot, RobotDef, World, may_reach_target
from devlearn.maps import import_ros_map
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

SHADES = {"#": 0, ".": 254, "?": 205}
# A corner of a cell is cut from the middle of one side to the middle of the next.
CUT = 0.25 * math.sqrt(2)


def written(folder, shades, *, image="map.pgm", name="map.yaml", **fields):
    """A map_server map of these shades, a picture's highest row first; gives the YAML's path."""
    if shades is not None:
        file = image if str(image).endswith((".pgm", ".png")) and "/" not in image else "map.pgm"
        Image.fromarray(np.asarray(shades, dtype=np.uint8)).save(folder / file)
    fields = {
        "image": image,
        "resolution": 0.1,
        "origin": [0.0, 0.0, 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
        **fields,
    }
    path = folder / name
    path.write_text("".join(f"{k}: {json.dumps(v)}\n" for k, v in fields.items() if v is not None))
    return path


def drawn(folder, picture, **fields):
    """The same of a picture in letters: # occupied, . free, ? unknown."""
    rows = picture.split()
    return written(folder, [[SHADES[letter] for letter in row] for row in rows], **fields)


def around(shades, border=4):
    """Free space around them, in which a start and a target have room."""
    return np.pad(np.asarray(shades, dtype=np.uint8), border, constant_values=254)


ROOM = """
........
........
........
........
........
...##...
...##...
........
........
........
"""

# --- how cells are read --------------------------------------------------------------------------


def counts(made):
    return made.occupied, made.unknown, made.free


@pytest.mark.parametrize(
    ("fields", "occupied", "unknown"),
    [
        # 1 - shade / 255: 0.651 and more is occupied, 0.192 and less free.
        ({}, range(90), range(90, 206)),
        ({"mode": "Trinary"}, range(90), range(90, 206)),
        # shade / 255: 0.651 and 0.192 once more.
        ({"negate": 1}, range(166, 256), range(50, 166)),
        ({"negate": True}, range(166, 256), range(50, 166)),
        # 100 * (0.647 - 0.196) / (0.65 - 0.196) is 99.3, which is not 100.
        ({"mode": "scale"}, range(90), range(0)),
        ({"mode": "scale", "free_thresh": 0, "occupied_thresh": 0.999}, range(2), range(0)),
        ({"mode": "raw"}, [100], range(101, 256)),
        ({"mode": "raw", "negate": 1, "occupied_thresh": 0.2}, [100], range(101, 256)),
        ({"free_thresh": 0.65}, range(90), range(0)),
        ({"occupied_thresh": "5e-1", "free_thresh": 0.5}, range(128), range(0)),
    ],
)
@pytest.mark.parametrize("image", ["map.pgm", "map.png"])
def test_each_shade_means_what_nav2_reads_it_as(tmp_path, fields, occupied, unknown, image):
    shades = np.arange(256).reshape(16, 16)
    negate, raw = fields.get("negate"), fields.get("mode") == "raw"
    free = 0 if negate or raw else 255
    picture = np.pad(shades, 4, constant_values=free)
    made = import_ros_map(written(tmp_path, picture, image=image, **fields))
    frame = picture.size - shades.size
    assert counts(made) == (
        len(occupied),
        len(unknown),
        256 - len(occupied) - len(unknown) + frame,
    )


@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
def test_what_is_not_opaque_is_unknown_but_in_raw_maps(tmp_path, mode):
    picture = np.zeros((8, 10, 2), dtype=np.uint8)
    picture[..., 0] = 0 if mode == "raw" else 255
    picture[..., 1] = 255
    picture[2, 3:5, 1] = (254, 0)
    Image.fromarray(picture, "LA").save(tmp_path / "map.png")
    made = import_ros_map(written(tmp_path, None, image="map.png", mode=mode))
    assert made.unknown == (0 if mode == "raw" else 2)


def test_deep_plain_coloured_and_indexed_images_are_read_as_their_grey(tmp_path):
    shades = around([[0, 89, 90, 205, 206, 254]])
    wanted = counts(import_ros_map(written(tmp_path, shades)))
    assert wanted == (2, 2, shades.size - 4)
    rows, columns = shades.shape
    numbers = " ".join(map(str, shades.ravel()))
    (tmp_path / "plain.pgm").write_text(f"P2\n# by hand\n{columns} {rows}\n255\n{numbers}\n")
    deep = (shades.astype(">u2") * 257).tobytes()
    (tmp_path / "deep.pgm").write_bytes(b"P5 %d %d 65535\n" % (columns, rows) + deep)
    Image.fromarray(shades.astype(np.uint16) * 257).save(tmp_path / "deep.png")
    grey = Image.fromarray(shades)
    grey.convert("RGB").save(tmp_path / "coloured.png")
    grey.convert("P").save(tmp_path / "indexed.png")
    for name in ("plain.pgm", "deep.pgm", "deep.png", "coloured.png", "indexed.png"):
        assert counts(import_ros_map(written(tmp_path, None, image=name))) == wanted, name


# --- how outlines are traced ---------------------------------------------------------------------


def test_straight_walls_lie_on_the_edges_of_cells_and_corners_are_cut(tmp_path):
    path = drawn(tmp_path, ROOM, resolution=0.25, origin=[-1.0, 2.0, 0.0])
    world = World.from_ros_map(path, tolerance=0)
    assert (world.origin, world.width, world.height) == ((-1, 2), 2, 2.5)
    (outline,) = world.obstacles
    assert outline.holes == []
    # Cells 3 and 4 along x and y, but the lowest row is the picture's last.
    low, high = (-0.25, 2.75), (0.25, 3.25)
    assert set(outline.corners) == {
        (low[0] + 0.125, low[1]),
        (high[0] - 0.125, low[1]),
        (high[0], low[1] + 0.125),
        (high[0], high[1] - 0.125),
        (high[0] - 0.125, high[1]),
        (low[0] + 0.125, high[1]),
        (low[0], high[1] - 0.125),
        (low[0], low[1] + 0.125),
    }


def test_cells_that_touch_at_a_corner_are_one_obstacle(tmp_path):
    picture = "......\n......\n..#...\n...#..\n......\n......\n"
    world = World.from_ros_map(drawn(tmp_path, picture, resolution=0.5), tolerance=0)
    assert len(world.obstacles) == 1
    assert world.clearance(1.5, 1.5) == 0


RING = """
..........
..........
..######..
..#....#..
..#.##.#..
..#.##.#..
..#....#..
..######..
..........
..........
"""


def test_a_ring_is_an_outline_with_a_hole_and_what_stands_in_it_another(tmp_path):
    made = import_ros_map(drawn(tmp_path, RING, resolution=0.2), tolerance=0)
    ring, island = sorted(made.world.obstacles, key=lambda o: -len(o.holes))
    assert (len(ring.holes), len(island.holes)) == (1, 0)
    assert (made.outlines, made.holes) == (2, 1)
    assert made.corners == len(ring.corners) + len(ring.holes[0]) + len(island.corners)
    assert made.world.clearance(0.5, 0.5) == 0  # in the wall
    assert made.world.clearance(0.7, 0.9) == pytest.approx(0.1)  # in the ring
    assert made.world.clearance(1.0, 1.0) == 0  # on the island
    # Corners cut: 8 of cells stick out, 4 of the hole's are filled.
    cut = 0.2**2 / 8
    assert made.free_area == pytest.approx((100 - 24) * 0.2**2 + 8 * cut - 4 * cut)


def squares(cells):
    """Low corners of cells, in cells."""
    return np.argwhere(cells)[:, ::-1]


def depth(inside):
    """How far each cell's middle is from where cells of the other kind begin, in cells."""
    far = np.full(inside.shape, np.inf)
    for kind in (False, True):
        others = squares(inside != kind)
        for column, row in squares(inside == kind):
            middle = np.array([column, row]) + 0.5
            beyond = np.maximum(0, np.maximum(others - middle, middle - others - 1))
            far[row, column] = np.hypot(*beyond.T).min(initial=np.inf)
    return far


@st.composite
def random_maps(draw):
    """Noise and blocks beside a free strip, and how they lie."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    cells = random.random((14, 12)) < draw(st.sampled_from([0.1, 0.4, 0.6]))
    for _ in range(draw(st.integers(0, 4))):
        row, column = random.integers(0, 12, 2)
        cells[row : row + 6, column : column + 5] = random.random() < 0.6
    cells[:3] = False  # the lowest rows
    return cells


@settings(max_examples=80)
@given(
    random_maps(),
    st.sampled_from([0.2, 0.37, 1.0]),
    st.sampled_from([0, 0.1, 0.5, 1, 2]),
    st.sampled_from([0, 0, math.pi / 2, 0.3, -2.5]),
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
)
def test_cells_further_from_an_edge_than_the_error_are_what_they_were(
    tmp_path_factory, cells, resolution, tolerance, yaw, origin
):
    folder = tmp_path_factory.mktemp("map")
    turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])

    def placed(x, y):
        return np.array(origin) + turn @ (np.array([x, y]) * resolution)

    path = written(
        folder,
        np.flipud(np.where(cells, 0, 254)),
        resolution=resolution,
        origin=[*origin, yaw],
    )
    made = import_ros_map(
        path,
        start=(*placed(1, 1), 0),
        target=placed(11, 1),
        tolerance=tolerance * resolution,
    )
    assert made.error <= tolerance * resolution + 1e-9
    far = depth(cells)
    error = tolerance + CUT + 1e-9
    assert made.error_of_cells <= error * resolution
    for column, row in squares(far > error):
        x, y = placed(column + 0.5, row + 0.5)
        assert (made.world.clearance(x, y) == 0) == cells[row, column], (column, row)


def test_outside_of_a_turned_image_is_obstacle_up_to_the_arenas_walls(tmp_path):
    yaw = 0.5
    path = drawn(tmp_path, ROOM, resolution=0.5, origin=[3.0, -7.0, yaw])
    world = World.from_ros_map(path)
    width, height = 4.0, 5.0  # of the image
    assert world.width == pytest.approx(width * math.cos(yaw) + height * math.sin(yaw))
    assert world.height == pytest.approx(width * math.sin(yaw) + height * math.cos(yaw))
    assert world.origin == pytest.approx((3 - height * math.sin(yaw), -7))
    for x in np.linspace(0.01, 0.99, 40) * world.width + world.origin[0]:
        for y in np.linspace(0.01, 0.99, 40) * world.height + world.origin[1]:
            along = (x - 3) * math.cos(yaw) + (y + 7) * math.sin(yaw)
            across = -(x - 3) * math.sin(yaw) + (y + 7) * math.cos(yaw)
            if not (-1e-6 < along < width + 1e-6 and -1e-6 < across < height + 1e-6):
                assert world.clearance(x, y) == 0
            elif 0.01 < along < 1.2 and 0.01 < across < height - 0.01:
                assert world.clearance(x, y) > 0


def test_a_quarter_turn_leaves_nothing_outside(tmp_path):
    world = World.from_ros_map(drawn(tmp_path, ROOM, origin=[0, 0, math.pi / 2]))
    assert (world.width, world.height) == pytest.approx((1.0, 0.8))
    assert len(world.obstacles) == 1


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("resolution", [0.01, 0.013])
def test_cells_as_small_as_may_be_make_outlines_that_a_world_takes(tmp_path, seed, resolution):
    noise = np.random.default_rng(seed).random((60, 60)) < 0.3 + 0.1 * seed
    shades = around(np.where(noise, 0, 254), 40)
    made = import_ros_map(written(tmp_path, shades, resolution=resolution), radius=0.05)
    assert made.outlines > 0
    assert World.from_json(made.world.to_json()) == made.world


def test_small_cells_are_taken_two_by_two_and_obstacles_grow_by_one_at_most(tmp_path):
    shades = around(np.full((61, 61), 254), 10)
    shades[20, 20] = shades[51, 63] = 0
    shades[30:35, 30:34] = 0
    made = import_ros_map(written(tmp_path, shades, resolution=0.0125), tolerance=0, radius=0.05)
    assert made.outlines == 3
    assert (made.rows, made.columns, made.occupied) == (81, 81, 22)
    occupied = np.flipud(shades) == 0
    far = depth(occupied)
    for column, row in squares(far * 0.0125 > made.error_of_cells):
        x, y = (column + 0.5) * 0.0125, (row + 0.5) * 0.0125
        assert (made.world.clearance(x, y) == 0) == occupied[row, column]
    for column, row in squares(occupied):
        assert made.world.clearance((column + 0.5) * 0.0125, (row + 0.5) * 0.0125) <= 0.025 * CUT


# --- unknown space -------------------------------------------------------------------------------

UNSEEN = """
??????????
??????????
??........
??........
??........
??........
??........
??........
??........
??........
"""


@pytest.mark.parametrize(
    ("unknown", "near", "far"),
    [("occupied", True, True), ("free", False, False), ("border", True, False)],
)
def test_unknown_space_is_what_the_user_says(tmp_path, unknown, near, far):
    path = drawn(tmp_path, UNSEEN, resolution=0.2)
    made = import_ros_map(path, start=(1, 0.4, 0), target=(1.6, 1.2), unknown=unknown, tolerance=0)
    assert counts(made) == (0, 36, 64)
    assert (made.world.clearance(0.3, 0.7) == 0) == near  # beside a free cell
    assert (made.world.clearance(0.3, 1.7) == 0) == near  # beside one across a corner
    assert (made.world.clearance(0.1, 0.7) == 0) == far
    assert (made.world.clearance(1.0, 1.9) == 0) == far


# --- start and target ----------------------------------------------------------------------------

TWO_ROOMS = """
.......#....
.......#....
.......#....
.......#....
.......#....
.......#....
.......#....
.......#....
"""


@pytest.mark.parametrize("seed", range(8))
def test_places_are_drawn_far_apart_in_the_largest_region_and_can_reach_each_other(tmp_path, seed):
    path = drawn(tmp_path, TWO_ROOMS, resolution=0.2)
    world = World.from_ros_map(path, seed=seed)
    assert world == World.from_ros_map(path, seed=seed)
    assert may_reach_target(Robot(world))
    for x in (world.start.x, world.target[0]):
        assert x < 1.4
    assert math.dist(world.start[:2], world.target) > 0.59
    assert len({World.from_ros_map(path, seed=s).start for s in range(8)}) > 4


def test_a_place_that_is_given_is_kept_and_the_other_drawn_where_it_can_be_reached(tmp_path):
    path = drawn(tmp_path, TWO_ROOMS, resolution=0.2)
    by_start = World.from_ros_map(path, start=(1.8, 0.3, 45))
    assert by_start.start == (1.8, 0.3, 45)
    assert by_start.target[0] > 1.6
    by_target = World.from_ros_map(path, target=(1.8, 0.3))
    assert by_target.target == (1.8, 0.3)
    assert by_target.start.x > 1.6


def test_nothing_is_drawn_in_space_that_is_free_only_because_it_is_unknown(tmp_path):
    shades = np.full((40, 40), 205)
    shades[20:28, 20:28] = 254
    path = written(tmp_path, shades)
    for seed in range(4):
        world = World.from_ros_map(path, unknown="border", seed=seed)
        for x, y in (world.start[:2], world.target):
            assert 2 < x < 2.8
            assert 1.2 < y < 2
    everywhere = World.from_ros_map(path, unknown="free")
    assert everywhere.obstacles == []


def test_places_in_obstacles_are_refused_with_the_nearest_that_is_free(tmp_path):
    path = drawn(tmp_path, TWO_ROOMS, resolution=0.2)
    error = refused(lambda: World.from_ros_map(path, start=(1.5, 0.9, 0)), "start")
    assert error.value == "(1.5, 0.9), in an obstacle"
    assert "the nearest is (1.1, 0.9)" in error.allowed  # a cell's middle, with room for the body
    error = refused(lambda: World.from_ros_map(path, start=(0.05, 0.9, 0)), "start")
    assert "0.05 m from the nearest surface" in error.value
    assert "the nearest is (0.3, 0.9)" in error.allowed
    error = refused(lambda: World.from_ros_map(path, target=(2.5, 0.9)), "target.x", "2.5")
    assert "the nearest is (2.1, 0.9)" in error.allowed


def test_where_no_way_leads_it_says_from_where_to_where_and_how_near(tmp_path):
    path = drawn(tmp_path, TWO_ROOMS, resolution=0.2)
    error = refused(
        lambda: World.from_ros_map(path, start=(0.5, 0.5, 0), target=(1.9, 0.5)), "target"
    )
    assert "(1.9, 0.5), to which no way leads from the start (0.5, 0.5)" in error.value
    assert "the nearest is (1.1, 0.5)" in error.allowed


def test_a_larger_robot_needs_a_wider_way(tmp_path):
    door = TWO_ROOMS.split()
    door[4] = door[4].replace("#", ".")
    path = drawn(tmp_path, "\n".join(door), resolution=0.3)
    places = {"start": (0.6, 0.6, 0), "target": (3.0, 0.6), "tolerance": 0}
    world = World.from_ros_map(path, **places)
    assert may_reach_target(Robot(world, RobotDef(radius=0.1)))
    refused(lambda: World.from_ros_map(path, **places, radius=0.2), "target")


# --- what is refused -----------------------------------------------------------------------------


def not_read(path, field="", **how):
    error = refused(lambda: World.from_ros_map(path, **how))
    assert isinstance(error, FileError)
    assert error.field == field
    return error


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("image", None),
        ("image", 3),
        ("image", ""),
        ("image", "nowhere/map.pgm"),
        ("image", "."),
        ("image", "a\0b"),
        ("resolution", None),
        ("resolution", 0),
        ("resolution", -0.05),
        ("resolution", 0.009),
        ("resolution", 11),
        ("resolution", math.nan),
        ("resolution", ".nan"),
        ("resolution", ".inf"),
        ("resolution", "wide"),
        ("resolution", True),
        ("resolution", [0.05]),
        ("resolution", 10**400),
        ("origin", None),
        ("origin", 0),
        ("origin", [0, 0]),
        ("origin", [0, 0, 0, 0]),
        ("origin[0]", [math.inf, 0, 0]),
        ("origin[1]", [0, "far", 0]),
        ("origin[2]", [0, 0, None]),
        ("origin[0]", [2e5, 0, 0]),
        ("negate", None),
        ("negate", 2),
        ("negate", "maybe"),
        ("occupied_thresh", None),
        ("occupied_thresh", 65),
        ("free_thresh", None),
        ("free_thresh", -0.1),
        ("free_thresh", 0.7),
        ("mode", "binary"),
        ("mode", 3),
    ],
)
def test_fields_that_are_missing_or_out_of_range_are_named(tmp_path, field, value):
    path = drawn(tmp_path, ROOM, **{field.partition("[")[0]: value})
    assert not_read(path, field).file == str(path)


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"- image: map.pgm\n",
        b"map.pgm",
        b"3",
        b"image: [\n",
        b"image: !!python/object/apply:os.system ['true']\n",
        b"\xff\xfe\x00",
        b"a: &a [1]\nb: *a\n",
        b"[" * 5000,
        b"when: 2001-99-99\n",
        b"# long\n" * 20000,
        b"[" * 60000,
        b"negate: !!int ''\n",
        b"negate: !!float ''\n",
        b"negate: !!bool maybe\n",
        b"negate: !!timestamp today\n",
        b"!!int '': 3\n",
    ],
)
def test_what_is_no_yaml_of_a_map_is_refused(tmp_path, text):
    path = tmp_path / "map.yaml"
    path.write_bytes(text)
    not_read(path)


def test_a_yaml_that_is_not_there_is_refused(tmp_path):
    not_read(tmp_path / "none.yaml")
    not_read(tmp_path)
    refused(lambda: World.from_ros_map(3), "path")


def test_an_image_outside_of_the_yamls_folder_is_refused_links_followed(tmp_path):
    drawn(tmp_path, ROOM)
    inner = tmp_path / "inner"
    inner.mkdir()
    (inner / "link.pgm").symlink_to(tmp_path / "map.pgm")
    (inner / "loop.pgm").symlink_to(inner / "loop.pgm")
    for image in ("../map.pgm", str(tmp_path / "map.pgm"), "link.pgm", "loop.pgm"):
        not_read(written(inner, None, image=image), "image")
    within = written(tmp_path, None, image="inner/real.pgm")
    (inner / "real.pgm").write_bytes((tmp_path / "map.pgm").read_bytes())
    assert World.from_ros_map(within).obstacles
    linked = tmp_path / "linked"
    linked.symlink_to(tmp_path)
    assert World.from_ros_map(linked / "map.yaml").obstacles


def png(width, height, *chunks):
    def chunk(kind, content):
        sum_ = struct.pack(">I", zlib.crc32(kind + content))
        return struct.pack(">I", len(content)) + kind + content + sum_

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        chunk(*c) for c in ((b"IHDR", header), *chunks, (b"IEND", b""))
    )


BOMB = zlib.compress(b"\0" * 50_000_000, 9)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("map.pgm", b"P5 30000 30000 255\n"),
        ("map.pgm", b"P5 10001 10 255\n"),
        ("map.pgm", b"P5 9000 9000 255\n"),
        ("map.pgm", b"P5 12000 12000 255\n"),
        ("map.pgm", b"P5 10 10 255\nshort"),
        ("map.pgm", b"P5 0 0 255\n"),
        ("map.pgm", b"P5 10 ten 255\n"),
        ("map.pgm", b""),
        ("map.pgm", b"GIF89a"),
        ("map.pgm", b"Pf 20 20 -1.0\n" + bytes(1600)),
        ("map.png", png(30_000, 30_000)),
        ("map.png", png(60_000, 60_000, (b"IDAT", BOMB))),
        ("map.png", png(20, 20, (b"zTXt", b"note\0\0" + BOMB), (b"IDAT", b""))),
        ("map.png", png(20, 20, (b"IDAT", b"nothing"))),
    ],
)
def test_images_that_are_too_large_or_broken_are_refused_before_they_are_unpacked(
    tmp_path, name, content, recwarn
):
    (tmp_path / name).write_bytes(content)
    error = not_read(written(tmp_path, None, image=name))
    assert error.file == str(tmp_path / name)
    assert not recwarn.list


@pytest.mark.parametrize("side", [9000, 12_000, 30_000])
def test_too_large_images_are_told_how_large_one_may_be(tmp_path, side):
    (tmp_path / "map.pgm").write_bytes(f"P5 {side} {side} 255\n".encode())
    assert "at most 10000 x 10000 cells" in not_read(written(tmp_path, None)).allowed


def test_a_png_that_unpacks_to_more_than_it_says_makes_no_more_of_it(tmp_path):
    (tmp_path / "map.png").write_bytes(png(20, 20, (b"IDAT", BOMB)))
    error = refused(lambda: World.from_ros_map(written(tmp_path, None, image="map.png")))
    assert "no free cell: 400 occupied, 0 unknown" in error.value


@pytest.mark.parametrize("resolution", [0.01, 10])
def test_an_arena_too_small_or_too_large_is_refused(tmp_path, resolution):
    shades = np.full((40, 40 if resolution < 1 else 101), 254)
    error = not_read(written(tmp_path, shades, resolution=resolution), "resolution")
    assert "0.5 to 1000 m" in error.allowed


@pytest.mark.parametrize(
    ("picture", "unknown"), [("####", "free"), ("????", "occupied"), ("????", "border")]
)
def test_a_map_without_free_space_is_refused(tmp_path, picture, unknown):
    path = drawn(tmp_path, "\n".join([2 * picture] * 8))
    assert "no free cell" in not_read(path, unknown=unknown).value


def test_noise_that_would_take_long_to_simplify_is_refused_at_once_or_kept(tmp_path):
    # Every other row and column: 122 500 outlines of a cell; and 490 000 corners around 40 000.
    for side in (700, 400):
        shades = np.full((side, side), 254)
        shades[::2, ::2] = 0
        path = written(tmp_path, around(shades, 20))
        began = time.process_time()
        error = not_read(path)
        assert time.process_time() - began < 5
        assert "a tolerance of 0" in error.allowed
    assert len(import_ros_map(path, tolerance=0).world.obstacles) == 40_000


def test_a_map_without_room_for_the_robot_is_refused(tmp_path):
    path = drawn(tmp_path, ".#.#.#\n.#.#.#\n.#.#.#\n.#.#.#\n.#.#.#\n.#.#.#\n")
    error = not_read(path)
    assert error.value == "no free place with room for a body of radius 0.1 m"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("unknown", "maybe"),
        ("tolerance", -1),
        ("tolerance", math.nan),
        ("tolerance", 11),
        ("RobotDef.radius", 0),
        ("start", (math.nan, 0, 0)),
        ("target", (math.inf, 0)),
        ("seed", -1),
    ],
)
def test_arguments_out_of_range_are_refused(tmp_path, name, value):
    path = drawn(tmp_path, ROOM)
    refused(lambda: World.from_ros_map(path, **{name.rpartition(".")[2]: value}), name)


def test_places_of_too_few_numbers_are_refused(tmp_path):
    path = drawn(tmp_path, ROOM)
    refused(lambda: World.from_ros_map(path, start=(1, 1)))
    refused(lambda: import_ros_map(path, start=(1, 1)), "start")
    refused(lambda: import_ros_map(path, target="nowhere"), "target")


@pytest.mark.parametrize("tolerance", ["0.1", [0.1], 10**400])
def test_a_tolerance_is_a_number(tmp_path, tolerance):
    refused(lambda: import_ros_map(drawn(tmp_path, ROOM), tolerance=tolerance), "tolerance")


@pytest.mark.parametrize("start", ["000", b"000", {0: 0, 1: 0, 2: 0}, ("0", "0", "0"), 3])
def test_text_is_no_place(tmp_path, start):
    refused(lambda: import_ros_map(drawn(tmp_path, ROOM), start=start), "start", repr(start))


def test_a_place_with_no_way_to_any_other_is_named_with_the_nearest_that_has_room(tmp_path):
    path = drawn(tmp_path, ROOM)
    error = refused(lambda: World.from_ros_map(path, target=(0, 0)), "target")
    assert "(0, 0), and no way" in error.value
    assert "the nearest is (0.15, 0.15)" in error.allowed


def test_without_the_extra_it_says_how_to_get_it(tmp_path):
    (tmp_path / "shapely.py").write_text("raise ModuleNotFoundError('hidden', name='shapely')")
    program = "import devlearn\ndevlearn.World.from_ros_map('map.yaml')"
    run = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        env={"PYTHONPATH": str(tmp_path)},
    )
    assert "devlearn.maps needs shapely" in run.stderr
    assert "scikit-image" in run.stderr


def test_a_world_from_a_map_says_what_it_is_made_of(tmp_path):
    made = import_ros_map(drawn(tmp_path, ROOM, name="lab.yaml"))
    assert made.world.name == "lab"
    assert made.world.description.startswith("From lab.yaml: 8 x 10 cells of 0.1 m, unknown ones")
    assert devlearn.Trial(made.world, seed=1).free_learning(100).path().shape == (101, 3)
