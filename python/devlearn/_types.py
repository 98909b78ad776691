from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ._core import Event, Kind, heading_of_yaw, yaw_of_heading


class Pose(NamedTuple):
    """The robot's place and heading: x, y [m], heading [degrees, counter-clockwise from x]."""

    x: float
    y: float
    heading: float

    @classmethod
    def from_radians(cls, x: float, y: float, yaw: float) -> Pose:
        """The pose whose heading is yaw [radians], brought into [0, 360) degrees.

        Raises InvalidValue unless yaw is finite.
        """
        return cls(x, y, heading_of_yaw(yaw))

    @property
    def yaw(self) -> float:
        """The heading in (-pi, pi] radians."""
        return yaw_of_heading(self.heading)


class Senses(NamedTuple):
    """What is sensed at a pose, for an evaluation and situations of one's own.

    The sonars' echoes there are told by a Robot of the same world: ``robot.sonar(senses.pose)``.
    """

    pose: Pose
    """[m, m, degrees]"""
    goal_distance: float
    """d_g [m]"""
    clearance: float
    """d_o [m]"""


class Choice(NamedTuple):
    """A motion to execute: its index in M, and why."""

    motion: int
    """Index in M."""
    kind: Kind = Kind.UNSTATED
    """Why it was chosen."""


class Development(NamedTuple):
    """What one outcome changed in the learner."""

    situation: int
    """The situation learned in."""
    motion: int
    """The motion learned about."""
    event: Event
    """What happened to it."""
    reduced: int
    """How many motions reduction development (Eq. 14-17) removed."""
    explored_count: int = 0
    """NUM_RM, after it."""
    effective_count: int = 0
    """NUM_M, after it."""
    value: float | None = None
    """Cost to go from there on, as the agent expects it; None: it does not say."""


class LearnerMemory(NamedTuple):
    """All that a learner remembers, as arrays: S situations, N motions, E effective mappings.

    ``motions[i]`` holds each motion once: M_i (the first ``effective_count[i]``), then the
    ineffective ones (the next ``ineffective_count[i]``), then RM_i, ascending. ``orientation`` and
    ``times_learned`` go through the effective motions, situation by situation.
    """

    situation: npt.NDArray[np.int64]
    """Ids, in the order they were first experienced: (S,)."""
    effective_count: npt.NDArray[np.uint16]
    """n_i: (S,)."""
    ineffective_count: npt.NDArray[np.uint16]
    """How many of M-bar_i: (S,)."""
    motions: npt.NDArray[np.uint16]
    """Motion indices: (S, N)."""
    orientation: npt.NDArray[np.float64]
    """o_ij: (E,); each situation's sum is 1."""
    times_learned: npt.NDArray[np.uint32]
    """n_ij, at least 1: (E,)."""
