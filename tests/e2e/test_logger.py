"""The site's logger: quota, full and read-only disks, files taken away, forged datagrams, end."""

import gzip
import json
import os
import shutil
import signal
import socket
import struct
import subprocess
import time
from pathlib import Path

import lcm
import pytest
from conftest import BIN, finished, wait
from ols_demo.bus import LIVE_URL
from ols_demo.keys import members_of_environment
from ols_faults import fragments

FLOOD = "OLS_SIM_FLOOD"  # of the simulator, which may send much and anything
DEADLINE_S = 60.0
SPLIT_BYTES = 50_000
QUOTA_BYTES = 300_000


class Flood:
    """Sends messages of some length, signed by the simulator."""

    def __init__(self):
        self._lcm, self._members = lcm.LCM(LIVE_URL), members_of_environment()

    def publish(self, length, start=b""):
        head = struct.pack(">QQ", 0, time.time_ns() // 1000)
        self._lcm.publish(FLOOD, self._members.sign(FLOOD, head + start.ljust(length, b"x")))


class Shell:
    """A shell in a mount namespace of its own, where it may have a small disk for the logs."""

    def __init__(self):
        pipe = subprocess.PIPE
        command = ["unshare", "--mount", "sh"]
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)

    def run(self, command):
        self.process.stdin.write(f"{command}\necho; echo :end\n")
        self.process.stdin.flush()
        lines = []
        while (line := self.process.stdout.readline()) != ":end\n":
            assert line, f"the shell ended: {command}"
            lines.append(line)
        return "".join(lines).strip()

    def end(self):
        self.process.communicate(timeout=DEADLINE_S)


class Logger:
    """One ols-logger; on a small tmpfs when a size is given."""

    def __init__(self, folder, disk_bytes=None, reserve_bytes=0, mount="rw", signed=True, **keys):
        self.logs, self.status_file = folder / "logs", folder / "status.json"
        self.errors, self.ended = folder / "errors", False
        self.logs.mkdir()
        keys = {"quota_gb": QUOTA_BYTES * 1e-9, "split_mb": SPLIT_BYTES * 1e-6} | keys
        config = folder / "logger.toml"
        config.write_text(
            f'folder = "{self.logs}"\nstatus_file = "{self.status_file}"\nlcm_url = "{LIVE_URL}"\n'
            f"disk_reserve_gb = {reserve_bytes * 1e-9:.9f}\n"
            + "".join(f"{key} = {value:.9f}\n" for key, value in keys.items())
            + ("" if signed else '[trust]\nmode = "off"\n')
        )
        self.shell = Shell()
        if disk_bytes is not None:
            self.shell.run(f"mount -t tmpfs -o size={disk_bytes},{mount} tmpfs {self.logs}")
        program = f"{BIN / 'ols-logger'} --config {config}"
        self.pid = int(self.shell.run(f"{program} </dev/null >/dev/null 2>{self.errors} & echo $!"))
        self.bus = Flood()

    def status(self):
        try:
            return json.loads(self.status_file.read_text())
        except FileNotFoundError:
            return {}

    def wait_for(self, what, condition):
        wait(lambda: (s := self.status()) and condition(s), what)

    def wait_recording(self):
        """It records indeed: what is published now is in a log soon."""

        def grows():
            self.bus.publish(2000)
            sizes = self.sizes()
            return sizes and (sum(sizes.values()) > before or sizes.keys() != names)

        names = self.sizes().keys()
        before = sum(self.sizes().values())
        wait(grows, "a log that grows")

    def sizes(self):
        listed = self.shell.run(f"stat -c '%n %s' {self.logs}/*.lcmlog.* 2>/dev/null")
        pairs = (line.split() for line in listed.splitlines())
        return {Path(name).name: int(size) for name, size in pairs}

    def free_bytes(self):
        blocks, size = self.shell.run(f"stat -f -c '%a %S' {self.logs}").split()
        return int(blocks) * int(size)

    def end(self, sent=signal.SIGTERM):
        self.ended = True
        os.kill(self.pid, sent)
        code = int(self.shell.run(f"wait {self.pid}; echo $?"))
        return code, self.errors.read_text()

    def clean_up(self):
        if not self.ended:
            self.end()
        self.shell.end()


@pytest.fixture
def start(tmp_path, network):
    started = []

    def make(**options):
        started.append(Logger(tmp_path, **options))
        return started[-1]

    yield make
    for logger in started:
        logger.clean_up()


def test_a_flood_stays_within_the_quota_and_the_oldest_go_first(start):
    logger = start()
    logger.wait_recording()
    order, greatest = [], 0

    def flood():
        nonlocal order, greatest
        for _ in range(5):
            logger.bus.publish(2000)
        sizes = logger.sizes()
        greatest = max(greatest, sum(sizes.values()))
        order += sorted(set(sizes) - set(order))
        time.sleep(0.01)

    wait(lambda: logger.status().get("files_removed", 0) >= 8, "removed files", turn=flood)
    logger.end()
    left = sorted(logger.sizes())
    order += sorted(set(left) - set(order))  # begun since the last look
    assert greatest <= QUOTA_BYTES
    assert len(left) >= 2
    assert left == sorted(order[-len(left) :])
    # What is left can be read to its end, and each file begins with the trust list.
    for name in left:
        channels = [event.channel for event in lcm.EventLog(str(logger.logs / name))]
        assert channels == ["OLS_TRUST", *[FLOOD] * (len(channels) - 1)]


def test_waits_while_the_disk_is_full_of_other_things_and_records_again(start):
    logger = start(disk_bytes=1_000_000, reserve_bytes=200_000)
    logger.wait_recording()
    filler = logger.logs / "filler"
    logger.shell.run(f"head -c 850000 /dev/zero > {filler}")
    logger.wait_for("a full disk", lambda s: not s["recording"] and "disk full" in s["text"])
    logger.shell.run(f"rm {filler}")
    logger.wait_for("recording", lambda s: s["recording"])
    logger.wait_recording()
    code, error = logger.end()
    assert code == 0
    assert "nothing is recorded: disk full" in error


def test_a_disk_without_any_room_is_waited_for(start):
    """ENOSPC in the middle of a file."""
    logger = start(disk_bytes=300_000)
    logger.wait_recording()
    filler = logger.logs / "filler"
    logger.shell.run(f"head -c 1000000 /dev/zero > {filler} 2>/dev/null")
    wait(lambda: logger.bus.publish(2000) or logger.status().get("failures"), "trouble")
    logger.shell.run(f"rm {filler}")
    logger.wait_for("recording", lambda s: s["recording"])
    logger.wait_recording()


def test_waits_for_a_read_only_folder_to_become_writable(start):
    logger = start(disk_bytes=1_000_000, mount="ro")
    logger.wait_for("trouble", lambda s: "Read-only" in s["text"] and not s["recording"])
    logger.shell.run(f"mount -o remount,rw {logger.logs}")
    logger.wait_for("recording", lambda s: s["recording"])
    logger.wait_recording()


@pytest.mark.parametrize("how", ["rm {0}", "mv {0} {0}.away", "cp {0} {0}.2 && mv {0}.2 {0}"])
def test_a_file_that_is_taken_away_is_said_and_another_begun(start, how):
    logger = start(split_mb=10.0, quota_gb=0.04)
    logger.wait_recording()
    logger.wait_for("a status", lambda s: s["recording"])
    taken = logger.status()["text"]
    logger.shell.run(how.format(taken))
    logger.wait_for("another file", lambda s: s["files_lost"] == 1 and s["text"] != taken)
    logger.wait_recording()
    assert logger.status()["starts"] == 1
    code, error = logger.end()
    assert code == 0
    assert "was deleted, renamed or replaced while it was written" in error
    begun = Path(logger.status()["text"])
    assert {event.channel for event in lcm.EventLog(str(begun))} == {"OLS_TRUST", FLOOD}


def send_raw(datagrams):
    group, port = LIVE_URL.split("//")[1].split("?")[0].split(":")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        for datagram in datagrams:
            sender.sendto(datagram, (group, int(port)))


def test_forged_fragments_do_nothing_but_count(start):
    """The two datagrams that end every program with liblcm 1.3.1 on the bus."""
    logger = start()
    logger.wait_recording()
    send_raw([*fragments.pair("OLS_STATUS_x", 7), b"", b"LC02", b"LC02abcd\x1b[2J\0"])
    counted = lambda s: s["bus_fragments_refused"] == 2 and s["bus_datagrams_malformed"] == 3  # noqa: E731
    logger.wait_for("what was refused", counted)
    assert "2 fragments and 3 malformed datagrams refused" in logger.status()["bus_alarm"]
    logger.wait_recording()
    assert logger.status()["starts"] == 1


@pytest.fixture
def flight(tmp_path, network):
    log = tmp_path / "flight.lcmlog"
    program = [str(BIN / "ols-logger"), "--lcm-url", LIVE_URL, "--output", str(log)]
    with subprocess.Popen(program, stderr=subprocess.PIPE, text=True) as process:
        assert "ready" in process.stderr.readline()
        yield process, log, program
        process.kill()


def test_records_a_flight_into_one_file(flight):
    process, log, program = flight
    bus = Flood()
    for number in range(100):
        bus.publish(1, bytes([number]))
    # What was sent before the end was asked for may still be on its way.
    wait(lambda: log.exists() and len(messages(log, FLOOD)) >= 100, "100 messages")
    process.send_signal(signal.SIGTERM)
    assert process.wait(DEADLINE_S) == 0
    assert [data[16] for data in messages(log, FLOOD)] == list(range(100))
    again = finished(*program)
    assert again.returncode == 2
    assert str(log) in again.stderr
    assert len(messages(log, FLOOD)) == 100  # it is not overwritten


def messages(log, channel):
    return [event.data for event in lcm.EventLog(str(log)) if event.channel == channel]


def test_a_log_is_verified_after_a_later_revocation(flight, tmp_path):
    """Nobody tells the list on this bus: the log itself says which one was in force."""
    process, log, _ = flight
    bus = Flood()
    for number in range(20):
        bus.publish(1, bytes([number]))
    wait(lambda: log.exists() and len(messages(log, FLOOD)) >= 20, "20 messages")
    keys = Path(os.environ["OLS_KEYS"])
    wait(lambda: list(tmp_path.glob("trust-*.toml")), "the list beside the log")
    process.send_signal(signal.SIGTERM)
    assert process.wait(DEADLINE_S) == 0
    later = tmp_path / "later"
    shutil.copytree(keys, later)
    ols_key("revoke", "simulator", folder=later)
    shutil.copy(later / "trust.toml", tmp_path / "trust-999.toml")
    done = ols_key("verify", log, folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "20 good" in done.stdout
    damaged, content = tmp_path / "damaged.lcmlog", log.read_bytes()
    for kept, status, said in (
        (content[:-7], 1, "the end is cut off"),
        (b"noise" + content, 1, "5 bytes of the log are damaged, the first is byte 0"),
        (gzip.compress(content), 2, "is compressed (gzip)"),
        (b"nothing of the kind " * 9, 2, "is no LCM log: from byte 0"),
    ):
        damaged.write_bytes(kept)
        done = ols_key("verify", damaged, folder=tmp_path)
        assert done.returncode == status, said
        assert said in done.stdout + done.stderr


def ols_key(*words, folder):
    return finished(BIN / "ols-key", *words, cwd=folder)


def test_ends_though_messages_do_not(start):
    # Signatures off: what nobody has signed would end before it is written.
    logger = start(split_mb=1.0, quota_gb=0.02, max_unwritten_mb=50.0, signed=False)
    logger.wait_recording()
    flood = [str(BIN / "ols-sim-flood"), "--lcm-url", LIVE_URL, "--rate", "20000"]
    with subprocess.Popen(flood, stdout=subprocess.PIPE, text=True) as flooding:
        try:
            assert flooding.stdout.readline() == "ready\n"
            logger.wait_for("a flood", lambda s: s["files_removed"] > 0)
            code, _ = logger.end()
            assert code == 0
            assert flooding.poll() is None
        finally:
            flooding.terminate()


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--config", "/nonexistent.toml"], "/nonexistent.toml"),
        (["--lcm-url", "udpm://nowhere"], "--lcm-url"),
        (["--speed", "9"], "--speed"),
    ],
)
def test_bad_input_is_one_line_and_status_2(arguments, text):
    done = finished(BIN / "ols-logger", *arguments)
    assert done.returncode == 2
    assert done.stderr.startswith("ols-logger: ")
    assert text in done.stderr
    assert len(done.stderr.splitlines()) == 1
