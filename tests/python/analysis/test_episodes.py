"""Episodes are found where the counts show them."""

import pytest
from devlearn import InvalidValue
from devlearn.analysis.counts import counts_before
from devlearn.analysis.episodes import (
    find_abandonment,
    find_entry_and_window,
    find_episodes,
    find_window,
)
from handmade import (
    ABANDONMENT,
    ALL_FOUR,
    EFFECTIVE,
    INEFFECTIVE,
    NO_CHANGE,
    REDUCTION,
    RETRY,
    hand_made,
)


def test_the_papers_four_kinds_are_found_where_they_are():
    assert find_episodes(hand_made(ALL_FOUR)) == {
        "a": (3, 4),
        "b": (7, 12),
        "c": (14, 18),
        "d": (18, 19),
    }


def test_an_episode_is_what_the_counts_show():
    record = hand_made(ALL_FOUR)
    explored, effective = counts_before(record)
    change = {
        name: (
            int(explored[episode.last - 1] - explored[episode.first - 1]),
            int(effective[episode.last - 1] - effective[episode.first - 1]),
        )
        for name, episode in find_episodes(record).items()
    }
    assert change == {"a": (1, 1), "b": (5, 0), "c": (0, 0), "d": (0, -1)}


def test_an_abandonment_is_no_reduction():
    record = hand_made([EFFECTIVE, ABANDONMENT, NO_CHANGE])
    assert find_episodes(record)["d"] is None
    assert find_abandonment(record) == (2, 3)
    assert find_abandonment(hand_made([EFFECTIVE, REDUCTION, NO_CHANGE])) is None


def test_a_retry_is_neither_exploration_nor_exploitation():
    found = find_episodes(hand_made([RETRY] * 10))
    assert set(found.values()) == {None}


def test_one_step_is_no_run():
    record = hand_made([INEFFECTIVE, NO_CHANGE, INEFFECTIVE, NO_CHANGE, EFFECTIVE, RETRY])
    assert find_episodes(record) == {"a": (5, 6), "b": None, "c": None, "d": None}


def test_of_equal_runs_the_first_is_taken():
    record = hand_made([INEFFECTIVE] * 3 + [NO_CHANGE] + [INEFFECTIVE] * 3 + [RETRY])
    assert find_episodes(record)["b"] == (1, 4)


def test_an_episode_ends_within_its_window():
    record = hand_made([NO_CHANGE] * 29 + [EFFECTIVE] + [NO_CHANGE] * 10)
    # The outcome of step 30 shows at step 31.
    assert find_episodes(record)["a"] is None
    assert find_episodes(record, window=(0, 31))["a"] == (30, 31)
    assert find_episodes(record)["c"] == (1, 30)
    assert find_episodes(record, window=(35, 99))["c"] == (36, 40)


def test_episodes_are_those_of_the_round_asked_for():
    steps = [INEFFECTIVE] * 4 + [NO_CHANGE] * 2 + [REDUCTION] + [NO_CHANGE]
    record = hand_made(steps, before=(9, 9), rounds=[(1, 4, True), (2, 4, True)])
    assert find_episodes(record, entry=0)["d"] is None
    assert find_episodes(record, entry=1) == {"a": None, "b": None, "c": (1, 3), "d": (3, 4)}


def test_the_first_window_is_found_if_it_has_all_kinds():
    assert find_window(hand_made(ALL_FOUR)) == (0, 30)


def test_a_window_shows_the_kind_it_was_asked_for():
    record = hand_made([INEFFECTIVE] * 200 + [EFFECTIVE] + [INEFFECTIVE] * 200)
    assert find_episodes(record)["a"] is None
    start, stop = find_window(record, "a")
    assert stop - start == 30
    assert find_episodes(record, window=(start, stop))["a"] == (201, 202)
    assert abs((start + stop) / 2 - 201) <= 1  # in the middle
    assert find_window(record, "d") is None


def test_windows_found_have_every_kind_asked_for(history):
    for kinds in ("a", "b", "c", "ab", "bc", "abc"):
        window = find_window(history, kinds)
        found = find_episodes(history, window=window)
        assert all(found[kind] for kind in kinds), kinds


def test_the_round_that_has_the_kind_is_found():
    steps = [NO_CHANGE] * 6 + [REDUCTION] + [NO_CHANGE] * 3
    record = hand_made(steps, before=(9, 9), rounds=[(3, 5, True), (4, 5, True)])
    entry, window = find_entry_and_window(record, "d")
    assert (entry, window) == (1, (0, 5))
    assert find_entry_and_window(record, "a") is None


@pytest.mark.parametrize("window", [(-1, 30), (5, 5), (30, 0)])
def test_a_window_that_is_none_is_refused(window):
    record = hand_made([NO_CHANGE] * 40)
    for find in (find_episodes, find_abandonment):
        with pytest.raises(InvalidValue, match="window"):
            find(record, window=window)
    with pytest.raises(InvalidValue, match="kinds"):
        find_window(record, "e")
    with pytest.raises(InvalidValue, match="length"):
        find_window(record, "a", length=2)
