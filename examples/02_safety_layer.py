"""A safety layer that has the last word.

A robot drives about a table top, whose edges are cliffs, to its dock. Where a motion would lead
over an edge, the safety layer drives the other way; while a hand is over the table, nothing moves.
The learner is not told of refusals, or told of them afterwards, or told beforehand which motions
are allowed.
"""

import math
import sys

import devlearn

SIDE, MARGIN, CELL = 1.0, 0.05, 0.1  # of the table [m]
EAST, NORTH, WEST, SOUTH = range(4)  # the motions
DOCK = (0.9, 0.5)
TICKS = 4000


class Robot:
    def __init__(self, random):
        self.random = random
        self.place_anywhere()

    def place_anywhere(self):
        self.x = 0.05 + 0.9 * self.random.uniform()
        self.y = 0.05 + 0.9 * self.random.uniform()

    def after(self, motion, step):
        x = self.x + step * ((motion == EAST) - (motion == WEST))
        y = self.y + step * ((motion == NORTH) - (motion == SOUTH))
        return x, y

    def move(self, motion):
        self.x, self.y = self.after(motion, 0.04 + 0.02 * self.random.uniform())

    def safe(self, motion):
        """The safety layer: the motion, or where that could lead over an edge the opposite one."""
        x, y = self.after(motion, 0.06)
        on_table = MARGIN < x < SIDE - MARGIN and MARGIN < y < SIDE - MARGIN
        return motion if on_table else (motion + 2) % 4

    def situation(self):
        return 10 * int(self.y / CELL) + int(self.x / CELL)

    def distance(self):
        dx, dy = DOCK[0] - self.x, DOCK[1] - self.y
        return math.sqrt(dx * dx + dy * dy)


def run(seed, told):
    """Refusals in each quarter of the ticks, times docked, the learner."""
    random = devlearn.Random(seed, "example")
    robot = Robot(random)
    learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=4), seed)
    refusals, docked = [0, 0, 0, 0], 0
    for tick in range(TICKS):
        situation, before = robot.situation(), robot.distance()
        allowed = None
        if told == "what is allowed":
            allowed = [robot.safe(motion) == motion for motion in range(4)]
        chosen = learner.choose(situation, allowed).motion
        if random.index(20) == 0:  # a hand
            known = learner.explored_count
            learner.cancel()  # nothing ran, so nothing is learned
            assert learner.explored_count == known
            continue

        ran = robot.safe(chosen)
        robot.move(ran)
        assert 0.0 < robot.x < SIDE and 0.0 < robot.y < SIDE
        learner.learn(before - robot.distance(), ran)  # about the motion that really ran
        if ran != chosen:
            refusals[4 * tick // TICKS] += 1
            if (
                told == "of refusals"
            ):  # the edge will be here next time, too: let that motion count as tried
                learner.update(situation, chosen, -1.0)

        if robot.distance() < 0.06:
            docked += 1
            robot.place_anywhere()
    return refusals, docked, learner


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:4d} ({values[0]} ... {values[-1]})"


results = {}
for told in ("nothing of refusals", "of refusals", "what is allowed"):
    runs = [run(seed, told) for seed in range(1, 12)]
    print("the learner is told", told)
    print("  refused in ticks    1 ... 1000:", summary([refusals[0] for refusals, _, _ in runs]))
    print("  refused in ticks 3001 ... 4000:", summary([refusals[3] for refusals, _, _ in runs]))
    print("  times docked                  :", summary([docked for _, docked, _ in runs]))
    results[told] = sorted(refusals[3] for refusals, _, _ in runs)
    print("what the last one makes of the place before the eastern edge, where east is refused:")
    print(runs[-1][2].explain(59))
assert not any(results["what is allowed"])
sys.exit(not 2 * results["of refusals"][5] < results["nothing of refusals"][5])
