"""Faults of the camera and of its link."""

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import (
    judge_alarm,
    judge_counted,
    judge_motion,
    judge_outage,
    judge_tracking_again,
)
from ols_faults.session import Session

REPORTED_S = 2.5  # a lost camera is noticed after some frames; statuses come twice a second
RECOVERED_S = 10.0
SHORTLY_US = 700_000  # frames that are under way when the fault begins

# A frame is some 17 of the large packets that a loopback carries; on a real network it is hundreds
# of small ones, and 0.1 % does the same.
LOSS = 0.04
GONE = "camera:", "no frames for"
WRONG_S = 8.0  # of which it is lost this long, so that it is opened again:
GONE_S = 3.0


def do_recover(session: Session, evidence: Evidence, station: str) -> None:
    evidence["station"] = station
    session.wait_for_tracking(station, evidence["ended_us"], 30.0)
    evidence["judged_us"] = session.run(1.0)[1]


def judge_recovery(evidence: Evidence, outcome: Outcome) -> None:
    station, ended_us = evidence["station"], evidence["ended_us"]
    judge_tracking_again(evidence, outcome, "tracking again", station, ended_us, RECOVERED_S)
    judge_motion(evidence, outcome, station, (ended_us - 5_000_000, evidence["judged_us"]))


def judge_gone(evidence: Evidence, outcome: Outcome) -> None:
    station, at_us, ended_us = (evidence[name] for name in ("station", "at_us", "ended_us"))
    channel = f"OLS_STATUS_{station}"
    judge_outage(evidence, outcome, station, (at_us + SHORTLY_US, ended_us))
    judge_alarm(evidence, outcome, "reported", station, at_us, REPORTED_S, *GONE)
    window = at_us, evidence["judged_us"]
    judge_counted(evidence, outcome, "counted", channel, "camera_reconnects", window, 1.0)
    judge_recovery(evidence, outcome)


@case("camera-gone", "camera gone for 5 s", "counted, reported, recovers", judge_gone)
def camera_gone(session: Session, evidence: Evidence) -> None:
    station = session.stations[0]
    session.fresh_status(station)
    evidence["at_us"] = session.fault("camera-gone", station, 5.0)
    evidence["ended_us"] = session.run(5.0)[1]
    do_recover(session, evidence, station)
    session.run(0.6)  # the next status counts it
    evidence["judged_us"] = session.now_us()


def judge_packet_loss(evidence: Evidence, outcome: Outcome) -> None:
    station, window = evidence["station"], (evidence["at_us"], evidence["ended_us"])
    channel = f"OLS_STATUS_{station}"
    words = "camera:", "of the frames incomplete"
    judge_alarm(evidence, outcome, "reported", station, window[0], 5.0, *words)
    measured = measure.bearings_hz(evidence.heard, station, *window)
    broken_by = mutations.bearings_lost(station, window, 0.78)
    outcome.at_least("bearings meanwhile", measured, 4.0, "Hz", broken_by=broken_by)
    name = "frames_incomplete"
    judge_counted(evidence, outcome, "spoiled frames counted", channel, name, window, 20.0)
    judge_recovery(evidence, outcome)


@case(
    "camera-packet-loss",
    "1 image packet in 25 lost for 10 s, no resend: many frames are spoiled",
    "counted, reported, recovers",
    judge_packet_loss,
)
def camera_packet_loss(session: Session, evidence: Evidence) -> None:
    station = session.stations[1]
    session.fresh_status(station)
    evidence["at_us"] = session.fault("camera-no-resend", station, 10.0)
    session.fault("camera-packet-loss", station, 10.0, LOSS)
    evidence["ended_us"] = session.run(10.0)[1]
    do_recover(session, evidence, station)


def judge_wrong_format(evidence: Evidence, outcome: Outcome) -> None:
    """Ignores the alarms of the camera's absence: only those after its return count."""
    station, back_us = evidence["station"], evidence["back_us"]
    judge_outage(evidence, outcome, station, (back_us, evidence["wrong_until_us"]))
    words = "camera:", "BayerRG8", "Mono8"  # what it sends, and what it was configured to send
    judge_alarm(evidence, outcome, "both formats named", station, back_us, REPORTED_S, *words)
    judge_recovery(evidence, outcome)


@case(
    "camera-wrong-format",
    "camera comes back with another pixel format for 5 s",
    "reported by both formats' names, recovers",
    judge_wrong_format,
)
def camera_wrong_format(session: Session, evidence: Evidence) -> None:
    station = session.stations[2]
    session.fresh_status(station)
    at_us = session.fault("camera-wrong-format", station, WRONG_S)
    session.fault("camera-gone", station, GONE_S)
    evidence["back_us"] = at_us + round(GONE_S * 1e6)
    evidence["wrong_until_us"] = session.run(WRONG_S)[1]
    # The camera forgets the wrong format with the next connection.
    session.fault("camera-gone", station, 1.0)
    evidence["ended_us"] = session.run(1.0)[1]
    do_recover(session, evidence, station)
