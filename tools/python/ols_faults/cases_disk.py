"""A disk that is full, and one that is read-only, under what a station records."""

import errno
import shutil
import subprocess
from pathlib import Path

import ols_msg
from ols_demo.site import SiteError

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.cases_sensors import flagged_s
from ols_faults.session import Session

DISK_BYTES = 24_000_000
JUDGED_S = 6.0
REPORTED_S = 4.0


def mount(folder: Path) -> None:
    """A small disk of its own in our mount namespace."""
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


def folders(session: Session) -> set[str]:
    return {path.name for path in session.disk.iterdir() if path.is_dir()}


def judge_disk(session: Session, outcome: Outcome, what: str) -> None:
    """Tracking goes on as before, and what cannot be written is reported."""
    station = session.disk_station
    start_us = session.now_us()
    record(session, station, what)
    window = session.run(JUDGED_S)
    seen_s, text = flagged_s(session, station, start_us, "record")
    outcome.at_most(f"reported ({text})", seen_s, REPORTED_S, "s")
    ages = measure.bearing_ages_s(session.heard, station, *window)
    outcome.at_least("bearings meanwhile", len(ages) / JUDGED_S, 0.85 * 12.0, "Hz")
    away = session.state_since(station, start_us) - {"tracking", "coasting"}
    outcome.holds("goes on tracking", not away, ", ".join(sorted(away)) or "yes")


def fetch(session: Session) -> None:
    """Somebody takes the recordings along: the station itself keeps them."""
    for name in folders(session):
        if not name.endswith(".partial"):
            shutil.rmtree(session.disk / name)


def judge_recorded_again(session: Session, outcome: Outcome, ended_us: int) -> None:
    fetch(session)
    before = folders(session)
    recovered_s = None
    for _ in range(12):  # an operator who tries again
        record(session, session.disk_station, "after")
        if session.wait(lambda: bool(folders(session) - before), 1.0) is not None:
            recovered_s = (session.now_us() - ended_us) * 1e-6
            break
    outcome.recovered("records again", recovered_s, 8.0)


@case("disk-full", "the station's disk is full", "tracking untouched, reported")
def disk_full(session: Session, outcome: Outcome) -> None:
    path = fill(session.disk)
    try:
        judge_disk(session, outcome, "full")
    finally:
        path.unlink()
    judge_recorded_again(session, outcome, session.now_us())


@case("disk-read-only", "the station's log directory is read-only", "tracking untouched, reported")
def disk_read_only(session: Session, outcome: Outcome) -> None:
    remount(session.disk, "ro")
    try:
        judge_disk(session, outcome, "readonly")
    finally:
        remount(session.disk, "rw")
    judge_recorded_again(session, outcome, session.now_us())
