"""Evidence as it would be if the product or the fault were broken in some way."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import numpy as np
import ols
from ols_demo.evaluate import JOINT
from ols_demo.observer import STATES

from ols_faults.case import Mutation
from ols_faults.evidence import Evidence, heard, rewrite

OK = 2  # station_status_t.DEVICE_OK
EVER = 1 << 62
Window = tuple[int, int]
ALWAYS: Window = (0, EVER)


def altering(
    what: str, channel: str, change: Callable[[Any], Any], window: Window = ALWAYS
) -> Mutation:
    """Applies `change` to each message that arrived in the window; None removes it."""

    def one(message: Any, at: int) -> list[tuple[Any, int]]:
        if not window[0] <= at <= window[1]:
            return [(message, at)]
        changed = change(message)
        return [] if changed is None else [(changed, at)]

    return Mutation(what, lambda evidence: rewrite(evidence.heard, channel, one))


def together(what: str, *parts: Mutation) -> Mutation:
    def alter(evidence: Evidence) -> None:
        for mutation in parts:
            mutation.alter(evidence)

    return Mutation(what, alter)


def fact(what: str, name: str, value: Any) -> Mutation:
    """`value`, or if that is a function, its result for the noted value."""

    def alter(evidence: Evidence) -> None:
        evidence[name] = value(evidence[name]) if callable(value) else value

    return Mutation(what, alter)


def put(message: Any, **fields: Any) -> Any:
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def lost(what: str, channel: str, window: Window = ALWAYS, share: float = 1.0) -> Mutation:
    """Removes an evenly spread share of the channel's messages."""
    account = [0.0]

    def change(message: Any) -> Any:
        account[0] += share
        if account[0] < 1.0:
            return message
        account[0] -= 1.0
        return None

    return altering(what, channel, change, window)


def late(what: str, channel: str, window: Window, seconds: float) -> Mutation:
    def change(message: Any, at: int) -> list[tuple[Any, int]]:
        inside = window[0] <= at <= window[1]
        return [(message, at + round(seconds * 1e6) * inside)]

    return Mutation(what, lambda evidence: rewrite(evidence.heard, channel, change))


def scaled_counter(status: Any, name: str, factor: float) -> Any:
    both = zip(status.counter_name, status.counter_value, strict=True)
    return put(status, counter_value=[factor * v if n == name else v for n, v in both])


# Bearings.


def bearings_lost(station: str, window: Window = ALWAYS, share: float = 1.0) -> Mutation:
    part = "" if share == 1.0 else f"{100 * share:.0f} % of "
    return lost(f"{part}{station}'s bearings do not come", f"OLS_BEARING_{station}", window, share)


def not_tracking_for(station: str, since_us: int, seconds: float) -> Mutation:
    window = since_us, since_us + round((seconds + 0.5) * 1e6)
    return together(
        f"{station} does not track for {seconds:g} s more", bearings_lost(station, window)
    )


def bearings_turned(station: str, degrees: float, every: int, window: Window = ALWAYS) -> Mutation:
    count = [0]

    def change(bearing: Any) -> Any:
        count[0] += 1
        if count[0] % every:
            return bearing
        return put(bearing, elevation_rad=bearing.elevation_rad + np.radians(degrees))

    what = f"every {every}. bearing is off by {degrees:g} deg"
    return altering(what, f"OLS_BEARING_{station}", change, window)


def sigmas_scaled(station: str, factor: float) -> Mutation:
    def change(bearing: Any) -> Any:
        names = ("covariance_white_rad2", "covariance_systematic_rad2")
        return put(bearing, **{n: [factor**2 * v for v in getattr(bearing, n)] for n in names})

    return altering(f"published sigmas are {factor:g} times", f"OLS_BEARING_{station}", change)


def goes_on_publishing(station: str, window: Window) -> Mutation:
    """Its bearings continue as without the fault, as if the fault had not been applied."""

    def alter(evidence: Evidence) -> None:
        channel = f"OLS_BEARING_{station}"
        model = copy.copy(evidence.heard.bearings[station][0])
        added = [
            (put(copy.copy(model), utime=at - 60_000), at)
            for at in range(window[0] + 1, window[1], 83_000)
        ]
        kept = [
            row for row in heard(evidence.heard, channel) if not window[0] <= row[1] <= window[1]
        ]
        both = sorted(kept + added, key=lambda row: row[1])
        evidence.heard.bearings[station][:] = [bearing for bearing, _ in both]
        evidence.heard.arrivals_us[channel] = [at for _, at in both]

    return Mutation(f"{station} goes on publishing bearings", alter)


# The true shafts.


def shafts_altered(what: str, station: str, turn: Callable[[np.ndarray], np.ndarray]) -> Mutation:
    """`turn`: instants [us] to what is added to the pan [deg] then."""

    def change(ptu: Any) -> Any:
        times = ptu.utime + np.arange(ptu.samples) * ptu.interval_s * 1e6
        return put(ptu, pan_rad=np.asarray(ptu.pan_rad) + np.radians(turn(times)))

    return altering(what, f"OLS_SIM_PTU_{station}", change)


def swings(station: str, window: Window, deg_s: float = 46.0, period_s: float = 2.0) -> Mutation:
    """Swings to and fro about the right direction."""
    amplitude = deg_s * period_s / (2 * np.pi)

    def turn(times: np.ndarray) -> np.ndarray:
        phase = 2 * np.pi * (times - window[0]) * 1e-6 / period_s
        inside = (times >= window[0]) & (times <= window[1])
        return np.where(inside, amplitude * np.sin(phase), 0.0)

    return shafts_altered(f"the PTU swings at {deg_s:g} deg/s", station, turn)


def jerks(station: str, window: Window, deg_s2: float) -> Mutation:
    """Adds a short push in the middle of the window."""
    middle_us, lasts_s = sum(window) / 2, 0.2

    def turn(times: np.ndarray) -> np.ndarray:
        since = np.clip((times - middle_us) * 1e-6, 0.0, lasts_s)
        return deg_s2 * since**2 / 2

    return shafts_altered(f"the PTU is pushed at {deg_s2:g} deg/s^2", station, turn)


def moves_on(station: str, window: Window, deg_s: float) -> Mutation:
    """Moves at that speed until the window's end, and stays there."""

    def turn(times: np.ndarray) -> np.ndarray:
        return deg_s * (np.clip(times, window[0], window[1]) - window[0]) * 1e-6

    seconds = (window[1] - window[0]) * 1e-6
    return shafts_altered(f"the PTU moves at {deg_s:g} deg/s for {seconds:.2g} s", station, turn)


def from_where_it_was(
    what: str, station: str, window: Window, change: Callable[[Any, float, float], Any]
) -> Mutation:
    """`change`: of what the shafts did in the window, given pan and tilt of the window's start."""

    def alter(evidence: Evidence) -> None:
        before = [p for p in evidence.heard.ptus[station] if p.utime <= window[0]][-1]

        def one(ptu: Any, at: int) -> list[tuple[Any, int]]:
            if window[0] < ptu.utime <= window[1]:
                ptu = change(ptu, before.pan_rad[-1], before.tilt_rad[-1])
            return [(ptu, at)]

        rewrite(evidence.heard, f"OLS_SIM_PTU_{station}", one)

    return Mutation(what, alter)


def goes_further(station: str, window: Window, factor: float) -> Mutation:
    """Scales all motion after the window's start by a factor."""

    def change(ptu: Any, start: float, _: float) -> Any:
        return put(ptu, pan_rad=start + factor * (np.asarray(ptu.pan_rad) - start))

    what = f"the PTU goes {factor:g} times as far"
    return from_where_it_was(what, station, (window[0], EVER), change)


def stands(station: str, window: Window, what: str = "the PTU does not move") -> Mutation:
    """Freezes it at its state of the window's start."""

    def change(ptu: Any, pan: float, tilt: float) -> Any:
        return put(ptu, pan_rad=np.full(ptu.samples, pan), tilt_rad=np.full(ptu.samples, tilt))

    return from_where_it_was(what, station, window, change)


# A station's status.


def status_altered(
    what: str, station: str, change: Callable[[Any], Any], window: Window = ALWAYS
) -> Mutation:
    return altering(what, f"OLS_STATUS_{station}", change, window)


def says_nothing(station: str, window: Window = ALWAYS) -> Mutation:
    """Removes all alarms and makes every device well."""

    def change(status: Any) -> Any:
        return put(
            status,
            alarms=0,
            alarm=[],
            device_state=[OK] * status.devices,
            device_text=[""] * status.devices,
            last_error="",
        )

    return status_altered(f"{station} says nothing of it", station, change, window)


def alarm_instead(station: str, text: str, window: Window = ALWAYS) -> Mutation:
    """The alarm has other words than the expected ones."""

    def change(status: Any) -> Any:
        return put(
            status, alarms=1, alarm=[text], device_text=[text] * status.devices, last_error=text
        )

    return status_altered(f'{station} only says "{text}"', station, change, window)


def device_ails(station: str, device: str, window: Window) -> Mutation:
    def change(status: Any) -> Any:
        found = zip(status.device_name, status.device_state, strict=True)
        return put(status, device_state=[3 if name == device else s for name, s in found])

    return status_altered(f"{station}'s {device} stays a fault", station, change, window)


def in_state(station: str, state: str, window: Window = ALWAYS) -> Mutation:
    number = next(n for n, name in STATES.items() if name == state)
    return status_altered(f"{station} is {state}", station, lambda s: put(s, state=number), window)


def without_counter(channel: str, name: str, window: Window = ALWAYS) -> Mutation:
    """Keeps the counter at 0."""
    return altering(
        f"{name} is not counted", channel, lambda status: scaled_counter(status, name, 0.0), window
    )


def counter_more(channel: str, name: str, amount: float, window: Window) -> Mutation:
    def change(status: Any) -> Any:
        values = dict(zip(status.counter_name, status.counter_value, strict=True))
        values[name] = values.get(name, 0.0) + amount
        return put(status, counter_name=list(values), counter_value=list(values.values()))

    return altering(f"{name} counts {amount:g} more", channel, change, window)


# Targets.


def targets_lost(window: Window = ALWAYS, share: float = 1.0, channel: str = JOINT) -> Mutation:
    part = "no targets come" if share == 1.0 else f"{100 * share:.0f} % of the targets do not come"
    return lost(part, channel, window, share)


def targets_shifted(metres: float, window: Window = ALWAYS, channel: str = JOINT) -> Mutation:
    def change(target: Any) -> Any:
        position = np.array(target.position_ecef_m)
        up = np.asarray(ols.R_ecef_enu(position))[:, 2] if np.isfinite(position).all() else position
        return put(target, position_ecef_m=list(position + metres * up))

    return altering(f"targets are off by {metres:g} m", channel, change, window)


def target_sigmas_scaled(factor: float, channel: str = JOINT) -> Mutation:
    def change(target: Any) -> Any:
        grown = [factor**2 * value for value in target.position_covariance_enu_m2]
        return put(target, position_covariance_enu_m2=grown)

    return altering(f"the targets' published sigmas are {factor:g} times", channel, change)


def rays(what: str, station: str, used: bool, window: Window = ALWAYS) -> Mutation:
    """Makes the fusion use this station's rays, or not, during the window."""

    def change(target: Any) -> Any:
        names, flags = list(target.station), list(target.used)
        flags = [used if name == station else flag for name, flag in zip(names, flags, strict=True)]
        if used and station not in names:
            names, flags = [*names, station], [*flags, True]
        return put(target, station=names, used=flags)

    return altering(what, JOINT, change, window)


def shafts_late(station: str, seconds: float) -> Mutation:
    """Delays the PTU's motion."""
    return altering(
        f"the PTU does it {seconds:g} s later",
        f"OLS_SIM_PTU_{station}",
        lambda ptu: put(ptu, utime=ptu.utime + round(seconds * 1e6)),
    )
