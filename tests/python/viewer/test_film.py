"""A film shows what its record says, when it happened; and is whole or not there."""

import io
import itertools
import sys
import tempfile

import devlearn
import imageio_ffmpeg
import numpy as np
import pytest
from devlearn import Circle, FileError, InvalidValue, Mover, MoverPath, World, cli
from devlearn.errors import MissingExtra
from devlearn.plots.style import GREEN, OBSTACLE, ORANGE, VERMILLION
from devlearn.record import POSE_COLUMNS, STEP_COLUMNS
from handmade import NO_CHANGE, RETRY, E, hand_made
from matplotlib.colors import to_rgb
from PIL import Image

SMALL = 240


@pytest.fixture(scope="module")
def paths():
    trial = devlearn.Trial(World.load("paper"), seed=2)
    return trial.path_learning(12, step_limit=300)


@pytest.fixture(scope="module")
def file_of_paths(paths, tmp_path_factory):
    path = tmp_path_factory.mktemp("record") / "paths.npz"
    paths.save(path)
    return path


def row(places, *, kinds=(NO_CHANGE,), rounds=None):
    """A record of a robot at these places, one after the other, in an empty arena of 5 m x 5 m."""
    steps = len(places) - len(rounds or [1])
    record = hand_made(list(itertools.islice(itertools.cycle(kinds), steps)), rounds=rounds)
    record.x[:], record.y[:] = np.array(places, dtype=float).T
    return record


def of_colour(frame, colour):
    return np.abs(frame - 255 * np.array(to_rgb(colour))).max(axis=2) < 4


def place_of(frame, colour):
    """Where the middle of what has this colour is in the arena of 5 m x 5 m [m]."""
    dark = (frame < 80).all(axis=2)
    columns = np.flatnonzero(dark.sum(axis=0) > frame.shape[1] / 2)  # walls
    rows = np.flatnonzero(dark.sum(axis=1) > frame.shape[1] / 2)
    y, x = np.argwhere(of_colour(frame, colour)).mean(axis=0)
    left, right, top, bottom = columns[0], columns[-1], rows[0], rows[-1]
    return 5 * (x - left) / (right - left), 5 * (bottom - y) / (bottom - top)


# --- what frames show -----------------------------------------------------------------------------


def test_the_robot_is_where_the_record_says():
    record = row([(1, 1), (1, 4), (4, 4)])
    film = devlearn.animate(record, seconds=1, width=480)
    frames = list(film)
    moving = len(frames) - 5  # the last fifth stands
    for frame, part in ((0, 0.0), (moving // 2, moving // 2 / (moving - 1)), (moving - 1, 1.0)):
        at = 2 * part
        expected = (1, 1 + 3 * at) if at <= 1 else (1 + 3 * (at - 1), 4)
        assert place_of(frames[frame], GREEN) == pytest.approx(expected, abs=0.04)


def test_what_moves_is_where_it_is_at_the_time_of_the_frame():
    mover = Mover(Circle((0, 0), 0.3), MoverPath([(1, 4), (4, 4)], speed=0.1))
    world = World(width=5, height=5, start=(1, 1, 0), target=(4, 1), movers=[mover])
    trial = devlearn.Trial(world, seed=1)
    trial.free_learning(10)
    record = trial.free_learning(20)  # from 5 s to 15 s
    frames = list(devlearn.animate(record, seconds=1, width=480))
    for frame, seconds in ((frames[0], 5), (frames[-1], 15)):
        assert place_of(frame, OBSTACLE) == pytest.approx((1 + 0.1 * seconds, 4), abs=0.04)


def test_the_path_has_the_colours_of_its_kinds():
    places = [(1 + 0.05 * i, 2.5) for i in range(60)]
    colours = []
    for kinds in ([NO_CHANGE], [(E, 0, 0)]):
        film = devlearn.animate(row(places, kinds=kinds), seconds=1, width=480)
        *_, last = film
        height = last.shape[0]
        colours.append(of_colour(last[: height * 9 // 10], ORANGE).sum())
    assert colours[0] == 0
    assert colours[1] > 100


def test_the_newest_steps_stand_out_from_those_before():
    places = [(0.5 + 0.04 * i, 2.5) for i in range(101)]
    *_, last = devlearn.animate(row(places, kinds=[RETRY]), seconds=1, width=480)
    middle = last[last.shape[0] // 2 - 60 : last.shape[0] // 2 + 60].min(axis=2)
    dark = middle.min(axis=0)
    assert dark[100:200].mean() > dark[300:350].mean() + 30


def test_a_step_that_touches_shows():
    free, touching = row([(1, 1), (2, 1)]), row([(1, 1), (2, 1)])
    touching.collided[:] = True
    frames = [next(iter(devlearn.animate(r, seconds=1, width=SMALL))) for r in (free, touching)]
    assert of_colour(frames[1], VERMILLION).sum() > of_colour(frames[0], VERMILLION).sum()


def of_steps(steps):
    """A record of one round of so many steps, all of them alike."""
    one = hand_made([NO_CHANGE])
    columns = {name: np.broadcast_to(one[name][:1], (steps,)) for name in STEP_COLUMNS}
    columns |= {name: np.broadcast_to(one[name][:1] + 2, (steps + 1,)) for name in POSE_COLUMNS}
    rounds = one.rounds.copy()
    rounds["steps"] = steps
    return devlearn.Record({**columns, "rounds": rounds}, one.provenance)


def test_a_round_of_no_steps_shows_the_robot_where_it_began():
    film = devlearn.animate(of_steps(0), seconds=1, width=SMALL)
    *_, last = film
    assert place_of(last, GREEN) == pytest.approx((2, 2), abs=0.1)


# --- how long, how large --------------------------------------------------------------------------


def test_every_round_has_the_same_share_of_the_seconds(paths):
    film = devlearn.animate(paths, rounds="1,2,5-6", seconds=4, width=SMALL)
    assert (film.seconds, len(film), film.rounds) == (4.0, 100, [1, 2, 5, 6])
    frames = list(film)
    assert len(frames) == 100
    # Each round stands still for the last fifth of its share, and not before.
    for end in (25, 50, 75, 100):
        assert all(np.array_equal(frames[end - 1], frame) for frame in frames[end - 5 : end])
        assert not np.array_equal(frames[end - 1], frames[end - 10])


def test_a_film_at_a_speed_is_as_long_as_its_steps_take(paths):
    film = devlearn.animate(paths, rounds=[3], speed=50, width=SMALL)
    steps = int(paths.rounds["steps"][2])
    assert film.seconds == pytest.approx(steps * 0.5 / 50 + 0.5, abs=0.03)


def test_by_default_rounds_from_the_first_to_the_last_are_shown(paths):
    film = devlearn.animate(paths, width=SMALL)
    assert film.seconds == 10
    assert film.rounds[0] == 1
    assert film.rounds[-1] == len(paths.rounds)
    assert len(film.rounds) <= 8
    assert np.all(np.diff(np.diff(film.rounds)) >= 0) or len(paths.rounds) <= 20
    assert devlearn.animate(paths.part(slice(0, 5)), width=SMALL).rounds == [1, 2, 3, 4, 5]


@pytest.mark.parametrize("width", [240, 241, 500])
def test_frames_have_the_size_that_the_film_says_and_it_is_even(paths, width):
    film = devlearn.animate(paths, seconds=1, width=width)
    frame = next(iter(film))
    assert frame.shape == (film.size[1], film.size[0], 3)
    assert frame.dtype == np.uint8
    assert abs(film.size[0] - width) <= 1
    assert film.size[0] % 2 == film.size[1] % 2 == 0


@pytest.mark.parametrize("shape", [(100, 1), (1, 100)])
def test_arenas_far_from_square_give_films_that_can_be_seen(shape):
    world = World(width=shape[0], height=shape[1], start=(0.5, 0.5, 0), target=(0.8, 0.8))
    record = devlearn.Trial(world, seed=1).free_learning(5)
    width, height = devlearn.animate(record, width=SMALL).size
    assert width / 4 < height < 2 * width


def test_the_same_record_gives_the_same_film(paths):
    films = [devlearn.animate(paths, rounds="1,last", seconds=1, width=SMALL) for _ in range(2)]
    for a, b in zip(*films):
        assert np.array_equal(a, b)
    assert all(np.array_equal(a, b) for a, b in zip(films[0], films[0]))  # once more, the same
    for kind in ("gif", "mp4", "webp"):
        assert films[0].to_bytes(kind) == films[1].to_bytes(kind)


def test_of_a_hundred_million_steps_some_are_drawn_and_the_film_says_so():
    film = devlearn.animate(of_steps(10**8), seconds=1, width=SMALL)
    assert film.every > 100
    *_, last = film
    assert place_of(last, GREEN) == pytest.approx((2, 2), abs=0.1)
    assert devlearn.animate(hand_made([NO_CHANGE] * 50), width=SMALL).every == 1


# --- files ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["gif", "mp4", "webp"])
def test_a_file_has_the_frames_and_the_size_of_the_film(paths, tmp_path, kind):
    film = devlearn.animate(paths, rounds=[1], seconds=1, width=SMALL)
    path, told = tmp_path / f"film.{kind.upper()}", []
    film.save(path, progress=lambda frame, all_: told.append((frame, all_)))
    assert told == [(i, 25) for i in range(1, 26)]
    if kind == "mp4":
        reader = imageio_ffmpeg.read_frames(str(path))
        size = next(reader)["size"]
        images = [np.frombuffer(content, np.uint8) for content in reader]
        assert len(images) == 25
        images = [image.reshape(size[1], size[0], 3) for image in images]
    else:
        with Image.open(path) as image:
            size, seconds, images = image.size, 0.0, []
            for i in range(image.n_frames):
                image.seek(i)
                images.append(np.asarray(image.convert("RGB")))
                seconds += image.info["duration"] / 1000
        assert seconds == pytest.approx(1.0, abs=0.05)
        assert len(images) > 15  # frames that are alike may have become one
    assert size == film.size
    *_, last = film
    assert np.abs(images[-1].astype(int) - last).mean() < 2


def test_a_film_shows_itself_in_a_notebook(paths):
    shown = devlearn.animate(paths, rounds=[1], seconds=1, width=SMALL)._repr_html_()
    assert shown.startswith("<video ")
    assert 'src="data:video/mp4;base64,' in shown


@pytest.mark.parametrize("stop", [KeyboardInterrupt, MemoryError])
def test_a_film_that_is_stopped_leaves_what_was_there(paths, tmp_path, monkeypatch, stop):
    aside = tmp_path / "aside"
    aside.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(aside))
    path = tmp_path / "film.mp4"
    path.write_text("the film of yesterday")

    def progress(frame, _):
        if frame == 5:
            raise stop

    with pytest.raises(stop):
        devlearn.animate(paths, rounds=[1], seconds=1, width=SMALL).save(path, progress=progress)
    assert path.read_text() == "the film of yesterday"
    assert sorted(tmp_path.iterdir()) == [aside, path]
    assert list(aside.iterdir()) == []


# --- refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "quantity"),
    [
        ({"rounds": "0"}, "rounds"),
        ({"rounds": "13"}, "rounds"),
        ({"rounds": "5-2"}, "rounds"),
        ({"rounds": "some"}, "rounds"),
        ({"rounds": []}, "rounds"),
        ({"rounds": [1.5]}, "rounds"),
        ({"rounds": [True]}, "rounds"),
        ({"rounds": 3}, "rounds"),
        ({"seconds": 0.5}, "seconds"),
        ({"seconds": 3601}, "seconds"),
        ({"seconds": float("nan")}, "seconds"),
        ({"seconds": "10"}, "seconds"),
        ({"seconds": 10, "speed": 2}, "seconds"),
        ({"speed": 0}, "speed"),
        ({"speed": 1e-3}, "speed"),
        ({"width": 239}, "width"),
        ({"width": 2161}, "width"),
        ({"width": 640.0}, "width"),
    ],
)
def test_what_no_film_can_have_is_refused(paths, arguments, quantity):
    with pytest.raises(InvalidValue) as refusal:
        devlearn.animate(paths, **arguments)
    assert refusal.value.quantity == quantity


def test_more_rounds_than_frames_are_refused_with_the_seconds_that_they_take():
    record = row([(1, 1)] * 60, rounds=[(i + 1, 1, True) for i in range(30)])
    with pytest.raises(InvalidValue, match=r"at least 1\.2"):
        devlearn.animate(record, rounds="all", seconds=1)
    assert len(devlearn.animate(record, rounds="all", seconds=1.2)) == 30


def test_a_record_that_has_nothing_to_show_is_refused(paths):
    for record, given in (
        (paths.part(slice(0, 0)), "no rounds"),
        (devlearn.Trial(World.load("paper")).path_learning(2, rounds_only=True), "rounds only"),
    ):
        with pytest.raises(InvalidValue) as refusal:
            devlearn.animate(record)
        assert refusal.value.value == given
    with pytest.raises(InvalidValue, match="record"):
        devlearn.animate("paths.npz")


def test_a_record_that_does_not_tell_when_things_moved_is_refused():
    mover = Mover(Circle((0, 0), 0.3), MoverPath([(1, 4), (4, 4)], speed=0.1))
    world = World(width=5, height=5, start=(1, 1, 0), target=(4, 1), movers=[mover])
    record = devlearn.Trial(world, seed=1).free_learning(10)
    record.rounds["began"] = -1
    with pytest.raises(InvalidValue, match="began"):
        devlearn.animate(record)


@pytest.mark.parametrize("name", ["film", "film.avi", "gif"])
def test_a_name_of_no_film_is_refused(paths, tmp_path, name):
    with pytest.raises(InvalidValue, match="ends in one of .gif, .mp4, .webp"):
        devlearn.animate(paths, width=SMALL).save(tmp_path / name)


def test_a_missing_folder_is_named_before_a_frame_is_drawn(paths, tmp_path):
    with pytest.raises(FileError, match="no folder .*nowhere"):
        devlearn.animate(paths, width=SMALL).save(
            tmp_path / "nowhere" / "film.gif", progress=pytest.fail
        )


@pytest.mark.parametrize("program", ["/no/such/ffmpeg", "/bin/false"])
def test_an_ffmpeg_that_is_none_is_refused_saying_what_would_do(paths, monkeypatch, program):
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", program)
    with pytest.raises(FileError, match="imageio-ffmpeg") as refusal:
        devlearn.animate(paths, width=SMALL).to_bytes()
    assert refusal.value.file == program


def test_a_missing_package_is_named_with_how_to_get_it(paths, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(MissingExtra, match="pip install .*imageio-ffmpeg"):
        devlearn.animate(paths, width=SMALL).to_bytes()


# --- the command line -----------------------------------------------------------------------------


@pytest.mark.parametrize("how", [["film.gif"], ["--output", "film.gif"], []])
def test_the_verb_writes_the_film_that_it_is_asked_for(
    file_of_paths, tmp_path, monkeypatch, capsys, how
):
    monkeypatch.chdir(tmp_path)
    more = ["--rounds", "1,last", "--seconds", "1", "--width", str(SMALL)]
    assert cli.main(["film", str(file_of_paths), *how, *more]) == 0
    said = capsys.readouterr()
    assert "rounds 1, 12 of 12; 1 s, 240 x " in said.out
    assert said.out.endswith("written: film.gif\n")
    assert said.err == ""
    film = devlearn.animate(
        devlearn.Record.load(file_of_paths), rounds="1,last", seconds=1, width=SMALL
    )
    assert (tmp_path / "film.gif").read_bytes() == film.to_bytes("gif")


def test_the_verb_takes_a_folder_of_devlearn_run(tmp_path, capsys):
    folder, film = tmp_path / "run", tmp_path / "film.gif"
    asked = ["--steps", "20", "--rounds", "1", "--output", str(folder)]
    assert cli.main(["run", "empty", *asked]) == 0
    more = ["--rounds", "all", "--seconds", "1", "--width", str(SMALL)]
    assert cli.main(["film", str(folder), str(film), *more]) == 0
    assert "rounds 1, 2, 3 of 3" in capsys.readouterr().out
    assert cli.main(["film", "paper", str(film), *more]) == 1
    assert "no such file" in capsys.readouterr().err
    world = tmp_path / "world.json"
    devlearn.World.load("paper").save(world)
    assert cli.main(["film", str(world), str(film), *more]) == 1
    assert "a world" in capsys.readouterr().err


def test_the_verb_refuses_two_names(file_of_paths, capsys):
    assert cli.main(["film", str(file_of_paths), "a.gif", "--output", "b.gif"]) == 1
    assert "no second name beside a.gif" in capsys.readouterr().err


def test_the_verb_tells_how_far_it_is_on_a_terminal_only(file_of_paths, tmp_path, monkeypatch):
    said = io.StringIO()
    monkeypatch.setattr(said, "isatty", lambda: True, raising=False)
    monkeypatch.setattr(sys, "stderr", said)
    more = ["--rounds", "1", "--seconds", "1", "--width", str(SMALL)]
    assert cli.main(["film", str(file_of_paths), str(tmp_path / "film.mp4"), *more]) == 0
    assert "frame 7 of 25" in said.getvalue()
    assert said.getvalue().endswith("\r\33[K")
