"""What is read off records, worlds and learners, for plots and for whoever likes: numpy alone."""

from .counts import counts_before
from .episodes import (
    Episode,
    find_abandonment,
    find_entry_and_window,
    find_episodes,
    find_window,
)
from .fields import PreferenceField, SefField, preference_field, sef_field
from .replay import Replay, first_learner, learner_chose, parts
from .rooms import Gap, Rooms
from .ways import WayField

__all__ = [
    "Episode",
    "Gap",
    "PreferenceField",
    "Replay",
    "Rooms",
    "SefField",
    "WayField",
    "counts_before",
    "find_abandonment",
    "find_entry_and_window",
    "find_episodes",
    "find_window",
    "first_learner",
    "learner_chose",
    "parts",
    "preference_field",
    "sef_field",
]
