"""Gymnasium: learners of devlearn on environments of others (``LearnerOn``)."""

from ..errors import MissingExtra

try:
    import gymnasium as gymnasium
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.envs", "gymnasium", "envs") from error

from .learner_on import LearnerOn
from .situations import DiscreteSituations, TileSituations

__all__ = ["DiscreteSituations", "LearnerOn", "TileSituations"]
