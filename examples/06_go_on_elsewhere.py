"""Going on elsewhere: what 05_learn_in_simulation saved, on a robot whose wheels slip.

The same motions, the same grid of situations and the same SEF as in simulation, in a program that
needs no simulator. It saves as it goes, and a power cut costs it nothing.

    06_go_on_elsewhere FILE
"""

import math
import sys

import devlearn

TURNS = (-60.0, -30.0, 0.0, 30.0, 60.0)
LIMIT = 5000  # ticks a round

if len(sys.argv) != 2:
    sys.exit("usage: 06_go_on_elsewhere FILE")
grid = devlearn.SituationGrid(3.0, 3.0, columns=12, rows=12, headings=12)
evaluation = devlearn.StateEvaluation()


class Robot:
    """From (0.5, 0.5) to (2.4, 2.4) [m] in a room of 3 m x 3 m."""

    def __init__(self, random):
        self.random = random
        self.x, self.y, self.heading = 0.5, 0.5, 0.0

    def move(self, motion):
        """Turns, then drives, both inexactly; True where it ran into a wall."""
        slip = 10.0 * self.random.uniform() - 5.0
        self.heading = devlearn.wrapped_heading(self.heading + TURNS[motion] + slip)
        hx, hy = devlearn.direction(self.heading)
        step = 0.04 + 0.01 * self.random.uniform()
        x, y = self.x + step * hx, self.y + step * hy
        self.x, self.y = min(max(x, 0.1), 2.9), min(max(y, 0.1), 2.9)
        return self.x != x or self.y != y

    def target_distance(self):
        dx, dy = 2.4 - self.x, 2.4 - self.y
        return math.sqrt(dx * dx + dy * dy)


def round_of(learner, seed):
    """Ticks from start to target; LIMIT where it did not arrive."""
    robot = Robot(devlearn.Random(seed, "slip"))
    before = evaluation(robot.target_distance(), math.inf)
    for tick in range(LIMIT):
        if robot.target_distance() <= 0.1:
            return tick
        motion = learner.choose(grid.situation(robot.x, robot.y, robot.heading)).motion
        bumped = robot.move(motion)
        after = evaluation(robot.target_distance(), math.inf)
        learner.learn(min(after - before, -1.0) if bumped else after - before)
        before = after
    return LIMIT


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:5d} ({values[0]} ... {values[-1]})"


# How much of it carries over: first rounds on the robot, with and without the simulation's memory.
experienced, new = [], []
for seed in range(1, 12):
    experienced.append(round_of(devlearn.Learner.load(sys.argv[1]), seed))
    new.append(round_of(devlearn.Learner(devlearn.LearnerConfig(motion_count=5), seed), seed))
print("ticks of a first round: median of 11 seeds (least ... most)")
print("  with what simulation taught:", summary(experienced))
print("  from nothing               :", summary(new))

# A working life of 30 rounds; the power fails after the 25th, and the last snapshot is of the 20th.
learner = devlearn.Learner.load(sys.argv[1])
ticks, snapshot = [], b""
for number in range(1, 31):
    ticks.append(round_of(learner, 100 + number))
    if number % 10 == 0 and number < 30:
        snapshot = learner.to_bytes()  # here, between two rounds; written out by whoever has time
restarted = devlearn.Learner.from_bytes(snapshot)
again = [round_of(restarted, 100 + number) for number in range(21, 31)]
same = again == ticks[20:] and restarted.to_bytes() == learner.to_bytes()
print("30 rounds on the robot       :", summary(ticks))
print(f"  then {learner.effective_count} motions in {learner.situations_experienced} situations")
print("restarted from the snapshot, it went the same way:", "yes" if same else "no")
sys.exit(not (same and 2 * sorted(experienced)[5] < sorted(new)[5]))
