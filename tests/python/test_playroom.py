"""The playroom, and the agent that finds skills in it. Their laws are tested in C++."""

import pickle

import pytest
from conftest import refused
from devlearn import InvalidValue, Trial, World, agents, tasks


def room(**settings):
    return tasks.Playroom(tasks.Playroom.Config(**settings))


def test_the_room_tells_where_everything_is_and_what_happened():
    task = room(ending=False)
    assert (len(task.MOTIONS), len(task.EVENTS), len(task.OBJECTS)) == (15, 6, 6)
    task.begin(seed=3)
    while task.squares["eye"] != task.squares["switch"]:
        task.step(task.MOTIONS.index("eye_to_random_object"))
    task.step(task.MOTIONS.index("hand_to_eye"))
    outcome = task.step(task.MOTIONS.index("flick_switch"))
    assert outcome.event == task.EVENTS.index("light_on")
    assert (task.light, task.music) == (True, False)
    assert task.counts == {name: int(name == "light_on") for name in task.EVENTS}
    refused(lambda: task.step(task.MOTIONS.index("kick_ball")), "motion")
    assert repr(task).startswith("<devlearn.tasks.Playroom: PlayroomConfig(")


def test_skills_are_explained_and_an_explanation_is_a_value():
    task, agent = room(reward=0.0, ending=False), agents.SalientEvents(seed=1)
    assert agent.explain(0) is None
    assert agent.events == []
    tasks.run(task, agent, 2, step_limit=20_000)
    assert {task.EVENTS[event] for event in agent.events} >= {"light_on", "light_off"}
    task.begin(seed=9)
    agent.begin_round()
    seen = task.observation()
    agent.choose(seen)
    why = agent.explain(seen.situation)
    assert [view.event for view in why.options] == agent.events
    assert all(0.0 <= view.probability <= 1.0 for view in why.options)
    assert [*why.allowed] == [*seen.allowed]
    assert why.value == [agent.value(seen.situation, motion) for motion in range(15)]
    assert str(why).startswith(f"situation {seen.situation}: ")
    assert repr(why).startswith("<devlearn.SalientEventsExplanation: situation ")
    assert repr(why.options[0]).startswith("<devlearn.OptionView: event ")
    assert pickle.loads(pickle.dumps(why)) == why
    refused(lambda: agent.explain(-1), "situation")


def test_a_run_in_pieces_goes_as_in_one_call_before_and_after_pickling():
    whole, parts = agents.SalientEvents(seed=2), agents.SalientEvents(seed=2)
    tasks.run(room(ending=False), whole, 4, step_limit=3000)
    tasks.run(room(ending=False), parts, 2, step_limit=3000)
    parts = pickle.loads(pickle.dumps(parts))
    tasks.run(room(ending=False), parts, 2, first=2, step_limit=3000)
    assert pickle.dumps(whole) == pickle.dumps(parts)


def test_in_a_trial_arrivals_and_touches_are_its_events():
    agent = agents.SalientEvents(agents.SalientEvents.Config(epsilon=1.0), seed=1)
    Trial(World.load("empty"), agent=agent).path_learning(rounds=3, step_limit=20_000)
    assert sorted(agent.events) == [0, 1]


def test_settings_are_refused_beyond_their_ranges():
    with pytest.raises(InvalidValue, match=r"SalientEventsConfig\.tau: got -1"):
        agents.SalientEvents.Config(tau=-1.0)
    with pytest.raises(InvalidValue, match=r"PlayroomConfig\.ending"):
        tasks.Playroom.Config(ending=3)
