"""Where messages come from: logs, and the bus."""

import time
from collections.abc import Callable
from pathlib import Path

import ols

from ols_archive.archiver import Archiver

SILENT_MS = 200


def archive_log(path: Path, archiver: Archiver) -> None:
    """A log of ols-logger or lcm-logger. What is damaged is named and counted."""
    tally = archiver.tally
    if path.is_dir():
        tally.count("unreadable", f"{path}: is a folder")
        return
    try:
        reader = ols.LogReader(str(path))
    except ValueError as error:
        tally.count("unreadable", str(error))
        return
    try:
        for recorded_us, channel, payload, signature in reader:
            where = f"{path}: byte {reader.message_offset}"
            archiver.take(recorded_us, channel, payload, signature, where)
    except ValueError as error:  # another file, or a disk that fails
        tally.count("unreadable", str(error))
        return
    if reader.garbage_bytes:
        tally.count("garbage_bytes", f"{path}: {reader.damage}", reader.garbage_bytes)
    if reader.is_cut_off:
        tally.count("cut_off", f"{path}: {reader.damage}")


class LiveSource:
    """The bus, with a new connection when the old one hears nothing any more."""

    def __init__(self, url: str, archiver: Archiver, trust: "ols.Trust | None"):
        self._url, self._archiver, self._trust = url, archiver, trust
        self._connect()

    def _connect(self) -> None:
        self._bus = ols.Bus(self._url, self._trust)
        self._bus.subscribe("OLS_.*", self._take)

    def _take(self, recorded_us: int, channel: str, payload: bytes, signature: bytes) -> None:
        self._archiver.take(recorded_us, channel, payload, signature, self._url)

    def run(self, flush_s: float, is_over: Callable[[], bool]) -> None:
        """Until is_over(); what came until then is in the files."""
        flushed_s = time.monotonic()
        while not is_over():
            self._bus.handle(SILENT_MS)
            if self._bus.is_deaf:
                self._count_refused()
                self._connect()
            if time.monotonic() - flushed_s >= flush_s:
                self._archiver.flush()
                flushed_s = time.monotonic()
        while self._bus.handle(0):
            pass
        self._archiver.flush()
        self._count_refused()

    def _count_refused(self) -> None:
        for reason, count in self._bus.refused().items():
            if count:
                self._archiver.tally.count(f"bus_{reason}", times=count)
