"""A record's learner, lived through once more."""

import devlearn
import pytest
from conftest import refused
from devlearn import AdaptiveLearner, Learner, Record, RobotDef, Trial, TrialConfig
from devlearn.analysis import Replay, first_learner, parts

CONFIGS = {
    "paper": TrialConfig(),
    "step5": TrialConfig.step5(),
    "adaptive": TrialConfig.adaptive(),
}


@pytest.mark.parametrize("before", [0, 300])
@pytest.mark.parametrize("config", CONFIGS.values(), ids=CONFIGS)
def test_at_the_end_of_its_record_it_is_the_trials_learner_to_the_bit(paper, config, before):
    trial = Trial(paper, config, seed=4)
    trial.free_learning(before)
    phases = [
        lambda: trial.free_learning(700, learner=True),
        lambda: trial.run(100),
        lambda: trial.path_learning(5, step_limit=900),
    ]
    record = phases[0]()
    halfway = trial.learner.to_bytes()
    record = Record.concatenate([record, *(phase() for phase in phases[1:])])
    replay = Replay(record)
    assert replay.to(700).to_bytes() == halfway
    replay.to(len(record))
    if isinstance(trial.learner, AdaptiveLearner) and not record.arrived[-1]:
        trial.learner.end_round(False)
        replay.learner.end_round(False)
    assert replay.learner.to_bytes() == trial.learner.to_bytes()


def test_parts_of_a_record_carry_the_learner_as_it_was_where_they_begin(paper):
    trial = Trial(paper, seed=4)
    first = trial.path_learning(3)
    then = trial.learner.to_bytes()
    whole = Record.concatenate([first, trial.path_learning(3)])
    both = list(parts(whole, slice(0, 3), slice(3, 6)))
    assert both[0].learner == Learner(seed=4).to_bytes()
    assert both[1].learner == then
    assert both[1].part(slice(0, 1)).learner == then
    assert both[1].part(slice(1, 2)).learner is None


def test_where_the_safety_layer_speaks_the_lists_are_the_same(paper):
    config = TrialConfig(robot=RobotDef(safety_margin=0.05))
    trial = Trial(paper, config, seed=4)
    record = trial.free_learning(1500)
    learner = Replay(record).to(len(record))
    for situation in trial.learner.situations():
        assert learner.situation(situation) == trial.learner.situation(situation)


def test_a_record_that_begins_later_and_carries_no_learner_is_refused(paper):
    trial = Trial(paper, seed=4)
    trial.free_learning(10)
    record = trial.free_learning(10)
    assert first_learner(record) is None
    refused(lambda: Replay(record), "record.learner")
    assert first_learner(Trial(paper, agent=devlearn.RandomAgent(5)).free_learning(10)) is None


def test_another_learner_than_the_one_recorded_is_noticed(paper):
    trial = Trial(paper, TrialConfig.adaptive(), seed=4)
    record = trial.free_learning(200)
    record.learner = AdaptiveLearner(seed=5).to_bytes()
    replay = Replay(record)
    refused(lambda: replay.to(200))
    refused(lambda: replay.to(201), "steps")
    agent = Learner(devlearn.LearnerConfig(eta=0.9, sigma=0.9, c1=5.0), seed=4)
    record = Trial(paper, agent=agent, seed=4).free_learning(4000)
    replay = Replay(record)
    refused(lambda: replay.to(4000))
    record.learner = b"none"
    with pytest.raises(devlearn.FileError):
        Replay(record)


def test_a_record_keeps_the_learner_that_it_carries(paper, tmp_path):
    trial = Trial(paper, seed=4)
    trial.free_learning(100)
    then = trial.learner.to_bytes()
    record = trial.free_learning(50, learner=True)
    assert record.learner == then
    record.save(tmp_path / "record.npz")
    again = Record.load(tmp_path / "record.npz")
    assert again.learner == then
    assert again == record
    assert Record.from_bytes(record.to_bytes()) == record
    assert Record.concatenate([record, trial.free_learning(5)]).learner == then
    columns = {name: record[name] for name in record}
    assert Record(columns, record.provenance) != record
    refused(lambda: Record(columns, record.provenance, "text"), "learner")
    agent = devlearn.RandomAgent(5)
    refused(lambda: Trial(paper, agent=agent).free_learning(1, learner=True), "learner")
