"""A network that loses, doubles and reorders; a network that is flooded."""

import re
from pathlib import Path

from ols_demo.bus import LIVE_URL, Bus, counters
from ols_demo.site import SiteError

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.processes import resident_bytes
from ols_faults.session import Session

FAR_URL = "udpm://239.255.76.69:7669?ttl=0"
TO_FUSION = "OLS_(BEARING|STATUS)_.*"
FROM_FUSION = "OLS_SLEW_.*"
WORSE_AT_MOST = 1.2
JUDGED_S = 20.0
FLOOD_HZ = 10_000
FLOOD_S = 15.0


class FarFusion:
    """The fusion on a bus of its own behind a relay, for one case."""

    def __init__(self, session: Session):
        self._session = session
        session.kill("ols-fusion")
        session.start_fusion(FAR_URL)
        # Targets are heard where the fusion is: what the relay does to them is not judged.
        self.bus = Bus(FAR_URL, self._receive)
        session.add_handler(self._handle)

    def _receive(self, channel: str, message: object) -> None:
        if channel.startswith("OLS_TARGET") or channel == "OLS_FUSION_STATUS":
            self._session.hear(channel, message)

    def _handle(self) -> None:
        self.bus.handle(0.0)

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
        session.start_fusion()


@case(
    "lcm-bad-network",
    "LCM: 5 % loss, 5 % duplicates, 5 % reordering, by a relay",
    "error <= 1.2 x undisturbed",
)
def lcm_bad_network(session: Session, outcome: Outcome) -> None:
    far = FarFusion(session)
    try:
        far.relay()
        session.wait(session.well, 15.0)
        # Undisturbed, disturbed, undisturbed again: the target's place in the site changes too.
        first = session.run(JUDGED_S / 2)
        far.relay("--loss", "0.05", "--duplicate", "0.05", "--reorder", "0.05")
        session.run(1.0)
        window = session.run(JUDGED_S)
        far.relay()
        session.run(1.0)
        second = session.run(JUDGED_S / 2)
    finally:
        far.close()
    judge_error(session, outcome, [first, second], window)
    log = session.site.logs / "relay.log"
    outcome.holds("the relay did it", *disturbed(log))


def disturbed(log: Path) -> tuple[bool, str]:
    found = [
        tuple(map(int, m))
        for m in re.findall(
            r"forward: received (\d+), lost (\d+), duplicated (\d+), reordered (\d+)",
            log.read_text(errors="replace"),
        )
    ]
    worst = max(found, key=lambda counts: counts[1], default=(0, 0, 0, 0))
    text = f"{worst[1]} lost, {worst[2]} doubled, {worst[3]} reordered of {worst[0]}"
    return min(worst[1:]) > 0, text


def judge_error(
    session: Session, outcome: Outcome, calm: list[tuple[int, int]], window: tuple[int, int]
) -> None:
    errors = [measure.target_error_m(session.heard, *span) for span in calm]
    known = [error for error in errors if error is not None]
    usual = (sum(e * e for e in known) / len(known)) ** 0.5 if known else float("nan")
    outcome.at_most("undisturbed RMS error", usual, 5.0, "m")
    error = measure.target_error_m(session.heard, *window)
    ratio = error / usual if error is not None else None
    outcome.at_most(f"RMS error over undisturbed ({error or 0:.3f} m)", ratio, WORSE_AT_MOST)


@case(
    "lcm-flood",
    "10 000 foreign messages a second",
    "error <= 1.2 x undisturbed; no queue that grows",
)
def lcm_flood(session: Session, outcome: Outcome) -> None:
    calm = session.run(JUDGED_S / 2)
    command = [session.wiring.program("ols-sim-flood"), "--lcm-url", LIVE_URL]
    command += ["--rate", str(FLOOD_HZ), "--stations", ",".join(session.stations)]
    session.site.start_and_wait("flood", [*command, "--seed", str(session.seed)], "ready")
    session.run(3.0)
    names = ["ols-fusion", *(session.process(s) for s in session.stations)]
    before = {name: resident_bytes(session.pid(name)) for name in names}
    window = session.run(FLOOD_S)
    grown = {name: resident_bytes(session.pid(name)) - before[name] for name in names}
    session.site.stop("flood")
    sent = re.findall(r"sent (\d+) in ([\d.]+) s", (session.site.logs / "flood.log").read_text())
    if not sent:
        raise SiteError("the flood did not say what it sent")
    rate = float(sent[-1][0]) / float(sent[-1][1])
    outcome.at_least("messages sent", rate, 0.95 * FLOOD_HZ, "Hz")
    worst = max(grown, key=lambda name: grown[name])
    outcome.at_most(f"resident memory grown ({worst})", grown[worst] / 1e6, 2.0, "MB")
    lag = target_lag_s(session, window)
    outcome.at_most("age of targets (95 %)", lag, 0.5, "s")
    after = session.run(JUDGED_S / 2)
    judge_error(session, outcome, [calm, after], window)
    fusion = counters(session.observer.fusion)
    refused = fusion.get("messages_malformed", 0.0)
    outcome.at_least("malformed messages counted by the fusion", refused, 100.0)
    back = session.wait(session.well, 10.0)
    outcome.recovered("normal after the flood", back, 5.0)


def target_lag_s(session: Session, window: tuple[int, int]) -> float | None:
    both = zip(
        session.heard.targets["OLS_TARGET"],
        session.heard.arrivals_us["OLS_TARGET"],
        strict=True,
    )
    lags = sorted((at - t.utime) * 1e-6 for t, at in both if window[0] <= at <= window[1])
    return lags[int(0.95 * len(lags))] if lags else None
