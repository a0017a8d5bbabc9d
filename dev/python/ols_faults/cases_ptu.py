"""Faults of the PTU's line and of the unit behind it."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import ols_msg
from ols_demo.evaluate import JOINT
from ols_demo.evaluate import OK as OK_POSITION

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import (
    judge_alarm,
    judge_angles,
    judge_counted,
    judge_motion,
    judge_outage,
    judge_rest,
    judge_target,
    judge_tracking_again,
)
from ols_faults.session import Session

OK = 2  # station_status_t.DEVICE_OK
REPORTED_S = 1.5
HOME = ols_msg.ptu_command_t.COMMAND_HOME
HOMING_S = 60.0
STILL_DEG = 0.02
SLIP_DEG = 1.0
SHORTLY_S = 1.0
REST_S = 1.0
AIM_PX = 40.0  # a fifteenth of the image; 2 are measured
ANGLES = "no angle off by more than 3 sigmas"


def is_well(status: Any) -> bool:
    devices = dict(zip(status.device_name, status.device_state, strict=True))
    return devices.get("ptu") == OK


def well_again_s(recording: Any, station: str, since_us: int, until_us: int) -> float | None:
    return measure.first_s(recording, f"OLS_STATUS_{station}", since_us, until_us, is_well)


def wait_until_well(session: Session, station: str, since_us: int, deadline_s: float) -> int:
    """Returns the time when it happened, or the deadline."""
    session.wait(
        lambda: well_again_s(session.heard, station, since_us, session.now_us()) is not None,
        deadline_s,
    )
    return session.now_us()


def judge_well_again(
    evidence: Evidence, outcome: Outcome, what: str, station: str, since_us: int, limit_s: float
) -> None:
    late = since_us, since_us + round((limit_s + 1.0) * 1e6)
    measured = well_again_s(evidence.heard, station, since_us, mutations.EVER)
    broken_by = mutations.device_ails(station, "ptu", late)
    outcome.at_most(what, measured, limit_s, "s", broken_by=broken_by)


def settle(session: Session, evidence: Evidence) -> None:
    evidence["judged_us"] = session.run(2.0)[1]


def judge_whole(evidence: Evidence, outcome: Outcome, since_us: int, tracked_s: float) -> None:
    station, window = evidence["station"], (since_us, evidence["judged_us"])
    judge_motion(evidence, outcome, station, window)
    judge_angles(evidence, outcome, station, window, tracked_s)


def judge_line(evidence: Evidence, outcome: Outcome, words: str) -> None:
    station, at_us, ended_us = (evidence[name] for name in ("station", "at_us", "ended_us"))
    judge_alarm(evidence, outcome, "reported", station, at_us, REPORTED_S, "ptu:", words)
    judge_outage(evidence, outcome, station, (at_us + 500_000, ended_us))
    judge_rest(evidence, outcome, station, (at_us, ended_us), REST_S)
    judge_well_again(evidence, outcome, "line healed", station, ended_us, 5.0)
    judge_tracking_again(evidence, outcome, "tracking again", station, ended_us, 8.0)
    judge_whole(evidence, outcome, at_us, 1.5)


def do_line(session: Session, evidence: Evidence, kind: str, number: int) -> None:
    station, seconds = session.stations[number], 5.0
    evidence["station"] = station
    session.wait_until_turning(station, 1.0, 30.0)
    session.fresh_status(station)
    evidence["at_us"] = session.fault(kind, station, seconds)
    evidence["ended_us"] = session.run(seconds)[1]
    wait_until_well(session, station, evidence["ended_us"], 10.0)
    session.wait_for_tracking(station, evidence["ended_us"], 20.0)
    settle(session, evidence)


HEALED = f"reported at once, healed, no runaway, {ANGLES}"
CUT, GONE = "halted, no ", "no serial port"  # words of the alarms
case("ptu-line-cut", "PTU line cut for 5 s", HEALED, partial(judge_line, words=CUT))(
    partial(do_line, kind="ptu-line-cut", number=0)
)
case(
    "ptu-line-gone",
    "PTU's serial adapter unplugged for 5 s",
    HEALED,
    partial(judge_line, words=GONE),
)(partial(do_line, kind="ptu-line-gone", number=3))


def aim_px(recording: Any, station: str, window: tuple[int, int]) -> float:
    """The target's greatest distance from the image centre; infinite if it left the image."""
    views = [v for v in recording.views.get(station, []) if window[0] <= v.utime <= window[1]]
    if not views:
        return float("nan")
    if not all(view.visible for view in views):
        return float("inf")
    return float(measure.aim_offsets_px(recording, station, *window).max())


def judge_ridden_through(
    evidence: Evidence, outcome: Outcome, counters: tuple[str, ...], least: float
) -> None:
    """A fault that must not interrupt the tracking."""
    station, window = evidence["station"], (evidence["at_us"], evidence["ended_us"])
    channel = f"OLS_STATUS_{station}"
    judge_counted(evidence, outcome, "counted", channel, counters, window, least)
    judge_motion(evidence, outcome, station, window)
    judge_angles(evidence, outcome, station, window, (window[1] - window[0]) * 1e-6)

    def astray(view: Any) -> Any:
        x, y = view.centre_px
        return mutations.put(view, centre_px=[x + 1.5 * AIM_PX, y])

    measured = aim_px(evidence.heard, station, window)
    broken_by = mutations.altering("it does not follow", f"OLS_SIM_VIEW_{station}", astray)
    outcome.at_most("target from the image centre", measured, AIM_PX, "px", broken_by=broken_by)
    judge_tracking_again(evidence, outcome, "tracking", station, window[1], 3.0)


def ride_through(
    session: Session,
    evidence: Evidence,
    kind: str,
    number: int,
    seconds: float,
    value: float = float("nan"),
) -> None:
    station = evidence["station"] = session.stations[number]
    session.fresh_status(station)
    evidence["at_us"] = session.fault(kind, station, seconds, value)
    evidence["ended_us"] = session.run(seconds + 1.0)[1]
    session.wait_for_tracking(station, evidence["ended_us"], 10.0)


def through(
    name: str, fault: str, do: Callable[..., None], counters: tuple[str, ...], least: float
) -> None:
    judge = partial(judge_ridden_through, counters=counters, least=least)
    case(name, fault, f"counted, no interruption, no runaway, {ANGLES}", judge)(do)


through(
    "ptu-garbled",
    "1 % of the PTU's replies garbled for 15 s",
    partial(ride_through, kind="ptu-garbled", number=1, seconds=15.0, value=0.01),
    ("ptu_garbled", "ptu_timeouts"),
    3.0,
)
through(
    "ptu-echo-on",
    "echo switched on in mid-run",
    partial(ride_through, kind="ptu-echo-on", number=2, seconds=4.0),
    ("ptu_echoes",),
    1.0,
)
through(
    "ptu-reply-lost",
    "a reply lost every 4 s (the table: every minute)",
    partial(ride_through, kind="ptu-reply-lost", number=3, seconds=13.0, value=4.0),
    ("ptu_timeouts", "ptu_garbled"),  # by which of a poll's replies it was
    3.0,
)


def power_cycle(session: Session, evidence: Evidence, number: int, homes: bool) -> None:
    """Switches the unit off and on."""
    station = evidence["station"] = session.stations[number]
    session.fresh_status(station)
    evidence["at_us"] = session.fault("ptu-power-cycle", station, 2.0, float(homes))
    session.run(4.0)


def judge_reported(evidence: Evidence, outcome: Outcome) -> None:
    station, at_us = evidence["station"], evidence["at_us"]
    words = "ptu:", "lost power"
    judge_alarm(evidence, outcome, "reported", station, at_us, REPORTED_S, *words)


def home_and_back(session: Session, evidence: Evidence) -> None:
    """The operator homes it."""
    station = evidence["station"]
    session.command(station, HOME)
    evidence["homed_us"] = session.run(2.0)[1]
    come_back(session, evidence)


def come_back(session: Session, evidence: Evidence) -> None:
    station = evidence["station"]
    evidence["again_us"] = wait_until_well(session, station, evidence["homed_us"], HOMING_S)
    session.wait_for_tracking(station, evidence["again_us"], 20.0)
    settle(session, evidence)


def judge_back(evidence: Evidence, outcome: Outcome, ready: str) -> None:
    station, again_us = evidence["station"], evidence["again_us"]
    judge_well_again(evidence, outcome, ready, station, evidence["homed_us"], HOMING_S)
    what = "tracking again, by slews, after it was homed"
    judge_tracking_again(evidence, outcome, what, station, again_us, 10.0)


def judge_power_cycle(evidence: Evidence, outcome: Outcome) -> None:
    station, at_us, again_us = (evidence[name] for name in ("station", "at_us", "again_us"))
    judge_reported(evidence, outcome)
    judge_outage(evidence, outcome, station, (at_us + round(SHORTLY_S * 1e6), again_us - 600_000))
    judge_back(evidence, outcome, "ready again")
    # Not its own homing, which sweeps over the whole travel.
    judge_whole(evidence, outcome, again_us, 1.5)


@case(
    "ptu-power-cycle",
    "PTU off and on, it homes itself",
    f"reported, no bearing until it has homed, recovers on its own, no runaway, {ANGLES}",
    judge_power_cycle,
)
def ptu_power_cycle(session: Session, evidence: Evidence) -> None:
    power_cycle(session, evidence, 1, homes=True)
    evidence["homed_us"] = session.now_us()
    come_back(session, evidence)


def judge_unhomed(evidence: Evidence, outcome: Outcome) -> None:
    station, window = evidence["station"], evidence["doubt"]
    judge_reported(evidence, outcome)
    measured = measure.moved_deg(evidence.heard, station, *window)
    broken_by = mutations.moves_on(station, (window[0], window[0] + 500_000), 1.0)
    outcome.at_most("moved while in doubt", measured, STILL_DEG, "deg", broken_by=broken_by)
    shortly_us = evidence["at_us"] + round(SHORTLY_S * 1e6)
    judge_outage(evidence, outcome, station, (shortly_us, window[1]))
    said = measure.statuses(evidence.heard, station, *window)
    measured = bool(said) and not any(is_well(status) for status in said)
    outcome.holds("still reported", measured, broken_by=mutations.says_nothing(station, window))
    judge_back(evidence, outcome, "ready after `home`")
    judge_whole(evidence, outcome, evidence["again_us"], 1.5)


@case(
    "ptu-power-cycle-unhomed",
    "PTU off and on, it does not home itself",
    f"reported, no bearing and no motion until it was homed, {ANGLES}",
    judge_unhomed,
)
def ptu_power_cycle_unhomed(session: Session, evidence: Evidence) -> None:
    power_cycle(session, evidence, 2, homes=False)
    evidence["doubt"] = session.run(6.0)
    home_and_back(session, evidence)


def is_without(target: Any, station: str) -> bool:
    return target.solution == OK_POSITION and station not in measure.used(target)


def judge_lost_steps(evidence: Evidence, outcome: Outcome) -> None:
    """The unit does not report this fault, so its station cannot; the other stations reveal it."""
    station, at_us, window = (evidence[name] for name in ("station", "at_us", "window"))
    without = partial(is_without, station=station)
    measured = measure.first_s(evidence.heard, JOINT, at_us, window[1], without)
    broken_by = mutations.rays("its rays are used", station, True, (at_us, mutations.EVER))
    outcome.at_most("positions without its rays", measured, 5.0, "s", broken_by=broken_by)
    found = measure.positions(evidence.heard, *window)
    measured = float(np.mean([not without(target) for target in found])) if found else None
    broken_by = mutations.rays("its rays are used again", station, True, window)
    outcome.at_most("share of positions with its rays", measured, 0.05, broken_by=broken_by)
    others = set(evidence.stations) - {station}
    measured = float(np.mean([not others <= measure.used(t) for t in found])) if found else None
    broken_by = mutations.rays("the others' are rejected", min(others), False, window)
    outcome.at_most("share of positions that lack another's", measured, 0.1, broken_by=broken_by)
    judge_target(evidence, outcome, window, 8.0)
    judge_back(evidence, outcome, "ready after `home`")
    judge_whole(evidence, outcome, evidence["again_us"], 1.5)


@case(
    "ptu-lost-steps",
    f"PTU's pan slips by {SLIP_DEG:g} deg, unnoticed by the unit",
    f"its rays are rejected, the target stays; {ANGLES} once homed",
    judge_lost_steps,
)
def ptu_lost_steps(session: Session, evidence: Evidence) -> None:
    station = evidence["station"] = session.stations[3]
    evidence["at_us"] = at_us = session.fault("ptu-lost-steps", station, 1e6, SLIP_DEG)
    without = partial(is_without, station=station)
    session.wait(
        lambda: measure.first_s(session.heard, JOINT, at_us, mutations.EVER, without) is not None,
        5.0,
    )
    session.run(1.5)  # until its filter has followed
    evidence["window"] = session.run(4.0)
    home_and_back(session, evidence)
