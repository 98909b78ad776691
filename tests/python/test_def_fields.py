"""What a field of a configuration, and a column of a record, is: told once, seen everywhere."""

import copy
import inspect
import json
import pickle
import re
from decimal import Decimal
from pathlib import Path

import devlearn
import numpy as np
import pytest
from devlearn import (
    AdaptiveConfig,
    BatchConfig,
    LearnerConfig,
    NoiseDef,
    Record,
    RobotDef,
    StateEvaluation,
    TrialConfig,
    _core,
    agents,
    tasks,
)
from devlearn.record import POSE_COLUMNS, STEP_COLUMNS

SOURCE = Path(__file__).parents[2]
CONFIGS = [
    LearnerConfig, AdaptiveConfig, StateEvaluation, RobotDef, TrialConfig, agents.QLearning.Config,
    agents.ExpectedSarsa.Config, agents.SarsaLambda.Config, agents.DynaQ.Config,
    agents.PrioritizedSweeping.Config, agents.LrtaStar.Config, agents.RMax.Config,
    agents.SalientEvents.Config, tasks.Playroom.Config,
    agents.OperantConditioning.Config, agents.Appraisal.Config, tasks.Foraging.Config,
    tasks.Balance.Config, tasks.TwoWheeledDef,
    BatchConfig, agents.Iac.Config, tasks.Attention.Config,
]  # fmt: skip
each_config = pytest.mark.parametrize("kind", CONFIGS)
NO, WHOLE = "", "a whole number in [{}, {}]"

FIRST_VALUES = {
    "first_value": ("", NO, "'constant' or 'estimate'", "estimate"),
    "initial_value": (NO, NO, "in [-1e+09, 1e+09]", 0.0),
}
# As Sutton & Barto have them.
VALUES = {
    "alpha": ("alpha", NO, "in (0, 1]", 0.5),
    "gamma": ("gamma", NO, "in [0, 1]", 1.0),
    "epsilon": ("epsilon", NO, "in [0, 1]", 0.1),
    "first_value": ("Q_0", NO, "'constant' or 'estimate'", "constant"),
    "initial_value": (NO, NO, "in [-1e+09, 1e+09]", 0.0),
    "shaping": ("Phi", NO, "'none' or 'sef' or 'estimate'", "none"),
}

# As the method and the guides have them: symbol, unit, range, default.
EXPECTED = {
    LearnerConfig: {
        "motion_count": ("N_M", NO, WHOLE.format(1, 65535), 5),
        "eta": ("eta", NO, "in (0, 1)", 0.05),
        "sigma": ("sigma", NO, "in (0, 1)", 0.3),
        "c1": ("c_1", NO, "in [0, 1e+06]", 0.5),
        "c2": ("c_2", NO, "in [-1e+06, 1e+06]", 1.0),
        "on_negative": (NO, NO, "'abandon' or 'weaken'", "abandon"),
        "when_exhausted": (NO, NO, "'retry' or 'wander'", "retry"),
    },
    AdaptiveConfig: {
        "motion_count": ("N_M", NO, WHOLE.format(1, 65535), 5),
        "optimism": ("w", NO, "in [1, 10]", 1.1),
        "hold_limit": (NO, NO, WHOLE.format(1, 1_000_000), 20),
        "recollections": (NO, NO, WHOLE.format(0, 1_000_000), 20),
        "patience": (NO, NO, WHOLE.format(0, 1_000_000), 10),
        "gain": (NO, NO, "in [0, 1e+06]", 0.5),
        "tolerance": (NO, NO, "in [0, 1e+06]", 0.0),
        "detour": (NO, NO, "in [0, 1e+09]", 20.0),
        "enough": (NO, NO, "in [1, 1e+09]", 3.0),
        "refine": (NO, NO, "true or false", True),
        "curious_every": (NO, NO, WHOLE.format(0, 1_000_000), 0),
        "stale_after": (NO, NO, WHOLE.format(1, 1_000_000_000), 100),
        "sweep_limit": (NO, NO, WHOLE.format(0, 2**31 - 1), 0),
    },
    StateEvaluation: {
        "a1": ("a_1", NO, "in [-1e+06, 1e+06]", 20.0),
        "a2": ("a_2", "1/m^2", "in [0, 1e+06] 1/m^2", 0.3),
        "a3": ("a_3", NO, "in [0, 1e+06]", 0.2),
        "a4": ("a_4", NO, "in [-100, 100]", 5.0),
        "a5": ("a_5", "1/m", "in [0, 1e+06] 1/m", 12.0),
    },
    RobotDef: {
        "radius": ("r", "m", "in [0.01, 10] m", 0.1),
        "speed": ("v", "m/s", "in (0, 10] m/s", 0.1),
        "sample_time": ("t_s", "s", "in (0, 10] s", 0.5),
        "track": (NO, "m", "in (0, 10] m, or none", None),
        "steering_angles": (
            "M",
            "degrees",
            "1 ... 65535 numbers, each in [-360, 360] degrees",
            [-60.0, -30.0, 0.0, 30.0, 60.0],
        ),
        "sonar_count": (NO, NO, WHOLE.format(0, 720), 5),
        "sonar_fov": (NO, "degrees", "in [0, 360] degrees", 180.0),
        "sonar_range": (NO, "m", "in [0.01, 100] m", 2.0),
        "sonar_beam": (NO, "degrees", "in [0, 90] degrees", 0.0),
        "sonar_rays": (NO, NO, WHOLE.format(2, 181), 5),
        "sonar_specular": (NO, "degrees", "in (0, 90] degrees", 90.0),
        "sonar_least_range": (NO, "m", "in [0, 100] m", 0.0),
        "sonar_blind_time": (NO, "s", "in [0, 1] s", 0.0),
        "safety_margin": (NO, "m", "in (0, 10] m, or none", None),
    },
    NoiseDef: {
        "turn": (NO, "degrees", "in [0, 90] degrees", 0.0),
        "drive": (NO, "m", "in [0, 1] m", 0.0),
        "slip": (NO, NO, "in [0, 1]", 0.0),
        "odometry_turn": (NO, "degrees", "in [0, 90] degrees", 0.0),
        "odometry_drive": (NO, NO, "in [0, 1]", 0.0),
        "echo": (NO, "m", "in [0, 10] m", 0.0),
        "bearing": (NO, "degrees", "in [0, 90] degrees", 0.0),
        "dropout": (NO, NO, "in [0, 1]", 0.0),
    },
    TrialConfig: {
        "learner": (NO, NO, "a LearnerConfig or AdaptiveConfig", LearnerConfig()),
        "evaluation": (NO, NO, "a StateEvaluation", StateEvaluation()),
        "robot": (NO, NO, "a RobotDef", RobotDef()),
        "clearance_source": (NO, NO, "'geometric' or 'sonar'", "geometric"),
        "walls_count": (NO, NO, "true or false", False),
        "goal_radius": (NO, "m", "in (0, 100] m", 0.1),
        "touch_cost": (NO, NO, "in [0, 1e+06]", 5.0),
        "cell_size": (NO, "m", "in [0.001, 1000] m", 0.25),
        "heading_bins": (NO, NO, WHOLE.format(1, 3600), 12),
        "noise": (NO, NO, "a NoiseDef", NoiseDef()),
    },
    agents.QLearning.Config: VALUES,
    agents.ExpectedSarsa.Config: VALUES,
    agents.SarsaLambda.Config: VALUES
    | {
        "trace_decay": ("lambda", NO, "in [0, 1]", 0.9),
        "traces": (NO, NO, "'accumulating' or 'replacing'", "accumulating"),
    },
    agents.DynaQ.Config: VALUES
    | {
        "planning_steps": ("n", NO, WHOLE.format(0, 1000000), 10),
        "kappa": ("kappa", NO, "in [0, 1e+06]", 0.0),
    },
    agents.PrioritizedSweeping.Config: VALUES
    | {
        "alpha": ("alpha", NO, "in (0, 1]", 1.0),
        "planning_steps": ("n", NO, WHOLE.format(0, 1000000), 10),
        "theta": ("theta", NO, "in [0, 1e+09]", 1e-4),
    },
    agents.LrtaStar.Config: FIRST_VALUES,
    agents.RMax.Config: {
        "m": ("m", NO, WHOLE.format(1, 1000), 3),
        "gamma": ("gamma", NO, "in [0, 1]", 1.0),
        **FIRST_VALUES,
        "theta": ("theta", NO, "in [1e-09, 1e+09]", 1e-6),
        "least_value": (NO, NO, "in [-1e+06, 0]", -1000.0),
    },
    agents.OperantConditioning.Config: {  # Narendra & Thathachar 1974
        "reward_step": ("a", NO, "in (0, 1)", 0.1),
        "penalty_step": ("b", NO, "in [0, 1)", 0.01),
        "reinforced_by": (NO, NO, "'smf' or 'reward'", "smf"),
    },
    agents.Appraisal.Config: {
        "novelty": ("phi_n", NO, "in [-1, 1]", 0.0),
        "motivation": ("phi_m", NO, "in [-1, 1]", 0.0),
        "control": ("phi_c", NO, "in [-1, 1]", -0.3),
        "valence": ("phi_v", NO, "in [-1, 1]", 0.0),
        "external": ("phi_e", NO, "in [-1, 1]", 0.7),
        "alpha": ("alpha", NO, "in (0, 1]", 0.3),
        "gamma": ("gamma", NO, "in [0, 1]", 0.9),
        "epsilon": ("epsilon", NO, "in [0, 1]", 1.0),
        "epsilon_decay": (NO, NO, "in [1, 2]", 1.0001),
        "novelty_decay": ("lambda", NO, "in [1, 2]", 1.001),
        "planning_steps": ("n", NO, WHOLE.format(0, 1000000), 10),
        "theta": ("theta", NO, "in [0, 1e+09]", 1e-4),
    },
    tasks.Foraging.Config: {
        "scenario": (
            NO,
            NO,
            "'moving_preys' or 'persistence' or 'prey_season' or 'poisoned_season' or "
            "'hunger_thirst' or 'lairs'",
            "moving_preys",
        ),
        "season": (NO, NO, WHOLE.format(1, 1000000000), 5000),
        "most_pushes": (NO, NO, WHOLE.format(0, 1000000), 30),
    },
    tasks.Balance.Config: {
        "robot": (NO, NO, "a TwoWheeledDef", tasks.TwoWheeledDef()),
        "torques": (
            "M",
            "N m",
            "1 ... 1000 numbers, each in [-1000, 1000] N m",
            [-0.04, -0.01, 0.0, 0.01, 0.04],
        ),
        "sample_time": ("t_s", "s", "in (0, 10] s", 0.02),
        "substep": (NO, "s", "in (0, 10] s", 0.01),
        "duration": (NO, "s", "in (0, 1e+06] s", 60.0),
        "angle_limit": (NO, "degrees", "in (0, 90] degrees", 15.0),
        "start_angle": (NO, "degrees", "in [0, 90] degrees", 2.0),
        "angle_edges": (
            NO,
            "degrees",
            "0 ... 100 numbers, each in [-90, 90] degrees",
            [-6.0, -3.0, -1.0, 1.0, 3.0, 6.0],
        ),
        "rate_edges": (
            NO,
            "degrees/s",
            "0 ... 100 numbers, each in [-1e+06, 1e+06] degrees/s",
            [-120.0, -60.0, -20.0, 20.0, 60.0, 120.0],
        ),
        "wheel_rate_edges": (
            NO,
            "degrees/s",
            "0 ... 100 numbers, each in [-1e+06, 1e+06] degrees/s",
            [-360.0, -120.0, 120.0, 360.0],
        ),
        "sef_scale": (NO, NO, "in (0, 1e+06]", 20.0),
        "sef_rate": ("T_1", "s", "in [0, 100] s", 0.07),
        "sef_wheel_rate": ("T_2", "s", "in [0, 100] s", 0.02),
        "fall_cost": (NO, NO, "in [0, 1e+06]", 100.0),
    },
    tasks.TwoWheeledDef: {  # NXTway-GS's, as in its param_plant.m
        "gravity": ("g", "m/s^2", "in (0, 100] m/s^2", 9.81),
        "wheel_mass": ("m", "kg", "in (0, 1000] kg", 0.03),
        "wheel_radius": ("R", "m", "in (0, 10] m", 0.04),
        "body_mass": ("M", "kg", "in (0, 1000] kg", 0.6),
        "body_height": ("H", "m", "in (0, 10] m", 0.144),
        "motor_inertia": ("J_m", "kg m^2", "in [0, 10] kg m^2", 1e-5),
        "gear_ratio": ("n", NO, "in (0, 1000]", 1.0),
        "motor_friction": ("f_m", "N m s", "in [0, 100] N m s", 0.0022),
        "floor_friction": ("f_w", "N m s", "in [0, 100] N m s", 0.0),
        "torque_constant": ("K_t", "N m/A", "in (0, 100] N m/A", 0.317),
        "back_emf": ("K_b", "V s", "in [0, 100] V s", 0.468),
        "resistance": ("R_m", "Ohm", "in (0, 1e+06] Ohm", 6.69),
        "battery": ("V", "V", "in (0, 1000] V", 8.0),
    },
    agents.Iac.Config: {
        "epsilon": ("epsilon", NO, "in [0, 1]", 0.35),
        "most_exemplars": ("T", NO, WHOLE.format(2, 100_000), 250),
        "smoothing": ("theta", NO, WHOLE.format(0, 10_000), 25),
        "window": ("tau", NO, WHOLE.format(1, 10_000), 15),
        "neighbours": ("k", NO, WHOLE.format(1, 1000), 1),
        "most_regions": (NO, NO, WHOLE.format(1, 1_000_000), 1000),
        "length": (NO, "m", "in [0.01, 1e+06] m", 5.0),
    },
    tasks.Attention.Config: {
        "speeds": (NO, NO, WHOLE.format(2, 21), 5),
        "frequencies": (NO, NO, WHOLE.format(3, 99), 9),
        "side": (NO, "m", "in [0.01, 1000] m", 1.0),
        "speed": (NO, "m", "in [0, 1000] m", 0.1),
        "axle": (NO, "m", "in [0.001, 1000] m", 0.2),
        "noise": (NO, "m", "in [0, 1000] m", 0.01),
        "steps": (NO, NO, WHOLE.format(1, 10**9), 5000),
    },
    agents.SalientEvents.Config: {
        "alpha": ("alpha", NO, "in (0, 1]", 0.1),
        "gamma": ("gamma", NO, "in (0, 1]", 0.9),
        "epsilon": ("epsilon", NO, "in [0, 1]", 0.3),
        "tau": ("tau", NO, "in [0, 1e+06]", 0.5),
        "terminal_value": (NO, NO, "in [-1e+06, 1e+06]", 1.0),
        "endings": (NO, NO, WHOLE.format(1, 1000000), 32),
    },
    tasks.Playroom.Config: {
        "reward": ("r_e", NO, "in [-1e+06, 1e+06]", 1.0),
        "ending": (NO, NO, "true or false", True),
    },
    BatchConfig: {
        "reward": (NO, NO, "'shaped' or 'cost' or 'smf' or 'sparse'", "shaped"),
        "step_limit": (NO, NO, WHOLE.format(1, 2**40), 10_000),
        "autoreset": (NO, NO, "'next_step' or 'same_step' or 'disabled'", "next_step"),
        "sonars": (NO, NO, "true or false", False),
        "random_starts": (NO, NO, "true or false", False),
    },
}


@each_config
def test_each_field_is_what_the_method_says(kind):
    told = {
        name: (field["symbol"], field["unit"], field["range"], field["default"])
        for name, field in kind.fields().items()
    }
    assert told == EXPECTED[kind]
    assert all(field["doc"] for field in kind.fields().values())


@each_config
def test_every_field_is_an_argument_an_attribute_and_in_the_dict(kind):
    names = list(kind.fields())
    signature = re.match(r"__init__\(self: [\w.]+, (.*)\) -> None", kind.__init__.__doc__)[1]
    assert re.findall(r"(\w+): ", signature) == names
    assert list(kind().to_dict()) == names
    for name, field in kind.fields().items():
        assert getattr(kind(), name) == field["default"]
        assert kind(**{name: field["default"]}) == kind()
        with pytest.raises(AttributeError):
            setattr(kind(), name, field["default"])
    assert kind(*(field["default"] for field in kind.fields().values())) == kind()


def other(value):
    """Another value near this one that a field with it may have."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    if isinstance(value, list):
        return [1.5 * each for each in value]
    if isinstance(value, str):
        names = {
            "abandon": "weaken", "retry": "wander", "geometric": "sonar", "constant": "estimate",
            "estimate": "constant", "none": "sef", "accumulating": "replacing", "shaped": "cost",
            "next_step": "same_step", "smf": "reward", "moving_preys": "lairs",
        }  # fmt: skip
        return names[value]
    if hasattr(value, "fields"):
        changes = {name: other(field["default"]) for name, field in value.fields().items()}
        changes.pop("motion_count", None)  # is the number of steering angles
        return type(value)(**changes)
    if value is None:
        return 0.15
    return 1.5 * value if 1 < value < 50 else 0.5 * value or 0.5


@each_config
def test_every_field_is_compared_replaced_and_survives_dict_json_repr_pickle_and_copy(kind):
    for name, field in kind.fields().items():
        value = other(field["default"])
        fields = {name: value} | ({"walls_count": True} if value == "sonar" else {})
        changed = kind(**fields)
        assert changed != kind()
        assert getattr(changed, name) == value
        for again in (
            kind().replace(**fields),
            kind.from_dict(fields),
            kind.from_dict(json.loads(json.dumps(changed.to_dict()))),
            eval(repr(changed), {**vars(devlearn), **vars(agents), **vars(tasks)}),
            pickle.loads(pickle.dumps(changed)),
            copy.deepcopy(changed),
        ):
            assert again == changed
            assert hash(again) == hash(changed)


@each_config
def test_help_says_of_every_field_what_it_is_its_unit_and_its_range(kind):
    stub = (SOURCE / "python/devlearn/_core.pyi").read_text(encoding="utf-8")
    whole = " ".join(kind.__doc__.split())
    for name, field in kind.fields().items():
        doc = " ".join(getattr(kind, name).__doc__.split())
        assert doc.startswith(field["symbol"])
        assert doc.endswith(f"{field['doc'][1:]}; {field['range']}.")
        assert field["unit"] in doc
        assert f" {name} {doc}" in whole
        assert f"def {name}(self)" in stub
        assert field["range"] in stub


# --- columns -------------------------------------------------------------------------------------


def test_every_column_is_an_attribute_of_a_record_with_its_type_and_in_its_help():
    columns = STEP_COLUMNS | POSE_COLUMNS
    annotations = {n: a for n, a in Record.__annotations__.items() if n[0] != "_"}
    for name in ("rounds", "echoes", "learner"):
        annotations.pop(name)
    assert list(annotations) == list(columns)
    for name, dtype in columns.items():
        assert annotations[name].replace("bool_", "bool") == f"npt.NDArray[np.{dtype}]"
        assert f"``{name}``" in Record.__doc__
    assert inspect.getdoc(Record).startswith("What happened in a trial")


def test_a_step_has_every_column_of_a_step_and_says_what_it_is():
    step = devlearn.Trial(devlearn.World()).step()
    for name, (_, doc) in _core.step_columns.items():
        assert hasattr(step, name)
        assert getattr(devlearn.Step, name).__doc__ == doc[0].upper() + doc[1:] + "."


@pytest.mark.parametrize("value", [2.7, np.float32(2.7), np.array(2.7), Decimal("2.7"), None, "3"])
def test_no_whole_number_is_cut_to_fit(value):
    for call in (
        lambda: RobotDef(sonar_count=value),
        lambda: LearnerConfig(motion_count=value),
        lambda: TrialConfig(heading_bins=value),
        lambda: devlearn.RandomAgent(seed=value),
    ):
        with pytest.raises((devlearn.InvalidValue, TypeError)):
            call()


@pytest.mark.parametrize("value", [1, 0.0, float("nan"), None, "yes", []])
def test_only_true_and_false_are_truths(value):
    with pytest.raises(TypeError):
        TrialConfig(walls_count=value)
    assert TrialConfig(walls_count=np.bool_(True)).walls_count is True
