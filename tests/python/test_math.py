"""Headings and the exponential as Python sees them: exact where they can be, equal everywhere."""

import math

import devlearn
import pytest
from conftest import refused
from hypothesis import given
from hypothesis import strategies as st

headings = st.floats(-1e9, 1e9)


@given(headings)
def test_a_direction_is_the_unit_vector_of_its_heading(heading):
    x, y = devlearn.direction(heading)
    angle = math.radians(math.fmod(heading, 360.0))
    assert x == pytest.approx(math.cos(angle), abs=1e-14)
    assert y == pytest.approx(math.sin(angle), abs=1e-14)


def test_directions_along_the_axes_are_exact():
    along = [devlearn.direction(heading) for heading in (0.0, 90.0, 180.0, -90.0)]
    assert along == [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]


@given(headings)
def test_a_wrapped_heading_lies_in_the_circle_and_is_exact(heading):
    wrapped = devlearn.wrapped_heading(heading)
    assert 0.0 <= wrapped < 360.0
    assert wrapped in (math.fmod(heading, 360.0), math.fmod(heading, 360.0) + 360.0, 0.0)


@given(st.floats(-745.0, 709.0))
def test_the_exponential_is_within_an_ulp(x):
    assert abs(devlearn.exponential(x) - math.exp(x)) <= 2 * math.ulp(math.exp(x))


@pytest.mark.parametrize("heading", [math.nan, math.inf, -math.inf])
def test_a_heading_is_finite(heading):
    refused(lambda: devlearn.direction(heading), "heading")
    refused(lambda: devlearn.wrapped_heading(heading), "heading")
