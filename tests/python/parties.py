"""Agents and measures that tests of sweeps name as ``parties:...``."""

import os
import signal
import time
from pathlib import Path

import numpy as np


class Straight:
    """Always the same motion."""

    def __init__(self, seed, motion=2):
        self.motion = motion

    def choose(self, observation):
        return self.motion

    def observe(self, outcome):
        pass


class Raises(Straight):
    """Fails in its first step where its seed is even."""

    def __init__(self, seed):
        super().__init__(seed)
        self.seed = seed

    def choose(self, observation):
        if self.seed % 2 == 0:
            raise RuntimeError(f"no motion for seed {self.seed}")
        return 2


class Repaired(Straight):
    """Fails as long as a file is not there."""

    def __init__(self, seed, told):
        super().__init__(seed)
        Path(told).stat()


class Deadly(Straight):
    """Ends its process where its seed is 3, and tells of it in a file."""

    def __init__(self, seed, told):
        super().__init__(seed)
        if seed == 3:
            with Path(told).open("a") as file:
                file.write("died\n")
            os.kill(os.getpid(), signal.SIGKILL)


class DiesOnce(Straight):
    """Ends its process where its seed is 3 and nobody did before."""

    def __init__(self, seed, told):
        super().__init__(seed)
        if seed == 3 and not Path(told).exists():
            Path(told).touch()
            os.kill(os.getpid(), signal.SIGKILL)


class Slow(Straight):
    """Takes a while to begin."""

    def __init__(self, seed, seconds=0.05):
        super().__init__(seed)
        time.sleep(seconds)


def step_count(run):
    return len(run.record)


def three_values(run):
    return {"steps": [len(run.record)], "name": "x"}


def nothing(run):
    return None


def threads(run):
    """How many threads linear algebra may take where it is measured."""
    return {"threads": os.environ.get("OMP_NUM_THREADS")}


def wrong(run):
    return np.zeros


class Changes(Straight):
    """Changes the list that it was given."""

    def __init__(self, seed, motions):
        super().__init__(seed)
        motions.append(seed)


class Bare(BaseException):
    """No Exception."""


class RaisesBare(Straight):
    """Fails by what is no Exception, with a text that is no Unicode."""

    def choose(self, observation):
        raise Bare("\udc80 is half a letter")
