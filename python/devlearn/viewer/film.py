"""Films of records: which moment each frame shows, and the files that they become."""

from __future__ import annotations

import base64
import contextlib
import math
import os
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import IO, NamedTuple

import numpy as np
import numpy.typing as npt

from .._calls import path_text, shown
from ..errors import FileError, InvalidValue, MissingExtra, WrongType
from ..plots.scene import MOST_A_FRAME, Scene
from ..record import Record, written_aside

RATE = 25  # frames a second: GIFs count in hundredths
SECONDS = 10.0  # of a film of which nothing is said
_MOST_ROUNDS = 8  # of such a film
_LONGEST = 3600.0  # [s]
_LEAST_WIDTH, _MOST_WIDTH = 240, 2160  # [pixels]
_STILL = 0.5  # for how long the end of a round is seen [s], but at most for this share of it:
_STILL_SHARE = 0.2

Progress = Callable[[int, int], object]
"""Is told how many frames are made, and how many there will be."""

# What ffmpeg is told, by the end of the file's name.
_FORMATS = {
    "gif": ["-filter_complex", "paletteuse=dither=none:diff_mode=rectangle", "-loop", "0"],
    "mp4": [
        "-codec:v", "libx264", "-preset", "veryfast", "-tune", "animation", "-crf", "20",
        "-pix_fmt", "yuv420p", "-movflags", "+faststart",
    ],
    "webp": ["-codec:v", "libwebp_anim", "-lossless", "1", "-loop", "0"],
}  # fmt: skip


class _Shot(NamedTuple):
    """A round in a film."""

    entry: int
    steps: int
    moving: int
    """Frames in which it goes on."""
    still: int
    """Frames that show its end."""
    speed: float
    """How many times faster than the robot."""


class Film:
    """Rounds of a record as frames; ``animate`` makes it.

    Iterating draws them, one after the other: arrays of bytes, (height, width, 3), red, green and
    blue. The same record and arguments give the same frames. A notebook shows it as a video.
    """

    def __init__(self, record: Record, shots: Sequence[_Shot], width: int) -> None:
        self._record, self._shots, self._width = record, list(shots), width
        self.size: tuple[int, int] = self._new_scene().size
        """Width and height of its frames [pixels], both even."""

    def _new_scene(self) -> Scene:
        return Scene(self._record, [shot.entry for shot in self._shots], self._width)

    def __len__(self) -> int:
        """How many frames; 25 of them are a second."""
        return sum(shot.moving + shot.still for shot in self._shots)

    def __iter__(self) -> Iterator[npt.NDArray[np.uint8]]:
        scene = self._new_scene()
        for entry, steps, moving, still, speed in self._shots:
            for at in np.linspace(0, steps, moving) if moving > 1 else [steps]:
                frame = scene.frame(entry, float(at), speed)
                yield frame
            for _ in range(still):
                yield frame

    def __repr__(self) -> str:
        width, height = self.size
        return (
            f"<devlearn.Film: {self.seconds:g} s of {len(self._shots)} rounds, "
            f"{width} x {height} pixels>"
        )

    @property
    def seconds(self) -> float:
        """How long it is [s]."""
        return len(self) / RATE

    @property
    def rounds(self) -> list[int]:
        """The rounds that it shows, counted from 1."""
        return [shot.entry + 1 for shot in self._shots]

    @property
    def every(self) -> int:
        """Of the steps of the fastest round every so many-th is drawn; 1: all of all rounds."""
        return max(
            math.ceil(math.ceil(shot.steps / max(shot.moving - 1, 1)) / MOST_A_FRAME) or 1
            for shot in self._shots
        )

    # --- files ------------------------------------------------------------------------------------

    def save(self, path: str | os.PathLike[str], *, progress: Progress | None = None) -> None:
        """Write it as the end of the file's name says: gif, mp4 (H.264) or webp.

        ``progress`` is told of each frame. The file takes its name once it is whole. Raises
        InvalidValue for any other ending, FileError where the file cannot be written or ffmpeg
        fails, MissingExtra where imageio-ffmpeg is missing.
        """
        kind = format_of(path)
        with written_aside(path, "wb") as file:
            file.write(self.to_bytes(kind, progress=progress))

    def to_bytes(self, kind: str = "mp4", *, progress: Progress | None = None) -> bytes:
        """What ``save`` writes, as "gif", "mp4" or "webp"."""
        if kind not in _FORMATS:
            raise InvalidValue("kind", shown(kind), ", ".join(_FORMATS))
        with tempfile.TemporaryDirectory(prefix="devlearn-film-") as folder:
            made, palette = Path(folder) / f"film.{kind}", Path(folder) / "palette.png"
            if kind == "gif":
                self._encode(self._some(), ["-vf", "palettegen"], palette)
            how = ["-i", os.fspath(palette)] if kind == "gif" else []
            self._encode(self, [*how, *_FORMATS[kind]], made, progress)
            return made.read_bytes()

    def _some(self) -> Iterator[npt.NDArray[np.uint8]]:
        """A few moments, all over the film, whose colours are those of the others."""
        scene = self._new_scene()
        for shot in self._shots[:: math.ceil(len(self._shots) / 10)]:
            for at in (shot.steps // 2, shot.steps):
                yield scene.frame(shot.entry, at, shot.speed)

    def _encode(
        self,
        frames: Iterable[npt.NDArray[np.uint8]],
        how: Sequence[str],
        made: Path,
        progress: Progress | None = None,
    ) -> None:
        width, height = self.size
        with _ffmpeg(
            "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(RATE),
            "-i", "-", *how, "-fflags", "+bitexact", os.fspath(made),
        ) as read:  # fmt: skip
            for i, frame in enumerate(frames, 1):
                read.write(frame.tobytes())
                if progress is not None:
                    progress(i, len(self))

    def _repr_html_(self) -> str:
        content = base64.b64encode(self.to_bytes("mp4")).decode()
        return (
            f'<video controls autoplay loop muted playsinline width="{self.size[0]}" '
            f'src="data:video/mp4;base64,{content}"></video>'
        )


def format_of(path: str | os.PathLike[str]) -> str:
    """Gif, mp4 or webp, of a file that can be written. Raises InvalidValue, FileError."""
    name = path_text(path)
    kind = os.path.splitext(name)[1][1:].lower()
    if kind not in _FORMATS:
        ends = ", ".join(f".{known}" for known in _FORMATS)
        raise InvalidValue("path", shown(name), f"a name that ends in one of {ends}")
    folder = os.path.dirname(name) or "."
    if not os.path.isdir(folder):
        raise FileError(name, "", f"no folder {folder}", "a file in a folder that is there")
    return kind


@contextlib.contextmanager
def _ffmpeg(*arguments: str) -> Iterator[IO[bytes]]:
    """What it reads from; whole once the context has ended. Raises FileError, MissingExtra."""
    program = _program()
    with tempfile.TemporaryFile() as said:
        try:
            process = subprocess.Popen(
                [program, "-loglevel", "error", *arguments],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=said,
                start_new_session=True,  # Ctrl-C is ours to handle
            )
        except OSError as error:
            raise FileError(program, "", error.strerror, _WANTED) from error
        assert process.stdin is not None
        try:
            with contextlib.suppress(BrokenPipeError):  # it has ended, and said why
                yield process.stdin
                process.stdin.close()
            failed = process.wait()
        except BaseException:
            process.kill()
            raise
        finally:
            with contextlib.suppress(BrokenPipeError):
                process.stdin.close()
            process.wait()
        if failed:
            said.seek(0)
            lines = said.read().decode(errors="replace").split("\n")
            told = next((line for line in lines if line.strip()), f"exit code {failed}")
            raise FileError(program, "", told, _WANTED)


_WANTED = (
    "an ffmpeg with x264 and WebP: that of imageio-ffmpeg, or one named by the environment "
    "variable IMAGEIO_FFMPEG_EXE"
)


def _program() -> str:
    try:
        import imageio_ffmpeg
    except ModuleNotFoundError as error:
        raise MissingExtra("a film's file", "imageio-ffmpeg", "films") from error
    try:
        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except RuntimeError as error:
        raise FileError("ffmpeg", "", "no such program", _WANTED) from error


# --- what is shown when ---------------------------------------------------------------------------


def animate(
    record: Record,
    *,
    rounds: str | Sequence[int] | None = None,
    seconds: float | None = None,
    speed: float | None = None,
    width: int = 640,
) -> Film:
    """A film of a record's rounds: ``animate(record).save("out.mp4")``, or shown by a notebook.

    Parameters
    ----------
    rounds
        Which, counted from 1: ``"1-3,50,last"``, ``"all"`` or a list. By default up to eight, from
        the first to the last, more of the early ones.
    seconds
        How long it is [s], in [1, 3600]; by default 10. Each round has the same share.
    speed
        Instead of ``seconds``: how many times faster than the robot all rounds are shown, above 0.
    width
        Of a frame [pixels], in [240, 2160]. The height follows from the arena's shape.

    Where a frame takes more than 10 000 steps, evenly many of them are drawn (``Film.every``). The
    echoes that are drawn are those without noise. Raises InvalidValue for a record without rounds
    or steps, or where something moves in its world and it does not tell when; WrongType.
    """
    if not isinstance(record, Record):
        raise WrongType("record", shown(record), "a Record, as the phases of a Trial give")
    offsets = record.offsets()  # refuses records of rounds only
    if len(record.rounds) == 0:
        raise InvalidValue("record", "no rounds", "one that holds rounds")
    if seconds is not None and speed is not None:
        raise InvalidValue("seconds", seconds, "None where speed is given, which tells the length")
    if speed is None:
        seconds = _within("seconds", SECONDS if seconds is None else seconds, 1.0, _LONGEST)
    else:
        _within("speed", speed, 1e-6, 1e9)
    if isinstance(width, bool) or not hasattr(width, "__index__"):
        raise WrongType("width", shown(width), "a whole number")
    _within("width", width, _LEAST_WIDTH, _MOST_WIDTH)
    entries = _entries(rounds, len(record.rounds))
    shots = _shots(
        entries, np.diff(offsets)[entries].tolist(), record.config.robot.sample_time, seconds, speed
    )
    return Film(record, shots, 2 * round(width / 2))


def _within(quantity: str, value: object, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise WrongType(quantity, shown(value), "a number")
    if not low <= value <= high:
        raise InvalidValue(quantity, shown(value), f"in [{low:g}, {high:g}]")
    return float(value)


def _entries(rounds: object, count: int) -> list[int]:
    if rounds is None:
        some = np.geomspace(1, count, _MOST_ROUNDS).round().astype(int) - 1
        return sorted(set(some.tolist())) if count > _MOST_ROUNDS else list(range(count))
    if isinstance(rounds, str) and rounds == "all":
        return list(range(count))
    allowed = f'"all", or such as "1-3,50,last" or a list, in [1, {count}]'
    numbers: list[int] = []
    if isinstance(rounds, str):
        for part in rounds.replace("last", str(count)).split(","):
            first, to, last = part.partition("-")
            try:
                ends = int(first), int(last if to else first)
            except ValueError:
                raise InvalidValue("rounds", shown(rounds), allowed) from None
            if not 1 <= ends[0] <= ends[1] <= count:
                raise InvalidValue("rounds", shown(rounds), allowed)
            numbers += range(ends[0], ends[1] + 1)
    elif isinstance(rounds, Sequence) or isinstance(rounds, np.ndarray):
        for number in rounds:
            if isinstance(number, (bool, np.bool_)) or not hasattr(number, "__index__"):
                raise WrongType("rounds", shown(number), allowed)
            if not 1 <= number <= count:
                raise InvalidValue("rounds", shown(number), allowed)
            numbers.append(int(number))
    else:
        raise WrongType("rounds", shown(rounds), allowed)
    if not numbers:
        raise InvalidValue("rounds", "none", allowed)
    return [number - 1 for number in numbers]


def _shots(
    entries: Sequence[int],
    steps: Sequence[int],
    step_time: float,
    seconds: float | None,
    speed: float | None,
) -> list[_Shot]:
    if seconds is not None:
        frames = round(seconds * RATE)
        if frames < len(entries):
            raise InvalidValue(
                "seconds", f"{seconds:g} for {len(entries)} rounds",
                f"at least {len(entries) / RATE:g}, a frame each, or fewer rounds",
            )  # fmt: skip
        ends = np.linspace(0, frames, len(entries) + 1).round().astype(int)
        shares = np.diff(ends).tolist()
        still = [min(round(_STILL * RATE), int(_STILL_SHARE * share)) for share in shares]
        moving = [share - held for share, held in zip(shares, still)]
    else:
        assert speed is not None
        length = sum(steps) * step_time / speed + _STILL * len(entries)
        if length > _LONGEST:
            raise InvalidValue(
                "speed", f"{speed:g}, for a film of {length:.0f} s",
                f"one of at most {_LONGEST:g} s: a higher speed, fewer rounds, or seconds instead",
            )  # fmt: skip
        moving = [max(1, round(count * step_time / speed * RATE)) for count in steps]
        still = [round(_STILL * RATE)] * len(steps)
    return [
        _Shot(entry, count, on, held, count * step_time * RATE / max(on - 1, 1))
        for entry, count, on, held in zip(entries, steps, moving, still)
    ]
