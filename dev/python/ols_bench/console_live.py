"""tools/bench console --live: the demo's site with its console and a real browser. What ten viewers
cost the stations and the fusion, as ratios without and with them, and the console; a box dragged
until its station tracks. A click in the overview's picture: tools/bench lead-times."""

import argparse
import os
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from console_hand import Hand, Pointer, Views
from console_site import browser
from ols_demo.bus import LIVE_URL, Bus, counters
from ols_demo.keys import members_of_environment
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring

from ols_bench.line import line
from ols_bench.plain_viewer import PlainViewer
from ols_bench.processes import cpu_s, first_thread_cpu_s

ROOT = Path(__file__).resolve().parents[3]
BIN = ROOT / "build/release/bin"
SCENARIO = ROOT / "sim/scenarios/overview.toml"
OVERVIEW = "overview"
PATIENCE_S = 90.0
VIEWERS_HZ = 5.0
REFUSES_AFTER_STOP_S = 1.2  # a little more than the second for which a station does


class Timed(Views):
    """Also: how long after its exposure each target was heard."""

    def __init__(self):
        super().__init__()
        self.delays_s: list[float] = []

    def receive(self, channel, message):
        super().receive(channel, message)
        if channel == "OLS_TARGET":
            self.delays_s.append(time.time() - message.utime * 1e-6)

    def turns_p99_s(self) -> list[float]:
        """Of each station that tracks by itself, of its last thousand turns."""
        own = [status for station, status in self.status.items() if station != OVERVIEW]
        readings = [dict(zip(s.reading_name, s.reading_value, strict=True)) for s in own]
        return [one["turn_p99_s"] for one in readings]

    def frames_lost(self) -> float:
        """Of all stations since their start."""
        counts = [counters(status) for status in self.status.values()]
        return sum(c.get("frames_lost", 0.0) + c.get("frames_incomplete", 0.0) for c in counts)


@dataclass
class Cost:
    """Of some seconds with so many viewers."""

    delays_s: list[float] = field(default_factory=list)
    turns_s: list[float] = field(default_factory=list)
    lost: float = 0.0
    cores: list[float] = field(default_factory=list)  # of the console
    loops: list[float] = field(default_factory=list)  # the same, of all control loops


class Live:
    def __init__(self, site: Site, folder: Path, seed: int):
        wiring = Wiring(BIN, SCENARIO, seed, folder)
        bring_up_loopback(wiring.prepare())
        wiring.start(site, log=False)
        self.address = wiring.start_console(site)
        self.pid = site.processes["ols-console"].pid
        self.stations = [site.processes[f"ols-station-{name}"].pid for name in wiring.stations]
        self.all = wiring.stations
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

    def viewers(self, count: int, seconds: float, rounds: int) -> None:
        """In turn without and with viewers, so that what else the computer does is in both."""
        costs = {0: Cost(), count: Cost()}
        for viewers in [0, count] * rounds:
            self._measure(costs[viewers], viewers, seconds)
        without, seen = costs[0], costs[count]
        for what, of, share, most in (
            ("exposure to target, p95", "delays_s", 95, 1.1),
            ("a turn of the control loop, p99, median of the stations", "turns_s", 50, 1.05),
        ):
            samples = [getattr(cost, of) for cost in (without, seen)]
            a, b = (1000 * np.percentile(of, share) for of in samples)
            line(
                what,
                f"{a:.1f} ms; {count} viewers {b:.1f} ms: {b / a:.2f} x",
                f"<= {most} x ({len(samples[0])} and {len(samples[1])} of them)",
            )
        a, b = (float(np.mean(cost.loops)) for cost in (without, seen))
        line(
            "processor of all control loops",
            f"{a:.3f} cores; {count} viewers {b:.3f}: {b / a:.2f} x",
            "none: what viewers cost them beside waiting for a core",
        )
        line(
            "frames lost by all stations",
            f"{without.lost:.0f}; {count} viewers {seen.lost:.0f}",
            "0 more",
        )
        line(
            f"console's processor, {count} viewers at {VIEWERS_HZ:g} Hz",
            f"{np.mean(seen.cores):.2f} cores (nobody {np.mean(without.cores):.2f})",
            "<= 0.5 cores",
        )

    def _measure(self, cost: Cost, viewers: int, seconds: float) -> None:
        looking = [PlainViewer(self.address, self.all, VIEWERS_HZ) for _ in range(viewers)]
        for one in looking:
            one.start()
        self._listen(1.0)
        self.views.delays_s.clear()
        lost, spent_s, start = self.views.frames_lost(), cpu_s(self.pid), time.monotonic()
        loops_s = self._loops_s()
        self._listen(seconds)
        cost.delays_s += self.views.delays_s
        cost.turns_s += self.views.turns_p99_s()
        cost.lost += self.views.frames_lost() - lost
        took_s = time.monotonic() - start
        cost.cores.append((cpu_s(self.pid) - spent_s) / took_s)
        cost.loops.append((self._loops_s() - loops_s) / took_s)
        for one in looking:
            one.end()

    def _loops_s(self) -> float:
        return sum(map(first_thread_cpu_s, self.stations))

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
        live.viewers(options.viewers, options.seconds, options.rounds)
        site.check()
    return 0
