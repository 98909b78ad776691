"""Agents of a trial that the paper's learner is measured against: textbook learners of values,
operant conditioning as a one-to-one mapping, and whoever knows the map and takes the shortest way.

from devlearn import Trial, World, agents

agent = agents.QLearning(agents.QLearning.Config(alpha=0.5, first_value="estimate"), seed=1)
paths = Trial(World.load("empty"), agent=agent).path_learning(rounds=50)
"""

from ._core import (
    Appraisal,
    AppraisalConfig,
    AppraisalExplanation,
    DynaQ,
    DynaQConfig,
    ExpectedSarsa,
    ExpectedSarsaConfig,
    Iac,
    IacConfig,
    IacExplanation,
    IacRegion,
    LrtaStar,
    LrtaStarConfig,
    OperantConditioning,
    OperantConditioningConfig,
    PrioritizedSweeping,
    PrioritizedSweepingConfig,
    QLearning,
    QLearningConfig,
    RMax,
    RMaxConfig,
    SalientEvents,
    SalientEventsConfig,
    SarsaLambda,
    SarsaLambdaConfig,
    ShortestPathAgent,
)

__all__ = [
    "Appraisal",
    "AppraisalConfig",
    "AppraisalExplanation",
    "DynaQ",
    "DynaQConfig",
    "ExpectedSarsa",
    "ExpectedSarsaConfig",
    "Iac",
    "IacConfig",
    "IacExplanation",
    "IacRegion",
    "LrtaStar",
    "LrtaStarConfig",
    "OperantConditioning",
    "OperantConditioningConfig",
    "PrioritizedSweeping",
    "PrioritizedSweepingConfig",
    "QLearning",
    "QLearningConfig",
    "RMax",
    "RMaxConfig",
    "SalientEvents",
    "SalientEventsConfig",
    "SarsaLambda",
    "SarsaLambdaConfig",
    "ShortestPathAgent",
]
