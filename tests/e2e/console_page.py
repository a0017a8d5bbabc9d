"""The console's page in a browser: two consoles, a page that is watched, what is where on it, and
whether everybody can use it."""

import contextlib
import re
import time
from pathlib import Path

from conftest import ROOT, wait
from console_site import DEADLINE_S, PASSWORD, add_user, address_of, console_command
from ols_demo.site import Site
from playwright.sync_api import expect

AXE = ROOT / "build/page-libraries/node_modules/axe-core/axe.min.js"
CUT_TEXT = Path(__file__).with_name("cut_text.js").read_text()
DRAWN_TEXT = Path(__file__).with_name("drawn_text.js").read_text()
SIZES = [(1500, 900), (1280, 720), (1024, 768), (768, 1024), (390, 844)]
THEMES = ["night", "day", "sunlight"]  # the last with the largest letters
# A gamepad, and how often the page has looked at it.
PAD = """
  window.pad = { connected: true, mapping: "standard", axes: [0, 0, 0, 0],
                 buttons: Array.from({ length: 17 }, () => ({ value: 0 })) };
  window.looks = 0;
  navigator.getGamepads = () => (window.looks++, [null, window.pad]);
"""
expect.set_options(timeout=DEADLINE_S * 1000)


@contextlib.contextmanager
def two_consoles(folder):
    """Addresses: of one that is open, of one with users."""
    add_user(folder / "users", "ana", PASSWORD, "operator")
    add_user(folder / "users", "eva", PASSWORD, "admin")
    addresses = []
    with Site(folder / "logs") as site:
        for name, users in (("open", "nobody"), ("closed", "users")):
            command = console_command(folder / users, "--port", "0")
            site.start_and_wait(name, command, "ready")
            addresses.append(address_of(site, name))
        yield addresses
        site.check()


@contextlib.contextmanager
def watched_page(chromium, address):
    """A page of its own, which must have no errors; `troubles` has those so far."""
    context = chromium.new_context(viewport={"width": 1280, "height": 800}, color_scheme="dark")
    opened = context.new_page()
    opened.set_default_timeout(DEADLINE_S * 1000)
    opened.troubles = []
    opened.on("console", lambda m: opened.troubles.append(m.text) if m.type == "error" else None)
    opened.on("pageerror", lambda error: opened.troubles.append(str(error)))
    opened.goto(address)
    yield opened
    assert opened.troubles == []
    context.close()


def region(page, name):
    return page.get_by_role("region", name=name, exact=True)


def picture(page, station):
    """The station's video, once it shows something."""
    canvas = region(page, "Video").get_by_role("img", name=station, exact=True)
    expect(canvas.locator("xpath=..")).to_contain_text(re.compile(r"\d m?s"))
    return canvas


def enlarge(page, station):
    """The station's picture, large. A click while the page is being laid out may hit nothing."""
    shown = picture(page, station)
    large = shown.locator("xpath=ancestor::*[@class='cell large']")

    def click():
        shown.click()
        with contextlib.suppress(AssertionError):  # one on a large picture is an order
            expect(large).to_have_count(1, timeout=5000)

    wait(large.count, f"{station} is large", turn=click)
    return shown


def leave_unanswered(page, path):
    """Requests for the path are never answered. Chromium says so a little before it is true of what
    the page asks next, so a request of this function's own has to be caught first."""
    page.route(f"**{path}", lambda _route: None)
    page.route(lambda url: url.endswith("/?caught"), lambda route: route.fulfill(body="caught"))
    ask = "fetch('/?caught').then((answer) => answer.text())"
    wait(lambda: page.evaluate(ask) == "caught", "requests to be caught")


def axe_finds(page, within="html"):
    """What axe-core has against the page as it is now, or against what stands before it."""
    page.evaluate(AXE.read_text())
    run = "(within) => axe.run(within, {resultTypes: ['violations']})"
    found = page.evaluate(run, within)["violations"]
    return [(v["id"], [n["html"][:120] for n in v["nodes"]][:3]) for v in found]


def found_at_each_size(page, within="body"):
    """Texts that are cut or covered. A page with a map was loaded with DRAWN_TEXT."""
    found = {}
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        found[width, height] = page.evaluate(CUT_TEXT, within)
    return {size: texts for size, texts in found.items() if texts}


def unreadable(page, within="body"):
    """What axe-core has against it in any theme, and which texts are cut in the last."""
    found = []
    for theme in THEMES:
        page.evaluate("(theme) => (document.documentElement.dataset.theme = theme)", theme)
        found += [(theme, *finding) for finding in axe_finds(page, within)]
    return found + list(found_at_each_size(page, within).items())


def place(canvas, across, down):
    """On the page [px], of a picture as it lies there now."""
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    return box["x"] + across * box["width"], box["y"] + down * box["height"]


class SwiftMouse:
    """Its events are 10 ms apart by their own times, however long a busy machine takes for each: by
    them the page tells a drag from a press that rests, which is a joystick."""

    def __init__(self, page):
        self._screen = page.context.new_cdp_session(page)
        self._at, self._time_s = (0.0, 0.0), 0.0

    def _tell(self, kind, buttons):
        self._time_s += 0.01
        event = {"type": kind, "buttons": buttons, "button": "left", "clickCount": 1}
        event |= {"x": self._at[0], "y": self._at[1], "timestamp": self._time_s}
        self._screen.send("Input.dispatchMouseEvent", event)

    def press(self, x, y):
        self._at, self._time_s = (x, y), time.time()
        self._tell("mousePressed", 1)

    def move(self, x, y, steps=1):
        (x0, y0), parts = self._at, [(k + 1) / steps for k in range(steps)]
        for part in parts:
            self._at = x0 + part * (x - x0), y0 + part * (y - y0)
            self._tell("mouseMoved", 1)

    def let_go(self):
        self._tell("mouseReleased", 0)


def drag(page, canvas, begin=0.3, end=0.5):
    """Between these parts of a picture's width and height."""
    pressed, released = place(canvas, begin, begin), place(canvas, end, end)
    mouse = SwiftMouse(page)
    mouse.press(*pressed)
    mouse.move(*released, steps=4)
    mouse.let_go()
