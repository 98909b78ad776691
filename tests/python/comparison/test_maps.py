"""Maps: from every start, with a fresh copy of what was learned."""

import copy
import json
import math
import pickle

import numpy as np
from devlearn import Robot, Trial, TrialConfig, World, shortest_path
from devlearn.comparison import maps
from devlearn.experiments.contenders import trial_of
from devlearn.experiments.job import run_of
from devlearn.experiments.schedule import Schedule

COARSE = {"cell_size": 0.5}
SHORT = Schedule((500,), 5, 500)


def run(agent, settings=None, world="paper", trial=COARSE):
    return run_of(trial_of(agent, settings or {}, trial, World.load(world), 1), SHORT)


def test_each_start_is_tried_by_a_fresh_copy_of_what_was_learned():
    made = run("paper")
    before = copy.deepcopy(made.trial.learner)
    found = maps.reach(made)
    assert pickle.dumps(made.trial.learner) == pickle.dumps(before)
    grid = made.trial.grid
    tried = [i for i, least in enumerate(found["shortest"]) if least is not None]
    assert len(tried) > 500
    for i in tried[::97]:
        world = made.trial.world.with_start(grid.centre(i))
        trial = Trial(world, made.trial.config, 1, copy.deepcopy(before))
        record = trial.path_learning(1, 5 * found["shortest"][i])
        assert found["steps"][i] == (len(record) if record.rounds["arrived"][0] else None)


def test_a_map_is_the_same_each_time_and_json_can_hold_it():
    made = run("QLearning", {"first_value": "estimate"})
    assert json.loads(json.dumps(maps.reach(made))) == maps.reach(made)


def test_starts_are_where_the_body_fits_and_a_way_leads_from():
    made = run("RandomAgent", world="u_trap")
    world, grid = made.trial.world, made.trial.grid
    shortest = maps.reach(made)["shortest"]
    assert len(shortest) == grid.count
    for i in range(5, grid.count, 131):
        x, y, heading = grid.centre(i)
        if world.clearance(x, y, walls_count=True) <= 0.1:
            assert shortest[i] is None
        elif shortest[i] is not None:
            exact = shortest_path(Robot(world), (x, y, heading)).steps
            assert abs(shortest[i] - exact) <= 3


def test_an_agent_with_the_map_arrives_from_everywhere_on_the_shortest_ways():
    made = run("ShortestPathAgent", world="empty", trial={"cell_size": 1.0, "heading_bins": 4})
    found = maps.reach(made)
    steps = np.array([s for s in found["steps"] if s is not None])
    shortest = np.array([s for s in found["shortest"] if s is not None])
    assert len(steps) == len(shortest) > 60
    assert np.abs(steps - shortest).max() <= 2


def test_a_cell_s_value_is_the_median_of_its_headings_and_runs():
    trial = Trial(
        World(2, 1, (0.5, 0.5, 0), (1.5, 0.5)), TrialConfig(cell_size=1.0, heading_bins=4)
    )
    first = {
        "shortest": [10, 10, 10, 10, None, 20, None, None],
        "steps": [10, 12, None, 20, None, None, None, None],
    }
    other = {"shortest": first["shortest"], "steps": [11, 30, 40, None, None, 30, None, None]}
    found = maps.map_of([json.dumps(first), json.dumps(other)], trial)
    assert found.ratio.shape == (1, 2)
    # 1, 1.1, 1.2, 2, 3, 4, never, never; and never and 1.5, half of which do not arrive
    assert found.ratio.tolist() == [[2.5, math.inf]]
    assert found.arrived == [3 / 5, 4 / 5]


def test_a_cell_without_a_start_has_no_value():
    trial = Trial(
        World(2, 1, (0.5, 0.5, 0), (1.5, 0.5)), TrialConfig(cell_size=1.0, heading_bins=4)
    )
    none = {"shortest": [5] + [None] * 7, "steps": [5] + [None] * 7}
    ratio = maps.map_of([json.dumps(none)], trial).ratio
    assert ratio[0, 0] == 1 and math.isnan(ratio[0, 1])
