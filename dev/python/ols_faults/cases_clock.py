"""Steps a station's clock, as seen by its process alone."""

import sys
from functools import partial
from typing import Any

import numpy as np
import ols_msg
from ols_demo.evaluate import JOINT

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import judge_target
from ols_faults.mutations import put
from ols_faults.session import Session

MARKED_S = 3.0
QUARANTINED_S = 3.0
STEPPED_S = 12.0
RETURN_S = 20.0  # it is distrusted for a while: see configuration.py


class SteppedClock:
    """A station whose wall clock can be stepped; CLOCK_MONOTONIC is not affected."""

    def __init__(self, session: Session, station: str):
        self._session, self._station = session, station
        self._file = session.site.logs / "clock-offset"
        self._file.write_bytes(bytes(8))
        session.kill(session.process(station))
        session.start_station(
            station,
            {
                "LD_PRELOAD": session.wiring.program("libols-stepped-clock.so"),
                "OLS_CLOCK_OFFSET_FILE": str(self._file),
            },
        )

    def set(self, offset_s: float) -> int:
        with open(self._file, "r+b", buffering=0) as file:  # in place: the process has it mapped
            file.write(round(offset_s * 1e9).to_bytes(8, sys.byteorder, signed=True))
        return self._session.now_us()

    def close(self) -> None:
        self._session.kill(self._session.process(self._station))
        self._session.start_station(self._station)


def is_marked(bearing: Any, step_s: float) -> bool:
    """The mark must cover the step."""
    bad = bearing.clock_state == ols_msg.bearing_t.CLOCK_UNSYNCHRONISED
    return bad or bearing.clock_error_s > 0.1 * abs(step_s)


def unmarked(bearing: Any) -> Any:
    return put(bearing, clock_state=ols_msg.bearing_t.CLOCK_SYNCHRONISED, clock_error_s=1e-3)


def judge_marks(evidence: Evidence, outcome: Outcome, step_s: float) -> None:
    station, window = evidence["station"], evidence["window"]
    channel = f"OLS_BEARING_{station}"
    stamps = [b.utime - at for b, at in measure.between_arrivals(evidence.heard, channel, *window)]
    ahead_s = float(np.median(stamps[-20:])) * 1e-6 if stamps else float("nan")

    def not_stepped(bearing: Any) -> Any:
        return put(bearing, utime=bearing.utime - round(step_s * 1e6))

    measured = abs(ahead_s - step_s) < 0.5
    broken_by = mutations.altering("the clock is not stepped", channel, not_stepped, window)
    outcome.holds("the clock was stepped", measured, f"{ahead_s:+.2f} s", broken_by=broken_by)
    marked = partial(is_marked, step_s=step_s)
    measured = measure.first_s(evidence.heard, channel, *window, marked)
    broken_by = mutations.altering("bearings are not marked", channel, unmarked)
    outcome.at_most("bearings marked", measured, MARKED_S, "s", broken_by=broken_by)
    before = measure.between_arrivals(evidence.heard, channel, window[0] - 3_000_000, window[0])

    def always_marked(bearing: Any) -> Any:
        return put(bearing, clock_error_s=abs(step_s))

    measured = bool(before) and not any(marked(bearing) for bearing, _ in before)
    broken_by = mutations.altering("bearings are always marked", channel, always_marked)
    outcome.holds("and not before", measured, broken_by=broken_by)


def judge_quarantine(evidence: Evidence, outcome: Outcome) -> None:
    station, window = evidence["station"], evidence["window"]
    others = set(evidence.stations) - {station}
    span = window[0] + round(QUARANTINED_S * 1e6), window[1]
    later = measure.positions(evidence.heard, *span)
    measured = float(sum(station in measure.used(target) for target in later)) if later else None
    broken_by = mutations.rays("the stepped station is used", station, True, span)
    outcome.at_most(
        "targets with this station", measured, 0, note=f"of {len(later)}", broken_by=broken_by
    )
    lacking = sum(not others <= measure.used(target) for target in later)
    other = min(others)
    outcome.at_most(
        "share of targets that lack another station",
        lacking / len(later) if later else None,
        0.1,
        broken_by=mutations.rays(f"{other} is left out too", other, False, span),
    )
    told = [m for m, _ in measure.between_arrivals(evidence.heard, "OLS_FUSION_STATUS", *span)]
    named = {
        name
        for status in told
        for name, why in zip(status.station, status.quarantine, strict=True)
        if why
    }

    def silent(status: Any) -> Any:
        return put(status, quarantine=[""] * status.stations)

    outcome.holds(
        "the fusion names it, and it alone",
        named == {station},
        ", ".join(sorted(named)) or "no station",
        broken_by=mutations.altering("no quarantine is reported", "OLS_FUSION_STATUS", silent),
    )


def judge(evidence: Evidence, outcome: Outcome, step_s: float) -> None:
    station, window = evidence["station"], evidence["window"]
    judge_marks(evidence, outcome, step_s)
    judge_quarantine(evidence, outcome)
    judge_target(evidence, outcome, window, 5.0)
    back_us = evidence["back_us"]
    late = back_us, back_us + round((RETURN_S + 1.0) * 1e6)
    outcome.recovered(
        "in the targets again once the clock is right",
        measure.first_s(
            evidence.heard, JOINT, back_us, mutations.EVER, lambda t: station in measure.used(t)
        ),
        RETURN_S,
        broken_by=mutations.rays("the station is not used again", station, False, late),
    )


def clock_stepped(session: Session, evidence: Evidence, step_s: float) -> None:
    station = evidence["station"] = session.clock_station
    clock = SteppedClock(session, station)
    try:
        session.restore()
        session.run(8.0)
        at_us = clock.set(step_s)
        evidence["window"] = at_us, session.run(STEPPED_S)[1]
        evidence["back_us"] = clock.set(0.0)
        newest = session.heard.targets[JOINT]
        session.wait(lambda: station in measure.used(newest[-1]), RETURN_S)
    finally:
        clock.close()


CRITERION = "bearings marked; fusion quarantines that station alone"


@case("clock-ahead", "a station's clock stepped by +2 s", CRITERION, partial(judge, step_s=2.0))
def clock_ahead(session: Session, evidence: Evidence) -> None:
    clock_stepped(session, evidence, 2.0)


@case("clock-behind", "a station's clock stepped by -2 s", CRITERION, partial(judge, step_s=-2.0))
def clock_behind(session: Session, evidence: Evidence) -> None:
    clock_stepped(session, evidence, -2.0)
