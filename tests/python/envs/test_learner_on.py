"""Learners of devlearn on environments of others."""

import copy
import pickle
import subprocess
import sys

import devlearn
import gymnasium
import numpy as np
import pytest
from conftest import refused
from devlearn import AdaptiveConfig, AdaptiveLearner, InvalidValue, Learner, LearnerConfig, agents
from devlearn.envs import LearnerOn, TileSituations
from gymnasium import spaces

PLACES = 20


class Corridor(gymnasium.Env):
    """Places 0 ... 20, left and right; -1 a step until 20, where it is terminated."""

    observation_space = spaces.Discrete(PLACES + 1)
    action_space = spaces.Discrete(2)

    def __init__(self, places=PLACES, by_chance=False):
        self.places = places
        self.by_chance = by_chance  # where it begins
        self.resets = []

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.resets.append(seed)
        self.place = int(self.np_random.integers(self.places)) if self.by_chance else 0
        return self.place, {}

    def step(self, action):
        assert action in (0, 1)
        self.place = max(0, self.place + (-1, 1)[action])
        return self.place, -1.0, self.place == self.places, False, {}


class Slippery(Corridor):
    """One step in five goes the other way."""

    def step(self, action):
        return super().step(int(action) ^ int(self.np_random.random() < 0.2))


def newest(name):
    """The newest version of an environment of Gymnasium, made without its checks of every step."""
    versions = [spec for spec in gymnasium.registry.values() if spec.name == name]
    latest = max(versions, key=lambda spec: spec.version)
    return gymnasium.make(latest, disable_env_checker=True)


def paper(motions=2, seed=1):
    return Learner(LearnerConfig(motion_count=motions), seed=seed)


def adaptive(motions=2, seed=1, **settings):
    return AdaptiveLearner(AdaptiveConfig(motion_count=motions, **settings), seed=seed)


VALUE_AGENTS = [
    agents.QLearning,
    agents.ExpectedSarsa,
    agents.SarsaLambda,
    agents.DynaQ,
    agents.PrioritizedSweeping,
    agents.LrtaStar,
    agents.RMax,
    agents.OperantConditioning,
    agents.SalientEvents,
    agents.Appraisal,
]
LEARNERS = {
    "paper": paper,
    "adaptive": adaptive,
    **{agent.__name__: lambda seed=1, agent=agent: agent(seed=seed) for agent in VALUE_AGENTS},
    # Accumulating traces diverge where a round comes back to a place many times.
    "SarsaLambda": lambda: agents.SarsaLambda(agents.SarsaLambda.Config(traces="replacing"), 1),
}
every_learner = pytest.mark.parametrize("make", LEARNERS.values(), ids=LEARNERS)


def on_corridor(learner, env=None, **functions):
    """With an SEF, which only the paper's learner needs."""
    return LearnerOn(env or Corridor(), learner, **{"evaluation": float, **functions})


def state(learner):
    """All that a learner goes on from."""
    return pickle.dumps(learner)


# --- what it does is what the guides write by hand -----------------------------------------------


def test_it_is_the_loop_that_the_readme_writes():
    by_hand, steps = paper(), []
    for _ in range(7):
        place, count = 0, 0
        while place < PLACES:
            choice = by_hand.choose(place)
            before, place = place, max(0, place + (-1, 1)[choice.motion])
            by_hand.learn(place - before)
            count += 1
        steps.append(count)
    learner = paper()
    episodes = on_corridor(learner).run(7)
    assert episodes["steps"].tolist() == steps
    assert episodes["return"].tolist() == [-n for n in steps]
    assert learner.to_bytes() == by_hand.to_bytes()


def test_it_is_the_loop_of_the_adaptive_learner():
    def estimate(place):
        return float(PLACES - place)

    by_hand = adaptive()
    for _ in range(30):
        place = 0
        by_hand.begin_round()
        while place < PLACES:
            motion = by_hand.choose(place, estimate(place)).motion
            place = max(0, place + (-1, 1)[motion])
            by_hand.learn(1.0, place, estimate(place))
        by_hand.end_round(True)
    learner = adaptive()
    on_corridor(learner, estimate=estimate).run(30)
    assert learner.to_bytes() == by_hand.to_bytes()
    assert learner.habit_cost == PLACES


def test_q_learning_learns_what_the_textbook_s_table_does():
    config = agents.QLearning.Config(alpha=0.3, gamma=0.9, epsilon=1.0)
    env, agent = Slippery(places=5, by_chance=True), agents.QLearning(config, seed=2)
    told = []

    class Watched(gymnasium.Wrapper):
        def reset(self, **named):
            self.last, info = self.env.reset(**named)
            return self.last, info

        def step(self, action):
            place, reward, terminated, truncated, info = self.env.step(action)
            told.append((self.last, action, reward, place, terminated))
            self.last = place
            return place, reward, terminated, truncated, info

    LearnerOn(Watched(env), agent).run(40)
    table = np.zeros((6, 2))
    for place, action, reward, after, terminated in told:
        target = reward + (0.0 if terminated else 0.9 * table[after].max())
        table[place, action] += 0.3 * (target - table[place, action])
    learned = [[agent.value(place, motion) for motion in range(2)] for place in range(5)]
    np.testing.assert_allclose(learned, table[:5], rtol=1e-12)


def test_an_object_is_told_all_of_a_step_and_when_a_round_begins_and_ends():
    heard = []

    class Listener:
        def begin_round(self):
            heard.append("begin")

        def choose(self, seen):
            heard.append((seen.situation, seen.sef, seen.estimate, seen.motion_count))
            return devlearn.Choice(1)

        def observe(self, outcome):
            heard.append((outcome.situation, outcome.sef, outcome.smf, outcome.estimate))
            heard.append((outcome.cost, outcome.reward, outcome.arrived, outcome.collided))

        def end_round(self, arrived):
            heard.append(arrived)

    on = LearnerOn(
        Corridor(places=2),
        Listener(),
        situations=lambda place: 100 + place,
        evaluation=lambda place: place**2,
        estimate=lambda place: 2.0 - place,
    )
    on.run(1)
    first = [(100, 0.0, 2.0, 2), (101, 1.0, 1.0, 1.0), (1.0, -1.0, False, False)]
    second = [(101, 1.0, 1.0, 2), (102, 4.0, 3.0, 0.0), (1.0, -1.0, True, False)]
    assert heard == ["begin", *first, *second, True]
    heard.clear()
    on.run(1, step_limit=1)
    assert heard == ["begin", *first, False]


def test_by_reward_smf_is_the_reward_and_sef_0():
    told = []

    class Listener:
        def choose(self, seen):
            return 1

        def observe(self, outcome):
            told.append((outcome.smf, outcome.sef))

    LearnerOn(Corridor(places=3), Listener(), evaluation="reward").run(1)
    assert told == [(-1.0, 0.0)] * 3


def test_the_cost_is_the_user_s_and_otherwise_less_the_reward():
    learner = adaptive(hold_limit=1)
    on_corridor(
        learner,
        cost=lambda reward, terminated: 7.0 if terminated else 2.0 * -reward,
    ).run(40)
    assert learner.habit_cost == 2 * (PLACES - 1) + 7
    learner = adaptive(hold_limit=1)
    on_corridor(learner).run(40)
    assert learner.habit_cost == PLACES


def test_an_end_that_did_not_arrive_is_an_end_and_no_habit():
    learner = adaptive(hold_limit=1)
    on_corridor(learner, arrived=lambda reward: reward != -1.0).run(40)
    assert learner.habit_cost is None
    assert learner.best(PLACES - 1) == 1
    heard = []

    class Listener:
        def choose(self, seen):
            return 1

        def observe(self, outcome):
            heard.append(outcome.arrived)

        def end_round(self, arrived):
            heard.append(arrived)

    for arrived in (None, lambda reward: reward == -1.0, lambda reward: reward != -1.0):
        LearnerOn(Corridor(places=1), Listener(), arrived=arrived).run(1)
    assert heard == [True, True, True, True, True, False]


def test_actions_that_do_not_begin_at_0_are_motions_that_do():
    class Shifted(Corridor):
        action_space = spaces.Discrete(2, start=-5)

        def step(self, action):
            return super().step(action + 5)

    learner, same = paper(), paper()
    on_corridor(learner, Shifted()).run(5)
    on_corridor(same).run(5)
    assert learner.to_bytes() == same.to_bytes()


# --- it learns ------------------------------------------------------------------------------------


@every_learner
def test_every_learner_finds_the_best_policy_of_a_corridor(make):
    on = on_corridor(make())
    on.run(120)
    assert set(on.evaluate(5)["steps"].tolist()) == {PLACES}


@every_learner
def test_evaluation_changes_nothing_in_learner_or_run(make):
    learner = make()
    on = on_corridor(learner, Slippery(by_chance=True))
    on.run(3, seed=4)
    before = state(learner)
    assert len(on.evaluate(7, seed=9)) == 7
    assert state(learner) == before
    other = make()
    rest = on_corridor(other, Slippery(by_chance=True)).run(8, seed=4)[3:]
    assert (on.run(5) == rest).all()
    assert state(learner) == state(other)


def test_what_an_object_learns_while_it_is_evaluated_is_forgotten():
    class Counting:
        steps = 0

        def choose(self, seen):
            return np.int64(1)

        def observe(self, outcome):
            self.steps += 1

    agent = Counting()
    on = LearnerOn(Corridor(), agent)
    on.run(2)
    assert agent.steps == 2 * PLACES
    assert on.evaluate(3)["steps"].tolist() == [PLACES] * 3
    assert agent.steps == 2 * PLACES


def test_a_greedy_learner_plays_its_best_motion_and_any_where_it_knows_nothing():
    for learner in (paper(), adaptive(), agents.QLearning()):
        motions = []

        class Watched(Corridor):
            def step(self, action, motions=motions):
                motions.append(action)
                return super().step(action)

        on_corridor(learner, Watched()).evaluate(20, step_limit=20)
        assert 0.35 < np.mean(motions) < 0.65
    learner = paper()
    learner.update(0, 1, 3.0)
    learner.update(1, 0, 0.5)
    assert on_corridor(learner, Corridor(places=1)).evaluate(5)["steps"].tolist() == [1] * 5
    # Between 0 and 1 for ever: both motions are the best known.
    stuck = on_corridor(learner).evaluate(2, step_limit=50)
    assert stuck["steps"].tolist() == [50, 50]
    assert stuck["truncated"].all()


def test_best_is_the_learner_s_own_where_all_is_allowed():
    from devlearn.envs.players import OfAdaptive, OfLearner

    env = Slippery()
    for learner, player in ((paper(), OfLearner), (adaptive(), OfAdaptive)):
        on_corridor(learner, env).run(20)
        for place in range(PLACES):
            best = player(learner).best(devlearn.Observation(place, 2))
            assert best == [learner.best(place)]
            one = player(learner).best(devlearn.Observation(place, 2, allowed=[True, False]))
            assert list(one) == [0]


def test_the_adaptive_learner_is_evaluated_by_its_habit_as_it_would_go_on():
    learner = adaptive(motions=4, hold_limit=1, seed=103)
    on = LearnerOn(newest("CliffWalking"), learner)
    on.run(300, seed=103)
    assert learner.habit_cost == 13
    # By the tried motions of least loss alone it goes round for ever, where others are untried.
    assert on.evaluate(3, step_limit=100)["return"].tolist() == [-13.0] * 3


# --- the same history, whatever the way ----------------------------------------------------------


@every_learner
def test_the_same_seed_gives_the_same_history_and_another_another(make):
    def history(seed):
        learner = make()
        episodes = on_corridor(learner, Slippery(by_chance=True)).run(15, seed=seed)
        return episodes.tobytes(), state(learner)

    assert history(3) == history(3)
    assert history(3) != history(4)


@every_learner
def test_a_run_in_pieces_equals_one_in_one_call(make):
    whole, cut = make(), make()
    episodes = on_corridor(whole, Slippery(by_chance=True)).run(12, seed=3)
    on = on_corridor(cut, Slippery(by_chance=True))
    pieces = [on.run(5, seed=3), on.run(0), on.run(1), on.run(6)]
    assert np.concatenate(pieces).tobytes() == episodes.tobytes()
    assert state(cut) == state(whole)
    assert (on.seed, on.episode) == (3, 12)


@every_learner
def test_a_run_goes_on_from_the_learner_s_snapshot_on_an_environment_made_anew(make, tmp_path):
    whole = make()
    episodes = on_corridor(whole, Slippery(by_chance=True)).run(12, seed=3)
    first = make()
    on_corridor(first, Slippery(by_chance=True)).run(5, seed=3)
    if hasattr(first, "save"):
        first.save(tmp_path / "learner.safetensors")
        again = type(first).load(tmp_path / "learner.safetensors")
    else:
        again = pickle.loads(pickle.dumps(first))
    rest = on_corridor(again, Slippery(by_chance=True)).run(7, seed=3, first=5)
    assert rest.tobytes() == episodes[5:].tobytes()
    assert state(again) == state(whole)


def test_each_episode_is_reset_with_a_seed_of_its_own():
    env = Corridor()
    on = on_corridor(paper(), env)
    on.run(4, seed=7)
    on.evaluate(4, seed=7)
    on.run(4, seed=8)
    assert len(set(env.resets)) == 12
    assert all(0 <= seed < 2**31 for seed in env.resets)


# --- ends of episodes -----------------------------------------------------------------------------


def test_a_step_limit_truncates_and_an_end_at_the_limit_does_not():
    on = on_corridor(agents.QLearning(agents.QLearning.Config(epsilon=0.0)))
    on.run(200)
    assert on.run(1, step_limit=PLACES).tolist() == [(-PLACES, PLACES, True, False)]
    cut = on.run(1, step_limit=PLACES - 1)
    assert cut.tolist() == [(1 - PLACES, PLACES - 1, False, True)]
    limited = gymnasium.wrappers.TimeLimit(Corridor(), PLACES - 1)
    cut = on_corridor(on.learner, limited).run(1, step_limit=None)
    assert cut.tolist() == [(1 - PLACES, PLACES - 1, False, True)]


def test_values_go_on_beyond_a_truncation_and_end_at_a_termination():
    config = agents.QLearning.Config(alpha=1.0, initial_value=-50.0)
    for places, expected in ((1, -1.0), (2, -51.0)):
        agent = agents.QLearning(config)
        on = LearnerOn(Corridor(places=places), agent)
        on.run(30, step_limit=1)
        assert agent.value(0, 1) == expected


# --- what is allowed ------------------------------------------------------------------------------


class Masked(Corridor):
    """Left is ruled out where there is a wall, and everything at the end."""

    def mask(self):
        return {"action_mask": np.int8([0 < self.place < self.places, self.place < self.places])}

    def reset(self, **named):
        place, _ = super().reset(**named)
        return place, self.mask()

    def step(self, action):
        assert self.mask()["action_mask"][action], "an action that is not allowed"
        return (*super().step(action)[:-1], self.mask())


@every_learner
def test_an_action_that_the_mask_rules_out_is_never_chosen(make):
    on = on_corridor(make(), Masked())
    on.run(20, step_limit=300)
    on.evaluate(5, step_limit=100)


def test_random_motions_are_those_allowed():
    on = LearnerOn(Masked(), devlearn.RandomAgent(seed=1))
    assert on.run(20)["terminated"].all()
    assert on.evaluate(5)["terminated"].all()


def test_an_object_that_chooses_what_is_not_allowed_is_refused_and_told_so():
    class Left:
        cancelled = 0

        def choose(self, seen):
            return 0

        def observe(self, outcome):
            raise AssertionError("told of a step that was not made")

        def cancel(self):
            self.cancelled += 1

    agent = Left()
    error = refused(lambda: LearnerOn(Masked(), agent).run(1), "agent's choice", "0")
    assert "[1]" in error.allowed
    assert agent.cancelled == 1


@pytest.mark.parametrize(
    "mask", [[True], np.ones((2, 1)), np.zeros(2), "ab", [np.nan, 1], [2, 1], [[1], 1]]
)
@pytest.mark.parametrize("make", [paper, agents.QLearning, devlearn.RandomAgent])
def test_a_mask_that_is_none_or_allows_nothing_is_refused(make, mask):
    class Wrong(Corridor):
        def reset(self, **named):
            return super().reset(**named)[0], {"action_mask": mask}

    refused(lambda: on_corridor(make(), Wrong()).run(1), 'info["action_mask"]')


def test_infos_that_are_no_dict_are_refused():
    class Silent(Corridor):
        def reset(self, **named):
            return super().reset(**named)[0], None

    refused(lambda: on_corridor(paper(), Silent()).run(1), "info", "None")


# --- what it cannot do ----------------------------------------------------------------------------


class Continuous(Corridor):
    action_space = spaces.Box(-1, 1, (1,))


class Several(Corridor):
    action_space = spaces.MultiDiscrete([2, 3])


@pytest.mark.parametrize("env", [Continuous(), Several()])
def test_actions_that_are_not_discrete_are_refused_before_anything_and_the_way_out_is_said(env):
    error = refused(lambda: LearnerOn(env, paper(), evaluation=float), "env.action_space")
    assert "TransformAction" in error.allowed
    assert env.resets == []


def test_the_way_out_of_continuous_actions_is_one():
    class Pushed(Continuous):
        def step(self, action):
            return super().step(int(action[0] > 0))

    actions = [np.float32([-1]), np.float32([1])]
    env = gymnasium.wrappers.TransformAction(
        Pushed(), actions.__getitem__, spaces.Discrete(len(actions))
    )
    on = on_corridor(paper(), env)
    on.run(50)
    assert on.evaluate(1)["steps"] == PLACES


def test_a_box_without_situations_is_refused_and_the_way_out_is_said():
    env = gymnasium.make("CartPole-v1")
    error = refused(lambda: LearnerOn(env, adaptive()), "observation_space")
    assert "TileSituations" in error.allowed
    error = refused(lambda: TileSituations.even(env.observation_space, 8), "observation_space")
    assert "from_quantiles" in error.allowed


@pytest.mark.parametrize("env", [None, "Taxi-v3", Corridor, object()])
def test_what_is_no_environment_is_refused(env):
    refused(lambda: LearnerOn(env, paper(), evaluation=float), "env")


def test_a_vector_of_environments_is_refused():
    vector = gymnasium.vector.SyncVectorEnv([Corridor, Corridor])
    error = refused(lambda: LearnerOn(vector, paper(), evaluation=float), "env")
    assert "vector" in error.allowed


@pytest.mark.parametrize("learner", [None, object(), agents.QLearning, "paper", Corridor()])
def test_what_is_no_learner_is_refused(learner):
    refused(lambda: LearnerOn(Corridor(), learner, evaluation=float), "LearnerOn.learner")


def test_an_agent_with_a_map_is_refused():
    robot = devlearn.Robot(devlearn.World.load("empty"))
    agent = agents.ShortestPathAgent(robot)
    refused(lambda: LearnerOn(Corridor(), agent), "LearnerOn.learner")


@pytest.mark.parametrize("make", [paper, adaptive])
def test_a_learner_of_other_motions_is_refused(make):
    error = refused(lambda: on_corridor(make(motions=3)), "LearnerOn.learner")
    assert "motion_count=2" in error.allowed


def test_the_paper_s_learner_needs_an_evaluation():
    error = refused(lambda: LearnerOn(Corridor(), paper()), "LearnerOn.evaluation")
    assert "'reward'" in error.allowed
    shaped = agents.QLearning(agents.QLearning.Config(shaping="sef"))
    refused(lambda: LearnerOn(Corridor(), shaped), "LearnerOn.evaluation")


WRONG = [
    ("situations", 3),
    ("evaluation", 3),
    ("evaluation", "smf"),
    ("cost", 1.0),
    ("arrived", True),
    ("estimate", 0.0),
    ("estimate", -1.0),
    ("estimate", np.nan),
    ("estimate", "far"),
    ("estimate", "1"),
    ("estimate", 10**400),
    ("estimate", None),
]


@pytest.mark.parametrize("name, value", WRONG)
def test_what_is_no_function_or_number_is_refused_at_the_door(name, value):
    refused(lambda: on_corridor(adaptive(), **{name: value}), f"LearnerOn.{name}")


FAULTS = [
    ("evaluation", lambda place: np.nan, "LearnerOn.evaluation"),
    ("evaluation", lambda place: None, "LearnerOn.evaluation"),
    ("cost", lambda reward, terminated: np.inf, "LearnerOn.cost"),
    ("estimate", lambda place: 0.0, "LearnerOn.estimate"),
    ("situations", lambda place: -1, "situation"),
    ("situations", lambda place: 0.5, "situation"),
]


@pytest.mark.parametrize("name, function, quantity", FAULTS)
def test_what_a_function_gives_is_checked(name, function, quantity):
    with pytest.raises(InvalidValue) as error:
        on_corridor(adaptive(), **{name: function}).run(1)
    assert quantity in error.value.quantity


RUNS = [
    {"episodes": -1},
    {"episodes": 1.5},
    {"episodes": 1, "step_limit": 0},
    {"episodes": 1, "seed": -1},
    {"episodes": 1, "first": -1},
    {"episodes": 1, "progress": 3},
]


@pytest.mark.parametrize("arguments", RUNS)
def test_runs_that_cannot_be_are_refused(arguments):
    on = on_corridor(paper())
    refused(lambda: on.run(**arguments))
    assert on.env.resets == []


def test_a_reward_above_0_needs_a_cost_of_the_user_s_where_costs_are_learned_from():
    class Paid(Corridor):
        def step(self, action):
            place, _, terminated, truncated, info = super().step(action)
            return place, 1.0 if terminated else -1.0, terminated, truncated, info

    learner = adaptive(hold_limit=1)
    error = refused(lambda: on_corridor(learner, Paid()).run(50), "cost")
    assert "reward 1.0" in error.value
    assert "cost=" in error.allowed
    assert learner.pending is None
    on_corridor(learner, Paid(), cost=lambda reward, terminated: 2.0 - reward).run(20)
    agent = agents.QLearning(agents.QLearning.Config(alpha=1.0, gamma=0.5))
    on = LearnerOn(Paid(places=3), agent)  # values take any sign
    on.run(50)
    assert [agent.value(place, 1) for place in range(3)] == [-1.25, -0.5, 1.0]


@pytest.mark.parametrize("reward", [np.nan, np.inf, None, "1", 10**400, np.ones(2)])
def test_a_reward_that_is_no_number_is_refused(reward):
    class Broken(Corridor):
        def step(self, action):
            place, _, *rest = super().step(action)
            return place, reward, *rest

    refused(lambda: on_corridor(agents.QLearning(), Broken()).run(1), "reward")


# --- what breaks off ------------------------------------------------------------------------------


@every_learner
@pytest.mark.parametrize("broken", [RuntimeError("the motor"), KeyboardInterrupt()])
def test_what_was_finished_before_an_environment_breaks_is_kept_and_the_run_goes_on(make, broken):
    class Fragile(Corridor):
        left = 70

        def step(self, action):
            self.left -= 1
            if self.left == 0:
                raise broken
            return super().step(action)

    learner = make()
    on = on_corridor(learner, Fragile())
    with pytest.raises(type(broken)):
        on.run(100, step_limit=25, seed=2)
    finished = on.interrupted
    assert len(finished) == on.episode >= 2
    assert finished["steps"].sum() < 70 <= finished["steps"].sum() + 25
    same = on_corridor(make(), Corridor()).run(len(finished), step_limit=25, seed=2)
    assert (same == finished).all()
    assert len(on.run(5, step_limit=25)) == 5  # no choice is left waiting
    assert on.interrupted is None


def test_progress_is_told_at_the_end_and_may_end_the_run():
    heard = []
    on = on_corridor(paper())
    on.run(30, progress=lambda *told: heard.append(told))
    assert heard[0] == (1, 30)
    assert heard[-1] == (30, 30)

    def enough(done, total):
        raise StopIteration

    with pytest.raises(StopIteration):
        on.run(30, progress=enough)
    assert len(on.interrupted) == 1
    assert on.episode == 31


# --- environments of Gymnasium --------------------------------------------------------------------


def test_the_adaptive_learner_walks_along_the_cliff():
    on = LearnerOn(newest("CliffWalking"), adaptive(motions=4, hold_limit=1))
    on.run(200)
    assert on.evaluate(2)["return"].tolist() == [-13.0, -13.0]


def test_a_taxi_is_driven_by_its_masks():
    on = LearnerOn(newest("Taxi"), agents.QLearning(seed=1))
    episodes = on.run(30)
    # An illegal pick-up or drop-off costs 10; the mask rules them out.
    delivered = episodes["terminated"]
    np.testing.assert_array_equal(
        episodes["return"][delivered], 21.0 - episodes["steps"][delivered]
    )
    assert (episodes["return"][~delivered] == -200).all()


def test_blackjack_is_a_tuple_and_cart_pole_a_box():
    on = LearnerOn(newest("Blackjack"), agents.QLearning(seed=1))
    assert set(on.run(50)["return"].tolist()) <= {-1.0, 0.0, 1.0}
    env = newest("CartPole")
    tiles = TileSituations.from_quantiles(env, 4, warm_up=500)
    on = LearnerOn(
        env, paper(), situations=tiles, evaluation=lambda seen: -abs(seen[2] + 0.5 * seen[3])
    )
    assert (on.run(50)["return"] >= 1).all()
    assert len(on.learner.situations()) > 10


def test_without_gymnasium_it_is_said_how_to_get_it():
    code = (
        "import sys\nsys.modules['gymnasium'] = None\n"
        "try:\n    import devlearn.envs\n"
        "except ImportError as error:\n    print(type(error).__name__, error)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.startswith("MissingExtra devlearn.envs needs gymnasium, which is not")
    assert "pip install 'gymnasium>=1.1'" in run.stdout


def test_a_copy_of_the_learner_is_not_what_learns():
    learner = paper()
    aside = copy.deepcopy(learner)
    on = on_corridor(learner)
    on.run(1)
    assert on.learner is learner
    assert learner.situations_experienced > 0
    assert aside.situations_experienced == 0
