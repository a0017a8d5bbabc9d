"""Keys, clicks and fingers on the console's page that were not meant for a station: nothing stops,
moves or changes hands. And the ways that are meant: into the operator's hand and back to tracking,
the stop, and the release of what it has stopped."""

import re

import pytest
from conftest import wait
from console_page import PAD, SwiftMouse, picture, place, region
from console_site import DEADLINE_S, STATUS
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

HOLD_MS = 600  # longer than the half second after which a press is a joystick
# What the page says to the console, but for what it looks at.
SPY = (
    PAD
    + """
  window.said = [];
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (text) {
    if (!["watch", "taken"].includes(JSON.parse(text).do)) window.said.push(text);
    return send.call(this, text);
  };
"""
)


class Person:
    """At the page; alfa's picture is the large one."""

    def __init__(self, page):
        self.page = page
        self.canvas = picture(page, "alfa")
        self.figure = self.canvas.locator("xpath=..")

    def at(self, across=0.3, down=0.4, station="alfa"):
        box = picture(self.page, station).bounding_box()
        return box["x"] + across * box["width"], box["y"] + down * box["height"]

    def press(self, key):
        self.canvas.focus()
        self.page.keyboard.press(key)

    def escape(self):
        self.page.keyboard.press("Escape")

    def hold_escape(self):
        """A key that is held repeats: the first press closes the menu."""
        self.open_layers()
        for _ in range(3):
            self.page.keyboard.down("Escape")
        self.page.keyboard.up("Escape")
        expect(region(self.page, "Map").get_by_role("button", name="Rings")).to_be_hidden()

    def open_and_escape_at_once(self):
        """As soon as the page has drawn the open menu: before a browser tells that it is open."""
        region(self.page, "Map").locator("summary").evaluate(
            """async (summary) => {
                summary.click();
                for (let i = 0; i < 9; ++i) await null;
                const key = { key: "Escape", bubbles: true };
                summary.dispatchEvent(new KeyboardEvent("keydown", key));
            }"""
        )
        expect(region(self.page, "Map").get_by_role("button", name="Rings")).to_be_hidden()

    def open_layers(self):
        region(self.page, "Map").locator("summary").click()
        expect(region(self.page, "Map").get_by_role("button", name="Rings")).to_be_visible()

    def measure(self):
        region(self.page, "Map").get_by_role("button", name="Measure").click()
        self.escape()
        expect(self.page.get_by_text("Click two points")).to_be_hidden()

    def be_asked(self):
        button = region(self.page, "Stations").get_by_role("button", name="Home", exact=True)
        button.click()
        self.escape()
        expect(button).to_be_focused()

    def drag_and_leave(self):
        mouse = SwiftMouse(self.page)
        mouse.press(*self.at(0.3, 0.3))
        mouse.move(*self.at(0.6, 0.6), steps=4)
        self.escape()
        mouse.move(*self.at(0.7, 0.7))
        mouse.let_go()

    def draw_by_key_and_leave(self):
        self.press("Enter")
        self.escape()

    def write(self):
        field = region(self.page, "Stations").get_by_label("Pan °")
        field.focus()
        self.escape()
        expect(field).not_to_be_focused()

    def look_at_a_target(self):
        region(self.page, "Targets").get_by_role("row").nth(1).click()
        panel = self.page.get_by_role("complementary", name="Target 7")
        panel.get_by_role("button", name="Name it").click()
        self.escape()
        expect(panel.get_by_role("textbox")).to_be_hidden()
        self.escape()
        expect(panel).to_be_hidden()

    def choose(self):
        region(self.page, "Targets").get_by_label("Filter").focus()
        self.escape()

    def take_in_hand_and_leave(self):
        button = self.figure.get_by_role("button", name="By hand")
        button.click()
        expect(button).to_have_attribute("aria-pressed", "true")
        self.escape()
        expect(button).to_have_attribute("aria-pressed", "false")

    def push_by_mouse(self):
        self.page.mouse.move(*self.at(0.5, 0.5))
        self.page.mouse.down()
        self.page.wait_for_timeout(HOLD_MS)  # what the hand does
        self.page.mouse.move(*self.at(0.8, 0.5), steps=3)
        self.page.mouse.up()

    def push_by_pad(self):
        for axis in (0.6, 0):
            looks = self.page.evaluate(f"(window.pad.axes = [{axis}, 0, 0, 0], window.looks)")
            self.page.wait_for_function("(before) => window.looks > before + 2", arg=looks)

    def slip(self):
        (x, y), mouse = self.at(0.3, 0.3), SwiftMouse(self.page)
        mouse.press(x, y)
        mouse.move(x + 12, y + 12, steps=3)
        mouse.let_go()

    def slip_and_come_back(self):
        mouse = SwiftMouse(self.page)
        mouse.press(*self.at(0.3, 0.3))
        mouse.move(*self.at(0.5, 0.5))
        mouse.move(*self.at(0.3, 0.3))
        mouse.let_go()

    def choose_by_double_click(self):
        """The second click is on what the first has changed."""
        self.page.mouse.dblclick(*self.at(0.5, 0.5, "bravo"))
        self.page.mouse.click(*self.at(0.5, 0.5, "alfa"))
        expect(self.figure).to_have_class(re.compile("large"))

    def look_at_the_map(self):
        chart = region(self.page, "Map").get_by_role("application")
        chart.click()
        chart.press("ArrowRight")

    def drag_and_keep(self, *modifiers):
        """Escape while the map, or the view of it in 3-D, is under a hand."""
        box = region(self.page, "Map").bounding_box()
        x, y = box["x"] + 0.3 * box["width"], box["y"] + 0.6 * box["height"]
        for modifier in modifiers:
            self.page.keyboard.down(modifier)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + 40, y + 40, steps=4)
        for modifier in modifiers:
            self.page.keyboard.up(modifier)
        self.escape()
        self.page.mouse.up()

    def turn_in_3d(self):
        button = region(self.page, "Map").get_by_role("button", name="3-D")
        button.click()
        self.drag_and_keep()
        button.click()

    def zoom_to_a_part(self):
        scale = region(self.page, "Map").locator(".ol-scale-line-inner")
        before = scale.inner_text()
        self.drag_and_keep("Shift")
        self.page.wait_for_timeout(HOLD_MS)  # longer than the map would take to zoom
        expect(scale).to_have_text(before)

    def ways(self):
        page = self.page
        return {
            "Escape closes the menu of layers": lambda: (self.open_layers(), self.escape()),
            "Escape is held on the menu of layers": self.hold_escape,
            "Escape follows at once": self.open_and_escape_at_once,
            "Escape ends measuring": self.measure,
            "Escape answers a question": self.be_asked,
            "Escape cancels a drag": self.drag_and_leave,
            "Escape while the map is dragged": self.drag_and_keep,
            "Escape cancels a part of the map": self.zoom_to_a_part,
            "Escape while the site is turned": self.turn_in_3d,
            "Escape cancels a box of the keyboard": self.draw_by_key_and_leave,
            "Escape leaves a field": self.write,
            "Escape leaves a choice": self.choose,
            "Escape leaves a name, and closes a panel": self.look_at_a_target,
            "Escape with Shift is the browser's": lambda: page.keyboard.press("Shift+Escape"),
            "Escape takes the hand away": self.take_in_hand_and_leave,
            "a click": lambda: page.mouse.click(*self.at()),
            "a double click": lambda: page.mouse.dblclick(*self.at()),
            "a double click that chooses": self.choose_by_double_click,
            "the right button": lambda: page.mouse.click(*self.at(), button="right"),
            "a slip": self.slip,
            "a slip and back": self.slip_and_come_back,
            "a held press": self.push_by_mouse,
            "an arrow": lambda: self.press("ArrowRight"),
            "an arrow with Shift": lambda: self.press("Shift+ArrowUp"),
            "the letter L": lambda: self.press("l"),
            "a gamepad that is lifted": self.push_by_pad,
            "a wheel": lambda: (page.mouse.move(*self.at()), page.mouse.wheel(0, 300)),
            "the map": self.look_at_the_map,
        }


def track(paper, page, *stations):
    for station in stations:
        paper.states[station], paper.track_ids[station] = STATUS.STATE_TRACKING, 3
        row = region(page, "Stations").get_by_role("button", name=station)
        expect(row).to_contain_text("tracking")


def forget(paper):
    for what in (paper.commands, paper.ptu_commands, paper.designations, paper.lens_commands):
        what.clear()


def release_charlie(page, paper):
    """Once it is heard on the bus, so is whatever the page has sent before."""
    page.evaluate("window.said.length = 0")
    region(page, "Stations").get_by_role("button", name="charlie").click()
    region(page, "Stations").get_by_role("button", name="Release", exact=True).click()
    wait(lambda: paper.commands, "a command that is meant")
    assert paper.commands == [("charlie", "release")]
    assert paper.designations == [] and paper.lens_commands == []


@pytest.fixture
def spied(page):
    page.add_init_script(SPY)
    page.reload()
    return page


def test_what_is_not_meant_for_a_tracking_station_does_nothing(spied, paper):
    region(spied, "Stations").get_by_role("button", name="alfa").click()
    person = Person(spied)
    track(paper, spied, "alfa", "bravo")
    forget(paper)
    said = {}
    for way, do in person.ways().items():
        do()
        if sent := spied.evaluate("window.said.splice(0)"):
            said[way] = sent
    assert said == {}
    assert len(person.ways()) > 20
    release_charlie(spied, paper)


def test_a_tracking_station_is_taken_in_hand_and_given_back(spied, paper):
    person = Person(spied)
    track(paper, spied, "alfa")
    forget(paper)
    spied.mouse.click(*person.at())
    expect(spied.get_by_text("alfa follows an object by itself")).to_be_visible()
    person.figure.get_by_role("button", name="By hand").click()
    expect(person.figure).to_contain_text("ends tracking")
    spied.mouse.click(*person.at())
    wait(lambda: paper.commands, "the command")
    person.figure.get_by_role("button", name="Back to tracking").click()
    wait(lambda: len(paper.commands) > 1, "the release")
    assert paper.commands == [("alfa", "centre"), ("alfa", "release")]
    track(paper, spied, "alfa")
    expect(person.figure.get_by_role("button", name="Back to tracking")).to_be_hidden()
    forget(paper)
    person.press("m")
    spied.keyboard.down("ArrowRight")
    wait(lambda: paper.ptu_commands, "rates")
    spied.keyboard.up("ArrowRight")
    wait(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0, "the halt")


def test_what_was_stopped_is_released_by_one_button(page, paper):
    picture(page, "alfa")
    track(paper, page, "alfa", "bravo")
    paper.targets.clear()
    page.keyboard.press("Escape")
    expect(page.get_by_text("stopping: alfa, bravo, charlie")).to_be_visible()
    expect(region(page, "Stations").get_by_text("stopped", exact=True)).to_have_count(3)
    forget(paper)
    stop, release = (page.get_by_role("button", name=f"{word} all") for word in ("Stop", "Release"))
    before = stop.bounding_box()
    release.click()
    expect(page.get_by_text("Is the way clear?")).to_be_visible()
    assert stop.bounding_box() == before
    release.click()
    expect(page.get_by_text("released: alfa, bravo, charlie")).to_be_visible()
    assert set(paper.commands) == {(s, "release") for s in ("alfa", "bravo", "charlie")}
    expect(page.get_by_role("button", name="Release all")).to_be_hidden()
    advice = region(page, "Stations").get_by_text("alfa, bravo: No station knows where")
    expect(advice).to_be_visible(timeout=2 * DEADLINE_S * 1000)


@pytest.fixture
def phone(chromium, consoles, page):
    context = chromium.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    context.add_init_script(SPY)
    opened = context.new_page()
    opened.set_default_timeout(DEADLINE_S * 1000)
    opened.goto(consoles[0])
    yield opened
    context.close()


def swipe(page, canvas):
    """Upwards by a finger, from the picture's middle."""
    x, y = place(canvas, 0.5, 0.5)
    screen = page.context.new_cdp_session(page)
    for k in range(11):
        event = {"type": "touchMove" if k else "touchStart", "touchPoints": [{"x": x, "y": y}]}
        screen.send("Input.dispatchTouchEvent", event)
        x, y = x - 3, y - 8
    screen.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def test_a_swipe_over_a_picture_scrolls_unless_the_station_is_in_hand(phone, paper):
    alfa = picture(phone, "alfa")
    forget(paper)
    for canvas in (alfa, picture(phone, "bravo")):  # the large one, and a small one, which stays so
        phone.evaluate("scrollTo(0, 0)")
        swipe(phone, canvas)
        wait(lambda: phone.evaluate("scrollY") > 20, "the scroll")
    assert phone.evaluate("window.said") == []
    expect(alfa.locator("xpath=..")).to_have_class(re.compile("large"))
    alfa.tap()
    wait(lambda: paper.commands, "what a tap does")
    assert paper.commands == [("alfa", "centre")]
    phone.get_by_role("button", name="By hand").tap()

    def drawn():
        swipe(phone, alfa)
        return paper.designations

    wait(drawn, "a box by a finger")
