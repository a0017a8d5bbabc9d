"""Commands that must not move anything: stale, played again, out of limits, no numbers, addressed
to another station.

There are no signatures: a well-formed command counts from any sender, and the good ones here, which
move the unit, are as forged as the bad ones.
"""

from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import ols_msg
from ols_demo.bus import counters

from ols_faults import measure, mutations
from ols_faults.case import Mutation, Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import judge_tracking_again
from ols_faults.session import Session

POINT = ols_msg.ptu_command_t.COMMAND_POINT
STILL_DEG = 0.02  # of the truth; one count is 0.003 deg
WAY_RAD = np.radians(5.0)
WAY_DEG = float(np.degrees(WAY_RAD))
REPLAY_LEASE_S = 9.0  # of what is played again 6 s later
SLEW_LEASE_S = 2.0  # the longest that a slew may have

Bad = tuple[str, str, Callable[[Any], None]]  # what it is, the reason that must be counted, how


def reasons(status: Any) -> dict[str, float]:
    """Refusals of manual commands and slews so far; not those of precedence: the fusion's own slews
    meet it."""
    return {
        name.split("refused_", 1)[1]: value
        for name, value in counters(status).items()
        if name.startswith(("refused_", "messages_refused_")) and not name.endswith("precedence")
    }


def put(name: str, value: Any) -> Callable[[Any], None]:
    return lambda message: setattr(message, name, value)


def later(name: str, amount: float) -> Callable[[Any], None]:
    return lambda message: setattr(
        message, name, type(getattr(message, name))(getattr(message, name) + amount)
    )


COMMON: list[Bad] = [
    ("stale", "stale", later("utime", -60e6)),
    ("from the future", "from_the_future", later("utime", 60e6)),
    ("no lease", "lease", put("lease_s", 0.0)),
    ("endless lease", "lease", put("lease_s", 1e9)),
    ("lease not a number", "lease", put("lease_s", float("nan"))),
    ("another schema", "schema", put("schema_version", 99)),
    ("addressed to another station", "other_station", put("station", "nobody")),
]

MANUAL: list[Bad] = [
    ("NaN", "not_finite", put("pan_rad", float("nan"))),
    ("infinite", "not_finite", put("tilt_rad", float("inf"))),
    ("beyond the limits", "unreachable", put("tilt_rad", 1.5)),
    ("unknown command", "unknown_command", put("command", 77)),
]

SLEWS: list[Bad] = [
    ("NaN direction", "not_finite", put("azimuth_rad", float("nan"))),
    ("NaN rate", "not_finite", put("elevation_rate_rad_s", float("nan"))),
    ("infinite rate", "not_finite", put("azimuth_rate_rad_s", float("inf"))),
    ("too fast", "out_of_range", put("azimuth_rate_rad_s", 5.0)),
    ("beyond the limits", "unreachable", put("elevation_rad", 1.4)),
    ("elevation over 90 deg", "out_of_range", put("elevation_rad", 3.0)),
    ("effect long ago", "out_of_range", later("effect_utime", -30e6)),
    ("effect far off", "out_of_range", later("effect_utime", 30e6)),
    ("negative deviation", "out_of_range", put("direction_sd_rad", -1.0)),
]


def standing(session: Session, station: str) -> Any:
    """Brings the station to rest in manual control; returns its status."""
    status = session.status(station)
    session.command(station, POINT, status.pan_rad, status.tilt_rad)
    session.wait(lambda: session.state(station) == "manual", 3.0)
    session.run(1.0)
    return session.fresh_status(station)


def send_bad(
    session: Session, evidence: Evidence, kind: str, channel: str, bad: list[Callable[[], Any]]
) -> None:
    """Notes the time, and the station's counters before and after."""
    station = evidence["station"]
    before = reasons(session.fresh_status(station))
    start_us = session.now_us()
    for make in bad:
        session.publish(channel, make())  # made now: stale only where it is meant to be
        session.run(0.05)
    session.run(1.5)
    after = reasons(session.fresh_status(station))
    evidence[kind] = {"window": (start_us, session.now_us()), "before": before, "after": after}


def altered(make: Callable[[], Any], bad: list[Bad]) -> list[Callable[[], Any]]:
    def one(change: Callable[[Any], None]) -> Any:
        message = make()
        change(message)
        return message

    return [lambda change=change: one(change) for _, _, change in bad]


def judge_refused(evidence: Evidence, outcome: Outcome, kind: str, expected: list[str]) -> None:
    """All must be refused, each counted under its own reason, and none may move anything."""
    station, noted = evidence["station"], evidence[kind]
    window = noted["window"]
    one_moves = window[0], window[0] + 500_000
    measured = measure.moved_deg(evidence.heard, station, *window)
    broken_by = mutations.moves_on(station, one_moves, 1.0)
    outcome.at_most(f"moved by bad {kind}", measured, STILL_DEG, "deg", broken_by=broken_by)
    grown = {
        why: int(n - noted["before"].get(why, 0.0))
        for why, n in noted["after"].items()
        if n > noted["before"].get(why, 0.0)
    }
    text = ", ".join(f"{count} {why}" for why, count in sorted(grown.items())) or "none"

    def one_passes(altered: Evidence) -> None:
        altered[kind]["after"][expected[-1]] -= 1

    outcome.holds(
        f"each of the bad {kind} refused for its reason",
        grown == Counter(expected),
        f"{sum(grown.values())} of {len(expected)}: {text}",
        broken_by=Mutation("one of them is not counted", one_passes),
    )


def judge_good(evidence: Evidence, outcome: Outcome, share: float) -> None:
    """What would have happened if the bad commands had been obeyed."""
    station, window = evidence["station"], evidence["good"]
    outcome.at_least(
        "moved by a well-formed one, from any sender",
        measure.moved_deg(evidence.heard, station, *window),
        share * WAY_DEG,
        "deg",
        broken_by=mutations.stands(station, window),
    )


def judge_manual(evidence: Evidence, outcome: Outcome) -> None:
    wanted = [reason for _, reason, _ in COMMON + MANUAL]
    judge_refused(evidence, outcome, "manual commands", wanted)
    judge_good(evidence, outcome, 0.9)
    judge_refused(evidence, outcome, "commands played again", ["replayed"])
    station, freed_us = evidence["station"], evidence["freed_us"]
    judge_tracking_again(evidence, outcome, "tracking again", station, freed_us, 15.0)


@case(
    "bad-manual-commands",
    "stale, played-again, out-of-limit, NaN manual commands, and another station's",
    "refused and counted; 0 moves",
    judge_manual,
)
def bad_manual_commands(session: Session, evidence: Evidence) -> None:
    station = evidence["station"] = session.stations[0]
    status = standing(session, station)
    channel = f"OLS_PTU_{station}"

    def away() -> Any:
        message = session.address(ols_msg.ptu_command_t(), station)
        message.command = POINT
        message.pan_rad, message.tilt_rad = status.pan_rad - WAY_RAD, status.tilt_rad
        return message

    send_bad(session, evidence, "manual commands", channel, altered(away, COMMON + MANUAL))
    good = away()
    good.lease_s = REPLAY_LEASE_S
    session.publish(channel, good)
    evidence["good"] = session.run(2.0)
    home = away()
    home.pan_rad = status.pan_rad
    session.publish(channel, home)
    session.run(2.0)
    # The very same bytes, still within their lease.
    send_bad(session, evidence, "commands played again", channel, [lambda: good])
    evidence["freed_us"] = session.now_us()
    session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
    session.wait_for_tracking(station, evidence["freed_us"], 15.0)


def judge_slews(evidence: Evidence, outcome: Outcome) -> None:
    wanted = [reason for _, reason, _ in COMMON + SLEWS]
    judge_refused(evidence, outcome, "slews", wanted)
    judge_good(evidence, outcome, 0.8)
    judge_refused(evidence, outcome, "slews played again", ["replayed"])
    station, since_us = evidence["station"], evidence["fusion_us"]
    late = since_us, since_us + 12_000_000
    # What it takes to track again after a restart is another case's matter.
    outcome.recovered(
        "led by slews again after the fusion's start",
        measure.first_s(
            evidence.heard,
            f"OLS_STATUS_{station}",
            since_us,
            mutations.EVER,
            lambda status: status.state in LED_STATES,
        ),
        10.0,
        broken_by=mutations.in_state(station, "idle", late),
    )


LED_STATES = (ols_msg.station_status_t.STATE_SLEWED, ols_msg.station_status_t.STATE_TRACKING)


@case(
    "bad-slews",
    "stale, played-again, out-of-limit, NaN slews, and another station's",
    "refused and counted; 0 moves",
    judge_slews,
)
def bad_slews(session: Session, evidence: Evidence) -> None:
    station = evidence["station"] = session.stations[0]
    channel = f"OLS_SLEW_{station}"
    session.kill("ols-fusion")  # its own slews would move the station
    standing(session, station)
    session.kill(session.process(station))  # a fresh one has no target
    session.start_station(station)
    session.release_held(station)
    session.wait(lambda: np.isfinite(getattr(session.status(station), "pan_rad", np.nan)), 15.0)
    session.run(1.0)
    status = session.fresh_status(station)

    def away() -> Any:
        message = session.address(ols_msg.slew_t(), station)
        message.lease_s = 0.5
        message.effect_utime = message.utime + 100_000
        message.azimuth_rad = float((status.azimuth_rad + WAY_RAD) % (2 * np.pi))
        message.elevation_rad = status.elevation_rad
        message.direction_sd_rad = 1e-3
        return message

    send_bad(session, evidence, "slews", channel, altered(away, COMMON + SLEWS))
    start_us = session.now_us()
    for _ in range(20):
        good = away()
        session.publish(channel, good)
        session.run(0.1)
    evidence["good"] = start_us, session.now_us()
    good = away()
    good.lease_s = SLEW_LEASE_S
    good.azimuth_rad = status.azimuth_rad
    session.publish(channel, good)
    for _ in range(8):  # leads away from where that one pointed
        session.publish(channel, away())
        session.run(0.1)
    # The very same bytes, still within their lease.
    send_bad(session, evidence, "slews played again", channel, [lambda: good])
    evidence["fusion_us"] = session.start_fusion()
    session.wait(lambda: session.state(station) in ("slewed", "tracking"), 20.0)
