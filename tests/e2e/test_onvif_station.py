"""A station whose camera and mount are one simulated PTZ camera, by RTSP and ONVIF on the wire: it
measures its own position reports, locks a target, turns no more once it is gone, and notices what
it did not order."""

import math
import re
import signal
import subprocess
import tomllib
from datetime import timedelta

import numpy as np
import ols_msg
import pytest
from conftest import BIN, ROOT, finished
from helpers import Listener, addressed, at_frame_rate, point
from ols_demo.bus import LIVE_URL
from ols_demo.operator import Operator
from ols_demo.site import Site
from onvif import ONVIFCamera

SCENARIO = ROOT / "sim/scenarios/onvif.toml"
FRAMES_HZ = 8.0
LATE_S = 0.3
SCENERY_RAD, NEAR_RAD = math.radians(3.0), math.radians(0.3)
GAIN_DEG = 170.0  # of pan at -1 of the generic space
AT_REST_S = 2.5  # the lease, its delay, braking, and a busy simulator


class Ptz:
    def __init__(self, folder, running, config):
        self.folder, self.running, self.config = folder, running, config
        self.listener, self.truth = Listener(), []
        self.listener.bus.lcm.subscribe("OLS_SIM_PTU_alfa", self._hear)

    def _hear(self, _, data):
        message = ols_msg.truth_ptu_t.decode(data)
        step_us = 1e6 * message.interval_s
        self.truth += [(message.utime + i * step_us, pan) for i, pan in enumerate(message.pan_rad)]

    def start(self):
        self.running.start_and_wait(
            "alfa", [str(BIN / "ols-station"), "--config", str(self.config)], "ready"
        )
        self.listener.wait(self.knows_angles, "its angles")

    def look_at_scenery(self):
        sent = []

        def there():
            sent.append(point("alfa", len(sent) + 1, 0.0, SCENERY_RAD))
            self.listener.publish("OLS_PTU_alfa", sent[-1].encode())
            return abs(self.listener.observer.status["alfa"].tilt_rad - SCENERY_RAD) < NEAR_RAD

        self.listener.wait(there, "the scenery")

    def knows_angles(self):
        status = self.listener.observer.status.get("alfa")
        return status is not None and math.isfinite(status.pan_rad)

    def raises(self, alarm):
        return alarm in self.listener.observer.status["alfa"].alarm_id

    def wait_for_rest(self, seconds):
        self.truth.clear()

        def stands():
            since = self.truth[-1][0] - 1e6 * seconds if self.truth else 0.0
            pans = [pan for at, pan in self.truth if at > since]
            return bool(pans) and self.truth[0][0] < since and np.ptp(pans) == 0.0

        self.listener.wait(stands, "rest")

    def turn_as_another_client(self, velocity):
        password = (self.folder / "lines/alfa.password").read_text().strip()
        camera = ONVIFCamera("127.0.0.11", 8080, "admin", password)
        profile = camera.create_media_service().GetProfiles()[0].token
        camera.create_ptz_service().ContinuousMove(
            {
                "ProfileToken": profile,
                "Velocity": {"PanTilt": {"x": velocity, "y": 0}},
                "Timeout": timedelta(seconds=60),
            }
        )

    def fault(self, kind, duration_s, value=float("nan")):
        fault = ols_msg.sim_fault_t()
        fault.station, fault.kind, fault.duration_s, fault.value = "alfa", kind, duration_s, value
        self.listener.publish("OLS_SIM_FAULT", fault.encode())


@pytest.fixture(scope="module")
def ptz(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("ptz")
    scenario = at_frame_rate(SCENARIO, FRAMES_HZ, folder)
    before, alfa, *_ = scenario.read_text().split("[[station]]")
    target = scenario.read_text().split("[[target]]")[1]
    scenario.write_text(f"{before}[[station]]{alfa}[[target]]{target}")
    command = [str(BIN / "ols-sim"), "--scenario", str(scenario), "--seed", "1"]
    command += ["--lcm-url", LIVE_URL, "--directory", str(folder / "lines")]
    write = ["--write-configs", str(folder / "config"), "--state-folder", str(folder / "state")]
    subprocess.run([*command, *write], check=True)
    with Site(folder / "logs") as running:
        running.start_and_wait("ols-sim", command, "ready")
        yield Ptz(folder, running, folder / "config/alfa.toml")


@pytest.mark.night  # on a busy machine, pictures come with wrong times
def test_it_measures_what_its_position_reports_are_worth(ptz):
    text = ptz.config.read_text()
    wrong = re.sub(r"pan_gain_deg = .*", f"pan_gain_deg = {-1.05 * GAIN_DEG}", text)
    ptz.config.write_text(wrong)
    ptz.fault("ptz-late", 1e6, LATE_S)
    ptz.start()
    try:
        ptz.look_at_scenery()
        done = finished(BIN / "ols-calibrate", "mount", "--station", ptz.config, "--write")
        print(done.stdout, done.stderr)
        assert done.returncode == 0, done.stdout + done.stderr
        mount = tomllib.loads(ptz.config.read_text())["mount"]
        told = finished(BIN / "ols-doctor", "--config", ptz.config).stdout
        assert "mount: measured by ols-calibrate mount" in told, told
        assert "serial alfa: moves absolute" in told, told
    finally:
        ptz.running.stop("alfa")
        ptz.fault("all", 0.0)
        ptz.config.write_text(text)
    assert mount["pan_gain_deg"] == pytest.approx(-GAIN_DEG, rel=0.005)
    assert mount["tilt_gain_deg"] == pytest.approx(60.0, rel=0.005)
    assert mount["delay_s"] == pytest.approx(LATE_S, abs=0.02)


def test_it_locks_a_target_and_stops_when_it_is_killed(ptz):
    ptz.start()
    bearings = []
    ptz.listener.bus.lcm.subscribe(
        "OLS_BEARING_alfa", lambda _, data: bearings.append(ols_msg.bearing_t.decode(data))
    )
    person = Operator(ptz.listener.bus, ptz.listener.observer, seed=1)

    def locked():
        person.act({"alfa"})
        return len(bearings) > 20

    ptz.listener.wait(locked, "bearings of the target")
    truth = []

    def turns():
        ptz.listener.publish("OLS_PTU_alfa", turn(len(truth)).encode())
        truth.append(0)
        (first_us, first), (last_us, last) = ptz.truth[-20], ptz.truth[-1]
        return abs(last - first) > 1e-6 * (last_us - first_us) * math.radians(4.0)

    ptz.listener.wait(turns, "that it turns")
    ptz.running.stop("alfa", signal.SIGKILL)
    killed = ptz.truth[-1][0]
    ptz.listener.wait(lambda: ptz.truth[-1][0] > killed + 1e6 * (AT_REST_S + 1.0), "the truth")
    after = np.array([pan for at, pan in ptz.truth if at > killed + 1e6 * AT_REST_S])
    assert np.ptp(after) == 0.0


def test_a_motion_that_only_the_picture_shows_is_stopped_and_told(ptz):
    text = ptz.config.read_text()
    seeing = re.sub(r"(\[detector\]\n)enabled = false", r"\1enabled = true", text)
    assert seeing != text
    ptz.config.write_text(seeing)
    ptz.start()
    try:
        ptz.look_at_scenery()
        ptz.wait_for_rest(8.0)
        ptz.fault("ptz-frozen", 1e6)
        ptz.turn_as_another_client(-0.15)
        ptz.listener.wait(lambda: ptz.raises("ptu_picture_moves_unordered"), "the alarm")
        ptz.wait_for_rest(2.0)
        ptz.listener.wait(
            lambda: ptz.raises("ptu_positions_contradict_pictures"), "that its positions are wrong"
        )
    finally:
        ptz.fault("all", 0.0)
        ptz.running.stop("alfa")
        ptz.config.write_text(text)


def test_a_camera_that_starts_anew_is_told(ptz):
    ptz.start()
    try:
        ptz.look_at_scenery()
        ptz.wait_for_rest(8.0)
        ptz.fault("ptz-reboots", 1e6)
        ptz.listener.wait(lambda: ptz.raises("ptu_no_connection"), "its loss")
        ptz.listener.wait(lambda: ptz.raises("ptu_moved_unconnected"), "the alarm")
    finally:
        ptz.fault("all", 0.0)
        ptz.running.stop("alfa")


def turn(sequence):
    message = addressed(ols_msg.ptu_command_t(), "alfa", 1000 + sequence)
    message.command, message.lease_s = message.COMMAND_RATE, 0.3
    message.pan_rate_rad_s = math.radians(8.0)
    return message
