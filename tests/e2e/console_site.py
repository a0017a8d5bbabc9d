"""A site that exists only as messages, for tests of the console: stations that answer commands as
real ones do, a target, a fusion, pictures. And the console's page in a real browser."""

import contextlib
import io
import itertools
import json
import math
import re
import threading
import time
import types
import urllib.error
import urllib.request
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import lcm
import numpy as np
import ols
import ols_msg
from conftest import BIN, finished
from ols_demo.bus import LIVE_URL
from ols_demo.keys import members_of_environment
from ols_demo.places import geodetic
from PIL import Image
from playwright.sync_api import sync_playwright
from raised_alarms import Raised, put_alarms

CHROMIUM = "/usr/bin/chromium-headless-shell"
PLACES = {"alfa": (49.225, 16.594), "bravo": (49.225, 16.600), "charlie": (49.229, 16.597)}
TARGET = geodetic(49.2265, 16.597, 380.0)
FULL_PX = (1280, 960)
LOW_SUPPLY = ("ptu_supply_low", {"volts": "11.2"})
DEADLINE_S = 45.0
PERIOD_S = 0.5  # of everything that a paper site sends
PASSWORD = "correct horse"  # of ana
STATUS, PTU = ols_msg.station_status_t, ols_msg.ptu_command_t
COMMANDS = {
    PTU.COMMAND_POINT: "point",
    PTU.COMMAND_STOP: "stop",
    PTU.COMMAND_RELEASE: "release",
    PTU.COMMAND_REARM: "rearm",
    PTU.COMMAND_HOME: "home",
    PTU.COMMAND_REFERENCE_OK: "reference_ok",
    PTU.COMMAND_RATE: "rate",
    PTU.COMMAND_CENTRE: "centre",
}


def jpeg() -> bytes:
    """A grey picture with a dark object in its middle."""
    pixels = np.full((240, 320), 170, np.uint8)
    pixels[112:128, 148:172] = 40
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "JPEG", quality=80)
    return buffer.getvalue()


@dataclass
class PaperTarget:
    at: Callable[[float], Any] = lambda _time_s: TARGET
    state: int = ols_msg.target_t.TRACK_CONFIRMED
    covariance_m2: tuple[float, ...] = (4.0, 1.0, 0.0, 1.0, 0.0, 2.0)  # ee, en, eu, nn, nu, uu


class PaperSite(threading.Thread):
    """Sends until it is ended: less often than a real site, whose rates would be most of what the
    tests in a browser cost."""

    def __init__(self):
        super().__init__(daemon=True)
        self.lcm = lcm.LCM(LIVE_URL)
        self._signing = members_of_environment()
        self._sequences = itertools.count(1)
        self.counters = {name: {} for name in PLACES}
        self.begin_anew()
        self.refusing: dict[str, str] = {}  # station -> reason of its refusals
        self.alarms: dict[str, list[Raised]] = {}
        self.readings: dict[str, dict[str, float]] = {}
        self.devices: dict[str, dict[str, str]] = {}  # station -> more of them, with their texts
        self.silent: set[str] = set()
        self.deaf: set[str] = set()  # they hear no commands
        self.designations: list[ols_msg.designate_t] = []
        self.commands: list[tuple[str, str]] = []
        self.ptu_commands: list[ols_msg.ptu_command_t] = []
        self.lens_commands: list[ols_msg.lens_command_t] = []
        self.records: list[ols_msg.record_t] = []
        self.lenses: dict[str, list[float]] = {}  # overview station -> zoom, focus, iris
        self.targets = {7: PaperTarget()}
        self.lines: dict[str, tuple[float, float]] = {}  # station -> azimuth, elevation [rad]
        self.fusion_boot, self.fusion_alarms, self.is_fusion_silent = 9, [], False
        self.handover = "off"
        self.pictures: dict[int, str] = {}  # utime -> station
        self.utime_us = lambda: time.time_ns() // 1000
        self.borders: dict[str, list[list[tuple[float, float]]]] = {}  # keep-outs [rad]
        self._over = threading.Event()
        self._jpeg = jpeg()
        self.lcm.subscribe("OLS_DESIGNATE_.+", self._designated)
        self.lcm.subscribe("OLS_PTU_.+", self._commanded)
        self.lcm.subscribe("OLS_LENS_.+", self._lens_moved)
        self.lcm.subscribe("OLS_RECORD_.+", self._recorded)
        self.lcm.subscribe("OLS_CUE_ORDER", self._handed_over)

    def _publish(self, channel: str, message: Any) -> None:
        message.sequence = next(self._sequences)
        data = message.encode()
        self.lcm.publish(channel, self._signing.sign(channel, data) if self._signing else data)

    def _count(self, station: str, name: str) -> None:
        counters = self.counters[station]
        counters[name] = counters.get(name, 0) + 1

    def _judge(self, order: Any, name: str) -> bool:
        """Whether the station of this order carries it out; it counts that, and answers."""
        reason = self.refusing.get(order.station, "") if name != "stop" else ""
        if name == "rate" and self.states[order.station] == STATUS.STATE_STOPPED:
            reason = reason or "stopped"  # a joystick that is still held must not start the unit
        self._count(order.station, f"refused_{reason}" if reason else f"{name}_accepted")
        if not reason:
            self.states[order.station] = self._state_after(order.station, name)
        m = ols_msg.command_reply_t()
        m.utime, m.schema_version = self.utime_us(), m.SCHEMA_VERSION
        m.station, m.boot_id, m.state = order.station, 5, self.states[order.station]
        m.order_boot_id, m.order_sequence = order.boot_id, order.sequence
        m.accepted, m.reason = not reason, reason
        self._publish(f"OLS_REPLY_{order.station}", m)
        return not reason

    def _handed_over(self, _channel: str, data: bytes) -> None:
        order = ols_msg.cue_order_t.decode(data)
        self.handover = order.handover or self.handover
        m = ols_msg.command_reply_t()
        m.utime, m.schema_version, m.boot_id = self.utime_us(), m.SCHEMA_VERSION, self.fusion_boot
        m.order_boot_id, m.order_sequence, m.accepted = order.boot_id, order.sequence, True
        self._publish("OLS_CUE_REPLY", m)

    def _designated(self, _channel: str, data: bytes) -> None:
        message = ols_msg.designate_t.decode(data)
        self.designations.append(message)
        if self._judge(message, "designate"):
            self.track_ids[message.station] += 1

    def _commanded(self, _channel: str, data: bytes) -> None:
        message = PTU.decode(data)
        if message.station in self.deaf:
            return
        name = COMMANDS[message.command]
        self.commands.append((message.station, name))
        self.ptu_commands.append(message)
        self._judge(message, name)

    def _state_after(self, station: str, name: str) -> int:
        if name in ("rate", "centre", "point"):
            return STATUS.STATE_MANUAL
        if name == "designate":
            return STATUS.STATE_TRACKING
        if name in ("lens", "record"):
            return self.states[station]
        followed = STATUS.STATE_LOST if self.track_ids[station] else STATUS.STATE_IDLE
        return STATUS.STATE_STOPPED if name == "stop" else followed

    def begin_anew(self) -> None:
        """No station follows anything, or has."""
        self.states = dict.fromkeys(PLACES, STATUS.STATE_IDLE)
        self.track_ids = dict.fromkeys(PLACES, 0)

    def _lens_moved(self, _channel: str, data: bytes) -> None:
        message = ols_msg.lens_command_t.decode(data)
        self.lens_commands.append(message)
        if self._judge(message, "lens") and message.command == message.COMMAND_POSITION:
            wanted = (message.zoom, message.focus, message.iris)
            now = self.lenses[message.station]
            self.lenses[message.station] = [
                n if math.isnan(w) else w for n, w in zip(now, wanted, strict=True)
            ]

    def _recorded(self, _channel: str, data: bytes) -> None:
        self.records.append(ols_msg.record_t.decode(data))
        self._judge(self.records[-1], "record")

    def _send_status(self, station: str) -> None:
        m = STATUS()
        m.utime = self.utime_us()
        m.schema_version = m.SCHEMA_VERSION
        m.station, m.boot_id, m.state, m.belief = station, 5, self.states[station], 0.9
        m.track_id = self.track_ids[station]
        m.latitude_deg, m.longitude_deg = PLACES[station]
        m.height_m = 300.0
        at = geodetic(m.latitude_deg, m.longitude_deg, m.height_m)
        m.camera_ecef_m = list(ols.ecef_from_geodetic(at))
        m.pan_limits_rad, m.tilt_limits_rad = [-math.pi, math.pi], [-1.0, 1.5]
        m.calibration_sd_rad = math.nan
        if station == "alfa":
            m.calibration_state, m.calibration_id = m.CALIBRATION_IN_USE, 1 << 60
            m.calibration_utime, m.calibration_sd_rad = 1_780_000_000_000_000, 5e-5
        m.azimuth_rad, m.elevation_rad = 1.0, 0.2
        m.field_of_view_rad = [0.1, 0.08]
        if station in self.lenses:
            m.kind, m.lens_position = m.KIND_OVERVIEW, list(self.lenses[station])
            m.focal_length_px, m.focal_length_sd_px = 3000.0, 4.0
        m.image_width_px, m.image_height_px = FULL_PX
        devices = {"camera": "made of paper", "ptu": "", **self.devices.get(station, {})}
        m.devices, m.device_name, m.device_text = len(devices), list(devices), [*devices.values()]
        m.device_state, m.device_age_s = [m.DEVICE_OK] * len(devices), [0.1] * len(devices)
        put_alarms(m, self.alarms.get(station, []))
        readings = self.readings.get(station, {})
        m.readings, m.reading_name = len(readings), list(readings)
        m.reading_value = list(readings.values())
        outlines = self.borders.get(station, [])
        m.borders, m.border_kind = len(outlines), [m.BORDER_KEEP_OUT] * len(outlines)
        m.border_azimuth_rad = [azimuth for outline in outlines for azimuth, _ in outline]
        m.border_elevation_rad = [elevation for outline in outlines for _, elevation in outline]
        m.border_points = len(m.border_azimuth_rad)
        m.counter_name = list(self.counters[station])
        m.counter_value = [float(v) for v in self.counters[station].values()]
        m.counters = len(m.counter_name)
        self._publish(f"OLS_STATUS_{station}", m)

    def _send_picture(self, station: str) -> None:
        m = ols_msg.preview_t()
        m.utime = self.utime_us()
        self.pictures[m.utime] = station
        m.schema_version, m.station, m.boot_id = m.SCHEMA_VERSION, station, 5
        m.full_width_px, m.full_height_px = FULL_PX
        m.scale = 0.25
        m.jpeg_bytes, m.jpeg = len(self._jpeg), self._jpeg
        self._publish(f"OLS_PREVIEW_{station}", m)

    def _send_bearing(self, station: str) -> None:
        m = ols_msg.bearing_t()
        m.utime = self.utime_us()
        m.schema_version, m.station, m.boot_id, m.belief = m.SCHEMA_VERSION, station, 5, 0.9
        m.azimuth_rad, m.elevation_rad = 1.0, 0.2
        self._publish(f"OLS_BEARING_{station}", m)

    def _send_line(self, station: str) -> None:
        """Of a station whose object has no position."""
        m = ols_msg.target_t()
        m.utime = self.utime_us()
        m.schema_version, m.boot_id = m.SCHEMA_VERSION, self.fusion_boot
        m.solution = m.SOLUTION_BEARING_ONLY
        m.azimuth_rad, m.elevation_rad = self.lines[station]
        m.stations, m.station = 1, [station]
        m.used, m.weight, m.age_s = [True], [1.0], [0.0]
        self._publish("OLS_TARGET", m)

    def _send_target(self, target_id: int) -> None:
        target = self.targets[target_id]
        m = ols_msg.target_t()
        m.utime = self.utime_us()
        at = target.at(m.utime / 1e6)
        m.schema_version, m.boot_id, m.target_id = m.SCHEMA_VERSION, self.fusion_boot, target_id
        m.track_state, m.estimator = target.state, "filter"
        m.position_ecef_m = list(ols.ecef_from_geodetic(at))
        m.latitude_deg, m.longitude_deg = map(math.degrees, (at.latitude_rad, at.longitude_rad))
        m.height_m = at.height_m
        m.velocity_ecef_m_s = list(ols.R_ecef_enu(ols.ecef_from_geodetic(at)) @ [3.0, 4.0, 0.0])
        m.position_covariance_enu_m2 = target.covariance_m2
        m.stations, m.station = 2, ["alfa", "bravo"]
        m.used, m.weight, m.age_s = [True, True], [1.0, 1.0], [0.0, 0.0]
        self._publish("OLS_TARGET", m)

    def _send_fusion(self) -> None:
        m = ols_msg.fusion_status_t()
        m.utime = self.utime_us()
        m.schema_version, m.boot_id, m.last_error = m.SCHEMA_VERSION, self.fusion_boot, ""
        m.handover = self.handover
        put_alarms(m, self.fusion_alarms)
        m.station = ["alfa", "bravo"]
        m.stations = 2
        m.bearings, m.quarantine = [1, 1], ["", ""]
        for name in ("rate_hz", "age_s", "residual", "clock_offset_s"):
            setattr(m, name, [0.0, 0.0])
        m.clock_found_s = m.clock_found_sd_s = [math.nan, math.nan]
        m.bias_rad = m.bias_sd_rad = [[math.nan, math.nan]] * 2
        m.calibration_state = [STATUS.CALIBRATION_DOUBTED, STATUS.CALIBRATION_NONE]
        m.calibration_utime, m.calibration_sd_rad = [1_780_000_000_000_000, 0], [2e-4, math.nan]
        self._publish("OLS_FUSION_STATUS", m)

    def _send_all(self) -> None:
        for station in PLACES.keys() - self.silent:
            self._send_status(station)
            self._send_picture(station)
            if self.states[station] == STATUS.STATE_TRACKING:
                self._send_bearing(station)
        if self.is_fusion_silent:
            return
        for target_id in list(self.targets):
            self._send_target(target_id)
        for station in list(self.lines):
            self._send_line(station)
        self._send_fusion()

    @contextlib.contextmanager
    def another_target(self, target: PaperTarget):
        self.targets[8] = target
        try:
            yield
        finally:
            self.targets[8] = replace(target, state=ols_msg.target_t.TRACK_DROPPED)

    def write_log(self, path: Path, seconds: float) -> int:
        """Records itself instead of sending: in the middle an alarm and a stop. Its start [us]."""
        log, start_us = lcm.EventLog(str(path), "w", overwrite=True), 1_700_000_000_000_000
        now_us = start_us
        self.utime_us = lambda: now_us
        self.lcm = types.SimpleNamespace(publish=lambda c, data: log.write_event(now_us, c, data))
        for tick in range(round(5 * seconds)):
            now_us = start_us + 200_000 * tick
            middle = tick == round(2.5 * seconds)
            self.alarms["charlie"] = [LOW_SUPPLY] if middle else []
            if middle:
                m = PTU()
                m.schema_version, m.station, m.command = m.SCHEMA_VERSION, "alfa", PTU.COMMAND_STOP
                m.boot_id, m.sequence = 8, 1
                self.lcm.publish("OLS_PTU_alfa", m.encode())
                self._judge(m, "stop")
            self._send_all()
        log.close()
        return start_us

    def run(self) -> None:
        due = 0.0
        while not self._over.is_set():
            while self.lcm.handle_timeout(20) > 0:
                pass
            if time.monotonic() < due:
                continue
            due = time.monotonic() + PERIOD_S
            self._send_all()

    def end(self) -> None:
        self._over.set()
        self.join()


@contextlib.contextmanager
def paper_site():
    site = PaperSite()
    site.start()
    try:
        yield site
    finally:
        site.end()


def add_user(users: Path, name: str, password: str, role: str) -> None:
    command = [BIN / "ols-console", "--users", users, "--add-user", name, "--role", role]
    finished(*command, input=password + "\n", check=True)


def console_command(users: Path, *options: str) -> list[str]:
    command = [str(BIN / "ols-console"), "--lcm-url", LIVE_URL, "--users", str(users)]
    return [*command, *options]


def address_of(site, name: str) -> str:
    """Where the console that was started under this name serves."""
    return re.findall(r"ready: (\S+)", (site.logs / f"{name}.log").read_text())[-1]


class Api:
    """The console's HTTP interface as a program uses it."""

    def __init__(self, address: str):
        self.address = address.rstrip("/")

    def ask(self, path: str, body=None, method: str | None = None, headers=None):
        """(status, JSON or bytes, headers)."""
        data = (
            None
            if body is None
            else (body if isinstance(body, bytes) else json.dumps(body).encode())
        )
        sent = {"Content-Type": "application/json", **(headers or {})}
        request = urllib.request.Request(self.address + path, data, sent, method=method)
        direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with direct.open(request, timeout=DEADLINE_S) as answer:
                return answer.status, self._content(answer), answer.headers
        except urllib.error.HTTPError as refusal:
            return refusal.code, self._content(refusal), refusal.headers

    @staticmethod
    def _content(answer):
        content = answer.read()
        is_json = "json" in answer.headers["Content-Type"] and content[:1] in b"{["
        return json.loads(content) if is_json else content

    def state(self):
        return self.ask("/api/state")[1]


@contextlib.contextmanager
def browser():
    with sync_playwright() as playwright:
        # No GPU here, and CI is root in a container, where Chromium's own sandbox cannot be.
        started = playwright.chromium.launch(
            executable_path=CHROMIUM, headless=True, args=["--no-sandbox", "--disable-gpu"]
        )
        try:
            yield started
        finally:
            started.close()
