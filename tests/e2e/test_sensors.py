"""Inclinometer and GNSS receiver of real stations on their real wires: a simulated sensor on a pty,
a simulated receiver behind a real gpsd, and their faults. Function only: deadlines are generous."""

import itertools
import math
import re
import time
import tomllib

import numpy as np
import ols_msg
import pytest
from conftest import BIN, SCENARIO
from helpers import Listener
from ols_demo.site import Site
from ols_demo.wiring import GPSD, Wiring

Status = ols_msg.station_status_t
SURVEYED, SENSING = "alfa", "bravo"  # the one has its survey, the other only what it measures
EARTH_M = 6.38e6


class SensorSite(Listener):
    """The running stations, and where they would be by the survey."""

    def __init__(self, site, wiring, surveys):
        super().__init__()
        self.site, self.wiring, self.surveys = site, wiring, surveys

    def fault(self, kind, station, duration_s=math.inf, value=math.nan):
        message = ols_msg.sim_fault_t()
        message.utime = time.time_ns() // 1000
        message.kind, message.station = kind, station
        message.duration_s, message.value = duration_s, value
        self.publish("OLS_SIM_FAULT", message.encode())

    def device(self, station, name):
        status = self.observer.status.get(station)
        if status is None or name not in status.device_name:
            return None
        at = list(status.device_name).index(name)
        return status.device_state[at], status.device_text[at]

    def is_ok(self, station, name):
        state = self.device(station, name)
        return state is not None and state[0] == Status.DEVICE_OK

    def alarms(self, station):
        status = self.observer.status.get(station)
        return list(status.alarm) if status else []

    def wait_for_alarm(self, station, pattern):
        self.wait(
            lambda: any(re.search(pattern, alarm) for alarm in self.alarms(station)),
            f"alarm {pattern!r} of {station}, not {self.alarms(station)}",
            60.0,
        )

    def wait_until_well(self, station):
        def well():
            of_sensors = [a for a in self.alarms(station) if re.match("gnss|inclinometer|pose", a)]
            return (
                self.is_ok(station, "gnss")
                and self.is_ok(station, "inclinometer")
                and not of_sensors
            )

        self.wait(well, f"sensors of {station} well", 60.0)

    def settled(self, station):
        self.fault("all", station, 0.0)
        self.wait_until_well(station)
        return self.wait_for_status(station)

    def has_grown(self, station, before, tilt):
        """Its position's sigma, and its tilt's."""
        now = self.observer.status[station]
        return now.position_sd_m[0] > before.position_sd_m[0] + 0.004 and (
            not tilt or now.tilt_sd_rad > before.tilt_sd_rad + 1e-6
        )

    def off_survey_m(self, status):
        survey = self.surveys[status.station]
        north_m = math.radians(status.latitude_deg - survey["latitude_deg"]) * EARTH_M
        east_m = math.radians(status.longitude_deg - survey["longitude_deg"]) * EARTH_M
        east_m *= math.cos(math.radians(survey["latitude_deg"]))
        return math.hypot(east_m, north_m, status.height_m - survey["height_m"])


def prepared(wiring):
    """Configurations without cameras, and of one station without its survey; the surveys."""
    surveys = {}
    for name, path in list(wiring.configs.items()):
        if name not in (SURVEYED, SENSING):
            del wiring.configs[name]
            continue
        text = path.read_text()
        surveys[name] = tomllib.loads(text)["pose"]
        text = re.sub(r'(\[camera\]\ndevice = )"[^"]*"', r'\1"127.0.0.99"', text)
        if name == SENSING:
            text = re.sub(r"(?m)^(latitude_deg|longitude_deg|height_m|tilt_._deg) = .*\n", "", text)
        path.write_text(text)
    return surveys


@pytest.fixture(scope="module")
def sensors(network, tmp_path_factory):
    if GPSD is None:
        pytest.skip("gpsd is not installed")
    folder = tmp_path_factory.mktemp("sensors")
    wiring = Wiring(BIN, SCENARIO, 1, folder)
    wiring.prepare()
    surveys = prepared(wiring)
    with Site(folder / "logs") as site:
        wiring.start(site)
        running = SensorSite(site, wiring, surveys)
        running.wait_until_well(SURVEYED)
        running.wait_until_well(SENSING)
        yield running


def readings(status):
    return dict(zip(status.reading_name, status.reading_value, strict=True))


def test_both_report_through_the_status(sensors):
    status = sensors.settled(SENSING)
    assert re.fullmatch(r"RTK fixed, 14 satellites, 0\.0\d\d m", sensors.device(SENSING, "gnss")[1])
    assert sensors.device(SENSING, "inclinometer")[1].startswith("DPG2 V1.4, x ")
    known = readings(status)
    assert known["gnss_satellites"] == 14
    assert 0.005 < known["gnss_sd_m"] < 0.05
    tilt_deg = sensors.surveys[SENSING]["tilt_x_deg"]
    assert known["inclinometer_x_deg"] == pytest.approx(tilt_deg, abs=0.1)
    assert sensors.counter(SENSING, "gnss_reports") > 0
    assert sensors.counter(SENSING, "inclinometer_readings") > 0


def test_the_pose_is_what_the_sensors_measure_where_there_is_no_survey(sensors):
    status = sensors.settled(SENSING)
    assert status.position_source == Status.POSE_SENSOR
    assert status.tilt_source == Status.POSE_SENSOR
    assert sensors.off_survey_m(status) < 0.2
    survey = sensors.surveys[SENSING]
    assert np.degrees(status.tilt_x_rad) == pytest.approx(survey["tilt_x_deg"], abs=0.08)
    assert np.degrees(status.tilt_y_rad) == pytest.approx(survey["tilt_y_deg"], abs=0.08)
    assert 0.005 < status.position_sd_m[0] < 0.05


def test_the_survey_overrides(sensors):
    status = sensors.settled(SURVEYED)
    assert status.position_source == Status.POSE_SURVEYED
    assert status.latitude_deg == pytest.approx(
        sensors.surveys[SURVEYED]["latitude_deg"], abs=1e-12
    )


POSITION_KEPT = r"^gnss: {} for .*position kept"
TILT_KEPT = r"^inclinometer: {} for .*tilt kept"


@pytest.mark.parametrize(
    "faults",
    [
        {
            "gnss-no-fix": POSITION_KEPT.format("no fix"),
            "inclinometer-stuck": TILT_KEPT.format("stuck"),
        },
        {
            "gnss-silent": POSITION_KEPT.format("silent"),
            "inclinometer-silent": TILT_KEPT.format("silent"),
        },
        {"gnss-jump": r"^gnss: (99|100|101) m from the (survey|kept position)"},
    ],
    ids=" ".join,
)
def test_faults_leave_position_and_tilt_and_their_sigmas_grow(sensors, faults):
    """Of both sensors and of both stations at once: they know nothing of each other."""
    before = {station: sensors.settled(station) for station in (SURVEYED, SENSING)}
    for kind in faults:
        sensors.fault(kind, "", value=100.0 if kind == "gnss-jump" else math.nan)
    for station, alarm in itertools.product(before, faults.values()):
        sensors.wait_for_alarm(station, alarm)
    for station, status in before.items():
        sensors.wait(
            lambda now=station, was=status: sensors.has_grown(now, was, len(faults) > 1),
            f"growth of the sigmas of {station}",
        )
        during = sensors.observer.status[station]
        assert during.position_source == status.position_source
        assert abs(sensors.off_survey_m(during) - sensors.off_survey_m(status)) < 0.01
        assert during.tilt_x_rad == pytest.approx(status.tilt_x_rad, abs=1e-4)
    sensors.fault("all", "", 0.0)
    for station, status in before.items():
        after = sensors.settled(station)
        assert after.position_sd_m[0] == pytest.approx(status.position_sd_m[0], abs=0.005)


def test_garbled_lines_are_counted_and_nothing_else_happens(sensors):
    before = sensors.settled(SENSING)
    sensors.fault("inclinometer-garbled", SENSING, value=0.2)
    sensors.fault("gnss-garbled", SENSING, value=0.2)
    garbled = sensors.counter(SENSING, "inclinometer_garbled")
    sensors.wait_for_counter(SENSING, "inclinometer_garbled", garbled + 5)
    status = sensors.wait_for_status(SENSING)
    assert sensors.off_survey_m(status) == pytest.approx(sensors.off_survey_m(before), abs=0.05)
    sensors.settled(SENSING)


def test_a_gpsd_that_dies_is_told_and_found_again(sensors):
    sensors.settled(SURVEYED)
    sensors.site.stop(f"gpsd-{SURVEYED}")
    sensors.wait_for_alarm(SURVEYED, r"^gnss: .*gpsd")
    assert sensors.device(SURVEYED, "gnss")[0] == Status.DEVICE_ABSENT
    port = tomllib.loads(sensors.wiring.configs[SURVEYED].read_text())["gnss"]["port"]
    sensors.site.start(f"gpsd-{SURVEYED}", sensors.wiring.gpsd_command(SURVEYED, port))
    sensors.wait_until_well(SURVEYED)
    assert sensors.counter(SURVEYED, "gnss_reconnects") >= 1
