"""The console's page in a browser: two consoles, a page that is watched, what is where on it, and
whether everybody can use it."""

import contextlib
import re

from conftest import ROOT, wait
from console_site import DEADLINE_S, PASSWORD, add_user, address_of, console_command
from ols_demo.site import Site
from playwright.sync_api import expect

AXE = ROOT / "build/page-libraries/node_modules/axe-core/axe.min.js"
expect.set_options(timeout=DEADLINE_S * 1000)


@contextlib.contextmanager
def two_consoles(folder):
    """Addresses: of one that is open, of one with users."""
    add_user(folder / "users", "ana", PASSWORD, "operator")
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


def leave_unanswered(page, path):
    """Requests for the path are never answered. Chromium says so a little before it is true of what
    the page asks next, so a request of this function's own has to be caught first."""
    page.route(f"**{path}", lambda _route: None)
    page.route(lambda url: url.endswith("/?caught"), lambda route: route.fulfill(body="caught"))
    ask = "fetch('/?caught').then((answer) => answer.text())"
    wait(lambda: page.evaluate(ask) == "caught", "requests to be caught")


def axe_finds(page):
    """What axe-core has against the page as it is now."""
    page.evaluate(AXE.read_text())
    found = page.evaluate("axe.run({resultTypes: ['violations']})")["violations"]
    return [(v["id"], [n["html"][:120] for n in v["nodes"]][:3]) for v in found]


def place(canvas, across, down):
    """On the page [px], of a picture as it lies there now."""
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    return box["x"] + across * box["width"], box["y"] + down * box["height"]


def drag(page, canvas, begin=0.3, end=0.5):
    """Between these parts of a picture's width and height, at once: a long press is a joystick."""
    pressed, released = place(canvas, begin, begin), place(canvas, end, end)
    page.mouse.move(*pressed)
    page.mouse.down()
    page.mouse.move(*released, steps=4)
    page.mouse.up()
