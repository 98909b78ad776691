"""Each setting alone away from its default."""

import dataclasses
import json

import numpy as np
import pytest
from devlearn import FileError, Results, sweep
from devlearn.comparison import ablations
from devlearn.comparison.compare import compare
from devlearn.comparison.compared import Compared
from devlearn.experiments import statistics

SMALL = """
worlds = ["empty"]
agents = ["paper", "step5"]
seeds = "1-3"
free = []
rounds = 22
keep = "rounds"
[alone.paper]
sigma = [0.1, 0.9]
trial.cell_size = [0.5]
"""


def read(tmp_path, text):
    file = tmp_path / "ablations.toml"
    file.write_text(text)
    return ablations.read(file)


def test_every_agent_differs_from_the_defaults_in_one_setting(tmp_path):
    chosen = [(one.agent, one.settings, one.trial) for one in read(tmp_path, SMALL).variants]
    assert chosen == [
        ("paper", {}, {}),
        ("step5", {}, {}),
        ("paper", {"sigma": 0.1}, {}),
        ("paper", {"sigma": 0.9}, {}),
        ("paper", {}, {"cell_size": 0.5}),
    ]


def test_what_ships_changes_every_setting_of_the_paper_s_learner_and_of_the_grid():
    shipped = ablations.read()
    of_paper = [one for one in shipped.variants if one.agent == "paper"]
    assert {name for one in of_paper for name in one.settings} == {
        "sigma", "eta", "c1", "c2", "on_negative", "when_exhausted",
    }  # fmt: skip
    for agent in ("paper", "adaptive"):
        trials = [one.trial for one in shipped.variants if one.agent == agent and one.trial]
        assert trials and all(set(trial) == {"cell_size"} for trial in trials)
    for one in shipped.variants:
        assert len(one.settings) + len(one.trial) <= 1
    changed = {n for one in shipped.variants if one.agent == "adaptive" for n in one.settings}
    assert {"refine", "recollections", "gain", "patience", "hold_limit", "optimism"} <= changed


def test_effects_are_paired_with_the_defaults(tmp_path):
    results = sweep(read(tmp_path, SMALL), tmp_path / "r.sqlite", workers=1)
    [found] = ablations.effects(Compared(results))
    rows = dict(found.table.rows)
    assert [*rows] == ["defaults", "preset step5", "sigma 0.1", "sigma 0.9", "cell_size 0.5"]
    frame = results.to_pandas().set_index(["label", "seed"])["last_ratio"]
    ours, default = frame["paper sigma=0.9"], frame["paper"]
    better = np.mean([(a < b) + (a == b) / 2 for a, b in zip(ours, default)])
    share = statistics.estimate_share(3 * better, 3)
    last, against = rows["sigma 0.9"][:2]
    assert last.text == f"{statistics.interquartile_mean(np.array(ours)[:, None]):.2f}"
    assert against.text == f"{100 * better:.1f} %"
    assert against.spread == f"{100 * share.low:.1f} % to {100 * share.high:.1f} %"
    assert rows["defaults"][1].text == ""
    assert len(found.pictures) == 2


def test_they_stay_in_the_page_once_they_were_run(tmp_path, monkeypatch):
    small = dataclasses.replace(read(tmp_path, SMALL), seeds=[1])
    monkeypatch.setattr(ablations, "read", lambda: small)
    file = tmp_path / "sweep.toml"
    file.write_text(SMALL.partition("[alone")[0])
    how = {"seeds": "1", "maps": 0, "workers": 1, "say": lambda _: None}
    assert "Ablations" not in compare(file, tmp_path, **how).read_text()
    page = compare(file, tmp_path, ablations=True, **how).read_text()
    assert "<h2>Ablations</h2>" in page and "cell_size 0.5" in page
    assert len(Results(tmp_path / "ablations.sqlite")) == len(small)
    assert compare(file, tmp_path, **how).read_text() == page


@pytest.mark.parametrize(
    ("alone", "quantity"),
    [("[alone.paper]\nsigmas = [0.1]", "settings.paper"), ("alone = 3", "alone"),
     ("[alone]\npaper = 3", "alone.paper"), ("[alone.Nobody]\nx = [1]", "agent"),
     ("[alone.paper]\ntrial.cell_sizes = [1]", "trial")],
)  # fmt: skip
def test_what_cannot_be_set_is_refused_with_the_file(tmp_path, alone, quantity):
    text = SMALL.partition("[alone")[0]
    with pytest.raises(FileError, match=f"ablations.toml: {quantity}"):
        read(tmp_path, f"{text}\n{alone}\n")


def test_the_defaults_in_json_are_those_of_the_results(tmp_path):
    asked = read(tmp_path, SMALL)
    results = sweep(dataclasses.replace(asked, seeds=[1]), tmp_path / "r.sqlite", workers=1)
    assert json.loads(results.meta["spec"])["alone"]["paper"]["sigma"] == [0.1, 0.9]
