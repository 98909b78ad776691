"""``devlearn world``: pictures, reasons, imports and draws."""

import pytest
from conftest import refusal
from devlearn import Rectangle, World, cli
from test_ros_maps import ROOM, TWO_ROOMS, drawn

PNG = b"\x89PNG\r\n\x1a\n"


def told(capsys, *arguments, code=0):
    """What a command says, and what it warns of."""
    assert cli.main(["world", *map(str, arguments)]) == code
    return capsys.readouterr()


def walled(folder, gap=0.0, at=2.5):
    """An arena of 5 m parted by a wall, with a gap at its upper end; a file."""
    world = World(obstacles=[Rectangle((2.5, (5 - gap) / 2), (0.2, 5 - gap))], start=(1, at, 0))
    world.save(folder / "walled.json")
    return folder / "walled.json"


# --- show ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("world", ["office", "file"])
def test_a_world_is_drawn(tmp_path, capsys, world):
    picture = tmp_path / "pic.png"
    world = walled(tmp_path) if world == "file" else world
    assert told(capsys, "show", world, "--output", picture).out == f"written: {picture}\n"
    assert picture.read_bytes().startswith(PNG)


def test_a_world_that_the_robot_has_no_room_in_is_drawn_none_the_less(tmp_path, capsys):
    World(start=(0.05, 0.05, 0)).save(tmp_path / "tight.json")
    told(capsys, "show", tmp_path / "tight.json", "--output", tmp_path / "pic.svg")
    assert "obstacle" not in (tmp_path / "pic.svg").read_text()
    assert "robot" in (tmp_path / "pic.svg").read_text()


def test_pictures_of_other_kinds_and_worlds_that_are_none_are_refused(tmp_path, capsys):
    assert "ends in .png" in refusal(capsys, "world", "show", "empty", "--output", "pic.bmp")
    assert "no such file" in refusal(capsys, "world", "show", "nowhere")
    assert "devlearn world import" in refusal(capsys, "world", "check", "map.yaml")


# --- check ---------------------------------------------------------------------------------------


def test_a_world_that_can_be_used_is_told_with_its_shortest_path(capsys):
    out, err = told(capsys, "check", "paper")
    assert err == ""
    assert "world paper: 5 m x 5 m\n" in out
    assert "obstacles: 8\n" in out
    assert "shortest path: 113 steps\n" in out
    assert "gap" not in out


def test_a_start_without_room_is_the_reason(tmp_path, capsys):
    World(start=(0.05, 0.5, 0)).save(tmp_path / "tight.json")
    _, err = told(capsys, "check", tmp_path / "tight.json", code=1)
    assert "no room for the body: start: got a place 0.05 m from the nearest surface" in err
    assert told(capsys, "check", tmp_path / "tight.json", "--radius", "0.03").err == ""


def test_where_no_way_leads_it_says_how_far_the_robot_gets_and_what_is_too_narrow(tmp_path, capsys):
    out, err = told(capsys, "check", walled(tmp_path), code=1)
    assert "no way leads from the start (1, 2.5) to the target (4.5, 4.5)" in err
    assert "the robot gets as near as 2.21 m to it, at (2.288, 4.487)" in err
    assert "in 2 rooms" in out
    assert "gap" not in out
    out, err = told(capsys, "check", walled(tmp_path, gap=0.16), code=1)
    assert "gap: about 0.15 m wide at" in out
    assert "the body is 0.2 m" in out
    out, err = told(capsys, "check", walled(tmp_path, gap=0.16), "--radius", "0.05")
    assert "shortest path" in out
    assert err == ""


def test_a_file_that_is_no_world_is_refused_with_its_field(tmp_path, capsys):
    (tmp_path / "bad.json").write_text('{"format": "devlearn-world", "version": 1, "wall": 3}')
    assert "bad.json: wall" in refusal(capsys, "world", "check", tmp_path / "bad.json")


# --- import --------------------------------------------------------------------------------------


def test_an_import_tells_what_it_made(tmp_path, capsys):
    lab = tmp_path / "lab.json"
    path = drawn(tmp_path, ROOM, resolution=0.25, origin=[-1.0, 2.0, 0.0])
    out, _ = told(
        capsys, "import", path, "--output", lab, "--start", "-0.75,2.25,90", "--target", "0.75,4",
        "--tolerance", "0",
    )  # fmt: skip
    world = World.load(lab)
    assert world == World.from_ros_map(path, (-0.75, 2.25, 90), (0.75, 4), tolerance=0)
    assert out.splitlines() == [
        "cells: 8 x 10 of 0.25 m; 76 free, 4 occupied, 0 unknown",
        "outlines: 1 with 0 holes, 8 corners; within 0 m of those traced, 0.0884 m of the cells",
        "free: 4.781 m^2",
        "world map: 2 m x 2.5 m",
        "arena: (-1, 2) to (1, 4.5)",
        "obstacles: 1",
        "start: (-0.75, 2.25), heading 90 degrees",
        "target: (0.75, 4)",
        f"written: {lab}",
    ]


def test_an_import_draws_by_seed_and_takes_unknown_space_and_radius(tmp_path, capsys):
    path = drawn(tmp_path, TWO_ROOMS.replace("#", "?"), resolution=0.2)
    lab = tmp_path / "lab.json"
    told(capsys, "import", path, "--output", lab, "--seed", "3", "--unknown", "free")
    assert World.load(lab) == World.from_ros_map(path, seed=3, unknown="free")
    refused = refusal(capsys, "world", "import", path, "--output", lab, "--radius", "3")
    assert "no free place with room for a body of radius 3 m" in refused


@pytest.mark.parametrize(
    ("option", "value"), [("--start", "1,2"), ("--target", "1;2"), ("--target", "a,b")]
)
def test_places_that_are_none_are_refused(tmp_path, capsys, option, value):
    path = drawn(tmp_path, ROOM)
    assert f"{option}: got '{value}'" in refusal(capsys, "world", "import", path, option, value)


def test_a_map_that_cannot_be_read_is_refused_and_nothing_written(tmp_path, capsys):
    path = drawn(tmp_path, ROOM, resolution=0)
    lab = tmp_path / "lab.json"
    assert "resolution: got 0" in refusal(capsys, "world", "import", path, "--output", lab)
    assert not lab.exists()


# --- random --------------------------------------------------------------------------------------


def test_a_world_drawn_by_chance_is_that_of_its_kind_seed_and_difficulty(tmp_path, capsys):
    drawn_world = tmp_path / "rooms.json"
    out, _ = told(
        capsys, "random", "rooms", "--seed", "7", "--difficulty", "0.8", "--output", drawn_world
    )
    assert World.load(drawn_world) == World.random("rooms", 7, difficulty=0.8)
    assert out.endswith(f"written: {drawn_world}\n")
    assert "corridors" in refusal(capsys, "world", "random", "caves")


@pytest.mark.parametrize("task", ["import", "random"])
def test_a_world_is_written_over_no_map_and_where_there_is_a_folder_or_nothing_is_done(
    tmp_path, capsys, task
):
    path = drawn(tmp_path, ROOM)
    image = tmp_path / "map.pgm"
    before = path.read_bytes(), image.read_bytes()
    # A map that is none and a kind that is none: what is written to is looked at first.
    for what in (path if task == "import" else "rooms", "nowhere"):
        for output in (path, image, tmp_path / "world", tmp_path):
            assert "ends in .json" in refusal(capsys, "world", task, what, "--output", output)
        nowhere = tmp_path / "none" / "world.json"
        assert "no such folder" in refusal(capsys, "world", task, what, "--output", nowhere)
    assert (path.read_bytes(), image.read_bytes()) == before
