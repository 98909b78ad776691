"""The learner that the page lives through once more, against the one in C++, in node."""

import devlearn
import numpy as np
import pytest
from devlearn import LearnerConfig, Record, RobotDef, Trial, TrialConfig
from devlearn.analysis import Replay
from devlearn.viewer import page
from pages import header_of, in_node

SEVEN = RobotDef(steering_angles=[-90, -45, -20, 0, 20, 45, 90], safety_margin=0.02)
CONFIGS = {
    "paper": TrialConfig(),
    "step5": TrialConfig.step5(),
    "seven motions that a safety layer watches": TrialConfig(
        robot=SEVEN, learner=LearnerConfig(motion_count=7, eta=0.4, sigma=0.6, c1=0.2, c2=3.0)
    ),
    "weakened, retried": TrialConfig(
        learner=LearnerConfig(eta=0.9, on_negative="weaken", when_exhausted="retry")
    ),
    "two motions": TrialConfig(
        robot=RobotDef(steering_angles=[-60, 0]), learner=LearnerConfig(motion_count=2)
    ),
}


def lived(paper, config, before=0):
    """A trial and its record, which may begin after so many steps."""
    trial = Trial(paper, config, seed=11)
    trial.free_learning(before)
    return trial, Record.concatenate(
        [trial.free_learning(4000, learner=True), trial.path_learning(10, step_limit=800)]
    )


@pytest.mark.parametrize("before", [0, 2500])
@pytest.mark.parametrize("config", CONFIGS.values(), ids=CONFIGS)
def test_every_event_count_and_list_in_the_page_is_that_of_the_learner(paper, config, before):
    trial, record = lived(paper, config, before)
    told = in_node(
        page(record),
        "return {notes: run.notes, event: [...run.event], reduced: [...run.replay.reduced],"
        " explored: [...run.exploredAt], effective: [...run.effectiveAt],"
        " lists: run.ids.map((id, number) => [id, run.replay.learner.explain(number)])}",
    )
    assert told["notes"] == []
    assert told["event"] == record.event.tolist()
    assert told["reduced"] == record.reduced.tolist()
    assert told["explored"][1:] == record.explored_count.tolist()
    assert told["effective"][1:] == record.effective_count.tolist()
    assert {id for id, _ in told["lists"]} == set(trial.learner.situations())
    for id, lists in told["lists"]:
        require_same(lists, trial.learner.explain(id))


def require_same(lists, why):
    """The page's explanation is C++'s, to the bit."""
    memory = why.memory
    assert lists["effective"] == memory.effective
    assert lists["ineffective"] == memory.ineffective
    assert lists["unexplored"] == memory.unexplored
    assert lists["orientation"] == memory.orientation
    assert lists["times"] == memory.times_learned
    assert lists["curiosity"] == why.curiosity
    assert lists["opPlain"] == why.op_plain
    assert lists["opCurious"] == why.op_curious
    assert lists["winner"] == why.winner
    assert lists["probability"] == pytest.approx(why.probability, abs=1e-15)
    for name in ("explore", "exploit", "exhausted"):
        assert lists[name] == getattr(why, name)


def test_the_page_goes_to_any_step_and_back_as_it_went_there_first(paper):
    _, record = lived(paper, TrialConfig())
    steps = [3000, 17, 0, len(record), 1234, 1233, 4001]
    told = in_node(
        page(record),
        f"return {steps}.map((step) => [run.situation[Math.min(step, run.steps - 1)], step])"
        ".map(([number, step]) => [run.ids[number], run.replay.before(step, number)])",
    )
    for step, (situation, lists) in zip(steps, told):
        require_same(lists, Replay(record).to(step).explain(situation))


def test_frames_and_steps_answer_to_each_other(paper):
    trial = Trial(paper, seed=1)
    record = Record.concatenate(
        [trial.free_learning(0), trial.free_learning(7), trial.path_learning(3, step_limit=5)]
    )
    steps, frames = in_node(
        page(record),
        "const frames = Array.from({length: run.frames}, (_, frame) => frame);"
        "const steps = Array.from({length: run.total + 1}, (_, step) => step);"
        "return [frames.map((frame) => run.stepAt(frame)), steps.map((step) => run.frameOf(step))]",
    )
    assert len(steps) == len(record.x)
    assert [steps[frame] for frame in frames] == list(range(len(record) + 1))
    # The frame after a step is its pose, not that from which the next round begins.
    after = np.flatnonzero(np.diff(steps) > 0) + 1
    assert frames == [0, *after.tolist()]


def test_situations_beyond_what_a_double_tells_are_told_as_text(paper):
    far = 2**62 + 1
    trial = Trial(paper, seed=1, situations=lambda senses: far + int(senses.pose.x > 1))
    record = trial.free_learning(300)
    ids, known = in_node(page(record), "return [run.ids, run.exploredAt.at(-1)]")
    assert set(ids) <= {str(far), str(far + 1)}
    assert known == record.explored_count[-1]


def test_a_learner_that_learned_elsewhere_too_is_not_told_of(paper):
    trial = Trial(paper, seed=1)
    first = trial.free_learning(200)
    trial.free_learning(300)
    later = trial.free_learning(200)
    columns = {name: later[name] for name in later}
    notes, replay = in_node(
        page(Record(columns, later.provenance, devlearn.Learner(seed=1).to_bytes())),
        "return [run.notes, Boolean(run.replay)]",
    )
    assert not replay
    assert "cannot be followed" in notes[0]
    assert "does not carry" in header_of(page(later))["notes"][0]
    assert header_of(page(first))["notes"] == []
