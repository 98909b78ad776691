"""The command line as a program: ``devlearn``, and ``python -m devlearn``."""

from __future__ import annotations

import signal
import sys

# While it starts there is nothing to save, and Ctrl-C ends it at once; what it imports could only
# show a traceback of that. Where it is ignored, it stays so.
_heard = signal.getsignal(signal.SIGINT)
if _heard is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def command() -> int:
    """Main, and then there is nothing left to stop."""
    from .cli import main

    signal.signal(signal.SIGINT, _heard)
    code = main()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    return code


if __name__ == "__main__":
    sys.exit(command())
