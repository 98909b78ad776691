"""Records: their columns, their rounds, and their files."""

import copy
import csv
import json
import os
import pathlib
import pickle
import re
import resource
import stat
import subprocess
import sys
import zipfile

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import FileError, Record, Trial, TrialConfig, World
from devlearn.record import POSE_COLUMNS, STEP_COLUMNS


@pytest.fixture(scope="module")
def record(paper):
    trial = Trial(paper, TrialConfig.step5(), seed=2**64 - 1)
    return trial.path_learning(3, 200, echoes=True)


@pytest.fixture(scope="module")
def saved(record, tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "record.npz"
    record.save(path)
    return path


def columns_of(record):
    names = (*STEP_COLUMNS, *POSE_COLUMNS, "rounds", "echoes")
    return {name: getattr(record, name) for name in names}


# --- columns and rounds --------------------------------------------------------------------------


def test_columns_have_their_types_and_lengths(record):
    steps, rounds = len(record), len(record.rounds)
    assert rounds == 3
    for name, dtype in STEP_COLUMNS.items():
        assert getattr(record, name).dtype == dtype
        assert getattr(record, name).shape == (steps,)
    for name in POSE_COLUMNS:
        assert getattr(record, name).dtype == np.float64
        assert getattr(record, name).shape == (steps + rounds,)
    assert record.rounds.dtype.names == ("round", "steps", "arrived", "began")
    assert record.echoes.shape == (steps, 5)
    for column in columns_of(record).values():
        assert column.flags.c_contiguous


def test_phases_of_no_round_and_no_step_hold_echoes_where_others_do(paper):
    trial = Trial(paper, seed=1)
    phases = [trial.path_learning, trial.run, trial.path_learning]
    records = [phase(count, echoes=True) for phase, count in zip(phases, (0, 3, 0))]
    assert [r.echoes.shape for r in records] == [(0, 5), (3, 5), (0, 5)]
    assert differences(Record.concatenate(records), records[1]) == []


def test_a_record_of_rounds_only_tells_the_same_rounds_and_holds_no_steps(paper, tmp_path):
    def trial():
        return Trial(paper, TrialConfig.step5(), seed=1)

    kept = trial().path_learning(5, 200)
    brief = trial().path_learning(5, 200, rounds_only=True)
    assert brief.rounds_only
    assert not kept.rounds_only
    assert (brief.rounds == kept.rounds).all()
    assert len(brief) == len(brief.x) == 0
    brief.save(tmp_path / "brief.npz")
    assert (Record.load(tmp_path / "brief.npz").rounds == kept.rounds).all()
    trial().save(tmp_path / "trial", brief)
    assert differences(Record.load(tmp_path / "trial"), brief) == []
    for call in (brief.offsets, lambda: brief.path(0), lambda: brief.to_csv("-")):
        refused(call, "record")
    refused(lambda: trial().run(1, echoes=True, rounds_only=True), "rounds_only")
    refused(lambda: Record.concatenate([kept, brief]), "rounds.steps")


def test_rounds_are_found_by_their_index_from_either_end(record):
    slices = [record.steps_of(i) for i in range(3)]
    assert [s.start for s in slices] == [0, *(s.stop for s in slices[:-1])]
    assert slices[-1].stop == len(record)
    assert slices == [record.steps_of(i) for i in (-3, -2, -1)]
    assert record.offsets().tolist() == [0, *(s.stop for s in slices)]
    for i in range(3):
        path = record.path(i)
        assert path.shape == (record.rounds["steps"][i] + 1, 3)
        assert (path == record.path(i - 3)).all()
        assert (path[0] == record.world.start).all()
    assert (record.path() == record.path(0)).all()
    assert np.concatenate([record.path(i) for i in range(3)])[:, 0].tolist() == record.x.tolist()


@pytest.mark.parametrize("i", [3, -4, 10**30])
def test_a_round_that_is_not_there_is_refused(record, i):
    refused(lambda: record.path(i), "round entry", str(i))
    refused(lambda: record.steps_of(i), "round entry", str(i))


def test_columns_outlive_the_trial_and_the_record():
    sef = Trial(World.load("paper"), seed=1).free_learning(1000).sef
    assert np.isfinite(sef).all()


def test_a_record_of_nothing_is_a_record(paper, tmp_path):
    for record in (
        Trial(paper).path_learning(0),
        Trial(paper).run(0),
        Trial(paper).run(0, echoes=True),
    ):
        record.save(tmp_path / "none.npz")
        assert differences(record, Record.load(tmp_path / "none.npz")) == []
        record.to_csv(tmp_path / "none.csv")
        assert len((tmp_path / "none.csv").read_text().splitlines()) == 1
        assert repr(record)


def test_the_representation_says_what_is_in_it(record):
    arrived = int(record.rounds["arrived"].sum())
    text = f"{len(record)} steps in 3 rounds, {arrived} arrived, world 'paper'"
    assert text in repr(record)


def test_provenance_is_whole_and_brings_world_and_configuration_back(record, paper):
    provenance = record.provenance
    assert set(provenance) == {"devlearn", "commit", "box2d", "world", "config", "seed", "agent"}
    assert provenance["devlearn"] == devlearn.__version__
    assert provenance["box2d"].startswith("2.4")
    assert provenance["seed"] == 2**64 - 1
    assert provenance["world"] == {"name": "paper", "hash": paper.hash, "json": paper.to_json()}
    assert provenance["config"] == TrialConfig.step5().to_dict()
    assert json.loads(json.dumps(provenance)) == provenance
    assert record.world == paper
    assert record.config == TrialConfig.step5()


def test_a_record_is_pickled_whole(record):
    again = pickle.loads(pickle.dumps(record))
    assert differences(record, again) == []
    assert again.provenance == record.provenance


def test_a_history_follows_from_its_provenance_alone(record):
    trial = Trial(record.world, record.config, seed=record.provenance["seed"])
    assert differences(record, trial.path_learning(3, 200, echoes=True)) == []


# --- what the constructor refuses ----------------------------------------------------------------


def test_a_record_is_made_of_columns_that_fit(record):
    again = Record(columns_of(record), record.provenance)
    assert differences(record, again) == []
    without = {k: v for k, v in columns_of(record).items() if k != "echoes"}
    assert Record(without, record.provenance).echoes is None
    assert Record(without | {"echoes": None}, {}).echoes is None


@pytest.mark.parametrize("name", [*STEP_COLUMNS, *POSE_COLUMNS, "rounds"])
def test_columns_that_do_not_fit_are_refused_by_name(record, name):
    columns = columns_of(record)

    def with_column(value):
        return lambda: Record(columns | {name: value}, {})

    column = columns[name]
    missing = {k: v for k, v in columns.items() if k != name}
    refused(lambda: Record(missing, {}), name)
    refused(with_column(column[:-1]))
    for misfit in (
        None,
        3,
        "text",
        column.tolist(),
        np.array(column[0]),
        column[:, None],
        object(),
    ):
        assert refused(with_column(misfit)).quantity.startswith(name)
    if name != "rounds":
        refused(with_column(column.astype(np.float16)), name)
        if column.dtype.itemsize > 1:
            refused(with_column(column.astype(column.dtype.newbyteorder())), name)


def test_rounds_and_echoes_that_do_not_fit_are_refused(record):
    columns = columns_of(record)
    rounds = columns["rounds"].copy()
    rounds["steps"] = [2**63 - 1, 2**63 - 1, len(record) + 2]  # whose sum wraps to the right one
    refused(lambda: Record(columns | {"rounds": rounds}, {}), "rounds.steps")
    rounds["steps"] = [-1, len(record), 1]
    refused(lambda: Record(columns | {"rounds": rounds}, {}), "rounds.steps")
    refused(lambda: Record(columns | {"rounds": rounds["steps"]}, {}), "rounds")
    refused(lambda: Record(columns | {"echoes": columns["sef"]}, {}), "echoes")
    refused(lambda: Record(columns | {"echoes": columns["echoes"][1:]}, {}), "echoes")
    refused(lambda: Record(columns | {"other": columns["sef"]}, {}), "other")
    refused(lambda: Record(columns, [("a", 1)]), "provenance")
    refused(lambda: Record({}, {}))


# --- npz -----------------------------------------------------------------------------------------


def test_a_saved_record_loads_to_the_bit(record, saved, paper):
    loaded = Record.load(saved)
    assert differences(record, loaded) == []
    assert loaded.provenance == record.provenance
    assert loaded.world == paper
    assert loaded.config == record.config
    assert [p.name for p in saved.parent.iterdir()] == [saved.name]


def test_a_record_without_echoes_loads_without(paper, tmp_path):
    record = Trial(paper, seed=1).free_learning(10)
    record.save(tmp_path / "plain.npz")
    assert Record.load(tmp_path / "plain.npz").echoes is None


def test_paths_are_text_bytes_or_path_and_the_name_is_taken_as_it_is(record, tmp_path):
    for name in ("a.npz", "b", "c.txt", "ü 1", "x" * 200):
        record.save(tmp_path / name)
        record.save(str(tmp_path / name))
        record.save(os.fsencode(tmp_path / name))
        assert len(Record.load(os.fsencode(tmp_path / name))) == len(record)
    assert len(list(tmp_path.iterdir())) == 5


def test_the_same_history_gives_the_same_file(record, saved, tmp_path):
    Trial(record.world, record.config, seed=2**64 - 1).path_learning(3, 200, echoes=True).save(
        tmp_path / "again"
    )
    assert (tmp_path / "again").read_bytes() == saved.read_bytes()


def test_other_readers_find_plain_arrays_without_pickles(saved, record):
    with np.load(saved, allow_pickle=False) as file:
        assert file["sef"].tolist() == record.sef.tolist()
        assert json.loads(str(file["header"]))["format"] == "devlearn-record"


def unreadable(path):
    """Checks that a file is refused by name; gives the error."""
    with pytest.raises(FileError) as caught:
        Record.load(path)
    assert caught.value.file == caught.value.filename == str(path)
    assert str(caught.value).startswith(str(path))
    return caught.value


def rewritten(saved, path, **changes):
    with np.load(saved) as file:
        columns = {name: file[name] for name in file.files} | changes
    np.savez(path, **{k: v for k, v in columns.items() if v is not None})
    return path


def test_files_that_are_no_records_are_refused_by_name(saved, tmp_path, record):
    path = tmp_path / "file.npz"
    unreadable(tmp_path / "absent.npz")
    unreadable(tmp_path)
    for content in (b"", b"PK\x03\x04", b"garbage" * 99, os.urandom(4096), b"\x93NUMPY", b"{}"):
        path.write_bytes(content)
        unreadable(path)
    path.write_bytes(pickle.dumps(record))
    unreadable(path)
    np.save(path.with_suffix(".npy"), record.sef)
    unreadable(path.with_suffix(".npy"))
    np.save(path.with_suffix(".npy"), np.array([object()]), allow_pickle=True)
    unreadable(path.with_suffix(".npy"))
    np.savez(path, a=record.sef)
    unreadable(path)
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("header.npy", "no array")
    unreadable(path)


def test_a_pickle_in_a_file_is_never_run(saved, tmp_path):
    class Bomb:
        def __reduce__(self):
            return os.mkdir, (str(tmp_path / "run"),)

    array = np.empty(1, object)
    array[0] = Bomb()
    path = tmp_path / "bomb.npz"
    unreadable(rewritten(saved, path, sef=array))
    unreadable(rewritten(saved, path, header=array))
    assert not (tmp_path / "run").exists()


def test_a_file_cut_anywhere_or_changed_anywhere_is_refused_or_read(saved, tmp_path):
    whole = saved.read_bytes()
    path = tmp_path / "cut.npz"
    for length in np.linspace(0, len(whole) - 1, 40).astype(int):
        path.write_bytes(whole[:length])
        unreadable(path)
    random = np.random.default_rng(1)
    refusals = 0
    for _ in range(150):
        changed = bytearray(whole)
        for at in random.integers(len(whole), size=random.integers(1, 4)):
            changed[at] ^= 1 << random.integers(8)
        path.write_bytes(changed)
        try:
            Record.load(path)
        except FileError as error:
            refusals += 1
            assert error.file == str(path)
    assert refusals > 100


def test_a_header_that_does_not_fit_is_refused_by_field(saved, tmp_path):
    path = tmp_path / "header.npz"
    with np.load(saved) as file:
        header = json.loads(str(file["header"]))

    def refused_field(changes):
        text = json.dumps(header | changes)
        return unreadable(rewritten(saved, path, header=np.array(text))).field

    assert refused_field({"format": "other"}) == "format"
    for version in (2, 10**9):
        assert refused_field({"version": version}) == "version"
        assert "newer" in str(unreadable(path))
    for version in (0, -1, "1", 1.0, True, None):
        assert refused_field({"version": version}) == "version"
    for provenance in (None, 3, [], "x"):
        assert refused_field({"provenance": provenance}) == "provenance"
    for text in ("", "3", "[]", "null", "{}", "[" * 10**5, '{"format": "devlearn-record"}'):
        unreadable(rewritten(saved, path, header=np.array(text)))
    unreadable(rewritten(saved, path, header=None))


LATER = {"true_situation": -1, "cost": np.nan, "value": np.nan}


def test_columns_that_earlier_builds_did_not_write_are_unknown(saved, tmp_path):
    record = Record.load(rewritten(saved, tmp_path / "old.npz", **dict.fromkeys(LATER)))
    for name, unknown in LATER.items():
        assert np.array_equal(record[name], np.full(len(record), unknown), equal_nan=True)
        assert record[name].dtype == STEP_COLUMNS[name]
    assert len(record.cost) == len(record)
    assert record == Record.load(tmp_path / "old.npz")


def test_columns_that_do_not_fit_are_refused_by_file_and_field(saved, tmp_path, record):
    path = tmp_path / "columns.npz"
    for name in (*STEP_COLUMNS, *POSE_COLUMNS, "rounds"):
        if name not in LATER:
            assert unreadable(rewritten(saved, path, **{name: None})).field == name
        assert unreadable(rewritten(saved, path, **{name: np.array(1.0)})).field == name
    assert unreadable(rewritten(saved, path, sef=record.sef[1:])).field == "sef"
    assert unreadable(rewritten(saved, path, echoes=record.sef)).field == "echoes"
    assert unreadable(rewritten(saved, path, more=record.sef)).field == "more"


def test_a_save_that_fails_leaves_the_old_file_whole_and_nothing_else(record, saved, tmp_path):
    path = tmp_path / "record.npz"
    path.write_bytes(saved.read_bytes())
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    for write in (record.save, record.to_csv):
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limits[1]))  # as on a full disk
        try:
            with pytest.raises(FileError) as caught:
                write(path)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        assert caught.value.file == str(path)
        assert path.read_bytes() == saved.read_bytes()
        assert [p.name for p in tmp_path.iterdir()] == ["record.npz"]


def test_places_that_cannot_be_written_are_refused_by_name(record, tmp_path):
    (tmp_path / "file").write_text("")
    for place in ("absent/a.npz", "file/a.npz", ".", "a\0b", "y" * 300):
        for write in (record.save, record.to_csv):
            with pytest.raises(FileError) as caught:
                write(f"{tmp_path}/{place}")
            assert caught.value.file == f"{tmp_path}/{place}"
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
    for nothing in (None, 3, 1.5):
        with pytest.raises(TypeError):
            record.save(nothing)


def test_links_go_on_pointing_at_the_file(record, tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "file")
    record.save(tmp_path / "link")
    record.save(tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert not (tmp_path / "file").is_symlink()
    assert len(Record.load(tmp_path / "file")) == len(record)


def test_devices_are_written_to_and_never_replaced(record, tmp_path):
    record.save("/dev/null")
    record.to_csv("/dev/null")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    with pytest.raises(FileError) as caught:
        record.to_csv("/dev/full")
    assert caught.value.file == "/dev/full"
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)
    code = "import devlearn; devlearn.Trial(devlearn.World()).run(5).to_csv('/dev/stdout')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert len(done.stdout.splitlines()) == 6


def test_files_are_open_to_whom_the_umask_allows(record, tmp_path):
    before = os.umask(0o027)
    try:
        record.save(tmp_path / "record.npz")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "record.npz").stat().st_mode) == 0o640


# --- csv -----------------------------------------------------------------------------------------


def test_csv_reads_back_to_the_same_values(record, tmp_path):
    path = tmp_path / "record.csv"
    record.to_csv(path)
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert json.loads((tmp_path / "record.csv.json").read_text()) == record.provenance
    assert len(rows) == len(record)
    after = np.concatenate([record.path(i)[1:] for i in range(3)])
    expected = {name: getattr(record, name) for name in STEP_COLUMNS}
    expected |= {"x": after[:, 0], "y": after[:, 1], "heading": after[:, 2]}
    expected |= {f"echo_{i}": record.echoes[:, i] for i in range(5)}
    assert list(rows[0]) == list(expected)
    for name, column in expected.items():
        read = np.array([float(row[name]) for row in rows])
        assert np.array_equal(read, column, equal_nan=column.dtype.kind == "f"), name
        if column.dtype.kind != "f":
            assert all(row[name] == str(int(row[name])) for row in rows)
    table = np.genfromtxt(path, delimiter=",", names=True)
    assert (table["sef"] == record.sef).all()
    assert (table["collided"] == record.collided).all()


def test_csv_keeps_infinite_clearance(tmp_path):
    record = Trial(World.load("empty"), seed=1).free_learning(20)
    record.to_csv(pathlib.Path(tmp_path / "e.csv"))
    table = np.genfromtxt(tmp_path / "e.csv", delimiter=",", names=True)
    assert np.isinf(table["clearance"]).all()


# --- as a table -----------------------------------------------------------------------------------


def test_columns_are_had_by_name_and_counted_out(record):
    names = [*STEP_COLUMNS, *POSE_COLUMNS, "rounds", "echoes"]
    assert list(record) == names
    assert all(record[name] is getattr(record, name) for name in names)
    assert "sef" in record
    assert "provenance" not in record
    with pytest.raises(KeyError, match="no column 'sefs'; did you mean 'sef'"):
        record["sefs"]
    with pytest.raises(KeyError, match="there are round, situation"):
        record[3]
    brief = Trial(World()).run(5)
    assert "echoes" not in brief
    with pytest.raises(KeyError):
        brief["echoes"]


def test_records_are_equal_by_value(record, tmp_path):
    record.save(tmp_path / "record.npz")
    again = Record.load(tmp_path / "record.npz")
    assert again == record
    assert copy.deepcopy(record) == record
    again.sef[3] += 1e-9
    assert again != record
    other = copy.copy(record)
    other.provenance = {**record.provenance, "seed": 99}
    assert other != record
    assert record != 3
    with pytest.raises(TypeError, match="unhashable"):
        hash(record)


def test_pandas_gets_a_row_a_step_with_names_for_kinds_and_events(record, tmp_path):
    pandas = pytest.importorskip("pandas")
    frame = record.to_pandas()
    assert len(frame) == len(record)
    assert list(frame["kind"].cat.categories) == [kind.name.lower() for kind in devlearn.Kind]
    assert (frame["kind"].cat.codes.to_numpy() == record.kind).all()
    assert (frame["event"].cat.codes.to_numpy() == record.event).all()
    assert (frame["event"] == "extension").sum() == (record.event == 1).sum()
    last = np.cumsum(record.rounds["steps"] + 1) - 1  # of each round's poses
    assert frame["x"].iloc[-1] == record.x[last[-1]]
    assert frame.attrs["provenance"] == record.provenance
    record.to_csv(tmp_path / "record.csv")
    read = pandas.read_csv(tmp_path / "record.csv")
    assert list(read.columns) == list(frame.columns)
    assert (read["heading"] == frame["heading"]).all()
    with pytest.raises(devlearn.InvalidValue, match="rounds only"):
        Trial(World()).run(5, rounds_only=True).to_pandas()


# --- hostile files --------------------------------------------------------------------------------


def changed(record, **columns):
    """The record with some values set: name=(index, value)."""
    values = {name: record[name].copy() for name in record}
    for name, (index, value) in columns.items():
        values[name][index] = value
    return Record(values, record.provenance)


@pytest.mark.parametrize(
    ("column", "index", "value", "says"),
    [
        ("motion", 5, -7, "motion[5]: got -7"),
        ("kind", 2, 77, "kind[2]: got 77; expected a whole number in [0, 6]"),
        ("event", 0, 200, "event[0]: got 200; expected a whole number in [0, 4]"),
        ("situation", 1, -1, "situation[1]: got -1"),
        ("x", 4, np.nan, "x[4]: got nan"),
        ("heading", 4, np.inf, "heading[4]: got inf"),
        ("sef", 3, np.nan, "sef[3]: got nan"),
        ("goal_distance", 3, -1.0, "goal_distance[3]: got -1"),
        ("clearance", 3, np.nan, "clearance[3]: got nan"),
        ("round", 3, 2, "round[3]: got 2; expected 1, that of its round"),
        ("round", 3, 0, "round[3]: got 0"),
        ("explored_count", 7, -1, "explored_count[7]: got -1"),
        ("reduced", 7, -1, "reduced[7]: got -1"),
        ("arrived", 3, True, "rounds[0].arrived: got false"),
    ],
)
def test_a_record_that_no_trial_can_write_is_refused_by_column_and_row(
    record, tmp_path, column, index, value, says
):
    changed(record, **{column: (index, value)}).save(tmp_path / "bad.npz")
    with pytest.raises(devlearn.FileError, match=re.escape(says)) as refused:
        Record.load(tmp_path / "bad.npz")
    assert refused.value.file == str(tmp_path / "bad.npz")


@pytest.mark.parametrize(
    ("provenance", "says"),
    [
        ({"world": 3}, "provenance.world"),
        ({"world": {"name": 3}}, "provenance.world.name"),
        ({"config": []}, "provenance.config"),
        ({"commit": None}, "provenance.commit"),
    ],
)
def test_a_provenance_of_another_shape_is_refused(record, provenance, says):
    with pytest.raises(devlearn.InvalidValue, match=says):
        Record({name: record[name] for name in record}, provenance)


LARGE = """
import resource, sys, zipfile
import devlearn
resource.setrlimit(resource.RLIMIT_AS, (600 << 20,) * 2)
try:
    devlearn.Record.load(sys.argv[1])
except devlearn.FileError as error:
    print(error)
"""


@pytest.mark.parametrize("column", ["surprise", "sef", "rounds", "echoes", "header"])
def test_a_column_that_unpacks_to_a_gigabyte_is_refused_unread(saved, tmp_path, column):
    path = tmp_path / "large.npz"
    kind, length = {"rounds": ("|u1", 2**30), "header": ("<U268435456", 1)}.get(
        column, ("<f8", 2**27)
    )
    shape = () if column == "header" else (length,)
    text = repr({"descr": kind, "fortran_order": False, "shape": shape})
    head = b"\x93NUMPY\x01\x00" + (118).to_bytes(2, "little") + text.encode().ljust(117) + b"\n"
    with zipfile.ZipFile(saved) as old, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as new:
        for info in old.infolist():
            if info.filename != f"{column}.npy":
                new.writestr(info.filename, old.read(info))
        with new.open(f"{column}.npy", "w", force_zip64=True) as file:
            file.write(head)
            for _ in range(1 << 10):
                file.write(bytes(1 << 20))
    ran = subprocess.run(
        [sys.executable, "-c", LARGE, path], capture_output=True, text=True, timeout=60
    )
    assert ran.stderr == ""
    assert f"large.npz: {column}: got " in ran.stdout


def test_mutated_files_are_refused_or_are_records(saved, tmp_path):
    content = saved.read_bytes()
    generator = np.random.default_rng(5)
    path = tmp_path / "mutated.npz"
    refused = 0
    for _ in range(400):
        mutated = bytearray(content)
        for _ in range(generator.integers(1, 4)):
            mutated[generator.integers(len(mutated))] = generator.integers(256)
        if generator.random() < 0.2:
            del mutated[generator.integers(len(mutated)) :]
        path.write_bytes(mutated)
        try:
            assert len(Record.load(path)) == 600
        except devlearn.FileError as error:
            assert "allow_pickle" not in str(error)
            refused += 1
    assert refused > 200


def test_an_array_of_objects_is_refused_without_advice_to_unpickle_it(saved, tmp_path):
    path = tmp_path / "objects.npz"
    with np.load(saved) as old:
        np.savez(path, **{**old, "sef": np.array([None] * 600, object)}, allow_pickle=True)
    with pytest.raises(devlearn.FileError) as refused:
        Record.load(path)
    assert "pickle" not in str(refused.value)


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_what_is_no_file_is_refused_at_once(tmp_path, make):
    make(tmp_path / "it")
    with pytest.raises(devlearn.FileError, match="not a regular file"):
        Record.load(tmp_path / "it")
