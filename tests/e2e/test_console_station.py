"""A box drawn in the browser makes a real station track: camera, tracker and PTU on their wires."""

import time

import pytest
from conftest import BIN, ROOT, wait
from console_hand import Hand, Pointer, Views
from console_site import browser
from ols_demo.bus import LIVE_URL, Bus
from ols_demo.keys import members_of_environment
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring
from playwright.sync_api import expect

STATION = "alfa"
SCENARIO = ROOT / "sim/scenarios/small.toml"  # its target is slow, as a busy machine needs it
PATIENCE_S = 180.0


@pytest.fixture
def site(network, tmp_path):
    wiring = Wiring(BIN, SCENARIO, 1, tmp_path)
    bring_up_loopback(wiring.prepare())
    with Site(tmp_path / "logs") as started:
        wiring.start_simulator(started)
        wiring.start_station(started, STATION)
        yield wiring.start_console(started)
        started.check()


def test_a_box_drawn_in_the_browser_makes_the_station_track(site):
    views = Views()
    bus = Bus(LIVE_URL, views.receive, members_of_environment())
    with browser() as chromium:
        page = chromium.new_page(viewport={"width": 1280, "height": 800})
        page.goto(site)
        expect(page.get_by_role("img", name=STATION, exact=True)).to_be_visible(timeout=60_000)
        hand = Hand(page, views, bus, Pointer(bus, views, 1))
        end = time.monotonic() + PATIENCE_S
        while hand.state(STATION) != "tracking":
            assert time.monotonic() < end, "the station does not track"
            if not hand.draw(STATION):
                continue
            drawn = time.monotonic()
            while hand.state(STATION) != "tracking" and time.monotonic() < drawn + 2.5:
                pass
            print(f"{time.monotonic() - drawn:.2f} s from the drag to {hand.state(STATION)}")
        row = page.get_by_role("region", name="Stations").get_by_role("button", name=STATION)
        expect(row).to_contain_text("tracking")
        # And the same hand stops it.
        page.keyboard.press("Escape")
        wait(lambda: hand.state(STATION) == "stopped", "the station to stop")
