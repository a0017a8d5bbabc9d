"""Runs the paper's experiments in the lockstep simulation, and reads what they leave behind."""

import csv
import json
import os
import subprocess
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
SCENARIOS = ROOT / "sim/scenarios"
PROGRAMS = Path(os.environ.get("OLS_BIN", ROOT / "build/release/bin"))
WALK_SECONDS, STATIC_SECONDS = 123.0, 5.0
START_UTIME_US = 1_700_000_000_000_000  # of the lockstep simulation
WALK = "walk"  # stands for the walk where targets of table1.toml are named

# The errors of the scenario that each source is made of.
SOURCES = {
    "heading": ("heading",),
    "tilt": ("tilt",),
    "mounting": ("mounting",),
    "position": ("position",),
    "distortion": ("distortion",),
    "timing": ("clock", "ptu_reply"),
}
STAYING = tuple(
    error for source, errors in SOURCES.items() if source != "timing" for error in errors
)
# How the stations found their headings.
LANDMARKS, EACH_OTHER = "landmarks", "each-other"
# The errors in a run with images: random errors only, or all after a stationing of either kind.
RANDOM = "random"
KINDS = (RANDOM, LANDMARKS, EACH_OTHER)


@dataclass(frozen=True)
class Run:
    """One lockstep run; its files are kept in `folder` and not made twice."""

    folder: Path
    scenario: str
    seed: int
    seconds: float
    stationing: str
    target: str = ""
    without: tuple[str, ...] = ()
    pictures: bool = True

    def command(self) -> list[str]:
        command = [PROGRAMS / "ols-sim", "--lockstep", "--scenario", f"{self.scenario}.toml"]
        command += ["--seed", self.seed, "--seconds", self.seconds, "--output", self.folder]
        command += ["--stationing", self.stationing]
        if self.target:
            command += ["--target", self.target]
        if self.without:
            command += ["--without", ",".join(self.without)]
        if not self.pictures:
            command += ["--pixels", "--pixel-sd", 0.3]
        return [str(part) for part in command]

    def made(self) -> bool:
        return (self.folder / "summary.json").exists()

    def make(self) -> None:
        if not self.made():
            subprocess.run(self.command(), cwd=SCENARIOS, check=True)

    def bound_m(self) -> float | None:
        return json.loads((self.folder / "summary.json").read_text())["crb_horizontal_rmse_m"]

    def errors_enu(self, estimator: str = "fixes") -> np.ndarray:
        """(n, 3) east, north, up errors of the fixes [m]."""
        rows = self.rows(estimator)
        keys = ("error_east_m", "error_north_m", "error_up_m")
        return np.array([[float(row[key]) for key in keys] for row in rows]).reshape(-1, 3)

    def rows(self, name: str) -> list[dict]:
        with open(self.folder / f"{name}.csv", newline="") as file:
            return list(csv.DictReader(file))

    def frames_on_target(self) -> tuple[float, np.ndarray]:
        """Share of all stations' frames in which the target itself was tracked, and of each fix
        whether it was by all of them at that time."""
        rows = self.rows("frames")
        times = np.array([float(row["time_s"]) for row in rows])
        on = np.array([on_target(row) for row in rows])
        stations = np.array([row["station"] for row in rows])
        fixes = [1e-6 * (int(row["utime_us"]) - START_UTIME_US) for row in self.rows("fixes")]
        by_all = np.ones(len(fixes), dtype=bool)
        for station in np.unique(stations):
            own = np.flatnonzero(stations == station)
            nearest = np.abs(np.subtract.outer(fixes, times[own])).argmin(axis=1)
            by_all &= on[own][nearest]
        return float(on.mean()), by_all


def on_target(row: dict) -> bool:
    """A row of frames.csv: the pixel that was tracked is inside the target's box."""
    if row["state"] != "tracking" or not row["error_x_px"]:
        return False
    off = (2 * abs(float(row[f"error_{axis}_px"])) for axis in "xy")
    size = (float(row[f"{side}_px"]) for side in ("width", "height"))
    return all(a < b for a, b in zip(off, size, strict=True))


def make_all(runs: Iterable[Run], jobs: int) -> None:
    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(Run.make, runs))


def _run(place: Path, target: str, seed: int, **options: object) -> Run:
    if target == WALK:
        return Run(place, "walk", seed, WALK_SECONDS, **options)
    return Run(place, "table1", seed, STATIC_SECONDS, target=target, **options)


def picture_run(folder: Path, kind: str, target: str, seed: int) -> Run:
    """Rendered images and the real tracker; `kind` is one of KINDS."""
    place = folder / "pictures" / kind / target / f"seed{seed}"
    if kind == RANDOM:
        return _run(place, target, seed, stationing=LANDMARKS, without=STAYING)
    return _run(place, target, seed, stationing=kind)


def budget_run(folder: Path, stationing: str, source: str, target: str, seed: int) -> Run:
    """One source alone ("none": not one of them, "all"), with drawn pixels."""
    others = [errors for name, errors in SOURCES.items() if source not in ("all", name)]
    without = tuple(error for errors in others for error in errors)
    place = folder / "budget" / stationing / source / target / f"seed{seed}"
    return _run(place, target, seed, stationing=stationing, without=without, pictures=False)


def horizontal(errors_enu: np.ndarray) -> np.ndarray:
    """Distances [m], as in the paper: only the horizontal position is considered."""
    return np.hypot(errors_enu[:, 0], errors_enu[:, 1])


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def usable(runs: Iterable[Run]) -> list[Run]:
    """Those that were made and have fixes of two stations: without such a fix there is no bound."""
    return [run for run in runs if run.made() and run.bound_m() is not None]


def left_out(runs: Iterable[Run]) -> list[Run]:
    """Those that were made and are not usable."""
    return [run for run in runs if run.made() and run.bound_m() is None]


def mean_error(runs: Iterable[Run], estimator: str = "fixes") -> float:
    """Root mean square horizontal error [m] over the usable runs; NaN without any."""
    errors = [horizontal(run.errors_enu(estimator)) for run in usable(runs)]
    values = [rms(each) for each in errors if len(each) > 0]
    return rms(np.array(values)) if values else np.nan


def mean_bound(runs: Iterable[Run]) -> float:
    """The same of the Cramer-Rao bound at the runs' fixes."""
    values = [run.bound_m() for run in usable(runs)]
    return rms(np.array(values)) if values else np.nan
