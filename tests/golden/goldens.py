"""Golden runs: bearing logs and simulated sites in lockstep, and what came out of them
when a person last looked. `tools/goldens` runs and accepts them; test_goldens.py fails on any
difference.

How much may differ: another compiler or processor rounds differently, because libm and OpenCV
choose their instructions at run time. Without FMA in libm, and without AVX2 in OpenCV, the printed
values (6 to 12 digits) changed by at most 1e-7 of their column's size. A value is the same when it
differs by at most TOLERANCE of its size, or of the median of its column where it is near zero;
latitude and longitude by a millimetre on the ground. Words, stations, ids, stamps and counts must
be equal. With --exact every character must be.
"""

import csv
import math
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import make_log

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(__file__).resolve().parent
BUILD = Path(os.environ.get("OLS_BUILD", ROOT / "build/release"))
TOLERANCE = 1e-5
DEGREES_OF_A_MILLIMETRE = 1e-8
# One row in so many is kept of a file: filters and trackers carry a difference on, and the
# counters have how many rows there are.
KEPT_OF = {"targets.csv": 6, "slews.csv": 15, "frames.csv": 8, "fixes.csv": 3}


@dataclass(frozen=True)
class Golden:
    name: str
    files: tuple[str, ...]
    command: tuple[str, ...]  # OUTPUT stands for the folder of its files

    def folder(self) -> Path:
        return FOLDER / self.name

    def run(self, output: Path) -> None:
        output.mkdir(parents=True, exist_ok=True)
        make_log.write(output)
        command = [part.replace("OUTPUT", str(output)) for part in self.command]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {done.stderr.strip()}")


def lockstep(name: str, scenario: str, seconds: int, seed: int, *options: str) -> Golden:
    path = next(ROOT.glob(f"**/sim/scenarios/{scenario}.toml"))
    return Golden(
        name,
        ("fixes.csv", "slews.csv", "frames.csv", "counters.csv"),
        (
            *(str(BUILD / "bin/ols-sim"), "--scenario", str(path), "--seed", str(seed)),
            *("--lockstep", "--seconds", str(seconds), "--output", "OUTPUT", *options),
        ),
    )


def offline(name: str, *options: str) -> Golden:
    command = (str(BUILD / "bin/ols-fuse"), "--stations", str(FOLDER / "offline_stations.csv"))
    files = ("--bearings", "OUTPUT/clean.csv", "--output", "OUTPUT/fixes.csv")
    return Golden(name, ("fixes.csv",), (*command, *files, "--rate", "3", *options))


GOLDENS = (
    Golden(
        "two_drones",
        ("targets.csv", "slews.csv", "counters.csv"),
        (
            str(BUILD / "tests/ols-golden-replay"),
            *(str(FOLDER / "stations.csv"), "OUTPUT/heard.csv", "OUTPUT"),
        ),
    ),
    Golden("paper_mode", ("frames.csv",), (str(BUILD / "tests/ols-golden-paper-mode"), "OUTPUT")),
    offline("offline_filter"),
    offline("offline_smooth", "--smooth"),
    offline("offline_least_squares", "--estimator", "least-squares"),
    offline("offline_paper", "--estimator", "paper"),
    lockstep("fig7_pixels", "fig7", 9, 1, "--pixels"),
    lockstep("servo_pixels", "servo", 9, 3, "--pixels"),
    lockstep("small_pictures", "small", 12, 1),
    lockstep("skyline_pictures", "skyline", 6, 2),
)


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def kept(name: str, rows: list[dict[str, str]]) -> list[dict[str, str]]:
    """Of counters those that are not zero; of others one row in so many."""
    if name == "counters.csv":
        return [row for row in rows if row["value"] != "0"]
    return rows[:: KEPT_OF.get(name, 1)]


def with_zeros(was: list[dict[str, str]], now: list[dict[str, str]]) -> list[dict[str, str]]:
    """Counters that were zero are not kept."""
    values = {(row["of"], row["counter"]): row["value"] for row in was}
    rows = [{**row, "value": values.pop((row["of"], row["counter"]), "0")} for row in now]
    return rows + [{"of": of, "counter": name, "value": v} for (of, name), v in values.items()]


def number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None


def is_whole(cell: str) -> bool:
    """As counts are."""
    return cell.removeprefix("-").isdigit()


def is_exact(column: str) -> bool:
    return column.startswith(("utime", "effect_utime", "target", "counter", "station"))


def same(column: str, was: str, now: str, size: float) -> bool:
    if was == now:
        return True
    a, b = number(was), number(now)
    if is_whole(was) and is_whole(now):
        return False
    if a is None or b is None or is_exact(column) or math.isnan(a) != math.isnan(b):
        return False
    if column in ("latitude_deg", "longitude_deg"):
        return abs(a - b) <= DEGREES_OF_A_MILLIMETRE
    return abs(a - b) <= TOLERANCE * max(abs(a), size)


def sizes(rows: list[dict[str, str]]) -> dict[str, float]:
    """The median magnitude of each column."""
    found = {}
    for column in rows[0] if rows else ():
        values = [abs(value) for row in rows if (value := number(row[column])) is not None]
        values = sorted(value for value in values if math.isfinite(value))
        found[column] = values[len(values) // 2] if values else 0.0
    return found


def told(row: dict[str, str]) -> str:
    """Which target, station or counter a row is of, and when."""
    names = ("of", "counter", "utime_us", "time_s", "station", "target", "estimator")
    return ", ".join(f"{name} {row[name]}" for name in names if name in row)


def row_differences(was: dict[str, str], now: dict[str, str], size: dict[str, float]) -> list[str]:
    differences = [f"column {column} is new" for column in now if column not in was]
    for column, cell in was.items():
        new = now.get(column, "no such column")
        if not same(column, cell, new, size[column]):
            a, b = number(cell), number(new)
            by = f" (by {b - a:.3g})" if a is not None and b is not None else ""
            differences.append(f"{column} was {cell}, is {new}{by}")
    return differences


def file_differences(name: str, was: list[dict], now: list[dict]) -> list[str]:
    differences = []
    size = sizes(was)
    for old, new in zip(was, now, strict=False):
        changed = row_differences(old, new, size)
        if changed:
            differences.append(f"{name}: {told(old)}: {'; '.join(changed)}")
    if len(was) != len(now):
        differences.append(f"{name}: {len(was)} rows, now {len(now)}")
    return differences


def differences(golden: Golden, output: Path, exact: bool = False) -> list[str]:
    """One line for each row that differs."""
    found = []
    for name in golden.files:
        was, now = rows_of(golden.folder() / name), rows_of(output / name)
        if exact and was != kept(name, now):
            found.append(f"{name}: not the same to the last character")
        if name == "counters.csv":
            found += file_differences(name, with_zeros(was, now), now)
        else:
            found += file_differences(name, was, kept(name, now))
    return found


def accept(golden: Golden, output: Path) -> None:
    golden.folder().mkdir(exist_ok=True)
    for name in golden.files:
        rows = rows_of(output / name)
        with (golden.folder() / name).open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(kept(name, rows))
