"""Attacks on the readers of the bus: malformed datagrams, and endless new channels."""

import re
import subprocess
import time
from pathlib import Path

from ols_bench.processes import datagrams_dropped, resident_bytes
from ols_demo.bus import LIVE_URL

from ols_faults import fragments, measure, mutations
from ols_faults.case import Mutation, Outcome, case
from ols_faults.cases_network import FUSION, flooded
from ols_faults.evidence import Evidence
from ols_faults.judges import FRAME_HZ, judge_counted, judge_goes_on
from ols_faults.session import Session
from ols_faults.wire import Sender

ROUNDS = 3
CTL_S = 20.0
REFUSED = "bus_fragments_refused"  # as the stations and the fusion count them
MALFORMED = "bus_datagrams_malformed"

CHANNELS = 2_000_000
CHANNELS_HZ = 40_000
GROWN_MB = 5.0
UNKNOWN_S = 150.0


def targets_of(session: Session) -> list[str]:
    """The channels that each kind of process reads."""
    channels = ["OLS_STATUS_x", "OLS_BEARING_x", "OLS_FUSION_STATUS", "OLS_TARGET"]
    for station in session.stations:
        channels += [f"OLS_{kind}_{station}" for kind in ("PTU", "SLEW", "DESIGNATE", "STATUS")]
    return channels


class Logger:
    """ols-logger, for one case."""

    def __init__(self, session: Session):
        self._session = session
        folder = session.site.logs / "bus"
        folder.mkdir(parents=True, exist_ok=True)
        config = session.site.logs / "logger.toml"
        config.write_text(f'folder = "{folder}"\nlcm_url = "{LIVE_URL}"\ndisk_reserve_gb = 0.1\n')
        self._folder = folder
        program = session.wiring.program("ols-logger")
        session.site.start("ols-logger", [program, "--config", str(config)])
        session.wait(lambda: self.recorded() > 0, 10.0)

    def recorded(self) -> int:
        return sum(path.stat().st_size for path in self._folder.iterdir())

    def recorders(self) -> list[int]:
        """The processes that record for it, if it does not record itself."""
        pid = self._session.pid("ols-logger")
        path = Path(f"/proc/{pid}/task/{pid}/children")
        return [int(child) for child in path.read_text().split()] if path.exists() else []

    def close(self) -> None:
        if "ols-logger" in self._session.site.processes:
            self._session.site.stop("ols-logger")


def attack(session: Session, sender: Sender) -> None:
    """Sends every datagram once on each channel."""
    sequence = time.monotonic_ns() % (1 << 30)
    for channel in targets_of(session):
        groups = [fragments.pair(channel, sequence), *fragments.relatives(channel, sequence)]
        groups.append(list(fragments.malformed(channel, sequence)))
        for group in groups:
            for datagram in group:
                sender.send(datagram)
        sequence += 1000
        session.turn(0.005)


def ctl_meanwhile(session: Session, sender: Sender) -> int | None:
    """The exit status of `ols-ctl` while the pair is sent repeatedly; None if it hangs."""
    program = session.wiring.program("ols-ctl")
    with subprocess.Popen(
        [program, "all", "status"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        sequence, began = 1, time.monotonic()
        while process.poll() is None and time.monotonic() - began < CTL_S:
            for channel in ("OLS_STATUS_x", f"OLS_STATUS_{session.stations[0]}"):
                sequence += 1
                for datagram in fragments.pair(channel, sequence):
                    sender.send(datagram)
            session.turn(0.002)
        if process.poll() is None:
            process.kill()
            return None
    return process.returncode


def judge_fragments(evidence: Evidence, outcome: Outcome) -> None:
    window = evidence["window"]
    outcome.holds(
        "ols-ctl lists the stations meanwhile",
        evidence["ctl"] == 0,
        f"status {evidence['ctl']}",
        broken_by=mutations.fact("ols-ctl dies", "ctl", -11),
    )
    outcome.holds(
        "the recorder is the same process",
        evidence["recorders"][0] == evidence["recorders"][1],
        f"{evidence['recorders'][0]}, then {evidence['recorders'][1]}",
        broken_by=mutations.fact("it is restarted", "recorders", ([1], [2])),
    )
    measured = evidence["recorded_bytes"] / 1e3
    broken_by = mutations.fact("it stands still", "recorded_bytes", 0)
    outcome.at_least("recorded meanwhile", measured, 50.0, "kB", broken_by=broken_by)
    for station in evidence.stations:
        judge_goes_on(evidence, outcome, station, window, 0.6 * FRAME_HZ)
        status = f"OLS_STATUS_{station}"
        for name in (REFUSED, MALFORMED):
            judge_counted(evidence, outcome, f"{station}: {name}", status, name, window, 100.0)
    for name in (REFUSED, MALFORMED):
        judge_counted(evidence, outcome, f"fusion: {name}", FUSION, name, window, 100.0)
    middle_us = sum(window) // 2
    measured = measure.longest_gap_s(measure.target_arrivals_us(evidence.heard, *window), *window)
    broken_by = mutations.targets_lost((middle_us, middle_us + 1_500_000))
    outcome.at_most("longest time without a target", measured, 1.0, "s", broken_by=broken_by)


@case(
    "bus-fragments",
    "the two datagrams that ended every process, and their near relatives, on every channel",
    "no process ends, nothing happens but a counter",
    judge_fragments,
)
def bus_fragments(session: Session, evidence: Evidence) -> None:
    with session.without_log():
        send_fragments(session, evidence)


def send_fragments(session: Session, evidence: Evidence) -> None:
    for station in session.stations:
        session.fresh_status(station)
    logger, sender = Logger(session), Sender(LIVE_URL)
    try:
        recorders, recorded = logger.recorders(), logger.recorded()
        start_us = session.now_us()
        for _ in range(ROUNDS):
            attack(session, sender)
        evidence["ctl"] = ctl_meanwhile(session, sender)
        session.run(2.0)
        evidence["window"] = start_us, session.now_us()
        evidence["recorded_bytes"] = logger.recorded() - recorded
        evidence["recorders"] = recorders, logger.recorders()
    finally:
        sender.close()
        logger.close()


def ours(session: Session) -> list[str]:
    return ["ols-fusion", *(session.process(station) for station in session.stations)]


def judge_channels(evidence: Evidence, outcome: Outcome) -> None:
    heard, grown = evidence["names_heard"], evidence["grown"]
    for name in heard:
        least = mutations.fact("half of them are dropped", "names_heard", {**heard, name: 1e6})
        outcome.at_least(f"{name}: names that reached it", heard[name], CHANNELS, broken_by=least)

        def leaks(altered: Evidence, name: str = name) -> None:
            altered["grown"][name] += round(105 * heard[name])

        broken_by = Mutation("105 bytes of each name stay", leaks)
        outcome.at_most(
            f"{name}: resident memory grown", grown[name] / 1e6, GROWN_MB, "MB", broken_by=broken_by
        )


@case(
    "many-channels",
    "two million unknown channel names",
    f"fusion and stations grow by {GROWN_MB:g} MB at most",
    judge_channels,
)
def many_channels(session: Session, evidence: Evidence) -> None:
    with session.without_log():
        flood_with_channels(session, evidence)


def flood_with_channels(session: Session, evidence: Evidence) -> None:
    """As many as each process must receive, plus what the kernel drops if one is overrun."""
    names = ours(session)
    pids = {name: session.pid(name) for name in names}
    before = {name: resident_bytes(pid) for name, pid in pids.items()}
    dropped = {name: datagrams_dropped(pid) for name, pid in pids.items()}
    command = [session.wiring.program("ols-sim-flood"), "--lcm-url", LIVE_URL]
    command += ["--rate", str(CHANNELS_HZ), "--unknown", str(10 * CHANNELS)]
    session.site.start_and_wait("channels", command, "ready")
    log = session.site.logs / "channels.log"

    def heard(name: str, sent: int) -> int:
        return sent - (datagrams_dropped(pids[name]) - dropped[name])

    deadline = time.monotonic() + UNKNOWN_S
    while time.monotonic() < deadline and not session.ended():
        session.run(1.0)
        if min(heard(name, so_far(log)) for name in names) > CHANNELS:
            break
    session.site.stop("channels")
    sent, _ = flooded(log)
    evidence["names_heard"] = {name: heard(name, sent) for name in names}
    session.run(1.0)
    evidence["grown"] = {name: resident_bytes(pids[name]) - before[name] for name in names}


def so_far(log: Path) -> int:
    """The number of messages that the newest flood reports once a second."""
    said = re.findall(r"so far (\d+)", log.read_text().rpartition("ready")[2])
    return int(said[-1]) if said else 0
