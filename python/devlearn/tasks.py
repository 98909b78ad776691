"""Tasks of the systems that the paper stands on: environments that are no world of the robot's.

An agent lives through episodes of a task by run, or step by step.
"""

from ._core import (
    Attention,
    AttentionConfig,
    Balance,
    BalanceConfig,
    Foraging,
    ForagingConfig,
    Playroom,
    PlayroomConfig,
    Task,
    TwoWheeledDef,
)
from ._core import run_episodes as run

__all__ = [
    "Attention",
    "AttentionConfig",
    "Balance",
    "BalanceConfig",
    "Foraging",
    "ForagingConfig",
    "Playroom",
    "PlayroomConfig",
    "Task",
    "TwoWheeledDef",
    "run",
]
