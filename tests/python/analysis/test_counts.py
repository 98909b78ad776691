"""The counts of mappings, step by step."""

import pytest
from devlearn import Event
from devlearn.analysis.counts import counts_before
from handmade import ABANDONMENT, EFFECTIVE, INEFFECTIVE, NO_CHANGE, RETRY, X, hand_made


def test_counts_of_a_later_record_begin_with_what_was_known(history):
    free, paths = history.part(slice(0, 2)), history.part(slice(2, None))
    explored, effective = counts_before(paths, 0)
    assert (explored[0], effective[0]) == (free.explored_count[-1], free.effective_count[-1])
    explored, effective = counts_before(paths, 1)
    last = paths.steps_of(0).stop - 1
    assert explored[0] == paths.explored_count[last]
    assert effective[0] == paths.effective_count[last]
    assert len(explored) == paths.rounds["steps"][1] + 1


@pytest.mark.parametrize(
    ("first", "known"),
    [
        (EFFECTIVE, (12, 7)),
        (INEFFECTIVE, (12, 7)),
        (NO_CHANGE, (12, 7)),
        ((X, Event.ORIENTATION, 3), (12, 7)),
        (ABANDONMENT, (12, 7)),
        (RETRY, (12, 7)),
    ],
)
def test_counts_before_a_records_first_step_follow_from_what_it_did(first, known):
    record = hand_made([first, NO_CHANGE], before=known)
    explored, effective = counts_before(record)
    assert (explored[0], effective[0]) == known
