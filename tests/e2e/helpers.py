"""Talks to running processes as another member of the site's bus would."""

import re
import socket
import struct
import threading
import time
from pathlib import Path
from typing import Any

import ols_msg
from conftest import wait
from ols_demo.bus import LIVE_URL, Bus, counters
from ols_demo.keys import members_of_environment
from ols_demo.observer import Observer

DEADLINE_S = 60.0
STOP_LINE, REARM_LINE = 17, 18


def station_without_devices(name: str) -> str:
    """A configuration: no camera and no PTU answers."""
    return f"""\
id = "{name}"
[pose]
latitude_deg = 49.2
longitude_deg = 16.6
height_m = 250.0
heading_deg = 0.0
[calibration.sd]
heading_deg = 0.1
mount_deg = 0.1
[camera]
device = "127.0.0.99"
[ptu]
device = "/nonexistent/ptu"
[chain]
[lens]
fx_px = 13333.3
fy_px = 13333.3
"""


def at_frame_rate(scenario: Path, hz: float, folder: Path) -> Path:
    """The scenario with slower cameras, where no test judges motion: most of what a simulated
    station costs are its pictures."""
    text, count = re.subn(r"(?m)^frame_rate_hz = .*", f"frame_rate_hz = {hz}", scenario.read_text())
    assert count == 1, scenario
    path = folder / f"{scenario.stem}-at-{hz}-hz.toml"
    path.write_text(text)
    return path


class Babbler:
    """A server that answers every connection with what none says."""

    def __init__(self, rubbish: bytes):
        self._rubbish = rubbish
        self._kept: list[socket.socket] = []
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    @property
    def connections(self) -> int:
        return len(self._kept)

    def _serve(self) -> None:
        while True:
            connection = self._socket.accept()[0]
            self._kept.append(connection)
            try:
                connection.sendall(self._rubbish)
            except OSError:
                continue


class StopSwitch:
    """The server of a GPIO socket with an emergency stop and a re-arm button, as
    edge/gpio/gpio_lines.h has it."""

    def __init__(self, path: Any):
        self._server = socket.socket(socket.AF_UNIX)
        self._server.bind(str(path))
        self._server.listen()
        # The stop is normally closed to ground with a pull-up: pressed is high. The button closes
        # to ground: held is low.
        self._levels = {STOP_LINE: 0, REARM_LINE: 1}
        self._clients: list[socket.socket] = []
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self) -> None:
        while True:
            client, _ = self._server.accept()
            self._clients.append(client)
            for line in self._levels:
                self._tell(client, line)
            threading.Thread(target=self._answer, args=(client,), daemon=True).start()

    def _answer(self, client: socket.socket) -> None:
        try:
            for text in client.makefile():
                if text.startswith("read"):
                    self._tell(client, int(text.split()[1]))
        except ConnectionResetError:
            pass  # a station that was killed

    def _tell(self, client: socket.socket, line: int) -> None:
        try:
            client.sendall(f"in {line} {self._levels[line]}\n".encode())
        except OSError:
            if client in self._clients:
                self._clients.remove(client)  # a station that has ended

    def _set(self, line: int, level: int) -> None:
        self._levels[line] = level
        for client in list(self._clients):
            self._tell(client, line)

    def press(self, pressed: bool) -> None:
        self._set(STOP_LINE, int(pressed))


class Listener:
    """Collects what is on the bus; every wait has a deadline."""

    def __init__(self, url: str = LIVE_URL):
        self.observer = Observer()
        self.bus = Bus(url, self.observer.receive, members_of_environment())

    def wait(self, condition: Any, what: str, deadline_s: float = DEADLINE_S) -> None:
        wait(condition, what, deadline_s, lambda: self.bus.handle(0.02))

    def wait_for_status(self, station: str) -> Any:
        """A status that was sent after this call."""
        before = self.observer.status.get(station)
        self.wait(
            lambda: self.observer.status.get(station) not in (None, before), f"status of {station}"
        )
        return self.observer.status[station]

    def counter(self, station: str, name: str) -> float:
        status = self.observer.status.get(station)
        return counters(status).get(name, 0.0) if status else 0.0

    def wait_for_counter(self, station: str, name: str, value: float) -> None:
        self.wait(lambda: self.counter(station, name) >= value, f"{name} of {station} >= {value}")

    def device(self, station: str, name: str) -> tuple[int | None, str]:
        """State and text of a station's device, as its newest status has them."""
        status = self.observer.status.get(station)
        if status is None or name not in status.device_name:
            return None, ""
        at = list(status.device_name).index(name)
        return status.device_state[at], status.device_text[at]

    def publish(self, channel: str, data: bytes) -> None:
        self.bus.publish(channel, data)


class VideoViewer:
    """Asks a station for pictures, as docs/video.md has it."""

    def __init__(self, address):
        host, port = address.rsplit(":", 1)
        self._socket = socket.create_connection((host, int(port)), timeout=DEADLINE_S)

    def picture(self, after_utime=0, width=640, region=(0.0, 0.0, 0.0, 0.0)):
        request = ols_msg.video_request_t()
        request.schema_version = ols_msg.video_request_t.SCHEMA_VERSION
        request.after_utime, request.max_width_px, request.quality = after_utime, width, 70
        request.region_px = list(region)
        data = request.encode()
        self._socket.sendall(struct.pack(">I", len(data)) + data)
        (length,) = struct.unpack(">I", self._read(4))
        return ols_msg.video_frame_t.decode(self._read(length))

    def _read(self, count):
        data = b""
        while len(data) < count:
            more = self._socket.recv(count - len(data))
            assert more, "the station has closed the connection"
            data += more
        return data

    def close(self):
        self._socket.close()


def addressed(message: Any, station: str, sequence: int, boot_id: int = 77) -> Any:
    """Fills what every command has: fresh, valid, for this station."""
    message.utime = time.time_ns() // 1000
    message.schema_version = message.SCHEMA_VERSION
    message.boot_id = boot_id
    message.sequence = sequence
    message.station = station
    message.lease_s = 1.0
    return message


def point(station: str, sequence: int, pan_rad: float, tilt_rad: float = 0.0) -> Any:
    message = addressed(ols_msg.ptu_command_t(), station, sequence)
    message.command = ols_msg.ptu_command_t.COMMAND_POINT
    message.pan_rad, message.tilt_rad = pan_rad, tilt_rad
    return message


def slew(station: str, sequence: int, azimuth_rad: float, elevation_rad: float = 0.0) -> Any:
    message = addressed(ols_msg.slew_t(), station, sequence)
    message.effect_utime = message.utime + 50_000
    message.lease_s = 0.5
    message.azimuth_rad, message.elevation_rad = azimuth_rad, elevation_rad
    return message
