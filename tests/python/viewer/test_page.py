"""Pages of records and worlds, in a browser."""

import devlearn
import devlearn.viewer
import numpy as np
import pytest
from conftest import refused
from devlearn import Event, Kind, Record, Trial, TrialConfig, World
from devlearn.analysis import preference_field
from devlearn.viewer import page, write_page
from pages import TITLE, header_of, program


@pytest.fixture(scope="session")
def browser():
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=program("chromium"), args=["--no-sandbox"])
        yield browser
        browser.close()


class Opened:
    """A page that is open: what was asked of the network, and what went wrong."""

    def __init__(self, browser, path, **how):
        self.context = browser.new_context(**{"viewport": {"width": 1280, "height": 860}, **how})
        self.page = self.context.new_page()
        self.wrong, self.asked = [], []
        self.page.on("console", lambda message: self.wrong.append(message.text))
        self.page.on("pageerror", lambda error: self.wrong.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(path.as_uri())
        self.page.wait_for_selector("html[data-ready]", state="attached", timeout=20_000)

    def __getattr__(self, name):
        return getattr(self.page, name)

    def go_to(self, step):
        self.page.evaluate("(step) => devlearn.goTo(step)", int(step))
        return self.state()

    def state(self):
        return self.page.evaluate("devlearn.state()")

    def picture(self):
        return self.page.locator("#stage").screenshot()


@pytest.fixture
def opened(browser, tmp_path):
    """opened(record or world, **how) shows its page; at the end nothing may have gone wrong."""
    pages = []

    def open_page(what, how=None, **options):
        path = tmp_path / f"page-{len(pages)}.html"
        devlearn.viewer.write_page(path, what, **options)
        pages.append(Opened(browser, path, **(how or {})))
        return pages[-1]

    yield open_page
    for each in pages:
        each.context.close()
    assert [each.wrong for each in pages] == [[] for _ in pages]
    assert all(url.startswith("file:") for each in pages for url in each.asked)


@pytest.fixture(scope="module")
def record(paper):
    trial = Trial(paper, seed=3)
    return Record.concatenate([trial.free_learning(1500), trial.path_learning(8)])


def after(record, step):
    """The index of the pose after a step."""
    return step + int(np.searchsorted(np.cumsum(record.rounds["steps"]), step - 1, side="right"))


def test_the_page_tells_of_each_step_what_the_record_says(record, opened):
    shown = opened(record)
    for step in (1, 700, 1500, 1501, len(record), 42):
        told, pose = shown.go_to(step), after(record, step)
        assert told["step"] == step
        assert told["round"] == record.round[step - 1]
        assert told["situation"] == record.situation[step - 1]
        assert told["motion"] == record.motion[step - 1]
        assert told["kind"] == Kind(record.kind[step - 1]).name.lower()
        assert told["event"] == Event(record.event[step - 1]).name.lower()
        assert told["explored"] == record.explored_count[step - 1]
        assert told["effective"] == record.effective_count[step - 1]
        for name in "xy":
            assert told[name] == pytest.approx(getattr(record, name)[pose], abs=4e-5)
        turned = told["heading"] - record.heading[pose]
        assert (turned + 180) % 360 - 180 == pytest.approx(0, abs=0.003)
    assert shown.go_to(0)["stepOfRound"] == 0


def test_pictures_differ_where_the_robot_the_ground_or_the_learner_do(record, opened):
    shown = opened(record)
    pictures = []
    for step in (5, 400, len(record)):
        shown.go_to(step)
        pictures.append(shown.picture())
    for layer in ("arrows", "sonars", "paths"):
        shown.page.evaluate("(layer) => devlearn.show({[layer]: false})", layer)
        pictures.append(shown.picture())
    shown.page.evaluate("devlearn.show({ground: 'none'})")
    pictures.append(shown.picture())
    assert len(set(pictures)) == len(pictures)
    shown.page.evaluate("devlearn.show({ground: 'SEF', arrows: true, sonars: true, paths: true})")
    assert shown.picture() == pictures[2]


def test_keys_and_buttons_move_through_time(record, opened):
    shown = opened(record)

    def press(key):
        shown.keyboard.press(key)
        return shown.state()

    assert press("ArrowRight")["step"] == 1
    assert press("Shift+ArrowRight")["step"] == 101
    assert press("ArrowLeft")["step"] == 100
    assert press("PageDown")["round"] == 2
    assert press("PageDown")["round"] == 3
    assert press("End")["step"] == len(record)
    assert press("PageUp")["stepOfRound"] == 0
    assert press("Home")["step"] == 0
    assert press("+")["speed"] > press("-")["speed"]
    assert press("d")["theme"] != press("d")["theme"]
    assert not press("a")["layers"]["arrows"]
    shown.locator("#forward").click()
    assert shown.state()["step"] == 1
    shown.locator("#next").click()
    assert shown.state()["round"] == 2
    shown.locator("#speed").select_option("5000")
    shown.locator("#play").click()
    for _ in range(200):
        shown.wait_for_timeout(50)
        if not shown.state()["playing"]:
            break
    assert shown.state()["step"] == len(record)
    shown.locator("#help").click()
    assert shown.locator("#keys").is_visible()
    shown.locator("#keys").click()
    box = shown.locator("#rounds").bounding_box()
    shown.mouse.click(box["x"] + box["width"] - 10, box["y"] + 40)
    assert shown.state()["round"] == record.rounds["round"][-1]


def test_a_cell_pointed_at_tells_its_lists_and_why_it_chose(record, opened, paper):
    shown = opened(record)
    step = int(np.flatnonzero(record.kind == int(Kind.EXPLORE))[40]) + 1
    shown.go_to(step)
    why = shown.locator("#why").inner_text()
    assert f"Situation {record.situation[step - 1]}" in why
    assert "To explore had a chance of" in why
    assert shown.locator("#why tr.chosen").count() == 1
    assert shown.locator("#why tbody tr").count() == 5
    # A cell somewhere else, clicked at, stays; there, headings can be chosen.
    box = shown.locator("#stage").bounding_box()
    shown.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + 0.9 * box["height"])
    pinned = shown.locator("#why h3").inner_text()
    assert pinned != why.splitlines()[0]
    assert shown.locator("#headings button").count() == 12
    shown.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.2 * box["height"])
    assert shown.locator("#why h3").inner_text() == pinned
    shown.locator("#headings button").nth(5).click()
    assert "heading 150" in shown.locator("#why h3").inner_text()
    shown.keyboard.press("Escape")
    shown.mouse.move(1, 1)
    assert f"Situation {record.situation[step - 1]}" in shown.locator("#why").inner_text()


def test_the_arena_is_seen_from_nearer_and_the_robot_stays_in_view(record, opened):
    shown = opened(record)
    shown.go_to(1)
    whole = shown.picture()
    shown.keyboard.press("z")
    shown.keyboard.press("z")
    assert shown.state()["zoom"] == 4
    near = shown.picture()
    box = shown.locator("#stage").bounding_box()
    shown.mouse.move(box["x"] + 200, box["y"] + 300)
    shown.mouse.down()
    shown.mouse.move(box["x"] + 100, box["y"] + 350, steps=3)
    shown.mouse.up()
    shown.mouse.move(1, 1)
    assert len({whole, near, shown.picture()}) == 3
    x, y = shown.page.evaluate("devlearn.goTo(400), devlearn.pixel(devlearn.state())")
    assert 0 < x < box["width"]
    assert 0 < y < box["height"]
    for _ in range(3):
        shown.locator("#farther").click()
    assert shown.state()["zoom"] == 1
    shown.go_to(1)
    shown.mouse.move(1, 1)
    shown.page.evaluate("document.activeElement.blur()")
    assert shown.picture() == whole


def test_the_page_fits_a_phone_and_is_played_there_by_touch(record, opened):
    phone = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "color_scheme": "dark"}
    shown = opened(record, phone)
    assert shown.state()["theme"] == "dark"
    assert shown.page.evaluate("document.documentElement.scrollWidth") <= 390
    shown.locator("#next").tap()
    assert shown.state()["round"] == 2
    shown.locator("#stage").tap(position={"x": 100, "y": 200})
    assert shown.locator("#headings").is_visible()


def test_an_adaptive_learner_is_told_at_moments(paper, opened):
    trial = Trial(paper, TrialConfig.adaptive(), seed=2)
    record = trial.path_learning(25)
    shown = opened(record)
    assert shown.state()["layers"]["ground"] == "adaptive SEF"
    first = shown.picture()
    assert shown.go_to(len(record))["learner"] == "adaptive"
    assert shown.picture() != first
    for situation in trial.learner.situations()[:200:7].tolist():
        told = shown.page.evaluate("(id) => devlearn.situation(id)", situation)
        memory = trial.learner.situation(situation)
        assert told["outcomes"] == memory.times
        assert told["losses"] == pytest.approx(memory.losses, abs=max(memory.losses) / 100)
        assert told["unexplored"] == memory.unexplored
    assert header_of(page(record))["notes"] == []


@pytest.mark.parametrize(
    "config", [TrialConfig(), TrialConfig.adaptive()], ids=["paper", "adaptive"]
)
def test_the_arrows_are_those_of_the_field_of_preferences(paper, opened, config):
    trial = Trial(paper, config, seed=5)
    record = trial.free_learning(1500)
    shown = opened(record)
    shown.go_to(100)
    for step in range(1450, 1501, 10):  # the last ones by what changed alone
        shown.go_to(step)
    arrows = shown.page.evaluate("devlearn.preferences()")
    field = preference_field(trial)
    told = {(round(a["x"], 6), round(a["y"], 6)): (a["u"], a["v"], a["times"]) for a in arrows}
    assert len(told) == len(field.x) > 50
    for x, y, u, v, times in zip(*field):
        assert told[round(x, 6), round(y, 6)] == pytest.approx((u, v, times), abs=1e-6)


def test_worlds_are_shown_as_they_are_and_movers_move(opened):
    shapes = [
        devlearn.Polygon(
            [(0.5, 2), (2, 2), (2, 4), (0.5, 4)], [[(0.8, 2.3), (1.7, 2.3), (1.7, 3.7), (0.8, 3.7)]]
        ),
        devlearn.Polyline([(3, 1), (3.5, 2), (4.5, 1)]),
        devlearn.Rectangle((3, 3.5), (0.5, 0.3), 20),
    ]
    path = devlearn.MoverPath([(2.4, 1), (2.4, 4)], 0.1, "back")
    walk = devlearn.MoverWalk(4, (3.5, 2.5), (4.5, 4), leg_time=20)
    movers = [
        devlearn.Mover(devlearn.Circle((0, 0), 0.2), path),
        devlearn.Mover(devlearn.Rectangle((0, 0), (0.3, 0.2), 0), walk),
    ]
    world = World(
        start=(0.4, 0.4, 0), target=(4.6, 4.6), obstacles=shapes, movers=movers, name="all"
    )
    shown = opened(world)
    first = shown.picture()
    for time in (0, 7.5, 33, 59.5, 300):
        shown.locator("#scrub").fill(str(round(2 * time)))
        places = shown.page.evaluate("(time) => devlearn.movers(time)", time)
        expected = [shape.center for shape in world.movers_at(time)]
        assert np.array(places) == pytest.approx(np.array(expected), abs=1e-9)
    assert shown.picture() != first
    record = Trial(world, seed=1).free_learning(50)
    assert opened(record).go_to(50)["time"] == 25


def test_where_odometry_errs_the_situation_believed_in_is_shown(paper, opened):
    config = TrialConfig(noise=devlearn.NoiseDef(odometry_turn=5.0, odometry_drive=0.1))
    record = Trial(paper, config, seed=1).free_learning(400)
    errs = np.flatnonzero(record.situation != record.true_situation)
    shown = opened(record)
    assert shown.go_to(errs[-1])["trueSituation"] == record.true_situation[errs[-1]]
    assert shown.state()["believedSituation"] == record.situation[errs[-1]]


def test_sonars_are_heard_by_the_page_as_by_the_robot(paper, opened):
    trial = Trial(paper, seed=1)
    record = trial.free_learning(200, echoes=True)
    columns = {name: record[name] for name in record if name != "echoes"}
    shown = opened(Record(columns, record.provenance))
    for step in (1, 50, 199):
        shown.go_to(step)
        heard = shown.page.evaluate("devlearn.echoes()")
        assert heard == pytest.approx(record.echoes[step - 1].tolist(), abs=2e-3)


# --- what cannot be shown -------------------------------------------------------------------------


def test_records_of_rounds_only_or_of_none_say_so(paper, opened):
    trial = Trial(paper, seed=1)
    shown = opened(trial.path_learning(4, step_limit=50, rounds_only=True))
    assert "rounds only" in shown.locator("#notes").inner_text()
    assert shown.locator("#rounds").is_visible()
    assert not shown.locator("#growth").is_visible()
    shown = opened(trial.path_learning(0))
    assert "no rounds" in shown.locator("#notes").inner_text()
    shown = opened(trial.free_learning(0))
    assert shown.go_to(3)["step"] == 0


def test_long_records_are_thinned_and_the_page_says_so(record, opened):
    shown = opened(record, most_steps=500)
    subtitle = shown.locator("#subtitle").inner_text()
    assert f"one step in {-(-len(record) // 500)}" in subtitle
    assert shown.go_to(len(record))["step"] == len(record)
    told = shown.go_to(700)
    assert 700 <= told["step"] < 710
    assert told["kind"] == Kind(record.kind[told["step"] - 1]).name.lower()
    assert told["learner"] is None
    assert "too long" in shown.locator("#notes").inner_text()
    header = header_of(page(record, most_steps=500))
    assert header["thinned"]["steps"] > 1


def test_of_many_rounds_some_are_shown_whole(paper):
    trial = Trial(paper, seed=3)
    record = Record.concatenate([trial.free_learning(1)] + [trial.path_learning(200, step_limit=3)])
    header = header_of(page(record, most_steps=250))
    assert header["thinned"] == {"steps": 1, "rounds": 3}
    assert header["allRounds"] == 201


def test_markup_and_control_characters_in_names_do_nothing(opened):
    name = '</script><script>alert("x")</script>{{data}}\x01\u202e<b>&'
    world = World(start=(1, 1, 0), target=(4, 4), name=name)
    shown = opened(world)
    assert shown.locator("#title").inner_text().startswith("</script><script>alert")
    assert shown.locator("#title b").count() == 0
    title = TITLE.search(page(world))[1]
    assert "<" not in title
    assert "\x01" not in title
    assert "\u202e" not in title
    record = Trial(world, seed=1).free_learning(5)
    provenance = {**record.provenance, "agent": name, "commit": name}
    shown = opened(Record({name: record[name] for name in record}, provenance))
    assert "alert" in shown.locator("#provenance").inner_text()


def test_what_is_neither_record_nor_world_is_refused(record, paper):
    refused(lambda: page("paper"), "what")
    refused(lambda: page(record, config=TrialConfig()), "config")
    refused(lambda: page(record, most_steps=0), "most_steps")
    refused(lambda: page(Record({name: record[name] for name in record}, {})), "record.provenance")
    columns = {name: record[name] for name in record}
    with pytest.raises(devlearn.FileError):
        page(Record(columns, record.provenance, b"no snapshot"))


def test_a_page_that_cannot_be_written_is_refused(paper, tmp_path):
    with pytest.raises(devlearn.FileError):
        write_page(tmp_path / "none" / "page.html", paper)
