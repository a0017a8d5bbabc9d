"""Judges from the true shafts and the true target alone whether a PTU follows its target.

Between standing still and going with the target everything is right, and so is what closes the
distance to it, at the servo's gain. Anything beyond is unwanted motion.
"""

from __future__ import annotations

import numpy as np
import ols
from ols_demo.recording import Recording

from ols_faults import measure

GAIN_HZ = 3.0  # ServoConfig::gain_hz
GAIN_MARGIN = 1.5
STEP_S = 0.01  # shafts are looked at so often,
HALF_S = 0.03  # and speeds taken over so much to both sides
LAG_S = 0.4  # of what closes a distance: it was commanded for the distance of up to then


def needed_deg(recording: Recording, station: str, times_us: np.ndarray) -> np.ndarray:
    """(n, 2) pan and tilt at which the optical axis would meet the target; NaN unknown. The
    mounting and the tripod's tilt are left out: some tenths of a degree."""
    status = recording.statuses[station][-1]
    camera = np.array(status.camera_ecef_m)
    enu = (recording.truth_at(times_us) - camera) @ np.asarray(ols.R_ecef_enu(camera))
    azimuth = np.arctan2(enu[:, 0], enu[:, 1])
    elevation = np.arctan2(enu[:, 2], np.hypot(enu[:, 0], enu[:, 1]))
    pan = np.angle(np.exp(1j * (status.heading_rad - azimuth)))
    return np.degrees(np.column_stack([np.unwrap(pan), elevation]))


def sampled(
    recording: Recording, station: str, start_us: int, end_us: int
) -> tuple[np.ndarray, np.ndarray]:
    """Times every STEP_S [s after start] and the true shaft angles at those times [deg] (n, 2)."""
    times, angles = measure.ptu_track(recording, station, start_us, end_us)
    if len(times) < 2:
        return np.zeros(0), np.zeros((0, 2))
    order = np.argsort(times, kind="stable")
    even = np.arange(times[order[0]], times[order[-1]], STEP_S)
    columns = [np.interp(even, times[order], angles[order, axis]) for axis in (0, 1)]
    return even, np.column_stack(columns)


def rates(angles: np.ndarray) -> np.ndarray:
    """(n - 2 h, 2) [deg/s] about each instant except the first and last h."""
    h = round(HALF_S / STEP_S)
    return (angles[2 * h :] - angles[: -2 * h]) / (2 * h * STEP_S)


def excess_deg_s(recording: Recording, station: str, start_us: int, end_us: int) -> float:
    """The fastest motion beyond what standing, following and closing in on the target allow
    [deg/s]; NaN unknown."""
    times, shafts = sampled(recording, station, start_us, end_us)
    h, lag = round(HALF_S / STEP_S), round(LAG_S / STEP_S)
    if len(times) <= 2 * h + lag or not recording.statuses.get(station):
        return float("nan")
    needed = needed_deg(recording, station, start_us + np.round(times * 1e6).astype(np.int64))
    shafts = shafts + 360.0 * np.round((needed - shafts) / 360.0)
    speed, following = rates(shafts), rates(needed)
    distance = (needed - shafts)[h:-h]
    closing = GAIN_HZ * GAIN_MARGIN * distance
    past = np.stack([np.roll(closing, shift, axis=0) for shift in range(0, lag + 1, 5)])[:, lag:]
    speed, following = speed[lag:], following[lag:]
    fastest = np.maximum(0.0, following) + np.maximum(0.0, past.max(axis=0))
    slowest = np.minimum(0.0, following) + np.minimum(0.0, past.min(axis=0))
    excess = np.maximum(speed - fastest, slowest - speed)
    known = np.isfinite(excess).all(axis=1)
    return float(np.maximum(0.0, excess[known]).max()) if known.any() else float("nan")


def acceleration_deg_s2(recording: Recording, station: str, start_us: int, end_us: int) -> float:
    """The hardest of either axis; NaN unknown."""
    _, shafts = sampled(recording, station, start_us, end_us)
    if len(shafts) < 20:
        return float("nan")
    return float(np.abs(rates(rates(shafts))).max())
