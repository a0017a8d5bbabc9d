"""Measures from the recorded bus messages. Pure: a recording and a window of time in, numbers out.

Times are microseconds of true UTC; the host's own clock is never stepped in a fault run.
"""

from __future__ import annotations

import bisect
from collections.abc import Callable
from typing import Any

import numpy as np
import ols
from ols_demo import evaluate
from ols_demo.bus import counters
from ols_demo.evaluate import JOINT, OK
from ols_demo.observer import STATES
from ols_demo.recording import Recording

from ols_faults.evidence import heard

REST_DEG_S = 0.1
REST_S = 0.25
SMOOTH_S = 0.01
SAME_FRAME_US = 10_000
SAME_EPOCH_US = 45_000  # half of what lies between two targets: fusions choose their own instants


def ptu_track(
    recording: Recording, station: str, start_us: int, end_us: int
) -> tuple[np.ndarray, np.ndarray]:
    """True shaft angles: times [s after start] (n,), pan and tilt [deg] (n, 2)."""
    times, angles = [np.zeros(0)], [np.zeros((0, 2))]
    ptus = recording.ptus.get(station, [])
    for message in ptus[bisect.bisect_left(ptus, start_us - 1_000_000, key=lambda p: p.utime) :]:
        if message.utime > end_us:
            break
        first_s = (message.utime - start_us) * 1e-6
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
    """Time from the start until the PTU came to rest for at least REST_S."""
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
    """The PTU's greatest distance from its position at the start, of both axes; NaN if unknown."""
    _, angles = ptu_track(recording, station, start_us, end_us)
    return float(np.abs(angles - angles[0]).max()) if len(angles) else float("nan")


def braking(recording: Recording, station: str, edge_us: int) -> tuple[float, float, float]:
    """Of a PTU that turns steadily and then brakes: its speed before [deg/s], when it begins to
    brake after the edge [s], and its deceleration [deg/s^2]. A line through the middle of the
    braking, drawn back to the speed before, is far finer than the first slower sample."""
    times, angles = ptu_track(recording, station, edge_us - 150_000, edge_us + 2_500_000)
    times = times - 0.15
    speed = speeds(times, angles)
    if len(speed) < 50:
        return float("nan"), float("nan"), float("nan")
    shortly = (times >= -0.05) & (times <= 0.0)
    if not shortly.any():  # where some of what the shafts did was not heard
        shortly = times <= 0.0
    if not shortly.any():
        return float("nan"), float("nan"), float("nan")
    steady = float(np.median(speed[shortly]))
    speed, times = speed[times >= -0.05], times[times >= -0.05]
    slow = np.flatnonzero(speed < 0.3 * steady)
    end = slow[0] if len(slow) else len(speed)
    chosen = np.flatnonzero((speed < 0.85 * steady) & (np.arange(len(speed)) < end))
    if len(chosen) < 5:
        return steady, float("nan"), float("nan")
    slope, offset = np.polyfit(times[chosen], speed[chosen], 1)
    return steady, float((steady - offset) / slope), float(-slope)


def between(messages: list[Any], start_us: int, end_us: int) -> list[Any]:
    """Those with a utime in the window. After a clock step they are not in order."""
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


def between_arrivals(
    recording: Recording, channel: str, start_us: int, end_us: int
) -> list[tuple[Any, int]]:
    """Messages that arrived in the window, each with its arrival time [us]."""
    return [(m, at) for m, at in heard(recording, channel) if start_us <= at <= end_us]


def statuses(recording: Recording, station: str, start_us: int, end_us: int) -> list[Any]:
    found = between_arrivals(recording, f"OLS_STATUS_{station}", start_us, end_us)
    return [status for status, _ in found]


def states(recording: Recording, station: str, start_us: int, end_us: int) -> set[str]:
    found = statuses(recording, station, start_us, end_us)
    return {STATES.get(status.state, "unknown") for status in found}


def first_s(
    recording: Recording, channel: str, start_us: int, end_us: int, condition: Callable[[Any], bool]
) -> float | None:
    """Time from the start to the first message that meets the condition, or None."""
    for message, at in between_arrivals(recording, channel, start_us, end_us):
        if condition(message):
            return (at - start_us) * 1e-6
    return None


def tracking_again_s(
    recording: Recording, station: str, start_us: int, end_us: int
) -> float | None:
    """Time from the start to its first bearing of an image taken since then, or None."""

    def since(bearing: Any) -> bool:
        return bearing.utime >= start_us

    return first_s(recording, f"OLS_BEARING_{station}", start_us, end_us, since)


def grown(
    recording: Recording, channel: str, name: str, start_us: int, end_us: int
) -> float | None:
    """What a counter grew by: from the last status before the window to the last in it. None
    without both, or without the counter at the end."""
    before = [m for m, at in heard(recording, channel) if at < start_us]
    during = between_arrivals(recording, channel, start_us, end_us)
    if not before or not during or name not in (last := counters(during[-1][0])):
        return None
    return last[name] - counters(before[-1]).get(name, 0.0)


def counter_at_end(
    recording: Recording, channel: str, name: str, start_us: int, end_us: int
) -> float | None:
    """The counter in the window's last status: 0 if not there yet, None without a status."""
    during = between_arrivals(recording, channel, start_us, end_us)
    return counters(during[-1][0]).get(name, 0.0) if during else None


def used(target: Any) -> set[str]:
    """The stations whose rays a located target is computed from."""
    return {s for s, is_used in zip(target.station, target.used, strict=True) if is_used}


def positions(recording: Recording, start_us: int, end_us: int) -> list[Any]:
    """Targets with a position that arrived in the window."""
    arrived = between_arrivals(recording, JOINT, start_us, end_us)
    return [target for target, _ in arrived if target.solution == OK]


def target_arrivals_us(recording: Recording, start_us: int, end_us: int) -> list[int]:
    """The arrival times of targets with a position."""
    arrived = between_arrivals(recording, JOINT, start_us, end_us)
    return [at for target, at in arrived if target.solution == OK]


def longest_gap_s(arrivals_us: list[int], start_us: int, end_us: int) -> float:
    edges = np.array([start_us, *arrivals_us, end_us], dtype=np.int64)
    return float(np.diff(edges).max() * 1e-6)


def bearing_ages_s(recording: Recording, station: str, start_us: int, end_us: int) -> np.ndarray:
    """(n, 2): arrival times of bearings [s after start], and their ages then [s]."""
    arrived = between_arrivals(recording, f"OLS_BEARING_{station}", start_us, end_us)
    rows = [((at - start_us) * 1e-6, (at - bearing.utime) * 1e-6) for bearing, at in arrived]
    return np.array(rows).reshape(-1, 2)


def aim_offsets_px(recording: Recording, station: str, start_us: int, end_us: int) -> np.ndarray:
    """The target's distance from the image centre in each frame where its place is known."""
    statuses = recording.statuses.get(station)
    if not statuses:
        return np.zeros(0)
    middle = np.array([statuses[-1].image_width_px - 1, statuses[-1].image_height_px - 1]) / 2
    views = [v for v in recording.views.get(station, []) if start_us <= v.utime <= end_us]
    offsets = [np.hypot(*(np.array(v.centre_px) - middle)) for v in views]
    return np.array([o for o in offsets if np.isfinite(o)])


def bearings_hz(recording: Recording, station: str, start_us: int, end_us: int) -> float:
    ages = bearing_ages_s(recording, station, start_us, end_us)
    return len(ages) / ((end_us - start_us) * 1e-6)


def same_epochs_m(
    recording: Recording, channel: str, other: str, start_us: int, end_us: int
) -> tuple[np.ndarray, float]:
    """Errors (n, 2) [m] of the positions of two fusions that hold at nearly the same instants, each
    against the truth of its own; and how many positions the first one has for one of the second."""
    ours, theirs = (
        evaluate.solved(recording, name, (start_us, end_us)) for name in (channel, other)
    )
    if not ours or not theirs:
        return np.zeros((0, 2)), 0.0
    distances = [
        np.linalg.norm(evaluate.errors_enu(recording, name, indices), axis=1)
        for name, indices in ((channel, ours), (other, theirs))
    ]
    times = np.array([recording.targets[channel][i].utime for i in ours])
    wanted = np.array([recording.targets[other][i].utime for i in theirs])
    order = np.argsort(times)
    times = times[order]
    after = np.clip(np.searchsorted(times, wanted), 1, max(1, len(times) - 1))
    before = after - 1
    after = np.minimum(after, len(times) - 1)
    nearest = np.where(wanted - times[before] <= times[after] - wanted, before, after)
    close = np.abs(times[nearest] - wanted) <= SAME_EPOCH_US
    pairs = np.column_stack([distances[0][order][nearest[close]], distances[1][close]])
    return pairs[np.isfinite(pairs).all(axis=1)], len(ours) / len(theirs)
