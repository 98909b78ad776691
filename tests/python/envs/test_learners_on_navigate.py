"""Learners of devlearn drive its environment as they drive a trial."""

import gymnasium
import pytest
from devlearn import (
    AdaptiveConfig,
    AdaptiveLearner,
    Learner,
    LearnerConfig,
    RandomAgent,
    RobotDef,
    Trial,
    TrialConfig,
    World,
    agents,
)
from devlearn.envs import LearnerOn, Navigate

WORLD = World(width=1.6, height=1.6, start=(0.3, 0.3, 180.0), target=(1.2, 1.2))
CONFIG = TrialConfig(robot=RobotDef(safety_margin=0.05))
SEED = 4

VALUE_LEARNERS = [
    agents.QLearning, agents.ExpectedSarsa, agents.SarsaLambda, agents.DynaQ,
    agents.PrioritizedSweeping, agents.LrtaStar, agents.RMax, agents.Appraisal,
    agents.SalientEvents,
]  # fmt: skip
# Each with what the environment's rewards are then.
LEARNERS = {
    "Learner": (lambda: Learner(LearnerConfig(), SEED), "smf"),
    "AdaptiveLearner": (lambda: AdaptiveLearner(AdaptiveConfig(), SEED), "cost"),
    "RandomAgent": (lambda: RandomAgent(SEED), "cost"),
    "OperantConditioning": (lambda: agents.OperantConditioning(seed=SEED), "smf"),
    **{kind.__name__: (lambda kind=kind: kind(seed=SEED), "cost") for kind in VALUE_LEARNERS},
}


class Noted(gymnasium.Wrapper):
    """Keeps the actions."""

    actions = ()

    def step(self, action):
        self.actions = (*self.actions, int(action))
        return self.env.step(action)


@pytest.mark.parametrize("name", LEARNERS)
def test_a_learner_makes_the_motions_that_it_makes_in_a_trial(name):
    make, reward = LEARNERS[name]
    record = Trial(WORLD, CONFIG, agent=make()).path_learning(rounds=12, step_limit=150)
    env = Noted(
        Navigate(
            WORLD, CONFIG, reward=reward, observe=["situation", "goal_distance"], step_limit=150
        )
    )
    robot = CONFIG.robot
    on = LearnerOn(
        env,
        make(),
        situations=lambda seen: int(seen["situation"]),
        evaluation="reward" if reward == "smf" else None,
        estimate=lambda seen: seen["goal_distance"][0] / (robot.speed * robot.sample_time),
    )
    episodes = on.run(12)
    assert env.actions == tuple(record.motion)
    assert list(episodes["steps"]) == list(record.rounds["steps"])
    assert list(episodes["terminated"]) == list(record.rounds["arrived"])
    assert episodes["terminated"].any() or name in (
        "RandomAgent", "RMax", "Appraisal", "SalientEvents",
    )  # fmt: skip
