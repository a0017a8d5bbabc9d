"""The demo in the terminal: the current state of each station and the fusion."""

import shutil
import sys
import time

import numpy as np
import ols_msg

from ols_demo.bus import counters
from ols_demo.observer import Observer

SEEN_S = 1.5  # a position that is older is where the target was


def number(value: float, layout: str) -> str:
    """In this layout; a dash as wide for what is unknown."""
    return format(value, layout) if np.isfinite(value) else "-".rjust(len(format(0.0, layout)))


def at_work(observer: Observer) -> str:
    """How many of those that can follow a target by themselves do so now."""
    kind = ols_msg.station_status_t.KIND_OVERVIEW
    stations = [name for name, status in observer.status.items() if status.kind != kind]
    tracking = sum(observer.state(name) == "tracking" for name in stations)
    return f"{tracking} of {len(stations)} stations track"


def error_m(observer: Observer, channel: str) -> float:
    """Distance of the newest position from the newest truth, moved to the same instant; or NaN."""
    target, truth = observer.fix.get(channel), observer.truth
    if target is None or truth is None:
        return float("nan")
    ahead_s = (target.utime - truth.utime) * 1e-6
    there = np.array(truth.position_ecef_m) + np.array(truth.velocity_ecef_m_s) * ahead_s
    return float(np.linalg.norm(np.array(target.position_ecef_m) - there))


def station_lines(observer: Observer) -> list[str]:
    lines = ["station    state     belief   azimuth  elev.   offset px   frames  lost   bearings"]
    for station, status in sorted(observer.status.items()):
        count = counters(status)
        offset = ", ".join(number(v, "+5.0f") for v in status.target_offset_px)
        lost = count.get("frames_lost", 0) + count.get("frames_incomplete", 0)
        lines.append(
            f"{station:10s} {observer.state(station):9s} {number(status.belief, '5.2f')}  "
            f"{number(np.degrees(status.azimuth_rad), '8.2f')} "
            f"{number(np.degrees(status.elevation_rad), '6.2f')}  "
            f"{offset}  {count.get('frames_captured', 0):7.0f} {lost:5.0f}   "
            f"{count.get('bearings', 0):8.0f}"
        )
    return lines


def target_lines(observer: Observer, now_us: int) -> list[str]:
    target = observer.fix.get("OLS_TARGET")
    if target is None:
        return ["target     none yet"]
    silent_s = (now_us - target.utime) * 1e-6
    if silent_s > SEEN_S:
        return [f"target     none now, seen {silent_s:.0f} s ago", f"fixes      {observer.targets}"]
    covariance = target.position_covariance_enu_m2
    sd = np.sqrt([covariance[0], covariance[3], covariance[5]])
    used = sum(target.used)
    return [
        f"target     {target.latitude_deg:.6f}\u00b0 {target.longitude_deg:.6f}\u00b0 "
        f"{target.height_m:.1f} m   {used} of {target.stations} stations",
        f"1-sigma    east {sd[0]:.3f}  north {sd[1]:.3f}  up {sd[2]:.3f} m",
        f"error      {number(error_m(observer, 'OLS_TARGET'), '.3f')} m   "
        f"(the paper's estimator: {number(error_m(observer, 'OLS_TARGET_PAPER'), '.3f')} m)",
        f"fixes      {observer.targets}",
    ]


class Screen:
    """On a terminal it overwrites its previous output; into a file it writes now and then."""

    def __init__(self) -> None:
        self._drawn = 0
        self._is_terminal = sys.stdout.isatty()
        self.period_s = 0.5 if self._is_terminal else 10.0

    def draw(self, title: str, observer: Observer) -> None:
        lines = [
            title,
            "",
            *station_lines(observer),
            "",
            *target_lines(observer, time.time_ns() // 1000),
        ]
        if not self._is_terminal:
            print("\n".join(lines), end="\n\n", flush=True)
            return
        width = shutil.get_terminal_size().columns
        up = f"\x1b[{self._drawn}F" if self._drawn else ""
        sys.stdout.write(up + "".join(f"\x1b[2K{line[: width - 1]}\n" for line in lines) + "\x1b[J")
        sys.stdout.flush()
        self._drawn = len(lines)
