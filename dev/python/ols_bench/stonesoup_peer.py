"""Stone Soup's extended Kalman filter on the bearings written by ols-bench-estimators, next to our
filter: errors run by run, processor time a bearing.

Both know the true motion (constant velocity with white noise of the acceleration), the true noise
and the stations' places. Stone Soup starts a metre off the truth; ours initiates its own track.
Exits with 1 where ours is less accurate, or not that many times faster.
"""

import argparse
import csv
import json
import math
import sys
import time
from collections import defaultdict
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
from stonesoup.models.measurement.nonlinear import CartesianToElevationBearing
from stonesoup.models.transition.linear import (
    CombinedLinearGaussianTransitionModel,
    ConstantVelocity,
)
from stonesoup.predictor.kalman import ExtendedKalmanPredictor
from stonesoup.types.angle import Bearing, Elevation
from stonesoup.types.array import StateVector
from stonesoup.types.detection import Detection
from stonesoup.types.hypothesis import SingleHypothesis
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import ExtendedKalmanUpdater

from ols_bench.markdown import table

WARM_S = 4.0
LEAST_TIMES_FASTER = 300.0
START = datetime(2024, 1, 1)
PLACES = ("east_m", "north_m", "up_m")


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def by_run(path):
    runs = defaultdict(list)
    for row in rows(path):
        runs[int(row["run"])].append(row)
    return runs


def measurement_model(place, elevation, noise_rad):
    """x is east, y north; the variance of the bearing is that across the line of sight."""
    return CartesianToElevationBearing(
        ndim_state=6,
        mapping=(0, 2, 4),
        noise_covar=np.diag([noise_rad**2, (noise_rad / math.cos(elevation)) ** 2]),
        translation_offset=StateVector(place),
    )


def detections(bearings, stations, noise_rad):
    made = []
    for row in bearings:
        elevation = float(row["elevation_rad"])
        bearing = math.pi / 2 - float(row["azimuth_rad"])
        model = measurement_model(stations[row["station"]], elevation, noise_rad)
        vector = StateVector([[Elevation(elevation)], [Bearing(bearing)]])
        when = START + timedelta(seconds=float(row["time_s"]))
        made.append(Detection(vector, timestamp=when, measurement_model=model))
    return made


def track(seen, truth, disturbance):
    """Positions after each bearing, and the processor time [s] of predictions and updates."""
    motion = CombinedLinearGaussianTransitionModel([ConstantVelocity(disturbance**2)] * 3)
    predictor, updater = ExtendedKalmanPredictor(motion), ExtendedKalmanUpdater(None)
    velocity = (truth[30] - truth[0]) / (seen[30].timestamp - seen[0].timestamp).total_seconds()
    mean = np.ravel(np.column_stack([truth[0] + 1.0, velocity]))
    state = GaussianState(mean, np.diag([5.0, 10.0] * 3) ** 2, timestamp=seen[0].timestamp)
    positions = []
    begun = time.process_time()
    for detection in seen:
        prediction = predictor.predict(state, timestamp=detection.timestamp)
        state = updater.update(SingleHypothesis(prediction, detection))
        positions.append(state.state_vector[[0, 2, 4], 0])
    used = time.process_time() - begun
    return np.array(positions, dtype=float), used


def compare(folder):
    """Of each run the two RMSEs [m]; processor time a bearing of both [us], medians of the runs."""
    pinned = {k: float(v) for k, v in rows(folder / "pinned.csv")[0].items()}
    stations = {
        row["station"]: np.array([[float(row[k])] for k in PLACES])
        for row in rows(folder / "stations.csv")
    }
    bearings, fixes = by_run(folder / "bearings.csv"), by_run(folder / "fixes.csv")
    ours, theirs, cpu_us = [], [], []
    for run, own in bearings.items():
        truth = np.array([[float(row[f"true_{k}"]) for k in PLACES] for row in fixes[run]])
        judged = np.array([float(row["time_s"]) >= WARM_S for row in own])
        here = [[float(row[k] or "nan") for k in PLACES] for row in fixes[run]]
        there, seconds = track(
            detections(own, stations, pinned["noise_rad"]), truth, pinned["disturbance"]
        )
        cpu_us.append(1e6 * seconds / len(own))
        for estimate, sums in ((np.array(here), ours), (there, theirs)):
            squared = ((estimate - truth)[judged] ** 2).sum(axis=1)
            sums.append(math.sqrt(squared.mean()))
    return np.array(ours), np.array(theirs), pinned["cpu_us"], float(np.median(cpu_us))


def summary(ours, theirs, our_us, their_us):
    ratios = ours / theirs
    half = 1.96 * ratios.std(ddof=1) / math.sqrt(len(ratios))
    return {
        "runs": len(ours),
        "rmse_m": math.sqrt((ours**2).mean()),
        "stonesoup_rmse_m": math.sqrt((theirs**2).mean()),
        "ratio_mean": ratios.mean(),
        "ratio_95": [ratios.mean() - half, ratios.mean() + half],
        "cpu_us": our_us,
        "stonesoup_cpu_us": their_us,
        "times_faster": their_us / our_us,
    }


def misses(figures):
    """The limits that are not met, as text."""
    said = []
    if not figures["ratio_95"][0] <= 1.0:
        said.append("less accurate than Stone Soup's filter")
    if not figures["times_faster"] >= LEAST_TIMES_FASTER:
        said.append(f"not {LEAST_TIMES_FASTER:.0f} times faster")
    return said


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="as ols-bench-estimators --write-peer wrote it")
    folder = parser.parse_args().folder
    figures = summary(*compare(folder))
    (folder / "peer.json").write_text(json.dumps(figures, indent=1) + "\n")
    low, high = figures["ratio_95"]
    ours, theirs = figures["cpu_us"], figures["stonesoup_cpu_us"]
    rows = [
        ["RMSE", f"{figures['rmse_m']:.4f} m", f"{figures['stonesoup_rmse_m']:.4f} m"],
        ["processor time a bearing", f"{ours:.1f} us", f"{theirs:.0f} us"],
        ["RMSE over Stone Soup's, 95 %", f"{low:.4f} to {high:.4f}", "1"],
        ["times faster", f"{figures['times_faster']:.0f}", "1"],
    ]
    print(table([f"{figures['runs']} paired runs", "ours", "Stone Soup's EKF"], rows))
    for miss in misses(figures):
        print(f"stonesoup_peer: MISS: {miss}", file=sys.stderr)
    return 1 if misses(figures) else 0


if __name__ == "__main__":
    sys.exit(main())
