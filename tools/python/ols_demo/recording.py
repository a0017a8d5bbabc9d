"""Reads a recorded run (lcm-logger) back as arrays."""

import bisect
import struct
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import ols

from ols_demo.bus import counters, decode
from ols_demo.observer import FIRST_TARGET


@dataclass
class Recording:
    """Messages of one run; times in seconds since `start_us`."""

    start_us: int = 0
    targets: dict[str, list[Any]] = field(default_factory=dict)  # by channel
    arrivals_us: dict[str, list[int]] = field(default_factory=dict)  # by channel, all of them
    truth: list[Any] = field(default_factory=list)
    views: dict[str, list[Any]] = field(default_factory=dict)  # by station
    ptus: dict[str, list[Any]] = field(default_factory=dict)  # true shaft angles
    statuses: dict[str, list[Any]] = field(default_factory=dict)
    fusion: list[Any] = field(default_factory=list)
    bearings: dict[str, list[Any]] = field(default_factory=dict)

    def receive(self, channel: str, message: Any, arrival_us: int) -> None:
        self.arrivals_us.setdefault(channel, []).append(arrival_us)
        if channel.startswith("OLS_TARGET"):
            self.targets.setdefault(channel, []).append(message)
        elif channel == "OLS_SIM_TRUTH" and message.target_id == FIRST_TARGET:
            self.truth.append(message)
        elif channel.startswith("OLS_SIM_VIEW_"):
            self.views.setdefault(message.station, []).append(message)
        elif channel.startswith("OLS_SIM_PTU_"):
            self.ptus.setdefault(message.station, []).append(message)
        elif channel.startswith("OLS_STATUS_"):
            self.statuses.setdefault(message.station, []).append(message)
        elif channel.startswith("OLS_BEARING_"):
            self.bearings.setdefault(message.station, []).append(message)
        elif channel == "OLS_FUSION_STATUS":
            self.fusion.append(message)

    def truth_at(self, utimes_us: np.ndarray) -> np.ndarray:
        """(n, 3) true positions [m, ECEF], cubic Hermite between the truths; NaN outside."""
        if not len(utimes_us) or len(self.truth) < 2:
            return np.full((len(utimes_us), 3), np.nan)
        truth = self._truth_around(int(min(utimes_us)), int(max(utimes_us)))
        times = np.array([t.utime for t in truth], dtype=np.int64)
        positions = np.array([t.position_ecef_m for t in truth])
        velocities = np.array([t.velocity_ecef_m_s for t in truth])
        after = np.clip(np.searchsorted(times, utimes_us), 1, len(times) - 1)
        before = after - 1
        step = (times[after] - times[before])[:, None] * 1e-6
        s = (utimes_us - times[before])[:, None] * 1e-6 / step
        result = (
            positions[before] * (2 * s**3 - 3 * s**2 + 1)
            + velocities[before] * step * (s**3 - 2 * s**2 + s)
            + positions[after] * (3 * s**2 - 2 * s**3)
            + velocities[after] * step * (s**3 - s**2)
        )
        result[(utimes_us < times[0]) | (utimes_us > times[-1])] = np.nan
        return result

    def _truth_around(self, first_us: int, last_us: int) -> list[Any]:
        """Two at least, and one beyond either end where there is one: a long run has many."""
        first = bisect.bisect_right(self.truth, first_us, key=lambda t: t.utime)
        last = bisect.bisect_left(self.truth, last_us, key=lambda t: t.utime)
        first = min(max(0, first - 1), len(self.truth) - 2)
        return self.truth[first : max(last + 1, first + 2)]

    def station_counters(self, station: str, index: int) -> dict[str, float]:
        return counters(self.statuses[station][index])


def read(path: Path) -> Recording:
    """The recording in an LCM log. What is damaged is left out, and said on the terminal."""
    recording = Recording()
    reader = ols.LogReader(str(path))
    for arrival_us, channel, payload, _ in reader:
        try:
            message = decode(channel, payload)
        except (ValueError, struct.error):
            reader.reject(channel)
            continue
        if message is not None:
            recording.receive(channel, message, arrival_us)
    if reader.damage:
        print(f"{path}: left out: {reader.damage}", file=sys.stderr)
    if recording.truth:
        recording.start_us = recording.truth[0].utime
    return recording
