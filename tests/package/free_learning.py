"""Prints which devlearn this is, and a free learning's history as one digest of its bits."""

import hashlib

import devlearn
from devlearn import _core

record = devlearn.Trial(devlearn.World.load("paper"), seed=1).free_learning(2000)
columns = [record.situation, record.motion, record.smf, record.x, record.y, record.heading]
digest = hashlib.sha256(b"".join(column.tobytes() for column in columns)).hexdigest()
print(f"devlearn {devlearn.__version__} {_core.commit}: {len(record)} steps, sha256 {digest}")
