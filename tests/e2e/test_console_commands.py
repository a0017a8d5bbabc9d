"""Commands on the console's page, in a real browser: designations, turning by hand, stops."""

import re

import pytest
from conftest import wait
from console_page import drag, leave_unanswered, picture, place, region
from console_site import DEADLINE_S, FULL_PX, Api
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]


def test_a_dragged_box_designates_in_the_frame_that_is_seen(page, paper):
    paper.designations.clear()
    drag(page, picture(page, "alfa"), 0.4, 0.6)
    (sent,) = wait(lambda: paper.designations, "the designation")
    assert sent.station == "alfa"
    assert paper.pictures[sent.frame_utime] == "alfa"
    assert sent.x_px == pytest.approx(0.40 * FULL_PX[0], abs=8)
    assert sent.y_px == pytest.approx(0.40 * FULL_PX[1], abs=8)
    assert sent.width_px == pytest.approx(0.20 * FULL_PX[0], abs=8)
    expect(page.get_by_text("alfa designate: done")).to_be_visible()
    expect(region(page, "Stations").get_by_role("button", name="alfa")).to_contain_text("tracking")


def test_a_click_centres_what_is_there(page, paper):
    paper.ptu_commands.clear()
    page.mouse.click(*place(picture(page, "alfa"), 0.25, 0.75))
    (sent,) = wait(lambda: paper.ptu_commands, "the command")
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
    wait(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    page.keyboard.up("ArrowRight")
    wait(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0, "the halt")
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
    wait(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    context.close()

    def is_held():
        stations = Api(consoles[0]).state()["stations"]
        return any(s["id"] == "charlie" and s.get("control") for s in stations)

    wait(lambda: not is_held(), "the control to be given up")
    sent = len(paper.ptu_commands)
    paper.commands.clear()
    region(page, "Stations").get_by_role("button", name="charlie").click()
    region(page, "Stations").get_by_role("button", name="Release").click()
    wait(lambda: ("charlie", "release") in paper.commands, "another's command")
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
    ((age, unit),) = re.findall(r"([-\d.]+) (m?s)", shown)
    assert 0.0 <= float(age) * {"s": 1.0, "ms": 1e-3}[unit] < 300.0, (
        "an hour is no age of a picture that comes all the time"
    )
    picture(tablet, "alfa").focus()
    paper.ptu_commands.clear()
    tablet.keyboard.down("ArrowRight")
    wait(lambda: len(paper.ptu_commands) > 2, "rates: the console refuses those held up")
    tablet.keyboard.up("ArrowRight")
    wait(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0, "the halt")
    context.close()


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
    (sent,) = wait(lambda: paper.designations, "the designation")
    assert sent.station == "bravo"
    assert sent.x_px == pytest.approx(0.30 * FULL_PX[0], abs=8)
    assert sent.width_px == pytest.approx(0.20 * FULL_PX[0], abs=8)


def test_a_refusal_is_in_the_stations_words(page, paper):
    paper.refusing["bravo"] = "emergency"
    region(page, "Stations").get_by_role("button", name="bravo").click()
    region(page, "Stations").get_by_role("button", name="Release").click()
    expect(page.get_by_text("bravo release: refused: the emergency stop holds")).to_be_visible()
    expect(region(page, "History")).to_contain_text("refused: the emergency stop holds")
    paper.refusing.clear()


def test_one_key_stops_all(page, paper):
    picture(page, "alfa").focus()
    paper.commands.clear()
    page.keyboard.press("Escape")
    every = {(name, "stop") for name in ("alfa", "bravo", "charlie")}
    wait(lambda: every <= set(paper.commands), "a stop for each")
    expect(region(page, "Stations").get_by_text("stopped", exact=True)).to_have_count(3)
    page.keyboard.down("ArrowRight")
    wait(lambda: paper.counters["alfa"].get("refused_stopped"), "a rate that moves nothing")
    page.keyboard.up("ArrowRight")
    expect(region(page, "Stations").get_by_text("stopped", exact=True)).to_have_count(3)


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
    leave_unanswered(page, "/api/stop")
    page.keyboard.press("Escape")
    every = {(name, "stop") for name in ("alfa", "bravo", "charlie")}
    wait(lambda: every <= set(paper.commands), "a stop for each")
    wait(
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
