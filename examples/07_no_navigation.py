"""A task that is no navigation: a pole that stands on a motor must not fall.

The learner stays as it is. New are the situations (how the pole leans and how fast it falls), the
motions (how the motor pushes) and the evaluation of states.
"""

import sys

import devlearn

PUSHES = (-300.0, 0.0, 300.0)  # the motions: the motor's push [degrees/s^2]
TICK = 0.02  # [s]
LIMIT = 1000  # ticks: 20 s
LEAN_BORDERS = (-8.0, -4.0, -1.5, 0.0, 1.5, 4.0, 8.0)  # [degrees]
SPEED_BORDERS = (-40.0, -20.0, -8.0, 0.0, 8.0, 20.0, 40.0)  # [degrees/s]


class Pole:
    """Half a metre long; its lean is 0 upright and positive to the left."""

    def __init__(self, random):
        self.random = random
        self.lean = 6.0 * random.uniform() - 3.0  # [degrees]
        self.speed = 0.0  # [degrees/s]

    def push(self, motion):
        """One tick of the motor, of gravity and of draughts."""
        gravity = 19.6 * 57.3 * devlearn.direction(self.lean)[1]
        draught = 200.0 * (self.random.uniform() - 0.5)
        self.speed += TICK * (gravity + PUSHES[motion] + draught)
        self.lean += TICK * self.speed

    def fallen(self):
        return abs(self.lean) > 30.0

    def situation(self):
        lean = sum(self.lean > border for border in LEAN_BORDERS)
        speed = sum(self.speed > border for border in SPEED_BORDERS)
        return 8 * lean + speed

    def evaluation(self):
        """It is good to stand upright, or to be on the way there: lean + 0.25 s x speed is 0."""
        return -abs(self.lean + 0.25 * self.speed)


def balance(pole, learner):
    """Seconds until the pole falls; 20 where it stands to the end."""
    for tick in range(LIMIT):
        before = pole.evaluation()
        choice = learner.choose(pole.situation())
        pole.push(choice.motion)
        learner.learn(pole.evaluation() - before)
        if pole.fallen():
            return TICK * tick
    return TICK * LIMIT


def let_fall(pole, random):
    """The same with pushes at random."""
    for tick in range(LIMIT):
        pole.push(random.index(3))
        if pole.fallen():
            return TICK * tick
    return TICK * LIMIT


first, last, aimless = [], [], []
for seed in range(1, 12):
    random = devlearn.Random(seed, "example")
    learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=3), seed)
    seconds = [balance(Pole(random), learner) for _ in range(20)]
    first.append(seconds[0])
    last.append(seconds[19])
    aimless.append(let_fall(Pole(random), random))


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:6.2f} s ({values[0]:.2f} ... {values[-1]:.2f})"


print("how long the pole stands, of 20 s: median of 11 seeds (least ... most)")
print("  first attempt     ", summary(first))
print("  20th attempt      ", summary(last))
print("  pushes at random  ", summary(aimless))
sys.exit(not sorted(last)[5] > 4 * max(aimless))
