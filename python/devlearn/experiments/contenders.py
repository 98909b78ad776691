"""Whoever takes part in an experiment, by name, with settings of its own."""

from __future__ import annotations

import copy
import importlib
import importlib.util
import inspect
import sys
from collections.abc import Callable, Mapping
from typing import Any

from .. import _core, agents
from .._calls import shown
from .._core import Trial, TrialConfig, World
from .._settings import changed, unknown
from ..errors import InvalidValue

PRESETS = ("paper", "step5", "adaptive")

_OF_VALUES = {
    name: cls for name in agents.__all__ if hasattr(cls := getattr(agents, name), "Config")
}
_PLAIN: Mapping[str, Callable[[TrialConfig, World, int], object]] = {
    "RandomAgent": lambda config, world, seed: _core.RandomAgent(seed),
    "ShortestPathAgent": lambda config, world, seed: agents.ShortestPathAgent(
        _core.Robot(world, config.robot), config.goal_radius
    ),
}
NAMES = (*PRESETS, *_OF_VALUES, *_PLAIN)


def preset(name: str) -> TrialConfig:
    """The configuration of a preset, 'paper', 'step5' or 'adaptive'. Raises InvalidValue."""
    if name not in PRESETS:
        raise InvalidValue("preset", repr(name), " or ".join(map(repr, PRESETS)))
    config: TrialConfig = getattr(TrialConfig, name)()
    return config


def trial_of(
    name: str,
    settings: Mapping[str, Any],
    changes: Mapping[str, Any],
    world: World,
    seed: int,
) -> Trial:
    """A new trial of who is called ``name``: one of `NAMES`, or one's own, ``module:Class``.

    ``settings`` are its own, by name; ``changes`` are fields of the TrialConfig by dotted name. A
    class of one's own is called as ``Class(seed=seed, **settings)``. Raises InvalidValue.
    """
    config = config_of(name, settings, changes)
    return Trial(world, config, seed, _agent(name, settings, config, world, seed))


def config_of(name: str, settings: Mapping[str, Any], changes: Mapping[str, Any]) -> TrialConfig:
    """The configuration of its trials. Raises InvalidValue for what does not fit."""
    config = preset(name) if name in PRESETS else TrialConfig()
    for change in changes:
        if change.startswith("learner."):
            raise InvalidValue("trial", change, f"a setting of {name} in place of it")
    motions = changes.get("robot.steering_angles")
    if isinstance(motions, (list, tuple)):
        changes = {**changes, "learner.motion_count": len(motions)}
    config = changed(config, changes, "trial")
    if name in PRESETS:
        return config.replace(learner=changed(config.learner, settings, f"settings.{name}"))
    if name in _OF_VALUES:
        changed(_OF_VALUES[name].Config(), settings, f"settings.{name}")
    elif name in _PLAIN:
        for setting in settings:
            raise unknown(f"settings.{name}", setting, ())
    else:
        _require_arguments(name, settings)
    return config


def _agent(
    name: str, settings: Mapping[str, Any], config: TrialConfig, world: World, seed: int
) -> object:
    if name in PRESETS:
        return None
    if name in _OF_VALUES:
        cls = _OF_VALUES[name]
        return cls(changed(cls.Config(), settings), seed)
    if name in _PLAIN:
        return _PLAIN[name](config, world, seed)
    own = copy.deepcopy(dict(settings))  # which it may change; other runs have the same
    return of_module("agent", name)(seed=seed, **own)


def _require_arguments(name: str, settings: Mapping[str, Any]) -> None:
    own = of_module("agent", name)
    try:
        taken = inspect.signature(own)
    except (TypeError, ValueError):
        return  # it does not say
    try:
        taken.bind(seed=0, **settings)
    except TypeError as error:
        raise InvalidValue(f"settings.{name}", str(error), f"arguments of {name}{taken}") from error


def of_module(quantity: str, name: str) -> Callable[..., Any]:
    """What is called ``module:name``, from the present folder, too. Raises InvalidValue."""
    module, _, attribute = name.partition(":")
    if not module or not attribute:
        raise unknown(quantity, name, (*NAMES, "module:Class") if quantity == "agent" else ())
    try:
        if "" not in sys.path and importlib.util.find_spec(module.partition(".")[0]) is None:
            sys.path.insert(0, "")  # as `python -c` has it; the program's own folder is there else
        found: Any = importlib.import_module(module)
        for part in attribute.split("."):
            found = getattr(found, part)
    except (Exception, SystemExit) as error:
        told = f"{name}, which cannot be had: {type(error).__name__}: {error}"
        raise InvalidValue(quantity, told, "module:name of what can be imported") from error
    if not callable(found):
        raise InvalidValue(quantity, f"{name}, {shown(found)}", "what can be called")
    return found  # type: ignore[no-any-return]
