"""Judges a boot test from what was marked in the container and from the log of the bus.

    evaluate.py OUT_FOLDER UNITS_FOLDER

Prints a table; ends with 1 when a measure is missed, or was never taken.
"""

import math
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import lcm

EXPOSURE_LIMIT = 1.9
EVENTS = tomllib.loads((Path(__file__).parents[2] / "conditions/events.toml").read_text())
ALARM_BEGINS = "MESSAGE_ID=" + EVENTS["StationAlarmBegins"]["id"]
UNCONFINED = {"ols-station-restart.service"}  # installs packages


@dataclass
class Row:
    measure: str
    limit: str
    found: str
    passed: bool


class Evidence:
    """Marks of the script (s), and arrival times (s) of the messages by channel."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.marks: dict[str, float] = {}
        self.text: dict[str, str] = {}
        self.gave_up: list[str] = []
        for line in (folder / "events").read_text().splitlines():
            time_s, name, *text = line.split(" ", 2)
            self.text[name] = " ".join(text)
            if name == "gave-up":
                self.gave_up.append(self.text[name])
            elif name == "multi-user":  # the time of the event, not of the message
                self.marks[name] = float(text[0])
            else:
                self.marks[name] = float(time_s)
        self.arrivals: dict[str, list[float]] = {}
        for event in lcm.EventLog(str(folder / "bus.lcmlog"), "r"):
            self.arrivals.setdefault(event.channel, []).append(event.timestamp * 1e-6)

    def first(self, channel: str, after_s: float) -> float:
        return min((t for t in self.arrivals.get(channel, []) if t >= after_s), default=math.nan)

    def mark(self, name: str) -> float:
        return self.marks.get(name, math.nan)

    def read(self, name: str) -> str:
        path = self.folder / name
        return path.read_text() if path.exists() else ""


def within(measure: str, seconds: float, limit_s: float) -> Row:
    found = "never" if math.isnan(seconds) else f"{seconds:.1f} s"
    return Row(measure, f"<= {limit_s:g} s", found, seconds <= limit_s)


def said(measure: str, text: str, pattern: str) -> Row:
    match = re.search(pattern, text)
    return Row(measure, "said", match.group(0).strip() if match else "nothing", match is not None)


def starts(evidence: Evidence) -> list[Row]:
    rows = []
    for station in ("alfa", "bravo", "charlie", "lone"):
        status_s = evidence.first(f"OLS_STATUS_{station}", 0.0) - evidence.mark("multi-user")
        rows.append(within(f"first status of {station} after multi-user.target", status_s, 10.0))
    for station in ("alfa", "bravo", "charlie"):
        designated_s = evidence.first(f"OLS_DESIGNATE_{station}", 0.0)
        bearing_s = evidence.first(f"OLS_BEARING_{station}", designated_s) - designated_s
        rows.append(within(f"first bearing of {station} after designation", bearing_s, 3.0))
    tracking_s = evidence.mark("bravo-tracking")
    target_s = evidence.first("OLS_TARGET", tracking_s) - tracking_s
    rows.append(within("first target after the second station tracks", target_s, 3.0))
    return rows


def restarts(evidence: Evidence) -> list[Row]:
    rows = []
    for name, what, limit_s in (
        ("hang-station", "hung control loop of a station: replaced", 15.0),
        ("hang-fusion", "hung control loop of the fusion: replaced", 15.0),
        ("kill-station", "killed station: replaced", 5.0),
    ):
        took_s = evidence.mark(f"{name}-active") - evidence.mark(name)
        rows.append(within(what, took_s, limit_s))
    for name, what in (("hang-station", "hung"), ("kill-station", "killed")):
        took_s = evidence.mark(f"{name}-tracking") - evidence.mark(f"{name}-active")
        rows.append(within(f"{what} station tracks again by slew after its start", took_s, 8.0))
    watchdog = evidence.read("journal.txt").count("Watchdog timeout")
    rows.append(Row("ended by the watchdog, by the journal", "2", str(watchdog), watchdog == 2))
    return rows


def took(evidence: Evidence, name: str) -> float:
    """Since the mark before it."""
    before = [t for other, t in evidence.marks.items() if t < evidence.mark(name)]
    return evidence.mark(name) - max(before, default=math.nan)


def rest(evidence: Evidence) -> list[Row]:
    """The PTU, asked on its own line after the service was stopped in full motion."""
    took_s = evidence.mark("stop-station-rest") - evidence.mark("stop-station")
    stopped_s = evidence.mark("stop-station-done") - evidence.mark("stop-station")
    return [
        within("station stopped while its PTU turns", stopped_s, 5.0),
        within("PTU at rest by its own word", took_s, 5.0),
    ]


def doctor(measure: str, name: str, expected: set[str], evidence: Evidence) -> Row:
    failing = set(re.findall(r"^FAIL  (\w+):", evidence.read(name), flags=re.M))
    well = bool(re.search(r"^ok    ptu:", evidence.read(name), flags=re.M))
    shown = ", ".join(sorted(failing)) or "nothing"
    return Row(measure, ", ".join(sorted(expected)), shown, well and failing == expected)


def reported(evidence: Evidence) -> list[Row]:
    lone = evidence.read("status-text-lone.txt")
    nice = evidence.read("nice-alfa.txt")
    no_network = evidence.read("no-network.txt")
    explained = evidence.read("explained-lone.txt")
    route_s = evidence.mark("route-back") - evidence.mark("route-gone")
    healed_s = evidence.mark("network-answers") - evidence.mark("network")
    corrected_s = evidence.mark("wrong-answers") - evidence.mark("wrong-failed")
    restarts_done = evidence.text.get("wrong-failed", "never failed")
    return [
        said("station with nothing attached runs", evidence.read("status-lone.txt"), "running"),
        said("and says that the camera is missing", lone, r"camera[^;,]*"),
        said("and says that the PTU is missing", lone, r"ptu[^;,]*"),
        said("threads of a station are behind its loop", nice, r"(?m)^10$"),
        within("a route of the bus that goes comes back", route_s, 10.0),
        within("station starts without a network", took(evidence, "no-network-started"), 10.0),
        said("and says so", no_network, r"no bus"),
        within("and answers once there is one", healed_s, 10.0),
        said("wrong configuration is named", evidence.read("wrong.txt"), r"wrong\.toml:\d+: .*"),
        Row("and not run in circles", "0 restarts", restarts_done, restarts_done == "0"),
        within("corrected one is adopted automatically", corrected_s, 30.0),
        within("who stops it ends its next try too", took(evidence, "retry-stopped"), 10.0),
        within("an order without a signature is refused", took(evidence, "unsigned-refused"), 10.0),
        doctor("ols-doctor on a station: what fails", "doctor-alfa.txt", {"gnss"}, evidence),
        said(
            "its alarm is an event of the journal", evidence.read("events-lone.txt"), ALARM_BEGINS
        ),
        said("which the catalogue explains", explained, r"Station lone: an alarm begins"),
        said("no unit has failed in the end", evidence.read("failed.txt"), r"0 loaded units"),
    ]


def exposure(units: Path) -> list[Row]:
    rows = []
    for unit in sorted(units.glob("ols-*.service")):
        if unit.name in UNCONFINED:
            continue
        done = subprocess.run(
            ["systemd-analyze", "security", "--offline=yes", "--no-pager", str(unit)],
            capture_output=True,
            text=True,
            check=False,
        )
        match = re.search(r"Overall exposure level.*: ([\d.]+)", done.stdout)
        score = float(match.group(1)) if match else math.nan
        limit, passed = f"<= {EXPOSURE_LIMIT}", score <= EXPOSURE_LIMIT
        rows.append(Row(f"exposure of {unit.name}", limit, f"{score}", passed))
    return rows


def main(out: Path, units: Path) -> int:
    if not (out / "events").exists():
        sys.exit("boot test: the container did not come up; see build/boot-test/console.txt")
    evidence = Evidence(out)
    parts: list[Callable[[Evidence], list[Row]]] = [starts, restarts, rest, reported]
    rows = [row for part in parts for row in part(evidence)] + exposure(units)
    width = max(len(row.measure) for row in rows)
    for row in rows:
        verdict = "ok  " if row.passed else "FAIL"
        print(f"{verdict}  {row.measure:{width}}  {row.limit:>12}  {row.found}")
    if "done" not in evidence.marks:
        print("FAIL  the measurement did not come to its end")
    for text in evidence.gave_up:
        print(f"gave up waiting for: {text}")
    return 0 if all(row.passed for row in rows) and "done" in evidence.marks else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
