"""tools/soak: runs the simulated site for hours; memory, files and frames must stay constant."""

import argparse
import json
import signal
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib
import numpy as np
from ols_bench.processes import open_files, resident_bytes, threads
from ols_demo.bus import LIVE_URL, Bus, counters
from ols_demo.observer import Observer
from ols_demo.operator import Operator
from ols_demo.site import Site, SiteError, bring_up_loopback
from ols_demo.wiring import Wiring, add_site_options

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

SAMPLE_S = 5.0
DESIGNATION_S = 120.0
WARM_UP_SHARE = 0.2  # of the run, at least WARM_UP_S: caches fill, recordings begin
WARM_UP_S = 60.0
# "Flat": what a straight line through the samples after the warm-up grows over the judged time.
LIMITS = {"memory_MB": 2.0, "files": 0.5, "threads": 0.5}
LOST_SHARE = 0.01
NOT_OURS = ("lcm-logger", "gpsd")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/soak", description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0, help="after designation")
    parser.add_argument("--log", action="store_true", help="record the bus too (some GB an hour)")
    add_site_options(parser, "fig7", "soak")
    return parser.parse_args()


@dataclass
class Samples:
    """The resources of each process, every SAMPLE_S."""

    seconds: list[float] = field(default_factory=list)
    values: dict[str, dict[str, list[float]]] = field(default_factory=dict)  # process, quantity

    def take(self, site: Site, elapsed_s: float) -> None:
        self.seconds.append(elapsed_s)
        for name, process in site.processes.items():
            rows = self.values.setdefault(name, {quantity: [] for quantity in LIMITS})
            rows["memory_MB"].append(resident_bytes(process.pid) / 1e6)
            rows["files"].append(open_files(process.pid))
            rows["threads"].append(threads(process.pid))


@dataclass
class Frames:
    """Counters of the stations, from the first status after designation to the last."""

    first: dict[str, dict[str, float]] = field(default_factory=dict)
    last: dict[str, dict[str, float]] = field(default_factory=dict)
    boots: dict[str, set[int]] = field(default_factory=dict)

    def see(self, observer: Observer) -> None:
        for station, status in observer.status.items():
            self.boots.setdefault(station, set()).add(status.boot_id)
            self.last[station] = counters(status)
            self.first.setdefault(station, self.last[station])

    def of(self, station: str) -> dict[str, float]:
        def grown(name: str) -> float:
            return self.last[station].get(name, 0.0) - self.first[station].get(name, 0.0)

        lost = grown("frames_lost") + grown("frames_incomplete") + grown("frames_late")
        captured = grown("frames_captured")
        return {
            "captured": captured,
            "lost": lost,
            "of_these_late": grown("frames_late"),
            "lost_share": lost / max(1.0, captured + lost),
            "tracking_s": grown("seconds_tracking"),
            "restarts": len(self.boots[station]) - 1,
        }


def fitted_growth(seconds: np.ndarray, values: np.ndarray) -> float:
    """The growth of the regression line from the first to the last instant."""
    if len(seconds) < 3:
        return float("nan")
    slope = np.polyfit(seconds, values, 1)[0]
    return float(slope * (seconds[-1] - seconds[0]))


def judge(samples: Samples, frames: Frames) -> dict[str, object]:
    seconds = np.array(samples.seconds)
    judged = seconds >= max(WARM_UP_S, WARM_UP_SHARE * seconds[-1]) if len(seconds) else seconds > 0
    processes = {}
    for name, rows in samples.values.items():
        entry: dict[str, object] = {"judged": not name.startswith(NOT_OURS)}
        for quantity, limit in LIMITS.items():
            values = np.array(rows[quantity])
            grown = fitted_growth(seconds[judged], values[judged])
            entry[quantity] = {
                "first": values[judged][0] if judged.any() else float("nan"),
                "last": values[-1],
                "greatest": float(values.max()),
                "grown": grown,
                "flat": bool(grown <= limit),
            }
        processes[name] = entry
    stations = {station: frames.of(station) for station in sorted(frames.last)}
    flat = all(
        entry[quantity]["flat"]
        for entry in processes.values()
        if entry["judged"]
        for quantity in LIMITS
    )
    whole = all(
        s["lost_share"] <= LOST_SHARE and s["captured"] > 0 and s["restarts"] == 0
        for s in stations.values()
    )
    return {
        "seconds": seconds[-1] if len(seconds) else 0.0,
        "judged_s": float(seconds[-1] - seconds[judged][0]) if judged.any() else 0.0,
        "limits": {**LIMITS, "lost_share": LOST_SHARE},
        "processes": processes,
        "stations": stations,
        "passed": bool(flat and whole and stations),
    }


def table(result: dict[str, object]) -> str:
    lines = [
        f"{result['seconds'] / 60:.1f} min, judged the last {result['judged_s'] / 60:.1f} min; "
        f"flat: grown by at most {LIMITS['memory_MB']:g} MB, {LIMITS['files']:g} files or threads",
        "",
        "| process | memory first, last, grown | files first, last | threads | flat |",
        "|---|---|---|---|---|",
    ]
    for name, entry in result["processes"].items():
        memory, files, tasks = (entry[quantity] for quantity in LIMITS)
        flat = all(q["flat"] for q in (memory, files, tasks))
        verdict = ("yes" if flat else "NO") if entry["judged"] else "not judged"
        lines.append(
            f"| {name} | {memory['first']:.1f}, {memory['last']:.1f}, {memory['grown']:+.2f} MB "
            f"| {files['first']:.0f}, {files['last']:.0f} "
            f"| {tasks['first']:.0f}, {tasks['last']:.0f} | {verdict} |"
        )
    lines += ["", "| station | frames | lost | share | of these late | tracking |"]
    lines += ["|---|---|---|---|---|---|"]
    for name, s in result["stations"].items():
        lines.append(
            f"| {name} | {s['captured']:.0f} | {s['lost']:.0f} | {100 * s['lost_share']:.2f} % "
            f"| {s['of_these_late']:.0f} | {s['tracking_s']:.0f} s |"
        )
    return "\n".join([*lines, "", "passed" if result["passed"] else "FAILED"])


def plot(path: Path, samples: Samples) -> None:
    figure, axes = pyplot.subplots(2, 1, sharex=True, figsize=(9, 7))
    minutes = np.array(samples.seconds) / 60
    for axis, quantity, label in zip(
        axes, ("memory_MB", "files"), ("resident memory [MB]", "open files"), strict=True
    ):
        for name, rows in samples.values.items():
            axis.plot(minutes, rows[quantity], label=name)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=7)
    axes[-1].set_xlabel("time [min]")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def run(options: argparse.Namespace, site: Site, stations: list[str]) -> tuple[Samples, Frames]:
    observer = Observer()
    bus = Bus(LIVE_URL, observer.receive)
    operator = Operator(bus.lcm, observer, options.seed)

    def turn() -> None:
        bus.handle(0.05)
        operator.act()
        site.check()

    start = time.monotonic()
    while not operator.tracking.issuperset(stations):
        turn()
        if time.monotonic() - start > DESIGNATION_S:
            raise SiteError(f"not tracking after {DESIGNATION_S:.0f} s")
    samples, frames = Samples(), Frames()
    start, due = time.monotonic(), 0.0
    while (elapsed := time.monotonic() - start) < 60.0 * options.minutes:
        turn()
        if elapsed >= due:
            due = elapsed + SAMPLE_S
            samples.take(site, elapsed)
            frames.see(observer)
    return samples, frames


def main() -> int:
    options = arguments()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    wiring = Wiring(options.bin, options.scenario, options.seed, options.output)
    try:
        bring_up_loopback(wiring.prepare())
        with Site(options.output / "logs") as site:
            wiring.start(site, log=options.log)
            samples, frames = run(options, site, wiring.stations)
    except SiteError as error:
        print(f"tools/soak: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    result = judge(samples, frames)
    (options.output / "soak.json").write_text(json.dumps(result, indent=1, default=float) + "\n")
    (options.output / "soak.md").write_text(f"# Soak\n\n{table(result)}\n")
    plot(options.output / "soak.png", samples)
    print(f"{table(result)}\n\n{options.output / 'soak.md'}, .json, .png")
    return 0 if result["passed"] else 1


if __name__ == "__main__":
    sys.exit(main())
