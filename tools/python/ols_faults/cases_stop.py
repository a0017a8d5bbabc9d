"""The emergency stop, from the edge of its input to rest, release and re-arming."""

import numpy as np
import ols_msg
from ols_demo.recording import Recording

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.configuration import ACCELERATION_DEG_S2
from ols_faults.session import Session

POINT = ols_msg.ptu_command_t.COMMAND_POINT
REARM = ols_msg.ptu_command_t.COMMAND_REARM
WAY_DEG = 90.0
HALT_S = 0.05
STILL_DEG = 0.02
FAST_DEG_S = 50.0


def swing(session: Session, station: str, to_deg: float) -> None:
    status = session.status(station)
    session.command(station, POINT, float(np.radians(to_deg)), status.tilt_rad)


def newest_speed(session: Session, station: str) -> float:
    now_us = session.now_us()
    times, angles = measure.ptu_track(session.heard, station, now_us - 150_000, now_us)
    return float(np.median(measure.speeds(times, angles))) if len(times) > 10 else 0.0


@case(
    "emergency-stop",
    "emergency stop pressed while the PTU turns fast",
    "halt within 50 ms of the edge, at rest within v/a + 50 ms, until released and re-armed",
)
def emergency_stop(session: Session, outcome: Outcome) -> None:
    station = session.stations[1]
    side = 1.0 if session.status(station).pan_rad > 0 else -1.0
    swing(session, station, side * WAY_DEG / 2)
    session.wait(lambda: session.state(station) == "manual", 3.0)
    session.run(4.0)
    swing(session, station, -side * WAY_DEG / 2)
    session.wait(lambda: newest_speed(session, station) > FAST_DEG_S, 3.0)
    session.fault("emergency-stop", station, 1e6)
    session.run(2.5)
    edge_us = session.heard.ptus[station][-1].stop_edge_utime
    outcome.holds("it was pressed", edge_us > 0)
    judge_stop(outcome, session.heard, station, (edge_us, session.now_us()))
    outcome.holds(
        "the station says so", session.state(station) == "emergency", session.state(station)
    )
    stays_stopped(session, outcome, station, side, "while pressed")
    session.fault("emergency-stop", station, 0.0)
    session.run(1.0)
    stays_stopped(session, outcome, station, side, "released, not re-armed")
    session.rearm(station)
    session.wait(lambda: session.state(station) == "stopped", 4.0)
    start_us = session.now_us()
    swing(session, station, side * WAY_DEG / 2)
    session.run(2.0)
    moved = measure.moved_deg(session.heard, station, start_us, session.now_us())
    outcome.at_least("moves once re-armed", moved, 5.0, "deg")
    freed_us = session.now_us()
    session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
    outcome.recovered("tracking again", session.tracking_again_s(station, freed_us, 20.0), 15.0)


def judge_stop(outcome: Outcome, heard: Recording, station: str, window: tuple[int, int]) -> None:
    """From the edge on; a is what the PTU was configured to, not what it was seen to do."""
    speed, braking_s, slowing = measure.braking(heard, station, window[0])
    outcome.at_least("PTU's speed at the edge", speed, FAST_DEG_S * 0.9, "deg/s")
    outcome.at_most("it begins to brake after the edge", braking_s, HALT_S, "s")
    unsure_s = measure.rest_uncertainty_s(heard, station)
    what = (
        f"at rest (v/a + {1e3 * HALT_S:.0f} ms + {1e3 * unsure_s:.1f} ms of sampling;"
        f" it braked at {slowing:.1f} of {ACCELERATION_DEG_S2:g} deg/s^2)"
    )
    limit_s = speed / ACCELERATION_DEG_S2 + HALT_S + unsure_s
    outcome.at_most(what, measure.rest_s(heard, station, *window), limit_s, "s")


def stays_stopped(session: Session, outcome: Outcome, station: str, side: float, when: str) -> None:
    """The operator points, the fusion slews, somebody releases and re-arms: nothing moves."""
    start_us = session.now_us()
    for _ in range(4):
        swing(session, station, side * WAY_DEG / 2)
        session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
        session.command(station, REARM)  # from afar: nobody's hand at the station
        session.run(0.4)
    moved = measure.moved_deg(session.heard, station, start_us, session.now_us())
    outcome.at_most(f"moved {when}", moved, STILL_DEG, "deg")
