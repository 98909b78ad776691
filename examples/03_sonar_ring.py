"""A real sonar ring: noise, echoes that fail to come, and a driver that falls silent.

A robot in a round room with pillars drives to a beacon. How close it is to anything, it knows from
its sonars alone: the least echo plus the robot's radius.
"""

import math
import sys

import devlearn

RADIUS, STEP = 0.1, 0.05  # of the robot [m]
TURNS = (-60.0, -30.0, 0.0, 30.0, 60.0)  # the motions: degrees turned, then STEP ahead
BEAMS, NEAREST, RANGE = 8, 0.02, 1.5  # of the ring; echoes count in [NEAREST, RANGE] m
ROOM = (2.0, 2.0, 1.9)  # circles: x, y, radius [m]
PILLARS = ((1.3, 1.2, 0.25), (2.6, 1.4, 0.2), (1.6, 2.7, 0.3))
BEACON = (3.1, 2.9)
TICKS, SEEDS = 3000, 5
SEF = devlearn.StateEvaluation()


def ray(x, y, hx, hy, circle):
    """Distance along a ray to a circle: to its near side, from inside to its far side."""
    dx, dy = circle[0] - x, circle[1] - y
    along, gap = dx * hx + dy * hy, dx * dx + dy * dy - circle[2] * circle[2]
    root = along * along - gap
    if root < 0.0:
        return math.inf
    distance = along - math.sqrt(root) if gap > 0.0 else along + math.sqrt(root)
    return distance if distance > 0.0 else math.inf


class Robot:
    def __init__(self, random):
        self.random = random
        self.readings = [RANGE] * BEAMS
        self.place_anywhere()

    def place_anywhere(self):
        self.heading = 360.0 * self.random.uniform()
        self.x, self.y = 0.0, 0.0
        while not self.free(self.x, self.y):
            self.x, self.y = 4.0 * self.random.uniform(), 4.0 * self.random.uniform()

    def free(self, x, y):
        def squared(circle):
            return (x - circle[0]) * (x - circle[0]) + (y - circle[1]) * (y - circle[1])

        inside = squared(ROOM) < (ROOM[2] - RADIUS) * (ROOM[2] - RADIUS)
        return inside and all(squared(p) > (p[2] + RADIUS) * (p[2] + RADIUS) for p in PILLARS)

    def move(self, motion):
        """Turns, then drives ahead; True where it bumped into something and stayed."""
        self.heading = devlearn.wrapped_heading(self.heading + TURNS[motion])
        hx, hy = devlearn.direction(self.heading)
        x, y = self.x + STEP * hx, self.y + STEP * hy
        bumped = not self.free(x, y)
        if not bumped:
            self.x, self.y = x, y
        return bumped

    def driver(self):
        """What the ring's driver delivers: three echoes of each beam [m from the rim]."""
        if self.random.index(50) == 0:
            return [[math.nan] * 3] * BEAMS  # the bus timed out
        return [self.pings(self.heading + 45.0 * beam) for beam in range(BEAMS)]

    def pings(self, heading):
        hx, hy = devlearn.direction(heading)
        distance = ray(self.x, self.y, hx, hy, ROOM)
        for pillar in PILLARS:
            distance = min(distance, ray(self.x, self.y, hx, hy, pillar))
        echoes = []
        for _ in range(3):
            luck, noise = self.random.uniform(), 0.02 * (self.random.uniform() - 0.5)
            lost, foreign = luck < 0.05, luck > 0.98  # or another sonar's click
            echoes.append(math.nan if lost else 0.0 if foreign else distance - RADIUS + noise)
        return echoes

    def listen(self):
        """The door: keeps what can be believed; False where the ring said nothing at all."""
        ring = self.driver()
        if all(math.isnan(echo) for echoes in ring for echo in echoes):
            return False
        for beam, echoes in enumerate(ring):
            believable = sorted(echo for echo in echoes if NEAREST <= echo <= RANGE)  # never NaN
            self.readings[beam] = believable[len(believable) // 2] if believable else RANGE
        return True

    def beacon(self):
        """How far the beacon is, how far ahead and how far to the left."""
        hx, hy = devlearn.direction(self.heading)
        dx, dy = BEACON[0] - self.x, BEACON[1] - self.y
        return math.sqrt(dx * dx + dy * dy), dx * hx + dy * hy, dy * hx - dx * hy

    def situation(self):
        """In which eighth of the circle the beacon lies, and which front beams hear something."""
        _, ahead, left = self.beacon()
        eighth = 4 * (ahead > 0.0) + 2 * (left > 0.0) + (abs(left) > abs(ahead))
        right, front, left = (self.readings[beam] < 0.2 for beam in (7, 0, 1))
        return 8 * eighth + 4 * right + 2 * front + left

    def evaluation(self):
        """Eq. 6, with the clearance that a real robot has: least echo + radius."""
        return SEF(self.beacon()[0], min(self.readings) + RADIUS)


def run(seed, learns):
    """Bumps and beacons found in the last 1000 of TICKS."""
    random = devlearn.Random(seed, "example")
    robot = Robot(random)
    learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=5), seed)
    before = None  # SEF, where it is known
    bumps = found = 0
    for tick in range(TICKS):
        chosen = learner.choose(robot.situation()).motion
        bumped = robot.move(chosen if learns else random.index(5))
        after = robot.evaluation() if robot.listen() else None
        if before is None or after is None:
            learner.cancel()  # nobody knows how good that motion was
        else:
            smf = after - before
            learner.learn(min(smf, -1.0) if bumped else smf)  # a bump is never good
        before = after

        late = tick >= TICKS - 1000
        bumps += late and bumped
        if robot.beacon()[0] < 0.15:
            found += late
            robot.place_anywhere()
            before = None  # it was carried there
    return bumps, found


def summary(values):
    values = sorted(values)
    return f"{values[len(values) // 2]:4d} ({values[0]} ... {values[-1]})"


try:
    SEF(1.0, math.nan)
except devlearn.InvalidValue as error:
    print("devlearn's own door:", error)
results = {}
for learns in (True, False):
    runs = [run(seed, learns) for seed in range(1, SEEDS + 1)]
    print("motions as learned" if learns else "motions at random")
    print("  bumps in the last 1000 ticks:", summary([bumps for bumps, _ in runs]))
    print("  beacons found in them       :", summary([found for _, found in runs]))
    results[learns] = [sorted(values)[SEEDS // 2] for values in zip(*runs)]
(bumps, found), (random_bumps, random_found) = results[True], results[False]
sys.exit(not (3 * bumps < random_bumps and found > 3 * random_found))
