"""Textbook learners of values, or of probabilities, in a trial. What they learn is tested in C++,
against the books."""

import copy
import gc
import pickle
import threading

import devlearn
import numpy as np
import pytest
from conftest import differences, refused
from devlearn import FileError, InvalidValue, RobotDef, Trial, TrialConfig, World, agents

KINDS = {
    "q_learning": agents.QLearning,
    "expected_sarsa": agents.ExpectedSarsa,
    "sarsa_lambda": agents.SarsaLambda,
    "dyna_q": agents.DynaQ,
    "prioritized_sweeping": agents.PrioritizedSweeping,
    "lrta_star": agents.LrtaStar,
    "r_max": agents.RMax,
    "operant_conditioning": agents.OperantConditioning,
    "salient_events": agents.SalientEvents,
    "appraisal": agents.Appraisal,
}
each_value_agent = pytest.mark.parametrize(
    "agent", [agent for agent in KINDS.values() if hasattr(agent, "value")]
)
each_agent = pytest.mark.parametrize("agent", KINDS.values(), ids=KINDS)
EMPTY = World.load("empty")


def test_the_module_names_each_of_them_and_its_settings():
    names = {agent.__name__ for agent in KINDS.values()}
    assert names | {n + "Config" for n in names} | {"ShortestPathAgent"} <= set(agents.__all__)
    for name in names:
        assert getattr(agents, name).Config is getattr(agents, name + "Config")


# --- the same history, whatever the way ----------------------------------------------------------


class ByHand:
    """Calls an agent from Python, as a loop of one's own does."""

    def __init__(self, agent):
        self.agent = agent

    def begin_round(self):
        self.agent.begin_round()

    def choose(self, seen):
        mine = devlearn.Observation(
            seen.situation,
            seen.motion_count,
            estimate=seen.estimate,
            sef=seen.sef,
            allowed=seen.allowed,
        )
        return self.agent.choose(mine)

    def observe(self, outcome):
        told = ("cost", "estimate", "arrived", "sef", "smf", "collided", "event")
        mine = {name: getattr(outcome, name) for name in told}
        assert devlearn.Outcome(outcome.situation, **mine) == outcome
        self.agent.observe(devlearn.Outcome(outcome.situation, **mine))

    def cancel(self):
        self.agent.cancel()

    def end_round(self, arrived):
        self.agent.end_round(arrived)


@pytest.mark.parametrize("agent", [*KINDS.values(), devlearn.RandomAgent])
def test_called_by_hand_an_agent_goes_as_in_a_trial(agent):
    config = TrialConfig(robot=RobotDef(safety_margin=0.05))  # with motions that are not allowed
    mine, own = ByHand(agent(seed=3)), agent(seed=3)
    trials = [Trial(World.load("paper"), config, agent=each) for each in (mine, own)]
    records = [trial.path_learning(rounds=3, step_limit=300) for trial in trials]
    assert differences(*records) == []
    assert pickle.dumps(mine.agent) == pickle.dumps(own)


def test_what_no_observation_may_hold_is_refused_by_hand():
    refused(lambda: devlearn.Observation(-1, 2), "situation")
    refused(lambda: devlearn.Observation(0, 0), "motion_count")
    refused(lambda: devlearn.Observation(0, 65536), "motion_count")
    refused(lambda: devlearn.Observation(0, 2, allowed=[True]), "allowed")
    refused(lambda: devlearn.Observation(0, 2, allowed=[False, False]), "allowed")
    refused(lambda: devlearn.Outcome(-1), "situation")
    agent = agents.QLearning()
    refused(lambda: agent.observe(devlearn.Outcome(0)), "observe")
    agent.choose(devlearn.Observation(0, 2))
    refused(lambda: agent.choose(devlearn.Observation(0, 2)), "choose")
    agent.cancel()
    refused(agent.cancel, "cancel")
    refused(lambda: agent.choose(devlearn.Observation(0, 3)), "motion_count")
    # What comes out of a pickle is looked at when it is used.
    one = devlearn.Observation(0, 2, allowed=[True, False])
    state = list(one.__getstate__())
    state[-2] = [True]
    forged = devlearn.Observation.__new__(devlearn.Observation)
    forged.__setstate__(tuple(state))
    refused(lambda: devlearn.RandomAgent().choose(forged), "allowed")


@each_agent
def test_step_by_step_and_in_one_call_give_the_same_history(agent):
    whole = Trial(EMPTY, agent=agent(seed=3))
    record = whole.free_learning(700)
    stepwise = Trial(EMPTY, agent=agent(seed=3))
    stepwise.begin_round()
    assert [stepwise.step().motion for _ in range(700)] == record.motion.tolist()
    cut = Trial(EMPTY, agent=agent(seed=3))
    parts = [cut.free_learning(250), cut.run(1), cut.run(0), cut.run(449)]
    assert differences(devlearn.Record.concatenate(parts), record) == []
    assert pickle.dumps(whole.agent) == pickle.dumps(stepwise.agent) == pickle.dumps(cut.agent)
    other = Trial(EMPTY, agent=agent(seed=4)).free_learning(700)
    assert "motion" in differences(other, record)


@each_agent
def test_what_is_saved_loaded_pickled_or_copied_goes_on_equal_to_the_bit(agent, tmp_path):
    trial = Trial(EMPTY, agent=agent(seed=3))
    trial.path_learning(rounds=3, step_limit=200)
    trial.run(77)
    trial.save(tmp_path / "trial.safetensors")
    others = [
        Trial.load(tmp_path / "trial.safetensors"),  # the agent is not named
        Trial.from_bytes(trial.to_bytes()),
        pickle.loads(pickle.dumps(trial)),
        trial.copy(),
        copy.deepcopy(trial),
    ]
    record = trial.path_learning(rounds=2, step_limit=300)
    for other in others:
        assert type(other.agent) is agent
        assert other.agent is not trial.agent
        assert differences(other.path_learning(rounds=2, step_limit=300), record) == []
        assert pickle.dumps(other.agent) == pickle.dumps(trial.agent)


@each_value_agent
def test_an_agent_goes_from_trial_to_trial_with_what_it_learned(agent):
    learner = agent(seed=3)
    trial = Trial(EMPTY, agent=learner)
    record = trial.free_learning(300)
    assert trial.agent is learner
    assert record.provenance["agent"] == f"devlearn._core.{agent.__name__}"
    situation, motion = int(record.situation[0]), int(record.motion[0])
    assert learner.value(situation, motion) is not None
    again = pickle.loads(pickle.dumps(learner))
    assert again.value(situation, motion) == learner.value(situation, motion)
    assert again.config == learner.config
    first = Trial(EMPTY, agent=again).free_learning(50)
    assert differences(first, Trial(EMPTY, agent=learner).free_learning(50)) == []


def test_the_shortest_path_agent_takes_the_shortest_way_and_is_saved_with_it(tmp_path):
    robot = devlearn.Robot(World.load("paper"))
    trial = Trial(robot.world, agent=agents.ShortestPathAgent(robot))
    assert (
        trial.path_learning(rounds=2).rounds["steps"].tolist()
        == [devlearn.shortest_path(robot).steps] * 2
    )
    trial.place(4.0, 2.5, 77.0)
    trial.run(20)
    trial.save(tmp_path / "trial.safetensors")
    rest = trial.finish_round(500)
    assert rest.rounds["arrived"].all()
    trial = Trial.load(tmp_path / "trial.safetensors")
    assert (
        repr(trial.agent) == "<devlearn.agents.ShortestPathAgent: world 'paper', goal_radius 0.1>"
    )
    for again in (trial, pickle.loads(pickle.dumps(trial)), trial.copy()):
        assert differences(again.finish_round(500), rest) == []
    with pytest.raises(InvalidValue, match="safety_margin: got 0.1; expected none"):
        agents.ShortestPathAgent(devlearn.Robot(EMPTY, RobotDef(safety_margin=0.1)))


# --- settings and values -------------------------------------------------------------------------


@each_value_agent
def test_settings_are_those_given_and_the_defaults_otherwise(agent):
    assert agent().config == agent.Config()
    if "first_value" in agent.Config.fields():
        changed = agent.Config(first_value="estimate", initial_value=-7.0)
        with pytest.raises(InvalidValue, match=r"Config\.first_value: got 'none'"):
            agent.Config(first_value="none")
    else:
        changed = agent.Config(gamma=0.25)
    assert agent(changed).config == agent(config=changed, seed=5).config == changed
    assert repr(changed) in repr(agent(changed))
    with pytest.raises(InvalidValue, match=r"config: got 3; expected an? \w+Config or None"):
        agent(3)
    with pytest.raises(InvalidValue, match="seed: got -1"):
        agent(seed=-1)


@each_value_agent
def test_a_value_is_a_number_where_a_situation_was_met_and_none_elsewhere(agent):
    learner = agent()
    assert learner.value(760, 4) is None
    record = Trial(EMPTY, agent=learner).free_learning(100)
    assert isinstance(learner.value(record.situation[0], 4), float)
    assert learner.value(2**63 - 1, 0) is None
    for situation, motion, quantity in (
        (-1, 0, "situation"), (2.5, 0, "situation"), (2**63, 0, "situation"), (0, 5, "motion"),
        (0, -1, "motion"), (0, 0.5, "motion"), (0, 2**40, "motion"),
    ):  # fmt: skip
        refused(lambda s=situation, m=motion: learner.value(s, m), quantity)


def test_a_first_value_of_the_estimate_is_less_the_steps_straight_to_the_target():
    learner = agents.QLearning(agents.QLearning.Config(first_value="estimate", alpha=1e-9))
    trial = Trial(EMPTY, agent=learner)
    record = trial.free_learning(1)
    pose, target = EMPTY.start, EMPTY.target
    steps = np.hypot(pose[0] - target[0], pose[1] - target[1]) / 0.05
    motions = [m for m in range(5) if m != record.motion[0]]
    assert [learner.value(int(record.situation[0]), m) for m in motions] == pytest.approx(
        [-steps] * 4
    )


def test_what_r_max_knows_was_tried_m_times_and_updates_are_counted():
    learner = agents.RMax(agents.RMax.Config(m=2))
    record = Trial(EMPTY, agent=learner).free_learning(2000)
    pairs, tried = np.unique(
        np.column_stack([record.situation, record.motion]), axis=0, return_counts=True
    )
    assert [learner.visits(s, m) for s, m in pairs.tolist()] == np.minimum(tried, 2).tolist()
    sweeping = agents.PrioritizedSweeping(agents.PrioritizedSweeping.Config(planning_steps=3))
    Trial(EMPTY, agent=sweeping).free_learning(100)
    assert 100 <= sweeping.updates <= 300


# --- operant conditioning ------------------------------------------------------------------------


def test_probabilities_sum_to_one_entropy_falls_and_an_explanation_counts_what_came():
    config = agents.OperantConditioning.Config(reward_step=0.2, penalty_step=0.05)
    agent = agents.OperantConditioning(config, seed=1)
    assert agent.mean_entropy() is None
    assert agent.entropy(0) is None
    assert agent.probability(0, 0) is None
    assert agent.explain(0) is None
    record = Trial(EMPTY, agent=agent).free_learning(3000)
    assert 0.0 < agent.mean_entropy() < np.log2(5)
    entropies = []
    for situation in np.unique(record.situation).tolist():
        here = record.situation == situation
        why = agent.explain(situation)
        assert why.probability == pytest.approx([agent.probability(situation, m) for m in range(5)])
        assert sum(why.probability) == pytest.approx(1.0)
        smf = record.smf_used[here]
        motions = record.motion[here]
        for name, mask in (
            ("tried", here[here]),
            ("reinforced", smf > 0),
            ("extinguished", smf < 0),
        ):
            assert getattr(why, name) == np.bincount(motions[mask], minlength=5).tolist()
        entropies.append(agent.entropy(situation))
        assert entropies[-1] == why.entropy
    assert min(entropies) < agent.mean_entropy() < max(entropies)
    assert str(why).startswith(f"situation {why.situation}: entropy ")
    assert repr(why).startswith("<devlearn.ConditioningExplanation: situation ")
    assert pickle.loads(pickle.dumps(why)) == why
    masked = agent.explain(why.situation, [True, False, False, True, False])
    assert masked.probability[1:3] == [0.0, 0.0]
    assert sum(masked.probability) == pytest.approx(1.0)
    refused(lambda: agent.explain(why.situation, [True]), "allowed")
    refused(lambda: agent.entropy(-1), "situation")


@pytest.mark.parametrize("reinforced_by", ["smf", "reward"])
def test_operant_conditioning_lives_in_the_paper_s_world_and_is_resumed_to_the_bit(
    tmp_path, reinforced_by
):
    config = agents.OperantConditioning.Config(penalty_step=0.1, reinforced_by=reinforced_by)
    trial = Trial(World.load("paper"), agent=agents.OperantConditioning(config, seed=5))
    trial.free_learning(2000)
    trial.path_learning(rounds=2, step_limit=500)
    trial.save(tmp_path / "trial.safetensors")
    again = Trial.load(tmp_path / "trial.safetensors")
    assert again.agent.config == config
    assert differences(again.free_learning(500), trial.free_learning(500)) == []
    assert pickle.dumps(again.agent) == pickle.dumps(trial.agent)


# --- in a trial ----------------------------------------------------------------------------------


@each_agent
def test_only_motions_that_the_safety_layer_allows_are_chosen(agent):
    world = World(width=1.5, height=1.5, start=(0.22, 0.75, 180), target=(1.2, 1.2))
    config = TrialConfig(robot=RobotDef(safety_margin=0.09))
    record = Trial(world, config, agent=agent(seed=2)).free_learning(500)
    poses = zip(record.x, record.y, record.heading)  # before each step, and the last one
    robot = devlearn.Robot(world, config.robot)
    allowed = [robot.allowed(pose) for pose in poses]
    limits = [one for one in zip(allowed, record.motion) if not np.all(one[0])]
    assert limits
    assert all(mask[motion] for mask, motion in limits if np.any(mask))


@each_agent
def test_another_number_of_motions_is_refused_to_one_that_has_learned(agent):
    learner = agent()
    Trial(EMPTY, agent=learner).free_learning(10)
    three = TrialConfig(
        learner=devlearn.LearnerConfig(motion_count=3),
        robot=RobotDef(steering_angles=[-45, 0, 45]),
    )
    trial = Trial(EMPTY, three, agent=learner)
    refused(trial.step, "motion_count", "3")
    assert len(Trial(EMPTY, three, agent=agent()).free_learning(10)) == 10


@each_agent
def test_a_state_that_lacks_anything_is_refused_by_its_name(agent):
    trial = Trial(EMPTY, agent=agent())
    trial.free_learning(10)
    state = trial.agent.__getstate__()[0]
    for name in state.keys() - {"last_row"}:  # without which no motion waits for the next one
        with pytest.raises(FileError, match=rf"state: (__metadata__\.)?{name}"):
            agent.__new__(agent).__setstate__(({k: v for k, v in state.items() if k != name}, {}))
    with pytest.raises(InvalidValue, match="state: got 3"):
        agent.__new__(agent).__setstate__((3, {}))


@pytest.mark.parametrize("agent", [agents.LrtaStar, agents.RMax])
def test_an_estimate_leads_to_paths_near_the_shortest(agent):
    paths = Trial(EMPTY, agent=agent(seed=1)).path_learning(rounds=120, step_limit=20_000)
    shortest = devlearn.shortest_path(devlearn.Robot(EMPTY)).steps
    steps = paths.rounds["steps"]
    assert paths.rounds["arrived"][40:].all()  # R-max may go round between joined poses at first
    assert steps.min() >= shortest
    assert np.median(steps[-20:]) < 3 * shortest < np.mean(steps[:5])


@pytest.mark.parametrize("agent", [agents.QLearning, agents.RMax])
def test_one_that_another_thread_runs_is_refused(agent):
    learner, stop, running = agent(), threading.Event(), threading.Event()
    thread = threading.Thread(
        target=lambda: Trial(EMPTY, agent=learner).run(
            10**9, stop=stop, progress=lambda done, total: running.set()
        )
    )
    thread.start()
    try:
        assert running.wait(60)
        in_hand = "a call while another thread's run has it in hand"
        for call in (
            lambda: Trial(EMPTY, agent=learner).run(1),
            lambda: learner.value(0, 0),
            lambda: pickle.dumps(learner),
        ):
            refused(call, agent.__name__, in_hand)
    finally:
        stop.set()
        thread.join()
    assert learner.value(0, 0) is None or np.isfinite(learner.value(0, 0))


class Logging(agents.QLearning):
    """Adds what it likes."""


class LoggingLearner(devlearn.Learner):
    """Likewise."""


@pytest.mark.parametrize("derived", [Logging, LoggingLearner])
def test_a_derived_class_keeps_what_it_has_where_its_trial_alone_holds_it(derived):
    original = derived(seed=1)
    original.log = [1, 2]
    for again in (pickle.loads(pickle.dumps(original)), copy.copy(original)):
        assert type(again) is derived
        assert again.log == [1, 2]
    trial = Trial(EMPTY, agent=original)
    del original, again
    gc.collect()
    trial.free_learning(20)
    copied = copy.deepcopy(trial)
    gc.collect()
    for one in (trial, copied):
        assert type(one.agent) is derived
        assert one.agent.log == [1, 2]
