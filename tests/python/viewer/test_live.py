"""What Rerun is sent while a trial learns: read back from the file, and held to the record."""

import sys
import time
from collections import defaultdict

import devlearn
import numpy as np
import pytest
from devlearn import Circle, FileError, InvalidValue, Kind, Mover, MoverPath, World, WrongType, cli
from devlearn._colours import BLUE, BY_KIND, VERMILLION
from devlearn.errors import MissingExtra
from devlearn.viewer import live as live_module
from devlearn.viewer.live import ALLOWANCE, LEAST, SHARE
from devlearn.viewer.stream import Stream
from handmade import ALL_FOUR, hand_made
from rerun.chunk import RrdReader


class Recording:
    """What is in a file: of each entity, its columns in the order in which they were sent."""

    def __init__(self, path):
        self.columns, self.still = defaultdict(lambda: defaultdict(list)), defaultdict(dict)
        for chunk in RrdReader(path).stream().to_chunks():
            batch = chunk.to_record_batch()
            for name in batch.schema.names:
                values = batch.column(name).to_pylist()
                if chunk.is_static:
                    self.still[chunk.entity_path][name] = values[0]
                else:
                    self.columns[chunk.entity_path][name] += values

    def __getitem__(self, entity_and_column):
        """A column by step, as an array; what each row holds, if it is one, without its list."""
        entity, name = entity_and_column
        columns = self.columns[entity]
        order = np.argsort(columns["step"], kind="stable")
        values = columns[name]
        rows = [v[0] if isinstance(v, list) and len(v) == 1 else v for v in values]
        return np.array([rows[i] for i in order])

    @property
    def log(self):
        columns = self.columns["/events"]
        return [text for (text,) in columns["TextLog:text"]]


class Slow:
    """An agent that draws, a millisecond a choice; so that a phase is shown in many pieces."""

    def __init__(self, seconds=1e-3):
        self.random, self.seconds = devlearn.Random(3, "slow"), seconds

    def choose(self, observation):
        time.sleep(self.seconds)
        return int(self.random.uniform() * 5)

    def observe(self, outcome):
        pass


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """A run, and the file of what was shown of it: all of its steps."""
    path = tmp_path_factory.mktemp("live") / "run.rrd"
    trial = devlearn.Trial(World.load("paper"), seed=2)
    with devlearn.view(trial, path) as live:
        parts = [live.free_learning(1500), live.path_learning(20, step_limit=1200)]
    assert live.steps_shown == live.steps == sum(map(len, parts))
    return devlearn.Record.concatenate(parts), Recording(path)


def after(record):
    """Indices among the poses of those after each step."""
    return (
        np.arange(len(record))
        + np.repeat(np.arange(len(record.rounds)), record.rounds["steps"])
        + 1
    )


# --- the numbers ----------------------------------------------------------------------------------


def test_series_are_the_record_s(shown):
    record, recording = shown
    for entity, columns in (
        ("/evaluation", (record.sef, record.smf_used)),
        ("/mappings", (record.explored_count, record.effective_count)),
    ):
        np.testing.assert_array_equal(
            recording[entity, "Scalars:scalars"], np.column_stack(columns)
        )
        np.testing.assert_array_equal(recording[entity, "step"], np.arange(len(record)) + 1)
        np.testing.assert_array_equal(recording[entity, "round"], record.round)


def test_the_robot_is_where_the_record_has_it_after_each_step(shown):
    record, recording = shown
    at = after(record)
    x, y, z = recording["/world/robot", "Transform3D:translation"].T
    np.testing.assert_allclose(x, record.x[at], atol=1e-6)
    np.testing.assert_allclose(y, record.y[at], atol=1e-6)
    assert not z.any()
    _, _, sine, cosine = recording["/world/robot", "Transform3D:quaternion"].T
    turned = np.degrees(2 * np.arctan2(sine, cosine)) - record.heading[at]
    np.testing.assert_allclose((turned + 180) % 360 - 180, 0, atol=1e-4)


def test_each_step_of_the_path_is_a_line_of_the_entity_of_its_kind(shown):
    record, recording = shown
    found = 0
    for kind in Kind:
        chosen = np.flatnonzero(record.kind == kind)
        lines = recording[f"/world/path/{kind.name.lower()}", "LineStrips2D:strips"]
        assert len(lines) == len(chosen)
        ends = after(record)[chosen]
        for pose, point in ((ends - 1, 0), (ends, 1)):
            if len(chosen):
                np.testing.assert_allclose(lines[:, point, 0], record.x[pose], atol=1e-6)
                np.testing.assert_allclose(lines[:, point, 1], record.y[pose], atol=1e-6)
        found += len(lines)
    assert found == len(record)


def test_touches_are_marked_where_the_robot_is_then(shown):
    record, recording = shown
    touched = np.flatnonzero(record.collided)
    assert len(touched) > 0
    np.testing.assert_array_equal(recording["/world/touches", "step"], touched + 1)
    x = recording["/world/touches", "Points2D:positions"][:, 0]
    np.testing.assert_allclose(x, record.x[after(record)[touched]], atol=1e-6)


def test_each_round_has_its_steps_at_its_end_once(shown):
    record, recording = shown
    rounds = record.rounds
    for name, chosen in (("arrived", rounds["arrived"]), ("failed", ~rounds["arrived"])):
        assert (
            recording[f"/rounds/{name}", "Scalars:scalars"].tolist()
            == rounds["steps"][chosen].tolist()
        )
        assert recording[f"/rounds/{name}", "round"].tolist() == rounds["round"][chosen].tolist()
        ends = (rounds["began"] + rounds["steps"])[chosen]
        assert recording[f"/rounds/{name}", "step"].tolist() == ends.tolist()
    assert 0 < rounds["arrived"].sum() < len(rounds)


def test_time_is_the_world_s(shown):
    record, recording = shown
    seconds = [time.total_seconds() for time in recording["/evaluation", "time"]]
    step_time = record.config.robot.sample_time
    np.testing.assert_allclose(seconds, step_time * (np.arange(len(record)) + 1), atol=1e-6)


def test_the_log_tells_of_phases_rounds_arrivals_touches_and_reductions(shown):
    record, recording = shown
    log = recording.log
    assert log.count("free learning") == log.count("path learning") == 1
    for number, steps, arrived, _ in record.rounds.tolist():
        told = f"{steps} steps, arrived" if arrived else f"not arrived in {steps} steps"
        assert f"round {number}: {told}" in log
    assert sum(line.startswith("touches something") for line in log) > 0
    assert log[-1] == f"the end: {len(record)} of {len(record)} steps are shown"


def test_reductions_are_told_when_they_happened():
    record = hand_made(ALL_FOUR)
    record.rounds["began"] = 100
    words = [word for word in live_module._happened(record) if "loses" in word.text]
    assert words == [(118, 0, "DEBUG", "situation 0 loses 1 of its motions")]


def test_colours_are_those_of_all_pictures(shown):
    _, recording = shown

    def rgb(entity, archetype):
        return [f"#{colour >> 8:06X}" for colour in recording.still[entity][f"{archetype}:colors"]]

    for kind, colour in BY_KIND.items():
        assert rgb(f"/world/path/{kind.name.lower()}", "LineStrips2D") == [colour]
    assert rgb("/rounds/arrived", "SeriesLines") == [BLUE]
    assert rgb("/rounds/failed", "SeriesPoints") == [VERMILLION]
    assert rgb("/mappings", "SeriesLines") == [BLUE, VERMILLION]
    assert recording.still["/mappings"]["SeriesLines:names"] == ["explored", "effective"]


def test_y_points_up_by_a_transform_not_by_other_numbers(shown):
    _, recording = shown
    assert recording.still["/world"]["Transform3D:scale"] == [[1.0, -1.0, 1.0]]


def test_the_file_says_where_it_comes_from(shown):
    record, recording = shown
    (about,) = recording.still["/about"]["TextDocument:text"]
    assert record.provenance["world"]["hash"] in about
    assert '"seed": 2' in about


def test_what_moves_is_where_the_world_has_it(tmp_path):
    mover = Mover(Circle((0, 0), 0.2), MoverPath([(1, 1), (4, 1)], speed=0.2))
    world = World(5, 5, (1, 4, 0), (4, 4), movers=[mover])
    trial = devlearn.Trial(world, seed=1)
    with devlearn.view(trial, tmp_path / "run.rrd") as live:
        live.free_learning(50)
    recording = Recording(tmp_path / "run.rrd")
    outlines = recording["/world/movers", "LineStrips2D:strips"]
    steps = recording["/world/movers", "step"]
    assert steps.tolist() == list(range(51))
    step_time = trial.config.robot.sample_time
    for step, outline in zip(steps.tolist(), outlines):
        (shape,) = world.movers_at(step * step_time)
        np.testing.assert_allclose(outline[:-1].mean(axis=0), shape.center, atol=1e-5)


def test_a_world_that_changes_is_drawn_from_then_on(tmp_path):
    worlds = [World(5, 5, (1, 4, 0), (4, 4), [Circle((2, 2), r)]) for r in (0.3, 0.5)]
    trial = devlearn.Trial(worlds[0], seed=1)
    with devlearn.view(trial, tmp_path / "run.rrd") as live:
        live.free_learning(20)
        trial.change_world(worlds[1])
        live.free_learning(20)
    recording = Recording(tmp_path / "run.rrd")
    assert recording["/world/obstacles", "step"].tolist() == [0, 20]
    across = np.ptp(recording["/world/obstacles", "LineStrips2D:strips"][..., 0], axis=1)
    np.testing.assert_allclose(across, [0.6, 1.0], atol=1e-5)


# --- the same history -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phase", "counts", "options"),
    [
        ("free_learning", (400,), {"echoes": True}),
        ("path_learning", (6, 70), {}),
        ("path_learning", (5, 60), {"rounds_only": True}),
        ("path_learning", (0,), {}),
        ("run", (0,), {}),
        ("finish_round", (300,), {}),
    ],
)
def test_a_phase_in_pieces_gives_the_record_of_one_call(
    paper, tmp_path, monkeypatch, phase, counts, options
):
    monkeypatch.setattr(live_module, "BETWEEN", 0.0)  # a piece ends at the first look, after 20 ms
    plain, watched = (devlearn.Trial(paper, seed=4, agent=Slow(s)) for s in (0.0, 1e-3))
    for trial in (plain, watched):
        trial.begin_round()
    expected = getattr(plain, phase)(*counts, **options)
    with devlearn.view(watched, tmp_path / "run.rrd") as live:
        sent, send = [], live.send
        monkeypatch.setattr(live, "send", lambda *part: (sent.append(part), send(*part)))
        assert getattr(live, phase)(*counts, **options) == expected
    assert len(sent) > 5 or counts == (0,)
    assert (watched.pose, watched.round, watched.time) == (plain.pose, plain.round, plain.time)
    assert live.steps == len(expected)


def test_the_learner_and_its_snapshot_are_those_of_one_call(paper, tmp_path):
    plain, watched = (devlearn.Trial(paper, seed=4) for _ in range(2))
    tallies = devlearn.Tally(), devlearn.Tally()
    expected = plain.path_learning(10, learner=True, tally=tallies[0])
    with devlearn.view(watched, tmp_path / "run.rrd") as live:
        assert live.path_learning(10, learner=True, tally=tallies[1]) == expected
    assert tallies[0].steps == tallies[1].steps == len(expected)
    assert watched.learner.to_bytes() == plain.learner.to_bytes()


class Fails(Slow):
    """After so many choices."""

    def choose(self, observation):
        self.left = getattr(self, "left", 200) - 1
        if self.left < 0:
            raise RuntimeError("no more")
        return super().choose(observation)


def test_an_exception_leaves_what_was_finished_in_the_trial_and_in_the_file(
    paper, tmp_path, monkeypatch
):
    monkeypatch.setattr(live_module, "BETWEEN", 0.0)
    plain, watched = (devlearn.Trial(paper, seed=4, agent=Fails(s)) for s in (0.0, 1e-3))
    with pytest.raises(RuntimeError, match="no more"):
        plain.path_learning(9, 60)
    with (
        pytest.raises(RuntimeError, match="no more"),
        devlearn.view(watched, tmp_path / "run.rrd") as live,
    ):
        live.path_learning(9, 60)
    assert watched.interrupted == plain.interrupted
    assert Recording(tmp_path / "run.rrd")["/evaluation", "step"].tolist() == list(range(1, 201))


class Stopped:
    """Asks to stop at the third look."""

    looks = 0

    def is_set(self):
        self.looks += 1
        return self.looks >= 3


def test_a_phase_stops_where_it_is_asked_to(paper, tmp_path):
    trial = devlearn.Trial(paper, seed=4, agent=Slow())
    with devlearn.view(trial, tmp_path / "run.rrd") as live:
        record = live.path_learning(50, stop=Stopped())
    assert 0 < len(record) < 500


# --- what does not fit ----------------------------------------------------------------------------


def test_what_is_too_much_is_thinned_and_the_log_says_so(paper, tmp_path, monkeypatch):
    for name, value in {"IN_FULL": 500, "A_SECOND": 0, "LEAST": 100}.items():
        monkeypatch.setattr(live_module, name, value)
    trial = devlearn.Trial(paper, seed=2)
    with devlearn.view(trial, tmp_path / "run.rrd") as live:
        free = live.free_learning(4000)
        paths = live.path_learning(100, step_limit=300)
    recording = Recording(tmp_path / "run.rrd")
    made = len(free) + len(paths)
    steps = recording["/evaluation", "step"]
    assert live.steps == made
    assert live.steps_shown == len(steps) < 1500 < made
    assert any("one is shown" in line for line in recording.log)
    assert recording.log[-1] == f"the end: {len(steps)} of {made} steps are shown"
    assert any(line.endswith(" more touches") for line in recording.log)
    rounds = len(recording["/rounds/arrived", "step"]) + len(recording["/rounds/failed", "step"])
    assert rounds == 101
    whole = devlearn.Record.concatenate([free, paths])
    np.testing.assert_array_equal(
        recording["/evaluation", "Scalars:scalars"][:, 0], whole.sef[steps - 1]
    )


def test_showing_takes_no_more_than_its_share_of_the_time_however_slow_it_is(
    paper, tmp_path, monkeypatch
):
    def slow(stream):
        time.sleep(0.08)

    monkeypatch.setattr(Stream, "flush", slow)
    monkeypatch.setattr(live_module, "BETWEEN", 0.02)
    trial = devlearn.Trial(paper, seed=4, agent=Slow())
    live = devlearn.view(trial, tmp_path / "run.rrd")
    began = time.perf_counter()
    live.free_learning(700)
    took = time.perf_counter() - began
    spent = live._spent
    live.close()
    one_more = 0.15  # a batch is begun while there is time left
    assert 0.08 < spent <= ALLOWANCE + SHARE * (took - spent) + one_more
    assert live.steps_shown >= LEAST or live.steps_shown == 700


# --- what goes wrong ------------------------------------------------------------------------------


def test_a_viewer_that_is_gone_ends_nothing_but_the_showing(paper, tmp_path, monkeypatch):
    def gone(stream):
        raise RuntimeError("the viewer is gone")

    monkeypatch.setattr(Stream, "flush", gone)
    expected = devlearn.Trial(paper, seed=4).free_learning(500)
    with pytest.warns(RuntimeWarning, match="nothing is shown any more: the viewer is gone"):
        with devlearn.view(devlearn.Trial(paper, seed=4), tmp_path / "run.rrd") as live:
            assert live.free_learning(500) == expected
    assert "gone" in str(live.failed)


def test_a_closed_view_is_refused(paper, tmp_path):
    trial = devlearn.Trial(paper)
    with devlearn.view(trial, tmp_path / "run.rrd") as live:
        record = live.run(5)
    live.close()  # again: nothing
    with pytest.raises(InvalidValue, match="closed"):
        live.send(record)


def test_a_record_that_does_not_tell_when_it_began_is_refused(paper, tmp_path):
    trial = devlearn.Trial(paper)
    with devlearn.view(trial, tmp_path / "run.rrd") as live:
        record = trial.free_learning(5)
        record.rounds["began"] = -1
        with pytest.raises(InvalidValue, match="began"):
            live.send(record)
        with pytest.raises(WrongType, match="Record"):
            live.send([record])
        with pytest.raises(InvalidValue, match="progress"):
            live.run(5, progress=print)
        with pytest.raises(WrongType, match="is_set"):
            live.run(5, stop=3)
    assert trial.round == 1


@pytest.mark.parametrize("name", ["run", "run.npz", "rrd"])
def test_a_name_of_no_recording_is_refused(paper, tmp_path, name):
    (tmp_path / name).write_text("mine")
    with pytest.raises(InvalidValue, match="ends in .rrd"):
        devlearn.view(devlearn.Trial(paper), tmp_path / name)
    assert (tmp_path / name).read_text() == "mine"


def test_a_missing_folder_is_refused(paper, tmp_path):
    with pytest.raises(FileError, match=r"nowhere.run\.rrd: got No such file"):
        devlearn.view(devlearn.Trial(paper), tmp_path / "nowhere" / "run.rrd")


@pytest.mark.parametrize(
    "address",
    ["127.0.0.1:9876", "http://127.0.0.1:9876", "rerun+http://", "rerun+http://127.0.0.1:1/proxy"],
)
def test_an_address_without_a_viewer_is_refused(paper, address):
    with pytest.raises(InvalidValue, match="the address of a viewer that runs"):
        devlearn.view(devlearn.Trial(paper), connect=address)


def test_without_a_display_one_is_told_to_write_a_file(paper, monkeypatch, tmp_path, capsys):
    for display in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(display, raising=False)
    with pytest.raises(InvalidValue, match=r"no display.*run\.rrd"):
        devlearn.view(devlearn.Trial(paper))
    few = ["run", "paper", "--steps", "10", "--rounds", "0", "--output", str(tmp_path / "out")]
    assert cli.main([*few, "--view"]) == 1
    assert "--view-to run.rrd" in capsys.readouterr().err


def test_a_missing_package_is_named_with_how_to_get_it(paper, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    monkeypatch.delitem(sys.modules, "devlearn.viewer.stream")
    with pytest.raises(MissingExtra, match="pip install .*rerun-sdk"):
        devlearn.view(devlearn.Trial(paper), tmp_path / "run.rrd")
    assert not (tmp_path / "run.rrd").exists()


# --- the command line -----------------------------------------------------------------------------


def test_a_run_that_is_shown_writes_what_it_writes_otherwise(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("devlearn.cli.run._draw", lambda folder, made: None)
    few = ["run", "paper", "--seed", "3", "--steps", "800", "--rounds", "5", "--output"]
    assert cli.main([*few, str(tmp_path / "plain")]) == 0
    path = tmp_path / "run.rrd"
    assert cli.main([*few, str(tmp_path / "shown"), "--view-to", str(path)]) == 0
    assert f"steps and all rounds: {path}" in capsys.readouterr().out
    records = []
    for phase in ("free_1", "free_2", "paths"):
        plain, watched = (
            devlearn.Record.load(tmp_path / folder / f"{phase}.npz")
            for folder in ("plain", "shown")
        )
        assert plain == watched
        records.append(watched)
    whole = devlearn.Record.concatenate(records)
    recording = Recording(path)
    np.testing.assert_array_equal(recording["/evaluation", "Scalars:scalars"][:, 0], whole.sef)
    assert recording.log.count("free learning") == recording.log.count("path learning") == 1
