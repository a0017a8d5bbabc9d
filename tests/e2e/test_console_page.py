"""The console's page in a real browser, with a site that exists only as messages: what it shows, to
whom, and that it goes on."""

import re
import time

import ols_msg
from conftest import BIN, wait
from console_page import axe_finds, picture, region
from console_site import DEADLINE_S, FULL_PX, LOW_SUPPLY, PASSWORD, Api, PaperTarget
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]


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


def test_an_alarm_comes_with_what_to_do(page, paper):
    paper.alarms["charlie"] = [LOW_SUPPLY]
    region(page, "Stations").get_by_role("button", name="charlie").click()
    expect(region(page, "Stations")).to_contain_text("charge or replace the battery")
    paper.alarms.clear()
    row = region(page, "History").get_by_role("row", name="supply voltage low")
    expect(row).to_have_count(1)
    expect(row).to_contain_text("until")


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
    (sent,) = wait(lambda: paper.designations, "the designation")
    assert sent.station == "bravo"
    assert sent.x_px > 0.47 * FULL_PX[0] and sent.height_px > 0.06 * FULL_PX[1]
    paper.commands.clear()
    page.keyboard.press("Escape")
    wait(lambda: ("bravo", "stop") in paper.commands, "the stop")
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
    wait(lambda: api.ask("/api/health")[1]["viewers"] == before - 1, "the connection to end")
    expect(page.get_by_label("Password")).to_be_visible()
    context.close()


def test_axe_finds_nothing_in_any_theme(page, paper):
    """Contrast among it, of every state of a station and of every kind of event."""
    state = ols_msg.station_status_t
    paper.states |= {"alfa": state.STATE_LOST, "bravo": state.STATE_EMERGENCY}
    paper.fusion_alarms = [("another_fusion", {})]
    with paper.another_target(PaperTarget(state=ols_msg.target_t.TRACK_TENTATIVE)):
        region(page, "Stations").get_by_role("button", name="alfa").click()
        region(page, "Targets").get_by_role("row").nth(1).click()
        picture(page, "alfa")
        for lost in region(page, "Video"), region(page, "Stations"):
            expect(lost).to_contain_text("lost")
        for theme in ("night", "day", "sunlight"):
            page.get_by_label("Theme").select_option(theme)
            assert axe_finds(page) == [], theme
    paper.states |= dict.fromkeys(paper.states, state.STATE_IDLE)
    paper.fusion_alarms = []


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
    wait(lambda: page.locator(".utc").inner_text() != first, "the other browser to go on")
    assert api.ask("/api/health")[1]["viewers"] == before
    context.close()


NONSENSE = """() => new Promise((done) => {
  const socket = new WebSocket(`ws://${location.host}/api/live`);
  const why = [];
  const point = { do: "command", number: 1, station: "alfa", command: "point" };
  socket.onopen = () => {
    socket.send("{");
    socket.send("[]");
    socket.send(JSON.stringify({ do: "fly" }));
    socket.send(JSON.stringify({ ...point, pan_deg: 1e9, tilt_deg: 0 }));
  };
  socket.onmessage = ({ data }) => {
    const message = typeof data === "string" ? JSON.parse(data) : {};
    if (message.kind === "answer") why.push(message.why);
    if (why.length === 4) socket.send("x".repeat(9000));
  };
  socket.onclose = () => done(why);
})"""


def test_nonsense_is_answered_counted_and_costs_nobody(page, consoles):
    picture(page, "alfa")
    api = Api(consoles[0])
    before = api.ask("/api/health")[1]
    json, an_object, unknown, angle = page.evaluate(NONSENSE)
    assert (json, an_object) == ("refused: not JSON", "refused: not a JSON object")
    assert "do must be" in unknown and "pan_deg" in angle
    after = wait(
        lambda: (h := api.ask("/api/health")[1])["viewers"] == before["viewers"] and h,
        "the oversize message to end its connection",
    )
    assert after["messages_refused"] == before["messages_refused"] + 4
    first = page.locator(".utc").inner_text()
    wait(lambda: page.locator(".utc").inner_text() != first, "the page to go on")


TEN = """() => Promise.all(Array.from({ length: 10 }, () => new Promise((done) => {
  const socket = new WebSocket(`ws://${location.host}/api/live`);
  socket.binaryType = "arraybuffer";
  const had = { alfa: 0, bravo: 0, charlie: 0 };
  socket.onopen = () => socket.send(JSON.stringify({ do: "watch", pictures: Object.keys(had) }));
  socket.onmessage = ({ data }) => {
    if (typeof data === "string") return;
    const length = new DataView(data).getUint32(0);
    had[JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))).station]++;
    if (Math.min(...Object.values(had)) < 5) return;
    socket.close();
    done(true);
  };
})))"""


def test_ten_browsers_see_every_station(page, paper):
    picture(page, "alfa")
    assert page.evaluate(TEN) == [True] * 10
    first = page.locator(".utc").inner_text()
    wait(lambda: page.locator(".utc").inner_text() != first, "the page to go on")
    assert page.get_by_text("No connection to the console").count() == 0


def test_nothing_comes_from_elsewhere(page, consoles):
    """The bundle names no other host but in comments of licences and namespaces of XML."""
    urls = set()
    page.on("request", lambda request: urls.add(request.url))
    page.reload()
    picture(page, "alfa")
    assert all(url.startswith((consoles[0], "blob:", "data:")) for url in urls)
    files = BIN.parent / "console/page/files"
    named = set(re.findall(r"https?://[\w.-]+", (files / "page.js").read_text()))
    named |= set(re.findall(r"https?://[\w.-]+", (files / "page.css").read_text()))
    assert named <= {"http://www.w3.org", "http://www.opengis.net"}
