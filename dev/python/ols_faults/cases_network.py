"""A network that loses, duplicates and reorders; a network that is flooded.

The errors are compared with those of a second fusion that receives the same bearings on an
undisturbed bus: they depend mostly on the target's place in the site.
"""

import re
from pathlib import Path
from typing import Any

import numpy as np
from ols_bench.processes import resident_bytes
from ols_demo.bus import LIVE_URL, counters
from ols_demo.evaluate import JOINT
from ols_demo.site import SiteError

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import TWIN, Evidence
from ols_faults.judges import FRAME_HZ, judge_counted
from ols_faults.session import Session
from ols_faults.wire import Ear

FAR_URL = "udpm://239.255.76.69:7669?ttl=0"
TO_FUSION = "OLS_(BEARING|STATUS)_.*"
FROM_FUSION = "OLS_SLEW_.*"
FUSION = "OLS_FUSION_STATUS"
WORSE_AT_MOST = 1.2
ARRIVING = 0.93  # of the bearings, when 5 % are lost: four deviations of the count on top
FIXES = 0.8  # of the twin's: they come with bearings, some of which are lost
LONGEST_S = 0.5
JUDGED_S = 20.0
LOSS = 0.05
FLOOD_HZ = 10_000
FLOOD_S = 15.0
# Of the flood: half of it are the site's channels, of these nine two are the fusion's, four of five
# of these are of stations that exist. (sim/network/flood.cpp)
FUSION_HZ = FLOOD_HZ / 2 * 2 / 9 * 4 / 5


class FarFusion:
    """Runs the fusion behind a relay on a separate bus for one case."""

    def __init__(self, session: Session):
        self._session = session
        session.kill("ols-fusion")
        session.start_fusion(FAR_URL)
        # Targets are recorded at the fusion: the relay's effect on them is not judged.
        self.ear = Ear(FAR_URL, self._receive)
        session.add_handler(self._handle)

    def _receive(self, channel: str, message: Any, at_us: int) -> None:
        if channel.startswith("OLS_TARGET") or channel == FUSION:
            self._session.hear(channel, message, at_us)

    def _handle(self) -> None:
        self.ear.handle(0.0)

    def relay(self, *impairments: str) -> None:
        session = self._session
        if "relay" in session.site.processes:
            session.site.stop("relay")
        command = [session.wiring.program("ols-sim-relay"), "--from", LIVE_URL, "--to", FAR_URL]
        command += ["--channels", TO_FUSION, "--back-channels", FROM_FUSION]
        command += ["--seed", str(session.seed), *impairments]
        session.site.start_and_wait("relay", command, "ready")

    def close(self) -> None:
        session = self._session
        session.remove_handler(self._handle)
        for name in ("relay", "ols-fusion"):
            if name in session.site.processes:
                session.site.stop(name)
        self.ear.close()
        session.start_fusion()


def judge_beside_the_twin(evidence: Evidence, outcome: Outcome, window: tuple[int, int]) -> None:
    errors, share = measure.same_epochs_m(evidence.heard, JOINT, TWIN, *window)
    broken_by = mutations.targets_lost(window, 0.5)
    outcome.at_least(
        "positions, over those of the undisturbed fusion", share, FIXES, broken_by=broken_by
    )
    rms = np.sqrt(np.mean(errors**2, axis=0)) if len(errors) else np.full(2, np.nan)
    outcome.at_most(
        "RMS error over that of the undisturbed fusion",
        float(rms[0] / rms[1]),
        WORSE_AT_MOST,
        note=f"{rms[0]:.3f} m, {rms[1]:.3f} m at {len(errors)} instants",
        broken_by=mutations.targets_shifted(0.5, window),
    )
    middle_us = sum(window) // 2
    measured = measure.longest_gap_s(measure.target_arrivals_us(evidence.heard, *window), *window)
    broken_by = mutations.targets_lost((middle_us, middle_us + 800_000))
    outcome.at_most("longest time without a target", measured, LONGEST_S, "s", broken_by=broken_by)


def arriving(evidence: Evidence, window: tuple[int, int]) -> float | None:
    """Of the bearings that the stations sent, those that the fusion counts, once each."""
    told = measure.between_arrivals(evidence.heard, FUSION, *window)
    if len(told) < 2:
        return None
    (first, first_us), (last, last_us) = told[0], told[-1]
    taken = counters(last).get("bearings", 0.0) - counters(first).get("bearings", 0.0)
    sent = sum(
        len(measure.bearing_ages_s(evidence.heard, station, first_us, last_us))
        for station in evidence.stations
    )
    return taken / sent if sent else None


def judge_bad_network(evidence: Evidence, outcome: Outcome) -> None:
    window = evidence["window"]
    for station in evidence.stations:
        measured = measure.bearings_hz(evidence.heard, station, *window)
        broken_by = mutations.bearings_lost(station, window, 0.78)
        outcome.at_least(
            f"{station}: bearings sent", measured, 0.85 * FRAME_HZ, "Hz", broken_by=broken_by
        )
    share = arriving(evidence, window)

    def fewer(status: Any) -> Any:
        return mutations.scaled_counter(status, "bearings", 0.22)

    def none_lost(status: Any) -> Any:
        return mutations.scaled_counter(status, "bearings", 1.0 / (share or 1.0))

    broken_by = mutations.altering("78 % of the messages are lost", FUSION, fewer)
    outcome.at_least("share of the bearings that arrives", share, ARRIVING, broken_by=broken_by)
    broken_by = mutations.altering("the relay loses nothing", FUSION, none_lost)
    outcome.at_most("and at most", share, 0.98, broken_by=broken_by)
    judge_beside_the_twin(evidence, outcome, window)
    counts = evidence["relay"]
    outcome.holds(
        "the relay lost, doubled and reordered",
        min(counts[1:]) >= 0.5 * LOSS * counts[0] > 0,
        f"{counts[1]} lost, {counts[2]} doubled, {counts[3]} reordered of {counts[0]}",
        broken_by=mutations.fact("the relay doubles nothing", "relay", (*counts[:2], 0, counts[3])),
    )


@case(
    "lcm-bad-network",
    "LCM: 5 % loss, 5 % duplicates, 5 % reordering, by a relay",
    "against an undisturbed second fusion: error <= 1.2 times, as many positions",
    judge_bad_network,
)
def lcm_bad_network(session: Session, evidence: Evidence) -> None:
    far = FarFusion(session)
    try:
        with session.twin():
            far.relay()
            session.wait(session.well, 15.0)
            session.run(3.0)  # both filters have settled
            far.relay(*(f"--{how}={LOSS}" for how in ("loss", "duplicate", "reorder")))
            session.run(1.0)
            evidence["window"] = session.run(JUDGED_S)
            session.site.stop("relay")
    finally:
        far.close()
    evidence["relay"] = relayed(session.site.logs / "relay.log")


def relayed(log: Path) -> tuple[int, ...]:
    """How many messages the newest relay received, lost, duplicated and reordered."""
    found = re.findall(
        r"forward: received (\d+), lost (\d+), duplicated (\d+), reordered (\d+)",
        log.read_text(errors="replace"),
    )
    return tuple(map(int, found[-1])) if found else (0, 0, 0, 0)


def judge_flood(evidence: Evidence, outcome: Outcome) -> None:
    window = evidence["window"]
    measured = evidence["rate_hz"]
    broken_by = mutations.fact("the flood is half of it", "rate_hz", FLOOD_HZ / 2)
    outcome.at_least("messages sent", measured, 0.95 * FLOOD_HZ, "Hz", broken_by=broken_by)
    grown = evidence["grown"]
    worst = max(grown, key=lambda name: grown[name])
    measured = grown[worst] / 1e6
    broken_by = mutations.fact("a queue grows", "grown", {worst: grown[worst] + 5e6})
    outcome.at_most("resident memory grown", measured, 2.0, "MB", note=worst, broken_by=broken_by)
    measured = target_lag_s(evidence, window)
    broken_by = mutations.late("the fusion lags behind", JOINT, window, 0.5)
    outcome.at_most("age of targets (95 %)", measured, 0.5, "s", broken_by=broken_by)
    for station in evidence.stations:
        measured = measure.bearings_hz(evidence.heard, station, *window)
        broken_by = mutations.bearings_lost(station, window, 0.5)
        outcome.at_least(
            f"{station}: bearings sent", measured, 0.75 * FRAME_HZ, "Hz", broken_by=broken_by
        )
    judge_beside_the_twin(evidence, outcome, window)
    least = 0.5 * FUSION_HZ * FLOOD_S
    judge_counted(
        evidence, outcome, "counted by the fusion", FUSION, "messages_malformed", window, least
    )
    broken_by = mutations.fact("it does not get well again", "well_s", None)
    outcome.recovered("normal after the flood", evidence["well_s"], 5.0, broken_by=broken_by)


@case(
    "lcm-flood",
    "10 000 foreign messages a second",
    "against an undisturbed second fusion: error <= 1.2 times, as many positions; no queue grows",
    judge_flood,
)
def lcm_flood(session: Session, evidence: Evidence) -> None:
    with session.twin():
        session.run(3.0)
        command = [session.wiring.program("ols-sim-flood"), "--lcm-url", LIVE_URL]
        command += ["--rate", str(FLOOD_HZ), "--stations", ",".join(session.stations)]
        session.site.start_and_wait("flood", [*command, "--seed", str(session.seed)], "ready")
        session.run(3.0)
        names = ["ols-fusion", *(session.process(s) for s in session.stations)]
        before = {name: resident_bytes(session.pid(name)) for name in names}
        evidence["window"] = session.run(FLOOD_S)
        evidence["grown"] = {
            name: resident_bytes(session.pid(name)) - before[name] for name in names
        }
        session.site.stop("flood")
    evidence["rate_hz"] = flooded(session.site.logs / "flood.log")[1]
    evidence["well_s"] = session.wait(session.well, 10.0)


def flooded(log: Path) -> tuple[int, float]:
    """The number of messages of the newest flood, and its rate per second."""
    sent = re.findall(r"sent (\d+) in ([\d.]+) s", log.read_text(errors="replace"))
    if not sent:
        raise SiteError("the flood did not say what it sent")
    return int(sent[-1][0]), float(sent[-1][0]) / float(sent[-1][1])


def target_lag_s(evidence: Evidence, window: tuple[int, int]) -> float | None:
    arrived = measure.between_arrivals(evidence.heard, JOINT, *window)
    lags = sorted((at - target.utime) * 1e-6 for target, at in arrived)
    return lags[int(0.95 * len(lags))] if lags else None
