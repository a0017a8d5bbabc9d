"""Measures ols-batch on an archive of 200 simulated hours: beside ols-fuse, with two workers
killed, and against one run of the estimators that is not cut into hours. On a machine that does
nothing else; the load before is printed.
"""

import argparse
import hashlib
import json
import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import duckdb
import numpy as np
import ols
from ols_archive.archiver import Archiver

from ols_bench import flights
from ols_bench.uncut import compare, uncut_fixes

SEED = 23
CSV = """
COPY (
  SELECT utime AS utime_us, station, degrees(azimuth_rad) AS azimuth_deg,
         degrees(elevation_rad) AS elevation_deg,
         degrees(sqrt(covariance_white_rad2[1])) AS sigma_deg, belief
  FROM read_parquet('{archive}/bearing/*/*/*/bearing.parquet') ORDER BY utime, station
) TO '{path}' (HEADER)
"""


CROSSING = 10  # of so many flights one crosses the border of two hours


def make_archive(folder: Path, hours: int, seconds: float, rate_hz: float) -> int:
    random = np.random.default_rng(SEED)
    archiver = Archiver(folder, "bench")
    planned = flights.schedule(hours, seconds, random, CROSSING)
    for message in flights.bearings(planned, rate_hz, random):
        channel = f"OLS_BEARING_{message.station}"
        archiver.take(message.utime, channel, message.encode(), b"", "simulated")
    archiver.flush()
    return archiver.tally.counts["added"]


def write_csv(archive: Path, folder: Path) -> tuple[Path, Path]:
    """The same bearings as ols-fuse reads them."""
    stations, bearings = folder / "stations.csv", folder / "bearings.csv"
    lines = ["station,latitude_deg,longitude_deg,height_m,position_sd_m,pointing_sd_deg"]
    for name, place_ecef in flights.CAMERAS.items():
        at = ols.geodetic_from_ecef(place_ecef)
        latitude_deg, longitude_deg = math.degrees(at.latitude_rad), math.degrees(at.longitude_rad)
        sd = f"{flights.PLACE_SD_M},{math.degrees(flights.HEADING_RAD)}"
        lines.append(f"{name},{latitude_deg:.10f},{longitude_deg:.10f},{at.height_m:.5f},{sd}")
    stations.write_text("\n".join(lines) + "\n")
    duckdb.sql(CSV.format(archive=archive, path=bearings))
    return stations, bearings


class Timed:
    """A command, its time and the processor's."""

    def __init__(self, command: list, beside=None):
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        begin_s = time.monotonic()
        process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL)
        if beside is not None:
            threading.Thread(target=beside, args=(process,), daemon=True).start()
        self.code = process.wait()
        self.seconds = time.monotonic() - begin_s
        now = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.processor_s = now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime


def workers_of(pid: int) -> list[int]:
    """The processes in which a running ols-batch has its tasks done."""
    lists = Path(f"/proc/{pid}/task").glob("*/children")  # any thread may have started them
    found = []
    for child in sorted(" ".join(one.read_text() for one in lists).split()):
        try:
            words = Path(f"/proc/{child}/cmdline").read_bytes()
        except FileNotFoundError:
            continue
        if b"spawn_main" in words:
            found.append(int(child))
    return found


def done_in(output: Path) -> int:
    return sum(1 for _ in output.glob("fixes/*/*/*/fixes.parquet"))


class Killer:
    """Kills a worker whenever so many hours are done."""

    def __init__(self, output: Path, after: list[int]):
        self._output, self._after = output, after
        self.killed: list[int] = []

    def __call__(self, process: subprocess.Popen) -> None:
        for count in self._after:
            while done_in(self._output) < count and process.poll() is None:
                time.sleep(0.01)
            victims = [pid for pid in workers_of(process.pid) if pid not in self.killed]
            if process.poll() is None and victims:
                os.kill(victims[0], signal.SIGKILL)
                self.killed.append(victims[0])


def digests(output: Path) -> dict[str, str]:
    return {
        str(path.relative_to(output)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in [*output.glob("fixes/**/*.parquet"), output / "identities.parquet"]
    }


def batch(archive: Path, output: Path, *options: str) -> list:
    return [sys.executable, "-m", "ols_batch", archive, output, "--no-plots", *options]


def measure(arguments: argparse.Namespace, folder: Path) -> dict:
    archive, cut, killed = folder / "archive", folder / "cut", folder / "killed"
    count = make_archive(archive, arguments.hours, arguments.flight_s, arguments.rate)
    print(f"seed {SEED}: {arguments.hours} hours, {count} bearings", flush=True)
    options = ["--workers", str(arguments.workers), "--warm-up-s", str(arguments.warm_up_s)]
    whole = Timed(batch(archive, cut, *options))
    again = Timed(batch(archive, cut, *options))
    killer = Killer(killed, [arguments.hours // 4, arguments.hours // 2])
    shot = Timed(batch(archive, killed, *options), killer)
    stations, bearings = write_csv(archive, folder)
    files = ["--stations", stations, "--bearings", bearings, "--output", folder / "fixes.csv"]
    fuse = Timed([arguments.fuse, *files])
    first_us = flights.START_US + round(arguments.warm_up_s * 1e6)
    compared = compare(uncut_fixes(archive), killed, first_us)
    return {
        "hours": arguments.hours,
        "bearings": count,
        "batch_s": whole.seconds,
        "batch_processor_s": whole.processor_s,
        "again_s": again.seconds,
        "with_killed_workers_s": shot.seconds,
        "workers_killed": len(killer.killed),
        "exit_codes": [whole.code, again.code, shot.code, fuse.code],
        "same_bytes_as_unharmed": digests(cut) == digests(killed),
        "ols_fuse_s": fuse.seconds,
        "ols_fuse_processor_s": fuse.processor_s,
        "times_ols_fuse": fuse.seconds / whole.seconds,
        # What that would be if every process had its processor for itself.
        "times_ols_fuse_alone": fuse.processor_s * arguments.workers / whole.processor_s,
        "against_uncut": compared.__dict__ | {"is_same": compared.is_same},
        "load_after": os.getloadavg()[0],
    }


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/bench batch", description=__doc__)
    parser.add_argument("--hours", type=int, default=200)
    parser.add_argument("--flight-s", type=float, default=60.0, help="[s] of each hour's flight")
    parser.add_argument("--rate", type=float, default=10.0, help="[Hz] of each station")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--warm-up-s", type=float, default=1800.0)
    parser.add_argument("--fuse", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--report", type=Path)
    arguments = parser.parse_args()
    print("load before:", os.getloadavg()[0])
    with tempfile.TemporaryDirectory(prefix="ols-bench-batch-") as folder:
        result = measure(arguments, Path(folder))
    text = json.dumps(result, indent=2)
    print(text)
    if arguments.report:
        arguments.report.write_text(text + "\n")
    good = result["same_bytes_as_unharmed"] and result["against_uncut"]["is_same"]
    return 0 if good and result["workers_killed"] == 2 and not any(result["exit_codes"]) else 1


if __name__ == "__main__":
    sys.exit(main())
