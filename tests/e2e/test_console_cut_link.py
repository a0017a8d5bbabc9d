"""A network that is cut while the operator's hand holds: nothing that was pressed before moves
anything afterwards, however it is held, and what the network delivers late does nothing."""

import pytest
from conftest import wait
from console_cable import Cable
from console_page import PAD, picture, place, region, watched_page
from console_site import Api
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

HOLD_MS = 600  # longer than the half second after which a press is a joystick
STALL_MS = 2000  # too short for the page to give the connection up, longer than a hand waits
NO_CONNECTION = "No connection to the console"


@pytest.fixture
def cable(consoles):
    with Cable(consoles[0]) as one:
        yield one


@pytest.fixture
def page(chromium, cable, idle):
    idle()
    with watched_page(chromium, cable.address) as opened:
        opened.evaluate(PAD)
        yield opened


class Key:
    def __init__(self, page, key):
        self._page, self._key = page, key

    def press(self, canvas):
        canvas.focus()
        self._page.keyboard.down(self._key)

    def keep_on(self):
        self._page.keyboard.down(self._key)  # as a keyboard repeats it

    def let_go(self):
        self._page.keyboard.up(self._key)


class Mouse:
    def __init__(self, page):
        self._page = page

    def press(self, canvas):
        self._at = list(place(canvas, 0.5, 0.5))
        self._page.mouse.move(*self._at)
        self._page.mouse.down()
        self._page.wait_for_timeout(HOLD_MS)  # what the hand does
        self.keep_on()

    def keep_on(self):
        self._at[0] += 25
        self._page.mouse.move(*self._at, steps=3)

    def let_go(self):
        self._page.mouse.up()


class Stick:
    def __init__(self, page):
        self._page = page

    def _push(self, axes):
        before = self._page.evaluate("window.looks")
        self._page.evaluate("(axes) => (window.pad.axes = axes)", axes)
        self._page.wait_for_function("(before) => window.looks > before + 2", arg=before)

    def press(self, canvas):
        self._push([0.8, 0, 0, 0])

    def keep_on(self):
        self._push([0.9, 0, 0, 0])

    def let_go(self):
        self._push([0, 0, 0, 0])


HANDS = {
    "arrow": lambda page: Key(page, "ArrowRight"),
    "plus": lambda page: Key(page, "+"),
    "mouse": Mouse,
    "stick": Stick,
}


def moves(paper, name):
    """Rates that move something: of the unit, or of the lens."""
    if name == "plus":
        return [m for m in paper.lens_commands if m.zoom != 0]
    rates = [m for m in paper.ptu_commands if m.command == m.COMMAND_RATE]
    return [m for m in rates if m.pan_rate_rad_s != 0]


def second_passes(paper, earlier=lambda: False):
    """The site's, in which each status comes five times; `earlier` ends it."""
    end = len(paper.pictures) + 5 * 3
    wait(lambda: earlier() or len(paper.pictures) > end, "the site to go on")


def drive(paper, name, hand, canvas):
    """Presses until rates are renewed: anew where a busy page has taken the link for cut."""

    def is_renewed():
        before = len(moves(paper, name))
        hand.let_go()
        hand.press(canvas)
        renewed = lambda: len(moves(paper, name)) > before + 2  # noqa: E731
        second_passes(paper, renewed)
        return renewed()

    wait(is_renewed, "rates that are renewed")


def held(page, overview, name):
    """Station, its picture, and the hand that holds there and moves something."""
    station = "charlie" if name == "plus" else "alfa"
    picture(page, station).click()
    canvas = picture(page, station)
    hand = HANDS[name](page)
    drive(overview, name, hand, canvas)
    return station, canvas, hand


@pytest.mark.parametrize(
    ("is_long", "names"), [(True, [*HANDS]), (False, ["arrow", "stick"])], ids=["lost", "stalled"]
)
def test_what_is_held_over_a_cut_link_needs_a_new_press(page, cable, overview, is_long, names):
    for name in names:
        see_that_it_needs_a_new_press(page, cable, overview, name, is_long)


def see_that_it_needs_a_new_press(page, cable, overview, name, is_long):
    _, canvas, hand = held(page, overview, name)
    cable.cut()
    if is_long:
        expect(page.get_by_text(NO_CONNECTION)).to_be_visible()
    else:
        page.wait_for_timeout(STALL_MS)  # what the network does
    before = len(moves(overview, name))
    cable.mend()
    expect(page.get_by_text(NO_CONNECTION)).to_be_hidden()
    first = page.locator(".utc").inner_text()
    wait(lambda: page.locator(".utc").inner_text() != first, "the page to go on")
    hand.keep_on()
    second_passes(overview)
    assert moves(overview, name)[before:] == [], f"{name}: what was held drives again"
    drive(overview, name, hand, canvas)
    hand.let_go()
    page.troubles.clear()  # what the browser says of its missing network


def test_a_command_that_a_cut_link_delivers_late_is_refused(page, cable, paper, consoles):
    """It was given when the page had not yet noticed."""
    picture(page, "alfa").click()
    stations = region(page, "Stations")
    stations.get_by_role("button", name="alfa").click()
    release = stations.get_by_role("button", name="Release", exact=True)
    expect(release).to_be_visible()
    paper.commands.clear()
    events = len(Api(consoles[0]).state()["events"])
    cable.cut()
    release.click()
    expect(page.get_by_text(NO_CONNECTION)).to_be_visible()
    cable.mend()
    expect(page.get_by_text(NO_CONNECTION)).to_be_hidden()
    second_passes(paper)
    assert paper.commands == []
    assert len(Api(consoles[0]).state()["events"]) == events
    release.click()
    wait(lambda: ("alfa", "release") in paper.commands, "the one that is given now")
    page.troubles.clear()  # what the browser says of its missing network


@pytest.mark.parametrize("name", HANDS)
def test_a_stop_of_all_ends_what_is_held(page, overview, idle, name):
    """Also after somebody has released the station: who still holds must press anew."""
    station, _, hand = held(page, overview, name)
    overview.commands.clear()
    page.keyboard.press("Escape")  # of a joystick it lets go
    page.keyboard.press("Escape")
    expect(page.get_by_text("stopping: ")).to_be_visible()
    wait(lambda: (station, "stop") in overview.commands, "the stop")
    before = len(moves(overview, name))
    idle()  # somebody has released it
    hand.keep_on()
    second_passes(overview)
    assert moves(overview, name)[before:] == [], "what was held drives again"
    hand.let_go()


def test_what_was_given_before_a_stop_is_not_answered_over_it(page, overview):
    """Refusals of the rates before it come after its own answer."""
    overview.refusing["alfa"] = "limits"
    try:
        canvas, stick = picture(page, "alfa"), Stick(page)
        canvas.click()
        stick.let_go()  # a push counts from where it was seen at rest
        stick.press(canvas)
        expect(page.locator(".notice")).to_contain_text("alfa: ")  # refused
        page.keyboard.press("Escape")
        expect(page.get_by_text("stopping: ")).to_be_visible()
        second_passes(overview)
        assert page.get_by_text("stopping: ").is_visible()
    finally:
        overview.refusing.clear()
