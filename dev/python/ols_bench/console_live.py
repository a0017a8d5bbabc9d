"""tools/bench console --live: the demo's site with its console and a real browser; a box dragged
until its station tracks. A click in the overview's picture: tools/bench lead-times."""

import argparse
import os
import tempfile
import time
from pathlib import Path

import numpy as np
from console_hand import Hand, Pointer, Views
from console_site import browser
from ols_demo.bus import LIVE_URL, Bus, counters
from ols_demo.keys import members_of_environment
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring

from ols_bench.line import line

ROOT = Path(__file__).resolve().parents[3]
BIN = ROOT / "build/release/bin"
SCENARIO = ROOT / "sim/scenarios/overview.toml"
OVERVIEW = "overview"
PATIENCE_S = 90.0
REFUSES_AFTER_STOP_S = 1.2  # a little more than the second for which a station does


class Live:
    def __init__(self, site: Site, folder: Path, seed: int):
        wiring = Wiring(BIN, SCENARIO, seed, folder)
        bring_up_loopback(wiring.prepare())
        wiring.start(site, log=False)
        self.address = wiring.start_console(site)
        self.all = wiring.stations
        self.views = Views()
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

    def drags(self, page, count: int) -> None:
        """Each station in turn is stopped, so that the fusion leaves it alone, is pointed, and is
        given the target by a box, which ends the stop."""
        hand = Hand(page, self.views, self.bus, self.operator)
        times, done = [], 0
        for number in range(count):
            station = self.all[number % len(self.all)]
            self._stop(hand, station)
            page.get_by_role("img", name=station, exact=True).click(button="right")  # select it
            accepted = self._designations(station)
            self.wait(lambda s=station: hand.draw(s), f"a box on {station}'s picture")
            start = time.monotonic()
            # Without the operator, who would point a station that does not track yet.
            while self._state(station) != "tracking" and time.monotonic() < start + 5.0:
                pass
            times.append(time.monotonic() - start)
            tracks = self._state(station) == "tracking"
            is_done = tracks and self._designations(station) > accepted
            done += is_done
            if not is_done:
                print(f"drag {number}, {station}: {self._why_not(station, accepted)}", flush=True)
        p50, p95 = np.percentile(times, [50, 95])
        line(
            f"a box dragged until its station tracks, {len(self.all)} stations in turn",
            f"{done} of {count}, p50 {p50:.2f} s, p95 {p95:.2f} s",
            f"{count} of {count}, <= 1 s",
        )

    def _stop(self, hand, station: str) -> None:
        """And until it takes commands again."""
        self.command(station, "stop")
        self.wait(lambda: hand.state(station) == "stopped", f"{station} stops")
        self._listen(REFUSES_AFTER_STOP_S)
        self.operator.begin_again(station)

    def _designations(self, station: str) -> float:
        return counters(self.views.status[station]).get("designate_accepted", 0.0)

    def _why_not(self, station: str, accepted: float) -> str:
        status = self.views.status[station]
        counts = counters(status)
        refused = {name: n for name, n in counts.items() if "refused" in name and n}
        taken = "accepted" if self._designations(station) > accepted else "not accepted"
        return f"{taken}, then {self.views.state(station)}; since its start {refused}"

    def _listen(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.bus.handle(0.05)

    def _state(self, station: str) -> str:
        self.bus.handle(0.02)
        return self.views.state(station)


def main(options: argparse.Namespace) -> int:
    print(f"load of this computer before: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    with tempfile.TemporaryDirectory() as folder, Site(Path(folder) / "logs") as site:
        live = Live(site, Path(folder), options.seed)
        with browser() as chromium:
            page = chromium.new_page(viewport={"width": 1500, "height": 900})
            page.goto(live.address)
            page.get_by_role("img", name=OVERVIEW, exact=True).wait_for(timeout=30_000)
            live.drags(page, options.drags)
        site.check()
    return 0
