"""Processes that are killed or starved."""

import signal

import numpy as np
import ols_msg
from ols_demo.evaluate import JOINT, OK

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.configuration import ACCELERATION_DEG_S2
from ols_faults.evidence import Evidence
from ols_faults.judges import (
    FRAME_HZ,
    judge_goes_on,
    judge_rest,
    judge_target,
    judge_tracking_again,
)
from ols_faults.mutations import put
from ols_faults.session import Session

REST_S = 1.0
BACK_BY_SLEW_S = 8.0
BACK_FUSION_S = 2.0
RATE_DEG_S = 20.0
FOLLOWING_DEG_S = 0.5  # a PTU that hardly moves is soon at rest
STARVED_S = 2.0
KILLED_S = 3.0

# From full speed: as ServoConfig has it (runs_on_s in edge/ptu/servo.h).
FULL_DEG_S = 57.0
AHEAD_S = max(0.3, 1.0 / 3.0)  # look_ahead_s, 1 / gain_hz
SWING_DEG = 160.0
POLL_S = 0.025  # a command may just have been sent


def kill(session: Session, evidence: Evidence, station: str) -> None:
    """Kills the station and waits as long as its PTU may need to come to rest."""
    evidence["station"] = station
    evidence["boot"] = session.status(station).boot_id
    evidence["at_us"] = session.kill(session.process(station))
    evidence["dead_until_us"] = session.run(REST_S + 3 * measure.REST_S)[1]


def back(session: Session, evidence: Evidence, held: bool = False) -> None:
    """`held`: it was in manual control."""
    station = evidence["station"]
    evidence["started_us"] = session.start_station(station)
    if held:
        session.release_held(station)
    session.wait_for_tracking(station, evidence["started_us"], BACK_BY_SLEW_S + 7.0)
    session.fresh_status(station)
    evidence["judged_us"] = session.now_us()


def judge_speed(evidence: Evidence, outcome: Outcome, what: str, least_deg_s: float) -> None:
    """Checks that it moved before the kill; otherwise coming to rest proves nothing."""
    station, at_us = evidence["station"], evidence["at_us"]
    window = at_us - 150_000, at_us
    speed = measure.speeds(*measure.ptu_track(evidence.heard, station, *window))
    measured = float(np.median(speed)) if len(speed) else None
    broken_by = mutations.stands(station, (window[0] - 100_000, at_us))
    outcome.at_least(what, measured, least_deg_s, "deg/s", broken_by=broken_by)


def judge_back_by_slew(evidence: Evidence, outcome: Outcome) -> None:
    station, since_us = evidence["station"], evidence["started_us"]
    what = "tracking again after its start"
    judge_tracking_again(evidence, outcome, what, station, since_us, BACK_BY_SLEW_S)
    window = since_us, evidence["judged_us"]
    said = measure.statuses(evidence.heard, station, *window)
    measured = bool(said) and all(status.boot_id != evidence["boot"] for status in said)
    broken_by = mutations.status_altered(
        "it was not killed", station, lambda s: put(s, boot_id=evidence["boot"])
    )
    outcome.holds("it is another process", measured, broken_by=broken_by)
    channel = f"OLS_STATUS_{station}"
    found = measure.counter_at_end(evidence.heard, channel, "acquisitions", *window)
    broken_by = mutations.without_counter(channel, "acquisitions")
    outcome.at_least("found along a slew", found, 1.0, note="acquisitions", broken_by=broken_by)
    by_hand = measure.counter_at_end(evidence.heard, channel, "designate_accepted", *window)
    broken_by = mutations.counter_more(channel, "designate_accepted", 1.0, window)
    outcome.at_most("designations by hand", by_hand, 0.0, broken_by=broken_by)


def judge_killed(evidence: Evidence, outcome: Outcome, least_deg_s: float) -> None:
    judge_speed(evidence, outcome, "PTU's speed at the kill", least_deg_s)
    window = evidence["at_us"], evidence["dead_until_us"]
    judge_rest(evidence, outcome, evidence["station"], window, REST_S)
    judge_back_by_slew(evidence, outcome)


CRITERION = "PTU at rest within 1 s; tracking again by slew within 8 s of start"


@case(
    "station-killed",
    "station killed while it tracks, restarted",
    CRITERION,
    lambda evidence, outcome: judge_killed(evidence, outcome, FOLLOWING_DEG_S),
)
def station_killed(session: Session, evidence: Evidence) -> None:
    station = session.stations[0]
    session.wait_until_turning(station, 2 * FOLLOWING_DEG_S, 30.0)
    kill(session, evidence, station)
    back(session, evidence)


@case(
    "station-killed-fast",
    f"station killed while its PTU turns at {RATE_DEG_S:g} deg/s",
    CRITERION,
    lambda evidence, outcome: judge_killed(evidence, outcome, 0.9 * RATE_DEG_S),
)
def station_killed_fast(session: Session, evidence: Evidence) -> None:
    station = session.stations[1]
    start = session.status(station)
    turn_steadily(session, station, start.pan_rad, start.tilt_rad, 2.5)
    kill(session, evidence, station)
    back(session, evidence, held=True)


def turn_steadily(
    session: Session, station: str, pan_rad: float, tilt_rad: float, seconds: float
) -> None:
    """Moves the PTU manually at RATE_DEG_S for this time."""
    way = -1.0 if pan_rad > 0 else 1.0
    begin_us = session.now_us()
    while (elapsed := (session.now_us() - begin_us) * 1e-6) < seconds:
        goal = pan_rad + way * np.radians(RATE_DEG_S) * elapsed
        session.command(station, ols_msg.ptu_command_t.COMMAND_POINT, goal, tilt_rad)
        session.run(0.04)


def judge_full_speed(evidence: Evidence, outcome: Outcome) -> None:
    """Checks that it moves no longer and no further than its servo permits."""
    station = evidence["station"]
    window = evidence["at_us"], evidence["dead_until_us"]
    judge_speed(evidence, outcome, "PTU's speed at the kill", 0.95 * FULL_DEG_S)
    speed = 57.5  # ServoConfig::max_speed_rad_s
    braking_s = speed / ACCELERATION_DEG_S2
    unsure_s = POLL_S + measure.SMOOTH_S
    judge_rest(evidence, outcome, station, window, AHEAD_S + braking_s + unsure_s)
    outcome.at_most(
        "travels on",
        measure.moved_deg(evidence.heard, station, *window),
        speed * (AHEAD_S + braking_s / 2 + unsure_s),
        "deg",
        broken_by=mutations.goes_further(station, window, 1.25),
    )
    judge_back_by_slew(evidence, outcome)


@case(
    "killed-at-full-speed",
    "station killed while its PTU swings at full speed (57 deg/s)",
    "PTU at rest after the servo's look-ahead plus v/a; tracking again by slew",
    judge_full_speed,
)
def killed_at_full_speed(session: Session, evidence: Evidence) -> None:
    station = session.stations[1]
    swing_to_full_speed(session, station)
    kill(session, evidence, station)
    back(session, evidence, held=True)


def swing_to_full_speed(session: Session, station: str) -> None:
    status = session.status(station)
    side = 1.0 if status.pan_rad > 0 else -1.0
    point = ols_msg.ptu_command_t.COMMAND_POINT
    for at in (side, -side):
        goal_rad = float(np.radians(at * SWING_DEG / 2))
        session.command(station, point, goal_rad, status.tilt_rad)
        session.wait_until_turning(station, 0.97 * FULL_DEG_S, 2.0)
        if at == side:
            session.wait(lambda: session.speed_deg_s(station) < 0.5, 6.0)


def judge_fusion_killed(evidence: Evidence, outcome: Outcome) -> None:
    window, started_us = evidence["window"], evidence["started_us"]
    for station in evidence.stations:
        judge_goes_on(evidence, outcome, station, window, 5.0)
    shortly = window[0] + 300_000, window[1]
    measured = float(len(measure.target_arrivals_us(evidence.heard, *shortly)))
    broken_by = mutations.late("the fusion continues", JOINT, (0, window[0]), 1.0)
    outcome.at_most("targets while there was none", measured, 0.0, broken_by=broken_by)
    late = started_us, started_us + round((BACK_FUSION_S + 1.0) * 1e6)
    measured = measure.first_s(
        evidence.heard, JOINT, started_us, mutations.EVER, lambda t: t.solution == OK
    )
    broken_by = mutations.targets_lost(late)
    outcome.recovered("targets again after its start", measured, BACK_FUSION_S, broken_by=broken_by)
    judge_target(evidence, outcome, evidence["after"], 8.0)


@case(
    "fusion-killed",
    "fusion killed, restarted after 3 s",
    "stations continue to track; targets again within 2 s of start",
    judge_fusion_killed,
)
def fusion_killed(session: Session, evidence: Evidence) -> None:
    killed_us = session.kill("ols-fusion")
    evidence["window"] = killed_us, session.run(KILLED_S)[1]
    evidence["started_us"] = session.start_fusion()
    since_us = evidence["started_us"]
    session.wait(
        lambda: bool(measure.target_arrivals_us(session.heard, since_us, session.now_us())),
        BACK_FUSION_S + 5.0,
    )
    session.run(1.0)
    evidence["after"] = session.run(2.0)


def judge_starved(evidence: Evidence, outcome: Outcome) -> None:
    station, stopped_us, going_us = (evidence[n] for n in ("station", "stopped_us", "going_us"))
    end_us = evidence["judged_us"]
    channel = f"OLS_BEARING_{station}"
    judge_rest(evidence, outcome, station, (stopped_us, going_us), REST_S)
    ages = measure.bearing_ages_s(evidence.heard, station, going_us, end_us)
    outcome.at_most(
        "bearings older than 0.5 s that were still sent",
        float((ages[:, 1] > 0.5).sum()) if len(ages) else None,
        2.0,
        broken_by=mutations.late("frames are queued", channel, (going_us, end_us), 0.8),
    )
    before = measure.bearing_ages_s(evidence.heard, station, stopped_us - 4_000_000, stopped_us)
    usual_s = float(np.median(before[:, 1])) if len(before) else float("nan")
    late = ages[ages[:, 0] > 1.0]
    outcome.at_most(
        "age of bearings from 1 s after (90 %)",
        float(np.percentile(late[:, 1], 90)) if len(late) else None,
        max(0.25, 2 * usual_s),
        "s",
        broken_by=mutations.late("a backlog stays", channel, (going_us, end_us), 0.4),
    )
    status = f"OLS_STATUS_{station}"
    expected = (end_us - stopped_us) * 1e-6 * FRAME_HZ
    handled = measure.grown(evidence.heard, status, "frames_tracked", stopped_us, end_us)
    share = handled / expected if handled is not None else None
    broken_by = mutations.counter_more(
        status, "frames_tracked", STARVED_S * FRAME_HZ, (going_us, end_us)
    )
    outcome.at_most("share of that time's frames handled", share, 0.85, broken_by=broken_by)
    broken_by = mutations.without_counter(status, "frames_tracked")
    outcome.at_least("and at least", share, 0.35, broken_by=broken_by)
    judge_tracking_again(evidence, outcome, "tracking again", station, going_us, 8.0)


@case(
    "cpu-starved",
    "station's process does not run for 2 s (SIGSTOP)",
    "PTU at rest; late frames dropped, not queued; recovers",
    judge_starved,
)
def cpu_starved(session: Session, evidence: Evidence) -> None:
    station = evidence["station"] = session.stations[2]
    session.wait_until_turning(station, 2 * FOLLOWING_DEG_S, 30.0)
    session.fresh_status(station)
    name = session.process(station)
    evidence["stopped_us"] = session.send_signal(name, signal.SIGSTOP)
    session.run(STARVED_S)
    evidence["going_us"] = session.send_signal(name, signal.SIGCONT)
    session.wait_for_tracking(station, evidence["going_us"], 10.0)
    session.run(3.0)
    session.fresh_status(station)
    evidence["judged_us"] = session.now_us()
