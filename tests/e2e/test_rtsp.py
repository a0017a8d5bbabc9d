"""A station with an IP camera: its bearings' times, and a camera that vanishes and comes back."""

import json
import re
import subprocess

import ols_msg
import pytest
from conftest import BIN, ROOT, finished, wait
from helpers import Listener
from ols_demo.bus import LIVE_URL
from ols_demo.operator import Operator
from ols_demo.site import Site

SCENARIO = ROOT / "sim/scenarios/rtsp.toml"
TRUE_S = 0.005


@pytest.fixture(scope="module")
def site(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("rtsp")
    command = [str(BIN / "ols-sim"), "--scenario", str(SCENARIO), "--seed", "1"]
    command += ["--lcm-url", LIVE_URL, "--directory", str(folder / "lines")]
    write = ["--write-configs", str(folder / "config"), "--state-folder", str(folder / "state")]
    subprocess.run([*command, *write], check=True)
    with Site(folder / "logs") as running:
        running.start_and_wait("ols-sim", command, "ready")
        yield running, folder / "config" / "alfa.toml"


def test_the_doctor_tells_what_it_sends(site):
    """A busy machine may not show the first picture within the doctor's patience."""
    told = r"camera: RTSP H264, times by \w+.*, delay \d+ ms, Mono8 640x480"

    def tells():
        done = finished(BIN / "ols-doctor", "--json", "--config", site[1])
        return any(re.match(told, f["what"]) for f in json.loads(done.stdout)["findings"])

    wait(tells, "what the camera sends")


def test_bearings_have_the_true_time_and_come_again_after_the_camera_was_gone(site):
    running, config = site
    running.start_and_wait("alfa", [str(BIN / "ols-station"), "--config", str(config)], "ready")
    listener, bearings, exposures = Listener(), [], set()
    lcm = listener.bus.lcm
    lcm.subscribe("OLS_BEARING_alfa", lambda _, d: bearings.append(ols_msg.bearing_t.decode(d)))
    lcm.subscribe(
        "OLS_SIM_VIEW_alfa",
        lambda _, d: exposures.add(ols_msg.truth_view_t.decode(d).stamp_utime),
    )

    def by_reports(person):
        person.act({"alfa"})
        stamped = [b for b in bearings if b.stamp_source == ols_msg.bearing_t.STAMP_CAMERA]
        return len(stamped) > 10

    person = Operator(listener.bus, listener.observer, seed=1)
    listener.wait(lambda: by_reports(person), "bearings with times by sender reports")
    stamped = [b for b in bearings if b.stamp_source == ols_msg.bearing_t.STAMP_CAMERA]
    for bearing in stamped:
        error_s = min(abs(bearing.utime - true) for true in exposures) * 1e-6
        assert error_s < TRUE_S
        assert bearing.clock_error_s >= 0.02, "the report's own sigma is in it"
    status = listener.wait_for_status("alfa")
    assert status.kind == status.KIND_FIXED
    _, text = listener.device("alfa", "camera")
    assert text.startswith("RTSP H264, times by sender reports"), text

    fault = ols_msg.sim_fault_t()
    fault.station, fault.kind, fault.duration_s, fault.value = (
        "alfa",
        "camera-gone",
        4.0,
        float("nan"),
    )
    listener.publish("OLS_SIM_FAULT", fault.encode())
    listener.wait_for_counter("alfa", "camera_reconnects", 1)
    bearings.clear()
    person = Operator(listener.bus, listener.observer, seed=2)
    listener.wait(lambda: by_reports(person), "bearings after the camera came back")
    running.check()
