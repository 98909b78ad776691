"""devlearn and Gymnasium, both ways.

Outward: ``devlearn/Navigate-v0``, the paper's robot in any world, for agents of other libraries::

    import gymnasium
    import devlearn.envs

    env = gymnasium.make("devlearn/Navigate-v0", world="office")
    envs = gymnasium.make_vec(
        "devlearn/Navigate-v0", num_envs=64, vectorization_mode="vector_entry_point"
    )

and the tasks of ``devlearn.tasks``, such as ``devlearn/Balance-v0`` (``TaskEnv``).

Inward: learners of devlearn on environments of others (``LearnerOn``). Needs Gymnasium, which the
extra ``envs`` brings; pictures need the extra ``plots``, too.
"""

from ..errors import MissingExtra

try:
    import gymnasium as gymnasium
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.envs", "gymnasium", "envs") from error

from .learner_on import LearnerOn
from .navigate import Navigate
from .navigate_vector import NavigateVector
from .situations import DiscreteSituations, TileSituations
from .task_env import TaskEnv

__all__ = [
    "DiscreteSituations",
    "LearnerOn",
    "Navigate",
    "NavigateVector",
    "TaskEnv",
    "TileSituations",
]

gymnasium.register(
    "devlearn/Navigate-v0",
    entry_point="devlearn.envs.navigate:Navigate",
    vector_entry_point="devlearn.envs.navigate_vector:NavigateVector",
)
for _task in ("Attention", "Balance", "Foraging", "Playroom"):
    gymnasium.register(
        f"devlearn/{_task}-v0",
        entry_point="devlearn.envs.task_env:TaskEnv",
        kwargs={"task": _task},
    )
