"""The closed loop: what a history is made of, and that the same seed gives the same one."""

import concurrent.futures
import os
import pathlib
import signal
import subprocess
import threading
import time

import devlearn
import numpy as np
import pytest
from conftest import differences, joined, refused, same
from devlearn import Event, Kind, Robot, Trial, TrialConfig, World

SOURCE = pathlib.Path(__file__).parents[2]
GOLDEN = SOURCE / "tests" / "golden"


# --- the same seed, the same history -------------------------------------------------------------


def lines_of(record):
    """The record as the golden files have it: a line a step, before each round its first pose."""
    columns = zip(
        *(
            getattr(record, name).astype(int).tolist()
            for name in (
                "situation",
                "motion",
                "kind",
                "event",
                "reduced",
                "explored_count",
                "effective_count",
                "collided",
                "arrived",
            )
        )
    )
    names = ("sef", "smf", "smf_used", "goal_distance", "clearance")
    numbers = np.column_stack([getattr(record, name) for name in names]).tolist()
    lines = []
    for i, (number, steps, arrived, _) in enumerate(record.rounds.tolist()):
        path = record.path(i).tolist()
        pose = " ".join(f"{value:.17g}" for value in path[0])
        lines.append(f"round {number} {steps} {int(arrived)} {pose}")
        for pose, after in zip(path[1:], numbers[record.steps_of(i)]):
            whole = "".join(f"{value} " for value in next(columns))
            lines.append(whole + "| " + " ".join(f"{value:.17g}" for value in pose + after))
    return lines


def whole_history(trial, steps):
    free, again = trial.free_learning(steps), trial.free_learning(steps // 2)
    return joined([free, again, trial.path_learning(20, 400)])


def golden_trial(preset):
    world = World(
        12,
        12,
        (5, 5, 0),
        (6.5, 6),
        [
            devlearn.Circle((4.6, 6.8), 0.2),
            devlearn.Rectangle((8, 4.2), (0.4, 0.2), 30),
            devlearn.Polygon([(8.5, 7.5), (9.5, 7.4), (8.9, 8.2)]),
        ],
        name="open",
    )
    config = getattr(TrialConfig, preset)()
    config = config.replace(evaluation=devlearn.StateEvaluation(a3=3, a4=0.5, a5=1.5))
    if preset == "adaptive":  # it goes about more than the others
        config = config.replace(robot=config.robot.replace(safety_margin=0.05))
    return Trial(world, config, seed=2)


@pytest.mark.parametrize("preset", ["paper", "step5", "adaptive"])
def test_the_golden_trial_is_repeated_to_the_last_bit(preset):
    record = whole_history(golden_trial(preset), 3000)
    assert not record.collided.any()  # so Box2D has no say in it
    lines = lines_of(record)
    golden = (GOLDEN / f"trial_{preset}.txt").read_text().splitlines()
    assert lines[:200] == golden[1:201]
    assert lines[-20:] == golden[202:]
    digest = 0xCBF29CE484222325
    for byte in "".join(line + "\n" for line in lines).encode():
        digest = (digest ^ byte) * 0x100000001B3 % 2**64
    assert golden[0] == f"hash {digest:016x} of {len(lines)} lines"


def test_the_adaptive_preset_makes_one_history_at_once_step_by_step_and_in_threads():
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        records = list(pool.map(lambda _: whole_history(golden_trial("adaptive"), 3000), range(4)))
    record = whole_history(golden_trial("adaptive"), 3000)
    assert all(differences(record, other) == [] for other in records)

    trial, steps = golden_trial("adaptive"), []
    for count, until_arrival in [(3000, False), (1500, False), *[(400, True)] * 20]:
        trial.begin_round()
        for _ in range(count):
            steps.append(trial.step())
            if until_arrival and steps[-1].arrived:
                trial.learner.end_round(True)
                break
    assert len(steps) == len(record.motion)
    for name in devlearn.record.STEP_COLUMNS:
        column = getattr(record, name)
        assert same(np.array([getattr(s, name) for s in steps], column.dtype), column), name
    assert trial.learner.habit_cost is not None


def cpp_tests():
    """The C++ tests: those that scripts/test just built, or what is built and up to date."""
    if given := os.environ.get("DEVLEARN_TEST_SIM"):
        return given
    path = SOURCE / "build" / "release" / "tests/cpp/test_sim"
    sources = [*(SOURCE / "cpp").rglob("*.?pp")] + [
        SOURCE / "tests" / "cpp" / "sim" / "loop" / "test_trial.cpp"
    ]
    if not path.exists():
        pytest.skip(f"{path} is not built")
    if path.stat().st_mtime < max(source.stat().st_mtime for source in sources):
        pytest.skip(f"{path} is out of date")
    return path


def test_a_history_with_contacts_is_the_same_from_cpp(paper, tmp_path):
    file = tmp_path / "history"
    subprocess.run(
        [cpp_tests(), "-tc=the history of the paper's world*"],
        env=os.environ | {"DEVLEARN_WRITE_HISTORY": str(file)},
        check=True,
        capture_output=True,
    )
    record = whole_history(Trial(paper, seed=7), 3000)
    assert record.collided.sum() > 10
    assert lines_of(record) == file.read_text().splitlines()


def test_the_same_seed_gives_the_same_history_and_another_another(paper):
    first, second, third = (whole_history(Trial(paper, seed=s), 2000) for s in (7, 7, 8))
    assert differences(first, second) == []
    assert "motion" in differences(first, third)


@pytest.mark.parametrize("world", ["paper", "u_trap"])
def test_one_call_step_by_step_and_pieces_give_the_same_history(world):
    world = World.load(world)
    record = Trial(world, seed=3).free_learning(2500)

    trial = Trial(world, seed=3)
    steps = [trial.step() for _ in range(2500)]
    for name in devlearn.record.STEP_COLUMNS:
        column = getattr(record, name)
        assert same(np.array([getattr(s, name) for s in steps], column.dtype), column), name
    assert same(np.array([s.pose for s in steps]), record.path()[1:])

    trial = Trial(world, seed=3)
    pieces = [trial.free_learning(1), *(trial.run(n) for n in (0, 7, 1500, 992))]
    for name in devlearn.record.STEP_COLUMNS:
        column = np.concatenate([getattr(piece, name) for piece in pieces])
        assert same(column, getattr(record, name)), name
    for before, after in zip(pieces, pieces[1:]):
        assert (after.path()[0] == before.path()[-1]).all()
    assert trial.round == 1


def test_path_learning_is_the_same_in_one_call_and_round_by_round(paper):
    whole, single = Trial(paper, seed=3), Trial(paper, seed=3)
    record = whole.path_learning(8, 500)
    assert differences(record, joined([single.path_learning(1, 500) for _ in range(8)])) == []


def test_echoes_change_nothing_but_are_there(paper):
    plain = Trial(paper, seed=2).free_learning(1000)
    heard = Trial(paper, seed=2).free_learning(1000, echoes=True)
    assert differences(plain, heard) == ["echoes"]
    assert plain.echoes is None
    assert heard.echoes.shape == (1000, 5)


def test_trials_that_take_turns_do_not_disturb_each_other(paper):
    alone = Trial(paper, seed=2).free_learning(300)
    trial, other = Trial(paper, seed=2), Trial(World.load("clutter"), seed=9)
    motions = []
    for _ in range(300):
        motions.append(trial.step().motion)
        other.step()
    assert motions == alone.motion.tolist()


def test_the_learner_given_the_same_situations_and_smf_makes_the_same_choices(history):
    for preset in (TrialConfig.paper(), TrialConfig.step5()):
        record = Trial(history.world, preset, seed=5).free_learning(3000)
        learner = devlearn.Learner(preset.learner, seed=5)
        for situation, motion, kind, smf, event, reduced, explored, effective in zip(
            record.situation.tolist(),
            record.motion.tolist(),
            record.kind.tolist(),
            record.smf_used.tolist(),
            record.event.tolist(),
            record.reduced.tolist(),
            record.explored_count.tolist(),
            record.effective_count.tolist(),
        ):
            choice = learner.choose(situation)
            assert (choice.motion, choice.kind) == (motion, kind)
            development = learner.learn(smf)
            assert (development.event, development.reduced) == (event, reduced)
            assert learner.explored_count == explored
            assert learner.effective_count == effective


# --- what the columns say ------------------------------------------------------------------------


def test_poses_follow_eq_1_wherever_nothing_was_touched(history):
    angles = np.array(history.config.robot.steering_angles)
    free = 0
    for i in range(len(history.rounds)):
        steps, path = history.steps_of(i), history.path(i)
        heading = path[:-1, 2] + angles[history.motion[steps]]
        assert (np.mod(path[1:, 2] - heading, 360) == 0).all()  # whatever was touched
        assert ((path[:, 2] >= 0) & (path[:, 2] < 360)).all()
        to = np.radians(heading)
        expected = path[:-1, :2] + 0.05 * np.column_stack([np.cos(to), np.sin(to)])
        missed = np.abs(path[1:, :2] - expected).max(axis=1, initial=0)
        assert missed[~history.collided[steps]].max(initial=0) < 1e-12
        free += (~history.collided[steps]).sum()
        # A contact never carries the body further than it drives.
        moved = np.hypot(*(path[1:, :2] - path[:-1, :2]).T)
        assert moved.max(initial=0) < 0.05 + 0.006
    assert free > 3000
    assert history.collided.sum() > 10


def test_situations_are_those_of_the_poses_before_each_step(history):
    grid = devlearn.SituationGrid()
    for i in range(len(history.rounds)):
        before = history.path(i)[:-1]
        assert (history.situation[history.steps_of(i)] == grid.situation(*before.T)).all()


def test_distances_sef_and_smf_are_those_of_the_poses_after_each_step(history):
    world, evaluation = history.world, devlearn.StateEvaluation()
    for i in range(len(history.rounds)):
        steps, path = history.steps_of(i), history.path(i)
        distance = np.hypot(*(path[:, :2] - world.target).T)
        clearance = world.clearance(path[:, 0], path[:, 1])
        sef = (20 - 0.3 * distance**2) - 0.2 * np.exp(5 - 12 * clearance)
        assert np.abs(history.goal_distance[steps] - distance[1:]).max(initial=0) < 1e-12
        assert (history.clearance[steps] == clearance[1:]).all()
        assert np.abs(history.sef[steps] - sef[1:]).max(initial=0) < 1e-11
        assert (history.sef[steps] == evaluation(history.goal_distance[steps], clearance[1:])).all()
        before = np.concatenate([[evaluation(distance[0], clearance[0])], history.sef[steps]])
        assert np.abs(history.smf[steps] - np.diff(before)).max(initial=0) < 1e-12
        assert (history.smf[steps][1:] == np.diff(history.sef[steps])).all()
        assert (history.arrived[steps] == (history.goal_distance[steps] <= 0.1)).all()


def test_a_collision_is_never_effective_and_all_else_is_learned_as_it_was(history):
    expected = np.where(history.collided, np.minimum(history.smf, -1), history.smf)
    assert (history.smf_used == expected).all()
    assert (history.smf[history.collided] > -1).any()  # so the rule has had its say


def test_counts_are_the_sums_of_the_events(history):
    entered = history.event == Event.EXTENSION
    left = history.reduced + (history.event == Event.ABANDONMENT)
    assert (history.effective_count == np.cumsum(entered.astype(int) - left)).all()
    assert (history.explored_count == np.cumsum(history.kind == Kind.EXPLORE)).all()
    assert (history.effective_count <= history.explored_count).all()
    assert set(np.unique(history.kind)) <= {Kind.EXPLORE, Kind.EXPLOIT, Kind.EXHAUSTED}
    effective = history.smf_used >= 0
    explored = history.kind == Kind.EXPLORE
    exploited = history.kind == Kind.EXPLOIT
    assert (history.event[explored & effective] == Event.EXTENSION).all()
    assert (history.event[explored & ~effective] == Event.REJECTION).all()
    assert (history.event[exploited & effective] == Event.ORIENTATION).all()
    assert (history.event[exploited & ~effective] == Event.ABANDONMENT).all()
    retried = history.kind == Kind.EXHAUSTED
    assert (history.event[retried & effective] == Event.EXTENSION).all()
    assert (history.event[retried & ~effective] == Event.NOTHING).all()
    assert (history.reduced[history.event != Event.ORIENTATION] == 0).all()


def test_a_mapping_is_explored_once(history):
    explored = history.kind == Kind.EXPLORE
    pairs = list(zip(history.situation[explored].tolist(), history.motion[explored].tolist()))
    assert len(set(pairs)) == len(pairs)


def test_echoes_are_the_sonars_at_the_poses_after_each_step(history):
    robot = devlearn.Robot(history.world)
    for i in range(len(history.rounds)):
        heard = history.echoes[history.steps_of(i)]
        for pose, echoes in list(zip(history.path(i)[1:], heard))[::17]:
            assert (robot.sonar(pose) == echoes).all()


def test_clearance_by_sonar_is_the_least_echo_and_the_radius(paper):
    config = TrialConfig(clearance_source="sonar", walls_count=True)
    record = Trial(paper, config, seed=1).free_learning(1500, echoes=True)
    assert (record.clearance == record.echoes.min(axis=1) + 0.1).all()
    assert record.clearance.max() <= 2.1
    evaluation = devlearn.StateEvaluation()
    assert (record.sef == evaluation(record.goal_distance, record.clearance)).all()


def test_walls_count_where_asked_for(paper):
    record = Trial(paper, TrialConfig(walls_count=True), seed=1).free_learning(1500)
    x, y = record.x[1:], record.y[1:]
    walls = np.minimum(np.minimum(x, 5 - x), np.minimum(y, 5 - y))
    assert (record.clearance == np.minimum(walls, paper.clearance(x, y))).all()
    assert (record.clearance < paper.clearance(x, y)).any()


def test_without_obstacles_the_clearance_is_infinite_and_sef_finite():
    record = Trial(World.load("empty"), seed=1).free_learning(200)
    assert np.isinf(record.clearance).all()
    assert np.isfinite(record.sef).all()


# --- rounds --------------------------------------------------------------------------------------


def test_free_rounds_are_numbered_1_and_2_and_path_learning_goes_on_from_3(history):
    assert history.rounds["round"].tolist() == list(range(1, 15))
    for i, number in enumerate(history.rounds["round"]):
        assert (history.round[history.steps_of(i)] == number).all()


def test_rounds_begin_at_the_start_and_those_of_path_learning_end_where_they_arrive(history):
    for i, (_, steps, arrived, _) in enumerate(history.rounds.tolist()):
        path, reached = history.path(i), history.arrived[history.steps_of(i)]
        assert path.shape == (steps + 1, 3)
        assert tuple(path[0]) == history.world.start
        assert arrived == reached.any()
        if i >= 2:
            assert not reached[:-1].any()
            assert arrived or steps == 600
    outcomes = history.rounds["arrived"][2:]
    assert outcomes.any()
    assert not outcomes.all()


def test_the_goal_radius_is_where_a_round_ends(paper):
    for radius in (0.1, 1.0):
        trial = Trial(paper, TrialConfig(goal_radius=radius), seed=1)
        record = trial.path_learning(3)
        last = np.cumsum(record.rounds["steps"]) - 1
        assert (record.goal_distance[last] <= radius).all()
        assert (np.delete(record.goal_distance, last) > radius).all()
        assert trial.arrived


def test_a_round_that_begins_at_the_target_has_no_step_and_has_arrived():
    world = World(start=(2, 2, 0), target=(2, 2.05))
    trial = Trial(world, seed=1)
    assert trial.arrived
    record = trial.path_learning(4)
    assert len(record) == 0
    assert record.rounds.tolist() == [(n, 0, True, 0) for n in (1, 2, 3, 4)]
    assert [record.path(i).tolist() for i in range(4)] == [[[2, 2, 0]]] * 4
    assert len(trial.free_learning(10)) == 10  # where reaching the target ends nothing


def test_nothing_asked_for_is_nothing_done(paper):
    trial = Trial(paper, seed=1)
    assert len(trial.path_learning(0)) == len(trial.path_learning(0).rounds) == 0
    assert trial.round == 0
    record = trial.run(0, echoes=True)
    assert (len(record), len(record.rounds), record.echoes.shape) == (0, 1, (0, 5))
    assert trial.pose == paper.start
    assert trial.learner.situations_experienced == 0


def test_place_and_begin_round_begin_rounds_where_they_say(paper):
    trial = Trial(paper, seed=1)
    trial.place(2, 1.5, 90)
    assert (trial.round, trial.pose) == (1, (2, 1.5, 90))
    record = trial.run(20)
    assert record.rounds["round"].tolist() == [1]
    assert record.path()[0].tolist() == [2, 1.5, 90]
    trial.begin_round()
    assert (trial.round, trial.pose) == (2, paper.start)
    trial.place(x=2, y=1.5, heading=-1e9)  # any finite heading is one
    assert trial.run(1).path()[1, 2] in np.mod(-1e9 + np.arange(-60, 61, 30), 360)


def test_new_starts_go_on_with_what_was_learned(paper):
    trial = Trial(paper, seed=1)
    trial.free_learning(500)
    fresh = Trial(paper.with_start((4.5, 0.5, 90)), agent=trial.learner.copy())
    explored = trial.learner.explored_count
    record = fresh.path_learning(2, 200)
    assert record.path()[0].tolist() == [4.5, 0.5, 90]
    assert record.explored_count[0] >= explored
    assert trial.learner.explored_count == explored


# --- interruption --------------------------------------------------------------------------------


def interrupted_after(seconds, call):
    """Sends a real SIGINT meanwhile, which ends the call."""
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
    finally:
        timer.join()


def large_world():
    """40 000 obstacles."""
    grid = np.linspace(5, 995, 200)
    circles = [devlearn.Circle((x, y), 0.5) for x in grid for y in grid]
    return World(1000, 1000, (2, 2, 0), (999, 999), circles)


@pytest.mark.parametrize("world", [lambda: World.load("paper"), large_world])
def test_ctrl_c_ends_a_run_long_before_its_last_step(world):
    trial = Trial(world(), seed=1)
    interrupted_after(0.1, lambda: trial.free_learning(10**9))
    assert 0 < len(trial.interrupted) < 10**8


def test_going_on_after_ctrl_c_is_as_if_nothing_had_been(paper):
    trial = Trial(paper, seed=4)
    assert trial.interrupted is None
    interrupted_after(0.05, lambda: trial.free_learning(10**9))
    first = trial.interrupted
    assert isinstance(first, devlearn.Record)
    assert 0 < len(first) < 10**7
    assert trial.pose == tuple(first.path()[-1])
    second = trial.run(500)
    whole = Trial(paper, seed=4).free_learning(len(first) + 500)
    for name in devlearn.record.STEP_COLUMNS:
        column = np.concatenate([getattr(first, name), getattr(second, name)])
        assert same(column, getattr(whole, name)), name


def test_ctrl_c_ends_rounds_without_a_step_too():
    trial = Trial(World(start=(2, 2, 0), target=(2, 2)), seed=1)
    interrupted_after(0.05, lambda: trial.path_learning(2**30))
    assert 0 < len(trial.interrupted.rounds) < 2**30


def test_another_thread_makes_progress_during_a_run(paper):
    progress, running = [], threading.Event()

    def watch():
        running.wait()
        while running.is_set():
            progress.append(len(progress))
            time.sleep(0.001)

    thread = threading.Thread(target=watch)
    thread.start()
    running.set()
    Trial(paper, seed=1).free_learning(300_000)
    during = len(progress)
    running.clear()
    thread.join()
    assert during > 10


def test_trials_in_several_threads_give_the_histories_that_they_give_alone(paper):
    alone = [Trial(paper, seed=s).path_learning(20, 500, echoes=True) for s in range(4)]
    trials = [Trial(paper, seed=s) for s in range(4)]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        runs = [pool.submit(t.path_learning, 20, 500, echoes=True) for t in trials]
        heard = [Robot(paper).sonar(paper.start).tolist() for _ in range(50)]
        records = [run.result(timeout=60) for run in runs]
    assert [differences(a, b) for a, b in zip(alone, records)] == [[]] * 4
    assert heard == [heard[0]] * 50


class Chatty:
    """An agent in Python that lets other threads have their say within each choice."""

    def __init__(self, seed):
        self.random = devlearn.Random(seed, "chatty")

    def choose(self, observation):
        time.sleep(0)
        return self.random.index(observation.motion_count)

    def observe(self, outcome):
        time.sleep(0)


def test_agents_in_several_threads_do_not_disturb_each_other(paper):
    alone = [Trial(paper, agent=Chatty(s)).free_learning(300) for s in range(4)]
    trials = [Trial(paper, agent=Chatty(s)) for s in range(4)]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        runs = [pool.submit(t.free_learning, 300) for t in trials]
        records = [run.result(timeout=60) for run in runs]
    assert [differences(a, b) for a, b in zip(alone, records)] == [[]] * 4


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("phase", ["run", "free_learning", "path_learning"])
@pytest.mark.parametrize("count", [-1, -(2**63), 2**40 + 1, 2**63, 2**64, 10**30])
def test_lengths_out_of_range_are_refused_by_name_before_anything_happens(paper, phase, count):
    trial = Trial(paper, seed=1)
    quantity = "rounds" if phase == "path_learning" else "steps"
    refused(lambda: getattr(trial, phase)(count), quantity, str(count))
    assert (trial.round, trial.pose, trial.interrupted) == (0, paper.start, None)


@pytest.mark.parametrize("limit", [0, -1, 2**40 + 1, 2**70])
def test_step_limits_out_of_range_are_refused_by_name(paper, limit):
    trial = Trial(paper, seed=1)
    refused(lambda: trial.path_learning(1, step_limit=limit), "step_limit", str(limit))
    assert trial.round == 0


def test_places_where_the_body_does_not_fit_are_refused_and_the_trial_stays(paper):
    trial = Trial(paper, seed=1)
    trial.run(30)
    pose = trial.pose
    nan, inf = float("nan"), float("inf")
    for place, quantity in [
        ((1.3, 1.4, 0), "pose"),
        ((0.05, 2, 0), "pose"),
        ((-1, 2, 0), "pose.x"),
        ((2, 5.1, 0), "pose.y"),
        ((nan, 2, 0), "pose.x"),
        ((2, inf, 0), "pose.y"),
        ((2, 1.5, nan), "pose.heading"),
        ((2, 1.5, -inf), "pose.heading"),
    ]:
        refused(lambda place=place: trial.place(*place), quantity)
    assert (trial.round, trial.pose) == (1, pose)


def test_a_start_that_does_not_hold_the_body_is_refused():
    world = World(start=(0.05, 2, 0))
    refused(lambda: Trial(world), "start")
    refused(lambda: Trial(World(0.5, 0.5, (0.2, 0.2, 0), (0.3, 0.3)), fat()), "start")


def fat():
    return TrialConfig(robot=devlearn.RobotDef(radius=0.3))


def test_sonar_clearance_that_leaves_out_walls_is_refused():
    refused(
        lambda: TrialConfig(clearance_source="sonar"),
        "TrialConfig.walls_count",
        "false with clearance_source sonar",
    )


# --- what a trial shows --------------------------------------------------------------------------


def test_a_trial_shows_what_it_was_given(paper):
    config = TrialConfig.step5().replace(goal_radius=0.2)
    trial = Trial(paper, config, seed=2**64 - 1)
    assert trial.world == paper
    assert trial.config == config
    assert trial.seed == trial.learner.seed == 2**64 - 1
    assert trial.agent is trial.learner
    assert trial.learner.config == config.learner
    assert trial.robot.definition == config.robot
    assert (trial.grid.columns, trial.grid.rows, trial.grid.headings) == (20, 20, 12)
    assert (trial.round, trial.arrived, trial.pose) == (0, False, paper.start)
    assert isinstance(trial.pose, devlearn.Pose)


def test_a_step_shows_itself(paper):
    step = Trial(paper, seed=1).step()
    assert (step.round, step.motion in range(5), step.kind) == (1, True, Kind.EXPLORE)
    assert isinstance(step.pose, devlearn.Pose)
    assert "round 1" in repr(step)
    assert "EXPLORE" in repr(step)


def test_the_grid_follows_the_configuration(paper):
    grid = Trial(paper, TrialConfig(cell_size=0.3, heading_bins=36)).grid
    assert (grid.columns, grid.rows, grid.headings) == (17, 17, 36)
    assert grid.width == pytest.approx(5.1)


def test_parts_of_a_trial_outlive_it(paper):
    robot, learner = (lambda trial: (trial.robot, trial.learner))(Trial(paper, seed=1))
    assert robot.sonar(paper.start).shape == (5,)
    assert learner.choose(3).kind == Kind.EXPLORE


def test_a_learner_that_another_threads_run_has_in_hand_is_refused(paper):
    trial = devlearn.Trial(paper, seed=1)
    learner = trial.learner
    copied, refusals, running = learner.copy(), [], threading.Event()
    calls = [learner.situations, learner.copy]
    # Refused before and after, too, for other reasons.
    calls += [lambda: learner.choose(-1), lambda: learner.choose(situation=-1)]
    calls += [lambda: learner.learn(0.0), lambda: learner.learn(0.0, motion=1)]

    def look():
        running.wait()
        while running.is_set():
            for call in calls:
                try:
                    call()
                except devlearn.InvalidValue as refusal:
                    refusals.append((call, refusal.quantity))
            copied.situations()

    thread = threading.Thread(target=look)
    thread.start()
    running.set()
    record = trial.free_learning(200_000)
    running.clear()
    thread.join()
    assert {call for call, quantity in refusals if quantity == "Learner"} == set(calls)
    assert {quantity for _, quantity in refusals} <= {"Learner", "situation", "Learner.learn"}
    alone = devlearn.Trial(paper, seed=1).free_learning(200_000)
    assert np.array_equal(record.motion, alone.motion)
