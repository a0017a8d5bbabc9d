"""The console's page in a real browser, with a site that exists only as messages."""

import re
import time

import pytest
from conftest import ROOT
from console_site import (
    DEADLINE_S,
    FULL_PX,
    Api,
    add_user,
    browser,
    console_command,
    paper_site,
    wait_for,
)
from ols_demo.site import Site
from playwright.sync_api import expect

AXE = ROOT / "build/page-libraries/node_modules/axe-core/axe.min.js"
PASSWORD = "correct horse"
expect.set_options(timeout=DEADLINE_S * 1000)


@pytest.fixture(scope="module")
def paper(network):
    with paper_site() as site:
        yield site


@pytest.fixture(scope="module")
def consoles(paper, tmp_path_factory):
    """Addresses: of one that is open, of one with users."""
    folder = tmp_path_factory.mktemp("console")
    add_user(folder / "users", "ana", PASSWORD, "operator")
    addresses = []
    with Site(folder / "logs") as site:
        for name, users in (("open", "nobody"), ("closed", "users")):
            command = console_command(folder / users, "--port", "0")
            site.start_and_wait(name, command, "ready")
            log = (site.logs / f"{name}.log").read_text()
            addresses.append(re.findall(r"ready: (\S+)", log)[-1])
        yield addresses
        site.check()


@pytest.fixture(scope="module")
def chromium():
    with browser() as started:
        yield started


@pytest.fixture
def page(chromium, consoles):
    context = chromium.new_context(viewport={"width": 1280, "height": 800}, color_scheme="dark")
    opened = context.new_page()
    opened.set_default_timeout(DEADLINE_S * 1000)
    opened.troubles = []
    opened.on("console", lambda m: opened.troubles.append(m.text) if m.type == "error" else None)
    opened.on("pageerror", lambda error: opened.troubles.append(str(error)))
    opened.goto(consoles[0])
    yield opened
    assert opened.troubles == []
    context.close()


def region(page, name):
    return page.get_by_role("region", name=name, exact=True)


def picture(page, station):
    """The station's video, once it shows something."""
    canvas = region(page, "Video").get_by_role("img", name=station, exact=True)
    expect(canvas.locator("xpath=..")).to_contain_text(re.compile(r"\d\.\d s"))
    return canvas


def test_shows_stations_targets_and_pictures(page):
    for name in ("Map", "Video", "Stations", "Targets", "History"):
        expect(region(page, name)).to_be_visible()
    for station in ("alfa", "bravo", "charlie"):
        expect(region(page, "Stations").get_by_role("button", name=station)).to_be_visible()
        picture(page, station)
    row = region(page, "Targets").get_by_role("row").nth(1)
    expect(row).to_contain_text("380.0 m")
    expect(row).to_contain_text("2 of 2")
    # Something is drawn where there is a map, and the picture is the one that was sent.
    colours = page.evaluate(
        """() => [...document.querySelectorAll('.map canvas')].map((c) => {
          const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
          const seen = new Set();
          for (let i = 0; i < d.length; i += 4) seen.add(d.slice(i, i + 3).join());
          return seen.size;
        }).reduce((a, b) => Math.max(a, b), 0)"""
    )
    assert colours > 10
    middle = page.evaluate(
        """() => {
          const c = document.querySelector('[aria-label=alfa][role=img]');
          const g = c.getContext('2d');
          const at = (x, y) => g.getImageData(x * c.width, y * c.height, 1, 1).data[0];
          return [at(0.48, 0.48), at(0.2, 0.2)];
        }"""
    )
    assert middle[0] < 70 and middle[1] > 140


def test_a_dragged_box_designates_in_the_frame_that_is_seen(page, paper):
    paper.designations.clear()
    canvas = picture(page, "alfa")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + 0.40 * box["width"], box["y"] + 0.40 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.60 * box["width"], box["y"] + 0.60 * box["height"], steps=4)
    page.mouse.up()
    (sent,) = wait_for(lambda: paper.designations, "the designation")
    assert sent.station == "alfa"
    assert paper.pictures[sent.frame_utime] == "alfa"
    assert sent.x_px == pytest.approx(0.40 * FULL_PX[0], abs=8)
    assert sent.y_px == pytest.approx(0.40 * FULL_PX[1], abs=8)
    assert sent.width_px == pytest.approx(0.20 * FULL_PX[0], abs=8)
    expect(page.get_by_text("alfa designate: done")).to_be_visible()
    expect(region(page, "Stations").get_by_role("button", name="alfa")).to_contain_text("tracking")


def test_a_click_centres_what_is_there(page, paper):
    paper.ptu_commands.clear()
    canvas = picture(page, "alfa")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + 0.75 * box["height"])
    (sent,) = wait_for(lambda: paper.ptu_commands, "the command")
    assert (sent.station, sent.command) == ("alfa", sent.COMMAND_CENTRE)
    assert paper.pictures[sent.frame_utime] == "alfa"
    assert sent.x_px == pytest.approx(0.25 * FULL_PX[0], abs=8)
    assert sent.y_px == pytest.approx(0.75 * FULL_PX[1], abs=8)
    expect(page.get_by_text("alfa centre: done")).to_be_visible()


def test_arrows_turn_while_they_are_held_and_letting_go_halts(page, paper):
    canvas = picture(page, "alfa")
    canvas.focus()
    paper.ptu_commands.clear()
    page.keyboard.down("ArrowRight")
    wait_for(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    page.keyboard.up("ArrowRight")
    wait_for(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0, "the halt")
    sent = list(paper.ptu_commands)
    assert {m.command for m in sent} == {sent[0].COMMAND_RATE}
    assert all(m.lease_s <= 0.3 for m in sent)
    assert sent[0].pan_rate_rad_s < 0, "to the right, of a unit that counts to the left"
    assert [m.tilt_rate_rad_s for m in sent] == [0.0] * len(sent)


def test_a_browser_that_ends_in_a_hold_turns_nothing_more(page, chromium, consoles, paper):
    """Its lid is closed: no rate follows, and another may command the station."""
    context = chromium.new_context(viewport={"width": 1280, "height": 800})
    closing = context.new_page()
    closing.goto(consoles[0])
    picture(closing, "charlie").focus()
    paper.ptu_commands.clear()
    closing.keyboard.down("ArrowRight")
    wait_for(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    context.close()

    def is_held():
        stations = Api(consoles[0]).state()["stations"]
        return any(s["id"] == "charlie" and s.get("control") for s in stations)

    wait_for(lambda: not is_held(), "the control to be given up")
    sent = len(paper.ptu_commands)
    paper.commands.clear()
    region(page, "Stations").get_by_role("button", name="charlie").click()
    region(page, "Stations").get_by_role("button", name="Release").click()
    wait_for(lambda: ("charlie", "release") in paper.commands, "another's command")
    rates = [m for m in paper.ptu_commands[sent:] if m.command == m.COMMAND_RATE]
    assert rates == []


# A tablet whose clock is an hour behind, and which the page asks for the time.
WRONG_CLOCK = """
  const right = Date.now;
  Date.now = () => right() - 3600_000;
"""


def test_a_tablets_wrong_clock_changes_neither_ages_nor_rates(chromium, consoles, paper):
    context = chromium.new_context(viewport={"width": 1280, "height": 800})
    context.add_init_script(WRONG_CLOCK)
    tablet = context.new_page()
    tablet.set_default_timeout(DEADLINE_S * 1000)
    tablet.goto(consoles[0])
    shown = picture(tablet, "alfa").locator("xpath=..").inner_text()
    (age_s,) = map(float, re.findall(r"([-\d.]+) s", shown))
    assert 0.0 <= age_s < 300.0, "an hour is no age of a picture that comes all the time"
    picture(tablet, "alfa").focus()
    paper.ptu_commands.clear()
    tablet.keyboard.down("ArrowRight")
    wait_for(lambda: len(paper.ptu_commands) > 2, "rates: the console refuses those held up")
    tablet.keyboard.up("ArrowRight")
    wait_for(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0, "the halt")
    context.close()


def drag(page, canvas):
    """From 0.3 to 0.5 of a picture's width and height, as it lies there now."""
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    page.mouse.move(box["x"] + 0.30 * box["width"], box["y"] + 0.30 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.50 * box["width"], box["y"] + 0.50 * box["height"], steps=4)
    page.mouse.up()


def test_pressing_on_a_small_picture_selects_and_never_designates(page, paper):
    paper.designations.clear()
    bravo, alfa = picture(page, "bravo"), picture(page, "alfa")
    drag(page, bravo)
    expect(bravo.locator("xpath=..")).to_have_class(re.compile("large"))
    drag(page, alfa)  # it is small now
    expect(alfa.locator("xpath=..")).to_have_class(re.compile("large"))
    alfa.focus()
    bravo.click()
    expect(bravo.locator("xpath=..")).to_have_class(re.compile("large"))
    drag(page, bravo)
    (sent,) = wait_for(lambda: paper.designations, "the designation")
    assert sent.station == "bravo"
    assert sent.x_px == pytest.approx(0.30 * FULL_PX[0], abs=8)
    assert sent.width_px == pytest.approx(0.20 * FULL_PX[0], abs=8)


def test_a_refusal_is_in_the_stations_words(page, paper):
    paper.refusing["bravo"] = "emergency"
    region(page, "Stations").get_by_role("button", name="bravo").click()
    region(page, "Stations").get_by_role("button", name="Release").click()
    expect(page.get_by_text("bravo release: refused: emergency")).to_be_visible()
    expect(region(page, "History")).to_contain_text("refused: emergency")
    paper.refusing.clear()


def test_an_alarm_comes_with_what_to_do(page, paper):
    paper.alarms["charlie"] = ["ptu: supply voltage low (11.2 V)"]
    region(page, "Stations").get_by_role("button", name="charlie").click()
    expect(region(page, "Stations")).to_contain_text("charge or replace the battery")
    paper.alarms.clear()
    expect(region(page, "History")).to_contain_text("alarm over")


def test_one_key_stops_all(page, paper):
    picture(page, "alfa")
    paper.commands.clear()
    page.keyboard.press("Escape")
    every = {(name, "stop") for name in ("alfa", "bravo", "charlie")}
    wait_for(lambda: every <= set(paper.commands), "a stop for each")
    expect(region(page, "Stations").get_by_text("stopped")).to_have_count(3)


# Notes what the page says: another notice may take its place before a busy computer looks again.
NOTE_NOTICES = """() => {
  const said = document.querySelector("output.notice");
  window.notices = [];
  new MutationObserver(() => window.notices.push(said.textContent))
    .observe(said, { childList: true, characterData: true, subtree: true });
}"""


def test_a_stop_does_not_hang_on_its_request(page, paper):
    """The request is never answered: the stations are stopped, and the operator is told in time."""
    picture(page, "alfa")
    page.evaluate(NOTE_NOTICES)
    paper.commands.clear()
    page.route("**/api/stop", lambda _route: None)
    page.keyboard.press("Escape")
    every = {(name, "stop") for name in ("alfa", "bravo", "charlie")}
    wait_for(lambda: every <= set(paper.commands), "a stop for each")
    wait_for(
        lambda: "The console cannot be reached" in " ".join(page.evaluate("window.notices")),
        "the notice",
    )
    page.unroute_all(behavior="ignoreErrors")


def test_a_station_that_does_not_confirm_the_stop_is_said(page, paper):
    picture(page, "alfa")
    paper.deaf.add("bravo")
    page.keyboard.press("Escape")
    expect(page.get_by_text("The stop is not confirmed by bravo")).to_be_visible()
    paper.deaf.clear()


def test_a_keyboard_is_enough(chromium, consoles, paper):
    """Log in, designate, follow, stop: without a pointer."""
    context = chromium.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    page.goto(consoles[1])
    expect(page.get_by_label("Name")).to_be_focused()
    page.keyboard.type("ana")
    page.keyboard.press("Tab")
    page.keyboard.type("wrong password")
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert")).to_have_text("wrong name or password")
    page.keyboard.press("Control+a")
    page.keyboard.type(PASSWORD)
    page.keyboard.press("Enter")
    picture(page, "bravo")

    def tab_to(name):
        for _ in range(60):
            page.keyboard.press("Tab")
            if (
                page.evaluate(
                    "document.activeElement.ariaLabel || document.activeElement.innerText"
                )
                == name
            ):
                return
        raise AssertionError(f"the keyboard does not reach {name}")

    paper.designations.clear()
    tab_to("Follow")
    page.keyboard.press("Enter")
    tab_to("bravo")
    for key in ("Enter", "ArrowRight", "Shift+ArrowDown", "Enter"):
        page.keyboard.press(key)
    (sent,) = wait_for(lambda: paper.designations, "the designation")
    assert sent.station == "bravo"
    assert sent.x_px > 0.47 * FULL_PX[0] and sent.height_px > 0.06 * FULL_PX[1]
    paper.commands.clear()
    page.keyboard.press("Escape")
    wait_for(lambda: ("bravo", "stop") in paper.commands, "the stop")
    context.close()


def log_in(page, address):
    page.goto(address)
    page.get_by_label("Name").fill("ana")
    page.get_by_label("Password").fill(PASSWORD)
    page.get_by_role("button", name="Log in").click()
    picture(page, "alfa")


def test_a_session_that_has_ended_shows_nothing_more(chromium, consoles):
    """Logged out elsewhere, with the same cookie: the live connection ends with the session."""
    context = chromium.new_context()
    page = context.new_page()
    log_in(page, consoles[1])
    api = Api(consoles[1])
    before = api.ask("/api/health")[1]["viewers"]
    (cookie,) = context.cookies()
    headers = {"Cookie": f"{cookie['name']}={cookie['value']}"}
    assert api.ask("/api/session", method="DELETE", headers=headers)[0] == 200
    wait_for(lambda: api.ask("/api/health")[1]["viewers"] == before - 1, "the connection to end")
    expect(page.get_by_label("Password")).to_be_visible()
    context.close()


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_axe_finds_nothing(chromium, consoles, theme):
    context = chromium.new_context(viewport={"width": 1280, "height": 800}, color_scheme=theme)
    page = context.new_page()
    page.goto(consoles[0])
    region(page, "Stations").get_by_role("button", name="alfa").click()
    picture(page, "alfa")
    page.evaluate(AXE.read_text())
    found = page.evaluate("axe.run({resultTypes: ['violations']})")["violations"]
    assert [(v["id"], [n["html"][:120] for n in v["nodes"]][:3]) for v in found] == []
    context.close()


def test_two_languages(page):
    page.get_by_label("Language").select_option("de")
    expect(region(page, "Karte")).to_be_visible()
    expect(page.get_by_role("button", name="Alles halt")).to_be_visible()


def test_a_lost_connection_is_said_and_comes_back(page):
    picture(page, "alfa")
    page.context.set_offline(True)
    expect(page.get_by_text("No connection to the console")).to_be_visible()
    page.context.set_offline(False)
    expect(page.get_by_text("No connection to the console")).to_be_hidden()
    page.troubles.clear()  # what the browser says of its missing network


def test_a_browser_that_does_not_read_costs_nobody(page, chromium, consoles, paper):
    """It opens the live state and stops reading; the others go on, and the console stays small."""
    context = chromium.new_context()
    slow = context.new_page()
    slow.goto(consoles[0])
    picture(slow, "alfa")
    api = Api(consoles[0])
    before = api.ask("/api/health")[1]["viewers"]
    # The page's thread is busy for a while: it reads nothing from its socket.
    slow.evaluate("setTimeout(() => { const t = Date.now(); while (Date.now() - t < 4000); }, 0)")
    asked = time.monotonic()
    for _ in range(20):
        assert api.ask("/api/health")[0] == 200
    assert time.monotonic() - asked < DEADLINE_S
    first = page.locator(".utc").inner_text()
    wait_for(lambda: page.locator(".utc").inner_text() != first, "the other browser to go on")
    assert api.ask("/api/health")[1]["viewers"] == before
    context.close()


def test_nothing_comes_from_elsewhere(page, consoles):
    """The bundle names no other host but in comments of licences and namespaces of XML."""
    urls = set()
    page.on("request", lambda request: urls.add(request.url))
    page.reload()
    picture(page, "alfa")
    assert all(url.startswith((consoles[0], "blob:", "data:")) for url in urls)
    files = ROOT / "build/release/console/page/files"
    named = set(re.findall(r"https?://[\w.-]+", (files / "page.js").read_text()))
    named |= set(re.findall(r"https?://[\w.-]+", (files / "page.css").read_text()))
    assert named <= {"http://www.w3.org", "http://www.opengis.net"}
