"""tools/demo: runs a simulated site, records it and reports the accuracy."""

import argparse
import json
import os
import signal
import sys
import time
from pathlib import Path
from typing import Any

import ols

from ols_demo import evaluate, plot, recording
from ols_demo.bus import LIVE_URL, Bus
from ols_demo.doorway import VARIABLE
from ols_demo.finding import Finding
from ols_demo.inside import write_in_site
from ols_demo.live import Screen, at_work
from ols_demo.observer import Observer
from ols_demo.operator import Operator
from ols_demo.site import Site, SiteError, bring_up_loopback
from ols_demo.wiring import Wiring, add_site_options, scenario_file

PATIENCE_S = 120.0
PROGRAMS = ["ols-station", "ols-fusion", "ols-sim", "ols-key"]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/demo", description=__doc__)
    parser.add_argument(
        "--seconds", type=float, default=60.0, help="to run once the target is tracked [s]"
    )
    parser.add_argument(
        "--operator",
        action="store_true",
        help="an operator points the stations and designates the target, in place of the "
        "detectors (scenario: overview.toml)",
    )
    parser.add_argument(
        "--headless", action="store_true", help="neither console nor live picture in the terminal"
    )
    parser.add_argument("--report", type=Path, help="JSON file; a plot is written beside it")
    add_site_options(parser, "unattended", "demo")
    parser.set_defaults(scenario=None)
    parser.add_argument(
        "--patience", type=float, default=PATIENCE_S, help="until the target is tracked [s]"
    )
    parser.add_argument(
        "--console-only", type=Path, metavar="LOG", help="only replay this log on the console"
    )
    options = parser.parse_args()
    if options.scenario is None:
        options.scenario = scenario_file("overview" if options.operator else "unattended")
    return options


class Run:
    """One run of the site, from start to the report."""

    def __init__(self, options: argparse.Namespace, keys: str | None, operated: bool = True):
        """keys: the folder of the site's throw-away keys; None: the site is unsigned. operated:
        an operator points and designates; else the site finds targets by itself."""
        self.options = options
        self.observer = Observer()
        self.finding = Finding()
        trust = ols.Trust(keys, "operator", 1) if keys else None
        self.bus = Bus(LIVE_URL, self._receive, trust)
        self.operator = Operator(self.bus, self.observer, options.seed) if operated else None
        self.screen = None if options.headless else Screen()
        self._draw_due = 0.0

    def _receive(self, channel: str, message: Any) -> None:
        self.observer.receive(channel, message)
        if not self.operator:
            self.finding.receive(channel, message)

    def turn(self, site: Site, title: str) -> None:
        self.bus.handle(0.05)
        if self.operator:
            self.operator.act()
        site.check()
        if self.screen and time.monotonic() >= self._draw_due:
            self._draw_due = time.monotonic() + self.screen.period_s
            self.screen.draw(title, self.observer)

    def designate(self, site: Site, stations: list[str]) -> None:
        print(f"designating the target in {len(stations)} views", flush=True)
        deadline = time.monotonic() + self.options.patience
        while not self.operator.tracking.issuperset(stations):
            self.turn(site, "the operator points the stations and designates the target")
            if time.monotonic() > deadline:
                missing = ", ".join(sorted(set(stations) - self.operator.tracking))
                raise SiteError(f"not tracking after {self.options.patience:.0f} s: {missing}")

    def find(self, site: Site) -> None:
        """Waits for what the site does by itself."""
        print("nobody operates the site: it looks, follows and names by itself", flush=True)
        deadline = time.monotonic() + self.options.patience
        while not self.finding.holds(self.observer):
            self.turn(site, "the site looks for what flies")
            if time.monotonic() > deadline:
                raise SiteError(
                    f"no drone was found and tracked in {self.options.patience:.0f} s; "
                    "a scenario without detectors needs --operator"
                )

    def watch(self, site: Site) -> tuple[int, int]:
        """Runs for the asked time; the window [us] in which the run is judged."""
        seconds = self.options.seconds
        print(f"tracking for {seconds:.0f} s", flush=True)
        start_us = time.time_ns() // 1000
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            left = end - time.monotonic()
            self.turn(site, f"{at_work(self.observer)}, {left:.0f} s left")
        return start_us, time.time_ns() // 1000


def doorway() -> int | None:
    """The socket that ols_demo.doorway has opened for browsers, if the demo was started by it."""
    number = os.environ.get(VARIABLE)
    return int(number) if number else None


def report_of(options: argparse.Namespace) -> Path:
    return options.report or options.output / "report.json"


def plot_of(options: argparse.Namespace) -> Path:
    return report_of(options).with_suffix(".png")


def write_report(
    options: argparse.Namespace, window: tuple[int, int], log: Path, targets: set[int] | None
) -> dict:
    """targets: those that are judged; None: all."""
    recorded = recording.read(log)
    if targets is not None:
        evaluate.keep_targets(recorded, targets)
    result = {
        "scenario": options.scenario.stem,
        "seed": options.seed,
        **evaluate.report(recorded, window),
    }
    report, plotted = report_of(options), plot_of(options)
    report.parent.mkdir(parents=True, exist_ok=True)
    report.write_text(json.dumps(result, indent=1) + "\n")
    title = f"{options.scenario.stem}, seed {options.seed}"
    if result["fixes"]:
        title += (
            f": RMS error {result['rmse_m']:.3f} m, predicted {result['predicted_rmse_m']:.3f} m"
        )
        plot.save(plotted, recorded, window, title)
    print(f"report {report}")
    print(f"plot   {plotted if result['fixes'] else 'none: there is no fix'}\nlog    {log}")
    return result


def summary(result: dict) -> str:
    lines = []
    for name, station in result["stations"].items():
        lines.append(
            f"{name:10s} frames {station['frames_captured']} lost {station['frames_lost']}, "
            f"tracking {100 * station['tracking_fraction']:.1f} % of the time, "
            f"in the central third {100 * (station['central_third_fraction'] or 0):.1f} %"
        )
    if result["fixes"]:
        paper = result["paper"]["rmse_m"]
        lines.append(
            f"{result['fixes']} fixes, RMS error {result['rmse_m']:.3f} m "
            f"(predicted {result['predicted_rmse_m']:.3f} m"
            + (f"; the paper's estimator {paper:.3f} m)" if paper is not None else ")")
        )
        lines.append(
            f"exposure to published target: median {1e3 * result['latency']['p50_s']:.0f} ms, "
            f"95 % {1e3 * result['latency']['p95_s']:.0f} ms"
        )
    return "\n".join(lines)


def check_programs(binaries: Path, needed: list[str]) -> None:
    missing = [name for name in needed if not os.access(binaries / name, os.X_OK)]
    if missing:
        raise SiteError(
            f"{binaries} has no {', '.join(missing)}: build with "
            f"`tools/build release {' '.join(missing)}`, or name the folder with --bin"
        )


def replay(options: argparse.Namespace) -> int:
    """Shows a recorded log on the console until it is interrupted."""
    wiring = Wiring(options.bin, options.scenario, options.seed, options.output)
    check_programs(options.bin, ["ols-console"])
    bring_up_loopback([])
    with Site(options.output / "replay-logs") as site:
        address = wiring.start_console(site, doorway(), replay=options.console_only.resolve())
        print(f"the console replays it in a browser: {address}", flush=True)
        with open(site.logs / "ols-console.log") as said:
            while True:
                print(*(line for line in said if "[warning]" in line), sep="", end="", flush=True)
                time.sleep(0.5)
                site.check()


def demonstrate(options: argparse.Namespace) -> int:
    """Runs the site and reports on it."""
    wiring = Wiring(
        options.bin,
        options.scenario,
        options.seed,
        options.output,
        signed=True,
        unattended=not options.operator,
    )
    for former in (report_of(options), plot_of(options)):
        former.unlink(missing_ok=True)  # of a run that fails nothing is to be read
    check_programs(options.bin, PROGRAMS + ([] if options.headless else ["ols-console"]))
    bring_up_loopback(wiring.prepare())
    with Site(options.output / "logs") as site:
        wiring.start(site)
        if not options.headless:
            address = wiring.start_console(site, doorway())
            print(f"the console shows it in a browser: {address}", flush=True)
        in_site = write_in_site(options.output, options.bin, wiring.keys)
        print(f"commands to its stations: {in_site} ols-ctl all status", flush=True)
        run = Run(options, wiring.keys["OLS_KEYS"], options.operator)
        if options.operator:
            run.designate(site, wiring.tracking_stations)
        else:
            run.find(site)
        window = run.watch(site)
        print("ending the processes")
    drones = None if options.operator else run.finding.drones
    result = write_report(options, window, wiring.log, drones)
    print(summary(result))
    return 0 if result["fixes"] else 1


def main() -> int:
    options = arguments()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        return replay(options) if options.console_only else demonstrate(options)
    except (SiteError, OSError) as error:
        print(f"tools/demo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 0 if options.console_only else 130


if __name__ == "__main__":
    sys.exit(main())
