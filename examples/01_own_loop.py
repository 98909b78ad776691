"""The learner in a control loop of one's own.

A robot on two wheels learns to find its charger, wherever it stands. The robot, its clock and what
it senses are modelled here; the learner knows none of them.
"""

import math
import sys

import devlearn

TURNS = (20.0, 0.0, -20.0)  # the motions: degrees turned in a tick, then STEP metres ahead
NAMES = ("left", "ahead", "right")
STEP = 0.05
LIMIT = 300  # ticks a round


class Robot:
    """The charger is at the origin; x, y [m], heading [degrees]."""

    def __init__(self, random):
        self.x = 4.0 * random.uniform() - 2.0
        self.y = 4.0 * random.uniform() - 2.0
        self.heading = 360.0 * random.uniform()
        self.look()

    def move(self, motion):
        self.heading = devlearn.wrapped_heading(self.heading + TURNS[motion])
        hx, hy = devlearn.direction(self.heading)
        self.x += STEP * hx
        self.y += STEP * hy
        self.look()

    def look(self):
        """Where the charger is, as its beacon tells: how far, how far ahead and to the left."""
        hx, hy = devlearn.direction(self.heading)
        self.distance = math.sqrt(self.x * self.x + self.y * self.y)
        self.ahead = -(self.x * hx + self.y * hy)
        self.left = -(self.y * hx - self.x * hy)

    def situation(self):
        """In which eighth of the circle the charger lies: 0 ... 7."""
        wide = abs(self.left) > abs(self.ahead)
        return 4 * (self.ahead > 0.0) + 2 * (self.left > 0.0) + wide

    def evaluation(self):
        """It is good to be near the charger, and to face it."""
        return 0.4 * self.ahead / self.distance - self.distance


def learned_round(robot, learner):
    """How many ticks the robot takes to the charger; LIMIT where it does not arrive."""
    before = robot.evaluation()
    for tick in range(LIMIT):
        if robot.distance < 0.15:
            return tick
        choice = learner.choose(robot.situation())
        robot.move(choice.motion)
        after = robot.evaluation()
        learner.learn(after - before)  # > 0: things became better
        before = after
    return LIMIT


def aimless_round(robot, random):
    """The same with motions at random."""
    for tick in range(LIMIT):
        if robot.distance < 0.15:
            return tick
        robot.move(random.index(3))
    return LIMIT


early, late, aimless = [], [], []
for seed in range(1, 22):
    random = devlearn.Random(seed, "example")
    learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=3), seed)
    ticks = [learned_round(Robot(random), learner) for _ in range(40)]
    early.append(ticks[0])
    late.append(sum(ticks[20:]) / 20)
    aimless.append(aimless_round(Robot(random), random))


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:6.1f} ({values[0]:.1f} ... {values[-1]:.1f})"


print("ticks to the charger: median of 21 seeds (least ... most)")
print("  first round        ", summary(early))
print("  rounds 21 to 40    ", summary(late))
print("  motions at random  ", summary(aimless))
print("what the last one learned: where the charger lies, and the motions that help")
for situation in range(8):
    memory = learner.situation(situation)
    known = zip(memory.effective, memory.orientation)
    words = ", ".join(f"{NAMES[motion]} {orientation:.2f}" for motion, orientation in known)
    print(f"  eighth {situation}:", words or "none at present, so any may be tried")
sys.exit(not max(late) < 60)
