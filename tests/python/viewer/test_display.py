"""How things show themselves in notebooks: what Jupyter asks them for."""

import re
import subprocess
import sys
import time
from xml.etree import ElementTree

import devlearn
import numpy as np
import pytest
from devlearn.comparison.compared import Compared

SVG = "{http://www.w3.org/2000/svg}"
TENS_OF_KB = 64_000
# Markup, both quotes, controls, an escape sequence, a text turned around, and half a character.
HOSTILE = "<script>alert(1)</script>&amp;'\"\x00\x1b[31m\n\u202egnp.exe\x7f\x85"


def shown(thing):
    """The markup that a notebook would take, and its tree."""
    markup = thing._repr_svg_() if hasattr(thing, "_repr_svg_") else thing._repr_html_()
    tree = ElementTree.fromstring(f"<div>{markup}</div>")  # refuses what is no XML
    return markup, tree


def words(tree):
    return " ".join(text for text in tree.itertext() if text)


def paths(tree, **attributes):
    return [
        path.get("d")
        for path in tree.iter(f"{SVG}path")
        if all(path.get(name) == value for name, value in attributes.items())
    ]


@pytest.fixture(scope="module")
def trial():
    trial = devlearn.Trial(devlearn.World.load("paper"), seed=3)
    trial.free_learning(3000)
    return trial


@pytest.fixture(scope="module")
def adaptive():
    trial = devlearn.Trial(devlearn.World.load("paper"), devlearn.TrialConfig.adaptive(), seed=3)
    trial.path_learning(30)
    return trial


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    spec = {
        "worlds": ["empty", "corridor"], "agents": ["adaptive", "RandomAgent"], "seeds": "1-3",
        "rounds": 3, "step_limit": 300,
    }  # fmt: skip
    path = tmp_path_factory.mktemp("sweep") / "<b>&.sqlite"
    return devlearn.sweep(spec, path, workers=1, progress=False)


@pytest.fixture(scope="module")
def things(trial, adaptive, history, results):
    """One of each that shows itself."""
    situation = int(trial.learner.situations()[5])
    return [
        *(devlearn.World.load(name) for name in devlearn.worlds()),
        trial, trial.robot, trial.robot.definition, trial.learner,
        trial.learner.explain(situation), trial.learner.last_choice, history,
        adaptive, adaptive.learner, adaptive.learner.explain(situation),
        adaptive.learner.last_choice, devlearn.Learner(), devlearn.AdaptiveLearner(),
        devlearn.Learner().explain(0), results, Compared(results),
    ]  # fmt: skip


def test_everything_shows_itself_in_well_formed_and_small_markup(things):
    for thing in things:
        markup, _ = shown(thing)
        assert len(markup.encode()) < TENS_OF_KB, thing


def test_showing_a_thing_changes_nothing_and_gives_the_same_again(things):
    for thing in things:
        first, _ = shown(thing)
        assert shown(thing)[0] == first
    one, other = (devlearn.Trial(devlearn.World.load("paper"), seed=1) for _ in range(2))
    shown(one), shown(one.learner)
    assert one.to_bytes() == other.to_bytes()


def test_a_page_may_hold_several_because_nothing_has_an_id(things):
    assert not [node for thing in things for node in shown(thing)[1].iter() if node.get("id")]


def test_nothing_that_runs_or_loads_is_in_it(things):
    for thing in things:
        _, tree = shown(thing)
        for node in tree.iter():
            assert node.tag.rpartition("}")[2] not in {"script", "image", "use", "foreignObject"}
            assert not [name for name in node.attrib if name.startswith("on") or "href" in name]


def test_names_that_hold_markup_or_controls_are_text_and_nothing_else():
    world = devlearn.World(name=HOSTILE, description=HOSTILE)
    trial = devlearn.Trial(world, seed=1)

    class Named:
        def __repr__(self):
            return HOSTILE + "\ud800"

        def choose(self, observation):
            return 2

        def observe(self, outcome):
            pass

    record = trial.path_learning(2, step_limit=50)
    for thing in (world, trial, trial.robot, record, devlearn.Trial(world, agent=Named())):
        markup, tree = shown(thing)
        assert "<script>" in words(tree)
        assert not re.search("[\x00-\x1f\x7f-\x9f\u202a-\u202e\ud800-\udfff]", markup)
        markup.encode("utf-8")


def test_the_longest_name_is_shortened():
    world = devlearn.World(name="x" * 10_000)
    assert len(shown(world)[0]) < len(shown(devlearn.World())[0]) + 500
    assert len(shown(devlearn.Trial(world))[0]) < TENS_OF_KB


def ragged(corners, polygons=50):
    """A world whose polygons have so many corners in all."""
    draw = np.random.default_rng(1)
    angle = np.linspace(0, 2 * np.pi, corners // polygons, endpoint=False)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    obstacles = []
    for i in range(polygons):
        radius = 7 + 0.8 * draw.random((len(angle), 1))
        middle = np.array([10 + 20 * (i % 10), 10 + 35 * (i // 10)])
        obstacles.append(devlearn.Polygon((middle + radius * circle).tolist()))
    return devlearn.World(200, 180, (1, 1, 0), (199, 179), obstacles)


def seconds(thing):
    began = time.process_time()
    shown(thing)
    return time.process_time() - began


def test_a_world_of_fifty_thousand_corners_is_thinned_says_so_and_is_quick():
    world = ragged(50_000)
    markup, tree = shown(world)
    assert len(markup.encode()) < TENS_OF_KB
    assert "Thinned to a grid of" in words(tree)
    assert paths(tree, fill="#A9CBE6")[0].count("M") == 50  # none is left out
    assert min(seconds(world) for _ in range(3)) < 0.5


def test_a_world_that_is_drawn_as_it_is_says_nothing_of_thinning(paper):
    assert "Thinned" not in words(shown(paper)[1])
    assert paths(shown(paper)[1], fill="#A9CBE6")[0].count("M") == len(paper.obstacles)


def test_a_record_of_a_million_steps_shows_its_end_and_says_so(paper):
    agent = devlearn.RandomAgent(1)
    record = devlearn.Trial(paper, agent=agent).free_learning(1_000_000)
    markup, tree = shown(record)
    assert len(markup.encode()) < TENS_OF_KB
    assert "the last 2\u2009000 are drawn" in words(tree)
    assert min(seconds(record) for _ in range(3)) < 0.5


def test_many_rounds_are_shown_as_medians_and_say_so():
    world = devlearn.World.load("empty")
    trial = devlearn.Trial(world, devlearn.TrialConfig.adaptive(), seed=1)
    record = trial.path_learning(5000, rounds_only=True)
    markup, tree = shown(record)
    assert len(markup.encode()) < TENS_OF_KB
    assert "medians of 14" in words(tree)
    assert "It holds rounds only" in words(tree)


def test_the_path_that_is_drawn_begins_at_the_start_and_ends_where_the_robot_did(paper):
    trial = devlearn.Trial(paper, seed=3)
    record = trial.path_learning(3, step_limit=500)
    _, tree = shown(record)
    inner = [g for g in tree.iter(f"{SVG}svg") if g.get("viewBox") is None]
    [pieces] = [
        [path.get("d") for path in clip.iter(f"{SVG}path")]
        for clip in inner
        if any(path.get("stroke") == "#000000" for path in clip.iter(f"{SVG}path"))
    ]
    ends = set()
    for piece in "".join(pieces).split("M")[1:]:
        head, _, way = piece.partition("l")
        first = np.array(head.replace("h0", "").split(), dtype=int)
        moves = np.array(re.findall(r"-?\d+", way), dtype=int).reshape(-1, 2)
        ends |= {tuple(first.tolist()), tuple((first + moves.sum(axis=0)).tolist())}
    # A metre is 720 units where the side of 5 m is 360 pixels of ten units; y goes down.
    for x, y, _ in (record.path(2)[0], record.path(2)[-1]):
        assert any(np.hypot(x * 720 - a, (5 - y) * 720 - b) < 1.5 for a, b in ends)


def test_records_without_rounds_steps_or_a_world_are_shown_as_what_they_are(paper, history):
    nothing = devlearn.Trial(paper, seed=1).path_learning(0)
    assert "0 steps in 0 rounds" in words(shown(nothing)[1])
    untold = devlearn.Record({name: history[name] for name in history}, {})
    assert "does not say in which world" in words(shown(untold)[1])
    still = devlearn.Trial(paper, seed=1).free_learning(0)
    assert "0 steps in 1 round" in words(shown(still)[1])


def test_an_explanation_tells_of_each_motion_what_it_knows(trial):
    situation = max(
        trial.learner.situations().tolist(),
        key=lambda s: len(trial.learner.situation(s).effective),
    )
    explanation = trial.learner.explain(situation)
    _, tree = shown(explanation)
    rows = [[cell.text for cell in row] for row in tree.iter("tr")][1:]
    assert [int(row[0]) for row in rows] == list(range(5))
    for row, probability in zip(rows, explanation.probability):
        assert float(row[2]) == pytest.approx(probability, rel=1e-3)
        listed = {name for name in ("effective", "ineffective", "unexplored")
                  if int(row[0]) in getattr(explanation.memory, name)}  # fmt: skip
        assert {row[1]} == listed
    for motion, orientation in zip(explanation.memory.effective, explanation.memory.orientation):
        assert float(rows[motion][3]) == pytest.approx(orientation, rel=1e-3)


def test_of_sixty_thousand_motions_the_most_probable_are_told_and_how_many_more():
    learner = devlearn.Learner(devlearn.LearnerConfig(motion_count=60_000))
    learner.update(7, 41_000, 1.0)
    _, tree = shown(learner.explain(7))
    assert "and 59\u2009976 less probable motions" in words(tree)
    assert "59\u2009987 more" in words(shown(learner)[1])
    assert len(shown(learner)[0]) + len(shown(learner.explain(7))[0]) < TENS_OF_KB


def test_a_learner_tells_the_situations_that_it_learned_in_most():
    learner = devlearn.Learner()
    for situation, times in ((9, 1), (4, 30), (11, 7)):
        for _ in range(times):
            learner.update(situation, 2, 1.0)
    rows = [row for row in shown(learner)[1].iter("tr") if len(row) == 4]
    assert [row[0].text for row in rows] == ["situation", "4", "11", "9"]
    assert rows[1][1].text == "2 (o 1, n 30)"


def test_results_tell_runs_and_medians_of_each_agent_in_each_world(results):
    rows = [[cell.text for cell in row] for row in shown(results)[1].iter("tr")]
    frame = results.to_pandas()
    assert rows[0][:3] == ["world", "agent", "runs"]
    assert len(rows) == 1 + len(frame.groupby(["world", "label"]))
    for world, agent, runs, failed, first, *_ in rows[1:]:
        mine = frame[(frame["world"] == world) & (frame["label"] == agent)]
        assert (int(runs), int(failed)) == (len(mine), 0)
        median = np.median(mine["first_arrival"])
        told = float(first.replace("\u2009", "").replace("\u221e", "inf"))
        assert told == pytest.approx(median, rel=1e-3)


def test_a_comparison_tells_a_row_an_agent_and_a_column_a_world(results):
    rows = [[cell.text for cell in row] for row in shown(Compared(results))[1].iter("tr")]
    assert rows[0] == ["agent", "empty", "corridor"]
    assert [row[0] for row in rows[1:]] == ["adaptive", "RandomAgent"]


def test_a_robot_with_hundreds_of_sonars_and_thousands_of_motions_shows_itself_small():
    angles = np.linspace(-180, 180, 20_000).tolist()
    body = devlearn.RobotDef(steering_angles=angles, sonar_count=720, sonar_fov=360)
    robot = devlearn.Robot(devlearn.World.load("paper"), body)
    for thing in (body, robot):
        markup, tree = shown(thing)
        assert len(markup.encode()) < TENS_OF_KB
        assert "the first 360 drawn" in words(tree)


def test_showing_needs_numpy_alone():
    code = (
        "import sys, devlearn\n"
        "trial = devlearn.Trial(devlearn.World.load('paper'))\n"
        "record = trial.path_learning(2, step_limit=100)\n"
        "trial._repr_html_(), trial.learner._repr_html_(), record._repr_svg_()\n"
        "print(*sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"matplotlib", "pandas", "scipy", "jinja2", "IPython"} & set(run.stdout.split())
