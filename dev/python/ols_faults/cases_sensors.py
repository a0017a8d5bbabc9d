"""Faults of the GNSS receiver and the inclinometer of a station whose pose comes from them."""

from functools import partial
from typing import Any

import numpy as np
import ols
from ols_demo.places import geodetic

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import alarm_of, judge_alarm, judge_goes_on
from ols_faults.mutations import put
from ols_faults.session import Session

HELD_S = 10.0
FLAGGED_S = 9.0  # a receiver may be silent for some seconds, an inclinometer still for stuck_s
KEPT_M = 0.2
KEPT_DEG = 0.01
POSE_SENSOR = 2  # station_status_t.POSE_SENSOR
GONE_S = 15.0


def place(status: Any) -> np.ndarray:
    return np.asarray(
        ols.ecef_from_geodetic(geodetic(status.latitude_deg, status.longitude_deg, status.height_m))
    )


def around(evidence: Evidence) -> tuple[Any, Any]:
    """The station's last status before the fault and its last before the fault's end."""
    station = evidence["station"]
    before = measure.statuses(evidence.heard, station, 0, evidence["at_us"])
    during = measure.statuses(evidence.heard, station, evidence["at_us"], evidence["ended_us"])
    return before[-1], during[-1]


def judge_position(evidence: Evidence, outcome: Outcome) -> None:
    station, since = evidence["station"], (evidence["at_us"], mutations.EVER)
    before, during = around(evidence)
    measured = float(np.linalg.norm(place(during) - place(before)))
    broken_by = mutations.status_altered(
        "the pose goes with the sensor by 1 m",
        station,
        lambda s: put(s, height_m=s.height_m + 1.0),
        since,
    )
    outcome.at_most("position moved", measured, KEPT_M, "m", broken_by=broken_by)
    measured = max(during.position_sd_m) - max(before.position_sd_m)
    broken_by = mutations.status_altered(
        "the sigma stays", station, lambda s: put(s, position_sd_m=before.position_sd_m), since
    )
    outcome.at_least("its 1-sigma grown", measured, 1e-4, "m", broken_by=broken_by)


def judge_tilt(evidence: Evidence, outcome: Outcome) -> None:
    station, since = evidence["station"], (evidence["at_us"], mutations.EVER)
    before, during = around(evidence)
    tilts = [(s.tilt_x_rad, s.tilt_y_rad) for s in (before, during)]
    measured = float(np.degrees(np.abs(np.subtract(*tilts)).max()))
    broken_by = mutations.status_altered(
        "the tilt goes off by 0.05 deg",
        station,
        lambda s: put(s, tilt_x_rad=s.tilt_x_rad + np.radians(0.05)),
        since,
    )
    outcome.at_most("tilt changed", measured, KEPT_DEG, "deg", broken_by=broken_by)
    measured = float(np.degrees(during.tilt_sd_rad - before.tilt_sd_rad))
    broken_by = mutations.status_altered(
        "the sigma stays", station, lambda s: put(s, tilt_sd_rad=before.tilt_sd_rad), since
    )
    outcome.at_least("its 1-sigma grown", measured, 1e-5, "deg", broken_by=broken_by)


def judge(evidence: Evidence, outcome: Outcome, words: tuple[str, ...]) -> None:
    station, at_us, ended_us = (evidence[name] for name in ("station", "at_us", "ended_us"))
    of_position = words[0].startswith("gnss")
    before, _ = around(evidence)
    source = before.position_source if of_position else before.tilt_source
    measured = source == POSE_SENSOR
    broken_by = mutations.status_altered(
        "the pose is a survey's", station, lambda s: put(s, position_source=1, tilt_source=1)
    )
    outcome.holds("its pose is the sensors'", measured, f"source {source}", broken_by=broken_by)
    judge_alarm(evidence, outcome, "flagged", station, at_us, FLAGGED_S, *words)
    (judge_position if of_position else judge_tilt)(evidence, outcome)
    judge_goes_on(evidence, outcome, station, (at_us, ended_us), 8.0)
    still = ended_us, ended_us + round((GONE_S + 6.0) * 1e6)
    measured = measure.first_s(
        evidence.heard,
        f"OLS_STATUS_{station}",
        ended_us,
        mutations.EVER,
        lambda status: not alarm_of(status, words[0]),
    )
    broken_by = mutations.alarm_instead(station, " ".join(words), still)
    outcome.recovered("alarm gone", measured, GONE_S, broken_by=broken_by)


def do(session: Session, evidence: Evidence, kind: str, word: str, value: float) -> None:
    station = evidence["station"] = session.sensor_station
    session.wait(lambda: not alarm_of(session.status(station), word), 10.0)
    session.fresh_status(station)
    evidence["at_us"] = session.fault(kind, station, HELD_S, value)
    evidence["ended_us"] = session.run(HELD_S)[1]
    session.wait(lambda: not alarm_of(session.status(station), word), 20.0)


# By the fault's name: what is done, its value, and the words of the alarm.
FAULTS = {
    "gnss-fix-lost": ("GNSS fix lost", "gnss-no-fix", float("nan"), ("gnss:", "no fix", "kept")),
    "gnss-jump": ("GNSS position jumps by 100 m", "gnss-jump", 100.0, ("gnss:", " m from the")),
    "gnss-silent": ("GNSS receiver silent", "gnss-silent", float("nan"), ("gnss:", "silent")),
    "inclinometer-stuck": (
        "inclinometer stuck",
        "inclinometer-stuck",
        float("nan"),
        ("inclinometer:", "stuck", "kept"),
    ),
}

for name, (what, kind, value, words) in FAULTS.items():
    case(
        name,
        f"{what} for {HELD_S:g} s",
        "pose kept, flagged, uncertainty grows",
        partial(judge, words=words),
    )(partial(do, kind=kind, word=words[0], value=value))
