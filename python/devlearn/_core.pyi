"""
The C++ core of devlearn. Use it through the package `devlearn`.
"""

from __future__ import annotations
import collections.abc
import devlearn._types
import devlearn.record
import enum
import numpy
import numpy.typing
import threading
import typing

__all__: list[str] = [
    "AdaptiveConfig",
    "AdaptiveExplanation",
    "AdaptiveLearner",
    "AdaptiveMemory",
    "Appraisal",
    "AppraisalConfig",
    "AppraisalExplanation",
    "Attention",
    "AttentionConfig",
    "Balance",
    "BalanceConfig",
    "Batch",
    "BatchConfig",
    "BatchRows",
    "ChoiceTrace",
    "Circle",
    "ConditioningExplanation",
    "DynaQ",
    "DynaQConfig",
    "Event",
    "ExpectedSarsa",
    "ExpectedSarsaConfig",
    "Explanation",
    "Foraging",
    "ForagingConfig",
    "Iac",
    "IacConfig",
    "IacExplanation",
    "IacRegion",
    "Kind",
    "Learner",
    "LearnerConfig",
    "LrtaStar",
    "LrtaStarConfig",
    "MemoryUse",
    "Mover",
    "MoverPath",
    "MoverWalk",
    "NoiseDef",
    "Observation",
    "OperantConditioning",
    "OperantConditioningConfig",
    "OptionView",
    "Outcome",
    "Playroom",
    "PlayroomConfig",
    "Polygon",
    "Polyline",
    "PrioritizedSweeping",
    "PrioritizedSweepingConfig",
    "QLearning",
    "QLearningConfig",
    "RMax",
    "RMaxConfig",
    "Random",
    "RandomAgent",
    "Recollection",
    "Rectangle",
    "Robot",
    "RobotDef",
    "SalientEvents",
    "SalientEventsConfig",
    "SalientEventsExplanation",
    "SarsaLambda",
    "SarsaLambdaConfig",
    "ShortestPath",
    "ShortestPathAgent",
    "SituationGrid",
    "SituationMemory",
    "StateEvaluation",
    "Step",
    "Tally",
    "Task",
    "Trial",
    "TrialConfig",
    "TwoWheeledDef",
    "World",
    "box2d_version",
    "commit",
    "direction",
    "exponential",
    "heading_of_yaw",
    "later_columns",
    "load_config",
    "may_reach_target",
    "pose_columns",
    "record_in_snapshot",
    "require_record",
    "run_episodes",
    "shortest_path",
    "step_columns",
    "wrapped_heading",
    "write_file",
    "yaw_of_heading",
]

class Random:
    """
    A seedable generator (xoshiro256++) with named streams; the same draws on every machine.

    The paper's learner draws from the stream "agent" of its seed.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    @staticmethod
    def from_state(state: numpy.ndarray) -> Random:
        """
        A generator that goes on from a state. Raises InvalidValue for what is none.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> typing.Annotated[list[int], "FixedSize(4)"]: ...
    def __init__(self, seed: typing.SupportsIndex, stream: str) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(
        self,
        arg0: typing.Annotated[
            collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(4)"
        ],
    ) -> None: ...
    def index(self, count: typing.SupportsIndex) -> int:
        """
        An int uniform on {0, ..., count - 1}. Raises InvalidValue unless 1 <= count < 2**32.
        """
    def next(self) -> int:
        """
        64 random bits as an int.
        """
    def normal(self) -> float:
        """
        Normal with mean 0 and standard deviation 1, as far as twelve uniform numbers less six are (Irwin-Hall); never beyond 6.
        """
    def uniform(self) -> float:
        """
        A float uniform on [0, 1).
        """
    @property
    def state(self) -> numpy.typing.NDArray[numpy.uint64]:
        """
        What it goes on from, as an array of four uint64.
        """

class SituationGrid:
    """
    Step 1: which sensory situation a pose is, on an even grid of cells and headings.

    Cells are half-open; the arena's far borders belong to the last cells. Heading bin k is
    centred on k * 360 / headings degrees. id = (row * columns + column) * headings + bin.

    Parameters: width, height in (0, 10000] m; columns, rows in 1 ... 100000; headings in
    1 ... 3600; origin (x, y), the arena's corner of least x and y, each within 1e7 m of 0;
    outside: of poses beyond the arena, 'refuse', or 'clamp' to the nearest cell, as a real
    robot's estimate may need. Raises InvalidValue.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self,
        width: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        height: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        columns: typing.SupportsIndex = 20,
        rows: typing.SupportsIndex = 20,
        headings: typing.SupportsIndex = 12,
        origin: collections.abc.Sequence[float] = (0.0, 0.0),
        outside: str = "refuse",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def centre(self, situation: typing.SupportsIndex) -> devlearn._types.Pose:
        """
        The pose in the middle of a situation's cell and heading bin. Raises InvalidValue.
        """
    @typing.overload
    def situation(
        self,
        x: typing.SupportsFloat | typing.SupportsIndex,
        y: typing.SupportsFloat | typing.SupportsIndex,
        heading: typing.SupportsFloat | typing.SupportsIndex,
    ) -> int:
        """
        The situation id of a pose: x, y in metres inside the grid, heading in degrees. Numbers give an int; arrays broadcast and give an int64 array. Of a robot that has radians: situation(Pose.from_radians(x, y, yaw)). Raises InvalidValue.
        """
    @typing.overload
    def situation(self, pose: collections.abc.Sequence[float]) -> int:
        """
        The same of a Pose.
        """
    @typing.overload
    def situation(
        self,
        x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        heading: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> typing.Any: ...
    @property
    def columns(self) -> int:
        """
        Cells along x.
        """
    @property
    def count(self) -> int:
        """
        N_S, the number of situations.
        """
    @property
    def headings(self) -> int:
        """
        Heading bins.
        """
    @property
    def height(self) -> float:
        """
        [m]
        """
    @property
    def origin(self) -> tuple[float, float]:
        """
        (x, y) [m]
        """
    @property
    def outside(self) -> str:
        """
        Of poses beyond the arena: 'refuse' or 'clamp'.
        """
    @property
    def rows(self) -> int:
        """
        Cells along y.
        """
    @property
    def width(self) -> float:
        """
        [m]
        """

class StateEvaluation:
    """
    Step 2, the state evaluation function (Eq. 6); the defaults are the paper's:

        SEF = (a1 - a2 * d_g**2) - a3 * exp(a4 - a5 * d_o)

    Raises InvalidValue.

    Parameters
    ----------
    a1
        a_1: SEF at the target, far from obstacles; in [-1e+06, 1e+06].
    a2
        a_2: pull of the target; in [0, 1e+06] 1/m^2.
    a3
        a_3: push of obstacles; in [0, 1e+06].
    a4
        a_4: log of the push at an obstacle's surface; in [-100, 100].
    a5
        a_5: how fast the push decays; in [0, 1e+06] 1/m.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> StateEvaluation:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    @staticmethod
    def scaled(
        arena: typing.SupportsFloat | typing.SupportsIndex,
        radius: typing.SupportsFloat | typing.SupportsIndex,
    ) -> StateEvaluation:
        """
        The paper's shape for another arena [m, its greater side, in [0.01, 1e6]] and another radius of the robot [m, in [1e-5, arena / 2]]: SEF is the paper's at the same share of the arena from the target and the same number of radii from an obstacle. The paper's 5 m and 0.1 m give the defaults; else a2 = 0.3 (5 m / arena)**2 and a5 = 12 (0.1 m / radius). Raises InvalidValue.
        """
    @typing.overload
    def __call__(
        self,
        goal_distance: typing.SupportsFloat | typing.SupportsIndex,
        obstacle_distance: typing.SupportsFloat | typing.SupportsIndex,
    ) -> float:
        """
        SEF at a distance d_g in [0, 1e6] m from the target and d_o >= 0 m (inf where there is no obstacle) from the nearest obstacle. Numbers give a float; arrays broadcast. Raises InvalidValue.
        """
    @typing.overload
    def __call__(
        self,
        goal_distance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        obstacle_distance: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> typing.Any: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        a1: typing.SupportsFloat | typing.SupportsIndex = 20.0,
        a2: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        a3: typing.SupportsFloat | typing.SupportsIndex = 0.2,
        a4: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        a5: typing.SupportsFloat | typing.SupportsIndex = 12.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> StateEvaluation:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def a1(self) -> float:
        """
        a_1: SEF at the target, far from obstacles; in [-1e+06, 1e+06].
        """
    @property
    def a2(self) -> float:
        """
        a_2: pull of the target; in [0, 1e+06] 1/m^2.
        """
    @property
    def a3(self) -> float:
        """
        a_3: push of obstacles; in [0, 1e+06].
        """
    @property
    def a4(self) -> float:
        """
        a_4: log of the push at an obstacle's surface; in [-100, 100].
        """
    @property
    def a5(self) -> float:
        """
        a_5: how fast the push decays; in [0, 1e+06] 1/m.
        """

class LearnerConfig:
    """
    The learner's parameters; the defaults are the paper's.

    Raises InvalidValue.

    Parameters
    ----------
    motion_count
        N_M: number of motions; a whole number in [1, 65535].
    eta
        eta: orientation parameter of Eq. 9; in (0, 1).
    sigma
        sigma: weight of orientation against curiosity in Eq. 7; in (0, 1).
    c1
        c_1: how fast curiosity wanes, Eq. 5; in [0, 1e+06].
    c2
        c_2: times learned at which curiosity is 1/2, Eq. 5; in [-1e+06, 1e+06].
    on_negative
        What becomes of an exploited motion that met SMF < 0: it moves to the ineffective list (step
        4), or its orientation falls by Eq. 9 (step 5); 'abandon' or 'weaken'.
    when_exhausted
        What is done where every motion was tried and none is effective: any motion, and one that
        proves effective enters M_i again, or any motion, and nothing is learned; 'retry' or
        'wander'.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> LearnerConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    @staticmethod
    def paper() -> LearnerConfig:
        """
        The default: abandon and retry, the reading under which the paper's results come out.
        """
    @staticmethod
    def step5() -> LearnerConfig:
        """
        The other reading, for comparison: weaken and wander.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        motion_count: typing.SupportsIndex = 5,
        eta: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        sigma: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        c1: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        c2: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        on_negative: str = "abandon",
        when_exhausted: str = "retry",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> LearnerConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def c1(self) -> float:
        """
        c_1: how fast curiosity wanes, Eq. 5; in [0, 1e+06].
        """
    @property
    def c2(self) -> float:
        """
        c_2: times learned at which curiosity is 1/2, Eq. 5; in [-1e+06, 1e+06].
        """
    @property
    def eta(self) -> float:
        """
        eta: orientation parameter of Eq. 9; in (0, 1).
        """
    @property
    def motion_count(self) -> int:
        """
        N_M: number of motions; a whole number in [1, 65535].
        """
    @property
    def on_negative(self) -> str:
        """
        What becomes of an exploited motion that met SMF < 0: it moves to the ineffective list (step 4), or its orientation falls by Eq. 9 (step 5); 'abandon' or 'weaken'.
        """
    @property
    def sigma(self) -> float:
        """
        sigma: weight of orientation against curiosity in Eq. 7; in (0, 1).
        """
    @property
    def when_exhausted(self) -> str:
        """
        What is done where every motion was tried and none is effective: any motion, and one that proves effective enters M_i again, or any motion, and nothing is learned; 'retry' or 'wander'.
        """

class Kind(enum.IntEnum):
    """
    Why a motion was chosen.
    """

    EXPLORE = 0
    EXPLOIT = 1
    EXHAUSTED = 2
    UNSTATED = 3
    HABIT = 4
    DEVIATION = 5
    HELD = 6

class Event(enum.IntEnum):
    """
    What one outcome changed.
    """

    NOTHING = 0
    EXTENSION = 1
    REJECTION = 2
    ORIENTATION = 3
    ABANDONMENT = 4

class MemoryUse:
    """
    Memory in bytes.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def spare(self) -> int:
        """
        Held for more of them: reserved, or left over by growth.
        """
    @property
    def used(self) -> int:
        """
        By the situations experienced, their index included.
        """

class SituationMemory:
    """
    What one situation holds, as a copy: three disjoint lists of motion indices, together always M (Eq. 3-4).
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def effective(self) -> list[int]:
        """
        M_i: motions found effective, in the order they entered.
        """
    @property
    def ineffective(self) -> list[int]:
        """
        Motions found ineffective, or no longer good enough.
        """
    @property
    def orientation(self) -> list[float]:
        """
        Orientation of each effective motion; they sum to 1.
        """
    @property
    def times_learned(self) -> list[int]:
        """
        n_ij of each effective motion.
        """
    @property
    def unexplored(self) -> list[int]:
        """
        RM_i: motions not tried yet.
        """

class Explanation:
    """
    Why motions are chosen in a situation: all that step 3 makes of its memory. Of N motions,
    n are effective. Where not every motion is allowed, n and n_R of the probabilities count
    those that are. str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    def _repr_html_(self) -> str:
        """
        For notebooks.
        """
    @property
    def allowed(self) -> list[bool]:
        """
        N bools: whether each motion of M may be chosen.
        """
    @property
    def curiosity(self) -> list[float]:
        """
        n values: c_ik of each effective motion, Eq. 5.
        """
    @property
    def exhausted(self) -> float:
        """
        1 where nothing is left to explore or exploit, otherwise 0.
        """
    @property
    def exploit(self) -> float:
        """
        Probability to exploit, n / (n + n_R).
        """
    @property
    def explore(self) -> float:
        """
        Probability to explore, n_R / (n + n_R).
        """
    @property
    def memory(self) -> SituationMemory:
        """
        What the choice goes by: lists, orientations, counts.
        """
    @property
    def op_curious(self) -> list[float]:
        """
        n values: op of each, its own curiosity active, Eq. 7.
        """
    @property
    def op_plain(self) -> list[float]:
        """
        n values: op of each, another one's curiosity active, Eq. 7.
        """
    @property
    def probability(self) -> list[float]:
        """
        N values: of each motion of M to be chosen; they sum to 1.
        """
    @property
    def situation(self) -> int:
        """
        The situation's id.
        """
    @property
    def winner(self) -> list[int]:
        """
        n values: the motion that wins where the curiosity of each is active; -1 of one that is not allowed.
        """

class ChoiceTrace:
    """
    Why one choice came out as it did. str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    def _repr_html_(self) -> str:
        """
        For notebooks.
        """
    @property
    def choice(self) -> devlearn._types.Choice:
        """
        The Choice.
        """
    @property
    def curious(self) -> int:
        """
        The motion whose curiosity was drawn; -1 unless exploited.
        """
    @property
    def explanation(self) -> Explanation:
        """
        Of the situation as the choice found it.
        """
    @property
    def op(self) -> list[float]:
        """
        n values: op of each effective motion, Eq. 7; empty unless exploited.
        """

class Learner:
    """
    The sensorimotor developmental learner: a situation in, a motion out; how good it was in,
    the lists develop. It knows no robot, grid or task.

        learner = Learner(LearnerConfig(motion_count=4), seed=1)
        choice = learner.choose(situation)      # any whole number in 0 ... 2**63 - 1
        ...execute choice.motion...
        learner.learn(smf)                      # SMF = SEF after - SEF before, Eq. 8

    The same configuration, seed and outcomes give the same history everywhere. copy.copy and
    copy.deepcopy give independent learners that go on alike. One thread at a time.
    """
    @staticmethod
    def from_bytes(snapshot: bytes) -> Learner:
        """
        The learner in a snapshot's bytes. Raises FileError.
        """
    @staticmethod
    def from_memory(
        memory: devlearn._types.LearnerMemory,
        config: LearnerConfig | None = None,
        seed: typing.SupportsIndex = 0,
    ) -> Learner:
        """
        A learner that remembers what the arrays of a LearnerMemory say, which are copied; its draws begin anew from the seed. Raises InvalidValue where they break a law: lists that do not partition M, unexplored motions out of order, orientations outside [1e-12, 1] or whose sum is not 1 within 1e-9, counts below 1, a situation twice, other types or shapes.
        """
    @staticmethod
    def load(path: typing.Any) -> Learner:
        """
        The learner in a snapshot; it goes on equal to the bit. Raises FileError, saying what is wrong with the file.
        """
    def __copy__(self) -> typing.Any: ...
    def __deepcopy__(self, memo: dict[str, typing.Any]) -> typing.Any: ...
    def __getstate__(self) -> tuple[bytes, typing.Any]: ...
    def __init__(
        self, config: LearnerConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def _repr_html_(self) -> str:
        """
        For notebooks.
        """
    def best(self, situation: typing.SupportsIndex) -> int | None:
        """
        The effective motion of highest orientation, the first among equals; None where none is effective. Draws and changes nothing.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not executed; nothing is learned. Raises InvalidValue where none waits.
        """
    def choose(
        self,
        situation: typing.SupportsIndex,
        allowed: collections.abc.Sequence[bool] | numpy.typing.NDArray[numpy.bool_] | None = None,
    ) -> devlearn._types.Choice:
        """
        Step 3: chooses a motion, among those `allowed`: bools, one a motion (None: every one). The others are neither drawn nor explored nor won by. Raises InvalidValue for a negative situation, while an earlier choice waits for learn() or cancel(), where no motion is allowed, or for a situation that refuse_growth refuses.
        """
    def copy(self) -> typing.Any:
        """
        An independent learner that goes on alike.
        """
    def explain(
        self,
        situation: typing.SupportsIndex,
        allowed: collections.abc.Sequence[bool] | numpy.typing.NDArray[numpy.bool_] | None = None,
    ) -> Explanation:
        """
        Why motions are chosen in a situation as it is now, of all or of those allowed: an Explanation. Changes nothing.
        """
    def forget(self, situation: typing.SupportsIndex) -> bool:
        """
        Forgets a situation, as if it had never been experienced; whether there was anything to forget. The last one takes its place in the order of situations. Raises InvalidValue for a negative situation, or while a choice waits in it.
        """
    def learn(
        self,
        smf: typing.SupportsFloat | typing.SupportsIndex,
        motion: typing.SupportsIndex | None = None,
    ) -> devlearn._types.Development:
        """
        Steps 4-5: learns from the chosen motion's SMF (finite; >= 0 means effective), or from that of the `motion` that really ran. Raises InvalidValue where no choice waits.
        """
    def memory(self) -> devlearn._types.LearnerMemory:
        """
        All that it remembers, as a LearnerMemory: a tuple of arrays, which are copies.
        """
    def refuse_growth(self, refuse: bool = True) -> None:
        """
        Whether situations beyond the room are refused (by choose and update, with InvalidValue; nothing has changed then) instead of room being made, which for a million of them takes a fifth of a second. Not part of a snapshot.
        """
    def reserve(self, situations: typing.SupportsIndex, touch: bool = False) -> None:
        """
        Makes room for so many situations in all; touch: and takes the memory from the system now, so that no later call waits for it.
        """
    def save(self, path: typing.Any) -> None:
        """
        Writes a snapshot (safetensors layout): to the side first, flushed, then renamed. Raises FileError.
        """
    def situation(self, situation: typing.SupportsIndex) -> SituationMemory:
        """
        A situation's lists, as a copy; of one never experienced every motion is unexplored. Creates nothing.
        """
    def situations(self) -> numpy.ndarray:
        """
        Ids of the situations experienced, in that order: an int64 array.
        """
    def to_bytes(self) -> bytes:
        """
        The snapshot as bytes.
        """
    def update(
        self,
        situation: typing.SupportsIndex,
        motion: typing.SupportsIndex,
        smf: typing.SupportsFloat | typing.SupportsIndex,
    ) -> devlearn._types.Development:
        """
        Learns about any situation and motion, whoever chose: delayed outcomes, several robots, replay. A waiting choice goes on waiting. Raises InvalidValue.
        """
    @property
    def config(self) -> LearnerConfig:
        """
        Its parameters.
        """
    @property
    def effective_count(self) -> int:
        """
        NUM_M: mappings now effective.
        """
    @property
    def explored_count(self) -> int:
        """
        NUM_RM: mappings explored so far.
        """
    @property
    def last_choice(self) -> ChoiceTrace | None:
        """
        Why the last choice came out as it did, learned from or not: a ChoiceTrace; None before the first one since the learner was made or loaded.
        """
    @property
    def memory_use(self) -> MemoryUse:
        """
        Bytes used and spare, a MemoryUse.
        """
    @property
    def pending(self) -> devlearn._types.Choice | None:
        """
        The choice that waits for its outcome, or None.
        """
    @property
    def room(self) -> int:
        """
        For how many situations there is room.
        """
    @property
    def seed(self) -> int:
        """
        The seed it began with.
        """
    @property
    def situations_experienced(self) -> int:
        """
        How many situations were experienced.
        """

class AdaptiveConfig:
    """
    The adaptive learner's parameters. Costs are in the caller's unit; in a trial a step costs 1.

    Raises InvalidValue.

    Parameters
    ----------
    motion_count
        N_M: number of motions; a whole number in [1, 65535].
    optimism
        w: what an untried motion promises: the goal at w times the estimate; in [1, 10].
    hold_limit
        Steps after which a held motion is chosen anew though the situation is the same; 1: motions
        are not held; a whole number in [1, 1000000].
    recollections
        Mappings that are recalled after each decision; a whole number in [0, 1000000].
    patience
        Rounds that bring nothing better until the best one is a habit; a whole number in [0,
        1000000].
    gain
        What a deviation from the habit must save; in [0, 1e+06].
    tolerance
        Share by which a round by habit may cost more before the habit is given up; where there is
        noise, above 0; in [0, 1e+06].
    detour
        What a deviation may cost beyond the habit before the round goes on by values; in [0,
        1e+09].
    enough
        Times the least cost of a round, after which a round goes home by what is known; in [1,
        1e+09].
    refine
        Whether optimism falls where no deviation from the habit promises more, and a round that
        deviated goes on by values, not by habit; true or false.
    curious_every
        Rounds by habit between two looks for what has opened; 0: never; a whole number in [0,
        1000000].
    stale_after
        Rounds after which a motion that was interrupted may be worth another trial; a whole number
        in [1, 1000000000].
    sweep_limit
        Mappings that a call visits at most in a sweep over all that are known, which then takes
        several calls; 0: no limit; a whole number in [0, 2147483647].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> AdaptiveConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        motion_count: typing.SupportsIndex = 5,
        optimism: typing.SupportsFloat | typing.SupportsIndex = 1.1,
        hold_limit: typing.SupportsIndex = 20,
        recollections: typing.SupportsIndex = 20,
        patience: typing.SupportsIndex = 10,
        gain: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        detour: typing.SupportsFloat | typing.SupportsIndex = 20.0,
        enough: typing.SupportsFloat | typing.SupportsIndex = 3.0,
        refine: bool = True,
        curious_every: typing.SupportsIndex = 0,
        stale_after: typing.SupportsIndex = 100,
        sweep_limit: typing.SupportsIndex = 0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> AdaptiveConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def curious_every(self) -> int:
        """
        Rounds by habit between two looks for what has opened; 0: never; a whole number in [0, 1000000].
        """
    @property
    def detour(self) -> float:
        """
        What a deviation may cost beyond the habit before the round goes on by values; in [0, 1e+09].
        """
    @property
    def enough(self) -> float:
        """
        Times the least cost of a round, after which a round goes home by what is known; in [1, 1e+09].
        """
    @property
    def gain(self) -> float:
        """
        What a deviation from the habit must save; in [0, 1e+06].
        """
    @property
    def hold_limit(self) -> int:
        """
        Steps after which a held motion is chosen anew though the situation is the same; 1: motions are not held; a whole number in [1, 1000000].
        """
    @property
    def motion_count(self) -> int:
        """
        N_M: number of motions; a whole number in [1, 65535].
        """
    @property
    def optimism(self) -> float:
        """
        w: what an untried motion promises: the goal at w times the estimate; in [1, 10].
        """
    @property
    def patience(self) -> int:
        """
        Rounds that bring nothing better until the best one is a habit; a whole number in [0, 1000000].
        """
    @property
    def recollections(self) -> int:
        """
        Mappings that are recalled after each decision; a whole number in [0, 1000000].
        """
    @property
    def refine(self) -> bool:
        """
        Whether optimism falls where no deviation from the habit promises more, and a round that deviated goes on by values, not by habit; true or false.
        """
    @property
    def stale_after(self) -> int:
        """
        Rounds after which a motion that was interrupted may be worth another trial; a whole number in [1, 1000000000].
        """
    @property
    def sweep_limit(self) -> int:
        """
        Mappings that a call visits at most in a sweep over all that are known, which then takes several calls; 0: no limit; a whole number in [0, 2147483647].
        """
    @property
    def tolerance(self) -> float:
        """
        Share by which a round by habit may cost more before the habit is given up; where there is noise, above 0; in [0, 1e+06].
        """

class AdaptiveMemory:
    """
    What one situation holds, as a copy. The three lists of motion indices are views of the
    losses: no outcome yet, expected loss at most E, more than E. N motions.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def effective(self) -> list[int]:
        """
        M_i: tried, q at most E.
        """
    @property
    def expected_loss(self) -> float:
        """
        E: on the way to the goal, beyond the estimate.
        """
    @property
    def first_estimate(self) -> float:
        """
        h: the estimate at the first meeting.
        """
    @property
    def ineffective(self) -> list[int]:
        """
        Tried, q more than E.
        """
    @property
    def losses(self) -> list[float]:
        """
        N values: q of each motion.
        """
    @property
    def times(self) -> list[int]:
        """
        N values: outcomes remembered of each.
        """
    @property
    def unexplored(self) -> list[int]:
        """
        RM_i: not tried yet.
        """

class Recollection:
    """
    What one recollection changed.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def expected(self) -> float:
        """
        E, after it.
        """
    @property
    def expected_before(self) -> float:
        """
        E of the situation.
        """
    @property
    def loss(self) -> float:
        """
        q, after it.
        """
    @property
    def loss_before(self) -> float:
        """
        q of the mapping.
        """
    @property
    def motion(self) -> int:
        """
        Of the mapping recalled.
        """
    @property
    def situation(self) -> int:
        """
        Of the mapping recalled.
        """

class AdaptiveExplanation:
    """
    Why a motion is chosen in a situation, by an AdaptiveLearner. Motions are -1 where there is
    none. str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    def _repr_html_(self) -> str:
        """
        For notebooks.
        """
    @property
    def allowed(self) -> list[bool]:
        """
        N bools: whether each motion may be chosen.
        """
    @property
    def deviation(self) -> int:
        """
        The one by which this round is to deviate from the habit here.
        """
    @property
    def habit(self) -> int:
        """
        The habit's here, where this round goes by habit.
        """
    @property
    def held(self) -> int:
        """
        The motion that is held here.
        """
    @property
    def homeward(self) -> bool:
        """
        Whether this round goes home by what is known.
        """
    @property
    def kind(self) -> Kind:
        """
        What the choice goes by, or went by: a Kind; UNSTATED where a draw is to decide that.
        """
    @property
    def memory(self) -> AdaptiveMemory:
        """
        Lists and losses.
        """
    @property
    def motion(self) -> int:
        """
        What it was, where it was made; before, what it will be where there is nothing to draw.
        """
    @property
    def probability(self) -> list[float]:
        """
        N values: of each to be chosen by values.
        """
    @property
    def recollections(self) -> list[Recollection]:
        """
        What those of the last decision changed, at most 1000.
        """
    @property
    def situation(self) -> int:
        """
        The situation's id.
        """

class AdaptiveLearner:
    """
    A learner with an adaptive SEF, -(Phi + E): the estimate of the cost to go, corrected by
    what was experienced.

        learner = AdaptiveLearner(AdaptiveConfig(motion_count=4), seed=1)
        learner.begin_round()
        while not arrived:
            motion = learner.choose(situation, estimate).motion
            ...make one step of it...
            learner.learn(cost, next, next_estimate)   # estimate 0: the goal
        learner.end_round(True)

    The estimate is the caller's guess of the cost to go: linear in the distance, 0 at the goal
    and nowhere else. Without rounds there are no habits. The same configuration, seed and
    outcomes give the same history everywhere. One thread at a time.
    """
    @staticmethod
    def from_bytes(snapshot: bytes) -> AdaptiveLearner:
        """
        The learner in a snapshot's bytes. Raises FileError.
        """
    @staticmethod
    def load(path: typing.Any) -> AdaptiveLearner:
        """
        The learner in a snapshot; it goes on equal to the bit. Raises FileError, saying what is wrong with the file.
        """
    def __copy__(self) -> typing.Any: ...
    def __deepcopy__(self, memo: dict[str, typing.Any]) -> typing.Any: ...
    def __getstate__(self) -> tuple[bytes, typing.Any]: ...
    def __init__(
        self, config: AdaptiveConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def _repr_html_(self) -> str:
        """
        For notebooks.
        """
    def begin_round(self) -> None:
        """
        A round begins, where its first step is made; an open decision is dropped.
        """
    def best(self, situation: typing.SupportsIndex) -> int | None:
        """
        The tried motion of least expected loss, the first among equals; None where none was tried. Draws and changes nothing.
        """
    def cancel(self) -> None:
        """
        The waiting choice is not made: as the first of its decision nothing happened; later, the decision ends as interrupted. Raises InvalidValue where none waits.
        """
    def choose(
        self,
        situation: typing.SupportsIndex,
        estimate: typing.SupportsFloat | typing.SupportsIndex,
        allowed: collections.abc.Sequence[bool] | numpy.typing.NDArray[numpy.bool_] | None = None,
    ) -> devlearn._types.Choice:
        """
        The motion for the next step: the one that is held, or a new decision, among those `allowed`: bools, one a motion (None: every one). estimate: of the cost to go, in [0, 1e12]. Raises InvalidValue, likewise while a choice waits for learn() or cancel().
        """
    def copy(self) -> typing.Any:
        """
        An independent learner that goes on alike.
        """
    def end_round(self, arrived: bool) -> None:
        """
        A round ends, at the goal or not; one without a step counts for nothing. Raises InvalidValue where none has begun.
        """
    def expected_loss(self, situation: typing.SupportsIndex) -> float | None:
        """
        E of a situation; None where it was never met.
        """
    def explain(
        self,
        situation: typing.SupportsIndex,
        allowed: collections.abc.Sequence[bool] | numpy.typing.NDArray[numpy.bool_] | None = None,
    ) -> AdaptiveExplanation:
        """
        Why a motion would be chosen in a situation as it is now: an AdaptiveExplanation. Changes nothing.
        """
    def forget(self, situation: typing.SupportsIndex) -> bool:
        """
        Forgets the outcomes of a situation's motions; whether it was ever met. Those that lead there stay; a habit through it is dropped. Raises InvalidValue for a negative situation, or while a decision is open in it.
        """
    def learn(
        self,
        cost: typing.SupportsFloat | typing.SupportsIndex,
        next: typing.SupportsIndex,
        next_estimate: typing.SupportsFloat | typing.SupportsIndex,
        interrupted: bool = False,
    ) -> devlearn._types.Development:
        """
        What that step came to: its cost in [0, 1e12], and where it led; next_estimate 0 is the goal. interrupted: the motion cannot be held (the body touched something). The Development tells an event at the end of a decision. Raises InvalidValue.
        """
    def reserve(self, situations: typing.SupportsIndex, outcomes: typing.SupportsIndex) -> None:
        """
        Makes room for so many in all, so that up to then nothing is allocated.
        """
    def save(self, path: typing.Any) -> None:
        """
        Writes a snapshot (safetensors layout): to the side first, flushed, then renamed. Raises FileError.
        """
    def situation(self, situation: typing.SupportsIndex) -> AdaptiveMemory:
        """
        A situation's lists and losses, an AdaptiveMemory; of one never met every motion is unexplored. Creates nothing.
        """
    def situations(self) -> numpy.ndarray:
        """
        Ids of the situations met, in that order: an int64 array.
        """
    def to_bytes(self) -> bytes:
        """
        The snapshot as bytes.
        """
    def update(
        self,
        situation: typing.SupportsIndex,
        motion: typing.SupportsIndex,
        cost: typing.SupportsFloat | typing.SupportsIndex,
        next: typing.SupportsIndex,
        next_estimate: typing.SupportsFloat | typing.SupportsIndex,
        estimate: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> devlearn._types.Development:
        """
        An outcome whoever made it: of a decision by `motion` in `situation` that cost so much and led to `next`. estimate: where the decision was made (None: what it was at the first meeting). The open decision, round and habit stay. Raises InvalidValue.
        """
    @property
    def config(self) -> AdaptiveConfig:
        """
        Its parameters.
        """
    @property
    def effective_count(self) -> int:
        """
        NUM_M: of these, the ones whose loss is at most E.
        """
    @property
    def explored_count(self) -> int:
        """
        NUM_RM: mappings with an outcome.
        """
    @property
    def habit_cost(self) -> float | None:
        """
        What the habit costs; None where there is none.
        """
    @property
    def in_round(self) -> bool:
        """
        Whether a round is under way: begun, and neither ended nor gone on with from the goal.
        """
    @property
    def last_choice(self) -> AdaptiveExplanation | None:
        """
        Why the last decision came out as it did: an AdaptiveExplanation; None before the first one since the learner was made or loaded.
        """
    @property
    def memory_use(self) -> MemoryUse:
        """
        Bytes used and spare, a MemoryUse.
        """
    @property
    def optimism(self) -> float:
        """
        w, as it has fallen.
        """
    @property
    def outcomes(self) -> int:
        """
        How many are remembered.
        """
    @property
    def pending(self) -> devlearn._types.Choice | None:
        """
        The choice that waits for its step, or None.
        """
    @property
    def seed(self) -> int:
        """
        The seed it began with.
        """
    @property
    def situations_experienced(self) -> int:
        """
        How many situations were met.
        """

class Circle:
    """
    A round obstacle: center (x, y) [m], radius in [0.01, 1000] m.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self,
        center: collections.abc.Sequence[float],
        radius: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def center(self) -> tuple[float, float]:
        """
        (x, y) [m]
        """
    @property
    def radius(self) -> float:
        """
        [m]
        """

class Rectangle:
    """
    A rectangular obstacle: center (x, y) [m], size (width, height) in [0.01, 1000] m, turned by `angle` degrees counter-clockwise.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self,
        center: collections.abc.Sequence[float],
        size: collections.abc.Sequence[float],
        angle: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def angle(self) -> float:
        """
        [degrees]
        """
    @property
    def center(self) -> tuple[float, float]:
        """
        (x, y) [m]
        """
    @property
    def size(self) -> tuple[float, float]:
        """
        (width, height) [m]
        """

class Polygon:
    """
    An obstacle of any simple outline, convex or not: at least 3 corners (x, y) [m] in either direction, neighbours at least 0.01 m apart. Its holes, each such a list of corners inside the outline, apart from it and from each other, are free.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self,
        corners: collections.abc.Sequence[collections.abc.Sequence[float]],
        holes: collections.abc.Sequence[
            collections.abc.Sequence[collections.abc.Sequence[float]]
        ] = [],
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def corners(self) -> list[tuple[float, float]]:
        """
        (x, y) of each corner [m]
        """
    @property
    def holes(self) -> list[list[tuple[float, float]]]:
        """
        (x, y) of each corner of each hole [m]
        """

class Polyline:
    """
    A wall of no thickness: at least 2 points (x, y) [m], neighbours at least 0.01 m apart. It may cross itself, and is closed if it ends where it begins.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self, points: collections.abc.Sequence[collections.abc.Sequence[float]]
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def points(self) -> list[tuple[float, float]]:
        """
        (x, y) of each point [m]
        """

class MoverPath:
    """
    A way along 2 to 10 000 points (x, y) [m], neighbours at least 0.01 m apart, at one speed in
    (0, 1] m/s. What comes after the last point: 'back' (the same way back to the first, and so
    on), 'around' (straight to the first, and around again) or 'stop'. Raises InvalidValue.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self,
        points: collections.abc.Sequence[collections.abc.Sequence[float]],
        speed: typing.SupportsFloat | typing.SupportsIndex,
        then: str = "back",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def points(self) -> list[tuple[float, float]]:
        """
        (x, y) of each [m]
        """
    @property
    def speed(self) -> float:
        """
        [m/s]
        """
    @property
    def then(self) -> str:
        """
        'back', 'around' or 'stop'
        """

class MoverWalk:
    """
    A walk by random waypoints: every leg_time seconds a new point, uniform in the box from
    low (x, y) to high (x, y) [m]; straight and evenly from one to the next, at most at 1 m/s:
    leg_time in [0.1, 1e6] s is at least what the box's diagonal takes then. Raises
    InvalidValue.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(
        self,
        seed: typing.SupportsIndex,
        low: collections.abc.Sequence[float],
        high: collections.abc.Sequence[float],
        leg_time: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def high(self) -> tuple[float, float]:
        """
        Its corner of greatest x and y [m]
        """
    @property
    def leg_time(self) -> float:
        """
        From point to point [s]
        """
    @property
    def low(self) -> tuple[float, float]:
        """
        The box's corner of least x and y [m]
        """
    @property
    def seed(self) -> int:
        """
        Of the points.
        """

class Mover:
    """
    An obstacle that moves and does not turn: a Circle or Rectangle whose centre, which is
    given as (0, 0), goes along a MoverPath or MoverWalk from time 0 on. Raises InvalidValue.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __init__(self, shape: Circle | Rectangle, course: MoverPath | MoverWalk) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    @property
    def course(self) -> MoverPath | MoverWalk:
        """
        A MoverPath or MoverWalk.
        """
    @property
    def shape(self) -> Circle | Rectangle:
        """
        A Circle or Rectangle about (0, 0).
        """

class World:
    """
    An arena with walls, obstacles, a start and a target; checked once, then unchanging.

    Parameters: width, height of the arena in [0.5, 1000] m; start (x, y, heading) and target
    (x, y) inside it and outside every obstacle, in metres and degrees; obstacles, a list of
    Circle, Rectangle, Polygon and Polyline; origin (x, y), the arena's corner of least x and
    y, each within 100 000 m of 0; movers, a list of Mover, which go through obstacles, walls
    and each other, but not over the start. Where these are is a pure function of time [s], from
    0 to 1e9. Raises InvalidValue.
    """
    @staticmethod
    def from_json(text: str) -> World:
        """
        The world in JSON text. Raises FileError.
        """
    @staticmethod
    def from_ros_map(
        yaml: typing.Any,
        start: collections.abc.Sequence[float] | None = None,
        target: collections.abc.Sequence[float] | None = None,
        unknown: str = "occupied",
        tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None,
        seed: typing.SupportsIndex = 0,
        radius: typing.SupportsFloat | typing.SupportsIndex = 0.1,
    ) -> World:
        """
        The world in a map of ROS's map_server: its YAML, with a PGM or PNG, in the map's own
        frame. start (x, y, heading) and target (x, y), where None drawn by `seed`, with a way
        between them for a robot of `radius` [m]. unknown: what cells are of which the map does
        not know, 'occupied', 'free' or 'border' (occupied where they touch free ones). Outlines
        lie within `tolerance` [m] of those traced; None: half a cell. Needs the extra `maps`;
        docs/maps.md tells all, devlearn.maps.import_ros_map what was made of a map. Raises
        FileError, InvalidValue.
        """
    @staticmethod
    def load(path_or_name: typing.Any) -> World:
        """
        The world in a JSON file, or one that ships by its name (see devlearn.worlds()). Raises FileError, naming file and field.
        """
    @staticmethod
    def random(
        kind: str,
        seed: typing.SupportsIndex,
        *,
        difficulty: typing.SupportsFloat | typing.SupportsIndex = 0.5,
    ) -> World:
        """
        A world of 5 m x 5 m drawn by chance, the same on every machine, in which the robot of
        the paper has a way from start to target. kind: 'similar' (to Fig. 2), 'clutter',
        'corridors', 'rooms' or 'traps'. difficulty in [0, 1]: what it means for each kind is
        in docs/worlds.md. Raises InvalidValue.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        width: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        height: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        start: collections.abc.Sequence[float] = (0.5, 0.5, 0.0),
        target: collections.abc.Sequence[float] = (4.5, 4.5),
        obstacles: collections.abc.Sequence[Circle | Rectangle | Polygon | Polyline] = [],
        name: str = "",
        description: str = "",
        origin: collections.abc.Sequence[float] = (0.0, 0.0),
        movers: collections.abc.Sequence[Mover] = [],
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def _repr_svg_(self) -> str:
        """
        For notebooks.
        """
    @typing.overload
    def clearance(
        self,
        x: typing.SupportsFloat | typing.SupportsIndex,
        y: typing.SupportsFloat | typing.SupportsIndex,
        walls_count: bool = False,
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> float:
        """
        d_o: least distance from a point to an obstacle's surface at a time [m], 0 inside one, inf where there is none; with walls_count the walls count too. Numbers or arrays of points. Raises InvalidValue for what is not finite.
        """
    @typing.overload
    def clearance(
        self,
        x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        walls_count: bool = False,
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> typing.Any: ...
    def movers_at(
        self, time: typing.SupportsFloat | typing.SupportsIndex
    ) -> list[Circle | Rectangle | Polygon | Polyline]:
        """
        The movers where they are at a time [s], as a list of Circle and Rectangle. Raises InvalidValue.
        """
    def save(self, path: typing.Any) -> None:
        """
        Writes to_json() to a file, atomically. Raises FileError.
        """
    def standing(self) -> World:
        """
        The same world without its movers.
        """
    def to_json(self) -> str:
        """
        JSON text that from_json reads back as an equal world.
        """
    def with_start(self, start: collections.abc.Sequence[float]) -> World:
        """
        The same world with another start (x, y, heading). Raises InvalidValue.
        """
    @property
    def description(self) -> str:
        """
        For people.
        """
    @property
    def hash(self) -> str:
        """
        SHA-256 of to_json(), in hexadecimal.
        """
    @property
    def height(self) -> float:
        """
        [m]
        """
    @property
    def movers(self) -> list[Mover]:
        """
        Mover, as a list.
        """
    @property
    def name(self) -> str:
        """
        For people.
        """
    @property
    def obstacles(self) -> list[Circle | Rectangle | Polygon | Polyline]:
        """
        Circle, Rectangle, Polygon and Polyline, as a list.
        """
    @property
    def origin(self) -> tuple[float, float]:
        """
        The arena's corner of least x and y, (x, y) [m]
        """
    @property
    def start(self) -> devlearn._types.Pose:
        """
        Pose [m, m, degrees]
        """
    @property
    def target(self) -> tuple[float, float]:
        """
        (x, y) [m]
        """
    @property
    def width(self) -> float:
        """
        [m]
        """

class RobotDef:
    """
    The robot of Fig. 1: a circle on two wheels that turns, then drives forward.

    Raises InvalidValue.

    Parameters
    ----------
    radius
        r: radius of the body; in [0.01, 10] m.
    speed
        v: speed of the drive; in (0, 10] m/s.
    sample_time
        t_s: how long a step's drive lasts, and its turn by Eq. 2; v t_s is at most 1 m; in (0, 10]
        s.
    track
        Distance between the wheels in Eq. 2; none for the radius, as printed; in (0, 10] m, or
        none.
    steering_angles
        M: the motions: by how much each turns, counter-clockwise; 1 ... 65535 numbers, each in
        [-360, 360] degrees.
    sonar_count
        Number of sonars; a whole number in [0, 720].
    sonar_fov
        The sonars' field of view about the heading; in [0, 360] degrees.
    sonar_range
        How far a sonar hears, from the body's rim; in [0.01, 100] m.
    sonar_beam
        How wide a sonar's cone is; 0: a single ray; in [0, 90] degrees.
    sonar_rays
        How many rays make a cone, evenly over it; the nearest echo is heard; a whole number in [2,
        181].
    sonar_specular
        Greatest angle between a ray and a surface's normal at which there is an echo; beyond, the
        sound is thrown elsewhere; in (0, 90] degrees.
    sonar_least_range
        Nearer echoes are told as this far; in [0, 100] m.
    sonar_blind_time
        How long after its ping a sonar is deaf, in air: echoes from nearer than 171.5 m/s times it
        are not heard; in [0, 1] s.
    safety_margin
        What a safety layer keeps between body and obstacles: motions that would lead nearer are not
        allowed; none for no such layer; in (0, 10] m, or none.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> RobotDef:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    @staticmethod
    def load(path: typing.Any) -> RobotDef:
        """
        The robot in a JSON file, an object of these fields (robot.schema.json); those left out keep their defaults. Raises FileError.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        speed: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        sample_time: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        track: typing.SupportsFloat | typing.SupportsIndex | None = None,
        steering_angles: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = (
            -60.0,
            -30.0,
            0.0,
            30.0,
            60.0,
        ),
        sonar_count: typing.SupportsIndex = 5,
        sonar_fov: typing.SupportsFloat | typing.SupportsIndex = 180.0,
        sonar_range: typing.SupportsFloat | typing.SupportsIndex = 2.0,
        sonar_beam: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        sonar_rays: typing.SupportsIndex = 5,
        sonar_specular: typing.SupportsFloat | typing.SupportsIndex = 90.0,
        sonar_least_range: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        sonar_blind_time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        safety_margin: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def _repr_svg_(self) -> str:
        """
        For notebooks.
        """
    def replace(self, **kwargs: typing.Any) -> RobotDef:
        """
        A copy with some fields changed.
        """
    def sonar_angles(self) -> list[float]:
        """
        Where each sonar looks, relative to the heading, from right to left [degrees].
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def radius(self) -> float:
        """
        r: radius of the body; in [0.01, 10] m.
        """
    @property
    def safety_margin(self) -> float | None:
        """
        What a safety layer keeps between body and obstacles: motions that would lead nearer are not allowed; none for no such layer; in (0, 10] m, or none.
        """
    @property
    def sample_time(self) -> float:
        """
        t_s: how long a step's drive lasts, and its turn by Eq. 2; v t_s is at most 1 m; in (0, 10] s.
        """
    @property
    def sonar_beam(self) -> float:
        """
        How wide a sonar's cone is; 0: a single ray; in [0, 90] degrees.
        """
    @property
    def sonar_blind_time(self) -> float:
        """
        How long after its ping a sonar is deaf, in air: echoes from nearer than 171.5 m/s times it are not heard; in [0, 1] s.
        """
    @property
    def sonar_count(self) -> int:
        """
        Number of sonars; a whole number in [0, 720].
        """
    @property
    def sonar_fov(self) -> float:
        """
        The sonars' field of view about the heading; in [0, 360] degrees.
        """
    @property
    def sonar_least_range(self) -> float:
        """
        Nearer echoes are told as this far; in [0, 100] m.
        """
    @property
    def sonar_range(self) -> float:
        """
        How far a sonar hears, from the body's rim; in [0.01, 100] m.
        """
    @property
    def sonar_rays(self) -> int:
        """
        How many rays make a cone, evenly over it; the nearest echo is heard; a whole number in [2, 181].
        """
    @property
    def sonar_specular(self) -> float:
        """
        Greatest angle between a ray and a surface's normal at which there is an echo; beyond, the sound is thrown elsewhere; in (0, 90] degrees.
        """
    @property
    def speed(self) -> float:
        """
        v: speed of the drive; in (0, 10] m/s.
        """
    @property
    def steering_angles(self) -> list[float]:
        """
        M: the motions: by how much each turns, counter-clockwise; 1 ... 65535 numbers, each in [-360, 360] degrees.
        """
    @property
    def track(self) -> float | None:
        """
        Distance between the wheels in Eq. 2; none for the radius, as printed; in (0, 10] m, or none.
        """

class Robot:
    """
    The robot's body in a world: how it moves and what its sonars hear. A step is a pure function of (world, time, pose, motion). Times are the world's [s]: they say where its movers are.
    """
    def __deepcopy__(self, memo: dict[str, typing.Any]) -> typing.Any: ...
    def __init__(self, world: World, robot: RobotDef | None = None) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def _repr_svg_(self) -> str:
        """
        For notebooks.
        """
    def allowed(
        self,
        pose: collections.abc.Sequence[float],
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Which motions the robot can make from a pose, as its safety layer sees it: those that keep its body further than safety_margin from obstacles, walls and movers all along the way of Eq. 1. Where none does, or there is no such layer, every one. A bool array. Raises InvalidValue for a pose that is not finite.
        """
    def drive(
        self,
        pose: collections.abc.Sequence[float],
        turn: typing.SupportsFloat | typing.SupportsIndex,
        speed: typing.SupportsFloat | typing.SupportsIndex,
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> tuple[devlearn._types.Pose, bool]:
        """
        The same for any turn [degrees] and any speed of the drive from 0 m/s on, at most 1 m a step: what becomes of a motion that is not made exactly. Raises InvalidValue.
        """
    def drive_wheels(
        self,
        pose: collections.abc.Sequence[float],
        left: typing.SupportsFloat | typing.SupportsIndex,
        right: typing.SupportsFloat | typing.SupportsIndex,
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> tuple[devlearn._types.Pose, bool]:
        """
        The same at constant wheel speeds [m/s], forwards or backwards, their mean at most 1 m a step. What they ask for is an arc, of which the turn is (right - left) sample_time / track; the body turns by half of that and drives straight along the arc's chord. It always ends with the arc's heading and, where nothing is in the way, at the arc's end. Raises InvalidValue.
        """
    def sonar(
        self,
        pose: collections.abc.Sequence[float],
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> numpy.ndarray:
        """
        Echo distances from the body's rim, right to left [m]; sonar_range where nothing is heard. A float64 array of sonar_count values.
        """
    def step(
        self,
        pose: collections.abc.Sequence[float],
        motion: typing.SupportsIndex,
        time: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> tuple[devlearn._types.Pose, bool]:
        """
        (next pose, collided): Eq. 1 exactly where the way is free, Box2D where there is something to touch, or that pushes. Raises InvalidValue.
        """
    def turn_speeds(self, motion: typing.SupportsIndex) -> tuple[float, float]:
        """
        (left, right) wheel speeds of the turn, held for one sample time, Eq. 2 [m/s].
        """
    @property
    def definition(self) -> RobotDef:
        """
        Its RobotDef.
        """
    @property
    def drive_speeds(self) -> tuple[float, float]:
        """
        (left, right) wheel speeds of the drive, held for one sample time [m/s].
        """
    @property
    def world(self) -> World:
        """
        Its World.
        """

class ShortestPath:
    """
    The shortest way that the robot's own motions allow, or what is known of it: what shortest_path returns.
    """
    def __repr__(self) -> str: ...
    @property
    def exact(self) -> bool:
        """
        Whether `steps` is the least, or there is no way; False where the search gave up before it knew.
        """
    @property
    def lower_bound(self) -> int | None:
        """
        No way has fewer steps; None where there is no way at all.
        """
    @property
    def poses(self) -> numpy.ndarray:
        """
        (steps + 1, 3) [m, m, degrees], from the start to the first within goal_radius; empty where no way was found.
        """
    @property
    def steps(self) -> int | None:
        """
        Steps of the way; None where none was found.
        """

class Step:
    """
    Everything about one step of a trial.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def arrived(self) -> bool:
        """
        After the step: d_g <= goal_radius.
        """
    @property
    def clearance(self) -> float:
        """
        After the step: d_o [m].
        """
    @property
    def collided(self) -> bool:
        """
        Whether the body touched something during the step.
        """
    @property
    def cost(self) -> float:
        """
        Of the step: 1, and touch_cost more where it collided.
        """
    @property
    def effective_count(self) -> int:
        """
        After the step: NUM_M.
        """
    @property
    def event(self) -> Event:
        """
        What the outcome changed, an Event.
        """
    @property
    def explored_count(self) -> int:
        """
        After the step: NUM_RM.
        """
    @property
    def goal_distance(self) -> float:
        """
        After the step: d_g [m].
        """
    @property
    def kind(self) -> Kind:
        """
        Why it was chosen, a Kind.
        """
    @property
    def motion(self) -> int:
        """
        Index in M.
        """
    @property
    def pose(self) -> devlearn._types.Pose:
        """
        After the step [m, m, degrees].
        """
    @property
    def reduced(self) -> int:
        """
        Motions that reduction development removed.
        """
    @property
    def round(self) -> int:
        """
        The round the step belongs to, from 1.
        """
    @property
    def sef(self) -> float:
        """
        After the step: SEF(t+1).
        """
    @property
    def situation(self) -> int:
        """
        Before the step: S_i, in which the motion was chosen.
        """
    @property
    def smf(self) -> float:
        """
        SEF(t+1) - SEF(t), Eq. 8.
        """
    @property
    def smf_used(self) -> float:
        """
        What was learned from: min(smf, -1) for a collision.
        """
    @property
    def true_situation(self) -> int:
        """
        The situation that the robot was in; another one where its odometry errs.
        """
    @property
    def value(self) -> float | None:
        """
        After the step: cost to go as the agent expects it; NaN: it does not say.
        """

class Tally:
    """
    What a run came to, counted as its steps pass, where no record is kept of them.

    A trial's phases count into the one that they are given as `tally`, whatever their
    record holds; memory does not grow with steps. It is of one trial. ``rounds`` is a
    structured array, an entry a round, of

    =======================  =======  =================================================================================
    field                    dtype    meaning
    =======================  =======  =================================================================================
    ``round``                int32    its number in the trial, from 1
    ``steps``                int64    steps of it
    ``arrived``              bool     whether d_g <= goal_radius after one, or before the first in path learning
    ``first_arrival``        int64    which of the steps, from 1, was the first after which it was so; 0: none
    ``touches``              int64    steps that collided
    ``cost``                 float64  of all steps; NaN where that of one is not known
    ``path``                 uint64   fingerprint of the motions: equal motions, equal value
    ``explored``             int64    steps of kind explore
    ``known_ineffective``    int64    steps of a mapping that had smf_used < 0 when first executed, but for that one
    ``ineffective``          int64    steps with smf_used < 0
    ``updates``              int64    events extension, orientation and abandonment
    ``ineffective_updates``  int64    those with smf_used < 0
    ``mappings``             int64    different mappings executed by the end of the round
    ``explored_count``       int64    NUM_RM after the last step by then
    ``effective_count``      int64    NUM_M after the last step by then
    =======================  =======  =================================================================================

    A mapping is a situation and a motion executed in it. A round that goes on in another
    call is one entry, and each of its fields as if it had never been stopped.
    """
    @staticmethod
    def of(record: devlearn.record.Record) -> Tally:
        """
        That of a Record's steps, equal to what is counted as they pass. Raises InvalidValue for a record of rounds only.
        """
    def __init__(self) -> None:
        """
        One that holds nothing yet.
        """
    def __repr__(self) -> str: ...
    @property
    def rounds(self) -> numpy.ndarray:
        """
        A copy of what each round came to, a structured array.
        """
    @property
    def steps(self) -> int:
        """
        How many were counted.
        """

class Observation:
    """
    What an agent knows when it chooses.

    A trial makes it. So does, with what agents of devlearn's look at, a loop of one's own:
    situation, a whole number in [0, 2**63 - 1]; motion_count in [1, 65535]; estimate and sef,
    numbers; allowed, bools, one a motion (None: every one); senses, finite numbers (None: no
    such). What is left out is 0. Raises InvalidValue.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __init__(
        self,
        situation: typing.SupportsIndex,
        motion_count: typing.SupportsIndex,
        *,
        estimate: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        sef: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        allowed: collections.abc.Sequence[bool] | numpy.typing.NDArray[numpy.bool_] | None = None,
        senses: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] | None = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def allowed(self) -> numpy.typing.NDArray[numpy.bool] | None:
        """
        Of these, the motions that the robot can make: bools, one a motion; None for every one.
        """
    @property
    def clearance(self) -> float:
        """
        d_o [m]
        """
    @property
    def estimate(self) -> float:
        """
        Cost to go at the least, in steps: d_g / (v t_s), 0 at the target.
        """
    @property
    def goal_distance(self) -> float:
        """
        d_g [m]
        """
    @property
    def motion_count(self) -> int:
        """
        Choose one in 0 ... motion_count - 1.
        """
    @property
    def pose(self) -> devlearn._types.Pose:
        """
        [m, m, degrees]
        """
    @property
    def sef(self) -> float:
        """
        SEF here.
        """
    @property
    def senses(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        What a task senses, as numbers; None where there are none, as in a trial.
        """
    @property
    def situation(self) -> int:
        """
        The present situation's id.
        """

class Outcome:
    """
    What an agent is told about the motion it chose.

    A trial makes it; so does a loop of one's own: situation, a whole number in
    [0, 2**63 - 1]; cost, estimate, sef and smf, numbers; arrived and collided, bools; event, a
    whole number in [-1, 63]. Raises InvalidValue.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __init__(
        self,
        situation: typing.SupportsIndex,
        *,
        cost: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        estimate: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        arrived: bool = False,
        sef: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        smf: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        collided: bool = False,
        event: typing.SupportsIndex = -1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def arrived(self) -> bool:
        """
        d_g <= goal_radius.
        """
    @property
    def collided(self) -> bool:
        """
        Whether the body touched something.
        """
    @property
    def cost(self) -> float:
        """
        What the step cost: 1, and touch_cost more if it collided.
        """
    @property
    def estimate(self) -> float:
        """
        Cost to go from there, as in Observation.
        """
    @property
    def event(self) -> int:
        """
        The salient event that it was, in [0, 63], -1 for none. In a trial 0 is an arrival, and 1 a touch.
        """
    @property
    def reward(self) -> float:
        """
        -cost.
        """
    @property
    def sef(self) -> float:
        """
        SEF there.
        """
    @property
    def situation(self) -> int:
        """
        The next situation's id.
        """
    @property
    def smf(self) -> float:
        """
        SMF as learned from: min(SMF, -1) for a collision.
        """

class RandomAgent:
    """
    Uniformly random motions: what learning is measured against.
    """
    def __getstate__(self) -> tuple[typing.Annotated[list[int], "FixedSize(4)"], typing.Any]: ...
    def __init__(self, seed: typing.SupportsIndex = 0) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """

class QLearningConfig:
    """
    The settings of QLearning.

    Raises InvalidValue.

    Parameters
    ----------
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in [0, 1].
    epsilon
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
    first_value
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost
        to go; 'constant' or 'estimate'.
    initial_value
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
    shaping
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef'
        or 'estimate'.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> QLearningConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        first_value: str = "constant",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shaping: str = "none",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> QLearningConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
        """
    @property
    def first_value(self) -> str:
        """
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def initial_value(self) -> float:
        """
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
        """
    @property
    def shaping(self) -> str:
        """
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef' or 'estimate'.
        """

class QLearning:
    """
    Q-learning (Watkins 1989; Sutton & Barto 6.5), epsilon-greedy:

    Q(S, A) <- Q(S, A) + alpha (R + gamma max_a Q(S', a) - Q(S, A)).

    In a trial: Trial(world, agent=QLearning()). It is saved with its trial, pickled and copied.

    Parameters: config, a QLearningConfig, also QLearning.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = QLearningConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: QLearningConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> QLearningConfig:
        """
        Its settings.
        """

class ExpectedSarsaConfig:
    """
    The settings of ExpectedSarsa.

    Raises InvalidValue.

    Parameters
    ----------
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in [0, 1].
    epsilon
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
    first_value
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost
        to go; 'constant' or 'estimate'.
    initial_value
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
    shaping
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef'
        or 'estimate'.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> ExpectedSarsaConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        first_value: str = "constant",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shaping: str = "none",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> ExpectedSarsaConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
        """
    @property
    def first_value(self) -> str:
        """
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def initial_value(self) -> float:
        """
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
        """
    @property
    def shaping(self) -> str:
        """
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef' or 'estimate'.
        """

class ExpectedSarsa:
    """
    Expected SARSA (Sutton & Barto 6.6) under its epsilon-greedy policy pi:

    Q(S, A) <- Q(S, A) + alpha (R + gamma sum_a pi(a | S') Q(S', a) - Q(S, A)).

    In a trial: Trial(world, agent=ExpectedSarsa()). It is saved with its trial, pickled and copied.

    Parameters: config, a ExpectedSarsaConfig, also ExpectedSarsa.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = ExpectedSarsaConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: ExpectedSarsaConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> ExpectedSarsaConfig:
        """
        Its settings.
        """

class SarsaLambdaConfig:
    """
    The settings of SarsaLambda.

    Raises InvalidValue.

    Parameters
    ----------
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in [0, 1].
    epsilon
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
    first_value
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost
        to go; 'constant' or 'estimate'.
    initial_value
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
    shaping
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef'
        or 'estimate'.
    trace_decay
        lambda: trace-decay parameter: how far back an outcome is learned from; 0 is SARSA; in [0,
        1].
    traces
        What a visit makes of an eligibility trace: one more, or 1; 'accumulating' or 'replacing'.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> SarsaLambdaConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        first_value: str = "constant",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shaping: str = "none",
        trace_decay: typing.SupportsFloat | typing.SupportsIndex = 0.9,
        traces: str = "accumulating",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> SarsaLambdaConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
        """
    @property
    def first_value(self) -> str:
        """
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def initial_value(self) -> float:
        """
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
        """
    @property
    def shaping(self) -> str:
        """
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef' or 'estimate'.
        """
    @property
    def trace_decay(self) -> float:
        """
        lambda: trace-decay parameter: how far back an outcome is learned from; 0 is SARSA; in [0, 1].
        """
    @property
    def traces(self) -> str:
        """
        What a visit makes of an eligibility trace: one more, or 1; 'accumulating' or 'replacing'.
        """

class SarsaLambda:
    """
    SARSA(lambda), tabular and epsilon-greedy (Sutton & Barto 12.7); SARSA where trace_decay is
    0. A motion is learned about once the next one has run.

    In a trial: Trial(world, agent=SarsaLambda()). It is saved with its trial, pickled and copied.

    Parameters: config, a SarsaLambdaConfig, also SarsaLambda.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = SarsaLambdaConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: SarsaLambdaConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> SarsaLambdaConfig:
        """
        Its settings.
        """

class DynaQConfig:
    """
    The settings of DynaQ.

    Raises InvalidValue.

    Parameters
    ----------
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in [0, 1].
    epsilon
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
    first_value
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost
        to go; 'constant' or 'estimate'.
    initial_value
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
    shaping
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef'
        or 'estimate'.
    planning_steps
        n: steps of planning after each real one; a whole number in [0, 1000000].
    kappa
        kappa: bonus of Dyna-Q+: planning adds kappa sqrt(tau) to the reward of a motion not tried
        for tau steps; 0 is Dyna-Q; in [0, 1e+06].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> DynaQConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        first_value: str = "constant",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shaping: str = "none",
        planning_steps: typing.SupportsIndex = 10,
        kappa: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> DynaQConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
        """
    @property
    def first_value(self) -> str:
        """
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def initial_value(self) -> float:
        """
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
        """
    @property
    def kappa(self) -> float:
        """
        kappa: bonus of Dyna-Q+: planning adds kappa sqrt(tau) to the reward of a motion not tried for tau steps; 0 is Dyna-Q; in [0, 1e+06].
        """
    @property
    def planning_steps(self) -> int:
        """
        n: steps of planning after each real one; a whole number in [0, 1000000].
        """
    @property
    def shaping(self) -> str:
        """
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef' or 'estimate'.
        """

class DynaQ:
    """
    Tabular Dyna-Q (Sutton & Barto 8.2), epsilon-greedy: after each step of Q-learning,
    planning_steps more from what came of each motion when it was last tried. With kappa > 0
    Dyna-Q+ (8.3); then gamma should be below 1.

    In a trial: Trial(world, agent=DynaQ()). It is saved with its trial, pickled and copied.

    Parameters: config, a DynaQConfig, also DynaQ.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = DynaQConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: DynaQConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> DynaQConfig:
        """
        Its settings.
        """

class PrioritizedSweepingConfig:
    """
    The settings of PrioritizedSweeping.

    Raises InvalidValue.

    Parameters
    ----------
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in [0, 1].
    epsilon
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
    first_value
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost
        to go; 'constant' or 'estimate'.
    initial_value
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
    shaping
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef'
        or 'estimate'.
    planning_steps
        n: updates after each step, at most; a whole number in [0, 1000000].
    theta
        theta: what would change a value by no more than this is not queued; in [0, 1e+09].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> PrioritizedSweepingConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        first_value: str = "constant",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shaping: str = "none",
        planning_steps: typing.SupportsIndex = 10,
        theta: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> PrioritizedSweepingConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion instead of a greedy one; in [0, 1].
        """
    @property
    def first_value(self) -> str:
        """
        Q_0: Q of a situation when it is first met: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def initial_value(self) -> float:
        """
        Q of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
        """
    @property
    def planning_steps(self) -> int:
        """
        n: updates after each step, at most; a whole number in [0, 1000000].
        """
    @property
    def shaping(self) -> str:
        """
        Phi: potential by which rewards are shaped: none, SEF, or less the estimate; 'none' or 'sef' or 'estimate'.
        """
    @property
    def theta(self) -> float:
        """
        theta: what would change a value by no more than this is not queued; in [0, 1e+09].
        """

class PrioritizedSweeping:
    """
    Prioritized sweeping for a deterministic world (Moore & Atkeson 1993, as in Sutton & Barto
    8.4), epsilon-greedy: after each step at most planning_steps updates of Q-learning from what
    came of each motion when it was last tried, those first that change most.

    In a trial: Trial(world, agent=PrioritizedSweeping()). It is saved with its trial, pickled and copied.

    Parameters: config, a PrioritizedSweepingConfig, also PrioritizedSweeping.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = PrioritizedSweepingConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: PrioritizedSweepingConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> PrioritizedSweepingConfig:
        """
        Its settings.
        """
    @property
    def updates(self) -> int:
        """
        How many updates there have been.
        """

class LrtaStarConfig:
    """
    The settings of LrtaStar.

    Raises InvalidValue.

    Parameters
    ----------
    first_value
        -h of a situation when it is first met: initial_value, or less the estimate of the cost to
        go; 'constant' or 'estimate'.
    initial_value
        -h of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> LrtaStarConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        first_value: str = "estimate",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> LrtaStarConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def first_value(self) -> str:
        """
        -h of a situation when it is first met: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def initial_value(self) -> float:
        """
        -h of a situation when it is first met, where first_value is constant; in [-1e+09, 1e+09].
        """

class LrtaStar:
    """
    Learning real-time A* (Korf 1990): the motion of the least f(s, a) = cost + h(s'), of what
    each led to when it was last tried, and h(s) <- min_a f(s, a). h is first the estimate of
    the cost to go. A value is -f.

    In a trial: Trial(world, agent=LrtaStar()). It is saved with its trial, pickled and copied.

    Parameters: config, a LrtaStarConfig, also LrtaStar.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = LrtaStarConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: LrtaStarConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> LrtaStarConfig:
        """
        Its settings.
        """

class RMaxConfig:
    """
    The settings of RMax.

    Raises InvalidValue.

    Parameters
    ----------
    m
        m: times a motion is tried until it is known; a whole number in [1, 1000].
    gamma
        gamma: discount rate; in [0, 1].
    first_value
        Value of a motion that is not known: initial_value, or less the estimate of the cost to go;
        'constant' or 'estimate'.
    initial_value
        Value of a motion that is not known, where first_value is constant; in [-1e+09, 1e+09].
    theta
        theta: changes of a value by no more than this are not planned on with; in [1e-09, 1e+09].
    least_value
        Value of that from which nothing leads on; in [-1e+06, 0].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> RMaxConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        m: typing.SupportsIndex = 3,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        first_value: str = "estimate",
        initial_value: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        theta: typing.SupportsFloat | typing.SupportsIndex = 1e-06,
        least_value: typing.SupportsFloat | typing.SupportsIndex = -1000.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> RMaxConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def first_value(self) -> str:
        """
        Value of a motion that is not known: initial_value, or less the estimate of the cost to go; 'constant' or 'estimate'.
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def initial_value(self) -> float:
        """
        Value of a motion that is not known, where first_value is constant; in [-1e+09, 1e+09].
        """
    @property
    def least_value(self) -> float:
        """
        Value of that from which nothing leads on; in [-1e+06, 0].
        """
    @property
    def m(self) -> int:
        """
        m: times a motion is tried until it is known; a whole number in [1, 1000].
        """
    @property
    def theta(self) -> float:
        """
        theta: changes of a value by no more than this are not planned on with; in [1e-09, 1e+09].
        """

class RMax:
    """
    R-max (Brafman & Tennenholtz 2002): a motion is known in a situation once it was tried m
    times there; one that is not is worth its first value. The best plan under that is followed.

    In a trial: Trial(world, agent=RMax()). It is saved with its trial, pickled and copied.

    Parameters: config, a RMaxConfig, also RMax.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = RMaxConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: RMaxConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    def visits(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> int:
        """
        How often a motion was tried in a situation, at most m: then it is known. Raises InvalidValue.
        """
    @property
    def config(self) -> RMaxConfig:
        """
        Its settings.
        """

class ShortestPathAgent:
    """
    Follows the way that shortest_path finds from where the robot stands: with the map, the
    bound of what can be learned without one. It plans anew where it is off its way. At the
    target it makes the first motion that touches nothing.

    Parameters: robot, as the trial's, without a safety margin; goal_radius of the target, in
    (0, 100] m. Raises InvalidValue.
    """
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, robot: Robot, goal_radius: typing.SupportsFloat | typing.SupportsIndex = 0.1
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    @property
    def goal_radius(self) -> float:
        """
        Of the target [m].
        """

class IacRegion:
    """
    A region of the sensorimotor space of an Iac.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def above(self) -> int:
        """
        The other half; -1: none.
        """
    @property
    def below(self) -> int:
        """
        The half below that; -1: none.
        """
    @property
    def error(self) -> float:
        """
        <e>: the mean of its latest theta + 1 squared errors; NaN before the first.
        """
    @property
    def exemplars(self) -> int:
        """
        How many it holds.
        """
    @property
    def lower(self) -> list[float]:
        """
        What lies in it is not below these: a number for each of SM, first S, then M; -inf for no bound.
        """
    @property
    def parent(self) -> int:
        """
        The one that was split into this one and another; -1: none.
        """
    @property
    def progress(self) -> float:
        """
        L, Eq. 2.
        """
    @property
    def region(self) -> int:
        """
        Its number, in the order in which they came to be; 0 is the whole space.
        """
    @property
    def since(self) -> int:
        """
        How many exemplars had been learned when it came to be.
        """
    @property
    def split_dimension(self) -> int:
        """
        Where in SM it was split; -1: it was not.
        """
    @property
    def split_value(self) -> float:
        """
        At which value.
        """
    @property
    def upper(self) -> list[float]:
        """
        And below these; inf for no bound.
        """

class IacExplanation:
    """
    Why an Iac chooses motions for what is observed. str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    @property
    def allowed(self) -> list[bool]:
        """
        A bool a motion.
        """
    @property
    def probability(self) -> list[float]:
        """
        A number a motion: of being chosen; they sum to 1.
        """
    @property
    def progress(self) -> list[float]:
        """
        A number a motion: the progress that is expected, L of its region, Eq. 4.
        """
    @property
    def region(self) -> list[int]:
        """
        A number a motion: where it falls.
        """
    @property
    def regions(self) -> list[IacRegion]:
        """
        Each IacRegion in which a motion falls, by their number.
        """
    @property
    def senses(self) -> list[float]:
        """
        S(t), as it learns from it.
        """

class IacConfig:
    """
    The settings of Iac.

    Raises InvalidValue.

    Parameters
    ----------
    epsilon
        epsilon: probability of any motion instead of one of the most progress; in [0, 1].
    most_exemplars
        T: exemplars of a region, above which it is split; a whole number in [2, 100000].
    smoothing
        theta: a mean error is that of the latest theta + 1; a whole number in [0, 10000].
    window
        tau: progress is how much the mean error fell over so many errors; a whole number in [1,
        10000].
    neighbours
        k: nearest exemplars, of what followed which the mean is predicted; a whole number in [1,
        1000].
    most_regions
        Regions, above which none is split, and a full one forgets its oldest exemplar; a whole
        number in [1, 1000000].
    length
        What counts as 1 of places and distances in a trial; in [0.01, 1e+06] m.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> IacConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.35,
        most_exemplars: typing.SupportsIndex = 250,
        smoothing: typing.SupportsIndex = 25,
        window: typing.SupportsIndex = 15,
        neighbours: typing.SupportsIndex = 1,
        most_regions: typing.SupportsIndex = 1000,
        length: typing.SupportsFloat | typing.SupportsIndex = 5.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> IacConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of any motion instead of one of the most progress; in [0, 1].
        """
    @property
    def length(self) -> float:
        """
        What counts as 1 of places and distances in a trial; in [0.01, 1e+06] m.
        """
    @property
    def most_exemplars(self) -> int:
        """
        T: exemplars of a region, above which it is split; a whole number in [2, 100000].
        """
    @property
    def most_regions(self) -> int:
        """
        Regions, above which none is split, and a full one forgets its oldest exemplar; a whole number in [1, 1000000].
        """
    @property
    def neighbours(self) -> int:
        """
        k: nearest exemplars, of what followed which the mean is predicted; a whole number in [1, 1000].
        """
    @property
    def smoothing(self) -> int:
        """
        theta: a mean error is that of the latest theta + 1; a whole number in [0, 10000].
        """
    @property
    def window(self) -> int:
        """
        tau: progress is how much the mean error fell over so many errors; a whole number in [1, 10000].
        """

class Iac:
    """
    Intelligent adaptive curiosity (Oudeyer, Kaplan & Hafner 2007): it seeks the region of its
    sensorimotor space in which its predictions improve the most, and is not led by rewards.

    In a trial: Trial(world, agent=Iac()). It is saved with its trial, pickled and copied.

    Parameters: config, a IacConfig, also Iac.Config (None: the defaults); seed of its draws; motors, a matrix
    of numbers in [-1e9, 1e9], a row a motion (None: one number, from 0 of the first motion to 1
    of the last).
    Raises InvalidValue.
    """

    Config = IacConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self,
        config: IacConfig | None = None,
        seed: typing.SupportsIndex = 0,
        motors: list[list[typing.SupportsFloat | typing.SupportsIndex]]
        | typing.Annotated[numpy.typing.ArrayLike, numpy.float64]
        | None = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def explain(self, observation: Observation) -> IacExplanation:
        """
        Why motions are chosen for what is observed: an IacExplanation. Draws and changes nothing. Raises InvalidValue.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def predict(
        self, observation: Observation, motion: typing.SupportsIndex
    ) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        What will be sensed after a motion, by what is learned so far; None before the first exemplar. Raises InvalidValue.
        """
    def regions(self) -> typing.Any:
        """
        All regions that ever were, by their number: a structured array with the fields of an IacRegion.
        """
    def tree(self) -> str:
        """
        The regions as a text, each line below that of the region that it was split from.
        """
    @property
    def config(self) -> IacConfig:
        """
        Its settings.
        """
    @property
    def motors(self) -> typing.Any:
        """
        A copy of the matrix of motors; None where it is not needed yet.
        """

class ConditioningExplanation:
    """
    What devlearn.agents.OperantConditioning has come to in a situation. str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    @property
    def allowed(self) -> list[bool]:
        """
        N bools: whether each motion may be chosen.
        """
    @property
    def entropy(self) -> float:
        """
        Of all N probabilities, -sum p log2 p [bits].
        """
    @property
    def extinguished(self) -> list[int]:
        """
        N whole numbers: and was extinguished.
        """
    @property
    def last_motion(self) -> int:
        """
        The one last tried; -1 for none.
        """
    @property
    def last_reinforcement(self) -> int:
        """
        What came of it: 1 reinforced, -1 extinguished, 0 neither.
        """
    @property
    def mean_reward(self) -> float:
        """
        Of the rewards that came; 0 before the first.
        """
    @property
    def probability(self) -> list[float]:
        """
        N values: of each to be chosen; they sum to 1.
        """
    @property
    def reinforced(self) -> list[int]:
        """
        N whole numbers: and was reinforced.
        """
    @property
    def situation(self) -> int:
        """
        The situation's id.
        """
    @property
    def tried(self) -> list[int]:
        """
        N whole numbers: how often each was.
        """

class OperantConditioningConfig:
    """
    The settings of OperantConditioning.

    Raises InvalidValue.

    Parameters
    ----------
    reward_step
        a: step towards a motion that is reinforced; in (0, 1).
    penalty_step
        b: step away from a motion that is extinguished: as much as a in the scheme L_R-P, 0 in
        L_R-I, between them in L_R-eP; in [0, 1).
    reinforced_by
        What reinforces: SMF above 0, or a reward above the mean of those that came in the situation
        before; less extinguishes, and equal does neither; 'smf' or 'reward'.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> OperantConditioningConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        reward_step: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        penalty_step: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        reinforced_by: str = "smf",
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> OperantConditioningConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def penalty_step(self) -> float:
        """
        b: step away from a motion that is extinguished: as much as a in the scheme L_R-P, 0 in L_R-I, between them in L_R-eP; in [0, 1).
        """
    @property
    def reinforced_by(self) -> str:
        """
        What reinforces: SMF above 0, or a reward above the mean of those that came in the situation before; less extinguishes, and equal does neither; 'smf' or 'reward'.
        """
    @property
    def reward_step(self) -> float:
        """
        a: step towards a motion that is reinforced; in (0, 1).
        """

class OperantConditioning:
    """
    Operant conditioning as a one-to-one mapping, a learning automaton of linear reward and
    penalty in each situation (Narendra & Thathachar 1974): a probability for each of N motions.
    Where motion i is reinforced, p_i grows by a (1 - p_i) and the others shrink by a p_j; where
    it is extinguished, p_i shrinks by b p_i and the others grow by b (1 / (N - 1) - p_j).

    In a trial: Trial(world, agent=OperantConditioning()). It is saved with its trial, pickled and copied.

    Parameters: config, a OperantConditioningConfig, also OperantConditioning.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = OperantConditioningConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: OperantConditioningConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def entropy(self, situation: typing.SupportsIndex) -> float | None:
        """
        Entropy of a situation's probabilities, -sum p log2 p, in [0, log2 N] bits; None for a situation never met. Raises InvalidValue.
        """
    def explain(
        self,
        situation: typing.SupportsIndex,
        allowed: collections.abc.Sequence[bool] | numpy.typing.NDArray[numpy.bool_] | None = None,
    ) -> ConditioningExplanation | None:
        """
        What it has come to in a situation, of all motions or of those allowed: a ConditioningExplanation; None for a situation never met. Changes nothing. Raises InvalidValue.
        """
    def mean_entropy(self) -> float | None:
        """
        The mean of that over all situations met; None before the first.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def probability(
        self, situation: typing.SupportsIndex, motion: typing.SupportsIndex
    ) -> float | None:
        """
        The probability of a motion in a situation where all are allowed; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> OperantConditioningConfig:
        """
        Its settings.
        """

class OptionView:
    """
    An option, as it stands in a situation.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    @property
    def available(self) -> bool:
        """
        Whether it can be begun here.
        """
    @property
    def event(self) -> int:
        """
        The salient event that it leads to, 0 ... 63.
        """
    @property
    def intrinsic(self) -> float:
        """
        Intrinsic reward of its event now, where it comes in the likeliest way.
        """
    @property
    def motion(self) -> int:
        """
        What it does first, the first among equals; -1 where it is not available.
        """
    @property
    def probability(self) -> float:
        """
        Of its event, in [0, 1], discounted by the steps to it: sum_x P(x | s).
        """
    @property
    def value(self) -> float:
        """
        Q_B of it.
        """

class SalientEventsExplanation:
    """
    What SalientEvents makes of a situation. str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    @property
    def allowed(self) -> list[bool]:
        """
        N bools: whether each motion was, at the last choice there.
        """
    @property
    def options(self) -> list[OptionView]:
        """
        An OptionView each, in the order in which they were made.
        """
    @property
    def running(self) -> list[int]:
        """
        Events of the options under way, the outermost first.
        """
    @property
    def situation(self) -> int:
        """
        The situation's id.
        """
    @property
    def value(self) -> list[float]:
        """
        N values: Q_B of each motion.
        """

class SalientEventsConfig:
    """
    The settings of SalientEvents.

    Raises InvalidValue.

    Parameters
    ----------
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in (0, 1].
    epsilon
        epsilon: probability of a random motion or option instead of a greedy one; within an option,
        of a random motion; in [0, 1].
    tau
        tau: intrinsic reward of a salient event that was not foreseen at all; in [0, 1e+06].
    terminal_value
        What its event is worth to an option; in [-1e+06, 1e+06].
    endings
        Situations in which an option ends that its model keeps for each one, at most; a whole
        number in [1, 1000000].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> SalientEventsConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 0.9,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        tau: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        terminal_value: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        endings: typing.SupportsIndex = 32,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> SalientEventsConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def endings(self) -> int:
        """
        Situations in which an option ends that its model keeps for each one, at most; a whole number in [1, 1000000].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion or option instead of a greedy one; within an option, of a random motion; in [0, 1].
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in (0, 1].
        """
    @property
    def tau(self) -> float:
        """
        tau: intrinsic reward of a salient event that was not foreseen at all; in [0, 1e+06].
        """
    @property
    def terminal_value(self) -> float:
        """
        What its event is worth to an option; in [-1e+06, 1e+06].
        """

class SalientEvents:
    """
    Skills from salient events (Singh, Barto & Chentanez 2004): an option for each event, which
    is rewarding in itself while the option's model does not foresee it. Epsilon-greedy over
    motions and options.

    In a trial: Trial(world, agent=SalientEvents()). It is saved with its trial, pickled and copied.

    Parameters: config, a SalientEventsConfig, also SalientEvents.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = SalientEventsConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: SalientEventsConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def explain(self, situation: typing.SupportsIndex) -> SalientEventsExplanation | None:
        """
        What it makes of a situation, a SalientEventsExplanation; None for one never met. Draws and changes nothing. Raises InvalidValue.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> SalientEventsConfig:
        """
        Its settings.
        """
    @property
    def events(self) -> list[int]:
        """
        The events for which there is an option, in the order in which they first came.
        """
    @property
    def intrinsic_reward(self) -> float:
        """
        Intrinsic reward of the last outcome, r_i.
        """

class Task:
    """
    An environment that is no world of the robot's: what all in devlearn.tasks have. An episode
    is begun, then observed and stepped until an outcome has arrived, or for as long as one
    likes. Not while another thread's run has it in hand.
    """

    interrupted: numpy.typing.NDArray[numpy.void] | None
    def begin(self, seed: typing.SupportsIndex = 0) -> None:
        """
        An episode begins, whatever was before. All that is by chance in it follows from seed, in [0, 2**64 - 1]. Raises InvalidValue.
        """
    def observation(self) -> Observation:
        """
        What is observed now. Raises InvalidValue where no episode is under way.
        """
    def step(self, motion: typing.SupportsIndex) -> Outcome:
        """
        Executes a motion. Where the episode has ended, well or not, the outcome has arrived. Raises InvalidValue for a motion that is none, and where no episode is under way.
        """
    @property
    def motion_count(self) -> int:
        """
        M: motions are 0 ... motion_count - 1.
        """
    @property
    def situation_count(self) -> int:
        """
        Situations are 0 ... situation_count - 1.
        """
    @property
    def succeeded(self) -> bool:
        """
        Whether the episode that has ended ended well.
        """

class PlayroomConfig:
    """
    The settings of Playroom.

    Raises InvalidValue.

    Parameters
    ----------
    reward
        r_e: reward where the monkey cries; in [-1e+06, 1e+06].
    ending
        Whether an episode ends where the monkey cries; true or false.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> PlayroomConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self, reward: typing.SupportsFloat | typing.SupportsIndex = 1.0, ending: bool = True
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> PlayroomConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def ending(self) -> bool:
        """
        Whether an episode ends where the monkey cries; true or false.
        """
    @property
    def reward(self) -> float:
        """
        r_e: reward where the monkey cries; in [-1e+06, 1e+06].
        """

class Playroom(Task):
    """
    The playroom of Singh, Barto & Chentanez (2004): 5 x 5 squares, a light switch, a ball, a
    bell, a blue and a red block that turn music on and off, and a toy monkey, which cries where
    the bell rang in the dark with music on. The agent has an eye, a hand and a marker, and senses
    what is in their squares, light, music and ringing. Motions, events and objects are numbered
    as in MOTIONS, EVENTS and OBJECTS.

    Parameters: config, a PlayroomConfig, also Playroom.Config (None: the defaults). Raises InvalidValue.
    """

    EVENTS: typing.ClassVar[tuple[str, ...]] = (
        "light_on",
        "light_off",
        "music_on",
        "music_off",
        "bell_rings",
        "monkey_cries",
    )
    MOTIONS: typing.ClassVar[tuple[str, ...]] = (
        "eye_to_hand",
        "eye_to_marker",
        "eye_north",
        "eye_south",
        "eye_east",
        "eye_west",
        "eye_to_random_object",
        "hand_to_eye",
        "marker_to_eye",
        "flick_switch",
        "kick_ball",
        "press_blue_block",
        "push_blue_block",
        "press_red_block",
        "push_red_block",
    )
    OBJECTS: typing.ClassVar[tuple[str, ...]] = (
        "switch",
        "ball",
        "bell",
        "blue_block",
        "red_block",
        "monkey",
    )
    Config = PlayroomConfig
    def __init__(self, config: PlayroomConfig | None = None) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def config(self) -> PlayroomConfig:
        """
        Its settings.
        """
    @property
    def counts(self) -> dict[str, typing.Any]:
        """
        How often each event came in the episode, by name.
        """
    @property
    def light(self) -> bool:
        """
        Whether it is light.
        """
    @property
    def music(self) -> bool:
        """
        Whether there is music.
        """
    @property
    def squares(self) -> dict[str, typing.Any]:
        """
        Where the eye, the hand, the marker and each object are, by name: (row, column), each 0 ... 4, row 0 in the north. Before an episode all are (0, 0).
        """

class AttentionConfig:
    """
    The settings of Attention.

    Raises InvalidValue.

    Parameters
    ----------
    speeds
        Speeds of a wheel, evenly from -1 to 1; a whole number in [2, 21].
    frequencies
        Frequencies of the sound, in the middles of even parts of [0, 1]; a whole number in [3, 99].
    side
        Side of the square room; in [0.01, 1000] m.
    speed
        Way of a wheel in a step at a speed of 1; in [0, 1000] m.
    axle
        Distance between the wheels; in [0.001, 1000] m.
    noise
        Standard deviation of the distance that is sensed; in [0, 1000] m.
    steps
        Steps of an episode; a whole number in [1, 1000000000].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> AttentionConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        speeds: typing.SupportsIndex = 5,
        frequencies: typing.SupportsIndex = 9,
        side: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        speed: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        axle: typing.SupportsFloat | typing.SupportsIndex = 0.2,
        noise: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        steps: typing.SupportsIndex = 5000,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> AttentionConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def axle(self) -> float:
        """
        Distance between the wheels; in [0.001, 1000] m.
        """
    @property
    def frequencies(self) -> int:
        """
        Frequencies of the sound, in the middles of even parts of [0, 1]; a whole number in [3, 99].
        """
    @property
    def noise(self) -> float:
        """
        Standard deviation of the distance that is sensed; in [0, 1000] m.
        """
    @property
    def side(self) -> float:
        """
        Side of the square room; in [0.01, 1000] m.
        """
    @property
    def speed(self) -> float:
        """
        Way of a wheel in a step at a speed of 1; in [0, 1000] m.
        """
    @property
    def speeds(self) -> int:
        """
        Speeds of a wheel, evenly from -1 to 1; a whole number in [2, 21].
        """
    @property
    def steps(self) -> int:
        """
        Steps of an episode; a whole number in [1, 1000000000].
        """

class Attention(Task):
    """
    A room with a robot on two wheels, which can sound, and a toy (Oudeyer, Kaplan & Hafner
    2007, section VI). A motion is (l, r, f), the speeds of both wheels in [-1, 1] and the
    frequency of a sound in [0, 1]; what is sensed is the distance to the toy, with noise [m].
    A situation is so many tenths of the room's side of it, the last one all beyond.
    Below 1/3 of f the toy goes anywhere, below 2/3 it stays, else it jumps to the robot. Nothing
    is to be reached, and a step costs nothing: what matters is where attention goes.

    Parameters: config, a AttentionConfig, also Attention.Config (None: the defaults). Raises InvalidValue.
    """

    Config = AttentionConfig
    def __init__(self, config: AttentionConfig | None = None) -> None: ...
    def __repr__(self) -> str: ...
    def zone(self, motion: typing.SupportsIndex) -> int:
        """
        What the toy does at a motion: 0, it goes anywhere; 1, it stays; 2, it jumps to the robot. Raises InvalidValue.
        """
    @property
    def config(self) -> AttentionConfig:
        """
        Its settings.
        """
    @property
    def distance(self) -> float:
        """
        Between them, as it is sensed [m].
        """
    @property
    def motors(self) -> numpy.ndarray:
        """
        A copy of the matrix of (l, r, f), a row a motion; f varies fastest.
        """
    @property
    def robot(self) -> devlearn._types.Pose:
        """
        Where the robot is: a Pose [m, m, degrees].
        """
    @property
    def toy(self) -> tuple[float, float]:
        """
        Where the toy is [m].
        """

class TwoWheeledDef:
    """
    A two-wheeled robot that balances. The defaults are those of NXTway-GS, a robot of LEGO
    Mindstorms NXT (Y. Yamamoto 2009).

    Raises InvalidValue.

    Parameters
    ----------
    gravity
        g: gravity; in (0, 100] m/s^2.
    wheel_mass
        m: of a wheel, a disk of inertia J_w = m R^2 / 2; in (0, 1000] kg.
    wheel_radius
        R: of a wheel; in (0, 10] m.
    body_mass
        M: of the body, of inertia J_psi = M L^2 / 3 about its centre; in (0, 1000] kg.
    body_height
        H: of the body, whose centre is L = H / 2 above the axle; in (0, 10] m.
    motor_inertia
        J_m: of a motor; in [0, 10] kg m^2.
    gear_ratio
        n: of a motor to its wheel; in (0, 1000].
    motor_friction
        f_m: torque of friction between body and wheel per angular rate; in [0, 100] N m s.
    floor_friction
        f_w: torque of friction between wheel and floor per angular rate; in [0, 100] N m s.
    torque_constant
        K_t: of a motor; in (0, 100] N m/A.
    back_emf
        K_b: constant of a motor; in [0, 100] V s.
    resistance
        R_m: of a motor; in (0, 1e+06] Ohm.
    battery
        V: voltage, which bounds the torque that a motor can give at a rate; in (0, 1000] V.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> TwoWheeledDef:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        gravity: typing.SupportsFloat | typing.SupportsIndex = 9.81,
        wheel_mass: typing.SupportsFloat | typing.SupportsIndex = 0.03,
        wheel_radius: typing.SupportsFloat | typing.SupportsIndex = 0.04,
        body_mass: typing.SupportsFloat | typing.SupportsIndex = 0.6,
        body_height: typing.SupportsFloat | typing.SupportsIndex = 0.144,
        motor_inertia: typing.SupportsFloat | typing.SupportsIndex = 1e-05,
        gear_ratio: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        motor_friction: typing.SupportsFloat | typing.SupportsIndex = 0.0022,
        floor_friction: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        torque_constant: typing.SupportsFloat | typing.SupportsIndex = 0.317,
        back_emf: typing.SupportsFloat | typing.SupportsIndex = 0.468,
        resistance: typing.SupportsFloat | typing.SupportsIndex = 6.69,
        battery: typing.SupportsFloat | typing.SupportsIndex = 8.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> TwoWheeledDef:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def back_emf(self) -> float:
        """
        K_b: constant of a motor; in [0, 100] V s.
        """
    @property
    def battery(self) -> float:
        """
        V: voltage, which bounds the torque that a motor can give at a rate; in (0, 1000] V.
        """
    @property
    def body_height(self) -> float:
        """
        H: of the body, whose centre is L = H / 2 above the axle; in (0, 10] m.
        """
    @property
    def body_mass(self) -> float:
        """
        M: of the body, of inertia J_psi = M L^2 / 3 about its centre; in (0, 1000] kg.
        """
    @property
    def floor_friction(self) -> float:
        """
        f_w: torque of friction between wheel and floor per angular rate; in [0, 100] N m s.
        """
    @property
    def gear_ratio(self) -> float:
        """
        n: of a motor to its wheel; in (0, 1000].
        """
    @property
    def gravity(self) -> float:
        """
        g: gravity; in (0, 100] m/s^2.
        """
    @property
    def motor_friction(self) -> float:
        """
        f_m: torque of friction between body and wheel per angular rate; in [0, 100] N m s.
        """
    @property
    def motor_inertia(self) -> float:
        """
        J_m: of a motor; in [0, 10] kg m^2.
        """
    @property
    def resistance(self) -> float:
        """
        R_m: of a motor; in (0, 1e+06] Ohm.
        """
    @property
    def torque_constant(self) -> float:
        """
        K_t: of a motor; in (0, 100] N m/A.
        """
    @property
    def wheel_mass(self) -> float:
        """
        m: of a wheel, a disk of inertia J_w = m R^2 / 2; in (0, 1000] kg.
        """
    @property
    def wheel_radius(self) -> float:
        """
        R: of a wheel; in (0, 10] m.
        """

class BalanceConfig:
    """
    The settings of Balance.

    Raises InvalidValue.

    Parameters
    ----------
    robot
        What balances; a TwoWheeledDef.
    torques
        M: the motions: what each motor is asked for; 1 ... 1000 numbers, each in [-1000, 1000] N m.
    sample_time
        t_s: time of a step; in (0, 10] s.
    substep
        Longest step of integration, of which a step has as many as it needs; in (0, 10] s.
    duration
        After which an episode has succeeded; in (0, 1e+06] s.
    angle_limit
        Angle beyond which the robot has fallen; in (0, 90] degrees.
    start_angle
        An episode begins at rest, at any angle up to this, below the limit; in [0, 90] degrees.
    angle_edges
        Rising; between which angles are one situation; 0 ... 100 numbers, each in [-90, 90]
        degrees.
    rate_edges
        The same of the angle's rate; 0 ... 100 numbers, each in [-1e+06, 1e+06] degrees/s.
    wheel_rate_edges
        The same of the wheels' rate; 0 ... 100 numbers, each in [-1e+06, 1e+06] degrees/s.
    sef_scale
        By how much SEF is lower where the robot leans by the limit than upright; in (0, 1e+06].
    sef_rate
        T_1: time by which the angle's rate counts as lean; in [0, 100] s.
    sef_wheel_rate
        T_2: time by which the wheels' rate counts as lean; in [0, 100] s.
    fall_cost
        Cost of a step that ends in a fall; others cost nothing; in [0, 1e+06].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> BalanceConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        robot: TwoWheeledDef | None = None,
        torques: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = (
            -0.04,
            -0.01,
            0.0,
            0.01,
            0.04,
        ),
        sample_time: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        substep: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        duration: typing.SupportsFloat | typing.SupportsIndex = 60.0,
        angle_limit: typing.SupportsFloat | typing.SupportsIndex = 15.0,
        start_angle: typing.SupportsFloat | typing.SupportsIndex = 2.0,
        angle_edges: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = (
            -6.0,
            -3.0,
            -1.0,
            1.0,
            3.0,
            6.0,
        ),
        rate_edges: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = (
            -120.0,
            -60.0,
            -20.0,
            20.0,
            60.0,
            120.0,
        ),
        wheel_rate_edges: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = (
            -360.0,
            -120.0,
            120.0,
            360.0,
        ),
        sef_scale: typing.SupportsFloat | typing.SupportsIndex = 20.0,
        sef_rate: typing.SupportsFloat | typing.SupportsIndex = 0.07,
        sef_wheel_rate: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        fall_cost: typing.SupportsFloat | typing.SupportsIndex = 100.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> BalanceConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def angle_edges(self) -> list[float]:
        """
        Rising; between which angles are one situation; 0 ... 100 numbers, each in [-90, 90] degrees.
        """
    @property
    def angle_limit(self) -> float:
        """
        Angle beyond which the robot has fallen; in (0, 90] degrees.
        """
    @property
    def duration(self) -> float:
        """
        After which an episode has succeeded; in (0, 1e+06] s.
        """
    @property
    def fall_cost(self) -> float:
        """
        Cost of a step that ends in a fall; others cost nothing; in [0, 1e+06].
        """
    @property
    def rate_edges(self) -> list[float]:
        """
        The same of the angle's rate; 0 ... 100 numbers, each in [-1e+06, 1e+06] degrees/s.
        """
    @property
    def robot(self) -> TwoWheeledDef:
        """
        What balances; a TwoWheeledDef.
        """
    @property
    def sample_time(self) -> float:
        """
        t_s: time of a step; in (0, 10] s.
        """
    @property
    def sef_rate(self) -> float:
        """
        T_1: time by which the angle's rate counts as lean; in [0, 100] s.
        """
    @property
    def sef_scale(self) -> float:
        """
        By how much SEF is lower where the robot leans by the limit than upright; in (0, 1e+06].
        """
    @property
    def sef_wheel_rate(self) -> float:
        """
        T_2: time by which the wheels' rate counts as lean; in [0, 100] s.
        """
    @property
    def start_angle(self) -> float:
        """
        An episode begins at rest, at any angle up to this, below the limit; in [0, 90] degrees.
        """
    @property
    def substep(self) -> float:
        """
        Longest step of integration, of which a step has as many as it needs; in (0, 10] s.
        """
    @property
    def torques(self) -> list[float]:
        """
        M: the motions: what each motor is asked for; 1 ... 1000 numbers, each in [-1000, 1000] N m.
        """
    @property
    def wheel_rate_edges(self) -> list[float]:
        """
        The same of the wheels' rate; 0 ... 100 numbers, each in [-1e+06, 1e+06] degrees/s.
        """

class Balance(Task):
    """
    A two-wheeled robot learns to stand. An episode begins at rest, at an angle drawn; it ends
    where the angle passes the limit, a fall, or when the robot has stood for the duration. A
    motion is a torque, held for a sample time. Situations are intervals of angle, of its rate
    and of the wheels' rate. With u = psi + T_1 psi' + T_2 theta', a lean that looks ahead, SEF
    is -sef_scale (u / angle_limit)^2, and SMF its growth, at most -1 for a fall. A fall costs
    fall_cost, other steps nothing; the estimate is 1 before the end. Senses: angle [degrees],
    its rate [degrees/s], the wheels' angle, by which they have rolled, and its rate.

    Parameters: config, a BalanceConfig, also Balance.Config (None: the defaults). Raises InvalidValue.
    """

    Config = BalanceConfig
    def __init__(self, config: BalanceConfig | None = None) -> None: ...
    def __repr__(self) -> str: ...
    def begin_at(
        self,
        state: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ],
    ) -> None:
        """
        An episode begins in this state, four numbers as the senses. Raises InvalidValue for numbers that are not finite, and for an angle beyond the limit.
        """
    def sef_of(
        self,
        state: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ],
    ) -> float:
        """
        SEF of a state, four numbers as the senses.
        """
    def situation_of(
        self,
        state: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ],
    ) -> int:
        """
        Which situation a state is, four numbers as the senses.
        """
    @property
    def config(self) -> BalanceConfig:
        """
        Its settings.
        """
    @property
    def state(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Four numbers as the senses, after the end, too.
        """
    @property
    def time(self) -> float:
        """
        Since the episode began [s].
        """

class AppraisalConfig:
    """
    The settings of Appraisal.

    Raises InvalidValue.

    Parameters
    ----------
    novelty
        phi_n: weight of novelty in what is learned from; in [-1, 1].
    motivation
        phi_m: weight of motivation, which is goal relevance; in [-1, 1].
    control
        phi_c: weight of control; in [-1, 1].
    valence
        phi_v: weight of valence; in [-1, 1].
    external
        phi_e: weight of the reward from outside; in [-1, 1].
    alpha
        alpha: step size; in (0, 1].
    gamma
        gamma: discount rate; in [0, 1].
    epsilon
        epsilon: probability of a random motion instead of a greedy one, at first; in [0, 1].
    epsilon_decay
        What epsilon is divided by after each step; in [1, 2].
    novelty_decay
        lambda: what novelty is divided by at each visit; in [1, 2].
    planning_steps
        n: updates after each step, at most; as many again of the values of external reward; a whole
        number in [0, 1000000].
    theta
        theta: what would change a value by no more than this is not queued; in [0, 1e+09].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> AppraisalConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        novelty: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        motivation: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        control: typing.SupportsFloat | typing.SupportsIndex = -0.3,
        valence: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        external: typing.SupportsFloat | typing.SupportsIndex = 0.7,
        alpha: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        gamma: typing.SupportsFloat | typing.SupportsIndex = 0.9,
        epsilon: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        epsilon_decay: typing.SupportsFloat | typing.SupportsIndex = 1.0001,
        novelty_decay: typing.SupportsFloat | typing.SupportsIndex = 1.001,
        planning_steps: typing.SupportsIndex = 10,
        theta: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> AppraisalConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def alpha(self) -> float:
        """
        alpha: step size; in (0, 1].
        """
    @property
    def control(self) -> float:
        """
        phi_c: weight of control; in [-1, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        epsilon: probability of a random motion instead of a greedy one, at first; in [0, 1].
        """
    @property
    def epsilon_decay(self) -> float:
        """
        What epsilon is divided by after each step; in [1, 2].
        """
    @property
    def external(self) -> float:
        """
        phi_e: weight of the reward from outside; in [-1, 1].
        """
    @property
    def gamma(self) -> float:
        """
        gamma: discount rate; in [0, 1].
        """
    @property
    def motivation(self) -> float:
        """
        phi_m: weight of motivation, which is goal relevance; in [-1, 1].
        """
    @property
    def novelty(self) -> float:
        """
        phi_n: weight of novelty in what is learned from; in [-1, 1].
        """
    @property
    def novelty_decay(self) -> float:
        """
        lambda: what novelty is divided by at each visit; in [1, 2].
        """
    @property
    def planning_steps(self) -> int:
        """
        n: updates after each step, at most; as many again of the values of external reward; a whole number in [0, 1000000].
        """
    @property
    def theta(self) -> float:
        """
        theta: what would change a value by no more than this is not queued; in [0, 1e+09].
        """
    @property
    def valence(self) -> float:
        """
        phi_v: weight of valence; in [-1, 1].
        """

class Appraisal:
    """
    Learning by appraising, as in Sequeira, Melo & Paiva (2011; 2014): rewards come from within.
    Each step is appraised by its history, for novelty, motivation, control and valence, each in
    [0, 1]; Q is learned of their sum with the reward from outside, weighted, by prioritized
    sweeping. Motions are chosen by Q, epsilon-greedy, with an epsilon that falls.

    In a trial: Trial(world, agent=Appraisal()). It is saved with its trial, pickled and copied.

    Parameters: config, a AppraisalConfig, also Appraisal.Config (None: the defaults); seed of its draws.
    Raises InvalidValue.
    """

    Config = AppraisalConfig
    def __getstate__(self) -> tuple[dict[str, typing.Any], typing.Any]: ...
    def __init__(
        self, config: AppraisalConfig | None = None, seed: typing.SupportsIndex = 0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def begin_round(self) -> None:
        """
        A round begins. As all that follow it: what a trial calls, for a loop of one's own.
        """
    def cancel(self) -> None:
        """
        The waiting choice was not made.
        """
    def choose(self, observation: Observation) -> devlearn._types.Choice:
        """
        A motion for what is observed. Raises InvalidValue, likewise while a choice waits for observe() or cancel().
        """
    def end_round(self, arrived: bool) -> None:
        """
        The round has ended, at the target or not.
        """
    def explain(self, situation: typing.SupportsIndex) -> AppraisalExplanation | None:
        """
        How a situation is appraised, an AppraisalExplanation; None for one never met. Draws and
        changes nothing. Raises InvalidValue.
        """
    def observe(self, outcome: Outcome) -> None:
        """
        What came of the choice. Raises InvalidValue.
        """
    def value(self, situation: typing.SupportsIndex, motion: typing.SupportsIndex) -> float | None:
        """
        The value of a motion in a situation; None for a situation never met. Raises InvalidValue.
        """
    @property
    def config(self) -> AppraisalConfig:
        """
        Its settings.
        """
    @property
    def epsilon(self) -> float:
        """
        The probability of a random motion, at present.
        """

class AppraisalExplanation:
    """
    How a situation is appraised at present, for each of its N motions. The reward of a motion is
    the sum of its four appraisals and of the mean reward from outside, weighted by the settings.
    str() of it is a table.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore
    def __eq__(self, other: object, /) -> bool: ...
    def __getstate__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple[typing.Any, ...]) -> None: ...
    def __str__(self) -> str: ...
    @property
    def allowed(self) -> list[bool]:
        """
        N bools: whether each was allowed at the last choice here.
        """
    @property
    def config(self) -> AppraisalConfig:
        """
        The AppraisalConfig: the weights among its settings.
        """
    @property
    def control(self) -> list[float]:
        """
        N values, in [0, 1].
        """
    @property
    def epsilon(self) -> float:
        """
        The probability of a random motion, at present.
        """
    @property
    def external(self) -> list[float]:
        """
        N values: mean reward from outside; 0 for one never tried.
        """
    @property
    def external_value(self) -> list[float]:
        """
        N values: Q of external rewards alone.
        """
    @property
    def goal(self) -> int:
        """
        The situation of the highest external value; -1: none as yet.
        """
    @property
    def goal_distance(self) -> int:
        """
        Motions from here to the goal, by all transitions seen; -1: no way is known.
        """
    @property
    def motivation(self) -> float:
        """
        In [0, 1], the same for all motions.
        """
    @property
    def novelty(self) -> list[float]:
        """
        N values, in [0, 1].
        """
    @property
    def reward(self) -> list[float]:
        """
        N values: what they come to.
        """
    @property
    def situation(self) -> int:
        """
        The situation's id.
        """
    @property
    def valence(self) -> list[float]:
        """
        N values, in [0, 1].
        """
    @property
    def value(self) -> list[float]:
        """
        N values: Q, by which motions are chosen.
        """
    @property
    def visits(self) -> list[int]:
        """
        N values: how often each was tried.
        """

class ForagingConfig:
    """
    The settings of Foraging.

    Raises InvalidValue.

    Parameters
    ----------
    scenario
        Which scenario; 'moving_preys' or 'persistence' or 'prey_season' or 'poisoned_season' or
        'hunger_thirst' or 'lairs'.
    season
        Steps of a season, where there are some; a whole number in [1, 1000000000].
    most_pushes
        Pushes that the fence of persistence takes, at most; a whole number in [0, 1000000].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> ForagingConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        scenario: str = "moving_preys",
        season: typing.SupportsIndex = 5000,
        most_pushes: typing.SupportsIndex = 30,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> ForagingConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def most_pushes(self) -> int:
        """
        Pushes that the fence of persistence takes, at most; a whole number in [0, 1000000].
        """
    @property
    def scenario(self) -> str:
        """
        Which scenario; 'moving_preys' or 'persistence' or 'prey_season' or 'poisoned_season' or 'hunger_thirst' or 'lairs'.
        """
    @property
    def season(self) -> int:
        """
        Steps of a season, where there are some; a whole number in [1, 1000000000].
        """

class Foraging(Task):
    """
    The foraging scenarios of Sequeira, Melo & Paiva (2011; 2014), as in their published program: a
    fox in a small grid world, which sees where it is and what is there, and nothing else. Motions:
    up, down, left, right, and among lairs eat and open; against a wall or the fence it stays. A
    situation is 16 times the cell, numbered row by row, walls too, and what is there. The event of
    a step is 0 if a prey was eaten. An episode has no end of its own.

    Parameters: config, a ForagingConfig, also Foraging.Config (None: the defaults). Raises InvalidValue.
    """

    Config = ForagingConfig
    def __init__(self, config: ForagingConfig | None = None) -> None: ...
    def __repr__(self) -> str: ...
    def drawn(self) -> str:
        """
        The grid, a line a row: # a wall, F the fox, h a hare, r a rabbit, w water, = the fence, o a
        lair that is closed, O one with its rabbit out, . one that is empty. Raises InvalidValue where no
        episode is under way.
        """
    @property
    def config(self) -> ForagingConfig:
        """
        Its settings.
        """

class NoiseDef:
    """
    By how much chance spoils what a robot does and senses: standard deviations, and chances,
    of each step, drawn from the stream "noise" of the trial's seed. By default there is none.

    Raises InvalidValue.

    Parameters
    ----------
    turn
        Standard deviation of a step's turn from the motion's; in [0, 90] degrees.
    drive
        Standard deviation of a step's drive from v t_s; it never goes backwards; in [0, 1] m.
    slip
        Chance that a motion drawn evenly from M is made in place of the one chosen; in [0, 1].
    odometry_turn
        Standard deviation of what odometry makes of a step's turn; it adds up until the robot is
        put somewhere; in [0, 90] degrees.
    odometry_drive
        Standard deviation of what odometry makes of a step's way, as a share of it; likewise; in
        [0, 1].
    echo
        Standard deviation of a sonar's echo distance; in [0, 10] m.
    bearing
        Standard deviation of where a sonar looks; in [0, 90] degrees.
    dropout
        Chance that a sonar hears nothing; in [0, 1].
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> NoiseDef:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        turn: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        drive: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        slip: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        odometry_turn: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        odometry_drive: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        echo: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        bearing: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        dropout: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> NoiseDef:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def bearing(self) -> float:
        """
        Standard deviation of where a sonar looks; in [0, 90] degrees.
        """
    @property
    def drive(self) -> float:
        """
        Standard deviation of a step's drive from v t_s; it never goes backwards; in [0, 1] m.
        """
    @property
    def dropout(self) -> float:
        """
        Chance that a sonar hears nothing; in [0, 1].
        """
    @property
    def echo(self) -> float:
        """
        Standard deviation of a sonar's echo distance; in [0, 10] m.
        """
    @property
    def odometry_drive(self) -> float:
        """
        Standard deviation of what odometry makes of a step's way, as a share of it; likewise; in [0, 1].
        """
    @property
    def odometry_turn(self) -> float:
        """
        Standard deviation of what odometry makes of a step's turn; it adds up until the robot is put somewhere; in [0, 90] degrees.
        """
    @property
    def slip(self) -> float:
        """
        Chance that a motion drawn evenly from M is made in place of the one chosen; in [0, 1].
        """
    @property
    def turn(self) -> float:
        """
        Standard deviation of a step's turn from the motion's; in [0, 90] degrees.
        """

class TrialConfig:
    """
    Everything a trial needs besides the world and the seed; the defaults are the paper's.

    Raises InvalidValue.

    Parameters
    ----------
    learner
        The paper's steps 3-5, or the adaptive learner; its motions are the robot's; a LearnerConfig
        or AdaptiveConfig.
    evaluation
        Step 2, Eq. 6; a StateEvaluation.
    robot
        Eq. 1-2; a RobotDef.
    clearance_source
        Where d_o of Eq. 6 comes from: the exact distance, or the least echo plus the robot's
        radius; 'geometric' or 'sonar'.
    walls_count
        Whether walls count in d_o; the clearance source sonar needs it; true or false.
    goal_radius
        Arrived when d_g is no more than this; in (0, 100] m.
    touch_cost
        What a step costs beside 1 where the body touched something; the paper's learner does not
        look at costs; in [0, 1e+06].
    cell_size
        Side of a cell of the situation grid; in [0.001, 1000] m.
    heading_bins
        Headings of the situation grid; a whole number in [1, 3600].
    noise
        What chance spoils of motions and senses; a NoiseDef.
    """
    @staticmethod
    def adaptive() -> TrialConfig:
        """
        The adaptive learner, by its defaults.
        """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> TrialConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    @staticmethod
    def paper() -> TrialConfig:
        """
        The default, with LearnerConfig.paper().
        """
    @staticmethod
    def step5() -> TrialConfig:
        """
        The other reading, with LearnerConfig.step5().
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        learner: LearnerConfig | AdaptiveConfig | None = None,
        evaluation: StateEvaluation | None = None,
        robot: RobotDef | None = None,
        clearance_source: str = "geometric",
        walls_count: bool = False,
        goal_radius: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        touch_cost: typing.SupportsFloat | typing.SupportsIndex = 5.0,
        cell_size: typing.SupportsFloat | typing.SupportsIndex = 0.25,
        heading_bins: typing.SupportsIndex = 12,
        noise: NoiseDef | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> TrialConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def cell_size(self) -> float:
        """
        Side of a cell of the situation grid; in [0.001, 1000] m.
        """
    @property
    def clearance_source(self) -> str:
        """
        Where d_o of Eq. 6 comes from: the exact distance, or the least echo plus the robot's radius; 'geometric' or 'sonar'.
        """
    @property
    def evaluation(self) -> StateEvaluation:
        """
        Step 2, Eq. 6; a StateEvaluation.
        """
    @property
    def goal_radius(self) -> float:
        """
        Arrived when d_g is no more than this; in (0, 100] m.
        """
    @property
    def heading_bins(self) -> int:
        """
        Headings of the situation grid; a whole number in [1, 3600].
        """
    @property
    def learner(self) -> LearnerConfig | AdaptiveConfig:
        """
        The paper's steps 3-5, or the adaptive learner; its motions are the robot's; a LearnerConfig or AdaptiveConfig.
        """
    @property
    def noise(self) -> NoiseDef:
        """
        What chance spoils of motions and senses; a NoiseDef.
        """
    @property
    def robot(self) -> RobotDef:
        """
        Eq. 1-2; a RobotDef.
        """
    @property
    def touch_cost(self) -> float:
        """
        What a step costs beside 1 where the body touched something; the paper's learner does not look at costs; in [0, 1e+06].
        """
    @property
    def walls_count(self) -> bool:
        """
        Whether walls count in d_o; the clearance source sonar needs it; true or false.
        """

class Trial:
    """
    The closed loop: world -> sense -> situation -> choice -> motion -> evaluation ->
    development -> record.

    Parameters: world; config, a TrialConfig (None: the paper's); seed of the learner's draws;
    agent: None for a new learner as config says, a Learner or AdaptiveLearner (shared, not
    copied), a RandomAgent, one of devlearn.agents, or any object with choose(observation) ->
    motion index or Choice, and
    observe(outcome). If it has them, these are called, too: begin_round(), before the first
    choice of a round; end_round(arrived), True where path learning arrives, False where the
    next round begins; cancel(), where its motion was refused. With state() -> dict of arrays
    and a classmethod from_state(dict) it is saved with the trial.
    evaluation: a callable of Senses that gives SEF in place of Eq. 6, or an array of SEFs, one a
    situation of the grid; situations: a callable of Senses that gives ids in place of the grid's.
    Raises InvalidValue.

    A phase that Ctrl-C or an exception ends leaves what it finished in `interrupted`. Trials in
    several threads run at once. A trial that one thread runs, its learner, and its agent of
    devlearn's are refused to others meanwhile, and for good to a child forked then.
    """

    interrupted: devlearn.record.Record | None
    @staticmethod
    def from_bytes(
        snapshot: bytes,
        agent: typing.Any = None,
        *,
        evaluation: typing.Any = None,
        situations: typing.Any = None,
    ) -> Trial:
        """
        The trial in a snapshot's bytes. Raises FileError.
        """
    @staticmethod
    def load(
        path: typing.Any,
        agent: typing.Any = None,
        *,
        evaluation: typing.Any = None,
        situations: typing.Any = None,
    ) -> Trial:
        """
        The trial in a snapshot; it goes on equal to the bit, in the middle of a round, too. `agent` takes the place of the one in the file; a class makes it, by from_state(dict) of what its state() was. `evaluation` and `situations` are the callables that the file names, given again; an array is in the file. Nothing is imported by a name in the file. Raises FileError, saying what is wrong with the file.
        """
    def __copy__(self) -> typing.Any: ...
    def __getstate__(self) -> typing.Any: ...
    def __init__(
        self,
        world: World,
        config: TrialConfig | None = None,
        seed: typing.SupportsIndex = 0,
        agent: typing.Any = None,
        *,
        evaluation: typing.Any = None,
        situations: typing.Any = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: typing.Any) -> None: ...
    def _repr_html_(self) -> str:
        """
        For notebooks.
        """
    def begin_round(self) -> None:
        """
        Puts the robot at the start pose for a new round.
        """
    def change_world(self, world: World) -> None:
        """
        Puts the robot at the start of another world, which has the same arena; robot, grid, agent
        and time stay. The present round ends, where the agent is in one. Records that follow tell of
        the earlier worlds in their provenance. Raises InvalidValue.
        """
    def copy(self) -> typing.Any:
        """
        An independent trial, with an agent of its own, that goes on alike.
        """
    def finish_round(
        self,
        steps: typing.SupportsIndex,
        *,
        echoes: bool = False,
        rounds_only: bool = False,
        learner: bool = False,
        tally: Tally | None = None,
        stop: threading.Event | None = None,
        progress: collections.abc.Callable[[int, int], typing.Any] | None = None,
    ) -> devlearn.record.Record:
        """
        Goes on with the present round until the target is reached, for at most `steps` steps: what finishes a round of path learning that was interrupted. Options as run.
        """
    def free_learning(
        self,
        steps: typing.SupportsIndex,
        *,
        echoes: bool = False,
        rounds_only: bool = False,
        learner: bool = False,
        tally: Tally | None = None,
        stop: threading.Event | None = None,
        progress: collections.abc.Callable[[int, int], typing.Any] | None = None,
    ) -> devlearn.record.Record:
        """
        A new round of `steps` steps from the start pose; reaching the target ends nothing. Options as run.
        """
    def path_learning(
        self,
        rounds: typing.SupportsIndex,
        step_limit: typing.SupportsIndex = 10000,
        *,
        echoes: bool = False,
        rounds_only: bool = False,
        learner: bool = False,
        tally: Tally | None = None,
        stop: threading.Event | None = None,
        progress: collections.abc.Callable[[int, int], typing.Any] | None = None,
    ) -> devlearn.record.Record:
        """
        `rounds` new rounds from the start pose, each until the target is reached, or failed (arrived False) after `step_limit` steps. Options as run.
        """
    def place(
        self,
        x: typing.SupportsFloat | typing.SupportsIndex,
        y: typing.SupportsFloat | typing.SupportsIndex,
        heading: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        Puts the robot anywhere it fits [m, m, degrees] for a new round. Raises InvalidValue.
        """
    def run(
        self,
        steps: typing.SupportsIndex,
        *,
        echoes: bool = False,
        rounds_only: bool = False,
        learner: bool = False,
        tally: Tally | None = None,
        stop: threading.Event | None = None,
        progress: collections.abc.Callable[[int, int], typing.Any] | None = None,
    ) -> devlearn.record.Record:
        """
        `steps` steps from where the robot is, in the present round.

        All phases take the same options. `echoes` records the sonars, too. With `rounds_only` the
        record holds `rounds` and no steps or poses, and memory does not grow with steps; not
        together with echoes. With `learner` the record carries the learner as the phase found it,
        for `devlearn view`. The steps are counted into `tally`, too, the finished ones also where
        the phase is not. `stop`, a threading.Event or what has its is_set(), ends the phase within
        50 ms of being set, from another thread too; what is finished is returned as ever.
        `progress` is called as progress(done, total) ten times a second at most, in steps (in
        rounds by path_learning), and once at the end; what it raises ends the phase as Ctrl-C does.
        """
    def save(
        self, path: typing.Any, record: typing.Any = None, *, without_agent: bool = False
    ) -> None:
        """
        Writes a snapshot (safetensors layout): world, configuration, seed, pose, round and agent with its generator, and a Record if one is given, which Record.load reads. To the side first, flushed, then renamed. Of agents devlearn's own are saved, and one with state() -> dict of str, numbers and numpy arrays, whose class has from_state(dict); any other only by its owner: then save the trial `without_agent`. Raises FileError, InvalidValue.
        """
    def step(self) -> Step:
        """
        One step: once around the loop.
        """
    def to_bytes(self, record: typing.Any = None, *, without_agent: bool = False) -> bytes:
        """
        The snapshot as bytes.
        """
    @property
    def agent(self) -> typing.Any:
        """
        Whoever chooses.
        """
    @property
    def arrived(self) -> bool:
        """
        Whether d_g <= goal_radius.
        """
    @property
    def config(self) -> TrialConfig:
        """
        The TrialConfig.
        """
    @property
    def earlier_worlds(self) -> list[tuple[World, int]]:
        """
        What change_world changed: (World, steps made by then) of each, the first first.
        """
    @property
    def estimated_pose(self) -> devlearn._types.Pose:
        """
        Where its odometry says the robot is; without noise, where it is.
        """
    @property
    def evaluation(self) -> typing.Any:
        """
        The callable or array that stands in place of Eq. 6; None for Eq. 6.
        """
    @property
    def grid(self) -> SituationGrid:
        """
        The SituationGrid over the arena.
        """
    @property
    def learner(self) -> Learner | AdaptiveLearner:
        """
        The Learner or AdaptiveLearner, where one is the agent; None otherwise.
        """
    @property
    def pose(self) -> devlearn._types.Pose:
        """
        Where the robot is [m, m, degrees].
        """
    @property
    def robot(self) -> Robot:
        """
        The Robot.
        """
    @property
    def round(self) -> int:
        """
        The present round, from 1; 0 before the first.
        """
    @property
    def round_open(self) -> bool:
        """
        Whether the agent is in a round: told that it began, and not yet that it ended.
        """
    @property
    def seed(self) -> int:
        """
        The seed it began with.
        """
    @property
    def situations(self) -> typing.Any:
        """
        The callable that stands in place of the grid's situations; None for the grid's.
        """
    @property
    def time(self) -> float:
        """
        The world's time: steps made so far, over all rounds, x sample_time [s].
        """
    @property
    def world(self) -> World:
        """
        The World.
        """

class BatchConfig:
    """
    What episodes of a Batch are.

    Raises InvalidValue.

    Parameters
    ----------
    reward
        What a step is worth: -cost and by how much the estimate of the cost to go fell; -cost; SMF
        as learned from; 1 at the target and 0 elsewhere; 'shaped' or 'cost' or 'smf' or 'sparse'.
    step_limit
        Steps after which an episode is truncated; a whole number in [1, 1099511627776].
    autoreset
        When the next episode begins: by the step after the last, which makes no motion, by the last
        step itself, or by reset alone; 'next_step' or 'same_step' or 'disabled'.
    sonars
        Whether the sonars' echoes are told; true or false.
    random_starts
        Whether an episode begins at a pose drawn among those that may get to the target, in place
        of the world's start; true or false.
    """
    @staticmethod
    def fields() -> dict[str, typing.Any]:
        """
        What each field is, by name: a dict of its symbol, unit, range, default and doc.
        """
    @staticmethod
    def from_dict(fields: dict[str, typing.Any]) -> BatchConfig:
        """
        From a dict of fields; those left out keep their defaults. Raises InvalidValue for an unknown field.
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self,
        reward: str = "shaped",
        step_limit: typing.SupportsIndex = 10000,
        autoreset: str = "next_step",
        sonars: bool = False,
        random_starts: bool = False,
    ) -> None: ...
    def __reduce__(self) -> tuple[typing.Any, ...]: ...
    def __repr__(self) -> str: ...
    def replace(self, **kwargs: typing.Any) -> BatchConfig:
        """
        A copy with some fields changed.
        """
    def to_dict(self) -> dict[str, typing.Any]:
        """
        Its fields as a dict of plain values, as JSON can hold.
        """
    @property
    def autoreset(self) -> str:
        """
        When the next episode begins: by the step after the last, which makes no motion, by the last step itself, or by reset alone; 'next_step' or 'same_step' or 'disabled'.
        """
    @property
    def random_starts(self) -> bool:
        """
        Whether an episode begins at a pose drawn among those that may get to the target, in place of the world's start; true or false.
        """
    @property
    def reward(self) -> str:
        """
        What a step is worth: -cost and by how much the estimate of the cost to go fell; -cost; SMF as learned from; 1 at the target and 0 elsewhere; 'shaped' or 'cost' or 'smf' or 'sparse'.
        """
    @property
    def sonars(self) -> bool:
        """
        Whether the sonars' echoes are told; true or false.
        """
    @property
    def step_limit(self) -> int:
        """
        Steps after which an episode is truncated; a whole number in [1, 1099511627776].
        """

class BatchRows:
    """
    What is known where the robots of a Batch are, a row an environment: arrays that show what is the case now.
    """
    def __repr__(self) -> str: ...
    @property
    def allowed(self) -> numpy.ndarray:
        """
        Which motions the robot can make: (count, motion_count) bools.
        """
    @property
    def clearance(self) -> numpy.ndarray:
        """
        d_o [m]
        """
    @property
    def echoes(self) -> numpy.ndarray:
        """
        The sonars' echoes: (count, sonar_count) [m]; no column where they are not told.
        """
    @property
    def estimate(self) -> numpy.ndarray:
        """
        Cost to go at the least, in steps: d_g / (v t_s), 0 at the target.
        """
    @property
    def goal_distance(self) -> numpy.ndarray:
        """
        d_g [m]
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        x, y, heading: (count, 3) [m, m, degrees].
        """
    @property
    def situation(self) -> numpy.ndarray:
        """
        The situation's id.
        """

class Batch:
    """
    Several environments of one world and configuration, which one call steps, in C++ and
    without the GIL: a row each, in arrays that stay where they are and show what is the case.

    An episode begins at the world's start, or at a drawn pose. It is terminated where the
    robot arrives, and truncated after step_limit steps without that. What environment i does depends on its own
    seed and motions alone, so it is the same in a batch of any size.

    Parameters: world; count, in [1, 2^20]; config, a TrialConfig (None: the paper's); episodes,
    a BatchConfig; seed: environment i is seeded with seed + i. Raises InvalidValue.
    """
    def __init__(
        self,
        world: World,
        count: typing.SupportsInt | typing.SupportsIndex = 1,
        config: TrialConfig | None = None,
        episodes: BatchConfig | None = None,
        seed: typing.SupportsIndex = 0,
    ) -> None: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def drive_wheels(self, speeds: typing.Any) -> None:
        """
        The same at constant wheel speeds, (count, 2): left, right [m/s], forwards or backwards, each at most RobotDef.speed, as Robot.drive_wheels makes them. `rows.allowed` is of motions alone.
        """
    def poses(self) -> numpy.ndarray:
        """
        Where the robots truly are, whatever they sense of it: a copy, (count, 3) [m, m, degrees].
        """
    def reset(
        self, seeds: typing.Any = None, which: typing.Any = None, poses: typing.Any = None
    ) -> None:
        """
        Begins an episode in every environment, or in `which`, bools. seeds: one an environment, a
        uint64 array (None: what is drawn goes on); poses: where each begins, (count, 3) [m, m,
        degrees] (None: as episodes do). Raises InvalidValue; then nothing was reset.
        """
    def step(self, motions: typing.Any) -> None:
        """
        One step of every environment: motions[i], an index of M, in environment i. One that the robot's safety layer would not allow is made, too. Raises InvalidValue, also where autoreset is disabled and an episode has ended; then nothing was stepped.
        """
    def times(self) -> numpy.ndarray:
        """
        Their worlds' time, by which movers move: a copy, (count,) [s]. Episodes do not set it back, seeds do.
        """
    @property
    def begun(self) -> numpy.ndarray:
        """
        Whether the step only began an episode.
        """
    @property
    def collided(self) -> numpy.ndarray:
        """
        Whether the body touched something.
        """
    @property
    def config(self) -> TrialConfig:
        """
        The TrialConfig.
        """
    @property
    def cost(self) -> numpy.ndarray:
        """
        What it cost: 1, and touch_cost more where it collided.
        """
    @property
    def episodes(self) -> BatchConfig:
        """
        The BatchConfig.
        """
    @property
    def final_rows(self) -> BatchRows:
        """
        Where episodes ended that ended by the last step, if autoreset is same_step: the rows that are terminated or truncated.
        """
    @property
    def grid(self) -> SituationGrid:
        """
        The SituationGrid over the arena.
        """
    @property
    def reward(self) -> numpy.ndarray:
        """
        What the last step was worth, as BatchConfig.reward says.
        """
    @property
    def rows(self) -> BatchRows:
        """
        Where the robots are, BatchRows.
        """
    @property
    def smf(self) -> numpy.ndarray:
        """
        SMF of it as learned from: min(SMF, -1) for a collision.
        """
    @property
    def terminated(self) -> numpy.ndarray:
        """
        Whether the target was reached.
        """
    @property
    def truncated(self) -> numpy.ndarray:
        """
        Whether the step limit was.
        """
    @property
    def world(self) -> World:
        """
        The World.
        """

def direction(heading: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float]:
    """
    The unit vector (x, y) of a heading [degrees, counter-clockwise from the x axis]. Its last bits are the same on every machine; multiples of 90 degrees are exact. Raises InvalidValue unless the heading is finite.
    """

def exponential(x: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    e**x within 1 ulp. Unlike math.exp its last bits are the same on every machine; inf where it overflows.
    """

def heading_of_yaw(yaw: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    Pose.from_radians, its heading alone.
    """

def load_config(path: typing.Any) -> TrialConfig:
    """
    A TrialConfig from a JSON file, an object of its fields; those left out keep their defaults. Raises FileError.
    """

def may_reach_target(
    robot: Robot,
    start: collections.abc.Sequence[float] | None = None,
    goal_radius: typing.SupportsFloat | typing.SupportsIndex = 0.1,
) -> bool:
    """
    Whether the robot's body may get from `start` (None: the world's) to within goal_radius [m]
    of the target: much faster than shortest_path. False is certain; True up to cells of half a
    step or a 2048th of the arena, and to what the robot's motions allow. Raises InvalidValue.
    """

def record_in_snapshot(path: typing.Any) -> typing.Any:
    """
    The record in a trial's snapshot, for Record.load.
    """

def require_record(record: typing.Any) -> None:
    """
    Raises InvalidValue unless a Record holds what a trial can write.
    """

def run_episodes(
    task: typing.Any,
    agent: typing.Any,
    episodes: typing.SupportsIndex,
    *,
    seed: typing.SupportsIndex = 0,
    first: typing.SupportsIndex = 0,
    step_limit: typing.SupportsIndex = 10000,
    stop: threading.Event | None = None,
    progress: collections.abc.Callable[[int, int], typing.Any] | None = None,
) -> numpy.ndarray:
    """
    An agent lives through episodes of a task, each a round, and goes on learning.

    Episode i begins with a seed drawn from seed and i: runs in pieces equal one in one call,
    and devlearn.envs.LearnerOn on the task as an environment.

    Parameters: task, one of devlearn.tasks; agent, as of a Trial, shared and not copied;
    episodes, how many, >= 0; seed of the task, in [0, 2**64 - 1]; first, the first one's
    number, >= 0; step_limit, steps after which an episode is cut off, >= 1; stop, a
    threading.Event or what has its is_set(), ends the run; progress, called as
    progress(done, total), ten times a second at most and at the end.

    Returns an array with the fields reward (the sum of all steps'), steps, ended (by the
    task, not by the limit) and succeeded, an entry an episode. Raises InvalidValue, and what
    the agent raises. An episode that is broken off, also by Ctrl-C, is not counted: what was
    finished is in task.interrupted, and a run with first begins with it anew.
    """

def shortest_path(
    robot: Robot,
    start: collections.abc.Sequence[float] | None = None,
    goal_radius: typing.SupportsFloat | typing.SupportsIndex = 0.1,
) -> ShortestPath:
    """
    The shortest way, in steps, that the robot's own motions allow from `start` (None: the
    world's) to within goal_radius [m] of the target, touching nothing that stands still: a
    ShortestPath. Of movers it knows nothing. What a
    learnt path is measured against.

    Found by A* over poses, those in one cell of a quarter step counting as one. Where the
    flooding of a grid shows that there is no way, that is known at once. In large arenas A* may
    give up, after 4 million poses: then the way is one that may be longer than the shortest, and
    `lower_bound` says by how much at most. Takes seconds at most, and hears Ctrl-C. Raises
    InvalidValue.
    """

def wrapped_heading(heading: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    The heading brought into [0, 360) degrees, exactly. Raises InvalidValue unless it is finite.
    """

def write_file(path: typing.Any, content: bytes) -> None:
    """
    Writes a file as a whole: to the side, flushed to the disk, renamed, its folder flushed. Raises FileError; then what was there before is whole.
    """

def yaw_of_heading(heading: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    Pose.yaw of a heading.
    """

__version__: str
box2d_version: str
commit: str
later_columns: tuple[str, ...] = ("true_situation", "cost", "value")
pose_columns: dict[str, tuple[str, str]] = {
    "x": ("float64", "of the robot's centre [m]"),
    "y": ("float64", "likewise [m]"),
    "heading": ("float64", "counter-clockwise from x [degrees]"),
}
step_columns: dict[str, tuple[str, str]] = {
    "round": ("int32", "the round the step belongs to, from 1"),
    "situation": ("int64", "before the step: S_i, in which the motion was chosen"),
    "true_situation": (
        "int64",
        "the situation that the robot was in; another one where its odometry errs",
    ),
    "motion": ("int32", "index in M"),
    "kind": ("uint8", "why it was chosen, a Kind"),
    "sef": ("float64", "after the step: SEF(t+1)"),
    "smf": ("float64", "SEF(t+1) - SEF(t), Eq. 8"),
    "smf_used": ("float64", "what was learned from: min(smf, -1) for a collision"),
    "collided": ("bool", "whether the body touched something during the step"),
    "arrived": ("bool", "after the step: d_g <= goal_radius"),
    "goal_distance": ("float64", "after the step: d_g [m]"),
    "clearance": ("float64", "after the step: d_o [m]"),
    "cost": ("float64", "of the step: 1, and touch_cost more where it collided"),
    "value": (
        "float64",
        "after the step: cost to go as the agent expects it; NaN: it does not say",
    ),
    "event": ("uint8", "what the outcome changed, an Event"),
    "reduced": ("int32", "motions that reduction development removed"),
    "explored_count": ("int64", "after the step: NUM_RM"),
    "effective_count": ("int64", "after the step: NUM_M"),
}
