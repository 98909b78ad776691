"""Builds and runs the benchmarks, judges what they measured, and compares with earlier results."""

from __future__ import annotations

import argparse
import datetime
import importlib.util
import json
import math
import os
import platform
import re
import shutil
import statistics
import subprocess
import sys
import sysconfig
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from items import COUNTED, FIGURES, FLOOR, ITEMS, STAGES, value_of

ROOT = Path(__file__).resolve().parents[1]
BENCH = ROOT / "bench"
RESULTS = BENCH / "results"

# In how many passes each is measured, and for how long: [s] a benchmark, [s] a sweep of runs.
MODES = {"full": (9, 0.3, 10.0), "quick": (3, 0.05, 2.0), "smoke": (1, 0.0, 0.0)}
NEEDLESS_FOR_HELP = ("numpy", "matplotlib", "devlearn._core", "multiprocessing")
# Slower is what is worse by more than this and by three standard errors of the two medians.
LEAST_SLOWDOWN = 1.02
LEAST_MORE_INSTRUCTIONS = 1.005

Pass = dict[str, float]


def output(command: Sequence[str | Path], **more: Any) -> str:
    """What a command prints; ends the program where the command fails."""
    run = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, check=False, **more
    )
    if run.returncode:
        sys.exit(f"bench: {command[0]} failed:\n{run.stderr[-2000:]}")
    return run.stdout


# --- what is measured -----------------------------------------------------------------------------


class Tree:
    """A built tree: its programs, and its Python package."""

    def __init__(self, commit: str, programs: Path, site: Path | None) -> None:
        self.commit = commit
        self._programs = programs
        self._environment = {**os.environ, "PYTHONHASHSEED": "0"}
        self._python = [sys.executable]
        if site is not None:
            # As a user has it: without site's hooks, by which an editable install finds its files.
            path = [str(site), sysconfig.get_path("purelib")]
            self._environment["PYTHONPATH"] = os.pathsep.join(path)
            self._python.append("-S")

    def run(self, program: str, *arguments: str, **environment: str) -> str:
        """What a program prints."""
        return output(
            [self._programs / f"bench_{program}", *arguments], env={**os.environ, **environment}
        )

    def python(self, *arguments: str | Path) -> str:
        """What Python prints, with this tree's devlearn."""
        return output([*self._python, *arguments], env=self._environment)

    def benchmarks(self, seconds: float) -> Pass:
        """Nanoseconds per step of every benchmark, each run for so long; once for no time."""
        once = {} if seconds else {"DEVLEARN_BENCH_ITERATIONS": "1"}
        arguments = ["--benchmark_format=json", f"--benchmark_min_time={seconds}"]
        text = self.run("all", *arguments, **once)
        measured = {}
        for one in json.loads(text)["benchmarks"]:
            unit = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}[one["time_unit"]]
            measured[one["name"].partition("/iterations")[0]] = (
                one["cpu_time"] * unit / one["steps"]
            )
            if one["name"].startswith("trial/closed_loop"):
                measured["contact_share"] = one["contact_share"]
        return measured

    def crossings(self) -> Pass:
        """Nanoseconds of calls from Python."""
        measured = json.loads(self.python(BENCH / "crossings.py"))
        del measured["commit"]
        return measured

    def imports(self) -> Pass:
        """Milliseconds of imports in fresh interpreters, and what --help loads for nothing."""
        code = (
            "import time, numpy; began = time.perf_counter(); import devlearn; devlearn.Trial, "
            "devlearn.Record; print(1e3 * (time.perf_counter() - began))"
        )
        times = [float(self.python("-c", code)) for _ in range(5)]
        code = (
            "import sys, atexit; sys.argv = ['devlearn', '--help']; atexit.register(lambda: "
            "print(*sys.modules, sep=chr(10), file=sys.stderr)); "
            "import contextlib, io; sys.stdout = io.StringIO(); "
            "from devlearn.cli import main; main()"
        )
        run = subprocess.run(
            [*self._python, "-c", code], capture_output=True, text=True, env=self._environment
        )
        loaded = set(run.stderr.split())
        needless = [name for name in NEEDLESS_FOR_HELP if name in loaded]
        return {
            "import/devlearn": statistics.median(times),
            "import/needless_for_help": float(len(needless)),
        }

    def many_runs(self, seconds: float) -> Pass:
        """Runs a second of one and of two workers, and how long they take to start."""
        return json.loads(self.python(BENCH / "many_runs.py", str(seconds)))

    def one_pass(self, mode: str) -> Pass:
        """Everything that has noise, once."""
        _, benchmark, sweep = MODES[mode]
        return {
            **self.benchmarks(benchmark), **self.crossings(), **self.imports(),
            **self.many_runs(sweep),
        }  # fmt: skip

    # --- what has no noise ---

    def memory(self) -> Pass:
        """Bytes per experienced situation."""
        return {f"memory/{key}": v for key, v in json.loads(self.run("memory")).items()}

    def endurance(self, steps: int) -> Pass:
        """Megabytes by which resident memory grows in a long run."""
        if not (self._programs / "bench_endurance").exists():
            return {}  # an earlier library cannot run so
        grown = json.loads(self.run("endurance", str(steps)))
        return {"endurance/growth_mb": grown["growth_mb"]}

    def latency(self, steps: int) -> list[dict[str, Any]]:
        """Median, 99.9th percentile and worst of choose + learn [ns]."""
        return [json.loads(line) for line in self.run("latency", str(steps)).splitlines()]

    def instructions(self, names: Sequence[str]) -> Pass:
        """Instructions per step of benchmarks, by callgrind: of two iterations less one's."""
        counted = {}
        for name in names:
            only = f"--benchmark_filter=^{name}(/iterations:.*)?$"
            command = [self._programs / "bench_all", only, "--benchmark_format=json"]
            runs = [_callgrind(command, DEVLEARN_BENCH_ITERATIONS=str(n)) for n in (1, 2)]
            steps = json.loads(runs[0][1])["benchmarks"][0]["steps"]
            counted[name] = (runs[1][0] - runs[0][0]) / steps
        return counted

    def phase_instructions(self) -> Pass:
        """Instructions per step of a phase called from C++ and from Python."""
        lengths = (10_000, 40_000)

        def per_step(command: Sequence[str | Path], **environment: str) -> float:
            less, more = (_callgrind([*command, str(n)], **environment)[0] for n in lengths)
            return (more - less) / (lengths[1] - lengths[0])

        python = [*self._python, BENCH / "crossings.py"]
        return {
            "instructions/phase_cpp": per_step([self._programs / "bench_phase"]),
            "instructions/phase_python": per_step(python, **self._environment),
        }


def _callgrind(command: Sequence[str | Path], **environment: str) -> tuple[int, str]:
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *map(str, command)],
        capture_output=True, text=True, check=False, env={**os.environ, **environment},
    )  # fmt: skip
    found = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode or not found:
        sys.exit(f"bench: valgrind failed on {command[0]}:\n{run.stderr[-2000:]}")
    return int(found[1]), run.stdout


# --- building -------------------------------------------------------------------------------------


def built(source: Path, commit: str, extension: Path | None = None) -> Tree:
    """Builds a source tree; the extension, too, unless it is given."""
    folder = source / "build" / "bench" / "release"
    pybind = output([sys.executable, "-m", "pybind11", "--cmakedir"]).strip()
    print(f"bench: building {commit}", flush=True)
    if not (folder / "build.ninja").exists():
        output([
            "cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            "-DDEVLEARN_BENCH=ON", f"-DDEVLEARN_PYTHON={'OFF' if extension else 'ON'}",
            f"-Dpybind11_DIR={pybind}", f"-DPython_EXECUTABLE={sys.executable}",
        ])  # fmt: skip
    # An earlier library may lack what a newer benchmark needs; what is essential is checked below.
    jobs = os.environ.get("DEVLEARN_JOBS", str(os.cpu_count()))
    command = ["cmake", "--build", folder, "--parallel", jobs, "--", "-k", "0"]
    subprocess.run(command, capture_output=True, check=False)
    crossing = next((folder / "bench").glob("bench_crossing*.so"), None)
    extension = extension or next((folder / "python").rglob("_core*.so"), None)
    if not crossing or not extension or not (folder / "bench" / "bench_all").exists():
        sys.exit(f"bench: {commit} does not build; look with: cmake --build {folder}")
    site = folder / "site"
    shutil.rmtree(site, ignore_errors=True)
    shutil.copytree(
        source / "python" / "devlearn", site / "devlearn",
        ignore=shutil.ignore_patterns("__pycache__"),
    )  # fmt: skip
    shutil.copy(extension, site / "devlearn")
    shutil.copy(crossing, site)
    output([sys.executable, "-m", "compileall", "-q", site])
    return Tree(commit, folder / "bench", site)


def earlier(revision: str) -> Tree:
    """An earlier commit, built with the benchmarks of today."""
    commit = commit_of(revision)
    source = ROOT / "build" / "against" / commit
    if not source.exists():
        source.mkdir(parents=True)
        command = ["git", "archive", commit]
        archive = subprocess.run(command, cwd=ROOT, capture_output=True, check=True)
        subprocess.run(["tar", "-x", "-C", source], input=archive.stdout, check=True)
    # Copied with their times, so that only what changed is built anew.
    shutil.copytree(BENCH, source / "bench", dirs_exist_ok=True)
    return built(source, commit)


def commit_of(revision: str | None = None) -> str:
    """A commit by its short name; without a revision that of this tree, `-dirty` where changed."""
    if revision is not None:
        return output(["git", "rev-parse", "--short=12", revision], cwd=ROOT).strip()
    command = ["git", "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"]
    return output(command, cwd=ROOT).strip()


def machine() -> dict[str, Any]:
    """What the figures depend on."""
    cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    governor = Path("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")
    return {
        "cpu": cpu[1] if cpu else platform.machine(),
        "cores": os.cpu_count(),
        "kernel": platform.release(),
        "compiler": output(["c++", "--version"]).splitlines()[0],
        "governor": governor.read_text().strip() if governor.exists() else "not shown",
        "python": platform.python_version(),
        "load_before": round(os.getloadavg()[0], 2),
    }


# --- judging --------------------------------------------------------------------------------------


def spread(values: Sequence[float]) -> float:
    """Standard error of the median, from the quartiles, as a share of it."""
    if len(values) < 3 or not statistics.median(values):
        return 0.0
    low, _, high = statistics.quantiles(values, n=4)
    return 1.25 * (high - low) / 1.35 / math.sqrt(len(values)) / abs(statistics.median(values))


def summarised(passes: Sequence[Pass], exact: Pass, value: Any) -> tuple[float, float]:
    """Median over the passes of a value, each from its own pass, and its standard error."""
    values = []
    for one in passes:
        try:
            values.append(value({**exact, **one}))
        except KeyError:
            return math.nan, 0.0
    return statistics.median(values), spread(values)


def measure(trees: Sequence[Tree], mode: str) -> list[dict[str, Any]]:
    """Results of each tree, their passes interleaved."""
    count = MODES[mode][0]
    made: list[list[Pass]] = [[] for _ in trees]
    state = machine()
    for i in range(count):
        print(f"bench: pass {i + 1} of {count}", flush=True)
        for tree, passes in zip(trees, made):
            passes.append(tree.one_pass(mode))
    results = []
    for tree, passes in zip(trees, made):
        print(f"bench: memory, latency and instructions of {tree.commit}", flush=True)
        exact = tree.memory()
        counted: Pass = {}
        exact |= tree.endurance({"full": 10**8, "quick": 10**7, "smoke": 10**6}[mode])
        if mode == "full":
            exact |= tree.phase_instructions()
            counted = tree.instructions(COUNTED)
            counted["contact_share"] = passes[0]["contact_share"]
        results.append({
            "commit": tree.commit,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "mode": mode,
            "machine": state,
            "items": judged(passes, exact, counted),
            "figures": {k: _finite(summarised(passes, exact, f)[0]) for k, f in FIGURES.items()},
            "stages": {
                k: [_finite(summarised(p, {}, f)[0]) for p in (passes, [counted])]
                for k, f in STAGES.items()
            },
            "latency_ns": tree.latency(10_000_000 if mode == "full" else 100_000),
            "exact": exact,
            "instructions": counted,
            "passes": passes,
        })  # fmt: skip
    return results


def judged(passes: Sequence[Pass], exact: Pass, counted: Pass) -> list[dict[str, Any]]:
    """Every item with its value, its bound and whether it holds."""
    rows = []
    for item in ITEMS:
        value, error = summarised(passes, exact, item.value)
        rows.append({
            "group": item.group, "what": item.what, "sign": item.sign, "bound": item.bound,
            "value": _finite(value), "error": error,
            "holds": None if math.isnan(value) else item.holds(value),
            "by_instructions": _finite(value_of(item, counted)),
        })  # fmt: skip
    return rows


def _finite(value: float) -> float | None:
    return None if math.isnan(value) else value


def shown(value: float | None) -> str:
    """A figure for people."""
    return "-" if value is None else f"{value:.0f}" if value >= 1000 else f"{value:.3g}"


def table(results: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """The items, one a line; of several results the first is judged, the others stand beside."""
    yield (
        f"{'':14} {'':56} {'asked':>8} "
        + " ".join(f"{r['commit'][:12]:>12}" for r in results)
        + (f" {'±':>5} {'by instr.':>9}")
    )
    for i, row in enumerate(results[0]["items"]):
        verdict = {True: "pass", False: "FAIL", None: "not measured"}[row["holds"]]
        yield (
            f"{row['group']:14} {row['what']:56} {row['sign']} {shown(row['bound']):>6} "
            + " ".join(f"{shown(r['items'][i]['value']):>12}" for r in results)
            + f" {100 * row['error']:4.1f}% {shown(row['by_instructions']):>9}  {verdict}"
        )
    for what in FIGURES:
        values = " ".join(f"{shown(r['figures'][what]):>12}" for r in results)
        yield f"{'figures':14} {what:56} {'':>9} {values}"
    for stage in STAGES:
        values = " ".join(f"{shown(r['stages'][stage][0]):>12}" for r in results)
        counted = shown(results[0]["stages"][stage][1])
        yield f"{'a step [ns]':14} {stage:56} {'':>9} {values} {'':>6} {counted:>9}"
    for i, row in enumerate(results[0]["latency_ns"]):
        for quantile in ("median", "p99.9", "worst"):
            what = f"{row['what']}, {quantile} of {row['steps']} [ns]"
            values = " ".join(f"{shown(r['latency_ns'][i][quantile]):>12}" for r in results)
            yield f"{'latency':14} {what:56} {'':>9} {values}"


# --- comparing ------------------------------------------------------------------------------------


def slower(now: Mapping[str, Any], before: Mapping[str, Any]) -> Iterator[str]:
    """What became slower than an earlier result, beyond the noise of both."""
    earlier_items = {row["what"]: row for row in before["items"]}
    for item, row in zip(ITEMS, now["items"]):
        old = earlier_items.get(item.what)
        if old is None or not row["value"] or not old["value"]:
            continue
        yield from _flagged(
            item.what, item.worsening(old["value"], row["value"]), row["error"], old["error"]
        )
    # Every benchmark, as a multiple of the floor of its own pass.
    for name in now["passes"][0]:
        if "/" not in name or name.startswith(("runs/", "import/", "floor/")):
            continue
        new, old = (
            summarised(r["passes"], {}, lambda m, name=name: m[name] / m[FLOOR])
            for r in (now, before)
        )
        if not math.isnan(old[0]):
            yield from _flagged(f"{name} / floor", new[0] / old[0], new[1], old[1])
    for name, count in now["instructions"].items():
        was = before["instructions"].get(name)
        if was and "/" in name and count / was > LEAST_MORE_INSTRUCTIONS:
            yield f"{name}: {count / was:.3f} x the instructions"


def _flagged(what: str, factor: float, error: float, other: float) -> Iterator[str]:
    if factor > max(LEAST_SLOWDOWN, 1.0 + 3.0 * math.hypot(error, other)):
        yield f"{what}: {factor:.2f} x as slow (noise {100 * math.hypot(error, other):.1f} %)"


def latest() -> Path:
    """The result written last."""
    found = sorted(RESULTS.glob("*.json"), key=lambda path: json.loads(path.read_text())["date"])
    if not found:
        sys.exit(f"bench: there is no result in {RESULTS.relative_to(ROOT)} to compare with")
    return found[-1]


def write(result: Mapping[str, Any], path: Path) -> None:
    """Writes a result as JSON."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(result, indent=1) + "\n")
    print(f"bench: written to {path}")


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(prog="scripts/bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer and shorter passes")
    parser.add_argument("--smoke", metavar="DIR", type=Path, help="run what is built in DIR once")
    parser.add_argument("--against", metavar="REV", help="measure an earlier commit, too")
    parser.add_argument(
        "--compare", metavar="FILE", nargs="?", type=Path, const=Path(),
        help="say what is slower than in a result (default: the last in bench/results)",
    )  # fmt: skip
    parser.add_argument("--output", metavar="DIR", type=Path, help="where to write results")
    options = parser.parse_args()
    mode = "smoke" if options.smoke else "quick" if options.quick else "full"

    before = None
    if options.compare is not None:
        before = json.loads((options.compare if options.compare.name else latest()).read_text())
    if options.smoke:
        trees = [Tree(commit_of(), options.smoke / "bench", None)]
    else:
        # scripts/setup has just built the extension.
        found = importlib.util.find_spec("devlearn._core")
        trees = [built(ROOT, commit_of(), Path(str(found.origin)) if found else None)]
    if options.against:
        trees.append(earlier(options.against))

    results = measure(trees, mode)
    print(*table(results), sep="\n")
    if options.output or mode == "full":
        for result in results:
            name = f"{result['date'][:10]}-{result['commit']}.json"
            write(result, (options.output or RESULTS) / name)
    if mode != "full":
        print(f"bench: mode {mode}: fewer, shorter passes, no instructions; nothing to rely on")
    if before:
        print(f"\nslower than {before['commit']} of {before['date'][:10]}:")
        print(*(list(slower(results[0], before)) or ["nothing beyond noise"]), sep="\n")


if __name__ == "__main__":
    main()
