"""ols-archive on the bus: what is published is in the files, also what is signed and by whom."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import lcm
import ols_msg
import pytest
from archive_site import REGION, event, write_log
from conftest import finished, made, wait
from ols_archive.archiver import Archiver as Collected
from ols_archive.partitions import Damaged, file_of, hours_of, read
from ols_archive.sources import LiveSource
from ols_demo.bus import LIVE_URL
from ols_demo.keys import members_of_environment

DEADLINE_S = 60.0


def bearing(sequence: int) -> "ols_msg.bearing_t":
    return made(ols_msg.bearing_t, station="alfa", boot_id=77, sequence=sequence)


class Archiver:
    def __init__(self, folder: Path, *options: str):
        self.archive, self.errors = folder / "archive", folder / "errors.txt"
        command = [sys.executable, "-m", "ols_archive", str(self.archive), "--region", REGION]
        command += ["--live", LIVE_URL, "--flush-s", "0.1", *options]
        with self.errors.open("w") as errors:
            self.process = subprocess.Popen(command, stderr=errors)
        self.wait(lambda: "ready" in self.errors.read_text(), "it is ready")

    def wait(self, condition, what):
        wait(lambda: condition() or self.process.poll() is not None, what)
        assert self.process.poll() is None, self.errors.read_text()

    def rows(self) -> list[dict]:
        return [
            row
            for hour in hours_of(self.archive, "bearing")
            for row in read(file_of(self.archive, "bearing", hour)).to_pylist()
        ]

    def end(self, sent=signal.SIGTERM) -> int:
        self.process.send_signal(sent)
        return self.process.wait(DEADLINE_S)


@pytest.fixture(name="archiver")
def fixture_archiver(unsigned, tmp_path):
    running = Archiver(tmp_path)
    yield running
    running.process.kill()
    running.process.wait()


def test_what_is_published_is_archived_once(archiver, tmp_path):
    bus = lcm.LCM(LIVE_URL)
    messages = [bearing(n) for n in range(20)]
    for message in [*messages, *messages]:
        bus.publish("OLS_BEARING_alfa", message.encode())
    bus.publish("OLS_BEARING_alfa", b"rubbish")
    archiver.wait(lambda: len(archiver.rows()) == 20, "all are in the files")
    assert archiver.end() == 1
    told = archiver.errors.read_text()
    assert "20 added, 20 repeated, 1 undecodable" in told
    # Its log adds nothing: the same messages.
    log = write_log(tmp_path / "a.lcmlog", map(event, messages))
    again = finished(
        sys.executable, "-m", "ols_archive", archiver.archive, "--region", REGION, log, check=True
    )
    assert "0 added, 20 repeated" in again.stderr


def test_killed_it_leaves_whole_files_and_the_log_completes_them(archiver, tmp_path):
    bus = lcm.LCM(LIVE_URL)
    messages = [bearing(n) for n in range(200)]
    for message in messages[:100]:
        bus.publish("OLS_BEARING_alfa", message.encode())
    archiver.wait(lambda: len(archiver.rows()) > 0, "some are in the files")
    for message in messages[100:]:
        bus.publish("OLS_BEARING_alfa", message.encode())
    assert archiver.end(signal.SIGKILL) == -signal.SIGKILL
    try:
        assert 0 < len(archiver.rows()) <= 200
    except Damaged as error:
        pytest.fail(str(error))
    log = write_log(tmp_path / "a.lcmlog", map(event, messages))
    command = [sys.executable, "-m", "ols_archive", str(archiver.archive), "--region", REGION]
    subprocess.run([*command, str(log)], check=True, capture_output=True)
    assert sorted(row["sequence"] for row in archiver.rows()) == list(range(200))


def test_with_keys_only_what_a_member_has_signed_is_archived(network, tmp_path, monkeypatch):
    monkeypatch.setenv("OLS_TRUST", "require")
    archiver = Archiver(tmp_path, "--keys", os.environ["OLS_KEYS"])
    try:
        bus, members = lcm.LCM(LIVE_URL), members_of_environment()
        bus.publish("OLS_BEARING_alfa", bearing(1).encode())
        signed = members.sign("OLS_BEARING_alfa", bearing(2).encode())
        bus.publish("OLS_BEARING_alfa", signed)
        archiver.wait(lambda: len(archiver.rows()) > 0, "the signed one is in the files")
        archiver.end()
        (row,) = archiver.rows()
        assert row["sequence"] == 2
        assert row["signature"] == signed[-96:]
        assert "1 bus_" in archiver.errors.read_text()
    finally:
        archiver.process.kill()
        archiver.process.wait()


def test_what_waits_at_the_end_is_written(unsigned, tmp_path):
    collected = Collected(tmp_path / "archive", REGION)
    source = LiveSource(LIVE_URL, collected, None)
    bus = lcm.LCM(LIVE_URL)
    for number in range(5):
        bus.publish("OLS_BEARING_alfa", bearing(number).encode())
    end = time.monotonic() + DEADLINE_S
    source.run(3600.0, lambda: collected.waiting == 5 or time.monotonic() > end)
    assert collected.tally.counts["added"] == 5
    assert collected.waiting == 0
