"""Worlds that move, and worlds that are changed between rounds, as Python sees them."""

import copy
import json
import pathlib
import pickle

import devlearn
import jsonschema
import numpy as np
import pytest
from conftest import refused
from devlearn import (
    Circle,
    FileError,
    Mover,
    MoverPath,
    MoverWalk,
    Record,
    Rectangle,
    Robot,
    Trial,
    TrialConfig,
    World,
    plots,
)
from devlearn.experiments.sweep import sweep

SCHEMA = json.loads((pathlib.Path(devlearn.__file__).parent / "world.schema.json").read_text())
VALIDATOR = jsonschema.validators.validator_for(SCHEMA)(SCHEMA)

PATROL = Mover(Circle((0, 0), 0.2), MoverPath([(1, 3.6), (3.4, 1.2)], 0.08, "back"))
WALKER = Mover(Rectangle((0, 0), (0.3, 0.2), 20), MoverWalk(4, (1.2, 1.2), (4.6, 4.6), 15))


def moving(*movers, **more):
    paper = World.load("paper")
    return World(
        start=paper.start,
        target=paper.target,
        obstacles=more.pop("obstacles", paper.obstacles),
        movers=movers or (PATROL, WALKER),
        name="moving",
        **more,
    )


# --- worlds --------------------------------------------------------------------------------------


def test_text_pickles_and_copies_bring_back_an_equal_world():
    world = moving()
    for back in (
        World.from_json(world.to_json()),
        pickle.loads(pickle.dumps(world)),
        copy.deepcopy(world),
    ):
        assert back == world
        assert back.hash == world.hash
        assert back.movers == [PATROL, WALKER]
        assert back.movers_at(33.3) == world.movers_at(33.3)


def test_movers_are_values():
    for thing in (PATROL, WALKER, PATROL.course, WALKER.course):
        assert pickle.loads(pickle.dumps(thing)) == thing
        assert eval(repr(thing), vars(devlearn)) == thing
    assert PATROL != WALKER
    assert PATROL.shape == Circle((0, 0), 0.2)
    assert (PATROL.course.points, PATROL.course.speed, PATROL.course.then) == (
        [(1, 3.6), (3.4, 1.2)],
        0.08,
        "back",
    )
    walk = WALKER.course
    assert (walk.seed, walk.low, walk.high, walk.leg_time) == (4, (1.2, 1.2), (4.6, 4.6), 15)


def test_a_world_without_movers_has_the_text_and_hash_it_had():
    paper = World.load("paper")
    assert paper.movers == []
    assert "movers" not in paper.to_json()
    assert moving(obstacles=[]).standing().movers == []
    assert "2 movers" in repr(moving())
    assert "movers" not in repr(paper)


def test_the_schema_says_what_is_read():
    text = moving().to_json()
    VALIDATOR.validate(json.loads(text))
    for part, by in (
        ('"radius": 0.2,', '"radius": 0.2, "center": [1, 1],'),
        ('"then": "back"', '"then": "on"'),
        ('"speed": 0.08', '"speed": 1.5'),
        ('"seed": 4', '"seed": -4'),
        ('"leg_time": 15', '"leg_time": 0'),
        ('"path"', '"way"'),
    ):
        assert part in text
        changed = text.replace(part, by, 1)
        with pytest.raises(jsonschema.ValidationError):
            VALIDATOR.validate(json.loads(changed))
        with pytest.raises(FileError):
            World.from_json(changed)


def test_what_no_mover_can_be_is_refused_by_name():
    shape = Circle((0, 0), 0.2)
    assert "2 to 10000" in refused(lambda: MoverPath([(1, 1)], 0.1), "MoverPath.points").allowed
    assert (
        "(0, 1] m/s" in refused(lambda: MoverPath([(1, 1), (2, 2)], 2), "MoverPath.speed").allowed
    )
    assert (
        "'back', 'around' or 'stop'"
        in refused(lambda: MoverPath([(1, 1), (2, 2)], 0.1, "on"), "MoverPath.then").allowed
    )
    assert (
        "at least 5 s"
        in refused(lambda: MoverWalk(1, (0, 0), (3, 4), 4), "MoverWalk.leg_time").allowed
    )
    refused(lambda: MoverWalk(-1, (0, 0), (3, 4), 10), "seed")
    assert (
        "(0, 0)"
        in refused(
            lambda: Mover(Circle((1, 1), 0.2), MoverPath([(1, 1), (2, 2)], 0.1)), "Mover.center"
        ).allowed
    )
    assert (
        "[0, 5] m"
        in refused(
            lambda: World(movers=[Mover(shape, MoverPath([(1, 3), (6, 3)], 0.1))]),
            "movers[0].path.points[1][0]",
        ).allowed
    )
    assert (
        "keeps clear of"
        in refused(
            lambda: World(movers=[Mover(shape, MoverPath([(0.5, 3), (0.5, 0.4)], 0.1))]),
            "movers[0]",
        ).allowed
    )


@pytest.mark.parametrize("bad", [-1.0, 2e9, float("nan")])
def test_a_time_that_never_comes_is_refused(bad):
    refused(lambda: moving().movers_at(bad), "time")
    refused(lambda: moving().clearance(1, 1, time=bad), "time")
    refused(lambda: Robot(moving()).step((0.6, 0.6, 0), 2, bad), "time")


def test_distances_of_arrays_are_those_of_the_time():
    world = moving()
    x, y = np.linspace(0.5, 4.5, 20), np.linspace(4.5, 0.5, 20)
    for time in (0, 17.0, 400):
        expected = [world.clearance(*p, time=time) for p in zip(x, y)]
        assert world.clearance(x, y, time=time).tolist() == expected
    assert not np.array_equal(world.clearance(x, y), world.clearance(x, y, time=17.0))


# --- trials --------------------------------------------------------------------------------------


def test_a_record_tells_the_time_of_each_pose_and_steps_can_be_made_again():
    trial = Trial(moving(), seed=3)
    trial.free_learning(100)
    record = trial.path_learning(2, 150)
    assert trial.time == pytest.approx(0.5 * (100 + len(record)))
    assert record.rounds["began"].tolist() == [100, 100 + record.rounds["steps"][0]]
    times = record.times(1)
    assert times.shape == (record.rounds["steps"][1] + 1,)
    assert times[0] == 0.5 * record.rounds["began"][1]
    path, steps = record.path(1), record.steps_of(1)
    for i, motion in enumerate(record.motion[steps]):
        pose, collided = trial.robot.step(path[i], motion, times[i])
        assert tuple(pose) == tuple(path[i + 1])
        assert collided == record.collided[steps][i]
        x, y, _ = path[i + 1]
        assert record.clearance[steps][i] == trial.world.clearance(x, y, time=times[i + 1])


def test_a_record_of_an_earlier_version_loads_and_does_not_know_its_times(tmp_path):
    record = Trial(moving(), seed=3).free_learning(30)
    record.save(tmp_path / "now.npz")
    assert Record.load(tmp_path / "now.npz") == record
    with np.load(tmp_path / "now.npz") as kept:
        columns = dict(kept)
    columns["rounds"] = columns["rounds"][["round", "steps", "arrived"]].astype(
        [("round", np.int32), ("steps", np.int64), ("arrived", np.bool_)]
    )
    np.savez_compressed(tmp_path / "earlier.npz", **columns)
    earlier = Record.load(tmp_path / "earlier.npz")
    assert earlier.rounds["began"].tolist() == [-1]
    assert earlier.rounds["steps"].tolist() == [30]
    refused(lambda: earlier.times(), "record.rounds.began")


def test_a_copy_and_a_saved_trial_go_on_alike_in_a_moving_world(tmp_path):
    trial = Trial(moving(), TrialConfig.adaptive(), seed=5)
    past = trial.free_learning(333)
    trial.save(tmp_path / "trial", past)
    others = [trial.copy(), Trial.load(tmp_path / "trial"), pickle.loads(pickle.dumps(trial))]
    record = trial.path_learning(3, 400)
    for other in others:
        assert other.time == 166.5
        assert other.path_learning(3, 400) == record
    assert Record.load(tmp_path / "trial") == past


def test_rows_of_a_sweep_over_a_moving_world_are_the_same_on_one_worker_and_on_two(tmp_path):
    moving().save(tmp_path / "moving.json")
    spec = {
        "worlds": [str(tmp_path / "moving.json")],
        "agents": ["paper", "adaptive", "QLearning"],
        "seeds": "1-2",
        "rounds": 3,
        "step_limit": 300,
        "free": [200],
    }
    frames = [
        sweep(spec, tmp_path / f"{workers}.sqlite", workers=workers).to_pandas()
        for workers in (1, 2)
    ]
    # Which run is the first to be finished is chance.
    one, two = (f[[c for c in f.columns if not c.startswith("run")]] for f in frames)
    keys = ["world", "agent", "seed"]
    one, two = (f.sort_values(keys).reset_index(drop=True) for f in (one, two))
    assert len(one) == 6
    assert one.equals(two)


def test_after_a_change_the_provenance_tells_of_the_worlds_before(tmp_path):
    trial = Trial(World.load("paper"), TrialConfig.adaptive(), seed=1)
    before = trial.path_learning(3, 2000)
    assert "earlier_worlds" not in before.provenance
    trial.change_world(moving())
    after = trial.path_learning(2, 2000)
    assert after.world == moving()
    assert before.world == World.load("paper")
    (was,) = after.provenance["earlier_worlds"]
    assert was["hash"] == World.load("paper").hash
    assert World.from_json(was["json"]) == World.load("paper")
    assert was["steps"] == len(before) == after.rounds["began"][0]
    assert trial.earlier_worlds == [(World.load("paper"), len(before))]
    assert after.rounds["round"].tolist() == [4, 5]

    after.save(tmp_path / "after.npz")
    assert Record.load(tmp_path / "after.npz").provenance == after.provenance
    trial.save(tmp_path / "trial", after)
    assert Record.load(tmp_path / "trial").provenance == after.provenance
    assert Trial.load(tmp_path / "trial").earlier_worlds == trial.earlier_worlds
    assert "of one world" in refused(lambda: Record.concatenate([before, after]), "records").allowed


def test_a_world_of_another_arena_is_refused():
    trial = Trial(World.load("paper"))
    assert (
        "5 m x 5 m from (0, 0)"
        in refused(lambda: trial.change_world(World(width=6)), "world.arena").allowed
    )
    assert trial.world == World.load("paper")


def test_a_robot_that_follows_the_shortest_path_gets_past_a_mover():
    world = moving(PATROL)
    agent = devlearn.agents.ShortestPathAgent(Robot(world))
    record = Trial(world, agent=agent).path_learning(3, 1000)
    assert record.rounds["arrived"].all()


# --- plots ---------------------------------------------------------------------------------------


def test_a_plot_shows_movers_where_they_are_and_their_courses_dashed():
    world = moving()
    ax = plots.plot_world(world, time=12.5)
    drawn = {patch.get_gid(): patch for patch in ax.patches}
    assert tuple(drawn["mover-0"].center) == world.movers_at(12.5)[0].center
    assert "mover-1" in drawn
    lines = {line.get_gid(): line for line in ax.get_lines()}
    assert lines["course-0"].get_xydata().tolist() == [[1, 3.6], [3.4, 1.2]]
    assert len(lines["course-1"].get_xydata()) == 5
    assert all(lines[f"course-{i}"].is_dashed() for i in (0, 1))
    assert not any(
        (p.get_gid() or "").startswith("mover")
        for p in plots.plot_world(World.load("paper")).patches
    )


def test_a_path_is_drawn_over_the_movers_as_they_were_when_it_began():
    world = moving()
    trial = Trial(world, seed=1)
    trial.free_learning(50)
    record = trial.free_learning(20)
    drawn = {patch.get_gid(): patch for patch in plots.plot_trajectory(record).patches}
    assert tuple(drawn["mover-0"].center) == world.movers_at(25.0)[0].center
