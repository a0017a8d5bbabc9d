"""Faults of the sensors that watch over the pose."""

from typing import Any

import numpy as np

from ols_faults.case import Outcome, case
from ols_faults.session import Session

KEPT = "pose kept, flagged, uncertainty grows"
EARTH_M = 6.38e6


def alarms(status: Any, device: str) -> list[str]:
    return [alarm for alarm in status.alarm if alarm.startswith(device)]


def moved_m(status: Any, before: Any) -> float:
    north_m = np.radians(status.latitude_deg - before.latitude_deg) * EARTH_M
    east_m = np.radians(status.longitude_deg - before.longitude_deg) * EARTH_M
    east_m *= np.cos(np.radians(before.latitude_deg))
    return float(np.linalg.norm([east_m, north_m, status.height_m - before.height_m]))


def leaned_rad(status: Any, before: Any) -> float:
    return float(
        np.hypot(status.tilt_x_rad - before.tilt_x_rad, status.tilt_y_rad - before.tilt_y_rad)
    )


def do(session: Session, outcome: Outcome, kind: str, station: str, seconds: float) -> None:
    """The fault, and what is the same for each of them."""
    device = kind.split("-")[0]
    well = session.wait(lambda: not alarms(session.status(station), device), 30.0)
    outcome.holds("no alarm before", well is not None)
    before = session.fresh_status(station)
    start_us = session.fault(kind, station, seconds)
    session.run(seconds)
    ended_us = session.now_us()
    heard = session.statuses_since(station, start_us)
    flagged = [text for status in heard for text in alarms(status, device)]
    outcome.holds("flagged", bool(flagged), flagged[-1] if flagged else "no")
    outcome.at_most("position moved", max(moved_m(s, before) for s in heard), 0.01, "m")
    # What was being averaged when it began may come to its end.
    outcome.at_most("tilt moved", max(leaned_rad(s, before) for s in heard), 1e-4, "rad")
    if device == "gnss":
        growth = max(s.position_sd_m[0] for s in heard) - before.position_sd_m[0]
        outcome.at_least("growth of the position's sigma", growth, 0.002, "m")
    else:
        growth = max(s.tilt_sd_rad for s in heard) - before.tilt_sd_rad
        outcome.at_least("growth of the tilt's sigma", growth, 1e-7, "rad")
    states = session.state_since(station, start_us)
    outcome.holds("tracking meanwhile", states == {"tracking"}, ", ".join(sorted(states)))
    clear_s = session.wait(lambda: not alarms(session.fresh_status(station), device), 30.0)
    outcome.recovered("flag taken back", clear_s, 10.0)
    outcome.holds("bearings since", session.tracking_again_s(station, ended_us, 10.0) is not None)


@case("gnss-fix-lost", "GNSS fix lost for 20 s", KEPT)
def gnss_fix_lost(session: Session, outcome: Outcome) -> None:
    do(session, outcome, "gnss-no-fix", session.stations[0], 20.0)


@case("gnss-jump", "position jumps by 100 m for 20 s", KEPT)
def gnss_jump(session: Session, outcome: Outcome) -> None:
    do(session, outcome, "gnss-jump", session.stations[1], 20.0)


@case("inclinometer-stuck", "inclinometer stuck for 30 s", KEPT)
def inclinometer_stuck(session: Session, outcome: Outcome) -> None:
    do(session, outcome, "inclinometer-stuck", session.stations[2], 30.0)
