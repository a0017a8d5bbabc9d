"""Faults of the camera and of its link."""

from ols_demo.bus import counters

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.judges import judge_motion
from ols_faults.session import Session

OK = 2  # station_status_t.DEVICE_OK
REPORTED_S = 2.5  # a camera that is gone is missed after some frames, and told of twice a second

# A frame is some 17 of the large packets that a loopback carries; on a real network it is hundreds
# of small ones, and 0.1 % does the same.
LOSS = 0.04


def camera_trouble(status: object, before: object) -> str:
    devices = dict(zip(status.device_name, status.device_state, strict=True))
    texts = dict(zip(status.device_name, status.device_text, strict=True))
    if devices.get("camera", OK) != OK:
        return f"camera state {devices['camera']} {texts['camera']}".strip()
    if any("camera" in alarm for alarm in status.alarm):
        return "alarm: " + "; ".join(a for a in status.alarm if "camera" in a)
    was, now = counters(before), counters(status)
    for name in ("frames_incomplete", "frames_lost", "frames_refused", "camera_reconnects"):
        if now.get(name, 0.0) > was.get(name, 0.0):
            return f"{name} +{now[name] - was.get(name, 0.0):g}"
    return ""


def reported(session: Session, station: str, since_us: int, before: object) -> tuple[float, str]:
    channel = f"OLS_STATUS_{station}"
    both = zip(session.heard.statuses[station], session.heard.arrivals_us[channel], strict=True)
    for status, at in both:
        trouble = camera_trouble(status, before) if at > since_us else ""
        if trouble:
            return (at - since_us) * 1e-6, trouble
    return float("nan"), "no"


def judge_recovery(session: Session, outcome: Outcome, station: str, ended_us: int) -> None:
    outcome.recovered("tracking again", session.tracking_again_s(station, ended_us, 30.0), 10.0)
    judge_motion(session, outcome, station, (ended_us - 5_000_000, session.now_us()))


@case("camera-gone", "camera gone for 5 s", "counted, reported, recovers")
def camera_gone(session: Session, outcome: Outcome) -> None:
    station = session.stations[0]
    before = session.fresh_status(station)
    at_us = session.fault("camera-gone", station, 5.0)
    session.run(5.0)
    ended_us = session.now_us()
    seen_s, text = reported(session, station, at_us, before)
    outcome.at_most(f"reported ({text})", seen_s, REPORTED_S, "s")
    judge_recovery(session, outcome, station, ended_us)


@case(
    "camera-packet-loss",
    "1 image packet in 25 lost for 10 s, no resend: many frames are spoiled",
    "counted, reported, recovers",
)
def camera_packet_loss(session: Session, outcome: Outcome) -> None:
    station = session.stations[1]
    before = session.fresh_status(station)
    at_us = session.fault("camera-no-resend", station, 10.0)
    session.fault("camera-packet-loss", station, 10.0, LOSS)
    start_us, end_us = session.run(10.0)
    seen_s, text = reported(session, station, at_us, before)
    outcome.at_most(f"counted ({text})", seen_s, 5.0, "s")
    ages = measure.bearing_ages_s(session.heard, station, start_us, end_us)
    outcome.at_least("bearings meanwhile", len(ages) / 10.0, 2.0, "Hz")
    now = counters(session.fresh_status(station))
    spoiled = now.get("frames_incomplete", 0.0) - counters(before).get("frames_incomplete", 0.0)
    outcome.at_least("spoiled frames", spoiled, 20.0)
    judge_recovery(session, outcome, station, end_us)


@case(
    "camera-wrong-format",
    "camera comes back with another pixel format for 5 s",
    "counted, reported, recovers",
)
def camera_wrong_format(session: Session, outcome: Outcome) -> None:
    station = session.stations[2]
    before = session.fresh_status(station)
    at_us = session.fault("camera-wrong-format", station, 8.0)
    session.fault("camera-gone", station, 3.0)
    session.run(8.0)
    seen_s, text = reported(session, station, at_us + 3_000_000, before)
    outcome.at_most(f"reported ({text})", seen_s, REPORTED_S, "s")
    texts = {
        dict(zip(s.device_name, s.device_text, strict=True)).get("camera", "")
        for s in session.statuses_since(station, at_us)
    } | {s.last_error for s in session.statuses_since(station, at_us)}
    named = sorted(t for t in texts if "format" in t.lower() or "Bayer" in t)
    outcome.holds("the format is named", bool(named), named[0] if named else "no")
    # The camera forgets the wrong format with the next connection.
    gone_us = session.fault("camera-gone", station, 1.0)
    session.run(1.0)
    judge_recovery(session, outcome, station, gone_us + 1_000_000)
