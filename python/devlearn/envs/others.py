"""What is asked of an environment of others, and how it is begun and looked at."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from .._calls import shown
from .._core import Random
from ..errors import InvalidValue

Env = gymnasium.Env[Any, Any]


def actions_of(env: Env) -> tuple[int, int]:
    """How many actions an environment takes, and the first of them. Raises InvalidValue."""
    if not isinstance(env, gymnasium.Env):
        raise InvalidValue("env", shown(env), "a gymnasium.Env, and one of them, no vector")
    space = env.action_space
    if isinstance(space, spaces.Discrete):
        return int(space.n), int(space.start)
    if isinstance(space, spaces.Box):
        instead = "a few of these actions chosen by a wrapper"
    else:
        instead = "the combinations numbered by a wrapper"
    raise InvalidValue(
        "env.action_space",
        shown(space),
        f"Discrete: {instead}, such as "
        "gymnasium.wrappers.TransformAction(env, actions.__getitem__, "
        "gymnasium.spaces.Discrete(len(actions)))",
    )


def allowed_of(info: Mapping[str, Any], count: int) -> npt.NDArray[np.bool_] | None:
    """Which actions an environment allows, by ``info["action_mask"]``; None: it does not say.

    Raises InvalidValue for what is no mask, or allows nothing.
    """
    if not isinstance(info, Mapping):
        raise InvalidValue("info", shown(info), "a dict, as Gymnasium's environments give it")
    mask = info.get("action_mask")
    if mask is None:
        return None
    allowed = array_of(mask)
    if allowed is None or allowed.shape != (count,) or not np.isin(allowed, (0, 1)).all():
        wanted = f"{count} of 0 and 1, one an action"
        raise InvalidValue('info["action_mask"]', shown(mask), wanted)
    if not allowed.any():
        raise InvalidValue('info["action_mask"]', shown(mask), "an action that is allowed")
    return allowed.astype(np.bool_)


def array_of(given: object) -> npt.NDArray[Any] | None:
    """As an array of numbers; None for what is none."""
    try:
        array = np.asarray(given)
    except ValueError:  # lists of different lengths
        return None
    return array if array.dtype.kind in "biuf" else None


def reset_seed(random: Random) -> int:
    """A seed that every environment takes: in [0, 2**31)."""
    return random.next() % 2**31


def is_whole(value: object) -> bool:
    """Whether it is a whole number, of Python or numpy, and no bool."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def require_whole(quantity: str, value: Any, least: int) -> None:
    """Raises InvalidValue unless it is a whole number of at least so much."""
    if not is_whole(value) or value < least:
        raise InvalidValue(quantity, shown(value), f"a whole number >= {least}")
