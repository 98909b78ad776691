"""Sensorimotor developmental learning from orientation and curiosity (Zhang et al., 2020).

A mobile robot that learns by itself to find its way. Lengths are in metres, times in seconds,
headings and angles in degrees, counter-clockwise positive.

    import devlearn

    trial = devlearn.Trial(devlearn.World.load("paper"), seed=1)
    first = trial.free_learning(10_000)
    paths = trial.path_learning(rounds=400)
    print(paths.rounds["steps"])
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from . import errors as errors

if TYPE_CHECKING:
    from ._core import (
        AdaptiveConfig,
        AdaptiveExplanation,
        AdaptiveLearner,
        AdaptiveMemory,
        Batch,
        BatchConfig,
        ChoiceTrace,
        Circle,
        ConditioningExplanation,
        Event,
        Explanation,
        Kind,
        Learner,
        LearnerConfig,
        MemoryUse,
        Mover,
        MoverPath,
        MoverWalk,
        NoiseDef,
        Observation,
        OptionView,
        Outcome,
        Polygon,
        Polyline,
        Random,
        RandomAgent,
        Recollection,
        Rectangle,
        Robot,
        RobotDef,
        SalientEventsExplanation,
        ShortestPath,
        SituationGrid,
        SituationMemory,
        StateEvaluation,
        Step,
        Tally,
        Trial,
        TrialConfig,
        World,
        __version__,
        direction,
        exponential,
        may_reach_target,
        shortest_path,
        wrapped_heading,
    )
    from ._types import Choice, Development, LearnerMemory, Pose, Senses
    from ._worlds import worlds
    from .errors import FileError, InvalidValue, WrongType
    from .experiments.store import Results
    from .experiments.sweep import sweep
    from .record import Record
    from .viewer.film import animate
    from .viewer.live import view

__all__ = [
    "AdaptiveConfig",
    "AdaptiveExplanation",
    "AdaptiveLearner",
    "AdaptiveMemory",
    "Batch",
    "BatchConfig",
    "Choice",
    "ChoiceTrace",
    "Circle",
    "ConditioningExplanation",
    "Development",
    "Event",
    "Explanation",
    "FileError",
    "InvalidValue",
    "Kind",
    "Learner",
    "LearnerConfig",
    "LearnerMemory",
    "MemoryUse",
    "Mover",
    "MoverPath",
    "MoverWalk",
    "NoiseDef",
    "Observation",
    "OptionView",
    "Outcome",
    "Polygon",
    "Polyline",
    "Pose",
    "Random",
    "RandomAgent",
    "Recollection",
    "Record",
    "Rectangle",
    "Results",
    "Robot",
    "RobotDef",
    "SalientEventsExplanation",
    "ShortestPath",
    "Senses",
    "SituationGrid",
    "SituationMemory",
    "StateEvaluation",
    "Step",
    "Tally",
    "Trial",
    "TrialConfig",
    "World",
    "WrongType",
    "__version__",
    "animate",
    "direction",
    "exponential",
    "may_reach_target",
    "shortest_path",
    "sweep",
    "view",
    "worlds",
    "wrapped_heading",
]

# Where they are, of which some need more than numpy.
_FURTHER = {
    "Results": ".experiments.store",
    "animate": ".viewer.film",
    "sweep": ".experiments.sweep",
    "view": ".viewer.live",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        # Each name when it is first asked for (PEP 562): --help should not wait for them.
        if name in _FURTHER:
            globals()[name] = getattr(import_module(_FURTHER[name], __name__), name)
            return globals()[name]
        if name in __all__:
            from . import _core, _types, _worlds, record

            for module in (_core, _types, _worlds, errors, record):
                if hasattr(module, name):
                    globals()[name] = getattr(module, name)
                    return globals()[name]
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
