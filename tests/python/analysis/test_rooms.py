"""Rooms of a world for a body, and the gaps between them."""

import pytest
from devlearn import Circle, Rectangle, World
from devlearn.analysis import Rooms


def parted(*gaps):
    """4 m x 3 m with a wall at 2 m that has gaps (low, high) in it."""
    walls, low = [], 0.0
    for begin, end in (*gaps, (3.0, 3.0)):
        if begin > low:
            walls.append(Rectangle((2, (low + begin) / 2), (0.2, begin - low)))
        low = end
    return World(4, 3, (1, 1, 0), (3, 1), walls)


def test_an_arena_without_obstacles_is_one_room_as_wide_as_the_body_leaves():
    rooms = Rooms(World(4, 3, (1, 1, 0), (3, 1)), 0.2)
    assert rooms.count == 1
    assert rooms.gaps() == []
    assert rooms.area == pytest.approx(3.6 * 2.6, abs=4 * rooms.cell * 6.2)
    assert rooms.area_of_start == rooms.area
    assert rooms.nearest_to_target()[0] <= rooms.cell


def test_a_wall_without_a_gap_makes_two_rooms_and_tells_no_gap():
    rooms = Rooms(parted(), 0.1)
    assert rooms.count == 2
    assert rooms.area_of_start == pytest.approx(rooms.area / 2, rel=0.02)
    assert rooms.gaps() == []
    distance, place = rooms.nearest_to_target()
    assert distance == pytest.approx(1.2, abs=rooms.cell)
    assert place == pytest.approx((1.8, 1), abs=rooms.cell)


@pytest.mark.parametrize("width", [0.08, 0.12, 0.19])
def test_a_gap_too_narrow_for_the_body_is_told_with_its_width_and_place(width):
    rooms = Rooms(parted((1.5 - width / 2, 1.5 + width / 2), (2.9, 2.95)), 0.1)
    assert rooms.count == 2
    (gap,) = rooms.gaps()  # the widest of the two
    assert gap.width == pytest.approx(width, abs=2 * rooms.cell)
    assert gap.place == pytest.approx((2, 1.5), abs=0.2)


def test_a_gap_that_the_body_fits_through_is_none():
    assert Rooms(parted((1.3, 1.6)), 0.1).count == 1


def test_every_room_is_parted_by_one_gap_from_the_others_the_widest_first():
    cells = [Rectangle((x, 1.5), (0.2, 2.9 - 0.02 * i), 0) for i, x in enumerate((1.0, 2.0, 3.0))]
    rooms = Rooms(World(4, 3, (0.5, 1, 0), (3.5, 1), cells), 0.1)
    assert rooms.count == 4
    widths = [gap.width for gap in rooms.gaps()]
    assert len(widths) == 3
    assert widths == sorted(widths, reverse=True)


def test_a_start_without_room_gets_nowhere():
    rooms = Rooms(World(4, 3, (0.05, 1, 0), (3, 1), [Circle((2, 2), 0.1)]), 0.2)
    assert rooms.nearest_to_target() is None
    assert rooms.area_of_start == 0
