"""Several robots that share one memory, and outcomes that come late.

Carriers in a hall bring parcels to a hatch. A computer in the office chooses for all of them; what
a motion led to, each radios back some ticks later. Whatever one carrier learns, all know.
"""

import sys

import devlearn

SIZE = 16  # the hall's cells a side; the hatch is in the corner (0, 0)
MOVES = ((1, 0), (0, 1), (-1, 0), (0, -1))
TICKS = 600


class Carrier:
    def __init__(self, random):
        self.random = random
        self.fetch_parcel()

    def fetch_parcel(self):
        self.x, self.y = self.random.index(SIZE), self.random.index(SIZE)

    def situation(self):
        return SIZE * self.y + self.x

    def move(self, motion):
        """The SMF: cells nearer to the hatch; -1 where a wall was in the way."""
        x, y = self.x + MOVES[motion][0], self.y + MOVES[motion][1]
        if not (0 <= x < SIZE and 0 <= y < SIZE):
            return -1
        smf = self.x + self.y - (x + y)
        self.x, self.y = x, y
        return smf


def run(seed, team):
    """Parcels that each carrier brought, on average, and the learner's memory."""
    random = devlearn.Random(seed, "example")
    learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=4), seed)
    carriers = [Carrier(random) for _ in range(team)]
    on_the_air = []  # (tick of arrival, situation, motion, smf)
    parcels = 0
    for tick in range(TICKS):
        for carrier in carriers:
            situation = carrier.situation()
            motion = learner.choose(situation).motion
            learner.cancel()  # the outcome will come by update, so that others can choose meanwhile
            smf = carrier.move(motion)
            on_the_air.append((tick + random.index(6), situation, motion, smf))
            if carrier.situation() == 0:
                parcels += 1
                carrier.fetch_parcel()

        still_on_the_air = []
        for report in on_the_air:
            arrives, situation, motion, smf = report
            if arrives <= tick:
                learner.update(situation, motion, smf)
            else:
                still_on_the_air.append(report)
        on_the_air = still_on_the_air
    return parcels / team, learner


def same_as_learn(seed):
    """For one robot and outcomes at once, choose-cancel-update is choose-learn, to the bit."""
    one, other = (devlearn.Learner(devlearn.LearnerConfig(motion_count=4), seed) for _ in range(2))
    carrier = Carrier(devlearn.Random(seed, "example"))
    for _ in range(TICKS):
        situation = carrier.situation()
        motion = one.choose(situation).motion
        if other.choose(situation).motion != motion:
            return False
        other.cancel()
        smf = carrier.move(motion)
        one.learn(smf)
        other.update(situation, motion, smf)
    return one.to_bytes() == other.to_bytes()


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:6.2f} ({values[0]:.2f} ... {values[-1]:.2f})"


print(f"parcels a carrier in {TICKS} ticks: median of 11 seeds (least ... most)")
medians = []
for team in (1, 3, 9):
    runs = [run(seed, team) for seed in range(1, 12)]
    print(f"  {team} with one memory:", summary([parcels for parcels, _ in runs]))
    medians.append(sorted(parcels for parcels, _ in runs)[5])
same = all(same_as_learn(seed) for seed in range(1, 12))
print("choose, cancel, update is choose, learn:", "yes" if same else "no")
sys.exit(not (same and medians[2] > 1.5 * medians[0]))
