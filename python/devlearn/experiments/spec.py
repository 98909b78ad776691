"""What a sweep is: worlds x agents x settings x seeds, from a small file or a dict.

``devlearn/sweep.schema.json`` says the same for editors and other programs.
"""

from __future__ import annotations

import dataclasses
import itertools
import json
import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from .._calls import path_text, shown
from .._core import World
from .._settings import unknown
from .._worlds import worlds
from ..errors import FileError, InvalidValue, MissingExtra
from . import measures
from .contenders import config_of
from .job import KEEP, Job, canonical, world_hash
from .schedule import Schedule

_LARGEST_SEED = 2**63 - 1  # as SQLite holds it
_MOST_RUNS = 10**7
_SCHEDULE = [field.name for field in dataclasses.fields(Schedule)]
_RANDOM_WORLD = re.compile(r"([a-z_]+):(\d{1,19})(?:-(\d{1,19}))?")

# Each key of a spec, and what it is in words.
KEYS = {
    "worlds": 'a list of names, of files, or of random worlds such as "similar:10-19"',
    "agents": "a list of names",
    "seeds": 'such as "1-100" or "1-10,20", or a list of whole numbers',
    "free": "a list of steps, one of each round of free learning",
    "rounds": "a whole number",
    "step_limit": "a whole number",
    "hopeless": "a whole number",
    "measures": 'a list of "module:function"',
    "keep": " or ".join(map(repr, KEEP)),
    "trial": "a table of fields of TrialConfig",
    "settings": "a table of tables, an agent's settings each",
}
_NEEDED = ("worlds", "agents", "seeds")


@dataclasses.dataclass(frozen=True)
class Variant:
    """An agent with its settings, under a configuration and a schedule."""

    agent: str
    settings: dict[str, Any]
    trial: dict[str, Any]
    schedule: Schedule

    label: str
    """A short name: the agent's, and what was set."""


def _label(agent: str, chosen: Mapping[str, Any]) -> str:
    return " ".join([agent, *(f"{name}={_brief(value)}" for name, value in chosen.items())])


def _brief(value: object) -> str:
    return value if isinstance(value, str) else json.dumps(value, separators=(",", ":"))


@dataclasses.dataclass(frozen=True)
class Spec:
    """A sweep, read and checked: every run that it names can be begun."""

    worlds: dict[str, str]
    """Each world's name, as the runs have it, and its JSON."""
    variants: list[Variant]
    seeds: list[int]
    measures: list[str]
    keep: str
    values: dict[str, Any]
    """What it was made of."""

    def __len__(self) -> int:
        """How many runs."""
        return len(self.worlds) * len(self.variants) * len(self.seeds)

    def jobs(self) -> Iterator[Job]:
        """The runs, seed by seed, so that a part of them is a smaller sweep."""
        for seed, (world, text), variant in itertools.product(
            self.seeds, self.worlds.items(), self.variants
        ):
            yield Job(
                world=world,
                world_json=text,
                agent=variant.agent,
                settings=variant.settings,
                trial=variant.trial,
                schedule=variant.schedule,
                seed=seed,
                label=variant.label,
                measures=tuple(self.measures),
                keep=self.keep,
            )

    def one_of_each(self) -> Iterator[Job]:
        """A run of each variant, in their order."""
        return itertools.islice(self.jobs(), len(self.variants))


class Together:
    """Several sweeps in one: each run once, with all that any of them asks of it."""

    def __init__(self, specs: Sequence[Spec]) -> None:
        """Raises InvalidValue for two worlds of one name."""
        self._specs = specs
        self.values = [spec.values for spec in specs]
        self.measures = [*dict.fromkeys(name for spec in specs for name in spec.measures)]
        self.worlds: dict[str, str] = {}
        for name, text in (world for spec in specs for world in spec.worlds.items()):
            if self.worlds.setdefault(name, text) != text:
                raise InvalidValue("worlds", repr(name), "one world of that name in all of them")
        self._jobs: dict[tuple[str, str, int], Job] = {}
        for job in (job for spec in specs for job in spec.jobs()):
            place = job.world, canonical(job.variant()), job.seed
            known = self._jobs.setdefault(place, job)
            self._jobs[place] = dataclasses.replace(
                known,
                measures=tuple(dict.fromkeys(known.measures + job.measures)),
                keep=max(known.keep, job.keep, key=KEEP.index),
            )

    def __len__(self) -> int:
        """How many runs."""
        return len(self._jobs)

    def jobs(self) -> Iterator[Job]:
        """The runs, one sweep after the other."""
        return iter(self._jobs.values())

    def one_of_each(self) -> Iterator[Job]:
        """A run of each variant, in the order of the sweeps."""
        return itertools.chain.from_iterable(spec.one_of_each() for spec in self._specs)


def read(spec: Mapping[str, Any] | str | os.PathLike[str]) -> Spec:
    """A spec from a dict, or from a TOML file, whose folder its world files are looked for in.

    Raises InvalidValue, FileError for a file.
    """
    if isinstance(spec, Mapping):
        return _of(dict(spec), Path())
    path = Path(path_text(spec))
    try:
        return _of(toml(path), path.parent)
    except FileError:
        raise
    except InvalidValue as error:
        raise FileError(str(path), error.quantity, error.value, error.allowed) from error


def toml(path: Path) -> dict[str, Any]:
    """What a TOML file holds. Raises FileError."""
    try:
        import tomllib
    except ModuleNotFoundError:  # before Python 3.11
        try:
            import tomli as tomllib  # type: ignore[import-not-found,no-redef]
        except ModuleNotFoundError as error:
            raise MissingExtra("a sweep's file", "tomli", "experiments") from error
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FileError(str(path), "", error.strerror, "a sweep in TOML") from error
    except ValueError as error:
        raise FileError(str(path), "", f"unreadable: {error}", "a sweep in TOML") from error


def _of(values: dict[str, Any], folder: Path) -> Spec:
    for key in values:
        if key not in KEYS:
            raise unknown("key", key, KEYS)
    for key in _NEEDED:
        if key not in values:
            raise InvalidValue(key, "nothing", KEYS[key])
    try:
        json.dumps(values, ensure_ascii=False).encode()
    except (TypeError, ValueError) as error:
        raise InvalidValue("spec", str(error), "values that JSON can hold") from error
    own = [_text("measures", name) for name in _list("measures", values.get("measures", []))]
    _require_once("measures", [name.lower() for name in own])  # columns of SQL, which see no case
    for name in own:
        measures.own(name)  # refuses what there is not
    keep = values.get("keep", "nothing")
    if keep not in KEEP:
        raise InvalidValue("keep", shown(keep), KEYS["keep"])
    named = [
        found
        for name in _list("worlds", values["worlds"])
        for found in _worlds(_text("worlds", name), folder)
    ]
    _require_once("worlds", [name for name, _ in named])
    spec = Spec(
        worlds=dict(named),
        variants=[*_variants(values)],
        seeds=seeds_of(values["seeds"]),
        measures=own,
        keep=keep,
        values=values,
    )
    if not 1 <= len(spec) <= _MOST_RUNS:
        raise InvalidValue("spec", f"{len(spec)} runs", f"in [1, {_MOST_RUNS}]")
    return spec


# --- worlds and seeds -----------------------------------------------------------------------------


def _worlds(name: str, folder: Path) -> Iterator[tuple[str, str]]:
    random = _RANDOM_WORLD.fullmatch(name)
    if random:
        kind, first, last = random[1], int(random[2]), int(random[3] or random[2])
        if not first <= last <= _LARGEST_SEED:
            raise InvalidValue("worlds", repr(name), "KIND:FIRST-LAST, FIRST no more than LAST")
        if last - first >= _MOST_RUNS:
            raise InvalidValue("worlds", repr(name), f"at most {_MOST_RUNS}")
        for seed in range(first, last + 1):
            yield f"{kind}:{seed}", World.random(kind, seed).to_json()
    elif name in worlds():
        yield name, World.load(name).to_json()
    else:
        file = folder / name
        if not os.path.exists(file) and not name.endswith(".json"):
            raise unknown("worlds", name, worlds())
        yield name, World.load(file).to_json()


def seeds_of(seeds: object) -> list[int]:
    """The seeds of ``"1-100"``, ``"1-10,20"`` or a list. Raises InvalidValue."""
    found: list[int] = []
    if isinstance(seeds, str):
        for part in seeds.split(","):
            span = re.fullmatch(r"\s*(\d{1,19})\s*(?:-\s*(\d{1,19})\s*)?", part)
            if not span:
                raise InvalidValue("seeds", repr(seeds), KEYS["seeds"])
            first, last = int(span[1]), int(span[2] or span[1])
            if not first <= last <= _LARGEST_SEED:
                raise InvalidValue("seeds", repr(seeds), f"in [0, {_LARGEST_SEED}], least first")
            if last - first >= _MOST_RUNS:
                raise InvalidValue("seeds", repr(seeds), f"at most {_MOST_RUNS}")
            found += range(first, last + 1)
    else:
        for seed in _list("seeds", seeds):
            if type(seed) is not int or not 0 <= seed <= _LARGEST_SEED:
                raise InvalidValue("seeds", shown(seed), f"whole numbers in [0, {_LARGEST_SEED}]")
            found.append(seed)
    _require_once("seeds", found)
    return found


# --- agents and their settings --------------------------------------------------------------------


def _variants(values: Mapping[str, Any]) -> Iterator[Variant]:
    names = [_text("agents", name) for name in _list("agents", values["agents"])]
    _require_once("agents", names)
    settings = _table("settings", values.get("settings", {}))
    for name in settings:
        if name not in names:
            raise unknown("settings", name, names)
    common = {key: values[key] for key in _SCHEDULE if key in values}
    trials = [*_alternatives(_table("trial", values.get("trial", {})))]
    for name in names:
        for chosen in _alternatives(_table(f"settings.{name}", settings.get(name, {}))):
            schedule = {**common, **{k: chosen[k] for k in _SCHEDULE if k in chosen}}
            planned = Schedule(**schedule)
            for trial in trials:
                own = {k: v for k, v in chosen.items() if k not in _SCHEDULE}
                config_of(name, own, trial)  # refuses what does not fit
                yield Variant(name, own, trial, planned, _label(name, {**chosen, **trial}))


def _alternatives(table: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Every choice of a value of each: of a list one of its values, of anything else itself."""
    choices = [value if isinstance(value, list) else [value] for value in table.values()]
    for name, alternatives in zip(table, choices):
        if not alternatives:
            raise InvalidValue(name, "[]", "a value, or a list of alternatives")
    for values in itertools.product(*choices):
        yield dict(zip(table, values))


def _require_once(key: str, values: Sequence[Any]) -> None:
    if len(set(values)) < len(values):
        twice, _ = Counter(values).most_common(1)[0]
        raise InvalidValue(key, f"{twice} twice", "each once")


def _table(quantity: str, value: object, outer: str = "") -> dict[str, Any]:
    if not isinstance(value, Mapping):
        raise InvalidValue(quantity, shown(value), KEYS.get(quantity, "a table"))
    if quantity == "settings":
        return dict(value)
    # TOML makes tables of dotted names.
    flat: dict[str, Any] = {}
    for name, entry in value.items():
        if isinstance(entry, Mapping):
            flat |= _table(quantity, entry, f"{outer}{name}.")
        else:
            flat[f"{outer}{name}"] = entry
    return flat


def _list(key: str, value: object) -> Sequence[Any]:
    if not isinstance(value, (list, tuple)):
        raise InvalidValue(key, shown(value), KEYS[key])
    return value


def _text(key: str, value: object) -> str:
    if not isinstance(value, str):
        raise InvalidValue(key, shown(value), KEYS[key])
    return value


# --- one run, by its command ----------------------------------------------------------------------


def of_command(text: str) -> Job:
    """The job of a command's JSON. Raises InvalidValue, FileError."""
    try:
        values = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InvalidValue(
            "--run", f"unreadable: {error}", "the JSON of a row's command"
        ) from error
    if not isinstance(values, dict):
        raise InvalidValue("--run", type(values).__name__, "the JSON of a row's command")
    known = ("world", "world_hash", "seed", "agent", "settings", "trial", "measures")
    for name in values:
        if name not in (*known, *_SCHEDULE):
            raise unknown("--run", name, (*known, *_SCHEDULE))
    one = _of(
        {
            "worlds": [values.get("world")],
            "agents": [values.get("agent")],
            "seeds": [values.get("seed")],
            "measures": values.get("measures", []),
            "keep": "record",
            **{name: values[name] for name in _SCHEDULE if name in values},
        },
        Path(),
    )
    [job] = one.jobs()
    settings, trial = values.get("settings", {}), values.get("trial", {})
    for key, table in (("settings", settings), ("trial", trial)):
        if not isinstance(table, dict):
            raise InvalidValue(key, shown(table), "a table")
    config_of(job.agent, settings, trial)
    asked = values.get("world_hash", found := world_hash(job.world_json))
    if asked != found:
        raise InvalidValue("world_hash", found, f"{asked}: {job.world} is not what it was")
    return dataclasses.replace(job, settings=settings, trial=trial)
