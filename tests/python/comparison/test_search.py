"""The search of settings: the same for each agent, and what it writes."""

import json

import pytest
from conftest import refused
from devlearn import Results
from devlearn.comparison import search
from devlearn.experiments import spec
from devlearn.experiments.contenders import config_of
from devlearn.experiments.schedule import Schedule

SMALL = {"worlds": ["empty"], "seeds": "1", "tries": 2, "rounds": 3, "workers": 1}


def test_as_many_different_settings_of_each_agent_are_tried_and_all_are_taken():
    for agent in search.SEARCHED:
        tried = search.drawn(agent)
        assert len({json.dumps(settings, sort_keys=True) for settings in tried}) == len(tried) == 12
        for settings in tried:
            config_of(agent, settings, {})


def test_the_defaults_are_among_what_is_tried():
    for agent in search.SEARCHED:
        assert search.drawn(agent)[0] in ({}, {"trace_decay": 0.9})


def test_a_round_that_failed_or_was_left_out_costs_as_much_as_the_limit():
    def cost(steps, arrived, rounds):
        return search.cost(steps, arrived, Schedule((), rounds, 1000), 100)

    assert cost([150, 250], [True, True], 2) == 2
    assert cost([150, 30], [True, False], 2) == (150 + 1000) / 200
    assert cost([150], [True], 3) == (150 + 2000) / 300


def test_the_settings_of_the_least_cost_are_written_as_a_sweep_s_file_takes_them(tmp_path):
    found = search.search(tmp_path, **SMALL, say=lambda _: None)
    text = (tmp_path / "settings.toml").read_text()
    head = 'worlds = ["empty"]\nseeds = "1"\nagents = ' + json.dumps([*search.SEARCHED])
    (tmp_path / "whole.toml").write_text(f"{head}\n{text}")
    read = spec.read(tmp_path / "whole.toml")
    assert {one.agent: one.settings for one in read.variants} == {
        agent: dict(one.settings) for agent, one in found.items()
    }
    results = Results(tmp_path / "search.sqlite")
    assert len(results) == 2 * len(search.SEARCHED)
    for agent, one in found.items():
        costs = []
        frame = results.to_pandas()
        for row in frame[frame["agent"] == agent].itertuples():
            rounds = results.rounds(row.run)
            steps = [s if a else 10_000 for s, a in zip(rounds["steps"], rounds["arrived"])]
            costs.append(sum(steps) / (3 * row.shortest))
        assert one.cost == pytest.approx(min(costs))


def test_a_search_in_no_world_is_refused(tmp_path):
    refused(lambda: search.search(tmp_path, **{**SMALL, "worlds": []}), "spec", "0 runs")
