"""The situation grid as Python sees it: numbers and arrays, and the same rule for both."""

import devlearn
import numpy as np
import pytest
from conftest import refused
from devlearn import Pose, SituationGrid
from hypothesis import given
from hypothesis import strategies as st

grids = st.builds(
    SituationGrid,
    st.floats(0.5, 1000),
    st.floats(0.5, 1000),
    st.integers(1, 1000),
    st.integers(1, 1000),
    st.integers(1, 3600),
    st.tuples(st.floats(-1e5, 1e5), st.floats(-1e5, 1e5)),
)


def test_the_default_grid_is_the_papers():
    grid = SituationGrid()
    assert (grid.width, grid.height, grid.columns, grid.rows, grid.headings) == (5, 5, 20, 20, 12)
    assert grid.count == 4800
    assert repr(grid) == (
        "SituationGrid(width=5, height=5, columns=20, rows=20, headings=12, origin=(0, 0))"
    )


@given(st.integers(0, 2**32 - 1))
def test_situations_are_numbered_by_row_column_and_heading(seed):
    random = np.random.default_rng(seed)
    x, y = random.uniform(0, 5, (2, 300))
    heading = random.uniform(-720, 720, 300)
    bins = np.floor(np.mod(heading + 15, 360) / 30)
    expected = (np.floor(y / 0.25) * 20 + np.floor(x / 0.25)) * 12 + bins
    situations = SituationGrid().situation(x, y, heading)
    assert situations.dtype == np.int64
    assert (situations == expected).all()


@given(grids, st.data())
def test_the_centre_of_a_situation_lies_in_it(grid, data):
    situation = data.draw(st.integers(0, grid.count - 1))
    centre = grid.centre(situation)
    assert isinstance(centre, Pose)
    assert grid.situation(*centre) == situation
    assert grid.situation(centre.x, centre.y, centre.heading - 360) == situation


def test_numbers_give_an_int_and_arrays_an_array():
    grid = SituationGrid()
    assert type(grid.situation(1, 2, 30)) is int
    assert type(grid.situation(np.float32(1), np.int8(2), np.float64(30))) is int
    x, y = np.meshgrid(np.linspace(0, 5, 4), np.linspace(0, 5, 3))
    situations = grid.situation(x, y, 0)
    assert situations.shape == (3, 4)
    for at in np.ndindex(situations.shape):
        assert situations[at] == grid.situation(x[at], y[at], 0)
    assert grid.situation([1, 2], [1, 2], [0, 90]).shape == (2,)
    assert grid.situation(np.empty(0), 1, 0).shape == (0,)
    assert grid.situation(x[:, ::2], y[:, ::2], 0).tolist() == situations[:, ::2].tolist()


def test_borders_belong_to_the_cell_above_and_the_far_ones_to_the_last():
    grid = SituationGrid()
    assert grid.situation(0.25, 0, 0) == 12
    assert grid.situation(np.nextafter(0.25, 0), 0, 0) == 0
    assert grid.situation(5, 5, 0) == 4800 - 12
    assert grid.situation(0, 0, 15) == 1
    assert grid.situation(0, 0, -15) == 0
    assert grid.situation(0, 0, np.nextafter(345, 0)) == 11


@pytest.mark.parametrize(
    "bad", [float("nan"), float("inf"), -float("inf"), -1e-9, 5.0000001, 1e308]
)
def test_a_place_outside_has_no_situation(bad):
    grid = SituationGrid()
    refused(lambda: grid.situation(bad, 1, 0), "x")
    refused(lambda: grid.situation(1, bad, 0), "y")
    refused(lambda: grid.situation([1, bad], 1, 0), "x")
    if not np.isfinite(bad):
        refused(lambda: grid.situation(1, 1, bad), "heading")


@pytest.mark.parametrize("bad", [-1, 4800, 2**63 - 1, 2**63, -(2**70), 10**30])
def test_a_situation_that_is_not_there_has_no_centre(bad):
    refused(lambda: SituationGrid().centre(bad), "situation", str(bad))


@pytest.mark.parametrize(
    ("name", "bad"),
    [
        *[
            (side, v)
            for side in ("width", "height")
            for v in (0, -1, 10001, float("nan"), float("inf"))
        ],
        *[(n, v) for n in ("columns", "rows") for v in (0, -1, 100_001, 2**31, 2**64)],
        *[("headings", v) for v in (0, -1, 3601, 2**31, 2**64)],
    ],
)
def test_a_grid_out_of_range_is_refused_by_name(name, bad):
    refused(lambda: SituationGrid(**{name: bad}), f"SituationGrid.{name}")


def test_the_trials_grid_agrees_with_one_made_by_hand():
    trial = devlearn.Trial(devlearn.World.load("paper"))
    pose = trial.pose
    assert trial.grid.situation(pose) == SituationGrid().situation(*pose)


def test_arrays_that_do_not_broadcast_are_refused():
    refused(lambda: SituationGrid().situation(np.zeros(3), np.zeros(2), 0), "the arrays' shapes")


@given(st.floats(-1e6, 1e6))
def test_a_heading_in_radians_is_one_in_degrees_and_back(yaw):
    pose = Pose.from_radians(1, 2, yaw)
    assert pose[:2] == (1, 2)
    assert 0 <= pose.heading < 360
    assert -np.pi < pose.yaw <= np.pi
    assert abs(np.exp(1j * pose.yaw) - np.exp(1j * yaw)) <= 1e-9
    for given_yaw in (np.inf, np.nan):
        refused(lambda given_yaw=given_yaw: Pose.from_radians(0, 0, given_yaw), "yaw")


# --- what lies outside ----------------------------------------------------------------------------


def test_what_lies_outside_is_refused_or_in_the_nearest_cell():
    refusing = SituationGrid(origin=(-1, -1))
    clamping = SituationGrid(origin=(-1, -1), outside="clamp")
    assert (refusing.outside, clamping.outside) == ("refuse", "clamp")
    assert repr(clamping).endswith("origin=(-1, -1), outside='clamp')")
    assert refusing != clamping
    with pytest.raises(devlearn.InvalidValue, match="x: got 9"):
        refusing.situation(9, 0, 0)
    assert clamping.situation(9, 0, 0) == clamping.situation(4, 0, 0)
    xs = np.array([-5.0, 0.0, 99.0])
    assert (clamping.situation(xs, 0, 90) == refusing.situation(np.clip(xs, -1, 4), 0, 90)).all()
    with pytest.raises(devlearn.InvalidValue, match="x: got nan"):
        clamping.situation(float("nan"), 0, 0)
    with pytest.raises(devlearn.InvalidValue, match="SituationGrid.outside: got 'wrap'"):
        SituationGrid(outside="wrap")


def test_a_robot_that_has_radians_says_so_by_name():
    grid = SituationGrid()
    assert grid.situation(*devlearn.Pose.from_radians(1, 2, np.pi / 2)) == grid.situation(1, 2, 90)
