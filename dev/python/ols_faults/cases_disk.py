"""A full and a read-only disk under a station's recordings."""

import errno
import shutil
import subprocess
from functools import partial
from pathlib import Path
from typing import Any

import ols_msg
from ols_demo.site import SiteError

from ols_faults import mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import FRAME_HZ, alarm_of, judge_alarm, judge_goes_on
from ols_faults.session import Session

DISK_BYTES = 24_000_000
JUDGED_S = 6.0
REPORTED_S = 4.0


def mount(folder: Path) -> None:
    """Mounts a small disk in our mount namespace."""
    folder.mkdir(parents=True, exist_ok=True)
    command = ["mount", "-t", "tmpfs", "-o", f"size={DISK_BYTES},mode=0777", "tmpfs", str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SiteError(f"no small disk at {folder}: {done.stderr.strip()}")


def remount(folder: Path, how: str) -> None:
    subprocess.run(["mount", "-o", f"remount,{how}", str(folder)], check=True)


def fill(folder: Path) -> Path:
    if not folder.is_mount():
        raise SiteError(f"{folder} is no disk of its own: it is not filled")
    path = folder / "filling"
    with open(path, "wb", buffering=0) as file:
        try:
            while True:
                file.write(b"\0" * 65536)
        except OSError as problem:
            if problem.errno != errno.ENOSPC:
                raise
    return path


def record(session: Session, station: str, label: str) -> None:
    message = session.address(ols_msg.record_t(), station)
    message.event_utime, message.before_s, message.after_s = 0, 1.0, 0.5
    message.label = label
    session.publish(f"OLS_RECORD_{station}", message)


def recorded(folder: Path) -> set[str]:
    """Complete events. An incomplete one is called .partial and has no list of frames."""
    return {path.parent.name for path in folder.glob("*/frames.csv") if is_complete(path)}


def is_complete(frames: Path) -> bool:
    return not frames.parent.name.endswith(".partial") and any(frames.parent.glob("*.png"))


def judge(evidence: Evidence, outcome: Outcome, words: tuple[str, ...]) -> None:
    """Tracking continues as before, and failed writes are reported."""
    station, window = evidence["station"], evidence["window"]
    judge_alarm(evidence, outcome, "reported", station, window[0], REPORTED_S, *words)
    judge_goes_on(evidence, outcome, station, window, 0.85 * FRAME_HZ)
    outcome.holds(
        "nothing is recorded meanwhile",
        not evidence["meanwhile"],
        ", ".join(evidence["meanwhile"]) or "yes",
        broken_by=mutations.fact("the disk takes it", "meanwhile", ["20261122_full"]),
    )
    broken_by = mutations.fact("no event is ever complete", "recorded_s", None)
    outcome.recovered("records again", evidence["recorded_s"], 8.0, broken_by=broken_by)


def do(session: Session, evidence: Evidence, label: str, begin: Any, end: Any) -> None:
    station = evidence["station"] = session.disk_station
    session.wait(lambda: not alarm_of(session.status(station), "recorder:"), 10.0)
    session.fresh_status(station)
    # Complete events that the quota removes meanwhile are ignored.
    before = recorded(session.disk)
    undo = begin(session.disk)
    try:
        record(session, station, label)
        evidence["window"] = session.run(JUDGED_S)
        evidence["meanwhile"] = sorted(recorded(session.disk) - before)
    finally:
        end(undo)
    evidence["recorded_s"] = records_again_s(session)


def fetch(session: Session) -> None:
    """The recordings are copied and removed: the station may record again."""
    for name in recorded(session.disk):
        shutil.rmtree(session.disk / name)


def records_again_s(session: Session) -> float | None:
    fetch(session)
    ended_us, before = session.now_us(), recorded(session.disk)
    for _ in range(12):  # an operator who tries again
        record(session, session.disk_station, "after")
        if session.wait(lambda: bool(recorded(session.disk) - before), 1.0) is not None:
            return (session.now_us() - ended_us) * 1e-6
    return None


def read_only(folder: Path) -> Path:
    remount(folder, "ro")
    return folder


CRITERION = "tracking untouched, reported"


@case(
    "disk-full",
    "the station's disk is full",
    CRITERION,
    partial(judge, words=("recorder:", "disk full")),
)
def disk_full(session: Session, evidence: Evidence) -> None:
    do(session, evidence, "full", fill, Path.unlink)


@case(
    "disk-read-only",
    "the station's log directory is read-only",
    CRITERION,
    partial(judge, words=("recorder:", "Read-only")),
)
def disk_read_only(session: Session, evidence: Evidence) -> None:
    do(session, evidence, "readonly", read_only, lambda folder: remount(folder, "rw"))
