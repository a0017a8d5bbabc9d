"""A station's clock that is stepped: for its process alone."""

import sys
from typing import Any

import numpy as np
import ols_msg
from ols_demo.evaluate import JOINT

from ols_faults.case import Outcome, case
from ols_faults.judges import judge_target
from ols_faults.session import Session

MARKED_S = 3.0
QUARANTINED_S = 3.0
STEPPED_S = 15.0
RETURN_S = 20.0  # it is distrusted for a while: see configuration.py


class SteppedClock:
    """A station whose wall clock can be stepped; CLOCK_MONOTONIC goes on as it does."""

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


def marked_s(session: Session, station: str, since_us: int, step_s: float) -> tuple[float, str]:
    """When the first bearing that was marked came, and how; the mark must cover the step."""
    arrivals = session.heard.arrivals_us[f"OLS_BEARING_{station}"]
    for bearing, at in zip(session.heard.bearings[station], arrivals, strict=True):
        bad = bearing.clock_state == ols_msg.bearing_t.CLOCK_UNSYNCHRONISED
        if at > since_us and (bad or bearing.clock_error_s > 0.1 * abs(step_s)):
            text = f"state {bearing.clock_state}, error {bearing.clock_error_s:.3g} s"
            return (at - since_us) * 1e-6, text
    return float("nan"), "not marked"


def used(target: Any) -> set[str]:
    return {s for s, is_used in zip(target.station, target.used, strict=True) if is_used}


def clock_stepped(session: Session, outcome: Outcome, step_s: float) -> None:
    station = session.clock_station
    others = set(session.stations) - {station}
    clock = SteppedClock(session, station)
    try:
        session.restore()
        session.run(8.0)
        at_us = clock.set(step_s)
        window = session.run(STEPPED_S)
        judge_step(session, outcome, station, others, (at_us, window[1]), step_s)
        back_us = clock.set(0.0)
        came = session.wait(lambda: station in used(newest_target(session)), RETURN_S)
        back_s = (session.now_us() - back_us) * 1e-6 if came is not None else None
        outcome.recovered("in the targets again once the clock is right", back_s, RETURN_S)
    finally:
        clock.close()


def newest_target(session: Session) -> Any:
    return session.heard.targets[JOINT][-1]


def judge_step(
    session: Session,
    outcome: Outcome,
    station: str,
    others: set[str],
    window: tuple[int, int],
    step_s: float,
) -> None:
    stamps = [b.utime for b in session.heard.bearings[station][-5:]]
    ahead = (float(np.median(stamps)) - window[1]) * 1e-6
    outcome.holds("the clock was stepped", abs(ahead - step_s) < 0.5, f"{ahead:+.2f} s")
    seen_s, text = marked_s(session, station, window[0], step_s)
    outcome.at_most(f"bearings marked ({text})", seen_s, MARKED_S, "s")
    arrivals = session.heard.arrivals_us[JOINT]
    later = [
        target
        for target, at in zip(session.heard.targets[JOINT], arrivals, strict=True)
        if window[0] + int(QUARANTINED_S * 1e6) < at < window[1] and target.solution == 0
    ]
    outcome.at_least("targets meanwhile", len(later) / (STEPPED_S - QUARANTINED_S), 5.0, "Hz")
    with_it = sum(station in used(target) for target in later)
    outcome.at_most("of them with this station", with_it, 0)
    lacking = sum(not others <= used(target) for target in later)
    outcome.at_most("share of them that lack another", lacking / max(1, len(later)), 0.1)
    judge_target(session, outcome, window)


@case(
    "clock-ahead",
    "a station's clock stepped by +2 s",
    "bearings marked; fusion quarantines that station alone",
)
def clock_ahead(session: Session, outcome: Outcome) -> None:
    clock_stepped(session, outcome, 2.0)


@case(
    "clock-behind",
    "a station's clock stepped by -2 s",
    "bearings marked; fusion quarantines that station alone",
)
def clock_behind(session: Session, outcome: Outcome) -> None:
    clock_stepped(session, outcome, -2.0)
