"""Eq. 6 as Python sees it: numbers and arrays, and its parameters."""

import copy
import json
import pickle

import numpy as np
import pytest
from conftest import refused
from devlearn import StateEvaluation
from hypothesis import given
from hypothesis import strategies as st

evaluations = st.builds(
    StateEvaluation,
    a1=st.floats(-1e6, 1e6),
    a2=st.floats(0, 1e6),
    a3=st.floats(0, 1e6),
    a4=st.floats(-100, 100),
    a5=st.floats(0, 1e6),
)


def test_the_default_is_the_papers():
    evaluation = StateEvaluation()
    names = ("a1", "a2", "a3", "a4", "a5")
    assert [getattr(evaluation, a) for a in names] == [20, 0.3, 0.2, 5, 12]
    assert evaluation == StateEvaluation(20, 0.3, 0.2, 5, 12)


@given(evaluations, st.floats(0, 1e3), st.floats(0, 1e3))
def test_eq_6(evaluation, goal, obstacle):
    e = evaluation
    expected = (e.a1 - e.a2 * goal**2) - e.a3 * np.exp(e.a4 - e.a5 * obstacle)
    scale = abs(e.a1) + e.a2 * goal**2 + e.a3 * np.exp(e.a4 - e.a5 * obstacle)
    assert abs(e(goal, obstacle) - expected) <= 1e-12 * scale + 1e-300


def test_scaled_is_the_papers_shape_for_another_arena_and_another_robot():
    assert StateEvaluation.scaled(5, 0.1) == StateEvaluation()
    desk, paper = StateEvaluation.scaled(arena=1.2, radius=0.037), StateEvaluation()
    share, radii = np.linspace(0, 1.4, 8)[:, None], np.linspace(1, 10, 9)
    np.testing.assert_allclose(
        desk(share * 1.2, radii * 0.037), paper(share * 5, radii * 0.1), 1e-12
    )
    refused(lambda: StateEvaluation.scaled(0, 0.1), "StateEvaluation.scaled.arena")
    refused(lambda: StateEvaluation.scaled(1.2, 0.7), "StateEvaluation.scaled.radius")


@given(evaluations, st.floats(0, 1e6), st.floats(0, allow_infinity=True))
def test_sef_is_always_a_number(evaluation, goal, obstacle):
    assert np.isfinite(evaluation(goal, obstacle))


def test_numbers_give_a_float_and_arrays_an_array_of_the_same_values():
    evaluation = StateEvaluation()
    assert type(evaluation(1, 2)) is float
    assert type(evaluation(np.float32(1), np.int8(2))) is float
    goal, obstacle = np.linspace(0, 7, 50)[:, None], np.linspace(0, 1, 20)
    sef = evaluation(goal, obstacle)
    assert sef.shape == (50, 20)
    for at in np.ndindex(sef.shape):
        assert sef[at] == evaluation(goal[at[0], 0], obstacle[at[1]])
    assert (np.diff(sef, axis=0) < 0).all()
    assert (np.diff(sef, axis=1) > 0).all()
    assert evaluation([1, 2], np.inf).tolist() == [19.7, 18.8]
    assert evaluation(np.empty(0), 1).shape == (0,)


@given(evaluations)
def test_an_evaluation_survives_dict_json_pickle_and_copy(evaluation):
    for again in (
        StateEvaluation.from_dict(evaluation.to_dict()),
        StateEvaluation.from_dict(json.loads(json.dumps(evaluation.to_dict()))),
        pickle.loads(pickle.dumps(evaluation)),
        copy.copy(evaluation),
        copy.deepcopy(evaluation),
        eval(repr(evaluation), {"StateEvaluation": StateEvaluation}),
        evaluation.replace(),
    ):
        assert again == evaluation
        assert hash(again) == hash(evaluation)
    other = evaluation.replace(a1=1 if evaluation.a1 < 0 else -1)
    assert other != evaluation
    assert other.replace(a1=evaluation.a1) == evaluation


def test_equal_evaluations_hash_alike_whatever_the_sign_of_zero():
    assert StateEvaluation(a2=0.0) == StateEvaluation(a2=-0.0)
    assert hash(StateEvaluation(a2=0.0)) == hash(StateEvaluation(a2=-0.0))


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -float("inf"), 1.1e6, -1.1e6])
@pytest.mark.parametrize("name", ["a1", "a2", "a3", "a4", "a5"])
def test_parameters_out_of_range_are_refused_by_name(name, bad):
    refused(lambda: StateEvaluation(**{name: bad}), f"StateEvaluation.{name}")
    refused(lambda: StateEvaluation().replace(**{name: bad}), f"StateEvaluation.{name}")
    refused(lambda: StateEvaluation.from_dict({name: bad}), f"StateEvaluation.{name}")


@pytest.mark.parametrize("bad", [-1e-9, float("nan"), 1e7, -float("inf")])
def test_what_is_no_distance_is_refused_by_name(bad):
    evaluation = StateEvaluation()
    refused(lambda: evaluation(bad, 1), "goal_distance")
    refused(lambda: evaluation([1, bad], 1), "goal_distance")
    if bad != 1e7:
        refused(lambda: evaluation(1, bad), "obstacle_distance")


def test_an_evaluation_cannot_be_changed():
    with pytest.raises(AttributeError):
        StateEvaluation().a1 = 3


def test_arrays_that_do_not_broadcast_are_refused():
    refused(lambda: StateEvaluation()(np.zeros(3), np.zeros(2)), "the arrays' shapes")
