"""Areas on the console's page: drawn by a guard, entered by a target, confirmed, kept over a
restart; and told to others on the bus, and to the stations."""

import re

import lcm
import numpy as np
import ols_msg
import pytest
from conftest import wait
from console_page import region, unreadable, watched_page
from console_site import Api, PaperTarget, address_of, console_command
from ols_demo.bus import LIVE_URL
from ols_demo.places import geodetic
from ols_demo.site import Site
from playwright.sync_api import expect
from test_console_map import is_target, pixels

pytest_plugins = ["console_fixtures"]

OUTSIDE = geodetic(49.2400, 16.597, 380.0)


@pytest.fixture
def console(paper, tmp_path):
    """Starts a console that keeps its areas in one folder, and ends it; returns its address."""
    config = tmp_path / "console.toml"
    config.write_text(f'[incidents]\nfolder = "{tmp_path / "incidents"}"\n')
    paper.records.clear()
    with Site(tmp_path / "logs") as site:

        def start(name):
            options = ("--config", str(config), "--port", "0")
            site.start_and_wait(name, console_command(tmp_path / "nobody", *options), "ready")
            return address_of(site, name)

        yield site, start
        site.check()


@pytest.fixture
def told():
    """The newest message of each incident, by its number; call it to hear more."""
    bus, newest = lcm.LCM(LIVE_URL), {}

    def hear(_channel, data):
        message = ols_msg.incident_t.decode(data)
        newest[message.number] = message

    bus.subscribe("OLS_INCIDENT", hear)

    def listen():
        while bus.handle_timeout(1) > 0:
            pass
        return newest

    return listen


def where_the_target_stands(page):
    """Down and right on the map [px]; None while it moves, or is not drawn."""
    at, then = (np.median(pixels(page, is_target), axis=0) for _ in range(2))
    return tuple(at) if np.allclose(at, then, atol=1) else None


def draw_around_the_target(page):
    """Four corners, by clicks, each from where the map shows the target then."""
    expect(page.get_by_role("banner")).to_contain_text("Stations 3/3")
    page.get_by_role("button", name="Whole site").click()
    page.get_by_role("button", name="Incidents").click()
    page.get_by_role("button", name="Draw an area").click()
    form = page.get_by_role("complementary", name="Area")
    form.get_by_label("Name").fill("Gate")
    canvas = page.locator(".map-canvas")
    box = canvas.bounding_box()
    for across, below in ((-60, -50), (60, -50), (60, 50), (-60, 50)):
        down, right = wait(lambda: where_the_target_stands(page), "the target on the map")
        page.mouse.click(box["x"] + right + across, box["y"] + down + below)
    corners = form.get_by_label("Corners")
    expect(corners).to_have_value(re.compile(r"^(49\.\d{6} 16\.\d{6}\n?){4}$"))
    return form


def test_a_target_in_a_drawn_area_is_confirmed_by_a_guard(chromium, paper, console, told):
    site, start = console
    address = start("watching")
    with watched_page(chromium, address) as page:
        expect(region(page, "Targets").get_by_role("row").nth(1)).to_contain_text("380.0 m")
        form = draw_around_the_target(page)
        assert unreadable(page, ".map-panel") == []
        page.set_viewport_size({"width": 1280, "height": 800})
        form.get_by_role("button", name="Save").click()
        expect(region(page, "History")).to_contain_text("area Gate: target 7 is inside")
        page.get_by_role("button", name="Incidents").click()
        incidents = page.get_by_role("dialog", name="Incidents")
        incidents.get_by_role("button", name="Incident 1", exact=True).click()
        picture = incidents.get_by_role("img", name="Incident 1: alfa")
        wait(lambda: picture.evaluate("one => one.naturalWidth") == 320, "its picture")
        expect(incidents.get_by_role("img", name=re.compile("Trail: 380 m"))).to_be_visible()
        assert unreadable(page, ".incidents") == []
        page.set_viewport_size({"width": 1280, "height": 800})
        incidents.get_by_role("button", name="Confirm: Incident 1").click()
        expect(incidents).to_contain_text("confirmed: operator")
        expect(region(page, "History")).to_contain_text("operator confirms incident 1")

    wait(lambda: told().get(1) and told()[1].verdict == 1, "the verdict on the bus")
    assert (told()[1].target_boot_id, told()[1].target_id) == (paper.fusion_boot, 7)
    wait(lambda: len(paper.records) >= 2, "the stations that saw it to record")
    assert {(m.station, m.label) for m in paper.records} == {
        ("alfa", "incident-1"),
        ("bravo", "incident-1"),
    }

    site.stop("watching")
    known = paper.targets[7]
    paper.targets[7] = PaperTarget(lambda _time_s: OUTSIDE)
    again = Api(start("again"))
    wait(lambda: again.state()["incidents"][0]["ended_us"] > 0, "the target to have left")
    kept = again.state()["incidents"][0]
    assert (kept["verdict"], kept["judged_by"], kept["entries"]) == ("confirmed", "operator", 1)
    assert again.ask("/api/incidents/1/picture")[1][:2] == b"\xff\xd8"
    wait(lambda: told()[1].ended_utime == kept["ended_us"], "its end on the bus")
    paper.targets[7] = known
    wait(lambda: again.state()["incidents"][0]["entries"] == 2, "the target to be back")


def test_a_bad_file_of_areas_is_named_and_left(chromium, console, tmp_path):
    _site, start = console
    areas = tmp_path / "incidents/areas.json"
    areas.parent.mkdir()
    areas.write_text('{"version": 7}')
    with watched_page(chromium, start("reading")) as page:
        expect(region(page, "History")).to_contain_text(f"{areas} cannot be read: version 7")
        form = draw_around_the_target(page)
        form.get_by_role("button", name="Save").click()
        expect(page.locator(".notice")).to_contain_text("the file of areas cannot be read")
        expect(form).to_be_visible()
    assert areas.read_text() == '{"version": 7}'
