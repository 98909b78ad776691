"""The learner once more, in plain Python, written from method.md alone, for tests to agree with.

Lists and dicts, no cleverness. Draws come from outside, so that it can be given the same ones.
"""

import math

MASK = 2**64 - 1

EXPLORE, EXPLOIT, EXHAUSTED = range(3)
NOTHING, EXTENSION, REJECTION, ORIENTATION, ABANDONMENT = range(5)


class Situation:
    """M_i, M-bar_i and RM_i, with orientation and count of each motion in M_i."""

    def __init__(self, motion_count):
        self.effective = []
        self.ineffective = []
        self.unexplored = list(range(motion_count))
        self.orientation = {}
        self.times_learned = {}


class Reference:
    """Steps 3-5 of the method. `draw(count)` gives a whole number uniform on 0 ... count - 1."""

    def __init__(
        self,
        draw,
        motion_count=5,
        eta=0.05,
        sigma=0.3,
        c1=0.5,
        c2=1.0,
        on_negative="abandon",
        when_exhausted="retry",
    ):
        self.draw = draw
        self.motion_count = motion_count
        self.eta = eta
        self.sigma = sigma
        self.c1 = c1
        self.c2 = c2
        self.on_negative = on_negative
        self.when_exhausted = when_exhausted
        self.situations = {}
        self.explored_count = 0

    def at(self, situation):
        return self.situations.setdefault(situation, Situation(self.motion_count))

    @property
    def effective_count(self):
        return sum(len(s.effective) for s in self.situations.values())

    # Step 3

    def curiosity(self, times_learned):  # Eq. 5
        exponent = self.c1 * (times_learned - self.c2)
        return 0.0 if exponent > 700 else 1 / (1 + math.exp(exponent))

    def choose(self, situation, allowed=None):
        s = self.at(situation)
        allowed = [m for m in range(self.motion_count) if allowed is None or allowed[m]]
        effective = [m for m in s.effective if m in allowed]
        unexplored = [m for m in s.unexplored if m in allowed]
        n, n_r = len(effective), len(unexplored)
        if n + n_r == 0:
            return allowed[self.draw(len(allowed))], EXHAUSTED
        drawn = self.draw(n + n_r)
        if drawn < n_r:
            return unexplored[drawn], EXPLORE
        curious = effective[drawn - n_r]

        def op(motion):  # Eq. 7
            active = self.curiosity(s.times_learned[motion]) if motion == curious else 0.0
            return self.sigma * s.orientation[motion] + (1 - self.sigma) * active

        return max(effective, key=op), EXPLOIT  # the first among equals

    # Steps 4-5

    def learn(self, situation, motion, smf):
        """Returns the event and how many motions were reduced."""
        s = self.at(situation)
        if motion in s.unexplored:
            self.explored_count += 1
            s.unexplored.remove(motion)
            if smf >= 0:
                self.extend(s, motion)
                return EXTENSION, 0
            s.ineffective.append(motion)
            return REJECTION, 0
        if motion in s.effective:
            s.times_learned[motion] += 1
            if smf < 0 and self.on_negative == "abandon":
                self.remove(s, [motion])
                return ABANDONMENT, 0
            self.orient(s, motion, smf)
            return ORIENTATION, self.reduce(s)
        if smf >= 0 and self.when_exhausted == "retry":
            s.ineffective.remove(motion)
            self.extend(s, motion)
            return EXTENSION, 0
        return NOTHING, 0

    @staticmethod
    def extend(s, motion):  # Eq. 10-13
        n = len(s.effective)
        for other in s.effective:
            s.orientation[other] *= n / (n + 1)
        s.effective.append(motion)
        s.orientation[motion] = 1 / (n + 1)
        s.times_learned[motion] = 1

    def orient(self, s, chosen, smf):  # Eq. 9
        if len(s.effective) == 1:
            return
        exponent = -self.eta * smf
        d = -1.0 if exponent > math.log(2) else 1 - math.exp(exponent)
        o = s.orientation[chosen]
        for motion in s.effective:
            gain = o * d if motion == chosen else 0.0
            s.orientation[motion] = (s.orientation[motion] + gain) / (1 + o * d)
        self.normalise(s)

    @staticmethod
    def normalise(s):
        # In Eq. 9, 11 and 14 the sum is 1 as a matter of algebra; floating point needs telling.
        total = math.fsum(s.orientation.values())
        for motion in s.orientation:
            s.orientation[motion] /= total

    def reduce(self, s):  # Eq. 14-17
        threshold = 1 / (3 * len(s.effective))
        poor = [motion for motion in s.effective if s.orientation[motion] < threshold]
        self.remove(s, poor)
        return len(poor)

    def remove(self, s, motions):
        for motion in motions:
            s.effective.remove(motion)
            s.ineffective.append(motion)
            del s.orientation[motion], s.times_learned[motion]
        if motions and s.effective:
            self.normalise(s)


class Xoshiro:
    """xoshiro256++ seeded by SplitMix64 from a seed and a stream's name, in whole numbers."""

    def __init__(self, seed, stream):
        name = 0xCBF29CE484222325  # FNV-1a
        for byte in stream.encode():
            name = (name ^ byte) * 0x100000001B3 & MASK
        _, scrambled = self.split_mix(seed)
        word = scrambled ^ name
        self.state = []
        for _ in range(4):
            word, output = self.split_mix(word)
            self.state.append(output)

    @staticmethod
    def split_mix(word):
        word = word + 0x9E3779B97F4A7C15 & MASK
        z = (word ^ word >> 30) * 0xBF58476D1CE4E5B9 & MASK
        z = (z ^ z >> 27) * 0x94D049BB133111EB & MASK
        return word, z ^ z >> 31

    def next(self):
        def rotated(x, by):
            return (x << by | x >> 64 - by) & MASK

        a, b, c, d = self.state
        result = rotated(a + d & MASK, 23) + a & MASK
        shifted = b << 17 & MASK
        c ^= a
        d ^= b
        b ^= c
        a ^= d
        c ^= shifted
        self.state = [a, b, c, rotated(d, 45)]
        return result

    def uniform(self):
        return (self.next() >> 11) / 2**53

    def index(self, count):
        # Of the 2**32 draws, the first 2**32 mod count of a residue's run are too many.
        while True:
            product = (self.next() >> 32) * count
            if product % 2**32 >= 2**32 % count:
                return product >> 32
