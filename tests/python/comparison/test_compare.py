"""The page of a comparison: that it says what the results hold, and stands by itself."""

import html.parser
import json
import math
import re
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import refused
from devlearn import FileError, Results, cli, sweep
from devlearn.comparison import compared as module
from devlearn.comparison.compare import SHIPPED, compare
from devlearn.comparison.compared import Compared
from devlearn.comparison.curves import learning_curves
from devlearn.comparison.findings import findings
from devlearn.comparison.maps import REACH
from devlearn.comparison.report import write_report
from devlearn.experiments import spec, statistics

# One that learns, one that fails in every run, one that never arrives, and the bound.
TINY = {
    "worlds": ["empty", "paper"],
    "agents": ["paper", "adaptive", "parties:Repaired", "parties:Straight", "ShortestPathAgent"],
    "seeds": "1-3",
    "free": [],
    "rounds": 22,
    "step_limit": 1500,
    "keep": "rounds",
    "settings": {
        "paper": {"free": [[], [300]]},
        "parties:Repaired": {"told": "nowhere"},
        "parties:Straight": {"rounds": 4},
        "ShortestPathAgent": {"rounds": 2},
    },
}
SOME = {**TINY, "agents": ["paper", "parties:Straight"], "settings": {}, "free": [300]}


class Page(html.parser.HTMLParser):
    """What stands on a page: cells by row, links, and all text."""

    def __init__(self, path):
        super().__init__()
        self.rows, self.sources, self.text = [], [], ""
        self._cell = None
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        self.sources += [(tag, name, value) for name, value in attrs if name in ("src", "href")]
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self._cell = ""
        elif tag == "span" and self._cell is not None:
            self._cell += "|"

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self.rows[-1].append(self._cell.strip())
            self._cell = None

    def handle_data(self, data):
        self.text += data
        if self._cell is not None:
            self._cell += data

    def row(self, name):
        """The first row of a name."""
        return next(row for row in self.rows if row and row[0] == name)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("made")
    results = sweep(TINY, folder / "results.sqlite", workers=1)
    return compare(results.path, folder, maps=0, say=lambda _: None), results


def of(frame, agent, **more):
    mine = frame["agent"] == agent
    for name, value in more.items():
        mine &= frame[name] == value
    return frame[mine]


def test_the_first_table_holds_what_the_results_hold(made):
    path, results = made
    page = Page(path)
    assert "the median of the last 5 rounds" in page.text
    row = page.row("adaptive")
    runs = of(results.to_pandas(), "adaptive")
    assert row[1].partition("|")[0] == thousands(np.median(runs["first_arrival"]))
    reached = np.isfinite(runs["within_1_25"]).sum()
    share = statistics.estimate_share(reached, 6)
    percents = f"{100 * reached / 6:.1f} %|{100 * share.low:.1f} % to {100 * share.high:.1f} %"
    assert row[3] == percents
    middle = np.sort(runs["last_ratio"])[1:5]  # of six, one at each end is left out
    assert row[4].partition("|")[0] == f"{middle.mean():.2f}"
    assert row[5].partition("|")[0] == f"{100 * runs['failed_share'].mean():.1f} %"


def thousands(steps):
    return f"{steps:.0f}" if steps < 1000 else f"{steps / 1000:.1f} k"


def test_each_measure_stands_there_for_each_world(made):
    path, results = made
    table = results.to_pandas()
    page = Page(path)
    rows = [row for row in page.rows if row[0] == "ShortestPathAgent" and len(row) == 3]
    medians = of(table, "ShortestPathAgent").groupby("world", sort=False)["last_ratio"].median()
    assert [f"{value:.2f}" for value in medians] in [
        [cell.partition("|")[0] for cell in row[1:]] for row in rows
    ]


def test_no_value_of_the_first_table_is_without_an_interval(made):
    header, *rows = Page(made[0]).rows[:7]
    assert len(header) == 8 and len(rows) == 6
    for row in rows:
        for cell in row[1:]:
            assert re.search(r"\|.+ to |\|no interval of n = 3", cell), (row[0], cell)


def test_who_fails_in_every_run_and_who_never_arrives_are_on_the_page(made):
    page = Page(made[0])
    for name in ("Repaired", "Straight"):
        row = page.row(name)
        assert row[1].startswith("never|") and row[5].startswith("100.0 %"), row
    assert "6 runs ended by an error" in page.text
    assert "FileNotFoundError" in page.text
    assert "Straight in " in page.text  # its worst path


def test_the_page_needs_no_other_file_and_no_script(made):
    page = Page(made[0])
    assert len(page.sources) > 10
    assert {(tag, name) for tag, name, _ in page.sources} == {("img", "src")}
    assert all(value.startswith("data:image/png;base64,") for _, _, value in page.sources)
    text = made[0].read_text(encoding="utf-8")
    assert not re.search(r"<script|@import|url\(|https?://", text)
    assert '<meta name="viewport" content="width=device-width' in text


def test_the_same_results_give_the_same_bytes(made, tmp_path):
    path, results = made
    again = compare(results.path, tmp_path, say=lambda _: None)
    assert again.read_bytes() == path.read_bytes()


def test_every_agent_is_shown_with_what_was_set_of_it(made):
    page = Page(made[0])
    assert page.row("paper, no free steps") and page.row("paper, 300 free steps")
    shown = [row for row in page.rows if row[0] == "Repaired"][-1]
    assert shown[1] == 'told = "nowhere"'


def test_results_are_only_read(made, tmp_path):
    path, results = made
    before = results.path.read_bytes()
    compare(results.path, tmp_path, maps=3, say=lambda _: None)
    assert results.path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["report.html"]


def test_a_sweep_goes_on_and_takes_more_seeds(tmp_path):
    file = written(tmp_path / "some.toml", SOME)
    compare(file, tmp_path, seeds="1", maps=0, workers=1, say=lambda _: None)
    first = Results(tmp_path / "results.sqlite").to_pandas().set_index(["world", "agent", "seed"])
    compare(file, tmp_path, seeds="1-2", maps=0, workers=1, say=lambda _: None)
    frame = Results(tmp_path / "results.sqlite").to_pandas()
    assert len(frame) == 2 * len(first) == 8
    again = frame.set_index(["world", "agent", "seed"]).loc[first.index]
    assert (again["run_finished"] == first["run_finished"]).all()
    assert (again["run_seconds"] == first["run_seconds"]).all()
    assert "n = 2 (seeds 1 to 2)" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_rounds_are_kept_though_the_sweep_does_not_ask_for_them(tmp_path):
    file = written(tmp_path / "some.toml", {**SOME, "keep": "nothing", "worlds": ["empty"]})
    compare(file, tmp_path, seeds="5", maps=0, workers=1, say=lambda _: None)
    results = Results(tmp_path / "results.sqlite")
    assert all(len(results.rounds(run)) for run in results.to_pandas()["run"])


def test_maps_are_made_of_the_first_worlds_and_seeds_alone_and_of_who_learns(tmp_path):
    agents = ["paper", "RandomAgent"]
    values = {**SOME, "agents": agents, "rounds": 3, "trial": {"cell_size": 1.0}}
    file = written(tmp_path / "some.toml", values)
    path = compare(file, tmp_path, maps=1, workers=1, say=lambda _: None)
    frame = Results(tmp_path / "results.sqlite").to_pandas()
    mapped = frame[frame[REACH].notna()]
    assert set(zip(mapped["world"], mapped["agent"], mapped["seed"])) == {
        ("empty", "paper", 1), ("empty", "paper", 2),
    }  # fmt: skip
    assert len(frame) == 12
    assert "paper: arrives from" in path.read_text(encoding="utf-8")


def written(path, values):
    """A sweep's file."""
    tables = {k: v for k, v in values.items() if isinstance(v, dict)}
    lines = [f"{k} = {json.dumps(v)}" for k, v in values.items() if k not in tables]
    for name, table in tables.items():
        lines += [f"{name}.{json.dumps(k)} = {_inline(v)}" for k, v in table.items()]
    path.write_text("\n".join(lines) + "\n")
    return path


def _inline(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k} = {json.dumps(v)}" for k, v in value.items()) + "}"
    return json.dumps(value)


# --- what is left out, and what is refused --------------------------------------------------------


def test_results_that_kept_no_rounds_are_shown_without_learning_curves(tmp_path):
    small = {**SOME, "worlds": ["empty"], "seeds": "1-2", "keep": "nothing", "rounds": 5}
    results = sweep(small, tmp_path / "r.sqlite", workers=1)
    page = Page(compare(results.path, tmp_path, say=lambda _: None))
    assert page.row("Straight") and "How the runs are spread" in page.text
    assert "the median of the last 5 rounds" not in page.text


def test_unfinished_seeds_are_left_out_and_it_is_said(made, tmp_path):
    path = tmp_path / "part.sqlite"
    path.write_bytes(made[1].path.read_bytes())
    with sqlite3.connect(path) as connection:
        connection.execute("DELETE FROM runs WHERE seed = 2 AND id = (SELECT max(id) FROM runs "
                           "WHERE seed = 2)")  # fmt: skip
    compared = Compared(Results(path))
    assert compared.seeds == [1, 3] and compared.left_out == 11
    page = compare(path, tmp_path, say=lambda _: None).read_text(encoding="utf-8")
    assert "11 runs that have no counterpart" in page and "n = 2 (seeds 1, 3)" in page


def test_results_without_a_whole_seed_are_refused(made, tmp_path):
    path = tmp_path / "part.sqlite"
    path.write_bytes(made[1].path.read_bytes())
    with sqlite3.connect(path) as connection:
        connection.execute("DELETE FROM runs WHERE id NOT IN (SELECT id FROM runs LIMIT 2)")
        connection.execute("DELETE FROM runs WHERE id > 2")
    asked = Compared(Results(path))  # two runs are of one world and seed, or of two
    assert asked.left_out < 2
    with sqlite3.connect(path) as connection:
        connection.execute("DELETE FROM runs")
    refused(lambda: compare(path, tmp_path, say=print), "results", "0 runs, of no seed all")


def test_files_that_are_neither_sweeps_nor_results_are_refused(tmp_path):
    missing, wrong, other = (tmp_path / name for name in ("no.toml", "x.toml", "x.sqlite"))
    wrong.write_text("worlds = [\n")
    with sqlite3.connect(other) as connection:
        connection.execute("CREATE TABLE t (a)")
    for file in (missing, wrong, other):
        with pytest.raises(FileError, match=file.name):
            compare(file, tmp_path / "out", say=print)
    assert not (tmp_path / "out" / "report.html").exists()


def test_what_cannot_be_meant_is_refused(made, tmp_path):
    results = made[1].path
    refused(lambda: compare(results, tmp_path, seeds="1-3"), "seeds", "1-3")
    refused(lambda: compare(results, tmp_path, references=["Nobody"]), "reference", "'Nobody'")
    refused(lambda: compare(results, tmp_path, maps=-1), "maps", "-1")
    file = written(tmp_path / "some.toml", SOME)
    refused(lambda: compare(file, tmp_path, references=["papers"]), "reference")
    assert not (tmp_path / "results.sqlite").exists()
    assert cli.main(["compare", str(results), "--search", "--output", str(tmp_path)]) == 1


# --- parts ----------------------------------------------------------------------------------------


def test_an_error_counts_as_the_worst_there_is(made):
    compared = Compared(made[1])
    failing = next(one for one in compared.contenders if one.name == "Repaired")
    assert (compared.scores(failing, "last_ratio") == math.inf).all()
    assert (compared.scores(failing, "failed_share") == 1).all()
    assert compared.scores(failing, "last_ratio").shape == (3, 2)


def test_a_curve_has_at_each_step_the_median_of_the_last_rounds_by_then(made):
    compared = Compared(made[1])
    [curve] = [
        b for n, b in learning_curves(compared, "empty").items() if n == "paper, 300 free steps"
    ]
    frame = of(compared.frame, "paper", world="empty")
    frame = frame[frame["schedule"].str.contains('"free":\\[300\\]')]
    for at in (0, 20, 35, 47):
        values = []
        for run, shortest in zip(frame["run"], frame["shortest"]):
            rounds = compared.results.rounds(int(run))
            ratio = [s / shortest if a else math.inf for s, a in
                     zip(rounds["steps"][1:], rounds["arrived"][1:])]  # fmt: skip
            ends = np.cumsum(rounds["steps"])[1:]
            finished = [r for r, end in zip(ratio, ends) if end <= curve.x[at]][-5:]
            values.append(np.median(finished) if finished else math.inf)
        assert curve.y[at] == np.median(values)


def test_what_stands_out_is_computed(made):
    compared = Compared(made[1])
    text = " ".join(findings(compared, []))
    ratios = compared.frame.groupby("contender")["last_ratio"].median()
    learning = ratios.drop(["ShortestPathAgent", "Repaired"])
    assert text.startswith(f"{learning.idxmin()} ends on the shortest paths")
    assert "6 runs (16.7 %) ended by an error" in text
    assert "half of the rounds or more fail of Repaired and Straight" in text


def test_names_are_short_and_all_different(made):
    names = [one.name for one in Compared(made[1]).contenders]
    assert names == [
        "paper, no free steps", "paper, 300 free steps", "adaptive", "Repaired", "Straight",
        "ShortestPathAgent",
    ]  # fmt: skip


def test_runs_of_other_code_are_shown_without_paths_made_again(made, tmp_path, monkeypatch):
    monkeypatch.setattr("devlearn.comparison.worst.code_version", lambda: "another")
    path = tmp_path / "report.html"
    write_report(path, Compared(made[1]), [])
    text = path.read_text(encoding="utf-8")
    assert "made by another version of devlearn" in text and "The worst run of each" not in text


def test_the_sweep_that_ships_is_of_all_agents_in_all_worlds_with_settings_that_were_searched():
    shipped = spec.read(SHIPPED)
    from devlearn import agents, worlds
    from devlearn.comparison.search import SEARCHED, drawn

    assert set(worlds()) < set(shipped.worlds)
    comparable = {name for name in agents.__all__ if hasattr(getattr(agents, name), "Config")}
    assert {one.agent for one in shipped.variants} == {
        *comparable, "RandomAgent", "ShortestPathAgent", "paper", "adaptive",
    }  # fmt: skip
    for one in shipped.variants:
        if one.agent in SEARCHED:
            assert one.settings in drawn(one.agent)
    searched = {name for name in shipped.worlds if name.startswith("similar")}
    assert searched.isdisjoint(f"similar:{i}" for i in range(40, 44))


def test_ctrl_c_keeps_what_is_finished_and_the_same_command_goes_on(tmp_path):
    values = {**SOME, "worlds": ["empty"], "agents": ["parties:Slow"], "seeds": "1-40", "rounds": 2}
    values["settings"] = {"parties:Slow": {"seconds": 0.1}}
    file = written(tmp_path / "slow.toml", values)
    command = [sys.executable, "-m", "devlearn", "compare", str(file), "--output", str(tmp_path),
               "--maps", "0", "--workers", "1"]  # fmt: skip
    here = Path(__file__).resolve().parents[1]
    run = subprocess.Popen(command, cwd=here, stderr=subprocess.PIPE, text=True)
    results = tmp_path / "results.sqlite"
    while not results.exists() or len(Results(results)) < 3:
        time.sleep(0.02)
        assert run.poll() is None
    run.send_signal(signal.SIGINT)
    _, said = run.communicate(timeout=60)
    assert run.returncode == 130 and "the same command goes on" in said
    assert 3 <= len(Results(results)) < 40
    assert not (tmp_path / "report.html").exists()
    assert subprocess.run(command, cwd=here, capture_output=True).returncode == 0
    assert len(Results(results)) == 40 and (tmp_path / "report.html").exists()


def test_the_floor_and_the_bound_do_not_learn(made):
    assert {one.name for one in Compared(made[1]).contenders if not one.learns} == {module.BOUND}
