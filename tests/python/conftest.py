"""What several tests share."""

import os
import re
import signal

import devlearn
import numpy as np
import pytest
from devlearn import cli
from devlearn.record import POSE_COLUMNS, STEP_COLUMNS
from hypothesis import settings

# Ctrl-C is tested, too; a shell that runs the tests in the background would have it ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)

# The same examples every time, however slow the machine.
settings.register_profile("devlearn", derandomize=True, deadline=None, max_examples=60)
settings.load_profile("devlearn")


def refuse_skips(report):
    """Under scripts/test nothing is passed over: what is skipped has failed, with the reason."""
    if report.skipped and not hasattr(report, "wasxfail") and "DEVLEARN_NO_SKIPS" in os.environ:
        report.outcome = "failed"
        report.longrepr = f"skipped, where DEVLEARN_NO_SKIPS is set: {report.longrepr}"


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport():
    """A test that is skipped."""
    refuse_skips((yield).get_result())


@pytest.hookimpl(hookwrapper=True)
def pytest_make_collect_report():
    """A module that is skipped whole."""
    refuse_skips((yield).get_result())


@pytest.fixture(scope="session")
def paper():
    """The world after Fig. 2."""
    return devlearn.World.load("paper")


@pytest.fixture(scope="session")
def history(paper):
    """A record of all kinds of round in the paper's world, with echoes; not to be changed."""
    trial = devlearn.Trial(paper, seed=5)
    records = [
        trial.free_learning(3000, echoes=True),
        trial.free_learning(1000, echoes=True),
        trial.path_learning(12, step_limit=600, echoes=True),
    ]
    return joined(records)


def joined(records):
    """One record of several in a row, each of its own rounds."""
    names = [*STEP_COLUMNS, *POSE_COLUMNS, "rounds"]
    if records[0].echoes is not None:
        names.append("echoes")
    columns = {name: np.concatenate([getattr(r, name) for r in records]) for name in names}
    return devlearn.Record(columns, records[0].provenance)


def differences(a, b, names=(*STEP_COLUMNS, *POSE_COLUMNS, "rounds", "echoes")):
    """Names of the columns in which two records differ in any bit."""
    return [n for n in names if not same(getattr(a, n), getattr(b, n))]


def same(a, b):
    """Whether two columns are equal to the bit, in type and shape, too."""
    if a is None or b is None:
        return a is b
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def refused(call, quantity=None, value=None):
    """Checks that a call raises InvalidValue, whole and worded; gives the error."""
    with pytest.raises(devlearn.InvalidValue) as caught:
        call()
    error = caught.value
    assert isinstance(error, ValueError)
    assert quantity is None or error.quantity == quantity
    assert value is None or error.value == value
    assert isinstance(error.value, str)
    assert error.allowed
    assert str(error).endswith(f": got {error.value}; expected {error.allowed}")
    return error


def refusal(capsys, *arguments):
    """The one line that a refused command writes."""
    assert cli.main(list(map(str, arguments))) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert re.fullmatch(r"devlearn: .+\n", err), err
    return err
