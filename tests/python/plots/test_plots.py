"""What the plots draw is what the record, the world or the learner says."""

import gc
import importlib
import math
import os
import subprocess
import sys
import time
import weakref

import devlearn
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import refused
from devlearn import InvalidValue, Kind, WrongType, plots
from devlearn.plots.panels import panels, shared_legend
from devlearn.plots.style import COLUMN, OBSTACLE
from devlearn.record import STEP_COLUMNS
from handmade import (
    ABANDONMENT,
    ALL_FOUR,
    EFFECTIVE,
    INEFFECTIVE,
    NO_CHANGE,
    REDUCTION,
    RETRY,
    E,
    H,
    X,
    hand_made,
)
from matplotlib.colors import to_hex

matplotlib.use("Agg")


@pytest.fixture(scope="module")
def trial():
    return devlearn.Trial(devlearn.World.load("paper"), seed=0)


@pytest.fixture(scope="module")
def free(trial):
    return trial.free_learning(3000)


@pytest.fixture(scope="module")
def paths(free, trial):
    return trial.path_learning(5, step_limit=600)


@pytest.fixture(autouse=True)
def no_figure_stays_open():
    yield
    plt.close("all")


@pytest.fixture
def ax():
    return plt.figure().add_subplot()


def by_gid(ax, gid):
    found = [artist for artist in ax.get_children() if artist.get_gid() == gid]
    assert len(found) == 1, (gid, [a.get_gid() for a in ax.get_children() if a.get_gid()])
    return found[0]


def gids(ax):
    return {artist.get_gid() for artist in ax.get_children()} - {None}


def xy(ax, gid):
    return np.asarray(by_gid(ax, gid).get_xydata())


# --- what all have in common ----------------------------------------------------------------------


def every_plot(free, paths, trial):
    return {
        "world": lambda ax: plots.plot_world(trial.world, ax=ax),
        "sef": lambda ax: plots.plot_sef(trial.world, ax=ax, points=21),
        "by kind": lambda ax: plots.plot_trajectory(free, ax=ax),
        "by time": lambda ax: plots.plot_trajectory(free, ax=ax, by="time"),
        "path": lambda ax: plots.plot_trajectory(paths, ax=ax, entry=-1, by=None),
        "counts": lambda ax: plots.plot_counts(free, ax=ax),
        "episodes": lambda ax: plots.plot_episodes(free, ax=ax),
        "rounds": lambda ax: plots.plot_rounds(paths, ax=ax, shortest=113, settled=4),
        "preferences": lambda ax: plots.plot_preferences(trial, ax=ax),
        "distribution": lambda ax: plots.plot_distribution({"a": [1, 2]}, ax=ax, ylabel="steps"),
    }


def test_the_axes_passed_are_returned_and_no_figure_is_made(free, paths, trial):
    for name, plot in every_plot(free, paths, trial).items():
        ax = plt.figure().add_subplot()
        figures = plt.get_fignums()
        assert plot(ax) is ax, name
        assert plt.get_fignums() == figures, name


def test_without_axes_a_figure_of_a_columns_width_is_made_and_left_to_nobody(free, paths, trial):
    for name, plot in every_plot(free, paths, trial).items():
        ax = plot(None)
        assert plt.get_fignums() == [], name
        assert ax.figure.get_figwidth() == COLUMN, name
        figure = weakref.ref(ax.figure)
        del ax
        gc.collect()
        assert figure() is None, name


def test_where_pyplot_is_interactive_it_has_the_figure_to_show(paper):
    with plt.rc_context({"interactive": True}):
        ax = plots.plot_world(paper)
    assert plt.get_fignums() == [ax.figure.number]


@pytest.mark.parametrize(
    "settings",
    [
        "text.usetex: True",
        "backend: nonsense",
        "backend: TkAgg",
        "axes.grid: True\nfont.family: Nope",
    ],
)
def test_a_users_matplotlibrc_kills_no_picture(tmp_path, settings):
    (tmp_path / "matplotlibrc").write_text(settings)
    code = (
        "import devlearn; from devlearn import plots\n"
        "plots.save(plots.plot_world(devlearn.World.load('paper')), 'world.png')"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=60,
        env={k: v for k, v in os.environ.items() if k != "MPLBACKEND"},
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "world.png").stat().st_size > 5000


def test_long_arenas_and_many_obstacles_give_a_picture_in_seconds(tmp_path):
    began = time.process_time()
    long = devlearn.World(
        width=0.5, height=1000, start=(0.25, 1, 0), target=(0.25, 999),
        obstacles=[devlearn.Circle((0.1, 500), 0.05)],
    )  # fmt: skip
    places = [(5 + 3.3 * i, 5 + 3.3 * j) for i in range(300) for j in range(300)]
    many = devlearn.World(
        width=1000, height=1000, start=(1, 1, 0), target=(999, 999),
        obstacles=[devlearn.Circle(place, 1) for place in places],
    )  # fmt: skip
    for name, world in (("long", long), ("many", many)):
        ax = plots.plot_world(world)
        assert ax.figure.get_figheight() < 10
        plots.save(ax, tmp_path / f"{name}.png")
    assert time.process_time() - began < 30


def test_a_picture_is_written_as_its_name_says_and_nothing_else(tmp_path, paper):
    ax = plots.plot_world(paper)
    for kind, begins in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
        plots.save(ax, tmp_path / f"world.{kind}")
        first = (tmp_path / f"world.{kind}").read_bytes()
        assert first.startswith(begins)
        plots.save(ax, tmp_path / f"world.{kind}")
        assert (tmp_path / f"world.{kind}").read_bytes() == first
    with pytest.raises(devlearn.InvalidValue, match="ends in .png"):
        plots.save(ax, tmp_path / "world.bmp")
    with pytest.raises(devlearn.FileError):
        plots.save(ax, tmp_path / "nowhere" / "world.png")


def assert_nothing_is_cut_off(figure, name):
    figure.canvas.draw()
    drawn, page = figure.get_tightbbox(), figure.get_size_inches()
    assert drawn.x0 >= 0 and drawn.y0 >= 0, (name, drawn)
    assert drawn.x1 <= page[0] and drawn.y1 <= page[1], (name, drawn, page)


def test_nothing_drawn_in_a_figure_of_its_own_is_cut_off(free, paths, trial):
    for name, plot in every_plot(free, paths, trial).items():
        assert_nothing_is_cut_off(plot(None).figure, name)


@pytest.mark.parametrize("origin", [(100, -50), (-2000, 3000), (1e5, -1e5)])
def test_numbers_of_a_world_far_away_are_written_out_and_not_cut_off(origin):
    x, y = origin
    world = devlearn.World(5, 5, start=(x + 1, y + 1, 0), target=(x + 4, y + 4), origin=origin)
    for ax in (plots.plot_world(world), plots.plot_sef(world, points=21)):
        assert_nothing_is_cut_off(ax.figure, origin)
        for axis, edge in ((ax.xaxis, x), (ax.yaxis, y)):
            assert f"{edge:.0f}".replace("-", "\N{MINUS SIGN}") in [
                label.get_text() for label in axis.get_ticklabels()
            ]


def test_no_plot_runs_a_trial_or_moves_what_it_reads(free, paths, trial, monkeypatch):
    def refuse(*_, **__):
        raise AssertionError("a plot ran a trial")

    for name in ("step", "run", "free_learning", "path_learning", "begin_round", "place"):
        monkeypatch.setattr(devlearn.Trial, name, refuse)
    for name in ("choose", "learn", "update"):
        monkeypatch.setattr(devlearn.Learner, name, refuse)
    monkeypatch.setattr(devlearn.Robot, "step", refuse)
    before = {name: getattr(free, name).copy() for name in STEP_COLUMNS}
    explored = trial.learner.explored_count
    for plot in every_plot(free, paths, trial).values():
        plot(None)
    assert trial.learner.explored_count == explored
    for name, column in before.items():
        np.testing.assert_array_equal(getattr(free, name), column)


def test_no_setting_of_matplotlib_is_left_changed(free, paths, trial):
    before = dict(matplotlib.rcParams)
    for plot in every_plot(free, paths, trial).values():
        plot(None)
    assert dict(matplotlib.rcParams) == before


def test_maps_have_equal_aspect_and_metres(free, paths, trial):
    every = every_plot(free, paths, trial)
    for name in ("world", "sef", "by kind", "by time", "path", "preferences"):
        ax = every[name](None)
        assert ax.get_aspect() == 1.0, name
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]"), name


def names(ax):
    """What the legend says."""
    legend = ax.get_legend()
    return {text.get_text() for text in legend.get_texts()} if legend else set()


def test_robot_and_target_are_named_wherever_they_are_drawn(free, paths, trial):
    drawn = set()
    for name, plot in every_plot(free, paths, trial).items():
        ax = plot(None)
        marks = {"robot": "robot at start", "target": "target"}
        shown = {marks[gid] for gid in gids(ax) & set(marks)}
        assert shown <= names(ax), name
        drawn |= {(name, mark) for mark in shown}
    assert {("by kind", "robot at start"), ("by time", "target"), ("sef", "target")} < drawn
    ax = plots.plot_world(trial.world, pose=(1.0, 2.0, 0.0))
    assert "robot" in names(ax) and "robot at start" not in names(ax)


def test_the_legend_of_several_panels_names_robot_and_target_once(paths):
    figure, axes = panels(1, 2)
    for entry, ax in enumerate(axes):
        plots.plot_trajectory(paths, ax=ax, entry=entry, legend=False)
    shared_legend(figure, axes)
    (legend,) = figure.legends
    told = [text.get_text() for text in legend.get_texts()]
    assert told.count("robot at start") == told.count("target") == 1


NO_ROUNDS = hand_made([NO_CHANGE]).part(slice(0, 0))
NO_STEPS = devlearn.Trial(devlearn.World(), seed=0).free_learning(0)
ROUNDS_ONLY = devlearn.Trial(devlearn.World(), seed=0).path_learning(2, 9, rounds_only=True)
OF_ROUNDS = {
    "by kind": plots.plot_trajectory,
    "by time": lambda record: plots.plot_trajectory(record, by="time"),
    "path": lambda record: plots.plot_trajectory(record, entry=-1, by=None),
    "counts": plots.plot_counts,
    "counts of a window": lambda record: plots.plot_counts(record, steps=(0, 30)),
    "episodes": plots.plot_episodes,
    "rounds": plots.plot_rounds,
}
OF_A_WORLD = {
    "world": plots.plot_world,
    "sef": lambda record: plots.plot_sef(record, points=11),
    "surface": lambda record: plots.plot_sef_surface(record, points=11),
    "preferences": lambda record: plots.plot_preferences(record, devlearn.Learner()),
}


@pytest.mark.parametrize("plot", OF_ROUNDS.values(), ids=OF_ROUNDS)
def test_a_record_of_no_rounds_is_refused_as_that(plot):
    refused(lambda: plot(NO_ROUNDS), "record", "no rounds")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("plot", OF_ROUNDS.values(), ids=OF_ROUNDS)
def test_a_round_of_no_steps_is_drawn_empty(plot):
    ax = plot(NO_STEPS)
    assert "0 steps" in ax.get_title() or "nothing" in gids(ax) or ax.get_xlabel() == "round"
    assert_nothing_is_cut_off(ax.figure, ax.get_title())
    # No ticks that mean nothing, such as step -0.04.
    for axis in (ax.xaxis, ax.yaxis):
        assert all(tick == round(tick) for tick in axis.get_majorticklocs())


@pytest.mark.parametrize("plot", OF_ROUNDS.values(), ids=OF_ROUNDS)
def test_a_record_without_steps_serves_for_its_rounds_alone(plot):
    if plot is plots.plot_rounds:
        np.testing.assert_array_equal(xy(plot(ROUNDS_ONLY), "failed"), [(1, 9), (2, 9)])
    else:
        refused(lambda: plot(ROUNDS_ONLY), "record", "rounds only")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("record", [NO_ROUNDS, NO_STEPS, ROUNDS_ONLY])
@pytest.mark.parametrize("plot", OF_A_WORLD.values(), ids=OF_A_WORLD)
def test_what_is_drawn_of_a_records_world_needs_no_steps(plot, record):
    plot(record).figure.canvas.draw()


@pytest.mark.parametrize("plot", [OF_ROUNDS["path"], *OF_A_WORLD.values()])
def test_a_record_that_does_not_tell_where_it_comes_from_is_refused_as_that(plot):
    columns = {name: NO_STEPS[name] for name in NO_STEPS}
    refused(lambda: plot(devlearn.Record(columns, {})), "record.provenance")


@pytest.mark.parametrize("plot", [plots.plot_trajectory, plots.plot_counts, plots.plot_episodes])
def test_an_entry_that_is_none_is_refused_alike_by_all(plot, paths):
    for entry in (99, -99):
        error = refused(lambda entry=entry: plot(paths, entry=entry), "round entry", str(entry))
        assert error.allowed == "in [-5, 4]"
    for entry in (1.5, "1", None):
        with pytest.raises(devlearn.WrongType, match="round entry: got .*a whole number"):
            plot(paths, entry=entry)


def test_devlearn_itself_does_not_need_matplotlib(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "devlearn.plots")
    with pytest.raises(ImportError, match=r"-m pip install 'matplotlib>="):
        importlib.import_module("devlearn.plots")


def test_importing_devlearn_does_not_import_matplotlib():
    code = "import devlearn, sys; print('matplotlib' in sys.modules)"
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "False"


# --- worlds ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("others", [0, 1001])
@pytest.mark.parametrize("turn", [1, -1])
def test_holes_are_drawn_free_and_thin_walls_as_lines(turn, others):
    corners = [(1, 1), (4, 1), (4, 4), (1, 4)]
    hole = [(2, 2), (3, 2), (3, 3), (2, 3)][::turn]
    world = devlearn.World(
        obstacles=[
            devlearn.Polygon(corners, [hole]),
            devlearn.Polyline([(4.2, 0.5), (4.8, 0.5), (4.8, 0.9), (4.2, 0.5)]),
            *[devlearn.Circle((0.05, 4.95), 0.02)] * others,
        ]
    )
    axes = plots.plot_world(world, sonar=False)
    axes.figure.set_dpi(200)
    axes.figure.canvas.draw()
    picture = np.asarray(axes.figure.canvas.buffer_rgba())

    def colour(x, y):
        column, row = axes.transData.transform((x, y))
        return to_hex(picture[len(picture) - 1 - int(row), int(column)] / 255).upper()

    assert colour(1.5, 2.5) == OBSTACLE
    assert colour(2.5, 2.5) == colour(0.3, 2.5) == colour(4.7, 0.7) == "#FFFFFF"
    assert colour(4.5, 0.5) != "#FFFFFF"


def test_a_world_shows_every_obstacle_where_it_is(ax):
    world = devlearn.World(
        obstacles=[
            devlearn.Circle((1.0, 2.0), 0.3),
            devlearn.Rectangle((3.0, 1.0), (1.0, 0.5), 90.0),
            devlearn.Polygon([(2.0, 3.0), (3.0, 3.0), (2.5, 4.0)]),
        ]
    )
    plots.plot_world(world, ax=ax)
    circle = by_gid(ax, "obstacle-0")
    assert (circle.center, circle.radius) == ((1.0, 2.0), 0.3)
    corners = by_gid(ax, "obstacle-1").get_xy()[:-1]
    expected = [(3.25, 0.5), (3.25, 1.5), (2.75, 1.5), (2.75, 0.5)]
    np.testing.assert_allclose(corners, expected, atol=1e-12)
    expected = [(2.0, 3.0), (3.0, 3.0), (2.5, 4.0)]
    np.testing.assert_array_equal(by_gid(ax, "obstacle-2").get_xy()[:-1], expected)
    walls = by_gid(ax, "walls").get_bbox()
    assert (walls.x0, walls.y0, walls.x1, walls.y1) == (0, 0, world.width, world.height)
    np.testing.assert_array_equal(xy(ax, "target"), [world.target])


def test_sonar_rays_end_where_the_robot_hears_them(ax):
    world, body = devlearn.World.load("paper"), devlearn.RobotDef()
    pose = (1.0, 2.0, 30.0)
    plots.plot_world(world, ax=ax, robot=body, pose=pose)
    echoes = devlearn.Robot(world, body).sonar(pose)
    for i, (angle, echo) in enumerate(zip(body.sonar_angles(), echoes)):
        ray = xy(ax, f"sonar-{i}")
        distances = np.hypot(*(ray - pose[:2]).T)
        np.testing.assert_allclose(distances, [body.radius, body.radius + echo], atol=1e-12)
        turned = math.degrees(math.atan2(*(ray[1] - ray[0])[::-1])) - (pose[2] + angle)
        assert math.cos(math.radians(turned)) == pytest.approx(1.0)
    robot = by_gid(ax, "robot")
    assert (robot.center, robot.radius) == (pose[:2], body.radius)


def test_a_ray_that_meets_nothing_has_no_echo_to_mark(ax):
    plots.plot_world(devlearn.World(start=(2.5, 2.5, 0)), ax=ax)
    assert {by_gid(ax, f"sonar-{i}").get_marker() for i in range(5)} == {"None"}


def test_sonars_can_be_left_out(ax):
    plots.plot_world(devlearn.World(), ax=ax, sonar=False)
    assert not any(gid.startswith("sonar") for gid in gids(ax))


def test_a_world_elsewhere_is_drawn_where_it_lies(ax):
    world = devlearn.World(origin=(256, -128), start=(256.5, -127.5, 0), target=(260.5, -123.5))
    plots.plot_sef(world, ax=ax, points=51)
    assert by_gid(ax, "walls").get_bbox().extents.tolist() == [256, -128, 261, -123]
    left, right, bottom, top = by_gid(ax, "sef").get_extent()
    assert (left, right, bottom, top) == pytest.approx((255.95, 261.05, -128.05, -122.95))
    assert ax.get_xlim() == pytest.approx((255.9, 261.1))
    assert ax.get_ylim() == pytest.approx((-128.1, -122.9))
    trial = devlearn.Trial(world, seed=1)
    trial.free_learning(500)
    field = plots.preference_field(trial)
    assert (field.x > 256).all()
    assert (field.y < -123).all()


@pytest.mark.parametrize("name", devlearn.worlds())
def test_every_shipped_world_can_be_drawn(name):
    ax = plots.plot_world(devlearn.World.load(name))
    ax.figure.canvas.draw()


# --- SEF ------------------------------------------------------------------------------------------


def test_the_map_shows_sef_at_each_point(ax):
    world, sef = devlearn.World.load("paper"), devlearn.StateEvaluation(a1=10.0)
    plots.plot_sef(world, ax=ax, evaluation=sef, points=11)
    values = by_gid(ax, "sef").get_array()
    assert values.shape == (11, 11)
    for row, column in [(0, 0), (3, 8), (10, 2)]:
        x, y = 0.5 * column, 0.5 * row
        goal = math.hypot(x - world.target[0], y - world.target[1])
        assert values[row, column] == pytest.approx(sef(goal, world.clearance(x, y)))


def test_walls_count_where_asked(ax):
    world = devlearn.World()
    plots.plot_sef(world, ax=ax, points=11, walls_count=True)
    values = by_gid(ax, "sef").get_array()
    expected = devlearn.StateEvaluation()(math.hypot(*world.target), 0.0)
    assert values[0, 0] == pytest.approx(expected)


def test_the_scale_stops_at_the_floor_and_says_so():
    ax = plots.plot_sef(devlearn.World.load("paper"), points=101, floor=3.0)
    assert by_gid(ax, "sef").get_clim()[0] == 3.0
    assert by_gid(ax, "sef").colorbar.extend == "min"
    ax = plots.plot_sef_surface(devlearn.World.load("paper"), points=101, floor=3.0)
    assert "cut off at 3" in ax.get_zlabel()
    assert ax.get_zlim()[0] <= 3.0


def test_the_surface_needs_three_dimensions(ax):
    with pytest.raises(InvalidValue, match="3d"):
        plots.plot_sef_surface(devlearn.World(), ax=ax)
    solid = plt.figure().add_subplot(projection="3d")
    assert plots.plot_sef(devlearn.World(), ax=solid, kind="surface") is solid
    assert (solid.get_xlabel(), solid.get_ylabel()) == ("x [m]", "y [m]")


def test_a_map_of_an_unknown_kind_is_refused(ax):
    with pytest.raises(InvalidValue, match="kind"):
        plots.plot_sef(devlearn.World(), ax=ax, kind="contour")


# --- paths ----------------------------------------------------------------------------------------


def test_a_path_is_the_records(paths, ax):
    plots.plot_trajectory(paths, ax=ax, entry=2, by=None)
    np.testing.assert_array_equal(xy(ax, "path"), paths.path(2)[:, :2])
    assert by_gid(ax, "robot").center == tuple(paths.path(2)[0, :2])


def test_each_kind_of_step_is_drawn_from_where_it_was_chosen(free, ax):
    plots.plot_trajectory(free, ax=ax)
    path = free.path(0)[:, :2]
    for name, kind in (("explore", E), ("exploit", X), ("exhausted", H)):
        drawn = xy(ax, f"path-{name}").reshape(-1, 3, 2)
        chosen = free.kind == kind
        assert chosen.any()
        np.testing.assert_array_equal(drawn[:, 0], path[:-1][chosen])
        np.testing.assert_array_equal(drawn[:, 1], path[1:][chosen])
        assert np.isnan(drawn[:, 2]).all()


def test_the_legend_gives_the_number_of_steps_of_each_kind(free, ax):
    plots.plot_trajectory(free, ax=ax)
    shown = {text.get_text().replace("\u2009", "") for text in ax.get_legend().get_texts()}
    counts = {name: np.count_nonzero(free.kind == kind) for name, kind in Kind.__members__.items()}
    kinds = {f"{name.lower()} ({count})" for name, count in counts.items() if count}
    assert shown == kinds | {"robot at start", "target"}


def test_every_step_is_drawn_whatever_its_kind():
    record = hand_made([NO_CHANGE] * 14)
    record.kind[:] = sorted(map(int, Kind.__members__.values())) * 2
    ax = plots.plot_trajectory(record)
    lines = [line for line in ax.get_lines() if str(line.get_gid()).startswith("path-")]
    assert sum(len(line.get_xdata()) for line in lines) == 3 * 14
    assert len({(line.get_color(), line.get_linewidth()) for line in lines}) == len(
        Kind.__members__
    )
    shown = {text.get_text() for text in ax.get_legend().get_texts()}
    assert {f"{line.get_label()}" for line in lines} | {"robot at start", "target"} == shown
    assert sum(text.endswith(" (2)") for text in shown) == len(Kind.__members__)


def test_kinds_differ_in_more_than_colour(free, ax):
    plots.plot_trajectory(free, ax=ax)
    lines = [by_gid(ax, f"path-{name}") for name in ("explore", "exploit", "exhausted")]
    assert len({line.get_marker() for line in lines}) == 3


def test_time_colours_each_step_by_its_number(paths, ax):
    plots.plot_trajectory(paths, ax=ax, entry=1, by="time")
    lines, path = by_gid(ax, "path"), paths.path(1)[:, :2]
    np.testing.assert_array_equal(lines.get_array(), np.arange(1, len(path)))
    np.testing.assert_array_equal(np.array(lines.get_segments())[:, 1], path[1:])


def test_the_title_tells_round_steps_and_failure():
    steps = [NO_CHANGE] * 5
    record = hand_made(steps, rounds=[(1, 2, True), (2, 3, False)])
    assert plots.plot_trajectory(record).get_title() == "round 1 of 2: 2 steps"
    title = "round 2 of 2: 3 steps, not arrived"
    assert plots.plot_trajectory(record, entry=1).get_title() == title
    assert plots.plot_trajectory(record, entry=-1).get_title() == title
    assert plots.plot_trajectory(record, entry=-1, title=False).get_title() == ""


def test_rounds_of_path_learning_are_counted_as_they_were_asked_for(paths):
    count = len(paths.rounds)  # as asked for, after one round of free learning
    assert paths.rounds["round"].tolist() == list(range(2, count + 2))
    for entry in (0, 2, -1, -count):
        number = range(1, count + 1)[entry]
        told = f"round {number} of {count} ({number + 1} of the trial)"
        title = plots.plot_trajectory(paths, entry=entry).get_title()
        assert title.startswith(told + "\n")
        for plot in (plots.plot_counts, plots.plot_episodes):
            assert plot(paths, entry=entry).get_xlabel() == f"step of {told}"


def test_the_only_round_of_a_record_has_its_number_in_the_trial(trial):
    second = devlearn.Trial(trial.world, seed=0)
    second.free_learning(10)
    record = second.free_learning(10)
    assert plots.plot_trajectory(record).get_title() == "round 2: 10 steps, not arrived"
    assert plots.plot_counts(record).get_xlabel() == "step"
    assert plots.plot_rounds(record).get_xlabel() == "round"


def test_the_longest_title_and_legend_are_not_cut_off():
    of_kinds = [EFFECTIVE, NO_CHANGE, RETRY, (Kind.UNSTATED, 0, 0)]
    for kinds, times in ((1, 10_000), (2, 10_000), (3, 10_000), (4, 10)):
        steps = of_kinds[:kinds] * times
        rounds = [(1000, 1, True), (1001, len(steps), False)]
        ax = plots.plot_trajectory(hand_made([NO_CHANGE, *steps], rounds=rounds), entry=-1)
        told = ax.get_title().replace("\u2009", ",")
        assert told == f"round 2 of 2 (1001 of the trial)\n{len(steps):,} steps, not arrived"
        assert len(names(ax)) == kinds + 2
        assert_nothing_is_cut_off(ax.figure, told)


def test_a_path_can_be_added_to_what_is_drawn(paths, ax):
    plots.plot_trajectory(paths, ax=ax, entry=0, by=None)
    lines = len(ax.lines)
    plots.plot_trajectory(paths, ax=ax, entry=1, by=None, world=False)
    assert len(ax.lines) == lines + 1
    plots.plot_trajectory(paths, ax=ax, entry=2, world=False)
    assert {"robot at start", "target"} < names(ax)


def test_a_path_with_a_name_is_in_the_legend_under_it(paths, ax):
    plots.plot_trajectory(paths, ax=ax, by=None, label="seed 0")
    assert names(ax) == {"seed 0", "robot at start", "target"}


def test_a_round_that_is_not_there_is_refused(paths, ax):
    with pytest.raises(InvalidValue, match="round entry"):
        plots.plot_trajectory(paths, ax=ax, entry=99)
    with pytest.raises(InvalidValue, match="by"):
        plots.plot_trajectory(paths, ax=ax, by="speed")


# --- counts ---------------------------------------------------------------------------------------


def test_a_motion_explored_at_step_24_shows_at_step_25(ax):
    record = hand_made([NO_CHANGE] * 23 + [EFFECTIVE] + [NO_CHANGE] * 6)
    plots.plot_counts(record, ax=ax, steps=(0, 30))
    for gid in ("explored", "effective"):
        steps, values = xy(ax, gid).T
        np.testing.assert_array_equal(steps, np.arange(1, 31))
        np.testing.assert_array_equal(values, [0] * 24 + [1] * 6)


def test_counts_are_the_records_one_step_later(free, ax):
    plots.plot_counts(free, ax=ax)
    for gid, column in (
        ("explored", free.explored_count),
        ("effective", free.effective_count),
    ):
        steps, values = xy(ax, gid).T
        np.testing.assert_array_equal(steps, np.arange(1, len(free) + 1))
        np.testing.assert_array_equal(values, [0, *column[:-1]])


def test_counts_of_a_window_are_those_steps(free, ax):
    plots.plot_counts(free, ax=ax, steps=(100, 130))
    steps, values = xy(ax, "explored").T
    np.testing.assert_array_equal(steps, np.arange(101, 131))
    np.testing.assert_array_equal(values, free.explored_count[99:129])


def test_relative_counts_begin_at_zero_and_tell_from_where(free, ax):
    plots.plot_counts(free, ax=ax, steps=(100, 130), relative=True)
    values = xy(ax, "effective")[:, 1]
    np.testing.assert_array_equal(values, free.effective_count[99:129] - free.effective_count[99])
    shown = ax.get_legend().get_texts()[1].get_text()
    assert shown.endswith(f"\u2212 {free.effective_count[99]}")
    assert ax.get_ylabel() == "mappings since step 101"


# --- episodes -------------------------------------------------------------------------------------


def test_rectangles_stand_around_their_episodes(ax):
    record = hand_made(ALL_FOUR)
    plots.plot_episodes(record, ax=ax)
    counts = np.stack(plots.counts_before(record))
    for name, episode in plots.find_episodes(record).items():
        box = by_gid(ax, f"episode-{name}").get_bbox()
        inside = counts[:, episode.first - 1 : episode.last]
        assert episode.first - 1 < box.x0 < episode.first
        assert episode.last < box.x1 < episode.last + 1
        assert box.y0 < inside.min() and inside.max() < box.y1
        assert by_gid(ax, f"label-{name}").get_text() == name
    assert ax.get_title() == ""
    assert "episode-d*" not in gids(ax)


def test_the_picture_says_which_kinds_are_absent(ax):
    record = hand_made([INEFFECTIVE, EFFECTIVE, ABANDONMENT] + [RETRY] * 30)
    plots.plot_episodes(record, ax=ax)
    assert {"episode-a", "episode-d*"} <= gids(ax)
    assert not {"episode-b", "episode-c", "episode-d"} & gids(ax)
    title = ax.get_title().replace("\n", " ")
    assert title.startswith("absent from steps 1 to 30: b (")
    assert "c (" in title and "d (" in title and "a (" not in title


def test_a_later_window_is_drawn_from_zero_and_its_rectangles_too(ax):
    record = hand_made([EFFECTIVE] * 100 + [NO_CHANGE] * 20 + [REDUCTION] + [NO_CHANGE] * 20)
    window = plots.find_window(record, "d")
    plots.plot_episodes(record, ax=ax, window=window)
    assert xy(ax, "explored")[0].tolist() == [window[0] + 1, 0]
    assert xy(ax, "effective")[-1].tolist() == [window[1], -1]
    box = by_gid(ax, "episode-d").get_bbox()
    assert box.y0 < -1 and 0 < box.y1 < 1


@pytest.mark.parametrize("window", [(-1, 30), (5, 5), (30, 0)])
def test_a_window_that_is_none_is_refused(window):
    record = hand_made([NO_CHANGE] * 40)
    with pytest.raises(InvalidValue, match="window"):
        plots.plot_episodes(record, window=window)


# --- rounds ---------------------------------------------------------------------------------------


def test_rounds_are_the_records_and_failed_ones_are_crosses(ax):
    rounds = [(3, 10, True), (4, 20, False), (5, 8, True), (6, 8, True)]
    record = hand_made([NO_CHANGE] * 46, rounds=rounds)
    plots.plot_rounds(record, ax=ax, shortest=6, settled=5)
    np.testing.assert_array_equal(xy(ax, "arrived"), [(3, 10), (5, 8), (6, 8)])
    np.testing.assert_array_equal(xy(ax, "failed"), [(4, 20)])
    assert by_gid(ax, "failed").get_marker() == "x"
    assert set(by_gid(ax, "shortest").get_ydata()) == {6}
    assert set(by_gid(ax, "settled").get_xdata()) == {5}
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert "settled from round 5 of the trial: 8" in labels and "shortest possible: 6" in labels
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("round of the trial", "steps of the round")


def test_a_span_of_more_than_ten_is_drawn_on_a_logarithmic_axis():
    record = hand_made([NO_CHANGE] * 22, rounds=[(1, 20, True), (2, 2, True)])
    assert plots.plot_rounds(record).get_yscale() == "linear"
    assert plots.plot_rounds(record, shortest=1).get_yscale() == "log"
    assert plots.plot_rounds(record, log=True).get_yscale() == "log"


@pytest.mark.filterwarnings("error")
def test_rounds_that_begin_later_are_also_counted_from_one(paths, ax):
    count = len(paths.rounds)
    for _ in range(2):  # drawn over itself there is one such axis still
        plots.plot_rounds(paths, ax=ax, settled=4)
        (above,) = ax.child_axes
        ax.figure.canvas.draw()
    assert (ax.get_xlabel(), above.get_xlabel()) == (
        "round of the trial",
        f"round of these {count}",
    )
    first, last = ax.get_xlim()
    assert 1 < first < 2 and above.get_xlim() == pytest.approx((first - 1, last - 1))
    assert [tick for tick in above.get_xticks() if tick > 0][:2] == [1, 2]
    assert any(name.startswith("settled from round 4 of the trial: ") for name in names(ax))
    assert_nothing_is_cut_off(plots.plot_rounds(paths, settled=4).figure, "rounds")


@pytest.mark.parametrize("numbers", [(1, 2, 3), (5,), (2, 3, 7)])
def test_no_second_axis_counts_rounds_where_it_would_say_nothing_or_wrong(numbers, ax):
    record = hand_made([NO_CHANGE] * len(numbers), rounds=[(n, 1, True) for n in numbers])
    plots.plot_rounds(record, ax=ax)
    assert ax.child_axes == []
    np.testing.assert_array_equal(xy(ax, "arrived")[:, 0], numbers)
    assert all(tick == round(tick) >= 1 for tick in ax.get_xticks() if tick > ax.get_xlim()[0])


def test_a_settled_round_that_the_record_does_not_hold_is_refused():
    record = hand_made([NO_CHANGE] * 2, rounds=[(3, 1, True), (4, 1, True)])
    error = refused(lambda: plots.plot_rounds(record, settled=1), "settled", "1")
    assert error.allowed.endswith("3 to 4")


# --- preferences ----------------------------------------------------------------------------------


def test_ineffective_mappings_have_no_arrow(ax):
    learner, grid = devlearn.Learner(seed=0), devlearn.SituationGrid()
    learner.update(grid.situation(0.3, 0.3, 0.0), 2, 1.0)
    learner.update(grid.situation(4.0, 4.0, 0.0), 2, -1.0)
    plots.plot_preferences(devlearn.World(), learner, grid=grid, ax=ax)
    np.testing.assert_array_equal(by_gid(ax, "preferences").get_offsets(), [(0.375, 0.375)])
    np.testing.assert_array_equal(xy(ax, "nothing-effective"), [(4.125, 4.125)])


def test_the_arrows_are_those_of_the_field_and_stay_in_their_cells(trial, free, ax):
    field = plots.preference_field(trial)
    plots.plot_preferences(free, trial.learner, ax=ax)
    room = trial.world.clearance(field.x, field.y, walls_count=True)
    arrows, shown = by_gid(ax, "preferences"), (field.times > 0) & (room >= 0.1)
    drawn = np.column_stack([arrows.U, arrows.V])
    expected = np.column_stack([field.u, field.v])[shown]
    length = np.minimum(0.9 * 0.25, 2 * room[shown])
    np.testing.assert_allclose(drawn, length[:, None] * expected)
    np.testing.assert_array_equal(arrows.get_array(), field.times[shown])
    assert np.hypot(*drawn.T).max() <= 0.25


@pytest.mark.parametrize("name", ["paper", "office"])
@pytest.mark.parametrize("cell_size", [0.1, 0.25, 0.55])
def test_nothing_is_drawn_where_the_robot_cannot_be_and_no_arrow_inside_obstacles(
    name, cell_size, ax
):
    config = devlearn.TrialConfig(cell_size=cell_size, heading_bins=1)
    trial = devlearn.Trial(devlearn.World.load(name), config, seed=0)
    world, grid, learner = trial.world, trial.grid, trial.learner
    for situation in range(grid.count):  # as if it had been everywhere, and found half of it good
        learner.update(situation, situation % 5, (situation // 5) % 2 or -1)
    plots.plot_preferences(world, learner, config=config, ax=ax)
    arrows = by_gid(ax, "preferences")
    at, along = np.asarray(arrows.get_offsets()), np.column_stack([arrows.U, arrows.V])
    dots = xy(ax, "nothing-effective")
    for points in (at, dots):
        assert world.clearance(*points.T, walls_count=True).min() >= config.robot.radius - 1e-6
    for part in np.linspace(-0.49, 0.49, 11):
        assert world.clearance(*(at + part * along).T, walls_count=True).min() > 0
    # And of all others none is left out.
    centres = np.array([grid.centre(situation)[:2] for situation in range(grid.count)])
    room = world.clearance(*centres.T, walls_count=True)
    assert len(at) + len(dots) == np.count_nonzero(room > config.robot.radius - 1e-6)
    assert len(at) + len(dots) < grid.count


def test_the_arrows_stand_on_the_grid_that_was_learned_on(ax):
    config = devlearn.TrialConfig(cell_size=0.5, heading_bins=8)
    trial = devlearn.Trial(devlearn.World(), config, seed=0)
    record = trial.free_learning(500)
    expected = {trial.grid.centre(situation)[:2] for situation in trial.learner.situations()}
    for source in (trial, record):
        ax = plots.plot_preferences(source, trial.learner)
        drawn = [by_gid(ax, "preferences").get_offsets(), *(
            [xy(ax, "nothing-effective")] if "nothing-effective" in gids(ax) else []
        )]  # fmt: skip
        assert {tuple(point) for points in drawn for point in np.asarray(points)} == expected
    refused(lambda: plots.plot_preferences(trial.world, trial.learner), "grid")


def test_a_learner_of_other_situations_is_refused(ax):
    learner = devlearn.Learner(seed=0)
    learner.update(10**12, 0, 1.0)
    with pytest.raises(InvalidValue, match="situation"):
        plots.plot_preferences(devlearn.World(), learner, config=devlearn.TrialConfig(), ax=ax)


def test_a_learner_without_experience_is_drawn_as_an_empty_field(ax):
    plots.plot_preferences(devlearn.Trial(devlearn.World(), seed=0), ax=ax)
    assert len(by_gid(ax, "preferences").get_offsets()) == 0
    ax.figure.canvas.draw()


# --- distributions --------------------------------------------------------------------------------


def test_every_finite_value_is_a_point_and_the_others_are_counted(ax):
    plots.plot_distribution(
        {"paper": [3.0, 1.0, 2.0], "step5": [5.0, np.nan, np.inf]}, ax=ax, ylabel="steps", bound=4
    )
    assert xy(ax, "sample-1")[:, 1].tolist() == [1, 2, 3]
    assert xy(ax, "sample-2")[:, 1].tolist() == [5]
    labels = [label.get_text() for label in ax.get_xticklabels()]
    assert labels == ["paper", "step5\n(2 without value)"]
    assert set(by_gid(ax, "bound").get_ydata()) == {4}
    assert ax.get_ylabel() == "steps"


@pytest.mark.parametrize("name", [name for name in plots.__all__ if name.startswith("plot_")])
@pytest.mark.parametrize("odd", ["paper", None, 3, object()])
def test_what_a_plot_cannot_read_is_refused_by_name_and_in_words(name, odd):
    with pytest.raises(WrongType, match=r"^(record|world|values_by_label): got .*; expected a "):
        getattr(plots, name)(odd)


def test_a_truth_value_is_no_round(paths):
    with pytest.raises(WrongType, match="round entry: got True; expected a whole number"):
        plots.plot_trajectory(paths, entry=True)


# --- curves, intervals and cells ------------------------------------------------------------------


def line(ax, gid):
    [found] = [one for one in ax.get_lines() if one.get_gid() == gid]
    return found


def test_a_curve_is_drawn_with_its_band():
    band = plots.Band([1, 10, 100], [8, 4, 2], [7, 3, 1.5], [9, 5, 4])
    ax = plots.plot_bands({"a": band}, xlabel="steps")
    np.testing.assert_allclose(line(ax, "curve-a").get_xydata(), [[1, 8], [10, 4], [100, 2]])
    [drawn] = [one for one in ax.collections if one.get_gid() == "band-a"]
    corners = {tuple(corner) for corner in drawn.get_paths()[0].vertices}
    assert {(1, 7), (1, 9), (10, 3), (10, 5), (100, 1.5), (100, 4)} <= corners
    assert ax.get_xscale() == ax.get_yscale() == "log" and ax.get_xlabel() == "steps"


@pytest.mark.filterwarnings("error")
def test_what_is_infinite_leaves_the_axes_and_does_not_stretch_them():
    inf = math.inf
    bands = {"a": plots.Band([1, 2, 3], [inf, 4, 2], [6, 3, 2], [inf, inf, 2]),
             "b": plots.Band([1, 2, 3], [inf] * 3, [inf] * 3, [inf] * 3)}  # fmt: skip
    ax = plots.plot_bands(bands)
    _, top = ax.get_ylim()
    assert 4 < top < 10
    assert line(ax, "curve-a").get_ydata()[0] > top
    assert (line(ax, "curve-b").get_ydata() > top).all()
    ax.figure.canvas.draw()


@pytest.mark.filterwarnings("error")
def test_curves_of_nobody_say_so():
    for bands in ({}, {"a": plots.Band([1, 2], [math.inf] * 2, [math.inf] * 2, [math.inf] * 2)}):
        ax = plots.plot_bands(bands)
        ax.figure.canvas.draw()
        assert [text.get_text() for text in ax.texts] == ["none arrives"]


def test_intervals_reach_from_end_to_end_one_below_the_other():
    rows = {"a": (0.5, 0.25, 0.75), "b": (0.2, -math.inf, math.inf)}
    ax = plots.plot_intervals(rows, bound=0.5, limits=(0, 1))
    assert line(ax, "interval-a").get_xydata().tolist() == [[0.25, 0], [0.75, 0]]
    assert line(ax, "interval-b").get_xydata().tolist() == [[0, 1], [1, 1]]
    assert line(ax, "value-b").get_xydata().tolist() == [[0.2, 1]]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["a", "b"]
    low, high = ax.get_ylim()
    assert low > high  # the first is above
    assert line(ax, "bound").get_xdata()[0] == 0.5


def test_many_looks_differ_in_colour_or_dashes():
    looks = [plots.look(i) for i in range(32)]
    assert len({(one.color, one.dash) for one in looks}) == 32
    assert all(a.color != b.color and a.dash != b.dash for a, b in zip(looks, looks[1:8]))


def test_cells_lie_where_they_are_in_the_world():
    world = devlearn.World(4, 2, (10.5, 20.5, 0), (13.5, 21.5), origin=(10, 20))
    values = [[1, 2, math.nan, math.inf], [5, 6, 7, 8]]
    ax = plots.plot_cells(world, values, limits=(1, 8), log=True, label="ratio", title="x")
    cells, never = (
        next(one for one in ax.collections if one.get_gid() == gid) for gid in ("cells", "never")
    )
    corners = cells.get_coordinates()
    assert corners[0, 0].tolist() == [10, 20] and corners[-1, -1].tolist() == [14, 22]
    shown = cells.get_array().reshape(2, 4)
    assert shown.mask.tolist() == [[False, False, True, True], [False] * 4]
    assert shown.compressed().tolist() == [1, 2, 5, 6, 7, 8]
    crossed = never.get_array().reshape(2, 4)
    assert crossed.mask.tolist() == [[True, True, True, False], [True] * 4]
