"""Whoever chooses in a trial: the paper's learner, random motions, or an agent in Python."""

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import Choice, Kind, Learner, LearnerConfig, RandomAgent, Trial, TrialConfig


class Loop:
    """Motions in turn; keeps what it is told."""

    def __init__(self, answer=lambda n: n % 5):
        self.answer = answer
        self.asked, self.told, self.cancelled = [], [], 0

    def choose(self, observation):
        self.asked.append(observation)
        return self.answer(len(self.asked) - 1)

    def observe(self, outcome):
        self.told.append(outcome)

    def cancel(self):
        self.cancelled += 1


class Paper:
    """The paper's learner, by way of Python."""

    def __init__(self, config, seed):
        self.learner = Learner(config, seed)

    def choose(self, observation):
        return self.learner.choose(observation.situation)

    def observe(self, outcome):
        return self.learner.learn(outcome.smf)


# --- the paper's learner -------------------------------------------------------------------------


def test_a_learner_given_is_shared_and_goes_on(paper):
    learner = Learner(seed=3)
    first = Trial(paper, agent=learner)
    record = first.free_learning(400)
    assert first.learner is first.agent is learner
    assert learner.explored_count == record.explored_count[-1] > 0
    second = Trial(paper, seed=99, agent=learner)
    assert second.free_learning(10).explored_count[0] >= record.explored_count[-1]


def test_the_history_depends_on_the_learners_seed_alone(paper):
    own = Trial(paper, seed=3).free_learning(1000)
    given = Trial(paper, seed=99, agent=Learner(seed=3)).free_learning(1000)
    assert differences(own, given) == []


def test_a_copied_learner_goes_on_alike_and_apart(paper):
    trial = Trial(paper, seed=3)
    trial.free_learning(500)
    copied = trial.learner.copy()
    explored = trial.learner.explored_count
    twin = Trial(paper, agent=copied).free_learning(500)
    assert trial.learner.explored_count == explored
    assert (
        differences(trial.free_learning(500), twin, ["motion", "sef", "x", "explored_count"]) == []
    )


def test_a_learner_with_other_motions_is_refused(paper):
    four = Learner(LearnerConfig(motion_count=4))
    refused(lambda: Trial(paper, agent=four), "Trial.agent.config.motion_count", "4")


def test_other_motions_need_no_more_than_a_configuration(paper):
    config = TrialConfig(
        learner=LearnerConfig(motion_count=3),
        robot=devlearn.RobotDef(steering_angles=[-45, 0, 45]),
        heading_bins=8,
    )
    record = Trial(paper, config, seed=1).free_learning(500)
    assert set(record.motion.tolist()) == {0, 1, 2}
    assert set((record.heading % 45).tolist()) == {0}


def test_a_learner_that_waits_for_its_outcome_is_refused_and_can_be_freed(paper):
    learner = Learner(seed=1)
    learner.choose(7)
    trial = Trial(paper, agent=learner)
    refused(trial.step, "Learner.choose")
    assert (trial.pose, trial.round) == (paper.start, 0)
    learner.cancel()
    assert trial.step().kind == Kind.EXPLORE
    assert learner.pending is None


def test_a_learner_of_another_kind_in_python_is_heard(paper):
    class Stubborn(Learner):
        def choose(self, observation):
            return 4

        def observe(self, outcome):
            pass

    assert set(Trial(paper, agent=Stubborn()).run(50).motion.tolist()) == {4}


# --- random motions ------------------------------------------------------------------------------


def test_random_motions_are_seeded_and_learn_nothing(paper):
    first, second, third = (
        Trial(paper, agent=RandomAgent(seed)).free_learning(2000) for seed in (1, 1, 2)
    )
    assert differences(first, second) == []
    assert "motion" in differences(first, third)
    assert set(np.unique(first.motion)) == set(range(5))
    assert not first.explored_count.any()
    assert (first.kind == Kind.UNSTATED).all()
    assert first.provenance["agent"] == "devlearn._core.RandomAgent"


# --- agents in Python ----------------------------------------------------------------------------


def test_the_learner_by_way_of_python_gives_the_same_history(paper):
    config = TrialConfig.step5()
    own = Trial(paper, config, seed=6).free_learning(1500)
    by_python = Trial(paper, config, agent=Paper(config.learner, 6)).free_learning(1500)
    assert differences(own, by_python) == ["explored_count", "effective_count"]


def test_an_agent_is_told_what_the_record_says(paper):
    agent = Loop()
    trial = Trial(paper, agent=agent)
    record = trial.free_learning(300)
    assert trial.agent is agent
    assert trial.learner is None
    assert (record.motion == np.arange(300) % 5).all()
    assert (record.kind == Kind.UNSTATED).all()
    assert [o.situation for o in agent.asked] == record.situation.tolist()
    assert [o.pose for o in agent.asked] == [tuple(p) for p in record.path()[:-1]]
    assert [o.sef for o in agent.asked[1:]] == record.sef[:-1].tolist()
    assert [o.goal_distance for o in agent.asked[1:]] == record.goal_distance[:-1].tolist()
    assert [o.clearance for o in agent.asked[1:]] == record.clearance[:-1].tolist()
    assert {o.motion_count for o in agent.asked} == {5}
    assert [o.situation for o in agent.told[:-1]] == record.situation[1:].tolist()
    assert [o.sef for o in agent.told] == record.sef.tolist()
    assert [o.smf for o in agent.told] == record.smf_used.tolist()
    assert [o.collided for o in agent.told] == record.collided.tolist()
    assert [o.arrived for o in agent.told] == record.arrived.tolist()
    assert agent.cancelled == 0


@pytest.mark.parametrize(
    ("answer", "kind"),
    [
        (3, Kind.UNSTATED),
        (np.int64(3), Kind.UNSTATED),
        (np.uint8(3), Kind.UNSTATED),
        (Choice(3), Kind.UNSTATED),
        (Choice(3, Kind.EXPLOIT), Kind.EXPLOIT),
        (Choice(motion=3, kind=Kind.EXPLORE), Kind.EXPLORE),
    ],
)
def test_an_agent_answers_with_an_index_or_a_choice(paper, answer, kind):
    step = Trial(paper, agent=Loop(lambda n: answer)).step()
    assert (step.motion, step.kind) == (3, kind)


@pytest.mark.parametrize(
    ("answer", "value"),
    [
        (5, "5"),
        (-1, "-1"),
        (2**31, str(2**31)),
        (10**30, str(10**30)),
        (Choice(5), "5"),
        (Choice(-7), "-7"),
        (Choice(2**31), str(2**31)),
        (Choice(2.0), "Choice(motion=2.0, kind=<Kind.UNSTATED: 3>)"),
        (Choice(2, 1), "Choice(motion=2, kind=1)"),
        ((2, Kind.EXPLORE), "(2, <Kind.EXPLORE: 0>)"),
        (2.0, "2.0"),
        (None, "None"),
        ("2", "'2'"),
        (float("nan"), "nan"),
        ([1], "[1]"),
        (np.array([1, 2]), "[1 2]"),
    ],
)
def test_any_other_answer_is_refused_and_the_trial_left_as_it_was(paper, answer, value):
    agent = Loop(lambda n: 2 if n < 3 else answer)
    trial = Trial(paper, agent=agent)
    error = refused(lambda: trial.free_learning(10), value=value)
    assert "motion" in error.quantity or "choice" in error.quantity
    assert len(trial.interrupted) == len(agent.told) == 3
    assert trial.pose == tuple(trial.interrupted.path()[-1])


def test_an_agent_hears_that_its_motion_was_refused(paper):
    agent = Loop(lambda n: 5)
    trial = Trial(paper, agent=agent)
    refused(trial.step, "agent's motion", "5")
    assert agent.cancelled == 1
    refused(trial.step)
    assert agent.cancelled == 2


class Unlucky(Loop):
    """Raises once, in one of its methods, at some step."""

    def __init__(self, method, error, at=7):
        super().__init__()
        self.method, self.error, self.at = method, error, at

    def fail(self, method):
        if method == self.method and len(self.told) == self.at and self.error is not None:
            error, self.error = self.error, None
            raise error

    def choose(self, observation):
        self.fail("choose")
        return super().choose(observation)

    def observe(self, outcome):
        self.fail("observe")
        super().observe(outcome)


class Surprise(BaseException):
    pass


@pytest.mark.parametrize("method", ["choose", "observe"])
@pytest.mark.parametrize(
    "error", [RuntimeError("no"), KeyboardInterrupt(), Surprise(1), SystemExit]
)
def test_what_an_agent_raises_comes_through_and_what_was_finished_is_kept(paper, method, error):
    agent = Unlucky(method, error)
    trial = Trial(paper, agent=agent)
    kind = error if isinstance(error, type) else type(error)
    with pytest.raises(kind) as caught:
        trial.free_learning(100, echoes=True)
    if not isinstance(error, type):
        assert caught.value is error
    record = trial.interrupted
    assert len(record) == 7
    assert record.echoes.shape == (7, 5)
    assert record.path().shape == (8, 3)
    assert trial.pose == tuple(record.path()[-1])
    assert trial.round == 1
    assert trial.run(5).path()[0].tolist() == list(trial.pose) or len(agent.told) == 12


def test_an_agent_that_raises_in_a_step_leaves_the_trial_as_it_was(paper):
    trial = Trial(paper, agent=Unlucky("observe", ZeroDivisionError(), at=0))
    with pytest.raises(ZeroDivisionError):
        trial.step()
    assert (trial.pose, trial.round, trial.arrived) == (paper.start, 0, False)
    assert trial.step().round == 1


@pytest.mark.parametrize(
    "call",
    [
        lambda trial: trial.step(),
        lambda trial: trial.run(1),
        lambda trial: trial.free_learning(1),
        lambda trial: trial.path_learning(1),
        lambda trial: trial.begin_round(),
        lambda trial: trial.place(2, 1.5, 0),
    ],
)
@pytest.mark.parametrize("method", ["choose", "observe"])
def test_an_agent_that_moves_its_own_trial_is_refused(paper, call, method):
    agent = Loop()
    trial = Trial(paper, agent=agent)

    def back(self_argument):
        call(trial)

    setattr(agent, method, back)
    refused(trial.step, "Trial")
    refused(lambda: trial.run(5), "Trial")
    assert trial.pose == paper.start


def test_an_agent_may_look_at_its_trial(paper):
    agent = Loop(lambda n: int(trial.grid.situation(*trial.pose)) % 5)
    trial = Trial(paper, agent=agent)
    record = trial.free_learning(50)
    assert (record.motion == record.situation % 5).all()


@pytest.mark.parametrize("agent", [3, "x", object(), [], lambda o: 1, {"choose": 1}])
def test_what_is_no_agent_is_refused(paper, agent):
    refused(lambda: Trial(paper, agent=agent), "agent")


def test_provenance_names_the_agent(paper):
    assert Trial(paper, agent=Loop()).run(1).provenance["agent"] == f"{__name__}.Loop"
    assert Trial(paper).run(1).provenance["agent"] == "devlearn._core.Learner"
