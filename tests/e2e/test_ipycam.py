"""A station steers ipycam, an ONVIF camera that others wrote, in a closed loop: ols-sim draws what
its camera sees at ipycam's angles."""

import json
import math
import re
import signal
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import ols_msg
import pytest
from conftest import BIN, ROOT, finished
from helpers import Listener, addressed, point
from ols_demo.bus import LIVE_URL
from ols_demo.evaluate import bearing_accuracy
from ols_demo.operator import Operator
from ols_demo.recording import Recording
from ols_demo.site import Site

pytestmark = pytest.mark.skipif(
    not (find_spec("ipycam") and find_spec("cv2")),
    reason="ipycam is not installed (CONTRIBUTING.md says how)",
)

USER, PASSWORD, PORT = "viewer", "ipycam's", 8080
PAN_DEG, TILT_DEG = -60.0, 40.0  # at position 1; at velocity 1, ipycam moves by 1 a second
NEAR_DEG = 0.3
FOLLOWED_S = 40.0
# 150 m before the station, to the left and right at up to 5 deg/s.
TARGET = """
[[target]]
span_m = 2.4
brightness = 0.22

[target.trajectory]
kind = "lissajous"
centre_enu_m = [-144.0, -144.0, 32.0]
amplitude_m = [42.4, 42.4, 2.0]
period_s = [29.0, 29.0, 17.0]
phase_deg = [0.0, 180.0, 0.0]
"""
MOUNT = f"""
[mount]
kind = "onvif"
url = "http://127.0.0.1:{PORT}/onvif/device_service"
user = "{USER}"
pan_gain_deg = {PAN_DEG}
pan_speed_deg_s = {PAN_DEG}
tilt_gain_deg = {TILT_DEG}
tilt_speed_deg_s = {TILT_DEG}
delay_s = 0.0
delay_sd_s = 0.01
position_sd_deg = 0.01
"""


def scenario_in(folder):
    """The ONVIF scenario's first station alone, on a mount of another program."""
    text = (ROOT / "sim/scenarios/onvif.toml").read_text()
    before, alfa, *_ = text.split("[[station]]")
    assert 'mount = "onvif"' in alfa
    path = folder / "ipycam.toml"
    external = alfa.replace('mount = "onvif"', 'mount = "external"')
    path.write_text(f"{before}[[station]]{external}{TARGET}")
    return path


def configure(folder):
    """The station's file, with ipycam as its mount."""
    config, password = folder / "config/alfa.toml", folder / "password"
    password.write_text(PASSWORD)
    text, count = re.subn(
        r"(?m)^\[mount\]$", f'{MOUNT}password_file = "{password}"\n', config.read_text()
    )
    assert count == 1
    config.write_text(text)
    return config


class Ptz:
    def __init__(self, running, config):
        self.running, self.config = running, config
        self.listener, self.truth = Listener(), []
        self.listener.bus.lcm.subscribe("OLS_SIM_PTU_alfa", self._hear)

    def _hear(self, _, data):
        message = ols_msg.truth_ptu_t.decode(data)
        step_us = 1e6 * message.interval_s
        self.truth += [
            (message.utime + i * step_us, math.degrees(pan), math.degrees(tilt))
            for i, (pan, tilt) in enumerate(zip(message.pan_rad, message.tilt_rad, strict=True))
        ]

    def start(self):
        self.running.start_and_wait(
            "alfa", [str(BIN / "ols-station"), "--config", str(self.config)], "ready"
        )
        self.listener.wait(self._knows_angles, "its angles")

    def _knows_angles(self):
        status = self.listener.observer.status.get("alfa")
        return status is not None and math.isfinite(status.pan_rad)

    def angles_deg(self):
        """True ones, of now."""
        self.truth.clear()
        self.listener.wait(lambda: self.truth, "the truth")
        return np.array(self.truth[-1][1:])

    def turned_deg(self, seconds):
        """By how much pan changes from now on."""
        self.truth.clear()
        enough = 1e6 * seconds
        self.listener.wait(
            lambda: self.truth and self.truth[-1][0] - self.truth[0][0] > enough, "the truth"
        )
        return self.truth[-1][1] - self.truth[0][1]


@pytest.fixture(scope="module")
def ptz(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("ipycam")
    command = [str(BIN / "ols-sim"), "--scenario", str(scenario_in(folder)), "--seed", "1"]
    command += ["--lcm-url", LIVE_URL, "--directory", str(folder / "lines")]
    write = ["--write-configs", str(folder / "config"), "--state-folder", str(folder / "state")]
    subprocess.run([*command, *write], check=True)
    config = configure(folder)
    camera = [sys.executable, str(Path(__file__).with_name("ipycam_camera.py"))]
    camera += ["alfa", str(PORT), USER, PASSWORD, str(PAN_DEG), str(TILT_DEG)]
    with Site(folder / "logs") as running:
        running.start_and_wait("ipycam", camera, "ready")
        running.start_and_wait("ols-sim", command, "ready")
        yield Ptz(running, config)
        running.check()


def test_the_doctor_tells_what_it_can_do(ptz):
    done = finished(BIN / "ols-doctor", "--json", "--config", ptz.config)
    told = [f["what"] for f in json.loads(done.stdout)["findings"]]
    assert any(
        re.match(r"ptu: ONVIF PythonCam .*: moves absolute relative continuous, zoom", what)
        for what in told
    ), told


def test_it_goes_where_the_station_orders(ptz):
    ptz.start()
    sent = []
    for goal in ([20.0, 5.0], [-35.0, 20.0]):

        def there(goal=goal):
            sent.append(point("alfa", len(sent) + 1, *np.radians(goal)))
            ptz.listener.publish("OLS_PTU_alfa", sent[-1].encode())
            return np.abs(ptz.angles_deg() - goal).max() < NEAR_DEG

        ptz.listener.wait(there, f"{goal}")
    ptz.running.stop("alfa")


def test_it_holds_a_target_with_bearings_as_good_as_stated(ptz):
    ptz.start()
    recording = Recording()
    ptz.listener.bus.lcm.subscribe("OLS_(BEARING|SIM_VIEW)_alfa|OLS_SIM_TRUTH", recorder(recording))
    person = Operator(ptz.listener.bus, ptz.listener.observer, seed=1)

    def locked():
        person.act({"alfa"})
        return len(recording.bearings.get("alfa", [])) > 20

    ptz.listener.wait(locked, "bearings of the target")
    first = recording.bearings["alfa"][-1]
    ends = first.utime + 1e6 * FOLLOWED_S
    ptz.listener.wait(lambda: recording.bearings["alfa"][-1].utime > ends, "that it follows")
    held = [b for b in recording.bearings["alfa"] if first.utime < b.utime < ends]
    seen = [v for v in recording.views["alfa"] if first.utime < v.stamp_utime < ends and v.visible]
    accuracy = bearing_accuracy(recording, held)
    print(len(held), "bearings of", len(seen), "pictures;", accuracy)
    assert {b.track_id for b in held} == {first.track_id}
    assert len(held) >= 0.95 * len(seen)
    for actual, stated in zip(accuracy["rms_deg"], accuracy["stated_deg"], strict=True):
        assert actual < 3.0 * stated, accuracy
    ptz.running.stop("alfa")


def recorder(recording):
    kinds = {"V": ols_msg.truth_view_t, "T": ols_msg.truth_target_t, "B": ols_msg.bearing_t}

    def hear(channel, data):
        kind = kinds[channel.removeprefix("OLS_").removeprefix("SIM_")[0]]
        recording.receive(channel, kind.decode(data), 0)

    return hear


def test_a_station_that_comes_back_stops_it_first(ptz):
    """ipycam takes no notice of a time-out: it turns until somebody stops it."""
    ptz.start()
    sent = []

    def turns():
        sent.append(turn(len(sent)))
        ptz.listener.publish("OLS_PTU_alfa", sent[-1].encode())
        return abs(ptz.turned_deg(0.2)) > 0.2 * 1.0

    ptz.listener.wait(turns, "that it turns")
    ptz.running.stop("alfa", signal.SIGKILL)
    assert abs(ptz.turned_deg(2.0)) > 2.0 * 1.0
    ptz.start()
    ptz.listener.wait(lambda: ptz.turned_deg(0.5) == 0.0, "that it is at rest")
    assert abs(ptz.angles_deg()[0]) < abs(PAN_DEG), "it was stopped before its end"
    ptz.running.stop("alfa")


def turn(sequence):
    message = addressed(ols_msg.ptu_command_t(), "alfa", 1000 + sequence)
    message.command, message.lease_s = message.COMMAND_RATE, 0.3
    message.pan_rate_rad_s = math.radians(2.0)
    return message
