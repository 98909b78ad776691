"""The measures of a run, each on rounds made by hand."""

import math

import numpy as np
import pytest
from devlearn import Tally, World
from devlearn.experiments import contenders, job, measures, spec
from devlearn.experiments.measures import MEASURES, Run
from devlearn.experiments.schedule import Schedule


def made(steps, *, failed=(), paths=None, free=(), planned=None, shortest=100, **columns):
    """A run of so many steps a round after free learning; a tenth of the steps touch."""
    rounds = np.zeros(len(free) + len(steps), Tally().rounds.dtype)
    rounds["round"] = np.arange(1, len(rounds) + 1)
    rounds["steps"] = [*free, *steps]
    late = rounds[len(free) :]
    late["arrived"] = True
    late["arrived"][list(failed)] = False
    late["first_arrival"] = np.where(late["arrived"], late["steps"], 0)
    late["path"] = np.arange(len(steps)) if paths is None else paths
    rounds["touches"] = rounds["steps"] // 10
    for name, values in columns.items():
        rounds[name] = values
    schedule = Schedule(tuple(free), len(steps) if planned is None else planned)
    return Run(rounds, len(free), schedule, shortest, None, None, 2e-6)


def measured(run):
    return {name: measure.of(run) for name, measure in MEASURES.items()}


def test_each_measure_has_the_value_that_a_run_made_by_hand_has():
    # A failed round may be short without being good.
    steps = [120, 1000, 400, 150, 125] + [110] * 25
    paths = [0, 1, 2, 3, 4, 5, 5] + [6] * 23
    run = made(
        steps, failed=[0], paths=paths, known_ineffective=3, updates=10, ineffective_updates=2,
        mappings=70, effective_count=40,
    )  # fmt: skip
    assert measured(run) == {
        "first_arrival": 1120,
        "within_1_5": 1670,
        "within_1_25": 1795,
        "last_ratio": 1.1,
        "settled_ratio": 1.1,
        "settled_round": 8,
        "failed_share": pytest.approx(1 / 30),
        "touching_share": pytest.approx(0.1),
        "learning_waste": 90 / 4545,
        "computing_waste": 0.2,
        "mappings": 40,
        "steps": 4545,
        "run_ns_a_step": pytest.approx(2000 / 4545),
    }


def test_free_learning_counts_before_the_rounds_and_may_arrive_first():
    run = made([110] * 20, free=(9_000, 11_000))
    assert measures.first_arrival(run) == 20_110
    assert MEASURES["within_1_25"].of(run) == 20_110
    run.rounds["first_arrival"][1] = 234
    assert measures.first_arrival(run) == 9_234
    assert measures.settled_round(run) == math.inf  # no two rounds alike
    run.paths["path"] = 7
    assert measures.settled_round(run) == 1  # rounds of path learning are counted


def test_what_a_run_never_reached_is_infinite():
    values = measured(made([10_000] * 20, failed=range(20), paths=[0] * 20, planned=600))
    never = ("first_arrival", "within_1_5", "within_1_25", "last_ratio", "settled_round")
    assert {values[name] for name in (*never, "settled_ratio")} == {math.inf}
    assert values["failed_share"] == 1


def test_a_run_has_settled_only_if_at_least_20_last_rounds_arrive_alike():
    same = [7] * 30
    assert measures.settled_round(made([110] * 30, paths=same)) == 1
    assert measures.settled_round(made([110] * 30, paths=same, failed=[9])) == 11
    assert measures.settled_round(made([110] * 30, paths=same, failed=[10])) == math.inf
    assert measures.settled_round(made([110] * 30, paths=[*same[1:], 8])) == math.inf
    assert measures.settled_round(made([110] * 30, paths=same, planned=31)) == math.inf


def test_half_of_the_last_rounds_failed_or_left_out_is_no_last_path():
    assert measures.last_ratio(made([110] * 20, failed=range(9))) == 1.1
    assert measures.last_ratio(made([110] * 20, failed=range(11))) == math.inf
    assert measures.last_ratio(made([110] * 30, planned=39)) == 1.1
    assert measures.last_ratio(made([110] * 30, planned=41)) == math.inf


def test_an_agent_without_lists_updates_at_every_step_and_keeps_what_it_tried():
    run = made([100] * 4, ineffective=25, mappings=[5, 6, 7, 8])
    assert measures.computing_waste(run) == 0.25
    assert measures.mappings(run) == 8


def test_what_has_no_value_is_none():
    values = measured(made([110] * 20, shortest=None))
    of_shortest = ("within_1_5", "within_1_25", "last_ratio", "settled_ratio")
    assert [values[name] for name in of_shortest] == [None] * 4
    nothing = measured(made([]))
    kinds = ("failed_share", "touching_share", "learning_waste", "computing_waste", "mappings")
    assert [nothing[name] for name in (*kinds, "run_ns_a_step")] == [None] * 6
    assert nothing["steps"] == 0


@pytest.mark.parametrize("agent", [*contenders.NAMES])
def test_every_agent_is_measured_alike_with_a_record_or_without(agent):
    world = World.load("empty")
    plan = Schedule((200,), 25, 300)
    runs = [
        job.run_of(contenders.trial_of(agent, {}, {}, world, 5), plan, record=record)
        for record in (False, True)
    ]
    values = [{n: v for n, v in measured(run).items() if n[:4] != "run_"} for run in runs]
    assert values[0] == values[1]
    assert Tally.of(runs[1].record).rounds.tobytes() == runs[0].rounds.tobytes()
    assert all(v is None or v >= 0 for v in values[0].values())


def test_names_say_what_differs_from_machine_to_machine():
    asked = {"worlds": ["empty"], "agents": ["paper"], "seeds": "1", "free": [], "rounds": 3}
    [one] = spec.read(asked).jobs()
    rows = [job.execute(one) for _ in range(2)]
    same = [{n: v for n, v in row.measures.items() if not n.startswith("run_")} for row in rows]
    assert same[0] == same[1]
    assert set(MEASURES) - set(same[0]) == {"run_ns_a_step"}
