"""Faults of the PTU's line and of the unit behind it."""

import ols_msg
from ols_demo.bus import counters

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.judges import judge_angles, judge_motion, judge_target
from ols_faults.session import Session

OK = 2  # station_status_t.DEVICE_OK
REPORTED_S = 1.5
HOME = ols_msg.ptu_command_t.COMMAND_HOME
HOMING_S = 60.0
STILL_DEG = 0.02
SLIP_DEG = 1.0
SHORTLY_S = 1.0


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
        "ptu_power_cycles",
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


def judge_since(session: Session, outcome: Outcome, station: str, since_us: int) -> None:
    session.run(2.0)
    window = since_us, session.now_us()
    judge_motion(session, outcome, station, window)
    judge_angles(session, outcome, station, window)


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
    judge_since(session, outcome, station, at_us)


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
    judge_since(session, outcome, station, at_us)


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


def power_cycle(session: Session, outcome: Outcome, station: str, homes: bool) -> int:
    """Off and on; returns when it was."""
    before = session.fresh_status(station)
    at_us = session.fault("ptu-power-cycle", station, 2.0, float(homes))
    session.run(4.0)
    outcome.at_most("reported", reported_s(session, station, at_us, before), REPORTED_S, "s")
    return at_us


def home_and_back(session: Session, outcome: Outcome, station: str) -> int:
    """The operator has it homed; returns when it was ready."""
    session.command(station, HOME)
    session.run(2.0)
    homed_us = session.now_us()
    healed = session.wait(lambda: not unwell(session, station, homed_us), HOMING_S)
    outcome.at_most("ready after `home`", healed, HOMING_S, "s")
    again_us = session.now_us()
    back_s = session.tracking_again_s(station, again_us, 20.0)
    outcome.recovered("tracking again, by slews, after it was homed", back_s, 10.0)
    return again_us


@case(
    "ptu-power-cycle",
    "PTU off and on, it homes itself",
    "reported, healed by itself, no runaway, no angle off by more than 3 sigmas",
)
def ptu_power_cycle(session: Session, outcome: Outcome) -> None:
    station = session.stations[1]
    at_us = power_cycle(session, outcome, station, homes=True)
    healed = session.wait(lambda: not unwell(session, station, at_us), HOMING_S)
    outcome.at_most("ready again", healed, HOMING_S, "s")
    again_us = session.now_us()
    back_s = session.tracking_again_s(station, again_us, 20.0)
    outcome.recovered("tracking again, by slews, after it homed", back_s, 10.0)
    judge_since(session, outcome, station, at_us)


@case(
    "ptu-power-cycle-unhomed",
    "PTU off and on, it does not home itself",
    "reported, no bearing and no motion until it was homed, no angle off by more than 3 sigmas",
)
def ptu_power_cycle_unhomed(session: Session, outcome: Outcome) -> None:
    station = session.stations[2]
    at_us = power_cycle(session, outcome, station, homes=False)
    start_us, end_us = session.run(6.0)
    moved = measure.moved_deg(session.heard, station, start_us, end_us)
    outcome.at_most("moved while in doubt", moved, STILL_DEG, "deg")
    shortly_us = at_us + round(SHORTLY_S * 1e6)
    published = measure.between(session.heard.bearings.get(station, []), shortly_us, end_us)
    outcome.at_most("bearings while in doubt", float(len(published)), 0.0)
    outcome.holds("still reported", unwell(session, station, start_us))
    home_and_back(session, outcome, station)
    judge_since(session, outcome, station, at_us)


def bearings_set_aside(session: Session) -> float:
    return counters(session.observer.fusion).get("bearings_set_aside", 0.0)


@case(
    "ptu-lost-steps",
    f"PTU's pan slips by {SLIP_DEG:g} deg, unnoticed by the unit",
    "its rays are set aside, the target stays; no angle off by more than 3 sigmas once homed",
)
def ptu_lost_steps(session: Session, outcome: Outcome) -> None:
    """No unit tells of it, and so no station can: the others show it."""
    station = session.stations[3]
    aside = bearings_set_aside(session)
    at_us = session.fault("ptu-lost-steps", station, 1e6, SLIP_DEG)
    seen = session.wait(lambda: bearings_set_aside(session) > aside, 5.0)
    outcome.at_most("rays set aside by the fusion", seen, 5.0, "s")
    session.run(1.5)  # until its filter has followed
    judge_target(session, outcome, session.run(4.0))
    again_us = home_and_back(session, outcome, station)
    judge_since(session, outcome, station, again_us)
    # Not the slip itself, which is as fast as it wants to be.
    judge_motion(session, outcome, station, (at_us + 500_000, session.now_us()))
