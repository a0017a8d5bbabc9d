"""The emergency stop, from the edge of its input to rest, release and re-arming."""

import numpy as np
import ols_msg

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.configuration import ACCELERATION_DEG_S2
from ols_faults.evidence import Evidence
from ols_faults.judges import judge_tracking_again
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


def judge_stop(evidence: Evidence, outcome: Outcome, station: str, window: tuple[int, int]) -> None:
    """From the edge on; a is what the PTU was configured to, not the observed one."""
    heard = evidence.heard
    speed, braking_s, slowing = measure.braking(heard, station, window[0])
    before = window[0] - 300_000, window[0]
    broken_by = mutations.stands(station, before)
    outcome.at_least(
        "PTU's speed at the edge", speed, FAST_DEG_S * 0.9, "deg/s", broken_by=broken_by
    )
    broken_by = mutations.shafts_late(station, 0.1)
    outcome.at_most(
        "it begins to brake after the edge", braking_s, HALT_S, "s", broken_by=broken_by
    )
    unsure_s = measure.rest_uncertainty_s(heard, station)
    outcome.at_most(
        "at rest after the edge",
        measure.rest_s(heard, station, *window),
        speed / ACCELERATION_DEG_S2 + HALT_S + unsure_s,
        "s",
        note=f"limit: v/a + {1e3 * HALT_S:.0f} ms + {1e3 * unsure_s:.1f} ms of sampling;"
        f" it braked at {slowing:.1f} of {ACCELERATION_DEG_S2:g} deg/s^2",
        broken_by=mutations.shafts_late(station, 0.2),
    )


def judge_still(
    evidence: Evidence, outcome: Outcome, when: str, station: str, window: tuple[int, int]
) -> None:
    measured = measure.moved_deg(evidence.heard, station, *window)
    broken_by = mutations.moves_on(station, (window[0], window[0] + 500_000), 1.0)
    outcome.at_most(f"moved {when}", measured, STILL_DEG, "deg", broken_by=broken_by)


def judge(evidence: Evidence, outcome: Outcome) -> None:
    station, at_us, braked_us = (evidence[n] for n in ("station", "at_us", "braked_us"))
    heard = evidence.heard
    during = [p for p in heard.ptus[station] if at_us <= p.utime <= braked_us]
    edges = {p.stop_edge_utime for p in during if p.stop_pressed and p.stop_edge_utime >= at_us}
    edge_us = min(edges, default=at_us)

    def not_pressed(ptu: object) -> object:
        return mutations.put(ptu, stop_pressed=False, stop_edge_utime=at_us - 100_000_000)

    broken_by = mutations.altering("it is not pressed", f"OLS_SIM_PTU_{station}", not_pressed)
    outcome.holds("it was pressed", len(edges) == 1, broken_by=broken_by)
    judge_stop(evidence, outcome, station, (edge_us, braked_us))
    said = measure.states(heard, station, edge_us + 1_000_000, braked_us)
    outcome.holds(
        "the station says so",
        said == {"emergency"},
        ", ".join(sorted(said)) or "no status",
        broken_by=mutations.in_state(station, "stopped", (edge_us, braked_us)),
    )
    judge_still(evidence, outcome, "while pressed", station, evidence["pressed"])
    judge_still(evidence, outcome, "released, not re-armed", station, evidence["released"])
    measured = measure.moved_deg(heard, station, *evidence["rearmed"])
    broken_by = mutations.stands(station, evidence["rearmed"])
    outcome.at_least("moves once re-armed", measured, 5.0, "deg", broken_by=broken_by)
    freed_us = evidence["freed_us"]
    judge_tracking_again(evidence, outcome, "tracking again", station, freed_us, 15.0)


@case(
    "emergency-stop",
    "emergency stop pressed while the PTU turns fast",
    "halt within 50 ms of the edge, at rest within v/a + 50 ms, until released and re-armed",
    judge,
)
def emergency_stop(session: Session, evidence: Evidence) -> None:
    station = evidence["station"] = session.stations[1]
    side = 1.0 if session.status(station).pan_rad > 0 else -1.0
    swing(session, station, side * WAY_DEG / 2)
    session.wait(lambda: session.state(station) == "manual", 3.0)
    session.run(4.0)
    swing(session, station, -side * WAY_DEG / 2)
    session.wait_until_turning(station, FAST_DEG_S, 3.0)
    evidence["at_us"] = session.fault("emergency-stop", station, 1e6)
    evidence["braked_us"] = session.run(2.5)[1]
    evidence["pressed"] = provoke(session, station, side)
    session.fault("emergency-stop", station, 0.0)
    session.run(1.0)
    evidence["released"] = provoke(session, station, side)
    session.rearm(station)
    session.wait(lambda: session.state(station) == "stopped", 4.0)
    start_us = session.now_us()
    swing(session, station, side * WAY_DEG / 2)
    evidence["rearmed"] = start_us, session.run(2.0)[1]
    evidence["freed_us"] = session.now_us()
    session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
    session.wait_for_tracking(station, evidence["freed_us"], 20.0)


def provoke(session: Session, station: str, side: float) -> tuple[int, int]:
    """Nothing may move, although a point, a slew, a release and a rearm command arrive."""
    start_us = session.now_us()
    for _ in range(4):
        swing(session, station, side * WAY_DEG / 2)
        session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
        session.command(station, REARM)  # remote: no person at the station
        session.run(0.4)
    return start_us, session.now_us()
