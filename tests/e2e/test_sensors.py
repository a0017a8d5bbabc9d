"""Inclinometer and GNSS receiver of real stations on their real wires: a simulated sensor on a pty,
a simulated receiver behind a real gpsd. Function only: deadlines are generous. What their faults
make of the pose is tested in simulated time (tests/unit/edge/process)."""

import re
import tomllib

import numpy as np
import ols_msg
import pytest
from conftest import BIN, SCENARIO
from helpers import Listener
from ols_demo.site import Site
from ols_demo.wiring import GPSD, Wiring

Status = ols_msg.station_status_t
STATION = "alfa"


class SensorSite(Listener):
    def __init__(self, site, wiring):
        super().__init__()
        self.site, self.wiring = site, wiring

    def device(self, name):
        status = self.observer.status.get(STATION)
        if status is None or name not in status.device_name:
            return None, ""
        at = list(status.device_name).index(name)
        return status.device_state[at], status.device_text[at]

    def alarms(self, pattern):
        status = self.observer.status.get(STATION)
        return [alarm for alarm in (status.alarm if status else []) if re.match(pattern, alarm)]

    def wait_until_well(self):
        def well():
            states = {self.device(name)[0] for name in ("gnss", "inclinometer")}
            return states == {Status.DEVICE_OK} and not self.alarms("gnss|inclinometer|pose")

        self.wait(well, "sensors well", 60.0)


def prepared(wiring):
    """One station, without its camera, that knows its pose from its sensors alone."""
    wiring.configs = {STATION: wiring.configs[STATION]}
    text = wiring.configs[STATION].read_text()
    text = re.sub(r'(\[camera\]\ndevice = )"[^"]*"', r'\1"127.0.0.99"', text)
    text = re.sub(r"(?m)^(latitude_deg|longitude_deg|height_m|tilt_._deg) = .*\n", "", text)
    wiring.configs[STATION].write_text(text)


@pytest.fixture(scope="module")
def sensors(network, tmp_path_factory):
    if GPSD is None:
        pytest.skip("gpsd is not installed")
    folder = tmp_path_factory.mktemp("sensors")
    wiring = Wiring(BIN, SCENARIO, 1, folder)
    wiring.prepare()
    prepared(wiring)
    with Site(folder / "logs") as site:
        wiring.start(site)
        running = SensorSite(site, wiring)
        running.wait_until_well()
        yield running


def test_both_report_through_the_status(sensors):
    status = sensors.wait_for_status(STATION)
    assert re.fullmatch(r"RTK fixed, 14 satellites, 0\.0\d\d m", sensors.device("gnss")[1])
    assert sensors.device("inclinometer")[1].startswith("DPG2 V1.4, x ")
    known = dict(zip(status.reading_name, status.reading_value, strict=True))
    assert known["gnss_satellites"] == 14
    assert 0.005 < known["gnss_sd_m"] < 0.05
    assert known["inclinometer_x_deg"] == pytest.approx(np.degrees(status.tilt_x_rad), abs=0.02)
    assert status.position_source == status.tilt_source == Status.POSE_SENSOR
    assert sensors.counter(STATION, "gnss_reports") > 0
    assert sensors.counter(STATION, "inclinometer_readings") > 0


def test_a_gpsd_that_dies_is_told_and_found_again(sensors):
    sensors.site.stop(f"gpsd-{STATION}")
    sensors.wait(lambda: sensors.alarms(r"gnss: .*gpsd"), "gpsd is missed", 60.0)
    assert sensors.device("gnss")[0] == Status.DEVICE_ABSENT
    port = tomllib.loads(sensors.wiring.configs[STATION].read_text())["gnss"]["port"]
    sensors.site.start(f"gpsd-{STATION}", sensors.wiring.gpsd_command(STATION, port))
    sensors.wait_until_well()
    assert sensors.counter(STATION, "gnss_reconnects") >= 1
