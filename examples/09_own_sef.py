"""A trial with an evaluation and situations of one's own.

The paper's situations are cells of a map, and its SEF is Eq. 6. Here both are made of what a robot
sees from where it is: in which eighth of the circle the target lies, and whether it faces it. What
is learned in one place holds in all of them, so eight situations are enough in an open room.
"""

import sys

import devlearn

TARGET = (2.4, 2.4)


def seen(senses):
    """Where the target is: how far ahead, how far to the left [m]."""
    hx, hy = devlearn.direction(senses.pose.heading)
    dx, dy = TARGET[0] - senses.pose.x, TARGET[1] - senses.pose.y
    return dx * hx + dy * hy, dy * hx - dx * hy


def eighth(senses):
    """In which eighth of the circle the target lies: 0 ... 7."""
    ahead, left = seen(senses)
    return 4 * (ahead > 0.0) + 2 * (left > 0.0) + (abs(left) > abs(ahead))


def facing(senses):
    """It is good to be near the target, and to face it."""
    distance = max(senses.goal_distance, 0.01)
    return 0.4 * seen(senses)[0] / distance - distance


world = devlearn.World(width=3.0, height=3.0, start=(0.5, 0.5, 180.0), target=TARGET)
own = {"evaluation": facing, "situations": eighth}


def median_of_rounds(trial):
    """Of the steps of 20 rounds, the first ones."""
    steps = trial.path_learning(20, step_limit=5000).rounds["steps"]
    return int(sorted(steps)[10])


plain, ours = [], []
for seed in range(1, 8):
    plain.append(median_of_rounds(devlearn.Trial(world, seed=seed)))
    trial = devlearn.Trial(world, seed=seed, **own)
    ours.append(median_of_rounds(trial))


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:5d} ({values[0]} ... {values[-1]})"


print("steps to the target, median of the first 20 rounds: median of 7 seeds (least ... most)")
print("  the map's cells, Eq. 6         ", summary(plain))
print("  seen from the robot, facing it ", summary(ours))

# A file names the functions. Whoever loads it gives them again.
again = devlearn.Trial.from_bytes(trial.to_bytes(), **own)
same = again.path_learning(5).rounds["steps"] == trial.path_learning(5).rounds["steps"]
print("goes on alike from a snapshot:", "yes" if same.all() else "no")
sys.exit(not (same.all() and max(ours) < min(plain)))
