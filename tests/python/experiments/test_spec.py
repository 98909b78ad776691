"""What a sweep may say, and what each of its runs then is."""

import json
from pathlib import Path

import devlearn
import jsonschema
import pytest
from conftest import refused
from devlearn import World
from devlearn.experiments import spec
from devlearn.experiments.contenders import config_of
from devlearn.experiments.schedule import Schedule

LEAST = {"worlds": ["paper"], "agents": ["paper"], "seeds": "1"}
SCHEMA = json.loads((Path(devlearn.__file__).parent / "sweep.schema.json").read_text())


def jobs(**more):
    return [*spec.read({**LEAST, **more}).jobs()]


def test_a_sweep_is_every_world_with_every_agent_under_every_seed():
    made = jobs(worlds=["paper", "empty"], agents=["paper", "QLearning"], seeds="1-3")
    assert {(j.world, j.agent, j.seed) for j in made} == {
        (world, agent, seed)
        for world in ("paper", "empty")
        for agent in ("paper", "QLearning")
        for seed in (1, 2, 3)
    }
    assert len(made) == 12


def test_seeds_come_one_after_the_other_so_that_a_part_is_a_smaller_sweep():
    assert [j.seed for j in jobs(worlds=["paper", "empty"], seeds="4-5")] == [4, 4, 5, 5]


@pytest.mark.parametrize(
    ("given", "meant"),
    [("7", [7]), ("1-3", [1, 2, 3]), (" 1 - 2 , 9", [1, 2, 9]), ([5, 0], [5, 0])],
)
def test_seeds_are_spans_or_a_list(given, meant):
    assert spec.read({**LEAST, "seeds": given}).seeds == meant


def test_random_worlds_come_by_kind_and_seed_and_files_from_the_folder_of_the_spec(tmp_path):
    World.load("empty").save(tmp_path / "mine.json")
    (tmp_path / "sweep.toml").write_text(
        'worlds = ["similar:10-11", "traps:3", "mine.json"]\nagents = ["paper"]\nseeds = "1"\n'
    )
    worlds = spec.read(tmp_path / "sweep.toml").worlds
    assert list(worlds) == ["similar:10", "similar:11", "traps:3", "mine.json"]
    assert worlds["similar:11"] == World.random("similar", 11).to_json()
    assert worlds["mine.json"] == World.load("empty").to_json()


def test_a_list_of_settings_is_a_choice_and_choices_multiply():
    made = jobs(settings={"paper": {"sigma": [0.1, 0.3], "eta": [0.1, 0.2], "c1": 3.0}})
    assert [(j.settings["sigma"], j.settings["eta"], j.settings["c1"]) for j in made] == [
        (0.1, 0.1, 3.0),
        (0.1, 0.2, 3.0),
        (0.3, 0.1, 3.0),
        (0.3, 0.2, 3.0),
    ]
    assert made[0].label == "paper sigma=0.1 eta=0.1 c1=3.0"


def test_fields_of_the_trial_are_for_all_agents_and_dotted_names_may_be_tables():
    made = jobs(agents=["paper", "QLearning"], trial={"robot": {"speed": 0.1}, "cell_size": [0.5]})
    assert [j.trial for j in made] == [{"robot.speed": 0.1, "cell_size": 0.5}] * 2


def test_a_robot_with_other_motions_has_learners_of_as_many():
    angles = [-20.0, 0.0, 20.0]
    for one in jobs(agents=["paper", "adaptive", "QLearning"],
                    trial={"robot.steering_angles": [angles]}):  # fmt: skip
        config = config_of(one.agent, one.settings, one.trial)
        assert config.robot.steering_angles == angles
        assert config.learner.motion_count == 3


def test_an_agent_may_have_a_schedule_of_its_own():
    made = jobs(
        agents=["paper", "RandomAgent"],
        rounds=50,
        settings={"RandomAgent": {"rounds": 5}, "paper": {"free": [[], [9]]}},
    )
    assert [j.schedule for j in made] == [
        Schedule((), 50),
        Schedule((9,), 50),
        Schedule((10_000, 10_000), 5),
    ]
    assert [j.settings for j in made] == [{}, {}, {}]
    assert [j.label for j in made] == ["paper free=[]", "paper free=[9]", "RandomAgent rounds=5"]


@pytest.mark.parametrize(
    ("changes", "quantity", "says"),
    [
        ({"wrlds": []}, "key", "'worlds', or another of worlds, agents"),
        ({"worlds": "paper"}, "worlds", "a list of names"),
        ({"worlds": ["papr"]}, "worlds", "'paper', or another of"),
        ({"worlds": ["missing.json"]}, "missing.json", "no such file"),
        ({"worlds": ["similar:9-3"]}, "worlds", "FIRST no more than LAST"),
        ({"worlds": ["similar:1-99999999"]}, "worlds", "at most 10000000"),
        ({"worlds": ["simlar:1"]}, "kind", "similar"),
        ({"worlds": ["paper", "paper"]}, "worlds", "each once"),
        ({"worlds": []}, "spec", "0 runs"),
        ({"agents": ["Qlearning"]}, "agent", "'QLearning', or another of"),
        ({"agents": ["nowhere:Agent"]}, "agent", "No module named 'nowhere'"),
        ({"agents": ["json:nothing"]}, "agent", "has no attribute 'nothing'"),
        ({"agents": [3]}, "agents", "a list of names"),
        ({"seeds": "9-1"}, "seeds", "least first"),
        ({"seeds": "1-99999999"}, "seeds", "at most 10000000"),
        ({"seeds": "1-"}, "seeds", "such as"),
        ({"seeds": 10}, "seeds", "such as"),
        ({"seeds": [1, 1]}, "seeds", "1 twice"),
        ({"seeds": [-1]}, "seeds", "whole numbers"),
        ({"seeds": [True]}, "seeds", "whole numbers"),
        ({"rounds": -1}, "Schedule.rounds", "a whole number in"),
        ({"free": 5}, "Schedule.free", "a list of whole numbers"),
        ({"keep": "all"}, "keep", "'nothing' or 'rounds' or 'record'"),
        ({"measures": ["first_arrival"]}, "measures", "devlearn's own are always measured"),
        ({"measures": ["json:dumps", "json:Dumps"]}, "measures", "each once"),
        ({"worlds": ["w" * 5000]}, "worlds", "one of"),
        ({"measures": ["json:none"]}, "measures", "has no attribute"),
        ({"trial": {"cellsize": 1}}, "trial", "'cell_size', or another of"),
        ({"trial": {"cell_size": "x"}}, "trial.cell_size", "[0.001, 1000] m"),
        ({"trial": {"learner.sigma": 0.1}}, "trial", "a setting of paper in place of it"),
        ({"trial": {"cell_size": []}}, "cell_size", "a value, or a list of alternatives"),
        ({"settings": {"QLearning": {}}}, "settings", "one of paper"),
        ({"settings": {"paper": {"sgma": 0.1}}}, "settings.paper", "'sigma', or another of"),
        ({"settings": {"paper": {"sigma": 7}}}, "LearnerConfig.sigma", "in (0, 1)"),
        ({"settings": {"paper": {"sigma": True}}}, "settings.paper.sigma", "in (0, 1)"),
        ({"settings": {"paper": {"free": [1, 2]}}}, "Schedule.free", "a list of whole numbers"),
        ({"settings": []}, "settings", "a table of tables"),
        ({"settings": {"paper": {"sigma": {1, 2}}}}, "spec", "JSON"),
        ({"settings": {"paper": {"sigma": "\udc80"}}}, "spec", "JSON"),
    ],
)
def test_what_a_sweep_cannot_mean_is_refused_by_name(changes, quantity, says):
    error = refused(lambda: spec.read({**LEAST, **changes}))
    assert quantity in f"{error.quantity} {getattr(error, 'file', '')}"
    assert says in str(error)


@pytest.mark.parametrize("key", ["worlds", "agents", "seeds"])
def test_what_a_sweep_needs_is_asked_for(key):
    assert "nothing" in str(
        refused(lambda: spec.read({k: LEAST[k] for k in LEAST if k != key}), key)
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [("worlds = [", "unreadable"), ('worlds = ["paper"]\nagents = ["papr"]\nseeds = "1"', "papr")],
)
def test_a_file_that_is_wrong_is_refused_by_its_name(tmp_path, text, says):
    file = tmp_path / "sweep.toml"
    file.write_text(text)
    with pytest.raises(devlearn.FileError, match=says) as caught:
        spec.read(file)
    assert caught.value.file == str(file)
    with pytest.raises(devlearn.FileError, match="No such file"):
        spec.read(tmp_path / "none.toml")


FULL = {
    "worlds": ["paper", "similar:1-2"], "agents": ["paper", "QLearning"], "seeds": [1, 2],
    "free": [], "rounds": 5, "step_limit": 9, "hopeless": 0, "measures": [], "keep": "rounds",
    "trial": {"cell_size": [0.25, 0.5]}, "settings": {"paper": {"sigma": [0.1]}},
}  # fmt: skip


def test_the_schema_that_ships_takes_what_is_read_and_knows_every_key():
    for good in (LEAST, FULL):
        jsonschema.validate(good, SCHEMA)
        spec.read(good)
    assert set(FULL) == set(SCHEMA["properties"]) == set(spec.KEYS)
    for key, value in {"seeds": "x", "keep": "all", "worlds": [], "rounds": -1, "more": 1}.items():
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**FULL, key: value}, SCHEMA)
        refused(lambda bad={**FULL, key: value}: spec.read(bad))
    defaults = {k: v["default"] for k, v in SCHEMA["properties"].items() if "default" in v}
    assert spec.read({**LEAST, **defaults}).variants == spec.read(LEAST).variants


def test_a_class_of_one_s_own_is_called_with_its_seed_and_its_settings(tmp_path, monkeypatch):
    (tmp_path / "mine.py").write_text(
        "class Mine:\n    def __init__(self, seed, pace=1): pass\n"
        "    def choose(self, observation): return 0\n    def observe(self, outcome): pass\n"
    )
    monkeypatch.chdir(tmp_path)
    [job] = jobs(agents=["mine:Mine"], settings={"mine:Mine": {"pace": 3}})
    assert job.settings == {"pace": 3}
    error = refused(
        lambda: jobs(agents=["mine:Mine"], settings={"mine:Mine": {"pase": 3}}),
        "settings.mine:Mine",
    )
    assert "pase" in str(error)
