"""Figures out of what was heard on the bus. Pure: a recording and a window of time in, numbers out.

Times are microseconds of true UTC; the host's own clock is never stepped in a fault run.
"""

from __future__ import annotations

import bisect
from typing import Any

import numpy as np
import ols
from ols_demo import evaluate
from ols_demo.evaluate import JOINT, OK
from ols_demo.recording import Recording

REST_DEG_S = 0.1
REST_S = 0.25
SMOOTH_S = 0.01
SAME_FRAME_US = 10_000


def ptu_track(
    recording: Recording, station: str, start_us: int, end_us: int
) -> tuple[np.ndarray, np.ndarray]:
    """True shaft angles: times [s after start] (n,), pan and tilt [deg] (n, 2)."""
    times, angles = [np.zeros(0)], [np.zeros((0, 2))]
    for message in recording.ptus.get(station, []):
        first_s = (message.utime - start_us) * 1e-6
        if message.utime > end_us or first_s < -1.0:
            continue
        times.append(first_s + np.arange(message.samples) * message.interval_s)
        angles.append(np.degrees(np.column_stack([message.pan_rad, message.tilt_rad])))
    t, a = np.concatenate(times), np.concatenate(angles)
    inside = (t >= 0.0) & (t <= (end_us - start_us) * 1e-6)
    return t[inside], a[inside]


def speeds(times: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """(n,) of the faster axis [deg/s], over SMOOTH_S."""
    if len(times) < 3:
        return np.zeros(len(times))
    step = max(1, round(SMOOTH_S / float(np.median(np.diff(times)))))
    ahead = np.minimum(np.arange(len(times)) + step, len(times) - 1)
    before = np.maximum(np.arange(len(times)) - step, 0)
    turned = np.abs(angles[ahead] - angles[before]).max(axis=1)
    return turned / np.maximum(times[ahead] - times[before], 1e-9)


def rest_s(recording: Recording, station: str, start_us: int, end_us: int) -> float | None:
    """How long after the start the PTU came to rest, to stay there for REST_S at least."""
    times, angles = ptu_track(recording, station, start_us, end_us)
    moving = speeds(times, angles) > REST_DEG_S
    if len(times) == 0 or times[-1] < REST_S:
        return None
    if not moving.any():
        return 0.0
    # The first instant from which nothing moves for REST_S.
    last_moved = np.maximum.accumulate(np.where(moving, times, -np.inf))
    resting = np.flatnonzero(times - last_moved >= REST_S)
    if len(resting) == 0:
        return None
    return max(0.0, float(last_moved[resting[0]]))


def rest_uncertainty_s(recording: Recording, station: str) -> float:
    """How much later than the truth rest_s() may be: a speed is taken over SMOOTH_S to both sides,
    and shafts are seen once an interval."""
    return SMOOTH_S + float(recording.ptus[station][-1].interval_s)


def moved_deg(recording: Recording, station: str, start_us: int, end_us: int) -> float:
    """How far the PTU got from where it was at the start, the greater of both axes; NaN unknown."""
    _, angles = ptu_track(recording, station, start_us, end_us)
    return float(np.abs(angles - angles[0]).max()) if len(angles) else float("nan")


def fastest_deg_s(recording: Recording, station: str, start_us: int, end_us: int) -> float:
    times, angles = ptu_track(recording, station, start_us, end_us)
    return float(speeds(times, angles).max()) if len(times) else float("nan")


def braking(recording: Recording, station: str, edge_us: int) -> tuple[float, float, float]:
    """Of a PTU that turns steadily and then brakes: its speed before [deg/s], when it begins to
    brake after the edge [s], and its deceleration [deg/s^2]. A line through the middle of the
    braking, drawn back to the speed before, is far finer than the first slower sample."""
    before_us = edge_us - 50_000
    times, angles = ptu_track(recording, station, before_us, edge_us + 2_500_000)
    times = times - 0.05
    speed = speeds(times, angles)
    if len(speed) < 50:
        return float("nan"), float("nan"), float("nan")
    steady = float(np.median(speed[times <= 0.0]))
    slow = np.flatnonzero(speed < 0.3 * steady)
    end = slow[0] if len(slow) else len(speed)
    chosen = np.flatnonzero((speed < 0.85 * steady) & (np.arange(len(speed)) < end))
    if len(chosen) < 5:
        return steady, float("nan"), float("nan")
    slope, offset = np.polyfit(times[chosen], speed[chosen], 1)
    return steady, float((steady - offset) / slope), float(-slope)


def between(messages: list[Any], start_us: int, end_us: int) -> list[Any]:
    """Those with a utime in the window; a station whose clock was stepped has them out of order."""
    return [m for m in messages if start_us <= m.utime <= end_us]


def same_frame(views: list[Any], utime: int) -> Any | None:
    """The view whose stamp is that of the bearing, or None."""
    after = bisect.bisect_left(views, utime, key=lambda view: view.stamp_utime)
    near = min(
        views[max(0, after - 1) : after + 1],
        key=lambda view: abs(view.stamp_utime - utime),
        default=None,
    )
    return near if near is not None and abs(near.stamp_utime - utime) <= SAME_FRAME_US else None


def bearing_errors(
    recording: Recording, station: str, start_us: int, end_us: int
) -> tuple[np.ndarray, np.ndarray]:
    """Published minus true direction of the bearings in the window: errors (n, 2) [rad] across and
    up, and their published 1-sigma (n, 2), everything that the bearing states included."""
    views = recording.views.get(station, [])
    bearings = between(recording.bearings.get(station, []), start_us, end_us)
    pairs = [(b, v) for b in bearings if (v := same_frame(views, b.utime)) is not None]
    truth = recording.truth_at(np.array([view.utime for _, view in pairs], dtype=np.int64))
    errors, sigmas = [], []
    for (bearing, _), position in zip(pairs, truth, strict=True):
        camera = np.array(bearing.camera_ecef_m)
        to_target = position - camera
        if not np.isfinite(to_target).all():
            continue
        true = ols.azimuth_elevation_from_enu(np.asarray(ols.R_ecef_enu(camera)).T @ to_target)
        turn = np.angle(np.exp(1j * (bearing.azimuth_rad - true.azimuth_rad)))
        across = turn * np.cos(true.elevation_rad)
        errors.append([across, bearing.elevation_rad - true.elevation_rad])
        place_rad = max(bearing.camera_position_sd_m) / np.linalg.norm(to_target)
        white, stays = bearing.covariance_white_rad2, bearing.covariance_systematic_rad2
        sigmas.append([np.sqrt(white[i] + stays[i] + place_rad**2) for i in (0, 2)])
    return np.array(errors).reshape(-1, 2), np.array(sigmas).reshape(-1, 2)


def target_error_m(recording: Recording, start_us: int, end_us: int) -> float | None:
    """RMS error of the joint estimate's positions [m]; None without any."""
    return evaluate.accuracy(recording, JOINT, (start_us, end_us))["rmse_m"]


def target_arrivals_us(recording: Recording, start_us: int, end_us: int) -> list[int]:
    """When targets with a position were heard."""
    both = zip(recording.targets.get(JOINT, []), recording.arrivals_us.get(JOINT, []), strict=True)
    return [at for target, at in both if target.solution == OK and start_us <= at <= end_us]


def longest_gap_s(arrivals_us: list[int], start_us: int, end_us: int) -> float:
    edges = np.array([start_us, *arrivals_us, end_us], dtype=np.int64)
    return float(np.diff(edges).max() * 1e-6)


def bearing_ages_s(recording: Recording, station: str, start_us: int, end_us: int) -> np.ndarray:
    """(n, 2): when bearings were heard [s after start], and how old they were then [s]."""
    channel = f"OLS_BEARING_{station}"
    both = zip(
        recording.bearings.get(station, []), recording.arrivals_us.get(channel, []), strict=True
    )
    rows = [
        ((at - start_us) * 1e-6, (at - bearing.utime) * 1e-6)
        for bearing, at in both
        if start_us <= at <= end_us
    ]
    return np.array(rows).reshape(-1, 2)


def aim_offsets_px(recording: Recording, station: str, start_us: int, end_us: int) -> np.ndarray:
    """How far the target was from the picture's middle, in each frame with a known place of it."""
    statuses = recording.statuses.get(station)
    if not statuses:
        return np.zeros(0)
    middle = np.array([statuses[-1].image_width_px - 1, statuses[-1].image_height_px - 1]) / 2
    views = [v for v in recording.views.get(station, []) if start_us <= v.utime <= end_us]
    offsets = [np.hypot(*(np.array(v.centre_px) - middle)) for v in views]
    return np.array([o for o in offsets if np.isfinite(o)])
