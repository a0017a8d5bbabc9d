"""The operator's STOP while an attacker tries to suppress it."""

import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from typing import Any

import numpy as np
import ols_msg
from ols_demo.bus import LIVE_URL

from ols_faults import fragments, measure, mutations
from ols_faults.case import Mutation, Outcome, case
from ols_faults.cases_network import flooded
from ols_faults.evidence import Evidence
from ols_faults.judges import judge_tracking_again
from ols_faults.session import Session
from ols_faults.wire import Sender

POINT = ols_msg.ptu_command_t.COMMAND_POINT
STOPS = 20
HALT_S = 0.2  # from the first STOP that was on the bus to the brakes
STARTED_S = 0.5  # from the start of ols-ctl: a process has to begin, on a computer under load
SWING_DEG = 80.0
FAST_DEG_S = 50.0
CTL_S = 6.0  # ols-ctl itself gives up before
FLOOD_HZ = 20_000
FLOOD_GOAL_DEG = np.degrees(1.4)  # kSwing_rad, kSwing_us in sim/network/command_flood.h
FLOOD_SWING_US = 4_000_000
AFTER_S = 1.3
PAIRS_HZ = 500


def swung_by_hand(session: Session, station: str) -> bool:
    """Points to the side that is further away; returns whether the PTU became fast."""
    status = session.status(station)
    side = -1.0 if status.pan_rad > 0 else 1.0
    deadline = time.monotonic() + 6.0
    while time.monotonic() < deadline:  # an operator who tries again: a stop holds for a moment
        session.command(station, POINT, float(np.radians(side * SWING_DEG)), status.tilt_rad)
        found = session.wait(lambda: session.speed_deg_s(station) > FAST_DEG_S, 1.2)
        if found is not None:
            return True
    return False


def swung_by_the_flood(session: Session, station: str) -> bool:
    """Forged commands swing it; returns whether it became fast with travel left."""

    def has_far_to_go() -> bool:
        now_us = session.now_us()
        pan_deg = np.degrees(session.heard.ptus[station][-1].pan_rad)
        side = 1.0 if now_us // FLOOD_SWING_US % 2 == 0 else -1.0
        onward = side * (pan_deg[-1] - pan_deg[0]) > 0.0
        far = side * (side * FLOOD_GOAL_DEG - pan_deg[-1]) > 50.0
        lasts = now_us % FLOOD_SWING_US < FLOOD_SWING_US - 800_000
        return onward and far and lasts and session.speed_deg_s(station) > FAST_DEG_S

    return session.wait(has_far_to_go, 10.0) is not None


def stop_once(
    session: Session, station: str, swung: Callable[[Session, str], bool]
) -> dict[str, Any]:
    """Runs `ols-ctl STATION stop` while the PTU swings, and notes the time."""
    fast = swung(session, station)
    heard_before = len(session.bus.stops_us.get(station, []))
    program = session.wiring.program("ols-ctl")
    started_us = session.now_us()
    with subprocess.Popen(
        [program, station, "stop"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        session.wait(lambda: process.poll() is not None, CTL_S)
        if process.poll() is None:
            process.kill()
    # At rest, while a stop overrides all other commands.
    session.wait(lambda: session.now_us() - started_us > 1e6 * AFTER_S, AFTER_S)
    sent = session.bus.stops_us.get(station, [])[heard_before:]
    return {
        "fast": fast,
        "started_us": started_us,
        "sent_us": sent[0] if sent else None,
        "status": process.returncode,
    }


def braking_s(evidence: Evidence, since_us: int | None) -> float:
    """Time from then until its PTU began to brake; NaN if it did not, or was not fast."""
    if since_us is None:
        return float("nan")
    speed, begins_s, slowing = measure.braking(evidence.heard, evidence["station"], since_us)
    return begins_s if speed > 0.9 * FAST_DEG_S and slowing > 20.0 else float("nan")


def judge(evidence: Evidence, outcome: Outcome, least_hz: float) -> None:
    station, stops = evidence["station"], evidence["stops"]
    halts = [braking_s(evidence, stop["sent_us"]) for stop in stops]
    after_start = [
        halt + (stop["sent_us"] - stop["started_us"]) * 1e-6 if stop["sent_us"] else float("nan")
        for halt, stop in zip(halts, stops, strict=True)
    ]
    worst = max(halts, key=lambda halt: halt if np.isfinite(halt) else np.inf)
    outcome.at_least(
        f"halts begun within {HALT_S:g} s of the STOP on the bus",
        float(sum(0.0 <= halt <= HALT_S for halt in halts)),
        STOPS,
        note=f"of {len(stops)}, the latest after {worst:.3f} s",
        broken_by=mutations.shafts_late(station, 0.25),
    )
    outcome.at_least(
        f"halts begun within {STARTED_S:g} s of the start of ols-ctl",
        float(sum(0.0 <= after <= STARTED_S for after in after_start)),
        STOPS,
        note=f"the latest after {np.max(after_start):.3f} s",
        broken_by=mutations.shafts_late(station, 0.6),
    )
    outcome.at_least(
        "ols-ctl says that it stopped",
        float(sum(stop["status"] == 0 for stop in stops)),
        STOPS,
        note=f"of {len(stops)}",
        broken_by=Mutation("ols-ctl dies once", one_dies),
    )
    broken_by = mutations.fact("it is half of it", "rate_hz", least_hz / 2)
    outcome.at_least("attack", evidence["rate_hz"], least_hz, "Hz", broken_by=broken_by)
    freed_us = evidence["freed_us"]
    judge_tracking_again(evidence, outcome, "tracking again", station, freed_us, 15.0)


def one_dies(evidence: Evidence) -> None:
    evidence["stops"][-1]["status"] = -11


def release(session: Session, station: str) -> bool:
    """Releases repeatedly, because a stop holds for a moment; returns whether it succeeded."""
    if session.state(station) in ("stopped", "manual"):
        session.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)
        session.run(0.6)
        return False
    return True


def do(
    session: Session,
    evidence: Evidence,
    attack: Callable[[Session, str, Evidence], AbstractContextManager[None]],
    swung: Callable[[Session, str], bool],
) -> None:
    station = evidence["station"] = session.stations[1]
    status = session.status(station)
    session.command(station, POINT, status.pan_rad, status.tilt_rad)
    session.wait(lambda: session.state(station) == "manual", 3.0)
    stops: list[dict[str, Any]] = []
    with session.without_log(), attack(session, station, evidence):
        session.run(0.5)
        for _ in range(STOPS):
            stops.append(stop_once(session, station, swung))
            if session.ended() or not any(stop["fast"] for stop in stops[-3:]):
                break  # there is nothing (left) to stop
    evidence["stops"] = stops
    evidence["freed_us"] = session.now_us()
    session.wait(lambda: release(session, station), 5.0)
    session.wait_for_tracking(station, evidence["freed_us"], 15.0)


@contextmanager
def forged_commands(session: Session, station: str, evidence: Evidence) -> Iterator[None]:
    command = [session.wiring.program("ols-sim-flood"), "--lcm-url", LIVE_URL]
    command += ["--rate", str(FLOOD_HZ), "--commands", station, "--seed", str(session.seed)]
    session.site.start_and_wait("commands", command, "ready")
    try:
        yield
    finally:
        session.site.stop("commands")
        evidence["rate_hz"] = flooded(session.site.logs / "commands.log")[1]


@contextmanager
def fragment_pairs(session: Session, station: str, evidence: Evidence) -> Iterator[None]:
    """The two datagrams, on the channels by which station and ols-ctl hear of each other."""
    sender, ended, sent = Sender(LIVE_URL), threading.Event(), [0]
    channels = f"OLS_PTU_{station}", f"OLS_STATUS_{station}"

    def send() -> None:
        began = time.monotonic()
        while not ended.is_set():
            while sent[0] < (time.monotonic() - began) * PAIRS_HZ:
                for datagram in fragments.pair(channels[sent[0] % 2], sent[0]):
                    sender.send(datagram)
                sent[0] += 1
            ended.wait(0.002)

    thread, began = threading.Thread(target=send, daemon=True), time.monotonic()
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        evidence["rate_hz"] = sent[0] / (time.monotonic() - began)
        sender.close()


CRITERION = f"its PTU begins to brake within {HALT_S:g} s of the STOP, {STOPS} of {STOPS} times"

case(
    "stop-under-flood",
    f"{STOPS} times `ols-ctl STATION stop` at full speed, under {FLOOD_HZ} forged commands/s",
    CRITERION,
    partial(judge, least_hz=0.9 * FLOOD_HZ),
)(partial(do, attack=forged_commands, swung=swung_by_the_flood))
case(
    "stop-under-fragments",
    f"the same under the two datagrams that ended every process, {PAIRS_HZ} times a second",
    CRITERION,
    partial(judge, least_hz=0.9 * PAIRS_HZ),
)(partial(do, attack=fragment_pairs, swung=swung_by_hand))
