"""What a calibration of all stations makes of the fusion's positions (tools/bench new-units)."""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCENARIO = ROOT / "sim/scenarios/new_units.toml"
STATIONS = ("alfa", "bravo", "charlie", "delta")


def run(*command, codes=(0,)):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        raise SystemExit(f"{command[0]}: {done.stderr.strip()}")


def calibrate(bin_folder, stem, output):
    run(
        *(bin_folder / "ols-calibrate", "adjust", "--station", f"{stem}.toml"),
        *("--observations", f"{stem}.observations.jsonl"),
        *("--references", f"{stem}.references.csv"),
        *("--pressure", 980, "--temperature", 10, "--ut1-utc", 0.03, "--output", output),
        codes=(0, 1),  # 1: a landmark has moved, as the scenario says, and is rejected
    )


def flight(bin_folder, seed, seconds):
    """The fusion's figures of one flight, before and after."""
    simulate = (bin_folder / "ols-sim", "--scenario", SCENARIO, "--seed", seed)
    with tempfile.TemporaryDirectory(prefix="ols-new-units-") as name:
        folder = Path(name)
        run(*simulate, "--write-observations", folder / "round")
        for station in STATIONS:
            calibrate(bin_folder, folder / "round" / station, folder / "calibrations" / station)
        figures = []
        for output, more in (
            ("before", ()),
            ("after", ("--calibrations", folder / "calibrations")),
        ):
            lockstep = ("--lockstep", "--pixels", "--seconds", seconds)
            run(*simulate, *lockstep, "--output", folder / output, *more)
            figures.append(json.loads((folder / output / "summary.json").read_text())["joint"])
        return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--flights", type=int, default=5, help="each of other units")
    parser.add_argument("--seconds", type=float, default=30.0, help="of each flight")
    parser.add_argument("--seed", type=int, default=1, help="of the first")
    parser.add_argument("--programs", type=Path, default=ROOT / "build/release/bin")
    arguments = parser.parse_args()
    print(f"{'seed':>4} {'before [m]':>11} {'NEES':>6} {'after [m]':>11} {'NEES':>6}")
    all_figures = []
    for seed in range(arguments.seed, arguments.seed + arguments.flights):
        before, after = flight(arguments.programs, seed, arguments.seconds)
        row = [before["rmse_m"], before["nees"], after["rmse_m"], after["nees"]]
        all_figures.append(row)
        print("{:4d} {:11.3f} {:6.2f} {:11.4f} {:6.2f}".format(seed, *row), flush=True)
    figures = np.array(all_figures)
    before_m, after_m = np.sqrt(np.mean(figures[:, [0, 2]] ** 2, axis=0))
    before_nees, after_nees = np.mean(figures[:, [1, 3]], axis=0)
    print(f"{'all':>4} {before_m:11.3f} {before_nees:6.2f} {after_m:11.4f} {after_nees:6.2f}")
    ok = after_m < before_m / 5 and 0.5 <= after_nees <= 2
    print(f"{before_m / after_m:.1f} times less: {'ok' if ok else 'MISSED'}")
    sys.exit(0 if ok else 1)


if __name__ == "__main__":
    main()
