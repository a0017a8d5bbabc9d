"""Runs the paper's experiments in the lockstep simulation, and reads what they leave behind."""

import csv
import json
import subprocess
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
SCENARIOS = ROOT / "tools/sim/scenarios"
PROGRAMS = ROOT / "build/release/bin"
STAYING = ("heading", "tilt", "mounting", "position", "distortion")
WALK_SECONDS, STATIC_SECONDS, PIXEL_SECONDS = 123.0, 5.0, 5.0


@dataclass(frozen=True)
class Run:
    """One lockstep run; its files are kept in `folder` and not made twice."""

    folder: Path
    scenario: str
    seed: int
    seconds: float
    target: str = ""
    without: tuple[str, ...] = ()
    pictures: bool = True

    def command(self) -> list[str]:
        command = [PROGRAMS / "ols-sim", "--lockstep", "--scenario", f"{self.scenario}.toml"]
        command += ["--seed", self.seed, "--seconds", self.seconds, "--output", self.folder]
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

    def summary(self) -> dict:
        return json.loads((self.folder / "summary.json").read_text())

    def errors_enu(self, estimator: str = "fixes") -> np.ndarray:
        """(n, 3) east, north, up errors of the fixes [m]."""
        rows = self.fixes(estimator)
        keys = ("error_east_m", "error_north_m", "error_up_m")
        return np.array([[float(row[key]) for key in keys] for row in rows]).reshape(-1, 3)

    def fixes(self, estimator: str = "fixes") -> list[dict]:
        with open(self.folder / f"{estimator}.csv", newline="") as file:
            return list(csv.DictReader(file))


def make_all(runs: Iterable[Run], jobs: int) -> None:
    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(Run.make, runs))


def table1_run(folder: Path, kind: str, target: str, seed: int) -> Run:
    """`kind`: "random", without the errors that stay, or "all"."""
    without = STAYING if kind == "random" else ()
    place = folder / "table1" / kind / target / f"seed{seed}"
    return Run(place, "table1", seed, STATIC_SECONDS, target, without)


def walk_run(folder: Path, kind: str, seed: int) -> Run:
    without = STAYING if kind == "random" else ()
    return Run(folder / "walk" / kind / f"seed{seed}", "walk", seed, WALK_SECONDS, "", without)


def budget_run(folder: Path, source: str, target: str, seed: int) -> Run:
    """One staying error alone ("none": not one of them, "all"), with drawn pixels."""
    without = () if source == "all" else tuple(error for error in STAYING if error != source)
    place = folder / "budget" / source / target / f"seed{seed}"
    return Run(place, "table1", seed, PIXEL_SECONDS, target, without, pictures=False)


def horizontal(errors_enu: np.ndarray) -> np.ndarray:
    """Distances [m], as in the paper: only the horizontal position is considered."""
    return np.hypot(errors_enu[:, 0], errors_enu[:, 1])


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
