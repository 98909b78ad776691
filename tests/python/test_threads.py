"""Runs in several threads, at the end of the process, in a child forked meanwhile, and stopped."""

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import RandomAgent, Trial, World


def ended(script):
    """(exit code, stderr) of a process that runs this."""
    process = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60
    )
    return process.returncode, process.stderr


# --- the end of the process ----------------------------------------------------------------------

AGENT = """
class Agent:
    def __init__(self, pause):
        self.pause = pause
    def choose(self, observation):
        time.sleep(self.pause)
        return 2
    def observe(self, outcome):
        pass
"""
RUNS = {
    "a learner": "trial.run(10**9)",
    "rounds": "trial.path_learning(2**30, 10)",
    "steps": "while True: trial.step()",
    "short runs": "while True: trial.run(3)",
    "a busy agent": "devlearn.Trial(paper, agent=Agent(0)).run(10**9)",
    "an agent that pauses": "devlearn.Trial(paper, agent=Agent(0.01)).run(10**9)",
    "an agent asleep": "devlearn.Trial(paper, agent=Agent(30)).run(10**9)",
    "echoes": "while True: trial.robot.sonar(paper.start)",
    "random worlds": "while True: devlearn.World.random('traps', 1)",
    "saving": "while True: trial.to_bytes()",
    "deaf to its end": """
while True:
    try: trial.run(10**9)
    except BaseException: pass
""",
}


@pytest.mark.parametrize("run", RUNS)
def test_a_process_ends_as_ever_while_a_daemon_thread_is_in_a_call(run):
    script = "import threading, time, devlearn\n" + AGENT
    script += "paper = devlearn.World.load('paper')\ntrial = devlearn.Trial(paper)\n"
    script += "def run():\n    " + RUNS[run].strip().replace("\n", "\n    ") + "\n"
    script += "threading.Thread(target=run, daemon=True).start()\ntime.sleep(0.1)\n"
    assert ended(script) == (0, "")


def test_a_daemon_threads_run_ends_at_exit_and_its_thread_can_be_joined():
    script = """
import atexit, threading, time
def join():
    thread.join()
    assert len(trial.interrupted) > 0
    trial.run(10)
    print("joined")
atexit.register(join)
import devlearn
trial = devlearn.Trial(devlearn.World.load("paper"))
thread = threading.Thread(target=trial.run, args=(10**9,), daemon=True)
thread.start()
time.sleep(0.1)
"""
    process = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60
    )
    assert (process.returncode, process.stdout, process.stderr) == (0, "joined\n", "")


# --- a child forked during a run -----------------------------------------------------------------

FORKED = """
import os, signal, threading, time, devlearn
paper = devlearn.World.load("paper")
trial, idle = devlearn.Trial(paper, seed=1), devlearn.Trial(paper, seed=2)
robot = devlearn.Robot(paper)
threading.Thread(target=lambda: trial.run(10**9), daemon=True).start()
time.sleep(0.1)
child = os.fork()
if child == 0:
    signal.alarm(20)
    {child}
    os._exit(0)
code = os.waitpid(child, 0)[1]
os._exit(code >> 8 or code)
"""


@pytest.mark.parametrize(
    "call",
    [
        "devlearn.Trial(paper).run(100)",
        "idle.path_learning(3)",
        "robot.sonar(paper.start)",
        "devlearn.World.random('rooms', 1)",
        "idle.to_bytes()",
    ],
)
def test_a_child_forked_during_a_run_has_all_that_no_run_had_in_hand(call):
    assert ended(FORKED.format(child=call)) == (0, "")


def test_a_child_forked_during_a_run_is_refused_what_the_run_had_in_hand():
    child = """
    def check():
        for call in (lambda: trial.run(1), lambda: trial.pose, trial.to_bytes, trial.copy,
                     trial.step, lambda: trial.learner.choose(1)):
            try: call()
            except devlearn.InvalidValue as refusal: assert "forked" in str(refusal), refusal
            else: assert False, call
    # A new thread of the child's may bear the other's name.
    for _ in range(3):
        thread = threading.Thread(target=check)
        thread.start()
        thread.join()
    check()
"""
    assert ended(FORKED.format(child=child.strip())) == (0, "")


def test_a_child_forked_during_a_run_ends_as_ever():
    child = "import sys; threading.Timer(0, lambda: None).start(); sys.exit(0)"
    started = time.monotonic()
    assert ended(FORKED.format(child=child)) == (0, "")
    assert time.monotonic() - started < 20


def test_forked_pools_work_during_a_run(paper):
    stop = threading.Event()
    thread = threading.Thread(target=Trial(paper).run, args=(10**9,), kwargs={"stop": stop})
    thread.start()
    try:
        with multiprocessing.get_context("fork").Pool(2) as pool:
            steps = pool.map_async(steps_of_a_run, range(4)).get(timeout=60)
    finally:
        stop.set()
        thread.join()
    assert steps == [100] * 4


def steps_of_a_run(seed):
    return len(Trial(World.load("paper"), seed=seed).run(100))


# --- several threads -----------------------------------------------------------------------------


IN_HAND = "a call while another thread's run has it in hand"


def in_threads(*calls):
    threads = [threading.Thread(target=call) for call in calls]
    for thread in threads:
        thread.start()
    return threads


def test_no_run_waits_for_another_threads(paper):
    """An agent waits, in the middle of a step, for all that another thread does."""
    asked, done = threading.Event(), threading.Event()

    class Waiting:
        def choose(self, observation):
            asked.set()
            assert done.wait(60)
            return 2

        def observe(self, outcome):
            pass

    trial = Trial(paper, agent=Waiting())
    records = []
    (thread,) = in_threads(lambda: records.append(trial.run(10)))
    assert asked.wait(60)
    other = Trial(paper, seed=1)
    other.path_learning(5, 500, echoes=True)
    other.step()
    other.begin_round()
    Trial.from_bytes(other.to_bytes())
    devlearn.Robot(paper).sonar(paper.start)
    done.set()
    thread.join()
    assert len(records[0]) == 10


def test_a_trial_that_another_thread_runs_is_refused(paper):
    trial, stop, running = Trial(paper, seed=1), threading.Event(), threading.Event()
    (thread,) = in_threads(
        lambda: trial.run(10**9, stop=stop, progress=lambda done, total: running.set())
    )
    assert running.wait(60)
    calls = [lambda: trial.run(1), trial.step, trial.begin_round, lambda: trial.place(1, 1, 0)]
    calls += [lambda: trial.pose, lambda: trial.round, lambda: trial.arrived]
    calls += [lambda: trial.round_open, trial.to_bytes, trial.copy]
    for call in calls:
        refused(call, "Trial", IN_HAND)
    assert trial.world == paper
    stop.set()
    thread.join()
    assert len(trial.run(1)) == 1


def test_a_random_agent_that_another_thread_runs_is_refused(paper):
    agent, stop, running = RandomAgent(1), threading.Event(), threading.Event()
    (thread,) = in_threads(
        lambda: Trial(paper, agent=agent).run(
            10**9, stop=stop, progress=lambda done, total: running.set()
        )
    )
    assert running.wait(60)
    refused(lambda: Trial(paper, agent=agent).run(1), "RandomAgent", IN_HAND)
    stop.set()
    thread.join()


def test_one_robot_answers_several_threads_at_once(paper):
    robot = devlearn.Robot(paper)
    alone = devlearn.Robot(paper)
    poses = [(0.3 + 0.01 * i, 0.5, 7.0 * i) for i in range(100)]
    heard = [[], [], []]
    for thread in in_threads(
        *(lambda h=h: h.extend(robot.sonar(p).tolist() for p in poses) for h in heard)
    ):
        thread.join()
    assert heard == [[alone.sonar(p).tolist() for p in poses]] * 3


def test_a_call_waits_for_a_thread_that_saves_the_learner(paper, tmp_path):
    learner = devlearn.Learner(seed=1)
    for situation in range(100_000):
        learner.update(situation, situation % 5, 1.0)
    saving = threading.Event()

    def save():
        for _ in range(5):
            saving.set()
            learner.save(tmp_path / "learner.safetensors")

    (thread,) = in_threads(save)
    saving.wait()
    for situation in range(100_000, 100_200):
        learner.choose(situation)
        learner.learn(1.0)
    thread.join()
    assert learner.situations_experienced == 100_200
    loaded = devlearn.Learner.load(tmp_path / "learner.safetensors")
    assert 100_000 <= loaded.situations_experienced <= 100_200


# --- stop and progress ---------------------------------------------------------------------------

PHASES = {
    "run": lambda trial, **options: trial.run(2**40, **options),
    "free_learning": lambda trial, **options: trial.free_learning(2**40, **options),
    "path_learning": lambda trial, **options: trial.path_learning(2**30, **options),
    "a round": lambda trial, **options: trial.path_learning(1, 2**40, **options),
    "finish_round": lambda trial, **options: trial.finish_round(2**40, **options),
}
# Behind a wall: no round ends.
CLOSED = World(2, 2, (0.5, 0.5, 0), (1.5, 1.5), [devlearn.Rectangle((1.0, 1.0), (2.0, 0.1))])


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("event", [threading.Event, multiprocessing.Event])
def test_a_phase_ends_soon_after_its_stop_is_set_and_goes_on_as_if_nothing_had_been(phase, event):
    stop, trial, result = event(), Trial(CLOSED, seed=1), []

    def run():
        result.append(PHASES[phase](trial, stop=stop, rounds_only=False))
        result.append(time.monotonic())

    (thread,) = in_threads(run)
    time.sleep(0.1)
    stop.set()
    asked = time.monotonic()
    thread.join(60)
    record, over = result
    assert over - asked < 1.0  # 50 ms on a machine that does nothing else
    assert len(record) > 0
    assert trial.interrupted is None
    assert trial.pose == tuple(record.path(-1)[-1])


def test_a_run_that_was_stopped_goes_on_as_if_nothing_had_been(paper):
    stop, trial = threading.Event(), Trial(paper, seed=4)
    timer = threading.Timer(0.05, stop.set)
    timer.start()
    first = trial.free_learning(10**9, stop=stop)
    second = trial.run(500)
    whole = Trial(paper, seed=4).free_learning(len(first) + 500)
    assert np.array_equal(np.concatenate([first.situation, second.situation]), whole.situation)


def test_a_stop_that_is_set_before_ends_the_phase_at_once(paper):
    stop = threading.Event()
    stop.set()
    trial = Trial(paper, seed=1)
    for _ in range(2):
        assert len(trial.run(2**40, stop=stop)) < 10**6


def test_progress_is_told_in_order_seldom_and_at_the_end(paper):
    told = []
    started = time.monotonic()
    Trial(paper, seed=1).free_learning(
        1_000_000, progress=lambda done, total: told.append((done, total)), rounds_only=True
    )
    took = time.monotonic() - started
    done = [d for d, _ in told]
    assert {total for _, total in told} == {1_000_000}
    assert done == sorted(set(done))
    assert done[-1] == 1_000_000
    assert 2 <= len(told) <= 10 * took + 2


@pytest.mark.parametrize("rounds_only", [False, True])
def test_progress_of_path_learning_counts_rounds(paper, rounds_only):
    told = []
    record = Trial(paper, seed=1).path_learning(
        3000, 3000, rounds_only=rounds_only, progress=lambda *part: told.append(part)
    )
    assert told[-1] == (3000, 3000) == (len(record.rounds), 3000)
    done = [d for d, _ in told]
    assert done == sorted(done)
    assert done[0] >= 0


def test_progress_of_a_short_phase_is_told_once_at_its_end(paper):
    told = []
    trial = Trial(paper, seed=1)
    for call in (trial.run, trial.free_learning, trial.finish_round):
        call(3, progress=lambda *part: told.append(part))
    trial.path_learning(2, 3, progress=lambda *part: told.append(part))
    assert told == [(3, 3)] * 3 + [(2, 2)]


def test_what_progress_raises_ends_the_phase_and_what_is_finished_is_kept(paper):
    class Enough(Exception):
        pass

    def progress(done, total):
        raise Enough

    trial = Trial(paper, seed=1)
    with pytest.raises(Enough):
        trial.run(10**9, progress=progress)
    assert 0 < len(trial.interrupted) < 10**9
    alone = Trial(paper, seed=1).run(len(trial.interrupted))
    assert differences(alone, trial.interrupted) == []


def test_ctrl_c_is_heard_where_progress_is_told_and_a_stop_is_given(paper):
    trial, timer = Trial(paper, seed=1), threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        trial.run(10**9, stop=threading.Event(), progress=lambda done, total: None)
    timer.join()
    assert len(trial.interrupted) > 0


def test_who_only_watches_changes_no_history(paper):
    watched = Trial(paper, seed=3).path_learning(
        20, 500, stop=threading.Event(), progress=lambda done, total: None
    )
    assert differences(watched, Trial(paper, seed=3).path_learning(20, 500)) == []


# --- the shortest path ---------------------------------------------------------------------------


def hard():
    """A world in which the search takes seconds."""
    walls = [devlearn.Rectangle((50 - (-1) ** i * 0.5, 9.0 * i), (99.0, 0.1)) for i in range(1, 11)]
    return World(100, 100, (0.5, 0.5, 0), (50, 99), walls)


def test_the_shortest_path_hears_ctrl_c_and_lets_others_run():
    robot, progress, over = devlearn.Robot(hard()), [], threading.Event()

    def watch():
        while not over.is_set():
            progress.append(time.monotonic())
            time.sleep(0.001)

    (thread,) = in_threads(watch)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        devlearn.shortest_path(robot)
    took = time.monotonic() - started
    over.set()
    thread.join()
    timer.join()
    assert took < 1.0  # 0.35 s on a machine that does nothing else
    assert len(progress) > 30


# --- other long calls ----------------------------------------------------------------------------

MANY = np.linspace(0.5, 4.5, 10_000_000)
LONG = {
    "clearance": lambda: World.load("paper").clearance(MANY, MANY),
    "evaluation": lambda: devlearn.StateEvaluation()(MANY, MANY),
    "situation": lambda: devlearn.SituationGrid().situation(MANY, MANY, MANY),
}


@pytest.mark.parametrize("call", LONG)
def test_a_call_with_long_arrays_hears_signals_and_lets_others_run(call):
    turns, heard, over = [], [], threading.Event()

    def watch():
        while not over.is_set():
            turns.append(None)
            time.sleep(0.001)

    def during_a_call(happened):
        before = len(happened)
        LONG[call]()
        return len(happened) - before

    (thread,) = in_threads(watch)
    before = signal.signal(signal.SIGALRM, lambda *_: heard.append(None))
    signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
    try:
        # One more might happen before or after it.
        assert max(during_a_call(heard) for _ in range(5)) > 2
        assert max(during_a_call(turns) for _ in range(5)) > 2
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
        over.set()
        thread.join()
