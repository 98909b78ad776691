"""What the claims are measured by, on records made by hand: every value was worked out on paper."""

import devlearn
import numpy as np
import pytest
from devlearn import Event, Kind
from devlearn.paper import measures
from devlearn.record import STEP_COLUMNS, provenance_of
from hypothesis import given
from hypothesis import strategies as st

E, X, H = Kind.EXPLORE, Kind.EXPLOIT, Kind.EXHAUSTED


def made(rounds, *, first=3, arrived=None, **columns):
    """A record of rounds, each a list of motions; whether each arrived; and columns of all steps.

    Every round arrives, with its last step, unless said otherwise.
    """
    motion = np.array([m for motions in rounds for m in motions], dtype=np.int32)
    arrived = [True] * len(rounds) if arrived is None else arrived
    entries = [(first + i, len(m), a) for i, (m, a) in enumerate(zip(rounds, arrived))]
    all_columns = {name: np.zeros(len(motion), dtype) for name, dtype in STEP_COLUMNS.items()}
    all_columns |= {
        "motion": motion,
        "round": np.repeat([n for n, _, _ in entries], list(map(len, rounds))).astype(np.int32),
        "rounds": np.array(entries, dtype=[("round", "i4"), ("steps", "i8"), ("arrived", "?")]),
    }
    all_columns |= {name: np.zeros(len(motion) + len(rounds)) for name in ("x", "y", "heading")}
    for name, values in columns.items():
        assert len(values) == len(motion), name
        all_columns[name] = np.array(values, dtype=STEP_COLUMNS[name])
    provenance = provenance_of(devlearn.World.load("empty"), devlearn.TrialConfig(), 0, None)
    return devlearn.Record(all_columns, provenance)


# --- arriving and staying -------------------------------------------------------------------------


def test_the_first_arrival_is_counted_from_one_within_its_round():
    record = made([[0] * 4, [0] * 3, [0] * 2])
    record.arrived[:] = [0, 0, 1, 1, 1, 0, 1, 0, 0]
    assert measures.first_arrival(record) == 3
    assert measures.first_arrival(record, 1) == 1
    assert measures.first_arrival(record, 2) is None
    assert measures.first_arrival(record, -2) == 1


def test_a_round_without_steps_never_arrives():
    assert measures.first_arrival(made([[]])) is None


def test_the_share_near_the_target_is_of_the_last_steps_with_the_bound_counted_in():
    record = made([[0] * 5], goal_distance=[0.1, 0.1, 0.6, 0.6000001, 0.2])
    assert measures.share_near_target(record, 3) == 2 / 3
    assert measures.share_near_target(record, 5) == 4 / 5
    assert measures.share_near_target(record, 5, distance=0.15) == 2 / 5


def test_cells_are_counted_once_whatever_the_heading():
    # Twelve headings a cell: 0 to 11 are the first cell, 12 to 23 the next.
    record = made([[0] * 6], situation=[0, 11, 12, 23, 24, 5])
    assert measures.cells_visited(record) == 3


def test_change_is_a_share_of_the_final_value_in_either_direction():
    counts = np.array([2, 4, 8, 10])
    assert measures.change_after(counts, 2) == 0.6
    assert measures.change_after(counts, 4) == 0
    assert measures.change_after(counts[::-1].copy(), 1) == 4
    assert measures.change_after(np.array([3, 0]), 1) == 0  # no share of nothing


# --- settling -------------------------------------------------------------------------------------


def test_a_run_is_settled_from_the_first_of_the_equal_rounds_at_its_end():
    record = made([[1, 2], [0, 1], [1, 2], [1, 2], [1, 2]])
    assert measures.settled_round(record, least=3) == 5  # round 3 is equal, but 4 is not
    assert measures.settled_round(record, least=1) == 5


def test_a_run_has_not_settled_one_round_short_of_the_least():
    record = made([[0, 1], [1, 2], [1, 2], [1, 2]])
    assert measures.settled_round(record, least=3) == 4
    assert measures.settled_round(record, least=4) is None


def test_by_default_forty_rounds_make_a_habit():
    assert measures.settled_round(made([[1]] * 39)) is None
    assert measures.settled_round(made([[1]] * 40)) == 3
    assert measures.settled_round(made([[0]] + [[1]] * 40)) == 4
    assert measures.settled_round(made([[1]] * 40 + [[0]])) is None


def test_rounds_of_different_length_are_different_though_one_begins_as_the_other():
    assert measures.settled_round(made([[1, 1], [1, 1, 1], [1, 1]]), least=2) is None


def test_a_run_whose_last_round_failed_has_not_settled():
    same = [[1, 2]] * 4
    assert measures.settled_round(made(same, arrived=[1, 1, 1, 0]), least=2) is None
    assert measures.settled_round(made([]), least=0) is None


@given(st.lists(st.lists(st.integers(0, 1), min_size=1, max_size=2), min_size=1, max_size=12))
def test_settled_means_what_the_method_says_it_means(rounds):
    found = measures.settled_round(made(rounds), least=3)
    starts = [i for i in range(len(rounds)) if all(r == rounds[-1] for r in rounds[i:])]
    expected = 3 + starts[0] if len(rounds) - starts[0] >= 3 else None
    assert found == expected


def test_habits_are_equal_for_equal_motions_and_none_before_a_run_settles():
    a, b = made([[0]] + [[1, 2]] * 40), made([[1, 2]] * 50)
    assert measures.habit(a) == measures.habit(b)
    assert measures.habit(a) != measures.habit(made([[2, 1]] * 40))
    assert measures.habit(made([[1, 2]] * 39)) is None
    assert len(measures.habit(a)) == 12


# --- exploring ------------------------------------------------------------------------------------


def test_late_increases_are_those_of_the_second_half_longer_than_the_round_before():
    # Steps 3 1 | 2 2 3 1: the third and the fifth are longer than the round before them.
    rounds = [[0] * n for n in (3, 1, 2, 2, 3, 1)]
    record = made(
        rounds, kind=[E, E, E] + [E] + [X, E] + [X, X] + [X, H, X] + [E]
    )  # half is 3: rounds 4 to 6 count, with 2, 3 and 1 steps
    assert measures.late_increases(record) == {"longer": [0, 1], "others": [1, 2]}
    record.kind[9] = E
    assert measures.late_increases(record) == {"longer": [1, 1], "others": [1, 2]}


def test_the_first_late_round_is_compared_with_the_last_early_one():
    record = made([[0], [0, 0]], kind=[X, X, E])
    assert measures.late_increases(record) == {"longer": [1, 1], "others": [0, 0]}


@pytest.mark.parametrize("count", [0, 1])
def test_without_two_rounds_nothing_increases(count):
    record = made([[0]] * count, kind=[E] * count)
    assert measures.late_increases(record) == {"longer": [0, 0], "others": [0, 0]}


def test_a_mapping_is_a_situation_and_a_motion():
    record = made([[0, 4, 0]], situation=[0, 0, 1])
    assert measures.mappings([record]).tolist() == [0, 4, 5]
    assert measures.mappings([record, record]).tolist() == [0, 4, 5, 0, 4, 5]


def test_repeated_explorations_are_those_beyond_the_first_over_all_records():
    first = made([[1, 1, 2]], situation=[7, 7, 7], kind=[E, X, E])
    assert measures.repeated_explorations([first]) == 0
    second = made([[1, 2, 1]], situation=[7, 7, 8], kind=[E, H, E])
    assert measures.repeated_explorations([first, second]) == 1
    assert measures.repeated_explorations([first, second, first]) == 3


def test_an_smf_of_zero_is_effective():
    record = made([[0, 0]], situation=[5, 5], smf_used=[0, 0], kind=[X, X], event=[3, 3])
    assert measures.exploited_ineffective([record]) == 0


# --- shares ---------------------------------------------------------------------------------------


def test_a_share_of_none_is_zero():
    assert measures.share(np.array([], dtype=bool)) == 0
    assert measures.share(np.array([True, False, False, True, False])) == 0.4


def test_only_exploits_count_among_the_exploited():
    record = made([[0] * 5], kind=[E, X, X, H, X], smf_used=[-1, -1, 1, -1, 0])
    assert measures.exploited_ineffective([record]) == 1 / 3
    assert measures.exploited_ineffective([record, record]) == 1 / 3
    assert measures.exploited_ineffective([made([[0]], kind=[E], smf_used=[-1])]) == 0


def test_a_collision_counts_by_what_is_learned_from_it():
    # Raw SMF says the robot came nearer; what was used says that it hit something.
    record = made([[0]], kind=[X], event=[Event.ABANDONMENT], smf=[5], smf_used=[-1], collided=[1])
    assert measures.exploited_ineffective([record]) == 1
