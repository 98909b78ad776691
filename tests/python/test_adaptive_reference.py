"""The adaptive learner agrees with a plain Python reference that is given the same draws."""

import collections
import random

import adaptive_reference
import devlearn
import pytest
from conftest import differences
from devlearn import AdaptiveConfig, AdaptiveLearner, Development, Event, Kind, Trial

START = 0


class Graph:
    """A task without a world. Situations in a row towards the goal, each of several places; a
    motion leads on, about, or nowhere, in some steps, and where noisy not always to the same."""

    def __init__(self, seed, motion_count, noisy, length=30):
        self.random = random.Random(seed)
        self.motion_count = motion_count
        self.noisy = noisy
        self.length = length
        made = random.Random(seed)
        self.ways = {
            (node, motion): (node + made.choice([-4, -2, -1, 1, 2, 3]), made.randrange(1, 4))
            for node in range(length)
            for motion in range(motion_count)
        }
        for node in range(length):  # so that there is a way at all
            self.ways[node, made.randrange(motion_count)] = (node + made.choice([1, 2]), 2)
        self.blocked = {way for way in self.ways if made.random() < 0.15}
        self.put(START)

    def put(self, node):
        self.node, self.progress = node, 0

    @property
    def situation(self):
        return self.node * 7919 * 2**40 + 5

    @property
    def arrived(self):
        return self.node >= self.length

    @property
    def estimate(self):
        return 0.0 if self.arrived else 0.6 * (self.length - self.node) - 0.1 * self.progress

    def step(self, motion):
        """Cost, and whether something was touched."""
        where, steps = self.ways[self.node, motion]
        slips = self.noisy and self.random.random() < 0.1
        if (self.node, motion) in self.blocked or slips:
            return 6.0, True
        self.progress += 1
        if self.progress >= steps:
            elsewhere = self.noisy and self.random.random() < 0.2
            self.put(max(0, where + (self.random.choice([-1, 1]) if elsewhere else 0)))
        return self.random.uniform(0.5, 1.5) if self.noisy else 1.0, False


def check_same(learner, plain, situation):
    theirs, ours = learner.situation(situation), plain.situations[situation]
    assert theirs.first_estimate == ours.first_estimate
    assert theirs.expected_loss == ours.expected
    assert theirs.losses == ours.losses
    assert theirs.times == [ours.times(m) for m in range(plain.motion_count)]
    assert theirs.effective == ours.effective()
    assert theirs.unexplored == [m for m in range(plain.motion_count) if not ours.outcomes[m]]
    assert learner.best(situation) == plain.best(situation)


def check_all(learner, plain):
    assert learner.situations().tolist() == list(plain.situations)
    for situation in plain.situations:
        check_same(learner, plain, situation)
    cost = learner.habit_cost
    assert (plain.habit_cost if plain.habit else None) == cost
    assert learner.optimism == plain.optimism
    assert learner.outcomes == sum(
        len(outcomes) for each in plain.situations.values() for outcomes in each.outcomes
    )
    assert learner.in_round == (plain.round is not None)


class Pair:
    """The learner and the reference, told the same; both must say the same."""

    def __init__(self, config, seed):
        self.learner = AdaptiveLearner(config, seed=seed)
        draw = devlearn.Random(seed, "agent").index
        self.plain = adaptive_reference.Adaptive(draw, **config.to_dict())
        self.met = collections.Counter()

    def choose(self, situation, estimate, allowed=None):
        plain = self.plain
        before = plain.optimism, plain.round and plain.round.start
        choice = self.learner.choose(situation, estimate, allowed)
        assert tuple(choice) == plain.choose(situation, estimate, allowed)
        self.met[choice.kind.name] += 1
        self.met["optimism falls"] += plain.optimism < before[0]
        if now := plain.round:
            self.met["by habit"] += now.by_habit and before[1] is None
            self.met["target"] += now.target is not None and before[1] is None
            self.met["curious"] += now.curious
            self.met["homeward"] += bool(plain.homeward())
        for name in ("home", "falling", "hope"):
            sweep = getattr(plain, name)
            self.met[f"{name} under way"] += bool(sweep and sweep.left)
        return choice.motion

    def compare(self, development, event, value, situation):
        assert (development.event, development.value) == (event, value)
        assert development.explored_count == self.plain.explored_count
        assert development.effective_count == self.plain.effective_count
        check_same(self.learner, self.plain, situation)
        self.met[development.event.name] += 1

    def learn(self, cost, situation, estimate, interrupted):
        made = self.plain.decision.situation
        habit, outcomes = self.plain.habit_cost, self.learner.outcomes
        development = self.learner.learn(cost, situation, estimate, interrupted)
        self.compare(development, *self.plain.learn(cost, situation, estimate, interrupted), made)
        self.met["habit dropped"] += self.plain.habit_cost > habit
        self.met["old outcomes go"] += self.learner.outcomes < outcomes

    def update(self, situation, *outcome):
        development = self.learner.update(situation, *outcome)
        self.compare(development, *self.plain.update(situation, *outcome), situation)

    def both(self, call, *arguments):
        answer = getattr(self.learner, call)(*arguments)
        assert answer == getattr(self.plain, call)(*arguments)
        self.met[call] += 1


def live(pair, task, rounds, disturbed):
    """Rounds from the start, of which this share is disturbed by everything else that may come."""
    odds = task.random.random
    for _ in range(rounds):
        amid = odds() < disturbed
        task.put(task.random.randrange(task.length) if amid and odds() < 0.3 else START)
        pair.both("begin_round")
        for _ in range(150):
            one_step(pair, task, amid)
            if task.arrived:
                break
        if odds() < disturbed:  # on from the goal, or wherever it is
            for _ in range(30):
                if task.arrived:
                    task.put(START)
                one_step(pair, task, amid)
        if odds() >= 0.3 * disturbed:
            pair.both("end_round", task.arrived)
        check_all(pair.learner, pair.plain)


def one_step(pair, task, disturbed):
    odds = task.random.random
    allowed = None
    if disturbed and odds() < 0.1:
        allowed = [odds() < 0.6 for _ in range(task.motion_count)]
        allowed[task.random.randrange(task.motion_count)] = True
    motion = pair.choose(task.situation, task.estimate, allowed)
    if disturbed and odds() < 0.05:
        return pair.both("cancel")
    cost, touched = task.step(motion)
    pair.learn(cost, task.situation, task.estimate, touched)
    if not disturbed or task.arrived:
        return None
    if odds() < 0.01:  # put elsewhere
        task.put(task.random.randrange(task.length))
    if odds() < 0.05:
        others = list(pair.plain.situations) + [task.random.randrange(2**62)]
        estimate = None if odds() < 0.5 else task.random.uniform(1, 40)
        which = task.random.choice(others if estimate else others[:-1])
        following, to_go = task.random.choice(others), task.random.choice([0.0, 3.0, 20.0])
        ran = task.random.randrange(task.motion_count)
        pair.update(which, ran, task.random.uniform(0, 9), following, to_go, estimate)
    if odds() < 0.005:
        which = task.random.choice([*pair.plain.situations, 3])
        if not pair.plain.decision or pair.plain.decision.situation != which:
            pair.both("forget", which)
    return None


CURIOUS = {"curious_every": 3, "stale_after": 10, "patience": 3, "tolerance": 0.5, "detour": 100.0}
EVERYTHING = {"EXPLORE", "EXPLOIT", "EXTENSION", "ORIENTATION", "HABIT", "by habit"}
EVERYTHING |= {"homeward", "habit dropped", "cancel", "forget"}


@pytest.mark.parametrize(
    ("changes", "more"),
    [
        ({}, {"HELD", "REJECTION", "target", "DEVIATION", "optimism falls"}),
        ({"hold_limit": 1}, {"REJECTION", "target", "DEVIATION"}),
        ({"hold_limit": 2, "motion_count": 3, "optimism": 2.0}, {"DEVIATION", "optimism falls"}),
        ({"motion_count": 2, "enough": 5.0}, {"HELD"}),
        ({"recollections": 0}, {"target", "DEVIATION"}),
        ({"recollections": 1}, {"REJECTION", "target", "DEVIATION", "optimism falls"}),
        ({"patience": 0, "gain": 0.0, "tolerance": 0.5, "detour": 2.0}, {"target", "DEVIATION"}),
        ({"optimism": 1.0, "enough": 1.0}, {"target", "DEVIATION"}),
        ({"refine": False, "patience": 3}, {"target", "DEVIATION"}),
        (CURIOUS, {"curious", "old outcomes go"}),
        ({"sweep_limit": 1}, {"falling under way", "home under way"}),
        (dict(sweep_limit=40, **CURIOUS), {"curious", "hope under way", "old outcomes go"}),
    ],
    ids=[
        "default",
        "nothing held",
        "held twice",
        "two motions",
        "no recollection",
        "one recollection",
        "impatient",
        "no optimism",
        "not refined",
        "curious",
        "a mapping a call",
        "curious, some mappings a call",
    ],
)
def test_every_choice_and_every_value_agrees_with_the_reference(changes, more):
    config = AdaptiveConfig(**changes)
    met = collections.Counter()
    for seed, noisy in ((1, False), (2, True), (3, False)):
        pair = Pair(config, seed)
        task = Graph(seed, config.motion_count, noisy)
        live(pair, task, 60, disturbed=0.0)
        live(pair, task, 60, disturbed=0.2)
        task.blocked = set(sorted(task.blocked)[::2])  # half of what was in the way is gone
        live(pair, task, 60, disturbed=0.2)
        met += pair.met
    # The history met what there is to disagree on.
    assert {what for what in EVERYTHING | more if met[what] == 0} == set()


class PlainAgent:
    """The reference in a trial."""

    def __init__(self, seed):
        self.plain = adaptive_reference.Adaptive(devlearn.Random(seed, "agent").index)
        self.begin_round = self.plain.begin_round
        self.end_round = self.plain.end_round

    def choose(self, seen):
        motion, kind = self.plain.choose(seen.situation, seen.estimate, seen.allowed)
        return devlearn.Choice(motion, Kind(kind))

    def observe(self, outcome):
        made = self.plain.decision
        event, value = self.plain.learn(
            outcome.cost, outcome.situation, outcome.estimate, outcome.collided
        )
        counts = self.plain.explored_count, self.plain.effective_count
        return Development(made.situation, made.motion, Event(event), 0, *counts, value)


def test_a_trial_of_the_adaptive_preset_agrees_with_the_reference(paper):
    config = devlearn.TrialConfig.adaptive()
    plain = PlainAgent(7)
    trial, theirs = Trial(paper, config, seed=7), Trial(paper, config, seed=7, agent=plain)
    for run in (
        lambda trial: trial.free_learning(1000),
        lambda trial: trial.path_learning(60, step_limit=2000),
    ):
        record = run(trial)
        assert differences(record, run(theirs)) == []
    assert record.rounds["arrived"].all()
    assert set(record.kind.tolist()) == {
        Kind.EXPLORE,
        Kind.EXPLOIT,
        Kind.HABIT,
        Kind.DEVIATION,
        Kind.HELD,
    }
    check_all(trial.learner, plain.plain)
