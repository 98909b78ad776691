"""``python -m devlearn``: the command line."""

import sys

from .cli import command

sys.exit(command())
