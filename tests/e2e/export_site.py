"""What the tests of ols-export have in common: a site on the bus, and the process."""

import itertools
import json
import shutil
import signal
import socket
import struct
import subprocess
from pathlib import Path

import lcm
import ols_msg
from conftest import BIN, made, wait
from ols_demo.bus import LIVE_URL
from ols_demo.keys import members_of_environment

DEADLINE_S = 60.0
HEIGHT_M = 100.0  # of the target above the ellipsoid
LATITUDE_DEG, LONGITUDE_DEG = 47.5, 13.25
COVARIANCE = [4.0, 1.0, 0.5, 9.0, -0.5, 25.0]
MOSQUITTO = shutil.which("mosquitto") or "/usr/sbin/mosquitto"
MQTT_PORT = 18830
CE_M, LE_M = 3.04, 5.0  # of that covariance, rounded up: major semi-axis, height


def geoid_m(latitude_deg, longitude_deg):
    """EGM96 from the grid itself, bilinear: not by the library that the product uses."""
    with open("/usr/share/proj/egm96_15.gtx", "rb") as grid:
        south, west, step_lat, step_lon, rows, columns = struct.unpack(">4d2i", grid.read(40))
        row, column = (latitude_deg - south) / step_lat, (longitude_deg - west) % 360 / step_lon
        i, j = int(row), int(column)
        assert 0 <= i < rows - 1

        def node(a, b):
            grid.seek(40 + 4 * (a * columns + b % columns))
            return struct.unpack(">f", grid.read(4))[0]

        u, v = row - i, column - j
        return (1 - u) * ((1 - v) * node(i, j) + v * node(i, j + 1)) + u * (
            (1 - v) * node(i + 1, j) + v * node(i + 1, j + 1)
        )


GEOID_M = geoid_m(LATITUDE_DEG, LONGITUDE_DEG)


def target(target_id=7, utime=None, **fields):
    message = made(ols_msg.target_t, boot_id=77, target_id=target_id)
    message.utime = utime or message.utime
    message.track_state = ols_msg.target_t.TRACK_CONFIRMED
    message.latitude_deg, message.longitude_deg = LATITUDE_DEG, LONGITUDE_DEG
    message.height_m = HEIGHT_M
    message.position_covariance_enu_m2 = COVARIANCE
    message.station, message.used = ["alfa", "bravo"], [True, True]
    message.weight = message.age_s = [1.0, 0.0]
    message.stations = 2
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def status(station="alfa", utime=None):
    message = made(ols_msg.station_status_t, station=station)
    message.utime = utime or message.utime
    message.state = ols_msg.station_status_t.STATE_TRACKING
    message.latitude_deg, message.longitude_deg, message.height_m = 47.4, 13.2, 600.0
    message.azimuth_rad, message.elevation_rad = 1.0, 0.1
    message.field_of_view_rad = [0.03, 0.02]
    return message


class Publisher:
    """A fusion and a station, as far as an exporter can tell."""

    def __init__(self):
        self._bus, self._signing = lcm.LCM(LIVE_URL), members_of_environment()
        self._sequences = itertools.count(1)

    def send(self, channel, message):
        """A message, or bytes that are none; signed by who may send there, if signatures are on."""
        if not isinstance(message, bytes):
            message.sequence = next(self._sequences)
            message = message.encode()
        self._bus.publish(
            channel, self._signing.sign(channel, message) if self._signing else message
        )

    def publish(self, *targets):
        for message in targets or (target(),):
            self.send("OLS_TARGET", message)
        self.send("OLS_STATUS_alfa", status())

    def until(self, condition, what, deadline_s=DEADLINE_S):
        """Goes on publishing."""

        def look():
            self.publish()
            return condition()

        return wait(look, what, deadline_s)


class Exporter:
    def __init__(self, folder: Path, outputs: str, head: str = ""):
        self.status_file = folder / "status.json"
        self.errors = folder / "errors.txt"
        self.config = folder / "export.toml"
        self.config.write_text(
            f'lcm_url = "{LIVE_URL}"\nsite = "brno"\nstatus_file = "{self.status_file}"\n'
            f"{head}\n{outputs}"
        )
        command = [str(BIN / "ols-export"), "--config", str(self.config)]
        with self.errors.open("w") as errors:
            self.process = subprocess.Popen(command, stderr=errors)
        wait(lambda: "ready" in self.said(), "ols-export is ready")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(DEADLINE_S) == 0, self.said()

    def said(self):
        return self.errors.read_text()

    def status(self):
        return json.loads(self.status_file.read_text()) if self.status_file.exists() else None

    def output(self, name):
        found = self.status()
        return found["outputs"][name] if found else {}


def output(name, kind, to, **keys):
    lines = [f'[[output]]\nname = "{name}"\nformat = "{kind}"\nto = "{to}"']
    lines += [f"{key} = {json.dumps(value)}" for key, value in keys.items()]
    return "\n".join(lines) + "\n"


def udp_receiver(address="127.0.0.1", group=None):
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind((group or address, 0))
    if group:
        member = socket.inet_aton(group) + socket.inet_aton(address)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    receiver.setblocking(False)
    return receiver, receiver.getsockname()[1]


def received(receiver, bytes_most=65536):
    """All that waits."""
    found = []
    while True:
        try:
            found.append(receiver.recv(bytes_most))
        except BlockingIOError:
            return found


class Broker:
    """mosquitto without a disk: it forgets what was retained when it dies."""

    def __init__(self, folder, users="allow_anonymous true\n"):
        self._config = folder / "mosquitto.conf"
        listener = f"listener {MQTT_PORT} 127.0.0.1"
        self._config.write_text(f"user root\n{listener}\npersistence false\n{users}")
        self.start()

    def start(self):
        command = [MOSQUITTO, "-c", str(self._config)]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self.process = subprocess.Popen(command, **quiet)

    def kill(self):
        self.process.kill()
        self.process.wait()
