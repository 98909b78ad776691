"""Worlds as Python sees them: built, loaded, compared, asked for distances; their schema."""

import copy
import json
import math
import os
import pathlib
import pickle
import stat

import devlearn
import jsonschema
import numpy as np
import pytest
from conftest import refused
from devlearn import Circle, FileError, Polygon, Polyline, Pose, Rectangle, World
from hypothesis import given
from hypothesis import strategies as st

SCHEMA = json.loads((pathlib.Path(devlearn.__file__).parent / "world.schema.json").read_text())
VALIDATOR = jsonschema.validators.validator_for(SCHEMA)(SCHEMA)

inside = st.floats(0.3, 4.7)
points = st.tuples(inside, inside)
sizes = st.floats(0.02, 1)


def square(center, half):
    x, y = center
    return [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]


def frame(center, half, share):
    return Polygon(square(center, half), [square(center, share * half)])


obstacles = st.one_of(
    st.builds(Circle, points, sizes),
    st.builds(Rectangle, points, st.tuples(sizes, sizes), st.floats(-360, 360)),
    st.builds(Polygon, st.tuples(points, points, points)),
    st.builds(frame, points, st.floats(0.1, 1), st.floats(0.2, 0.9)),
    st.builds(Polyline, st.lists(points, min_size=2, max_size=5)),
)


def try_world(obstacles, **more):
    try:
        return World(start=(0.1, 0.1, 0), target=(4.9, 4.9), obstacles=obstacles, **more)
    except devlearn.InvalidValue:
        return None


# --- the worlds that ship ------------------------------------------------------------------------


def test_at_least_six_worlds_ship_by_name():
    assert {"paper", "empty", "corridor", "u_trap", "clutter", "office"} <= set(devlearn.worlds())
    assert devlearn.worlds() == sorted(devlearn.worlds())


@pytest.mark.parametrize("name", devlearn.worlds())
def test_a_world_that_ships_is_whole(name):
    world = World.load(name)
    assert world.name == name
    assert world.description
    assert devlearn.Trial(world, seed=1).free_learning(50).path().shape == (51, 3)
    assert devlearn.shortest_path(devlearn.Robot(world)).steps > 10
    assert World.from_json(world.to_json()) == world
    VALIDATOR.validate(json.loads(world.to_json()))


def test_the_paper_world_is_that_of_the_method(paper):
    assert (paper.width, paper.height) == (5, 5)
    assert paper.start == (0.51, 0.515, 0)
    assert paper.target == (4.4, 4.4)
    assert paper.obstacles == [
        Circle((1.3, 1.4), 0.25),
        Rectangle((2.5, 0.9), (0.6, 0.35)),
        Polygon([(3.6, 1.1), (4.2, 1.3), (3.7, 1.7)]),
        Rectangle((1.0, 2.8), (0.35, 0.7)),
        Circle((2.4, 2.3), 0.3),
        Polygon([(3.2, 2.7), (3.9, 2.6), (3.5, 3.2)]),
        Rectangle((2.2, 3.9), (0.8, 0.3)),
        Circle((3.4, 4.2), 0.2),
    ]


# --- files and text ------------------------------------------------------------------------------


@given(st.lists(obstacles, max_size=5), st.text(max_size=30), st.floats(-1e9, 1e9))
def test_text_files_pickles_and_copies_bring_back_an_equal_world(shapes, name, heading):
    world = try_world(shapes, name=name, description=name[::-1])
    if world is None:
        return
    world = world.with_start((0.1, 0.1, heading))
    for again in (
        World.from_json(world.to_json()),
        pickle.loads(pickle.dumps(world)),
        copy.copy(world),
        copy.deepcopy(world),
    ):
        assert again == world
        assert again.to_json() == world.to_json()
        assert again.start == (0.1, 0.1, heading)
        assert again.obstacles == shapes
    VALIDATOR.validate(json.loads(world.to_json()))


def test_a_saved_world_loads_from_text_bytes_and_paths(paper, tmp_path):
    for name in ("w.json", "noend", "ü x.json"):
        for as_path in (lambda p: p, str, os.fsencode):
            path = tmp_path / name
            paper.save(as_path(path))
            assert World.load(as_path(path)) == paper
            path.unlink()


def test_names_that_are_no_unicode_are_names_too(paper, tmp_path):
    path = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.json")
    paper.save(path)
    assert World.load(path) == paper
    pathlib.Path(path).write_text("{}")
    with pytest.raises(FileError) as caught:
        World.load(path)
    assert caught.value.file == path


def test_a_folder_named_as_a_world_does_not_hide_it(paper, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "paper").mkdir()
    assert World.load("paper") == paper
    World(name="mine").save("empty")
    assert World.load("empty").name == "mine"


@pytest.mark.parametrize("place", ["absent/w.json", ".", "a\0b", "y" * 300, "file/w.json"])
def test_places_that_cannot_be_written_are_refused_by_name(paper, tmp_path, place):
    (tmp_path / "file").write_text("")
    with pytest.raises(FileError) as caught:
        paper.save(f"{tmp_path}/{place}")
    assert f"{tmp_path}/{place}".startswith(caught.value.file)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_devices_and_links_are_not_replaced(paper, tmp_path):
    with pytest.raises(FileError):
        paper.save("/dev/null")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    World().save(tmp_path / "file")
    (tmp_path / "link").symlink_to(tmp_path / "file")
    paper.save(tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert World.load(tmp_path / "file") == paper


def test_a_world_that_is_not_there_is_refused_with_the_names_of_those_that_are():
    with pytest.raises(FileError) as caught:
        World.load("papre")
    assert caught.value.file == "papre"
    assert "paper" in str(caught.value)


def test_every_field_out_of_order_is_refused_by_its_name(paper):
    text = json.loads(paper.to_json())

    def refused_field(change):
        changed = copy.deepcopy(text)
        change(changed)
        assert not VALIDATOR.is_valid(changed) or "in an obstacle" in str(refuse(changed))
        return refuse(changed).field

    def refuse(changed):
        with pytest.raises(FileError) as caught:
            World.from_json(json.dumps(changed))
        return caught.value

    def put(path, value):
        def change(tree):
            *way, last = path
            for key in way:
                tree = tree[key]
            tree[last] = value

        return change

    for path, value, field in [
        (["format"], "x", "format"),
        (["version"], 2, "version"),
        (["version"], "1", "version"),
        (["colour"], 1, "colour"),
        (["name"], 3, "name"),
        (["arena", "width"], 0.4, "arena.width"),
        (["arena", "width"], "5", "arena.width"),
        (["arena", "depth"], 5, "arena.depth"),
        (["start", "x"], None, "start.x"),
        (["start", "x"], [], "start.x"),
        (["target"], [1, 2], "target"),
        (["obstacles"], {}, "obstacles"),
        (["obstacles", 0, "radius"], 0, "obstacles[0].radius"),
        (["obstacles", 0, "shape"], "square", "obstacles[0].shape"),
        (["obstacles", 0, "size"], [1, 1], "obstacles[0].size"),
        (["obstacles", 1, "size"], [1, 0], "obstacles[1].size[1]"),
        (["obstacles", 1, "angle"], 361, "obstacles[1].angle"),
        (["obstacles", 2, "corners"], [[1, 1], [2, 2]], "obstacles[2].corners"),
        (["obstacles", 2, "corners", 1], [1], "obstacles[2].corners[1]"),
        (["obstacles", 2, "corners", 1, 0], "1", "obstacles[2].corners[1][0]"),
        (["obstacles", 2, "holes"], {}, "obstacles[2].holes"),
        (["obstacles", 2, "holes"], [[[1, 1], [2, 2]]], "obstacles[2].holes[0]"),
        (["obstacles", 2, "points"], [[1, 1], [2, 2]], "obstacles[2].points"),
        (["obstacles", 2], {"shape": "polyline", "points": [[1, 1]]}, "obstacles[2].points"),
        (["obstacles", 2], {"shape": "polyline", "points": [[1, 1], 2]}, "obstacles[2].points[1]"),
    ]:
        assert refused_field(put(path, value)) == field
    for field in ("format", "version", "arena", "start", "target", "obstacles"):
        assert refused_field(lambda tree, field=field: tree.pop(field)) == field
    assert refused_field(lambda tree: tree["obstacles"][0].pop("radius")) == "obstacles[0].radius"


@pytest.mark.parametrize("text", ["", "{", "null", "[]", "3", '"x"', "{}", "\0", "[" * 10**6, "﻿{}"])
def test_text_that_is_no_world_is_refused(text):
    with pytest.raises(FileError) as caught:
        World.from_json(text)
    assert caught.value.file == "JSON text"


# --- drawn by chance -----------------------------------------------------------------------------

KINDS = ("similar", "clutter", "corridors", "rooms", "traps")

# SHA-256 of worlds of seeds 1 to 5. The claims on similar worlds were judged on these.
SIMILAR = (
    "81ba824c243df325197ed3ac3c5e99418676fa455ed652fe82ee6cf676073853",
    "c21dfb0d299372bff50d546f59fec5233a3c59f451f19ec6004451203fc479c1",
    "50fa45554ea022c76cfcf803c622927f7f26f673079e07cd060cf6184daef512",
    "942ce5384fd34ec6de8a01288d69c229521063b30d1b8ecbe6d80c1c38b9dcd1",
    "89ce015e2c8d5b991e3431d48e4ab7a371f871bd6069a68ee3506f202a514823",
)

# Their hashes' beginnings, at seed 1 and difficulties 0, 0.5 and 1.
RANDOM = {
    "similar": ["4f474b7a9f93fc19", "81ba824c243df325", "cfe1d0fb2d415edf"],
    "clutter": ["7f548bb0b98293e4", "7a85d6068ba70eb2", "e0a90d6612b0dbf5"],
    "corridors": ["ec1b05c7b17237a0", "34ea0616f450b59b", "3e0d0ced84d100cc"],
    "rooms": ["cd7199f0fe4bcdc6", "707412ef7103a701", "3211e1dba9d90c6e"],
    "traps": ["71bd627657977585", "fd419eb3eefe110c", "69edc931fdfe340b"],
}


@pytest.mark.parametrize(("seed", "hash_"), list(enumerate(SIMILAR, 1)))
def test_similar_worlds_are_those_the_claims_were_judged_on(seed, hash_):
    assert World.random("similar", seed).hash == hash_


@pytest.mark.parametrize("kind", KINDS)
def test_a_random_world_is_the_same_on_every_machine(kind):
    hashes = [World.random(kind, 1, difficulty=d).hash[:16] for d in (0, 0.5, 1)]
    assert hashes == RANDOM[kind]


@pytest.mark.parametrize("kind", KINDS)
def test_a_random_world_is_a_world_like_any(kind):
    world = World.random(kind, 2**64 - 1, difficulty=0.25)
    assert World.from_json(world.to_json()) == world
    assert world.name == f"{kind} {2**64 - 1}, difficulty 0.25"
    VALIDATOR.validate(json.loads(world.to_json()))
    assert len(devlearn.Trial(world, seed=1).free_learning(50)) == 50


@pytest.mark.parametrize(
    ("quantity", "says", "arguments", "difficulty"),
    [
        ("kind", "similar, clutter, corridors, rooms, traps", ("maze", 1), 0.5),
        ("difficulty", "[0, 1]", ("rooms", 1), 1.5),
        ("difficulty", "[0, 1]", ("rooms", 1), float("nan")),
        ("seed", "[0, 2^64 - 1]", ("rooms", -1), 0.5),
        ("seed", "[0, 2^64 - 1]", ("rooms", 2**64), 0.5),
    ],
)
def test_what_no_random_world_can_be_is_refused(quantity, says, arguments, difficulty):
    assert (
        says in refused(lambda: World.random(*arguments, difficulty=difficulty), quantity).allowed
    )


def _outline(obstacle):
    """Points of an obstacle's outline: corners, or places around a circle."""
    if isinstance(obstacle, devlearn.Polygon):
        return list(obstacle.corners)
    x, y = obstacle.center
    if isinstance(obstacle, devlearn.Circle):
        around = np.linspace(0, 2 * np.pi, 72)
        return [(x + obstacle.radius * np.cos(a), y + obstacle.radius * np.sin(a)) for a in around]
    c, s = np.cos(np.radians(obstacle.angle)), np.sin(np.radians(obstacle.angle))
    half = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) * obstacle.size / 2
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in half]


@pytest.mark.parametrize("index", range(1, 7))
def test_in_a_similar_world_start_and_target_are_free_and_there_is_a_way(index, paper):
    world = World.random("similar", index)
    assert (world.start, world.target) == (paper.start, paper.target)
    assert world.clearance(*world.start[:2], walls_count=True) > 0.2
    assert world.clearance(*world.target, walls_count=True) > 0.2
    assert devlearn.shortest_path(devlearn.Robot(world)).steps > 1


@pytest.mark.parametrize("index", range(1, 21))
def test_obstacles_of_a_similar_world_have_the_papers_sizes_and_a_way_between_them(index, paper):
    world = World.random("similar", index)
    for moved, original in zip(world.obstacles, paper.obstacles):
        assert type(moved) is type(original)
        size, other = (np.ptp(_distances(o)) for o in (moved, original))
        assert size == pytest.approx(other)
        assert _distances(moved) == pytest.approx(_distances(original))
        others = [o for o in world.obstacles if o != moved]
        assert len(others) == 7
        alone = World(5, 5, world.start, world.target, others)
        assert min(float(alone.clearance(x, y)) for x, y in _inside(_outline(moved))) >= 0.35


def _distances(obstacle):
    points = _outline(obstacle)
    return [math.dist(p, q) for p in points for q in points]


def _inside(points):
    return [(min(max(x, 0.0), 5.0), min(max(y, 0.0), 5.0)) for x, y in points]


# --- built in code -------------------------------------------------------------------------------


def test_the_default_world_is_the_empty_arena():
    world = World()
    assert (world.width, world.height, world.obstacles) == (5, 5, [])
    assert (world.start, world.target) == ((0.5, 0.5, 0), (4.5, 4.5))
    assert isinstance(world.start, Pose)
    assert (world.name, world.description) == ("", "")


def test_numbers_of_numpy_and_sequences_of_any_kind_are_taken():
    world = World(
        width=np.float32(4),
        height=np.int64(4),
        start=np.array([0.5, 0.5, 90]),
        target=[3, 3],
        obstacles=(
            Circle(np.array([2, 1]), np.float64(0.2)),
            Rectangle((2, 2), [1, 0.2]),
            Polygon(np.array([(1, 3), (1.5, 3), (1.2, 3.5)])),
            Polygon(square((3, 1), 0.5), np.array([square((3, 1), 0.3)])),
            Polyline(np.array([(1, 4), (2, 4)])),
        ),
    )
    assert (world.width, world.start, world.target) == (4, (0.5, 0.5, 90), (3, 3))
    assert [type(o) for o in world.obstacles] == [Circle, Rectangle, Polygon, Polygon, Polyline]
    assert world.obstacles[2].corners == [(1, 3), (1.5, 3), (1.2, 3.5)]
    assert world.obstacles[2].holes == []
    assert world.obstacles[3].holes == [square((3, 1), 0.3)]
    assert world.obstacles[4].points == [(1, 4), (2, 4)]


def test_what_a_world_shows_cannot_change_it(paper):
    paper.obstacles.clear()
    assert len(paper.obstacles) == 8
    for name in ("width", "start", "target", "name"):
        with pytest.raises(AttributeError):
            setattr(paper, name, getattr(paper, name))


@pytest.mark.parametrize(
    ("quantity", "arguments"),
    [
        ("arena.width", {"width": 0.4}),
        ("arena.height", {"height": 1e9}),
        ("arena.width", {"width": float("nan")}),
        ("start.x", {"start": (-1, 1, 0)}),
        ("start.y", {"start": (1, 5.1, 0)}),
        ("start.heading", {"start": (1, 1, float("inf"))}),
        ("target.x", {"target": (5.1, 1)}),
        ("start", {"obstacles": [Circle((0.5, 0.5), 0.2)]}),
        ("target", {"obstacles": [Rectangle((4.5, 4.5), (0.2, 0.2))]}),
        ("obstacles[0].center[0]", {"obstacles": [Circle((11, 2), 0.2)]}),
        ("obstacles[0].corners", {"obstacles": [Polygon([(1, 1), (2, 2), (3, 3)])]}),
        ("obstacles[0].corners", {"obstacles": [Polygon([(1, 1), (2, 2), (2, 1), (1, 2)])]}),
        ("obstacles[0].corners[1]", {"obstacles": [Polygon([(1, 1), (1.001, 1), (2, 2)])]}),
        ("obstacles[0].holes[0]", {"obstacles": [frame((2, 2), 0.5, 1)]}),
        ("obstacles[0].holes[0]", {"obstacles": [frame((2, 2), 0.5, 2)]}),
        ("obstacles[0].holes[0][1]", {"obstacles": [frame((2, 2), 0.5, 0.005)]}),
        ("obstacles[0].points[1]", {"obstacles": [Polyline([(1, 1), (1, 1)])]}),
        ("start", {"obstacles": [Polyline([(0, 0), (1, 1)])]}),
        ("target", {"obstacles": [Polyline([(4.5, 1), (4.5, 5)])]}),
        ("name", {"name": "x" * 10_001}),
    ],
)
def test_what_a_world_cannot_be_is_refused_by_the_field_of_its_file(quantity, arguments):
    refused(lambda: World(**arguments), quantity)


def test_an_arena_may_begin_anywhere():
    there = World(
        origin=(256, -128),
        start=(256.5, -127.5, 0),
        target=(260.5, -123.5),
        obstacles=[Circle((258, -126), 0.5)],
    )
    here = World(obstacles=[Circle((2, 2), 0.5)])
    assert (here.origin, there.origin) == ((0, 0), (256, -128))
    assert there != here
    for again in (World.from_json(there.to_json()), pickle.loads(pickle.dumps(there))):
        assert again == there
        assert again.origin == there.origin
    VALIDATOR.validate(json.loads(there.to_json()))
    assert "origin" not in here.to_json()
    x, y = np.meshgrid(np.linspace(0, 5, 20), np.linspace(0, 5, 20))
    for walls in (False, True):
        ours = here.clearance(x, y, walls_count=walls)
        theirs = there.clearance(x + 256, y - 128, walls_count=walls)
        assert np.abs(ours - theirs).max() < 1e-12
    assert devlearn.Trial(there).grid.origin == (256, -128)
    assert "[256, 261]" in refused(lambda: there.with_start((0.5, 0.5, 0)), "start.x").allowed
    assert "[-1e+05, 1e+05]" in refused(lambda: World(origin=(1e6, 0)), "arena.origin[0]").allowed


def test_another_start_is_another_world_and_a_bad_one_changes_nothing(paper):
    other = paper.with_start((4.5, 0.5, 90))
    assert other.start == (4.5, 0.5, 90)
    assert other != paper
    assert other.with_start(paper.start) == paper
    refused(lambda: paper.with_start((1.3, 1.4, 0)), "start")
    assert paper.start == (0.51, 0.515, 0)


def test_equal_worlds_are_equal_in_hash_too(paper):
    again = World.load("paper")
    assert again == paper
    assert again is not paper
    assert (hash(again), again.hash) == (hash(paper), paper.hash)
    assert len({again, paper, World()}) == 2
    assert paper != World()
    assert paper != "paper"
    assert len(paper.hash) == 64
    assert int(paper.hash, 16)


def test_obstacles_are_values():
    for make in (
        lambda: Circle((1, 2), 0.3),
        lambda: Rectangle((1, 2), (0.3, 0.4), 5),
        lambda: Polygon([(1, 2), (2, 2), (2, 3)]),
        lambda: frame((1, 2), 1, 0.5),
        lambda: Polyline([(1, 2), (2, 2)]),
    ):
        obstacle = make()
        assert obstacle == make()
        assert pickle.loads(pickle.dumps(obstacle)) == obstacle
        assert copy.deepcopy(obstacle) == obstacle
        assert obstacle != Circle((1, 2), 0.30001)
        assert obstacle != "x"
        assert eval(repr(obstacle), vars(devlearn)) == obstacle
    assert frame((1, 2), 1, 0.5) != Polygon(square((1, 2), 1))


# --- distances -----------------------------------------------------------------------------------


def segment_distances(points, x, y):
    """Least distance from each point to the way from point to point."""
    least = np.full(np.shape(x), np.inf)
    for (ax, ay), (bx, by) in zip(points, points[1:]):
        along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)
        along = np.clip(along, 0, 1)
        least = np.minimum(least, np.hypot(x - ax - along * (bx - ax), y - ay - along * (by - ay)))
    return least


def winds_around(corners, x, y):
    """Whether the outline turns around each point."""
    turn = 0
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0)):
        cross = (ax - x) * (by - y) - (ay - y) * (bx - x)
        turn = turn + np.arctan2(cross, (ax - x) * (bx - x) + (ay - y) * (by - y))
    return np.abs(turn) > 3


def distance(obstacle, x, y):
    if isinstance(obstacle, Circle):
        return np.maximum(
            0, np.hypot(x - obstacle.center[0], y - obstacle.center[1]) - obstacle.radius
        )
    if isinstance(obstacle, Rectangle):
        a = np.radians(obstacle.angle)
        (cx, cy), (w, h) = obstacle.center, obstacle.size
        u = (x - cx) * np.cos(a) + (y - cy) * np.sin(a)
        v = (y - cy) * np.cos(a) - (x - cx) * np.sin(a)
        return np.hypot(np.maximum(0, np.abs(u) - w / 2), np.maximum(0, np.abs(v) - h / 2))
    if isinstance(obstacle, Polyline):
        return segment_distances(obstacle.points, x, y)
    inside = winds_around(obstacle.corners, x, y)
    for hole in obstacle.holes:
        inside &= ~winds_around(hole, x, y)
    rings = [obstacle.corners, *obstacle.holes]
    least = np.min([segment_distances([*ring, ring[0]], x, y) for ring in rings], axis=0)
    return np.where(inside, 0, least)


@given(st.lists(obstacles, min_size=1, max_size=6), st.integers(0, 2**32 - 1))
def test_clearance_is_the_least_distance_to_an_obstacle(shapes, seed):
    world = try_world(shapes)
    if world is None:
        return
    x, y = np.random.default_rng(seed).uniform(0, 5, (2, 200))
    expected = np.min([distance(o, x, y) for o in shapes], axis=0)
    clearance = world.clearance(x, y)
    assert np.abs(clearance - expected).max() < 1e-9
    walls = np.min([x, 5 - x, y, 5 - y], axis=0)
    assert (world.clearance(x, y, walls_count=True) == np.minimum(clearance, walls)).all()
    assert [world.clearance(*p) for p in zip(x.tolist(), y.tolist())] == clearance.tolist()


def test_clearance_takes_numbers_and_arrays_of_any_shape(paper):
    assert type(paper.clearance(1, 2)) is float
    assert type(paper.clearance(np.float32(1), np.int8(2))) is float
    x, y = np.meshgrid(np.linspace(0, 5, 7), np.linspace(0, 5, 4))
    assert paper.clearance(x, y).shape == (4, 7)
    assert paper.clearance(x.T, y.T).tolist() == paper.clearance(x, y).T.tolist()
    assert paper.clearance([1, 2, 3], 0).shape == (3,)
    assert paper.clearance(np.empty(0), np.empty(0)).shape == (0,)
    assert World().clearance(1, 1) == np.inf
    assert World().clearance(1, 2, walls_count=True) == 1
    assert paper.clearance(-3, 9, True) == 0  # beyond the walls


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf")])
def test_clearance_of_no_point_is_refused(paper, bad):
    refused(lambda: paper.clearance(bad, 1), "x")
    refused(lambda: paper.clearance(1, bad), "y")
    refused(lambda: paper.clearance(np.array([1, bad]), 1), "x")


def test_arrays_that_do_not_broadcast_are_refused(paper):
    refused(lambda: paper.clearance(np.zeros(3), np.zeros(2)), "the arrays' shapes")
