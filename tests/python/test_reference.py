"""The learner agrees with a plain Python reference that is given the same draws."""

import collections
import random

import devlearn
import pytest
import reference

CHOICES = 100_000
SITUATIONS_AT_ONCE = 25


class Task:
    """A task without a world: situations, and an SMF of situation and motion with noise."""

    def __init__(self, seed, motion_count):
        self.random = random.Random(seed)
        self.motion_count = motion_count
        self.good = {}

    def situation(self, step):
        # New situations come all the time, for a wanderer's old ones run out of motions.
        return (step // 100 + self.random.randrange(SITUATIONS_AT_ONCE)) * 7919 % 2**63

    def smf(self, situation, motion):
        if (situation, motion) not in self.good:
            self.good[situation, motion] = self.random.gauss(0, 2)
        if self.random.random() < 0.02:
            return self.random.choice([0.0, -0.0, -13.9, -1e3, 1e3, 1e-300, -1e-300])
        return self.good[situation, motion] + self.random.gauss(0, 0.8)


def check_same(learner, ours, situation):
    theirs = learner.situation(situation)
    assert theirs.effective == ours.effective
    assert theirs.ineffective == ours.ineffective
    assert theirs.unexplored == ours.unexplored
    assert theirs.times_learned == [ours.times_learned[m] for m in ours.effective]
    expected = [ours.orientation[m] for m in ours.effective]
    assert all(abs(o - e) <= 1e-12 for o, e in zip(theirs.orientation, expected))


@pytest.mark.parametrize(
    ("config", "seed"),
    [
        (devlearn.LearnerConfig.paper(), 1),
        (devlearn.LearnerConfig.step5(), 2),
        (devlearn.LearnerConfig(motion_count=3, on_negative="weaken", eta=0.2, sigma=0.8), 3),
        (devlearn.LearnerConfig(motion_count=9, when_exhausted="wander", c1=0.1, c2=4.0), 4),
    ],
    ids=["paper", "step5", "weaken and retry", "abandon and wander"],
)
def test_every_choice_and_every_list_agrees_with_the_reference(config, seed):
    learner = devlearn.Learner(config, seed=seed)
    draws = devlearn.Random(seed, "agent")
    plain = reference.Reference(draws.index, **config.to_dict())
    task = Task(seed, config.motion_count)
    kinds, events, reductions = collections.Counter(), collections.Counter(), 0

    def compare(development, event, reduced, situation):
        nonlocal reductions
        assert (development.event, development.reduced) == (event, reduced)
        check_same(learner, plain.at(situation), situation)
        events[event] += 1
        reductions += reduced

    for step in range(CHOICES):
        situation = task.situation(step)
        choice = learner.choose(situation)
        assert (choice.motion, choice.kind) == plain.choose(situation)
        kinds[int(choice.kind)] += 1
        what = task.random.random()
        if what < 0.03:
            learner.cancel()
            check_same(learner, plain.at(situation), situation)
            continue
        if what < 0.1:
            ran = task.random.randrange(config.motion_count)
            smf = task.smf(situation, ran)
            development = learner.learn(smf, motion=ran)
        else:
            ran = choice.motion
            smf = task.smf(situation, ran)
            development = learner.learn(smf)
        compare(development, *plain.learn(situation, ran, smf), situation)
        if what > 0.9:
            other = task.situation(step)
            motion = task.random.randrange(config.motion_count)
            smf = task.smf(other, motion)
            development = learner.update(other, motion, smf)
            compare(development, *plain.learn(other, motion, smf), other)

    assert learner.situations().tolist() == list(plain.situations)
    assert learner.explored_count == plain.explored_count
    assert learner.effective_count == plain.effective_count
    for situation, ours in plain.situations.items():
        check_same(learner, ours, situation)

    # The history met what there is to disagree on.
    assert min(kinds[kind] for kind in range(3)) >= 1000
    assert min(events[e] for e in (0, 1, 2, 3)) >= 1000
    assert events[reference.ABANDONMENT] >= 1000 or config.on_negative == "weaken"
    assert reductions >= 500


@pytest.mark.parametrize("seed", [0, 1, 2**63, 2**64 - 1])
@pytest.mark.parametrize("stream", ["agent", "world", "", "wörld"])
def test_the_generator_agrees_with_a_plain_one(seed, stream):
    ours, theirs = reference.Xoshiro(seed, stream), devlearn.Random(seed, stream)
    assert [theirs.next() for _ in range(1000)] == [ours.next() for _ in range(1000)]
    assert [theirs.uniform() for _ in range(1000)] == [ours.uniform() for _ in range(1000)]
    for count in (1, 2, 5, 65535, 2**31 + 1, 2**32 - 1):
        assert [theirs.index(count) for _ in range(200)] == [ours.index(count) for _ in range(200)]


def test_the_learner_draws_from_the_stream_agent_of_its_seed():
    seed = 12
    learner, draws = devlearn.Learner(seed=seed), reference.Xoshiro(seed, "agent")
    for situation in range(1000):  # each new, so that every choice explores 0 ... 4
        assert learner.choose(situation).motion == draws.index(5)
        learner.cancel()


def test_choices_among_the_allowed_motions_agree_with_the_reference():
    generator = random.Random(7)
    kinds = collections.Counter()
    for seed in range(5):
        learner = devlearn.Learner(seed=seed)
        plain = reference.Reference(devlearn.Random(seed, "agent").index)
        for _ in range(1500):
            situation = generator.randrange(4)
            allowed = [generator.random() < 0.5 for _ in range(5)]
            if not any(allowed):
                continue
            choice = learner.choose(situation, allowed)
            assert tuple(choice) == plain.choose(situation, allowed)
            kinds[choice.kind] += 1
            smf = generator.uniform(-1, 1)
            learner.learn(smf)
            plain.learn(situation, choice.motion, smf)
            check_same(learner, plain.at(situation), situation)
    assert len(kinds) == 3
