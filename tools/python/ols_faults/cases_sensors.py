"""Faults of the GNSS receiver and the inclinometer of a station whose pose comes from them."""

from typing import Any

import numpy as np
import ols
from ols_demo.places import geodetic

from ols_faults.case import Outcome, case
from ols_faults.session import Session

HELD_S = 14.0
FLAGGED_S = 12.0  # a receiver may be silent for some seconds, an inclinometer still for stuck_s
KEPT_M = 0.2
KEPT_DEG = 0.01
POSE_SENSOR = 2  # station_status_t.POSE_SENSOR


def place(status: Any) -> np.ndarray:
    return np.asarray(
        ols.ecef_from_geodetic(geodetic(status.latitude_deg, status.longitude_deg, status.height_m))
    )


def flagged_s(session: Session, station: str, since_us: int, word: str) -> tuple[float, str]:
    """When an alarm with this word first came after then [s], and its text."""
    arrivals = session.heard.arrivals_us[f"OLS_STATUS_{station}"]
    for status, at in zip(session.heard.statuses[station], arrivals, strict=True):
        for alarm in status.alarm:
            if at > since_us and word in alarm:
                return (at - since_us) * 1e-6, alarm
    return float("nan"), "no alarm"


def flag_is_gone(session: Session, station: str, word: str) -> bool:
    return not any(word in alarm for alarm in session.status(station).alarm)


def pose_kept(session: Session, outcome: Outcome, kind: str, word: str, value: float) -> None:
    station = session.sensor_station
    before = session.fresh_status(station)
    of_position = word == "gnss"
    source = before.position_source if of_position else before.tilt_source
    outcome.holds("its pose is the sensors'", source == POSE_SENSOR, f"source {source}")
    at_us = session.fault(kind, station, HELD_S, value)
    session.run(HELD_S)
    during = session.status(station)
    ended_us = session.now_us()
    seen_s, text = flagged_s(session, station, at_us, word)
    outcome.at_most(f"flagged ({text})", seen_s, FLAGGED_S, "s")
    if of_position:
        moved_m = float(np.linalg.norm(place(during) - place(before)))
        outcome.at_most("position moved", moved_m, KEPT_M, "m")
        grown = max(during.position_sd_m) - max(before.position_sd_m)
        outcome.at_least("its 1-sigma grown", grown, 1e-4, "m")
    else:
        tilts = [(s.tilt_x_rad, s.tilt_y_rad) for s in (before, during)]
        turned_deg = float(np.degrees(np.abs(np.subtract(*tilts)).max()))
        outcome.at_most("tilt changed", turned_deg, KEPT_DEG, "deg")
        grown = np.degrees(during.tilt_sd_rad - before.tilt_sd_rad)
        outcome.at_least("its 1-sigma grown", float(grown), 1e-5, "deg")
    away = session.state_since(station, at_us) - {"tracking", "coasting"}
    outcome.holds("goes on tracking", not away, ", ".join(sorted(away)) or "yes")
    session.wait(lambda: flag_is_gone(session, station, word), 20.0)
    gone = flag_is_gone(session, station, word)
    outcome.recovered("alarm gone", (session.now_us() - ended_us) * 1e-6 if gone else None, 15.0)


@case("gnss-fix-lost", "GNSS fix lost for 14 s", "pose kept, flagged, uncertainty grows")
def gnss_fix_lost(session: Session, outcome: Outcome) -> None:
    pose_kept(session, outcome, "gnss-no-fix", "gnss", float("nan"))


@case("gnss-jump", "GNSS position jumps by 100 m for 14 s", "pose kept, flagged, uncertainty grows")
def gnss_jump(session: Session, outcome: Outcome) -> None:
    pose_kept(session, outcome, "gnss-jump", "gnss", 100.0)


@case("gnss-silent", "GNSS receiver silent for 14 s", "pose kept, flagged, uncertainty grows")
def gnss_silent(session: Session, outcome: Outcome) -> None:
    pose_kept(session, outcome, "gnss-silent", "gnss", float("nan"))


@case("inclinometer-stuck", "inclinometer stuck for 14 s", "pose kept, flagged, uncertainty grows")
def inclinometer_stuck(session: Session, outcome: Outcome) -> None:
    pose_kept(session, outcome, "inclinometer-stuck", "inclinometer", float("nan"))
