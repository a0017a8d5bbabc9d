"""A station as a service and an instrument: the service manager, the emergency stop, a network that
comes and goes, a flood, a standstill. Function only: deadlines are generous."""

import os
import signal
import socket
import subprocess
import threading
import time
from pathlib import Path

import ols_msg
import pytest
from conftest import BIN, finished, wait
from helpers import DEADLINE_S, Listener, StopSwitch, addressed, point, station_without_devices
from ols_demo.site import Site

CONFIG = f"""\
state_folder = "{{folder}}"
{station_without_devices("tool")}
[gpio]
chip = "socket:{{folder}}/gpio"
led_line = 22
stop_line = 17
rearm_line = 18
[recorder]
folder = "{{folder}}/events"
"""
WATCHDOG_S = 1.0
DRAINED = b"DRAINED"
NOT_REARMED = "emergency stop: not rearmed yet: hold its re-arm button"


class Manager:
    """The service manager's socket. Always read: who tells a full one something, waits."""

    def __init__(self, path):
        self.path = str(path)
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(self.path)
        self.lines = []
        self._drained = threading.Event()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        while True:
            said = self._socket.recv(4096)
            if said == DRAINED:
                self.lines.clear()
                self._drained.set()
            else:
                self.lines += said.decode().splitlines()

    def drain(self):
        """Forgets all that was sent so far: datagrams come in the order in which they are sent."""
        self._drained.clear()
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
            sender.sendto(DRAINED, self.path)
        assert self._drained.wait(DEADLINE_S)

    def wait(self, line):
        wait(lambda: any(heard.startswith(line) for heard in list(self.lines)), line)


class Tool(Listener):
    def state(self):
        return self.observer.status["tool"].state

    def alarms(self):
        return list(self.observer.status["tool"].alarm)

    def wait_for_state(self, state):
        self.wait(lambda: self.state() == state, f"state {state}")

    def command(self, kind):
        message = addressed(ols_msg.ptu_command_t(), "tool", time.time_ns())
        message.command = kind
        self.publish("OLS_PTU_tool", message.encode())

    def pid(self):
        return self.site.processes["station"].pid


@pytest.fixture(scope="module")
def station(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("tool")
    config = folder / "tool.toml"
    config.write_text(CONFIG.format(folder=folder))
    listener = Tool()
    listener.switch = StopSwitch(folder / "gpio")
    listener.manager = Manager(folder / "notify")
    environment = {
        "NOTIFY_SOCKET": listener.manager.path,
        "WATCHDOG_USEC": str(int(WATCHDOG_S * 1e6)),
    }
    with Site(folder / "logs") as site:
        command = [str(BIN / "ols-station"), "--config", str(config)]
        listener.start = lambda: site.start_and_wait("station", command, "ready", environment)
        listener.start()
        listener.site, listener.config = site, config
        listener.wait_for_status("tool")
        # Its last state is unknown: it has just been set up.
        listener.wait_for_state(ols_msg.station_status_t.STATE_STOPPED)

        def released():  # again and again: on a busy machine an order may be stale when it is heard
            listener.command(ols_msg.ptu_command_t.COMMAND_RELEASE)
            return listener.state() == ols_msg.station_status_t.STATE_IDLE

        listener.wait(released, "the release")
        yield listener


def ctl(*arguments):
    return finished(BIN / "ols-ctl", *arguments)


def stop(pid):
    """Returns once all of it stands still."""
    os.kill(pid, signal.SIGSTOP)
    told = os.waitid(os.P_PID, pid, os.WSTOPPED)
    assert told.si_status == signal.SIGSTOP


def test_the_service_manager_is_told(station):
    station.manager.wait("READY=1")
    station.manager.wait("WATCHDOG=1")
    station.manager.wait("STATUS=idle; camera absent; ptu absent")


def test_a_hung_loop_starves_the_watchdog(station):
    stop(station.pid())
    try:
        station.manager.drain()
        time.sleep(2.0 * WATCHDOG_S)  # the fault itself
        assert station.manager.lines == []
    finally:
        os.kill(station.pid(), signal.SIGCONT)
    station.manager.wait("WATCHDOG=1")


def test_what_came_during_a_standstill_is_not_done(station):
    """Two seconds without processor: a command that has outlived its lease moves nothing."""
    station.wait_for_state(ols_msg.station_status_t.STATE_IDLE)
    before = station.counter("tool", "messages_refused_stale")
    stop(station.pid())
    try:
        station.publish("OLS_PTU_tool", point("tool", time.time_ns(), 0.3).encode())
        time.sleep(2.0)  # the fault itself: leases are a second and a margin
    finally:
        os.kill(station.pid(), signal.SIGCONT)
    station.wait_for_counter("tool", "messages_refused_stale", before + 1)
    assert station.state() == ols_msg.station_status_t.STATE_IDLE


def test_recording_is_asked_for(station):
    assert ctl("tool", "record", "1", "1", "flash").stdout == "tool: done\n"
    refused = ctl("tool", "record", "1", "1", "no/label")
    assert refused.returncode == 1
    assert "refused: the recorder does not record: the label must be" in refused.stdout


def test_the_full_status_is_readable(station):
    shown = ctl("tool", "status", "--full").stdout
    for part in ("clock ", "tilt ", "gpio", "recorder", "disk_free_bytes", "counters", "absent"):
        assert part in shown


def resident_kb(config):
    """Of the process with this configuration; /proc may be that of another process namespace."""
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if str(config).encode() in (process / "cmdline").read_bytes():
                lines = (process / "status").read_text().splitlines()
                return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS"))
        except OSError:
            continue  # it has ended meanwhile
    raise AssertionError(f"no process with {config}")


def test_a_flood_neither_fills_nor_stops_it(station):
    rubbish = point("tool", 1, 0.1).encode()[:-1]
    before_kb = resident_kb(station.config)
    unsigned = "bus_distrusted_unsigned"
    before = station.counter("tool", unsigned)
    accepted = station.counter("tool", "release_accepted")
    start = time.monotonic()
    sent = 0

    def is_over():
        """After three seconds, or when a release came through: on a busy machine many are stale."""
        went_s = time.monotonic() - start
        heard = station.counter("tool", "release_accepted") > accepted
        return went_s > 3.0 and (heard or went_s > DEADLINE_S)

    while not is_over():
        for _ in range(100):
            station.bus.lcm.publish("OLS_SLEW_tool", rubbish)
            station.bus.lcm.publish("OLS_PTU_other", rubbish)
        sent += 200
        time.sleep(max(0.0, start + sent / 10_000 - time.monotonic()))  # 10 000 a second
        if sent % 2000 == 0:
            station.command(ols_msg.ptu_command_t.COMMAND_RELEASE)
            station.bus.handle(0.0)
    station.wait_for_counter("tool", unsigned, before + 1000)
    assert station.counter("tool", "release_accepted") > accepted
    assert resident_kb(station.config) < before_kb + 50_000
    station.site.check()


def route(what):
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    subprocess.run(
        ["ip", "route", what, "224.0.0.0/4", "dev", "lo"],
        check=True,
        env={**os.environ, "PATH": path},
    )


def test_the_network_goes_and_comes(station):
    station.manager.drain()
    route("del")
    try:
        station.manager.wait("STATUS=no bus")
        station.manager.wait("WATCHDOG=1")
    finally:
        route("add")
    before = station.counter("tool", "bus_connects")
    station.wait_for_counter("tool", "bus_connects", before + 1)
    assert station.counter("tool", "messages_not_sent") > 0

    def stopped():  # it hears, too
        station.command(ols_msg.ptu_command_t.COMMAND_STOP)
        return station.state() == ols_msg.station_status_t.STATE_STOPPED

    station.wait(stopped, "the stop")


@pytest.mark.parametrize("program", ["ols-station", "ols-fusion"])
def test_it_starts_without_a_network(network, tmp_path, program):
    config = tmp_path / "c.toml"
    config.write_text(
        CONFIG.format(folder=tmp_path).replace("tool", "late") if program == "ols-station" else ""
    )
    manager = Manager(tmp_path / "notify")
    command = [str(BIN / program), "--config", str(config)]
    with Site(tmp_path / "logs") as site:
        route("del")
        try:
            environment = {"NOTIFY_SOCKET": manager.path, "WATCHDOG_USEC": "1000000"}
            said = "bus none" if program == "ols-station" else "no bus"
            site.start_and_wait("late", command, said, environment)
            manager.wait("READY=1")
            manager.wait("WATCHDOG=1")
            manager.wait("STATUS=no bus")
        finally:
            route("add")
        listener = Listener()
        heard = {
            "ols-station": lambda: "late" in listener.observer.status,
            "ols-fusion": lambda: listener.observer.fusion is not None,
        }
        listener.wait(heard[program], "its status, once there is a network")
        assert site.stop("late") == 0
        manager.wait("STOPPING=1")


def test_a_stop_outlives_a_station_that_is_killed(station):
    """What follows, and who re-arms it, EmergencyStop judges in simulated time."""
    status = ols_msg.station_status_t
    station.switch.press(True)
    station.wait_for_state(status.STATE_EMERGENCY)
    for order in (("manual", "1", "2"), ("rearm",), ("release",)):
        assert "emergency" in ctl("tool", *order).stdout
    station.switch.press(False)
    boot = station.observer.status["tool"].boot_id
    station.site.stop("station", signal.SIGKILL)
    station.start()
    station.wait(lambda: station.observer.status["tool"].boot_id != boot, "restarted")
    # A release counts when it has been stable for a moment, also at the start.
    station.wait(
        lambda: any(
            "stop released" in text for text in station.observer.status["tool"].device_text
        ),
        "released",
    )
    assert NOT_REARMED in station.alarms()
    os.kill(station.pid(), signal.SIGUSR1)
    station.wait_for_state(status.STATE_STOPPED)


def test_it_ends_in_order(station):
    assert station.site.stop("station") == 0
    station.manager.wait("STOPPING=1")
