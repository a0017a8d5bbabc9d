"""The operator's hand on a picture, in a real browser: holding as a joystick, wheel and fingers as
a zoom, the motorised lens of an overview station, and looking."""

import math
import time

import pytest
from conftest import wait
from console_page import axe_finds, drag, enlarge, picture, place, region
from console_site import DEADLINE_S, FULL_PX, PASSWORD, add_user, address_of, console_command
from ols_demo.site import Site
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

SOON_S = 5.0
HOLD_MS = 600  # longer than the half second after which a press is a joystick


def soon(condition):
    end = time.monotonic() + SOON_S
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    return condition()


def caption(canvas):
    return canvas.locator("xpath=..").locator("figcaption")


def test_a_press_that_is_held_is_a_joystick(page, paper):
    canvas = picture(page, "alfa")
    paper.ptu_commands.clear()
    page.mouse.move(*place(canvas, 0.5, 0.5))
    page.mouse.down()
    page.wait_for_timeout(HOLD_MS)  # what the hand does
    page.mouse.move(*place(canvas, 0.7, 0.4), steps=3)
    wait(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    page.mouse.up()
    wait(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0, "the halt")
    assert {m.command for m in paper.ptu_commands} == {paper.ptu_commands[0].COMMAND_RATE}
    assert paper.designations == [] or paper.designations[-1].station != "alfa"
    pushed = paper.ptu_commands[1]
    assert pushed.pan_rate_rad_s < 0 < pushed.tilt_rate_rad_s, "to the right and upwards"


MOVES = """([x, y]) => new Promise((resolve) => {
  const canvas = document.querySelector('[aria-label=alfa][role=img]');
  let count = 0;
  const timer = setInterval(() => {
    const at = { bubbles: true, pointerId: 1, clientX: x + (count % 20), clientY: y };
    canvas.dispatchEvent(new PointerEvent('pointermove', at));
    if (++count < 360) return;
    clearInterval(timer);
    resolve();
  }, 8);
})"""  # of a screen that is looked at 120 times a second, for three seconds


def test_a_hand_that_never_rests_is_told_ten_times_a_second(page, paper):
    canvas = picture(page, "alfa")
    rates = lambda: [m for m in paper.ptu_commands if m.command == m.COMMAND_RATE]  # noqa: E731

    def pressed():
        """Whether this press drove, and ended with a halt. One that a gap in the connection ends
        may do neither; the station then halts when the last rate's lease ends."""
        paper.ptu_commands.clear()
        begin = time.monotonic()
        page.mouse.move(*place(canvas, 0.5, 0.5))
        page.mouse.down()
        page.wait_for_timeout(HOLD_MS)
        page.evaluate(MOVES, place(canvas, 0.65, 0.5))
        sent = len(rates())
        assert sent <= 10 * (time.monotonic() - begin) + 3
        page.mouse.up()
        return sent > 2 and soon(lambda: paper.ptu_commands[-1].pan_rate_rad_s == 0)

    wait(pressed, "rates and a halt")


def test_a_box_of_the_keyboard_is_on_the_picture_of_its_end(page, paper):
    canvas = picture(page, "alfa")
    paper.designations.clear()
    canvas.focus()
    page.keyboard.press("Enter")
    begun_us = int(canvas.get_attribute("data-utime-us"))
    wait(
        lambda: int(canvas.get_attribute("data-utime-us")) > begun_us + 1_500_000, "later pictures"
    )
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    (sent,) = wait(lambda: paper.designations, "the designation")
    assert sent.station == "alfa" and sent.frame_utime > begun_us + 1_500_000
    assert sent.x_px == pytest.approx(0.48 * FULL_PX[0], abs=1)


def test_a_hold_over_a_network_that_is_cut_moves_nothing_late(page, paper):
    canvas = picture(page, "alfa")
    canvas.focus()
    paper.ptu_commands.clear()
    page.keyboard.down("ArrowRight")
    wait(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    page.context.set_offline(True)
    expect(page.get_by_text("No connection to the console")).to_be_visible()
    page.keyboard.up("ArrowRight")
    sent = len(paper.ptu_commands)
    page.context.set_offline(False)
    expect(page.get_by_text("No connection to the console")).to_be_hidden()
    page.keyboard.press("Escape")
    wait(lambda: ("alfa", "stop") in paper.commands[-9:], "the stop that comes after")
    late = [m for m in paper.ptu_commands[sent:] if m.command == m.COMMAND_RATE]
    assert all(m.pan_rate_rad_s == 0 for m in late)
    page.troubles.clear()  # what the browser says of its missing network


def test_a_wheel_magnifies_the_picture_and_a_box_on_it_is_where_it_was_drawn(page, paper):
    canvas = picture(page, "alfa")
    paper.designations.clear()
    page.mouse.move(*place(canvas, 0.5, 0.5))
    page.mouse.wheel(0, -400 * math.log(2))
    expect(caption(canvas)).to_contain_text("2.0×")
    drag(page, canvas, 0.4, 0.6)
    (sent,) = wait(lambda: paper.designations, "the designation")
    assert sent.x_px == pytest.approx(0.45 * FULL_PX[0], abs=8)
    assert sent.y_px == pytest.approx(0.45 * FULL_PX[1], abs=8)
    assert sent.width_px == pytest.approx(0.10 * FULL_PX[0], abs=8)
    canvas.focus()
    page.keyboard.press("-")
    page.keyboard.press("-")
    page.keyboard.press("-")
    expect(caption(canvas)).not_to_contain_text("×")


def test_who_may_only_look_may_magnify(chromium, tmp_path, paper):
    add_user(tmp_path / "users", "vera", PASSWORD, "viewer")
    with Site(tmp_path / "logs") as site:
        site.start_and_wait("closed", console_command(tmp_path / "users", "--port", "0"), "ready")
        page = chromium.new_context(viewport={"width": 1280, "height": 800}).new_page()
        page.set_default_timeout(DEADLINE_S * 1000)
        page.goto(address_of(site, "closed"))
        page.get_by_label("Name").fill("vera")
        page.get_by_label("Password").fill(PASSWORD)
        page.get_by_role("button", name="Log in").click()
        canvas = picture(page, "alfa")
        paper.ptu_commands.clear()
        page.mouse.move(*place(canvas, 0.5, 0.5))
        page.mouse.wheel(0, -400)
        expect(caption(canvas)).to_contain_text("2.7×")
        page.mouse.click(*place(canvas, 0.3, 0.3))
        stations = region(page, "Stations")
        stations.get_by_role("button", name="alfa").click()
        expect(stations.get_by_role("button", name="Release")).to_have_count(0)
        stations.get_by_role("button", name="Stop", exact=True).click()
        wait(lambda: paper.ptu_commands, "the stop, which anybody may")
        assert {m.command for m in paper.ptu_commands} == {paper.ptu_commands[0].COMMAND_STOP}
        page.context.close()


def test_the_wheel_moves_a_motorised_lens(page, overview):
    canvas = picture(page, "charlie")
    canvas.click()
    expect(caption(canvas)).to_contain_text("30 %")
    page.mouse.move(*place(canvas, 0.5, 0.5))
    page.mouse.wheel(0, -160)
    (sent,) = wait(lambda: overview.lens_commands, "the lens command")
    assert (sent.station, sent.command) == ("charlie", sent.COMMAND_POSITION)
    assert sent.zoom == pytest.approx(0.3 + 0.4 / 4, abs=0.01)
    assert math.isnan(sent.focus) and math.isnan(sent.iris)
    expect(caption(canvas)).to_contain_text("40 %")


def test_plus_zooms_the_lens_while_it_is_held(page, overview):
    canvas = enlarge(page, "charlie")
    canvas.focus()
    page.keyboard.down("+")
    wait(lambda: len(overview.lens_commands) > 2, "rates that are renewed")
    page.keyboard.up("+")
    wait(lambda: overview.lens_commands[-1].zoom == 0, "the halt")
    sent = overview.lens_commands
    assert all(m.command == m.COMMAND_RATE and m.lease_s <= 0.3 for m in sent)
    assert sent[0].zoom == 1


def test_each_axis_of_the_lens_goes_where_it_is_told(page, overview):
    stations = region(page, "Stations")
    stations.get_by_role("button", name="charlie").click()
    for index, axis in enumerate(("Zoom", "Focus", "Iris")):
        stations.get_by_label(axis).fill("0.9")
        wait(lambda at=index: overview.lenses["charlie"][at] == 0.9, f"{axis} at 90 %")
        expect(stations.get_by_text(f"{axis} 90 %")).to_be_visible()
    assert axe_finds(page) == []


def test_look_here_is_a_click_on_what_is_to_be_followed(page, overview):
    canvas = picture(page, "charlie")
    canvas.click()
    overview.designations.clear()
    caption(canvas).get_by_role("button", name="Look here").click()
    page.mouse.click(*place(canvas, 0.25, 0.75))
    (sent,) = wait(lambda: overview.designations, "what is to be looked at")
    assert sent.station == "charlie" and (sent.width_px, sent.height_px) == (0, 0)
    assert sent.x_px == pytest.approx(0.25 * FULL_PX[0], abs=8)
    assert sent.y_px == pytest.approx(0.75 * FULL_PX[1], abs=8)
    expect(page.get_by_text("charlie look: done")).to_be_visible()


def test_look_here_by_keys(page, overview):
    canvas = picture(page, "charlie")
    canvas.click()
    expect(page.get_by_text("charlie centre: done")).to_have_count(0)
    for by in ("L", "Shift"):
        overview.designations.clear()
        if by == "L":
            canvas.focus()
            page.keyboard.press("l")
        else:
            page.keyboard.down("Shift")
            page.mouse.click(*place(canvas, 0.5, 0.5))
            page.keyboard.up("Shift")
        (sent,) = wait(lambda: overview.designations, "what is to be looked at")
        assert sent.x_px == pytest.approx(0.5 * FULL_PX[0], abs=8)


class Fingers:
    """Touch the screen, as the browser has it from the device."""

    def __init__(self, page):
        self._session = page.context.new_cdp_session(page)

    def spread(self, canvas, narrow, wide):
        """Two of them, about the middle: from one distance of the picture's width to another."""
        for k in range(7):
            half = (narrow + (wide - narrow) * k / 6) / 2
            ends = [place(canvas, 0.5 - half, 0.5), place(canvas, 0.5 + half, 0.5)]
            self._touch("Move" if k else "Start", ends)
        self._touch("End", [])

    def _touch(self, kind, places):
        points = [{"x": x, "y": y, "id": n} for n, (x, y) in enumerate(places)]
        self._session.send(
            "Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points}
        )


def test_two_fingers_magnify_and_one_centres(chromium, consoles, paper):
    """On a tablet."""
    context = chromium.new_context(viewport={"width": 1024, "height": 768}, has_touch=True)
    tablet = context.new_page()
    tablet.set_default_timeout(DEADLINE_S * 1000)
    tablet.goto(consoles[0])
    canvas = picture(tablet, "alfa")
    paper.ptu_commands.clear()
    Fingers(tablet).spread(canvas, 0.1, 0.3)
    expect(caption(canvas)).to_contain_text("3.0×")
    assert paper.ptu_commands == [], "two fingers turn nothing"
    tablet.touchscreen.tap(*place(canvas, 0.5, 0.5))
    (sent,) = wait(lambda: paper.ptu_commands, "the command")
    assert sent.command == sent.COMMAND_CENTRE
    assert sent.x_px == pytest.approx(0.5 * FULL_PX[0], abs=20)
    context.close()


def test_three_dimensions_by_two_fingers(chromium, consoles):
    context = chromium.new_context(viewport={"width": 1024, "height": 768}, has_touch=True)
    tablet = context.new_page()
    tablet.set_default_timeout(DEADLINE_S * 1000)
    tablet.goto(consoles[0])
    chart = region(tablet, "Map")
    chart.get_by_role("button", name="3-D").click()
    view = chart.get_by_role("img", name="3-D")
    steps = chart.locator(".view-3d-tools span")
    expect(steps).to_contain_text("m")
    before = steps.inner_text()
    Fingers(tablet).spread(view, 0.04, 0.5)
    expect(steps).not_to_have_text(before)
    context.close()
