"""Processes that are killed or starved."""

import signal

import numpy as np
import ols_msg

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.session import Session

REST_S = 1.0
BACK_BY_SLEW_S = 8.0
BACK_FUSION_S = 2.0
RATE_DEG_S = 20.0
STARVED_S = 2.0


def killed_and_back(session: Session, outcome: Outcome, station: str, held: bool = False) -> None:
    """Kills the station now; judges the PTU's rest and the way back to the target by slew. `held`:
    the operator had it in hand."""
    at_us = session.kill(session.process(station))
    session.run(REST_S + 2 * measure.REST_S)
    rest = measure.rest_s(session.heard, station, at_us, session.now_us())
    outcome.at_most("PTU at rest after the kill", rest, REST_S, "s")
    started_us = session.start_station(station)
    if held:  # it comes up as it was left, until somebody releases it
        session.wait(lambda: session.state(station) == "stopped", 5.0)
        session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
    back_s = session.tracking_again_s(station, started_us, BACK_BY_SLEW_S + 7.0)
    outcome.recovered("tracking again after its start", back_s, BACK_BY_SLEW_S)
    designated = session.counter(station, "designate_accepted")
    outcome.holds("by slew alone", designated == 0, f"{designated:g} designations")


@case(
    "station-killed",
    "station killed while it tracks, restarted",
    "PTU at rest within 1 s; tracking again by slew within 8 s of start",
)
def station_killed(session: Session, outcome: Outcome) -> None:
    killed_and_back(session, outcome, session.stations[0])


@case(
    "station-killed-fast",
    "station killed while its PTU turns at 20 deg/s",
    "PTU at rest within 1 s; tracking again by slew within 8 s of start",
)
def station_killed_fast(session: Session, outcome: Outcome) -> None:
    station = session.stations[1]
    start = session.status(station)
    speed = turn_steadily(session, station, start.pan_rad, start.tilt_rad, 2.5)
    outcome.at_least("PTU's speed at the kill", speed, 0.9 * RATE_DEG_S, "deg/s")
    killed_and_back(session, outcome, station, held=True)


def turn_steadily(
    session: Session, station: str, pan_rad: float, tilt_rad: float, seconds: float
) -> float:
    """Leads the PTU by hand at RATE_DEG_S for so long; its true speed at the end [deg/s]."""
    way = -1.0 if pan_rad > 0 else 1.0
    begin_us = session.now_us()
    while (elapsed := (session.now_us() - begin_us) * 1e-6) < seconds:
        goal = pan_rad + way * np.radians(RATE_DEG_S) * elapsed
        session.command(station, ols_msg.ptu_command_t.COMMAND_POINT, goal, tilt_rad)
        session.run(0.04)
    now_us = session.now_us()
    times, angles = measure.ptu_track(session.heard, station, now_us - 400_000, now_us)
    return float(np.median(measure.speeds(times, angles))) if len(times) else float("nan")


@case(
    "fusion-killed",
    "fusion killed, restarted after 3 s",
    "stations go on tracking; targets again within 2 s of start",
)
def fusion_killed(session: Session, outcome: Outcome) -> None:
    killed_us = session.kill("ols-fusion")
    start_us, end_us = session.run(3.0)
    for station in session.stations:
        ages = measure.bearing_ages_s(session.heard, station, start_us, end_us)
        outcome.at_least(f"{station}: bearings without fusion", len(ages) / 3.0, 5.0, "Hz")
        away = session.state_since(station, start_us) - {"tracking", "coasting"}
        outcome.holds(f"{station}: goes on tracking", not away, ", ".join(away) or "yes")
    started_us = session.start_fusion()
    came = session.wait(
        lambda: bool(measure.target_arrivals_us(session.heard, started_us, session.now_us())),
        BACK_FUSION_S + 5.0,
    )
    arrivals = measure.target_arrivals_us(session.heard, started_us, session.now_us())
    back = (arrivals[0] - started_us) * 1e-6 if came is not None and arrivals else None
    outcome.recovered("targets again after its start", back, BACK_FUSION_S)
    gap = measure.longest_gap_s(arrivals[-1:], killed_us, session.now_us())
    outcome.holds("there really was an outage", gap > 2.0, f"{gap:.1f} s")


@case(
    "cpu-starved",
    "station's process does not run for 2 s (SIGSTOP)",
    "PTU at rest; late frames dropped, not queued; recovers",
)
def cpu_starved(session: Session, outcome: Outcome) -> None:
    station = session.stations[2]
    before_us = session.now_us() - 4_000_000
    before = measure.bearing_ages_s(session.heard, station, before_us, session.now_us())
    usual_s = float(np.median(before[:, 1])) if len(before) else float("nan")
    frames = frames_seen(session, station)
    name = session.process(station)
    stopped_us = session.send_signal(name, signal.SIGSTOP)
    session.run(STARVED_S)
    rest = measure.rest_s(session.heard, station, stopped_us, session.now_us())
    going_us = session.send_signal(name, signal.SIGCONT)
    outcome.at_most("PTU at rest after the stop", rest, REST_S, "s")
    back_s = session.tracking_again_s(station, going_us, 10.0)
    session.run(3.0)
    ages = measure.bearing_ages_s(session.heard, station, going_us, session.now_us())
    stale = int((ages[:, 1] > 0.5).sum()) if len(ages) else 0
    outcome.at_most("bearings older than 0.5 s that were still sent", stale, 2)
    late = ages[ages[:, 0] > 1.0]
    worst = float(np.percentile(late[:, 1], 90)) if len(late) else float("nan")
    outcome.at_most("age of bearings from 1 s after (90 %)", worst, max(0.25, 2 * usual_s), "s")
    passed_s = (session.now_us() - stopped_us) * 1e-6
    expected = passed_s * 12.0
    handled = frames_seen(session, station) - frames
    outcome.at_most("share of that time's frames handled", handled / expected, 0.85)
    outcome.recovered("tracking again", back_s, 8.0)


def frames_seen(session: Session, station: str) -> float:
    session.fresh_status(station)
    return session.counter(station, "frames_tracked")
