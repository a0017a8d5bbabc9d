"""What the rows of ols-bench-tracker say, point by point."""

import csv
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ols_bench.measures import BELIEVED, LOCK_SHARE, NEAR_PX

FRAMES_PER_SECOND = 30.0
HIDDEN_SWEEPS = ("occlusion_blank", "occlusion_clouds", "occlusion_woods")
REACQUIRED_IN_S = 1.0
COLUMNS = (
    "true_x",
    "true_y",
    "x",
    "y",
    "visible",
    "var_x",
    "var_y",
    "belief",
    "bound_x",
    "bound_y",
)


@dataclass
class Track:
    """One run; the first frame is the initialisation."""

    visible: np.ndarray
    error: np.ndarray  # frames x 2 [px], relative to the initialisation
    variance: np.ndarray  # frames x 2 [px^2]
    bound: np.ndarray  # frames x 2 [px^2]
    belief: np.ndarray

    @property
    def near(self) -> np.ndarray:
        return self.visible & (np.hypot(*self.error.T) <= NEAR_PX)


@dataclass
class Point:
    sweep: str
    value: float
    tracks: list[Track]


def track_of(rows: list[dict]) -> Track:
    v = {name: np.array([float(row[name]) for row in rows]) for name in COLUMNS}
    error = np.stack([v["x"] - v["true_x"], v["y"] - v["true_y"]], axis=1)
    rest = slice(1, None)
    return Track(
        visible=v["visible"][rest] > 0,
        error=(error - error[0])[rest],
        variance=np.stack([v["var_x"], v["var_y"]], axis=1)[rest],
        bound=np.stack([v["bound_x"], v["bound_y"]], axis=1)[rest],
        belief=v["belief"][rest],
    )


def read_points(path: Path) -> list[Point]:
    runs: dict[tuple, dict] = defaultdict(lambda: defaultdict(list))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            runs[row["sweep"], float(row["value"])][row["seed"]].append(row)
    return [
        Point(sweep, value, [track_of(rows) for rows in by_seed.values()])
        for (sweep, value), by_seed in runs.items()
    ]


def reacquired_after_s(track: Track) -> float:
    """From the first frame after the occlusion to the first one believed in and on target."""
    hidden = np.flatnonzero(~track.visible)
    back = hidden[-1] + 1
    found = np.flatnonzero(track.near[back:] & (track.belief[back:] >= BELIEVED))
    return float(found[0] / FRAMES_PER_SECOND) if len(found) else np.inf


def mean(values: list[np.ndarray]) -> np.ndarray:
    """Over all rows of all arrays; nan when there are none."""
    rows = np.concatenate(values)
    return rows.mean(axis=0) if len(rows) else np.full(2, np.nan)


def point_measures(point: Point) -> dict:
    """Errors and their consistency over the frames on target; RMS and NEES are (x, y)."""
    tracks = point.tracks
    lock = [t.near[t.visible].mean() for t in tracks]
    rms = np.sqrt(mean([t.error[t.near] ** 2 for t in tracks]))
    bound = np.sqrt(mean([t.bound[t.near] for t in tracks]))
    nees = mean([t.error[t.near] ** 2 / t.variance[t.near] for t in tracks])
    result = {
        "sweep": point.sweep,
        "value": point.value,
        "runs": len(tracks),
        "near": float(np.mean(lock)),
        "kept_lock": float(np.mean([share > LOCK_SHARE for share in lock])),
        "rms_px": rms.tolist(),
        "bound_px": bound.tolist(),
        "over_bound": (rms / bound).tolist(),
        "nees": nees.tolist(),
    }
    if point.sweep in HIDDEN_SWEEPS:
        times = [reacquired_after_s(t) for t in tracks]
        result["reacquired_s"] = times
        result["reacquired"] = float(np.mean([time <= REACQUIRED_IN_S for time in times]))
        result["believed_hidden"] = float(
            np.mean([(t.belief[~t.visible] >= BELIEVED).mean() for t in tracks])
        )
    return result
