"""A box drawn in the browser makes a real station track: camera, tracker and PTU on their wires."""

import time

import pytest
from conftest import BIN, ROOT
from console_site import browser, wait_for
from ols_demo.bus import LIVE_URL, Bus
from ols_demo.keys import members_of_environment
from ols_demo.observer import Observer
from ols_demo.operator import Operator
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring
from playwright.sync_api import expect

STATION = "alfa"
PATIENCE_S = 60.0
MARGIN = 0.3  # of the object's size around it


class Views(Observer):
    """Also remembers where the object was in each frame."""

    def __init__(self):
        super().__init__()
        self.frames = {}  # stamp -> box in the full frame [px]

    def receive(self, channel, message):
        super().receive(channel, message)
        if channel == f"OLS_SIM_VIEW_{STATION}":
            self.frames[message.stamp_utime] = (message.visible, list(message.box_px))

    def box_at(self, utime_us):
        """In the frame of this time, by the station's clock; None without an object."""
        stamp = min(self.frames, key=lambda one: abs(one - utime_us), default=None)
        if stamp is None or abs(stamp - utime_us) > 30_000 or not self.frames[stamp][0]:
            return None
        return self.frames[stamp][1]


class Pointer(Operator):
    """Points the station like the demo's operator, and leaves the designation to the browser."""

    def _designate(self, station):
        pass


class Drawer:
    """A person at the page."""

    def __init__(self, page, views, bus, operator):
        self._page, self._views, self._bus, self._operator = page, views, bus, operator
        self._canvas = page.get_by_role("img", name=STATION, exact=True)

    def turn(self):
        self._bus.handle(0.02)
        self._operator.act({STATION})

    def state(self):
        self.turn()
        return self._views.state(STATION)

    def seen_utime_us(self):
        return int(self._canvas.get_attribute("data-utime-us") or 0)

    def _corner(self, x, y):
        place = self._canvas.bounding_box()
        status = self._views.status[STATION]
        across = place["x"] + x / status.image_width_px * place["width"]
        self._page.mouse.move(across, place["y"] + y / status.image_height_px * place["height"])

    def draw(self):
        """True when the box was drawn on the picture for which it was meant."""
        self.turn()
        utime_us = self.seen_utime_us()
        box = self._views.box_at(utime_us)
        if box is None or self._views.turning_rad_s.get(STATION, 1.0) > 0.005:
            return False
        x, y, width, height = box
        self._corner(x - MARGIN * width, y - MARGIN * height)
        self._page.mouse.down()
        is_the_same = self.seen_utime_us() == utime_us
        if is_the_same:
            self._corner(x + (1 + MARGIN) * width, y + (1 + MARGIN) * height)
        self._page.mouse.up()
        return is_the_same


@pytest.fixture
def site(network, tmp_path):
    wiring = Wiring(BIN, ROOT / "sim/scenarios/fig7.toml", 1, tmp_path)
    bring_up_loopback(wiring.prepare())
    with Site(tmp_path / "logs") as started:
        sim = [wiring.program("ols-sim"), "--scenario", str(ROOT / "sim/scenarios/fig7.toml")]
        sim += ["--seed", "1", "--lcm-url", LIVE_URL, "--directory", str(tmp_path / "lines")]
        started.start_and_wait("ols-sim", sim, "ready")
        wiring.start_station(started, STATION)
        yield wiring.start_console(started)
        started.check()


def test_a_box_drawn_in_the_browser_makes_the_station_track(site):
    views = Views()
    bus = Bus(LIVE_URL, views.receive, members_of_environment())
    with browser() as chromium:
        page = chromium.new_page(viewport={"width": 1280, "height": 800})
        page.goto(site)
        expect(page.get_by_role("img", name=STATION, exact=True)).to_be_visible(timeout=20_000)
        drawer = Drawer(page, views, bus, Pointer(bus, views, 1))
        end = time.monotonic() + PATIENCE_S
        while drawer.state() != "tracking":
            assert time.monotonic() < end, "the station does not track"
            if not drawer.draw():
                continue
            drawn = time.monotonic()
            while drawer.state() != "tracking" and time.monotonic() < drawn + 2.5:
                pass
            print(f"{time.monotonic() - drawn:.2f} s from the drag to {drawer.state()}")
        row = page.get_by_role("region", name="Stations").get_by_role("button", name=STATION)
        expect(row).to_contain_text("tracking")
        # And the same hand stops it.
        page.keyboard.press("Escape")
        wait_for(lambda: drawer.state() == "stopped", "the station to stop")
