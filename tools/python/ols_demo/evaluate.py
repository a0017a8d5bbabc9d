"""Judges a recorded run against the simulator's truth."""

from typing import Any

import numpy as np
import ols

from ols_demo.recording import Recording

OK = 0  # target_t.SOLUTION_OK
OVERVIEW = 1  # station_status_t.KIND_OVERVIEW
JOINT, PAPER = "OLS_TARGET", "OLS_TARGET_PAPER"


def covariance_matrix(upper: list[float]) -> np.ndarray:
    """(3, 3) from ee, en, eu, nn, nu, uu."""
    ee, en, eu, nn, nu, uu = upper
    return np.array([[ee, en, eu], [en, nn, nu], [eu, nu, uu]])


def solved(recording: Recording, channel: str, window: tuple[int, int]) -> list[int]:
    """Indices of the targets with a position inside the window [us]."""
    return [
        i
        for i, target in enumerate(recording.targets.get(channel, []))
        if target.solution == OK and window[0] <= target.utime <= window[1]
    ]


def errors_enu(recording: Recording, channel: str, indices: list[int]) -> np.ndarray:
    """(n, 3) estimated minus true position [m], east, north, up at the target."""
    targets = [recording.targets[channel][i] for i in indices]
    estimates = np.array([t.position_ecef_m for t in targets]).reshape(-1, 3)
    truth = recording.truth_at(np.array([t.utime for t in targets], dtype=np.int64))
    rotations = [np.asarray(ols.R_ecef_enu(np.array(p))) for p in estimates]
    return np.array(
        [R.T @ (e - p) for R, e, p in zip(rotations, estimates, truth, strict=True)]
    ).reshape(-1, 3)


def accuracy(recording: Recording, channel: str, window: tuple[int, int]) -> dict[str, Any]:
    """RMS error, what the published covariances predict, and consistency."""
    indices = solved(recording, channel, window)
    errors = errors_enu(recording, channel, indices)
    known = np.isfinite(errors).all(axis=1) if len(errors) else np.zeros(0, dtype=bool)
    errors = errors[known]
    covariances = np.array(
        [
            covariance_matrix(recording.targets[channel][i].position_covariance_enu_m2)
            for i in indices
        ]
    ).reshape(-1, 3, 3)[known]
    if not len(errors):
        return {"fixes": 0, "rmse_m": None, "predicted_rmse_m": None}
    predicted = float(np.sqrt(np.mean(np.trace(covariances, axis1=1, axis2=2))))
    variances = np.diagonal(covariances, axis1=1, axis2=2)
    distance = np.linalg.norm(errors, axis=1)
    rmse = float(np.sqrt(np.mean(distance**2)))
    return {
        "fixes": len(errors),
        "rmse_m": rmse,
        "predicted_rmse_m": predicted,
        "rmse_over_predicted": rmse / predicted,
        "median_m": float(np.median(distance)),
        "p95_m": float(np.percentile(distance, 95)),
        "bias_enu_m": [float(v) for v in errors.mean(axis=0)],
        "normalised_error_squared_enu": [float(v) for v in (errors**2 / variances).mean(axis=0)],
    }


def latency(recording: Recording, window: tuple[int, int]) -> dict[str, float]:
    """Mid-exposure to the arrival of the published target at the logger [s]."""
    indices = solved(recording, JOINT, window)
    if not indices:
        return {}
    seconds = [
        (recording.arrivals_us[JOINT][i] - recording.targets[JOINT][i].utime) * 1e-6
        for i in indices
    ]
    p50, p95, p99 = np.percentile(seconds, [50, 95, 99])
    return {"p50_s": float(p50), "p95_s": float(p95), "p99_s": float(p99)}


def in_central_third(recording: Recording, station: str, window: tuple[int, int]) -> float | None:
    """Share of the frames in which the target is inside the central third of width and height."""
    views = [v for v in recording.views.get(station, []) if window[0] <= v.utime <= window[1]]
    statuses = recording.statuses.get(station)
    if not views or not statuses:
        return None
    size = np.array([statuses[-1].image_width_px, statuses[-1].image_height_px])
    centres = np.array([v.centre_px for v in views]) / size
    return float(np.mean((np.abs(centres - 0.5) < 1 / 6).all(axis=1)))


def bearings_inside(recording: Recording, station: str, window: tuple[int, int]) -> list[Any]:
    """The bearings of this station inside the window."""
    return [b for b in recording.bearings.get(station, []) if window[0] <= b.utime <= window[1]]


def off_truth(bearing: Any, truth_ecef_m: np.ndarray) -> np.ndarray:
    """(2,) a bearing minus the direction of the true position [rad]: cross-elevation, elevation."""
    camera = np.array(bearing.camera_ecef_m)
    east, north, up = np.asarray(ols.R_ecef_enu(camera)).T @ (truth_ecef_m - camera)
    elevation = np.arctan2(up, np.hypot(east, north))
    azimuth_off = np.angle(np.exp(1j * (bearing.azimuth_rad - np.arctan2(east, north))))
    return np.array([azimuth_off * np.cos(elevation), bearing.elevation_rad - elevation])


def bearing_accuracy(recording: Recording, bearings: list[Any]) -> dict[str, list[float]]:
    """RMS error, and what the bearings state [deg]: cross-elevation, elevation."""
    truth = recording.truth_at(np.array([b.utime for b in bearings], dtype=np.int64))
    known = [i for i, position in enumerate(truth) if np.isfinite(position).all()]
    if not known:
        return {}
    errors = np.array([off_truth(bearings[i], truth[i]) for i in known])
    stated = np.array(
        [
            [
                bearings[i].covariance_white_rad2[k] + bearings[i].covariance_systematic_rad2[k]
                for k in (0, 2)
            ]
            for i in known
        ]
    )
    return {
        "rms_deg": [float(v) for v in np.degrees(np.sqrt((errors**2).mean(axis=0)))],
        "stated_deg": [float(v) for v in np.degrees(np.sqrt(stated.mean(axis=0)))],
    }


def station_report(recording: Recording, station: str, window: tuple[int, int]) -> dict[str, Any]:
    """Frames, states and servo quality of one station, inside the window where that makes sense."""
    statuses = [s for s in recording.statuses[station] if window[0] <= s.utime <= window[1]]
    bearings = bearings_inside(recording, station, window)
    first, last = (
        recording.station_counters(station, recording.statuses[station].index(s))
        for s in (statuses[0], statuses[-1])
    )
    grown = {name: value - first.get(name, 0.0) for name, value in last.items()}
    seconds = {
        name.removeprefix("seconds_"): value
        for name, value in grown.items()
        if name.startswith("seconds_")
    }
    total_s = sum(seconds.values())
    captured = grown.get("frames_captured", 0.0)
    lost = grown.get("frames_lost", 0.0) + grown.get("frames_incomplete", 0.0)
    return {
        "frames_captured": int(captured),
        "frames_lost": int(lost),
        "frames_lost_fraction": lost / max(1.0, captured + lost),
        "frames_late": int(grown.get("frames_late", 0.0)),
        "bearings": len(bearings),
        "bearing_error": bearing_accuracy(recording, bearings),
        "seconds": {name: round(value, 3) for name, value in sorted(seconds.items())},
        "tracking_fraction": seconds.get("tracking", 0.0) / total_s if total_s > 0 else 0.0,
        "central_third_fraction": in_central_third(recording, station, window),
        "bearing_latency_s": statuses[-1].frame_latency_s,
        "ptu_timeouts": int(last.get("ptu_timeouts", 0.0)),
        "messages_refused": int(last.get("messages_refused", 0.0)),
    }


def keep_targets(recording: Recording, ids: set[int]) -> None:
    """Forgets the positions of all other targets: the truth is of one."""
    for channel, targets in recording.targets.items():
        kept = [i for i, target in enumerate(targets) if target.target_id in ids]
        recording.targets[channel] = [targets[i] for i in kept]
        recording.arrivals_us[channel] = [recording.arrivals_us[channel][i] for i in kept]


def report(recording: Recording, window: tuple[int, int]) -> dict[str, Any]:
    """The run's part of the demo's report."""
    joint = accuracy(recording, JOINT, window)
    paper = accuracy(recording, PAPER, window)
    return {
        "seconds": (window[1] - window[0]) * 1e-6,
        "stations": {
            station: station_report(recording, station, window)
            for station in sorted(recording.statuses)
            if recording.statuses[station][-1].kind != OVERVIEW
        },
        "fixes": joint["fixes"],
        "rmse_m": joint["rmse_m"],
        "predicted_rmse_m": joint["predicted_rmse_m"],
        "paper": {"rmse_m": paper["rmse_m"], "predicted_rmse_m": paper["predicted_rmse_m"]},
        "latency": latency(recording, window),
        "joint_details": joint,
        "paper_details": paper,
    }
