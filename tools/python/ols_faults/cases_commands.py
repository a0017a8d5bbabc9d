"""Commands that must not move anything: stale, played again, out of limits, no numbers, forged."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import ols_msg
from ols_demo.bus import counters

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.session import Session

POINT = ols_msg.ptu_command_t.COMMAND_POINT
STILL_DEG = 0.02  # of the truth; one count is 0.003 deg
WAY_RAD = np.radians(5.0)
REPLAY_LEASE_S = 9.0  # of what is played again 6 s later
SLEW_LEASE_S = 2.0  # the longest that a slew may have


def refusals(status: Any) -> float:
    """What was refused so far, before it was a command and after."""
    return sum(reasons(status).values())


def reasons(status: Any) -> dict[str, float]:
    """Of manual commands and slews; not those of precedence: the fusion's own slews meet it."""
    return {
        name.split("refused_", 1)[1]: value
        for name, value in counters(status).items()
        if name.startswith(("refused_", "messages_refused_")) and not name.endswith("precedence")
    }


def by_reason(before: Any, after: Any) -> str:
    was = reasons(before)
    grown = {
        name: int(value - was.get(name, 0.0))
        for name, value in reasons(after).items()
        if value > was.get(name, 0.0)
    }
    return ", ".join(f"{count} {why}" for why, count in sorted(grown.items())) or "none"


def standing(session: Session, station: str) -> Any:
    """The station at rest where it is, in manual control; its status."""
    status = session.status(station)
    session.command(station, POINT, status.pan_rad, status.tilt_rad)
    session.wait(lambda: session.state(station) == "manual", 3.0)
    session.run(1.0)
    return session.fresh_status(station)


def judge_refused(
    session: Session,
    outcome: Outcome,
    station: str,
    kind: str,
    bad: list[Callable[[], Any]],
    channel: str,
) -> None:
    """Publishes every bad message; all must be refused, counted, and move nothing."""
    before = session.fresh_status(station)
    start_us = session.now_us()
    for make in bad:
        session.publish(channel, make())  # made now: stale only where it is meant to be
        session.run(0.05)
    session.run(1.5)
    after = session.fresh_status(station)
    moved = measure.moved_deg(session.heard, station, start_us, session.now_us())
    outcome.at_most(f"moved by {len(bad)} bad {kind}s", moved, STILL_DEG, "deg")
    refused = refusals(after) - refusals(before)
    reasons = by_reason(before, after)
    outcome.holds(
        f"bad {kind}s refused and counted", refused == len(bad), f"{refused:g} ({reasons})"
    )


def altered(
    make: Callable[[], Any], changes: list[tuple[str, Callable[[Any], None]]]
) -> list[Callable[[], Any]]:
    def with_change(change: Callable[[Any], None]) -> Any:
        message = make()
        change(message)
        return message

    return [partial(with_change, change) for _, change in changes]


def put(name: str, value: Any) -> Callable[[Any], None]:
    return lambda message: setattr(message, name, value)


def later(name: str, amount: float) -> Callable[[Any], None]:
    return lambda message: setattr(
        message, name, type(getattr(message, name))(getattr(message, name) + amount)
    )


COMMON = [
    ("stale", later("utime", -60e6)),
    ("from the future", later("utime", 60e6)),
    ("no lease", put("lease_s", 0.0)),
    ("endless lease", put("lease_s", 1e9)),
    ("lease not a number", put("lease_s", float("nan"))),
    ("another schema", put("schema_version", 99)),
    ("forged: another station's", put("station", "nobody")),
]


@case(
    "bad-manual-commands",
    "stale, duplicated, out-of-limit, NaN, forged manual commands",
    "refused and counted; 0 moves",
)
def bad_manual_commands(session: Session, outcome: Outcome) -> None:
    station = session.stations[0]
    status = standing(session, station)

    def away() -> Any:
        message = session.address(ols_msg.ptu_command_t(), station)
        message.command = POINT
        message.pan_rad, message.tilt_rad = status.pan_rad - WAY_RAD, status.tilt_rad
        return message

    bad = altered(away, COMMON)
    bad += altered(
        away,
        [
            ("NaN", put("pan_rad", float("nan"))),
            ("infinite", put("tilt_rad", float("inf"))),
            ("beyond the limits", put("tilt_rad", 1.5)),
            ("unknown command", put("command", 77)),
        ],
    )
    channel = f"OLS_PTU_{station}"
    judge_refused(session, outcome, station, "manual command", bad, channel)
    good = away()
    good.lease_s = REPLAY_LEASE_S
    start_us = session.now_us()
    session.publish(channel, good)
    session.run(2.0)
    moved = measure.moved_deg(session.heard, station, start_us, session.now_us())
    outcome.at_least("moved by a good one", moved, 0.9 * np.degrees(WAY_RAD), "deg")
    home = away()
    home.pan_rad = status.pan_rad
    session.publish(channel, home)
    session.run(2.0)
    # The very same bytes, still within their lease.
    judge_refused(session, outcome, station, "played-again command", [lambda: good], channel)
    session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
    outcome.recovered("tracking again", session.wait(lambda: session.tracks(station), 15.0), 15.0)


@case(
    "bad-slews",
    "stale, duplicated, out-of-limit, NaN, forged slews",
    "refused and counted; 0 moves",
)
def bad_slews(session: Session, outcome: Outcome) -> None:
    station = session.stations[0]
    session.kill("ols-fusion")  # its own slews would move the station
    standing(session, station)
    session.kill(session.process(station))  # a fresh one has no target
    session.start_station(station)
    session.wait(lambda: session.state(station) == "stopped", 15.0)  # as it was left
    session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
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

    bad = altered(away, COMMON)
    bad += altered(
        away,
        [
            ("NaN direction", put("azimuth_rad", float("nan"))),
            ("NaN rate", put("elevation_rate_rad_s", float("nan"))),
            ("infinite rate", put("azimuth_rate_rad_s", float("inf"))),
            ("too fast", put("azimuth_rate_rad_s", 5.0)),
            ("beyond the limits", put("elevation_rad", 1.4)),
            ("elevation over 90 deg", put("elevation_rad", 3.0)),
            ("effect long ago", later("effect_utime", -30e6)),
            ("effect far off", later("effect_utime", 30e6)),
            ("negative deviation", put("direction_sd_rad", -1.0)),
        ],
    )
    channel = f"OLS_SLEW_{station}"
    judge_refused(session, outcome, station, "slew", bad, channel)
    start_us = session.now_us()
    for _ in range(20):
        good = away()
        session.publish(channel, good)
        session.run(0.1)
    moved = measure.moved_deg(session.heard, station, start_us, session.now_us())
    outcome.at_least("moved by good ones", moved, 0.8 * np.degrees(WAY_RAD), "deg")
    good = away()
    good.lease_s = SLEW_LEASE_S
    good.azimuth_rad = status.azimuth_rad
    session.publish(channel, good)
    for _ in range(8):  # leads away from where that one pointed
        session.publish(channel, away())
        session.run(0.1)
    # The very same bytes, still within their lease.
    judge_refused(session, outcome, station, "played-again slew", [lambda: good], channel)
    session.start_fusion()
    # What it takes to track again after a restart is another case's matter.
    slewed = session.wait(lambda: session.state(station) in ("slewed", "tracking"), 20.0)
    outcome.recovered("led by slews again after the fusion's start", slewed, 10.0)
