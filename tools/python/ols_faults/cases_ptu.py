"""Faults of the PTU's line and of the unit behind it."""

from ols_demo.bus import counters

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.judges import judge_angles, judge_motion
from ols_faults.session import Session

OK = 2  # station_status_t.DEVICE_OK
REPORTED_S = 1.5


def ptu_trouble(status: object, before: object) -> str:
    """What the status says of the PTU beyond what it said before; empty when nothing."""
    devices = dict(zip(status.device_name, status.device_state, strict=True))
    if devices.get("ptu", OK) != OK:
        return f"device state {devices['ptu']}"
    if any("ptu" in alarm for alarm in status.alarm):
        return "alarm: " + "; ".join(a for a in status.alarm if "ptu" in a)
    was, now = counters(before), counters(status)
    for name in (
        "ptu_timeouts",
        "ptu_garbled",
        "ptu_errors",
        "ptu_restarts",
        "ptu_port_failures",
        "ptu_resyncs",
        "ptu_echoes",
        "ptu_refused_positions",
        "ptu_reopens",
    ):
        if now.get(name, 0.0) > was.get(name, 0.0):
            return f"{name} +{now[name] - was.get(name, 0.0):g}"
    return ""


def reported_s(session: Session, station: str, since_us: int, before: object) -> float | None:
    """How long after `since_us` a status told of trouble with the PTU."""
    channel = f"OLS_STATUS_{station}"
    both = zip(session.heard.statuses[station], session.heard.arrivals_us[channel], strict=True)
    for status, at in both:
        if at > since_us and ptu_trouble(status, before):
            return (at - since_us) * 1e-6
    return None


def ridden_through(
    session: Session,
    outcome: Outcome,
    kind: str,
    seconds: float,
    value: float = float("nan"),
    station: int = 0,
) -> None:
    """A fault that must not interrupt the tracking."""
    name = session.stations[station]
    before = session.fresh_status(name)
    at_us = session.fault(kind, name, seconds, value)
    session.run(seconds + 1.0)
    window = at_us, session.now_us()
    seen = reported_s(session, name, at_us, before)
    text = ptu_trouble(session.status(name), before)
    outcome.holds("counted and reported", seen is not None, text or "no")
    judge_motion(session, outcome, name, window)
    judge_angles(session, outcome, name, window)
    offsets = measure.aim_offsets_px(session.heard, name, *window)
    height = session.status(name).image_height_px
    worst = float(offsets.max()) if len(offsets) else None
    outcome.at_most("target from the picture's middle", worst, height / 2, "px")
    outcome.recovered("tracking", session.tracking_again_s(name, window[1], 10.0), 3.0)


@case(
    "ptu-line-cut",
    "PTU line cut for 5 s",
    "reported at once, healed, no runaway, no angle off by more than 3 sigmas",
)
def ptu_line_cut(session: Session, outcome: Outcome) -> None:
    station, seconds = session.stations[0], 5.0
    before = session.fresh_status(station)
    at_us = session.fault("ptu-line-cut", station, seconds)
    session.run(seconds)
    ended_us = session.now_us()
    outcome.at_most("reported", reported_s(session, station, at_us, before), REPORTED_S, "s")
    rest = measure.rest_s(session.heard, station, at_us, ended_us)
    outcome.at_most("PTU at rest after the cut", rest, 1.0, "s")
    healed = session.wait(lambda: not unwell(session, station, ended_us), 10.0)
    outcome.at_most("line healed", healed, 5.0, "s")
    back_s = session.tracking_again_s(station, ended_us, 20.0)
    outcome.recovered("tracking again after the cut", back_s, 8.0)
    session.run(2.0)
    window = at_us, session.now_us()
    judge_motion(session, outcome, station, window)
    judge_angles(session, outcome, station, window)


def unwell(session: Session, station: str, since_us: int) -> bool:
    recent = session.statuses_since(station, since_us)
    if not recent:
        return True
    devices = dict(zip(recent[-1].device_name, recent[-1].device_state, strict=True))
    return devices.get("ptu") != OK


@case(
    "ptu-line-gone",
    "PTU's serial adapter unplugged for 5 s",
    "reported at once, healed, no runaway, no angle off by more than 3 sigmas",
)
def ptu_line_gone(session: Session, outcome: Outcome) -> None:
    station, seconds = session.stations[3], 5.0
    before = session.fresh_status(station)
    at_us = session.fault("ptu-line-gone", station, seconds)
    session.run(seconds)
    ended_us = session.now_us()
    outcome.at_most("reported", reported_s(session, station, at_us, before), REPORTED_S, "s")
    rest = measure.rest_s(session.heard, station, at_us, ended_us)
    outcome.at_most("PTU at rest", rest, 1.0, "s")
    back_s = session.tracking_again_s(station, ended_us, 20.0)
    outcome.recovered("tracking again", back_s, 8.0)
    session.run(1.0)
    window = at_us, session.now_us()
    judge_motion(session, outcome, station, window)
    judge_angles(session, outcome, station, window)


@case(
    "ptu-garbled",
    "1 % of the PTU's replies garbled for 15 s",
    "reported, healed, no runaway, no angle off by more than 3 sigmas",
)
def ptu_garbled(session: Session, outcome: Outcome) -> None:
    ridden_through(session, outcome, "ptu-garbled", 15.0, 0.01, station=1)


@case(
    "ptu-echo-on",
    "echo switched on in mid-run",
    "reported, healed, no runaway, no angle off by more than 3 sigmas",
)
def ptu_echo_on(session: Session, outcome: Outcome) -> None:
    ridden_through(session, outcome, "ptu-echo-on", 4.0, station=2)


@case(
    "ptu-reply-lost",
    "a reply lost every 4 s (the table: every minute)",
    "reported, healed, no runaway, no angle off by more than 3 sigmas",
)
def ptu_reply_lost(session: Session, outcome: Outcome) -> None:
    ridden_through(session, outcome, "ptu-reply-lost", 13.0, 4.0, station=3)
