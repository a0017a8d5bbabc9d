"""tools/bench-console --live: the demo's site with its console and a real browser. What ten viewers
cost the stations and the fusion, as ratios of turns without and with them; a box dragged until its
station tracks; a click in the overview's picture until all tracking stations follow."""

import argparse
import os
import tempfile
import time
from pathlib import Path

import numpy as np
from console_hand import Hand, Pointer, Views
from console_site import browser
from ols_demo.bus import LIVE_URL, Bus
from ols_demo.keys import members_of_environment
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring

from ols_bench.line import line
from ols_bench.plain_viewer import PlainViewer

ROOT = Path(__file__).resolve().parents[3]
BIN = ROOT / "build/release/bin"
SCENARIO = ROOT / "sim/scenarios/overview.toml"
OVERVIEW = "overview"
PATIENCE_S = 90.0
TARGETS_END_S = 5.0  # without bearings the fusion has none after 2 s, and the units have turned


class Timed(Views):
    """Also: how long after its exposure each target was heard, and each station's slowest turns."""

    def __init__(self):
        super().__init__()
        self.delays_s: list[float] = []
        self.turns_s: list[float] = []

    def receive(self, channel, message):
        super().receive(channel, message)
        if channel == "OLS_TARGET":
            self.delays_s.append(time.time() - message.utime * 1e-6)
        elif channel.startswith("OLS_STATUS_") and message.station != OVERVIEW:
            readings = dict(zip(message.reading_name, message.reading_value, strict=True))
            self.turns_s.append(readings["slowest_turn_s"])


class Live:
    def __init__(self, site: Site, folder: Path, seed: int):
        wiring = Wiring(BIN, SCENARIO, seed, folder)
        bring_up_loopback(wiring.prepare())
        wiring.start(site, log=False)
        self.address = wiring.start_console(site)
        self.tracking, self.all = wiring.tracking_stations, wiring.stations
        self.views = Timed()
        self.bus = Bus(LIVE_URL, self.views.receive, members_of_environment())
        self.operator = Pointer(self.bus, self.views, seed)

    def wait(self, condition, what: str, patience_s: float = PATIENCE_S) -> None:
        end = time.monotonic() + patience_s
        while not condition():
            if time.monotonic() > end:
                raise RuntimeError(f"not within {patience_s:.0f} s: {what}")

    def command(self, station: str, what: str) -> None:
        done = f'"{BIN}/ols-ctl" --lcm-url "{LIVE_URL}" {station} {what} >/dev/null'
        os.system(done)

    # --- the measures

    def drags(self, page, count: int) -> None:
        """Each station in turn follows nothing, is pointed, and is given the target by a box."""
        hand = Hand(page, self.views, self.bus, self.operator)
        times, done = [], 0
        for number in range(count):
            station = self.tracking[number % len(self.tracking)]
            if hand.state(station) == "tracking":
                self.command(station, "stop")
                self.wait(lambda s=station: hand.state(s) == "stopped", f"{station} stops")
                self.command(station, "release")
                self.wait(lambda s=station: hand.state(s) != "stopped", f"{station} is released")
                self.operator.tracking.discard(station)
            page.get_by_role("img", name=station, exact=True).click()
            self.wait(lambda s=station: hand.draw(s), f"a box on {station}'s picture")
            start = time.monotonic()
            while hand.state(station) != "tracking" and time.monotonic() < start + 5.0:
                pass
            done += hand.state(station) == "tracking"
            times.append(time.monotonic() - start)
        p50, p95 = np.percentile(times, [50, 95])
        line(
            f"a box dragged until its station tracks, {len(self.tracking)} stations in turn",
            f"{done} of {count}, p50 {p50:.2f} s, p95 {p95:.2f} s",
            f"{count} of {count}, <= 1 s",
        )

    def viewers(self, count: int, seconds: float, rounds: int) -> None:
        """In turn without and with viewers, so that what else the computer does is in both."""
        delays, turns = {0: [], count: []}, {0: [], count: []}
        for viewers in [0, count] * rounds:
            looking = [PlainViewer(self.address, self.all) for _ in range(viewers)]
            for one in looking:
                one.start()
            self._listen(1.0)
            self.views.delays_s.clear(), self.views.turns_s.clear()
            self._listen(seconds)
            delays[viewers] += self.views.delays_s
            turns[viewers] += self.views.turns_s
            for one in looking:
                one.end()
        for what, of, share, most in (
            ("exposure to target, p95", delays, 95, 1.1),
            ("slowest of a second's turns of the control loop, median", turns, 50, 1.05),
            ("slowest of a second's turns of the control loop, p95", turns, 95, 1.05),
        ):
            without, seen = (1000 * np.percentile(of[n], share) for n in (0, count))
            line(
                what,
                f"{without:.1f} ms; {count} viewers {seen:.1f} ms: {seen / without:.2f} x",
                f"<= {most} x ({len(of[0])} and {len(of[count])} of them)",
            )

    def _listen(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.bus.handle(0.05)

    def looks(self, page, count: int) -> None:
        """Nobody follows anything; a click in the overview's picture. One that is refused, or that
        missed the object, is repeated, and counted."""
        hand = Hand(page, self.views, self.bus, self.operator)
        times, repeated = [], 0
        for _ in range(count):
            while not (clicked_s := self._click(hand)):
                repeated += 1
            while not self._all_are(hand, {"tracking"}) and time.monotonic() < clicked_s + 20.0:
                pass
            times.append(time.monotonic() - clicked_s)
        line(
            f"a click in the overview's picture until all {len(self.tracking)} stations follow",
            ", ".join(f"{t:.1f}" for t in times) + f" s; {repeated} clicks repeated",
            "<= 5 s",
        )

    def _click(self, hand) -> float | None:
        """When it was clicked, if the overview then follows the object."""
        self._follow_nothing(hand)
        self.operator._pointed.pop(OVERVIEW, None)
        hand.turn(OVERVIEW)
        self._listen(3.0)
        clicked = None
        end = time.monotonic() + PATIENCE_S
        while clicked is None:
            if time.monotonic() > end:
                raise RuntimeError(f"not within {PATIENCE_S:.0f} s: the overview shows the object")
            at_s = time.monotonic()
            clicked = hand.look(OVERVIEW)
        while hand.state(OVERVIEW) != "tracking" and time.monotonic() < at_s + 1.0:
            pass
        return at_s if clicked and hand.state(OVERVIEW) == "tracking" else None

    def _follow_nothing(self, hand) -> None:
        self.command("all", "stop")
        self.wait(lambda: self._all_are(hand, {"stopped"}), "all stop")
        self.command("all", "release")
        self.wait(lambda: not self._any_is(hand, "stopped"), "all are released")
        for station in self.all:
            self.command(station, "manual 0 5")
        self._listen(TARGETS_END_S)
        for station in self.tracking:
            self.command(station, "release")

    def _states(self, hand) -> list[str]:
        self.bus.handle(0.02)
        return [self.views.state(station) for station in self.tracking]

    def _all_are(self, hand, states) -> bool:
        return all(state in states for state in self._states(hand))

    def _any_is(self, hand, state) -> bool:
        return state in self._states(hand)


def main(options: argparse.Namespace) -> int:
    print(f"load of this computer before: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    with tempfile.TemporaryDirectory() as folder, Site(Path(folder) / "logs") as site:
        live = Live(site, Path(folder), options.seed)
        with browser() as chromium:
            page = chromium.new_page(viewport={"width": 1500, "height": 900})
            page.goto(live.address)
            page.get_by_role("img", name=OVERVIEW, exact=True).wait_for(timeout=30_000)
            live.drags(page, options.drags)
            live.looks(page, options.looks)
        live.viewers(options.viewers, options.seconds, options.rounds)
        site.check()
    return 0
