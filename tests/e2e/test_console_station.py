"""An operator's hand on a real station: camera, tracker and PTU on their wires. How soon its unit
rests is judged in simulated time (tests/unit/edge/station/station_rate_test.cpp)."""

import time

import numpy as np
import pytest
from conftest import BIN, ROOT, wait
from console_cable import Cable
from console_hand import Hand, Pointer, Views
from console_page import picture
from console_site import browser
from helpers import at_frame_rate
from ols_demo.bus import LIVE_URL, Bus
from ols_demo.keys import members_of_environment
from ols_demo.observer import Observer
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring
from playwright.sync_api import expect

STATION = "alfa"
STANDING_RAD_S = 0.002  # a twentieth of the rate that is held
BY_S = 0.02  # over which a rate of the shaft is taken
PATIENCE_S = 60.0
SLOW = ROOT / "sim/scenarios/small.toml"  # its target is, as a busy machine needs it


class Shaft(Observer):
    """Remembers where the shaft was: time [s UTC], pan [rad]."""

    def __init__(self):
        super().__init__()
        self.samples = []

    def receive(self, channel, message):
        super().receive(channel, message)
        if channel == f"OLS_SIM_PTU_{STATION}":
            for k, pan_rad in enumerate(message.pan_rad):
                self.samples.append((message.utime * 1e-6 + k * message.interval_s, pan_rad))

    def rates(self, since_s):
        """When, and how fast it turned until then [rad/s]."""
        time_s, pan_rad = np.array([s for s in self.samples if s[0] >= since_s]).T
        step = max(1, round(BY_S / np.median(np.diff(time_s))))
        turned = (pan_rad[step:] - pan_rad[:-step]) / (time_s[step:] - time_s[:-step])
        return time_s[step:], np.abs(turned)

    def stands_since(self, cut_s):
        """Half a second after the cut at the least, and for as long."""
        until_s = self.samples[-1][0]
        return until_s > cut_s + 1.0 and self.rates(until_s - 0.5)[1].max() < STANDING_RAD_S


@pytest.fixture
def site(network, tmp_path, request):
    scenario = getattr(request, "param", None)
    scenario = scenario or at_frame_rate(ROOT / "sim/scenarios/fig7.toml", 6.0, tmp_path)
    wiring = Wiring(BIN, scenario, 1, tmp_path)
    bring_up_loopback(wiring.prepare())
    with Site(tmp_path / "logs") as started:
        wiring.start_simulator(started)
        wiring.start_station(started, STATION)
        yield wiring.start_console(started)
        started.check()


def listen(bus, condition, what):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, f"not within {PATIENCE_S:.0f} s: {what()}"
        bus.handle(0.02)


def turn(page, shaft, bus, key):
    """Holds the key until the unit turns evenly. A hold that has ended, as the page ends it when it
    has heard nothing for a while, needs a new press."""
    page.keyboard.down(key)
    pressed_s = time.time()

    def seen():
        newest_s = shaft.samples[-1][0] if shaft.samples else 0.0
        _, rates = shaft.rates(newest_s - 0.5) if shaft.samples else (0, np.array([np.nan]))
        state = shaft.status[STATION].state if STATION in shaft.status else "silent"
        return (
            f"the unit turns evenly; {rates.min():.4f} to {rates.max():.4f} rad/s, "
            f"known {time.time() - newest_s:.1f} s ago, pressed {time.time() - pressed_s:.1f} s "
            f"ago, state {state}"
        )

    def turns():
        nonlocal pressed_s
        until_s = shaft.samples[-1][0] if shaft.samples else 0.0
        if until_s < pressed_s + 1.0:
            return False
        times, rates = shaft.rates(until_s - 0.5)
        if rates.max() < STANDING_RAD_S:
            print("the hold has ended: another press")
            page.keyboard.up(key)
            page.keyboard.down(key)
            pressed_s = time.time()
        return np.ptp(rates) < 0.2 * rates.min()

    listen(bus, turns, seen)


def test_a_cut_link_during_a_hold_leaves_the_unit_at_rest(site):
    """By the simulator's truth of its shaft."""
    shaft = Shaft()
    bus = Bus(LIVE_URL, shaft.receive, members_of_environment())
    with Cable(site) as cable, browser() as chromium:
        page = chromium.new_page(viewport={"width": 1280, "height": 800})
        page.goto(cable.address)
        picture(page, STATION).focus()
        turn(page, shaft, bus, "ArrowRight")
        cut_s = cable.cut()
        stands = lambda: shaft.stands_since(cut_s)  # noqa: E731
        listen(bus, stands, lambda: "the unit at rest")
        rested_us = shaft.samples[-1][0] * 1e6
        no_connection = page.get_by_text("No connection to the console")
        expect(no_connection).to_be_visible()
        # And it stays there, whatever is still held, and by the station's own word.
        cable.mend()
        expect(no_connection).to_be_hidden()
        # The newest status may have been sent before it stood.
        listen(bus, lambda: shaft.status[STATION].utime > rested_us, lambda: "its status at rest")
        status, angle = shaft.status[STATION], shaft.samples[-1][1]
        later = lambda: shaft.status[STATION].utime > status.utime + 1_500_000  # noqa: E731
        listen(bus, later, lambda: "its status")
        assert shaft.samples[-1][1] == pytest.approx(angle, abs=1e-4)
        assert shaft.status[STATION].pan_rad == pytest.approx(status.pan_rad, abs=1e-3)
        page.keyboard.up("ArrowRight")


@pytest.mark.parametrize("site", [SLOW], indirect=True, ids=["slow"])
def test_a_box_drawn_in_the_browser_makes_the_station_track(site):
    views = Views()
    bus = Bus(LIVE_URL, views.receive, members_of_environment())
    with browser() as chromium:
        page = chromium.new_page(viewport={"width": 1280, "height": 800})
        page.goto(site)
        expect(page.get_by_role("img", name=STATION, exact=True)).to_be_visible(timeout=60_000)
        hand = Hand(page, views, bus, Pointer(bus, views, 1))
        end = time.monotonic() + 8 * PATIENCE_S
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
