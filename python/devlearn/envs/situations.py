"""Which situation an observation is: a whole number for what an environment of others shows."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from .._calls import shown
from .._core import Random
from ..errors import InvalidValue
from .others import Env, actions_of, allowed_of, array_of, is_whole, require_whole, reset_seed

_MOST = 2**63  # situations
_MOST_TILES = 1_000_000  # of a dimension, whose edges are kept one by one
_NO_BOUND = float(np.finfo(np.float32).max)  # in older environments it stands for infinity


@dataclass(frozen=True)
class DiscreteSituations:
    """Observations that are whole numbers, as they are: of Discrete, MultiDiscrete, MultiBinary,
    and a Tuple of Discrete.

    Several numbers are the digits of one, the first the most significant: id = (d_0 N_1 + d_1) N_2
    + d_2 and so on, each counted from the least of its space. Pickled and compared by value.
    Calling it raises InvalidValue for an observation that the space does not hold.
    """

    counts: tuple[int, ...]
    """N_i: how many values each number has; each >= 1, their product at most 2**63."""
    least: tuple[int, ...]
    """The least value of each; as many."""

    def __post_init__(self) -> None:
        counts, least = map(_whole_numbers, (self.counts, self.least), ("counts", "least"))
        for count in counts:
            require_whole("DiscreteSituations.counts", count, 1)
        if len(counts) != len(least):
            raise InvalidValue("DiscreteSituations.least", shown(least), f"{len(counts)} numbers")
        _require_room(counts)
        object.__setattr__(self, "counts", counts)
        object.__setattr__(self, "least", least)

    @classmethod
    def of(cls, space: spaces.Space[Any]) -> DiscreteSituations:
        """Those of a space. Raises InvalidValue for one that holds other things."""
        digits = _digits(space)
        if digits is None:
            raise InvalidValue(
                "observation_space",
                shown(space),
                "Discrete, MultiDiscrete, MultiBinary, or a Tuple of Discrete; for a Box, "
                "TileSituations; for any other, situations= a function observation -> whole number",
            )
        return cls(tuple(n for n, _ in digits), tuple(first for _, first in digits))

    @property
    def count(self) -> int:
        """How many situations there are."""
        return math.prod(self.counts)

    def __call__(self, observation: Any) -> int:
        """The id of an observation."""
        digits = array_of(observation)
        if digits is None or digits.dtype.kind == "f" or digits.size != len(self.counts):
            raise InvalidValue("observation", shown(observation), self._wanted())
        situation = 0
        for digit, count, least in zip(digits.ravel().tolist(), self.counts, self.least):
            if not 0 <= digit - least < count:
                raise InvalidValue("observation", shown(observation), self._wanted())
            situation = situation * count + digit - least
        return situation

    def _wanted(self) -> str:
        ranges = (f"{low} ... {low + n - 1}" for low, n in zip(self.least, self.counts))
        return "whole numbers, each in its range: " + ", ".join(ranges)


@dataclass(frozen=True)
class TileSituations:
    """Observations of a Box, by the tile they lie in.

    The edges of a dimension cut it into one tile more than there are edges; tiles hold their lower
    edge, and the outermost have no end. A dimension without edges says nothing. Tiles are numbered
    as digits, the first dimension's the most significant. Pickled and compared by value. Calling it
    raises InvalidValue for an observation of another size, or with NaN.

        TileSituations([[-0.5, 0.5], [0.0]])                   # 3 x 2 tiles
        TileSituations.even(env.observation_space, 20)         # of a Box with bounds
        TileSituations.from_quantiles(env, 8, warm_up=10_000)  # where it has none
    """

    edges: tuple[tuple[float, ...], ...]
    """Of each dimension, in the order of ``observation.ravel()``: increasing, finite."""

    def __post_init__(self) -> None:
        edges = tuple(_edges_of(d, given) for d, given in enumerate(_sequence(self.edges)))
        _require_room([len(of) + 1 for of in edges])
        object.__setattr__(self, "edges", edges)

    @classmethod
    def even(cls, space: spaces.Space[Any], tiles: int | Sequence[int]) -> TileSituations:
        """Tiles of equal width between the bounds of a Box.

        tiles: how many a dimension, one number for all or one each, in [1, 1,000,000]; 1 leaves a
        dimension out.
        Raises InvalidValue, likewise where a dimension that is cut has no bounds.
        """
        low, high = _bounds(space)
        counts = _counts("tiles", tiles, low.size)
        cut = np.asarray(counts) > 1
        bounded = np.maximum(np.abs(low), np.abs(high)) < _NO_BOUND
        if not (bounded | ~cut).all():
            which = ", ".join(map(str, np.flatnonzero(cut & ~bounded)))
            raise InvalidValue(
                "observation_space",
                f"{shown(space)}, without bounds in dimension {which}",
                "bounds; or TileSituations(edges) of edges chosen by you, or "
                "TileSituations.from_quantiles(env, n) of what random actions show",
            )
        return cls(
            tuple(
                tuple(np.linspace(a, b, n + 1)[1:-1]) if n > 1 else ()
                for a, b, n in zip(low.tolist(), high.tolist(), counts)
            )
        )

    @classmethod
    def from_quantiles(
        cls,
        env: Env,
        quantiles: int | Sequence[int],
        *,
        warm_up: int = 10_000,
        seed: int = 0,
    ) -> TileSituations:
        """Tiles that random actions meet equally often.

        Before anything is learned, so many observations are made in the environment, by uniformly
        random actions (of those allowed), and the edges are quantiles of what was seen. Where
        values repeat there are fewer tiles. What random actions never reach lies in the outermost
        tiles.

        quantiles: tiles a dimension, one number for all or one each, in [1, 1,000,000]; warm_up:
        how many observations, at least as many as quantiles; seed: of episodes and actions. Raises
        InvalidValue, likewise where an observation is not finite.
        """
        low, _ = _bounds(env.observation_space)
        counts = _counts("quantiles", quantiles, low.size)
        require_whole("warm_up", warm_up, max(counts))
        seen = _seen_by_chance(env, warm_up, seed)
        if not np.isfinite(seen).all():
            which = int(np.flatnonzero(~np.isfinite(seen).all(0))[0])
            raise InvalidValue(
                f"observation[{which}]", "a number that is not finite", "finite numbers"
            )
        return cls(
            tuple(
                tuple(np.unique(np.quantile(values, np.arange(1, n) / n)).tolist())
                for values, n in zip(seen.T, counts)
            )
        )

    @property
    def count(self) -> int:
        """How many situations there are."""
        return math.prod(len(edges) + 1 for edges in self.edges)

    def __call__(self, observation: Any) -> int:
        """The id of an observation."""
        values = array_of(observation)
        if values is None or values.size != len(self.edges):
            raise InvalidValue("observation", shown(observation), f"{len(self.edges)} numbers")
        situation = 0
        for value, edges in zip(values.ravel().tolist(), self.edges):
            if value != value:
                raise InvalidValue("observation", shown(observation), "numbers, none of them NaN")
            situation = situation * (len(edges) + 1) + bisect_right(edges, value)
        return situation


def _digits(space: spaces.Space[Any]) -> list[tuple[int, int]] | None:
    """Of each number that an observation is made of how many values it has, and the least."""
    if isinstance(space, spaces.Discrete):
        return [(int(space.n), int(space.start))]
    if isinstance(space, spaces.MultiDiscrete):
        return list(zip(np.ravel(space.nvec).tolist(), np.ravel(space.start).tolist()))
    if isinstance(space, spaces.MultiBinary):
        return [(2, 0)] * math.prod(space.shape)
    if isinstance(space, spaces.Tuple) and all(isinstance(s, spaces.Discrete) for s in space):
        return [(int(one.n), int(one.start)) for one in space]
    return None


def _bounds(
    space: spaces.Space[Any],
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    if not isinstance(space, spaces.Box):
        raise InvalidValue("observation_space", shown(space), "a Box")
    return np.ravel(space.low).astype(np.float64), np.ravel(space.high).astype(np.float64)


def _counts(name: str, given: int | Sequence[int], dimensions: int) -> list[int]:
    counts = list(given) if isinstance(given, (Sequence, np.ndarray)) else [given] * dimensions
    if len(counts) != dimensions:
        raise InvalidValue(name, shown(given), f"one number, or {dimensions}, one a dimension")
    for count in counts:
        require_whole(name, count, 1)
        if count > _MOST_TILES:
            raise InvalidValue(name, count, f"at most {_MOST_TILES} a dimension")
    return counts


def _whole_numbers(given: Sequence[int], name: str) -> tuple[int, ...]:
    if not isinstance(given, (Sequence, np.ndarray)) or not all(map(is_whole, given)):
        raise InvalidValue(f"DiscreteSituations.{name}", shown(given), "whole numbers, in a list")
    return tuple(map(int, given))


def _sequence(edges: Iterable[Iterable[float]]) -> Iterable[Iterable[float]]:
    if not isinstance(edges, (Sequence, np.ndarray)) or isinstance(edges, str):
        raise InvalidValue("TileSituations.edges", shown(edges), "a list of lists, one a dimension")
    return edges


def _edges_of(dimension: int, given: Iterable[float]) -> tuple[float, ...]:
    try:
        edges = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        edges = np.array(np.nan)
    if edges.ndim != 1 or not np.isfinite(edges).all() or (np.diff(edges) <= 0).any():
        raise InvalidValue(
            f"TileSituations.edges[{dimension}]", shown(given), "finite numbers, increasing"
        )
    return tuple(edges.tolist())


def _require_room(counts: Iterable[int]) -> None:
    situations = math.prod(counts)
    if situations > _MOST:
        raise InvalidValue("situations", situations, "at most 2**63: fewer tiles, or fewer numbers")


def _seen_by_chance(env: Env, count: int, seed: int) -> npt.NDArray[np.float64]:
    """So many observations, a row each, of uniformly random actions."""
    motions, first = actions_of(env)
    random = Random(seed, "warm-up")
    seen: list[npt.NDArray[np.float64]] = []
    over = True
    while len(seen) < count:
        if over:
            observation, info = env.reset(seed=reset_seed(random))
            over = False
        else:
            allowed = allowed_of(info, motions)
            among = range(motions) if allowed is None else np.flatnonzero(allowed).tolist()
            action = first + among[random.index(len(among))]
            observation, _, terminated, truncated, info = env.step(action)
            over = terminated or truncated
        seen.append(np.ravel(observation).astype(np.float64))
    return np.stack(seen)
