"""The adaptive learner in a loop of one's own, where the straight way is a trap.

A robot goes from S to G, cell by cell. The wall between them is open towards S: who goes nearer and
nearer ends in it. The adaptive learner finds out that its estimate is wrong there, goes round, and
makes its best round a habit. It is told what each step cost, and an estimate of the cost to go.
"""

import sys

import devlearn

YARD = (
    "###############",
    "#.............#",
    "#.....#####...#",
    "#.........#...#",
    "#.S.......#.G.#",
    "#.........#...#",
    "#.....#####...#",
    "#.............#",
    "###############",
)
WIDTH = len(YARD[0])
CELLS = "".join(YARD)
START, GOAL = CELLS.index("S"), CELLS.index("G")
MOTIONS = (-WIDTH, 1, WIDTH, -1)  # up, right, down, left
SHORTEST = 16  # steps


def estimate(cell):
    """Steps to the goal if nothing were in the way; 0 there and nowhere else."""
    down, right = abs(cell // WIDTH - GOAL // WIDTH), abs(cell % WIDTH - GOAL % WIDTH)
    return float(down + right)


def learned_round(learner):
    """What a round costs: 1 a step, and 1 more where it bumps into a wall."""
    learner.begin_round()
    cell, cost = START, 0
    while cell != GOAL:
        choice = learner.choose(cell, estimate(cell))
        there = cell + MOTIONS[choice.motion]
        bumped = CELLS[there] == "#"
        cell = cell if bumped else there
        learner.learn(1.0 + bumped, cell, estimate(cell), interrupted=bumped)
        cost += 1 + bumped
    learner.end_round(True)
    return cost


first, last, habit = [], [], []
for seed in range(1, 12):
    learner = devlearn.AdaptiveLearner(devlearn.AdaptiveConfig(motion_count=4), seed)
    costs = [learned_round(learner) for _ in range(60)]
    first.append(costs[0])
    last.append(costs[59])
    habit.append(int(learner.habit_cost))


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:4d} ({values[0]} ... {values[-1]})"


print("cost from S to G: median of 11 seeds (least ... most)")
print("  first round   ", summary(first))
print("  60th round    ", summary(last))
print("  the habit     ", summary(habit))
print("  shortest way  ", f"{SHORTEST:4d}")

deep = 4 * WIDTH + 9  # in the trap, before its wall
print("what the last one knows of the bottom of the trap; motions are up, right, down, left")
print(learner.explain(deep), end="")
print(f"adaptive SEF there: {-(estimate(deep) + learner.expected_loss(deep)):.4g}")
sys.exit(not max(habit) <= 1.25 * SHORTEST)
