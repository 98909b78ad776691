"""The file of results: what stands in it, who may write it, and what is refused."""

import json
import multiprocessing
import os
import shlex
import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas
import parties
import pytest
from conftest import refused
from devlearn import FileError, InvalidValue, Results, World, sweep
from devlearn.experiments import job, spec
from devlearn.experiments.measures import MEASURES
from devlearn.experiments.store import SCHEMA, Store, set_aside

SMALL = {
    "worlds": ["paper", "empty"],
    "agents": ["paper", "QLearning"],
    "seeds": "1-2",
    "free": [50],
    "rounds": 4,
    "step_limit": 60,
    "settings": {"QLearning": {"alpha": [0.2, 0.5]}},
}


def of_sql(path, query):
    with sqlite3.connect(path) as connection:
        return connection.execute(query).fetchall()


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    path = tmp_path_factory.mktemp("small") / "results.sqlite"
    return sweep({**SMALL, "keep": "record", "measures": ["parties:step_count"]}, path, workers=1)


def test_every_run_is_one_row_that_says_what_it_was(small):
    frame = small.to_pandas()
    assert len(frame) == len(small) == 12
    assert frame["run"].is_unique
    assert set(zip(frame["world"], frame["label"], frame["seed"])) == {
        (world, label, seed)
        for world in ("paper", "empty")
        for label in ("paper", "QLearning alpha=0.2", "QLearning alpha=0.5")
        for seed in (1, 2)
    }
    assert set(MEASURES) <= set(frame)
    assert set(frame["settings"]) == {"{}", '{"alpha":0.2}', '{"alpha":0.5}'}
    assert frame["error"].isna().all()


def test_rows_are_in_the_order_of_the_spec_whichever_was_finished_first(small):
    frame = small.to_pandas()
    agents = ("paper", "QLearning alpha=0.2", "QLearning alpha=0.5")
    assert [*zip(frame["world"], frame["label"], frame["seed"])] == [
        (world, label, seed) for world in ("paper", "empty") for label in agents for seed in (1, 2)
    ]


def test_a_row_s_values_are_those_of_the_run_made_again(small):
    frame = small.to_pandas().set_index("run")
    for run, row in frame.iterrows():
        again = job.execute(small.job(run))
        assert again.shortest == row["shortest"]
        for name, value in again.measures.items():
            if not name.startswith("run_"):
                assert row[name] == value or (value is None and np.isnan(row[name])), name


def test_rounds_and_records_are_kept_whole_where_they_are_asked_for(small):
    run = int(small.to_pandas()["run"].iloc[0])
    asked = small.job(run)
    world_of = job._world(asked.world_json)
    trial = job.trial_of(asked.agent, asked.settings, asked.trial, world_of, asked.seed)
    made = job.run_of(trial, asked.schedule, record=True)
    assert small.rounds(run).tobytes() == made.rounds.tobytes()
    assert small.record(run) == made.record


def test_what_was_not_kept_is_refused_by_the_run(tmp_path):
    results = sweep({**SMALL, "seeds": "1"}, tmp_path / "r.sqlite", workers=1)
    for read in (results.rounds, results.record):
        with pytest.raises(InvalidValue, match="was kept"):
            read(1)
    with pytest.raises(InvalidValue, match="one of the 6 in"):
        results.job(99)


def test_numbers_of_runs_may_be_numpy_s_and_others_are_refused(small):
    run = small.to_pandas()["run"].iloc[0]
    assert small.rounds(run).tobytes() == small.rounds(int(run)).tobytes()
    for read in (small.rounds, small.record, small.job):
        refused(lambda read=read: read(2**70), "run")
        refused(lambda read=read: read("1"), "run")


def test_rounds_that_are_damaged_are_refused_by_the_run(tmp_path):
    results = sweep({**SMALL, "keep": "rounds", "seeds": "1"}, tmp_path / "r.sqlite", workers=1)
    of_sql(results.path, "UPDATE kept SET rounds = substr(rounds, 1, 40) WHERE run = 2")
    assert len(results.rounds(1))
    with pytest.raises(FileError, match="rounds of run 2"):
        results.rounds(2)


def test_a_world_that_has_changed_is_refused_under_its_old_name(tmp_path):
    World.load("empty").save(tmp_path / "mine.json")
    (tmp_path / "s.toml").write_text(
        'worlds = ["mine.json"]\nagents = ["paper"]\nseeds = "1"\nfree = []\nrounds = 1\n'
    )
    sweep(tmp_path / "s.toml", tmp_path / "r.sqlite", workers=1)
    World.load("u_trap").save(tmp_path / "mine.json")
    with pytest.raises(FileError, match=r"mine\.json, which has changed since"):
        sweep(tmp_path / "s.toml", tmp_path / "r.sqlite", workers=1)


def test_a_link_is_the_file_that_it_leads_to(tmp_path):
    real, link = tmp_path / "real.sqlite", tmp_path / "link.sqlite"
    real.touch()
    link.symlink_to(real)
    asked = {**SMALL, "seeds": "1"}
    with Store(link, spec.read(asked)), pytest.raises(FileError, match=f"process {os.getpid()}"):
        sweep(asked, real)
    assert len(sweep(asked, link, workers=1)) == len(Results(real)) == 6
    assert link.is_symlink()


def test_plain_sql_reads_the_same(small):
    rows = of_sql(small.path, "SELECT world, label, seed, steps FROM results")
    frame = small.to_pandas()
    assert rows == [*zip(frame["world"], frame["label"], frame["seed"], frame["steps"])]


def test_the_command_of_a_row_makes_the_run_alone(small):
    row = small.to_pandas().iloc[3]
    program, *arguments = shlex.split(row["command"])
    assert program == "devlearn"
    run = subprocess.run(
        [sys.executable, "-m", "devlearn", *arguments],
        capture_output=True, text=True, check=True, cwd=Path(parties.__file__).parent,
    )  # fmt: skip
    told = dict(line.split() for line in run.stdout.splitlines())
    for name in MEASURES:
        if not name.startswith("run_"):
            assert float("nan" if told[name] == "None" else told[name]) == pytest.approx(
                row[name], abs=0, nan_ok=True
            )


def test_what_is_finished_is_not_made_again_but_for_what_else_is_asked(tmp_path):
    path = tmp_path / "r.sqlite"

    def times():
        return of_sql(path, "SELECT id, run_finished, run_seconds FROM runs ORDER BY id")

    sweep({**SMALL, "seeds": "1"}, path, workers=1)
    first = times()
    sweep(SMALL, path, workers=1)
    assert times()[: len(first)] == first and len(times()) == 2 * len(first)
    sweep({**SMALL, "seeds": "1", "measures": ["parties:step_count"]}, path, workers=1)
    frame = Results(path).to_pandas()
    assert len(frame) == 12
    assert frame.loc[frame["seed"] == 1, "parties:step_count"].notna().all()
    assert frame.loc[frame["seed"] == 2, "parties:step_count"].isna().all()
    before = times()
    sweep({**SMALL, "seeds": "1", "measures": ["parties:step_count"]}, path, workers=1)
    assert times() == before


def test_a_measure_of_one_s_own_gives_a_number_nothing_or_what_json_holds(tmp_path):
    names = ["parties:step_count", "parties:three_values", "parties:nothing", "parties:wrong"]
    one = {**SMALL, "worlds": ["paper"], "agents": ["paper"], "settings": {}, "seeds": "1"}
    frame = sweep({**one, "measures": names[:3]}, tmp_path / "r.sqlite", workers=1).to_pandas()
    steps = frame["parties:step_count"][0]
    assert steps == frame["steps"][0]
    assert json.loads(frame["parties:three_values"][0]) == {"steps": [steps], "name": "x"}
    assert frame["parties:nothing"].isna().all()
    failed = sweep({**one, "measures": names[3:]}, tmp_path / "w.sqlite", workers=1).failed
    assert "a number, None, or what JSON can hold" in failed[0][1]


# --- who may read and write -----------------------------------------------------------------------


def test_readers_see_every_finished_run_while_the_file_grows(tmp_path):
    path = tmp_path / "r.sqlite"
    asked = spec.read(SMALL)
    seen = []
    with Store(path, asked) as store:
        for one in asked.jobs():
            store.add([(one, job.execute(one))])
            seen.append((len(Results(path)), of_sql(path, "SELECT count(*) FROM results")[0][0]))
    assert seen == [(n, n) for n in range(1, 13)]


def test_a_second_writer_is_refused_and_told_who_writes(tmp_path):
    path = tmp_path / "r.sqlite"
    with Store(path, spec.read(SMALL)), pytest.raises(FileError, match=f"process {os.getpid()}"):
        sweep(SMALL, path)
    sweep(SMALL, path, workers=1)


def killed_in_mid_run(path):
    asked = spec.read(SMALL)
    with Store(path, asked) as store:
        for i, one in enumerate(asked.jobs()):
            if i == 5:
                os.kill(os.getpid(), 9)
            store.add([(one, job.execute(one))])


def test_a_kill_of_the_writer_loses_no_finished_run(tmp_path):
    path = tmp_path / "r.sqlite"
    process = multiprocessing.get_context("spawn").Process(target=killed_in_mid_run, args=(path,))
    process.start()
    process.join()
    assert process.exitcode == -9
    assert len(Results(path)) == 5
    assert len(sweep(SMALL, path, workers=1)) == 12


def test_a_full_disk_loses_nothing_and_says_so(tmp_path):
    path = tmp_path / "r.sqlite"
    asked = spec.read({**SMALL, "keep": "record"})
    kept = 0
    with Store(path, asked) as store:
        pages = store._connection.execute("PRAGMA page_count").fetchone()[0]
        store._connection.execute(f"PRAGMA max_page_count = {pages + 40}")
        with pytest.raises(FileError, match="room on the disk"):
            for one in asked.jobs():
                store.add([(one, job.execute(one))])
                kept += 1
    assert 0 < kept < 12
    assert len(Results(path)) == kept
    assert len(sweep(SMALL, path, workers=1)) == 12


def other_application(path):
    sqlite3.connect(path).execute("CREATE TABLE t (x)").connection.close()


def other_schema(path):
    sweep(SMALL, path, workers=1)
    of_sql(path, f"PRAGMA user_version = {SCHEMA + 1}")


def other_code(path):
    sweep(SMALL, path, workers=1)
    of_sql(path, "UPDATE meta SET value = 'other' WHERE name IN ('code', 'devlearn')")


def no_database(path):
    path.write_text("something else entirely, and long enough to be looked at" * 99)


def damaged(path):
    sweep(SMALL, path, workers=1)
    content = bytearray(path.read_bytes())
    content[4096:] = os.urandom(len(content) - 4096)
    path.write_bytes(content)


@pytest.mark.parametrize(
    ("made", "says"),
    [
        (other_application, "another application's file"),
        (other_schema, f"schema: got {SCHEMA + 1}; expected {SCHEMA}"),
        (other_code, "runs of devlearn other"),
        (no_database, "file is not a database"),
        (damaged, "malformed|file is not a database"),
    ],
)
def test_a_file_that_cannot_be_gone_on_with_is_refused_and_left_as_it_is(tmp_path, made, says):
    path = tmp_path / "r.sqlite"
    made(path)
    before = path.read_bytes()
    with pytest.raises(FileError, match=says):
        sweep(SMALL, path, workers=1)
    assert path.read_bytes() == before
    if made is not other_code:
        with pytest.raises(FileError, match=says):
            Results(path).to_pandas()


def test_results_that_are_not_there_are_refused(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        Results(tmp_path / "none.sqlite")
    with pytest.raises(InvalidValue, match=r"a file, such as results\.sqlite"):
        sweep(SMALL, tmp_path)


# --- several sweeps in one file -------------------------------------------------------------------


def test_what_several_sweeps_ask_for_is_run_once_with_all_that_they_ask(tmp_path):
    more = {**SMALL, "seeds": "2-3", "agents": ["paper"], "settings": {}, "keep": "rounds"}
    more["measures"] = ["parties:step_count"]
    path = tmp_path / "r.sqlite"
    results = sweep([SMALL, more], path, workers=1)
    assert len(results) == 12 + 2
    for row in results.rows(spec.read(more).jobs()):
        assert row["parties:step_count"] == row["steps"]
        assert len(results.rounds(row["run"])) == 5
    assert len(json.loads(results.meta["spec"])) == 2
    before = of_sql(path, "SELECT id, run_finished, run_seconds FROM runs")
    sweep([more, SMALL], path, workers=1)
    assert of_sql(path, "SELECT id, run_finished, run_seconds FROM runs") == before


def test_two_worlds_of_one_name_are_refused_together(tmp_path):
    specs = []
    for name in ("paper", "empty"):
        (tmp_path / name).mkdir()
        World.load(name).save(tmp_path / name / "w.json")
        file = tmp_path / name / "s.toml"
        file.write_text('worlds = ["w.json"]\nagents = ["paper"]\nseeds = "1"\n')
        specs.append(file)
    with pytest.raises(InvalidValue, match=r"'w\.json'; expected one world of that name"):
        sweep(specs, tmp_path / "r.sqlite")


def test_rows_are_found_by_their_runs_in_the_order_asked_for(tmp_path):
    names = ["parties:step_count", "parties:three_values", "parties:nothing"]
    results = sweep({**SMALL, "measures": names}, tmp_path / "r.sqlite", workers=1)
    jobs = [*spec.read(SMALL).jobs()][::-1]
    rows = results.rows(jobs)
    frame = results.to_pandas().set_index("run")
    for one, row in zip(jobs, rows):
        assert (row["world"], row["agent"], row["seed"]) == (one.world, one.agent, one.seed)
        assert json.loads(row["settings"]) == one.settings
        assert row["steps"] == frame.loc[row["run"], "steps"]
        assert row["parties:three_values"] == {"steps": [row["steps"]], "name": "x"}
        assert row["parties:nothing"] is None
    with pytest.raises(InvalidValue, match=r"paper, seed 9, in paper; expected one of the 12"):
        results.rows(spec.read({**SMALL, "seeds": [9]}).jobs())


def test_damage_is_found_by_a_check_before_rows_are_missed(tmp_path):
    path = tmp_path / "r.sqlite"
    sweep(SMALL, path, workers=1).check()
    content, whole = path.read_bytes(), Results(path).to_pandas()
    page, found = 4096, 0
    for at in range(page, len(content), page):
        path.write_bytes(content[:at] + b"\xff" * page + content[at + page :])
        try:
            Results(path).check()
        except FileError as error:
            assert error.file == str(path)
            found += 1
        else:
            pandas.testing.assert_frame_equal(Results(path).to_pandas(), whole)
    assert found > 5


def test_a_file_set_aside_is_whole_with_what_its_log_holds_and_leaves_room(tmp_path):
    path = tmp_path / "r.sqlite"
    asked = spec.read(SMALL)
    with Store(path, asked) as store:
        for one in [*asked.jobs()][:3]:
            store.add([(one, job.execute(one))])
        for name in ("r.sqlite", "r.sqlite-wal"):  # as a kill leaves them
            (tmp_path / f"k{name}").write_bytes((tmp_path / name).read_bytes())
    assert len(Results(tmp_path / "kr.sqlite")) == 3
    aside = set_aside(tmp_path / "kr.sqlite", ".old")
    assert aside == tmp_path / "kr.sqlite.old"
    assert len(Results(aside)) == 3
    assert not list(tmp_path.glob("kr.sqlite-*"))
    assert len(sweep({**SMALL, "seeds": "1"}, tmp_path / "kr.sqlite", workers=1)) == 6


def test_a_log_left_behind_is_not_taken_for_a_new_file_s(tmp_path):
    path = tmp_path / "r.sqlite"
    asked = spec.read(SMALL)
    with Store(path, asked) as store:
        for one in asked.jobs():
            store.add([(one, job.execute(one))])
        log = (tmp_path / "r.sqlite-wal").read_bytes()
    path.unlink()
    (tmp_path / "r.sqlite-wal").write_bytes(log)
    assert len(sweep({**SMALL, "seeds": "1"}, path, workers=1)) == 6
