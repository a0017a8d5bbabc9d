"""`ols-calibrate field` by what is in the sky of a simulated tripod: the sun, whose filter has to
be proved, and a drone with RTK whose positions come while it flies."""

import json
import time

import numpy as np
import ols
import ols_msg
import pytest
from ols_demo.places import geodetic
from ols_demo.site import Site
from tripod import SCENARIO, Tripod, found_values, head_and_camera, heading_of_picture_deg

SEED = 20261123
AIR = ("--ut1-utc", 0.03, "--pressure", 980, "--temperature", 10)  # as the simulator's
MOST_ARCSEC = 150.0  # of the picture's heading; one source alone, and a new unit
KEPT_DEG = 5.0  # of the 8 that the unit keeps away; the heading is known to a part of a degree


def sun_at(utc_s):
    """Declination and Greenwich hour angle [rad] to a hundredth of a degree (Astronomical Almanac,
    section C, low precision)."""
    days = utc_s / 86400.0 + 2440587.5 - 2451545.0
    mean = np.radians(280.460 + 0.9856474 * days)
    anomaly = np.radians(357.528 + 0.9856003 * days)
    longitude = mean + np.radians(1.915) * np.sin(anomaly) + np.radians(0.020) * np.sin(2 * anomaly)
    obliquity = np.radians(23.439 - 4e-7 * days)
    right_ascension = np.arctan2(np.cos(obliquity) * np.sin(longitude), np.cos(longitude))
    declination = np.arcsin(np.sin(obliquity) * np.sin(longitude))
    sidereal = np.radians(280.46062 + 360.98564737 * days)
    return declination, sidereal - right_ascension


def sun_enu(place, utc_s):
    """East, north, up; without refraction."""
    declination, hour_angle = sun_at(utc_s)
    hour_angle = hour_angle + place.longitude_rad
    latitude = place.latitude_rad
    return np.array(
        [
            -np.cos(declination) * np.sin(hour_angle),
            np.cos(latitude) * np.sin(declination)
            - np.sin(latitude) * np.cos(declination) * np.cos(hour_angle),
            np.sin(latitude) * np.sin(declination)
            + np.cos(latitude) * np.cos(declination) * np.cos(hour_angle),
        ]
    )


def sunny(path):
    """The scenario at a place where it is morning now and the sun stands 20 degrees high, 20
    degrees to the left of where the unit's zero looks."""
    latitude, elevation = np.radians([20.0, 20.0])
    now = time.time()
    declination, greenwich = sun_at(now)
    cosine = (np.sin(elevation) - np.sin(latitude) * np.sin(declination)) / (
        np.cos(latitude) * np.cos(declination)
    )
    longitude = np.angle(np.exp(1j * (-np.arccos(cosine) - greenwich)))
    east, north, _ = sun_enu(geodetic(20.0, np.degrees(longitude), 310.0), now)
    heading = np.degrees(np.arctan2(east, north)) + 20.0
    text = SCENARIO.read_text()
    for old, new in (
        ("latitude_deg = 49.2266", "latitude_deg = 20.0"),
        ("longitude_deg = 16.5969", f"longitude_deg = {np.degrees(longitude):.6f}"),
        ("heading_deg = 45.0", f"heading_deg = {heading:.6f}"),
        ("[landscape]\n", "[landscape]\nsun = true\n"),
    ):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path.write_text(text)
    return path


def off_arcsec(tripod):
    """The picture's heading, found less true."""
    found = heading_of_picture_deg(found_values(tripod.store / "current"))
    off_deg = found - heading_of_picture_deg(tripod.truth())
    return 3600 * ((off_deg + 180) % 360 - 180)


def sightings(tripod, kind):
    lines = (tripod.store / "current" / "observations.jsonl").read_text().splitlines()
    return sum(json.loads(line)["kind"] == kind for line in lines)


class FilterBearer:
    """Says first that the filter is on when it is not."""

    def __init__(self, tripod):
        self.tripod = tripod
        self.texts = []
        self.bare = [[0, 0]]  # when the lens was without a filter [us]

    def now_us(self):
        return time.time_ns() // 1000

    def react(self):
        state = self.tripod.state
        self.texts.append(state.text)
        if "filter_on" in state.choice:
            if len(self.texts) > 1:
                self.tripod.fault("sun-filter")
                self.bare[-1][1] = self.now_us()
            self.tripod.answer("filter_on")
        else:
            assert "filter_off" in state.choice, state.text
            self.tripod.fault("sun-filter", is_on=False)
            self.bare.append([self.now_us(), self.now_us() + 60_000_000])
            self.tripod.answer("filter_off")


@pytest.fixture(name="site", scope="module")
def fixture_site(network, tmp_path_factory):
    with Site(tmp_path_factory.mktemp("site") / "logs") as site:
        yield site


def nearest_deg(tripod, periods):
    """How near to the sun the camera has looked in these periods."""
    truth = tripod.truth()
    place = geodetic(truth["latitude_deg"], truth["longitude_deg"], truth["height_m"])
    nearest = 180.0
    for stamp, view in tripod.views.items():
        if not any(begin <= stamp <= end for begin, end in periods):
            continue
        _, camera = head_and_camera(truth, (view.pan_rad, view.tilt_rad))
        cosine = camera[:, 2] @ sun_enu(place, stamp * 1e-6)
        nearest = min(nearest, np.degrees(np.arccos(cosine)))
    return nearest


def test_the_sun_calibrates_once_its_filter_is_proved(site, tmp_path):
    tripod = Tripod(tmp_path, site, sunny(tmp_path / "sunny.toml"), timed=True)
    tripod.ready()
    bearer = FilterBearer(tripod)
    process = tripod.begin("field", "--sun", "--sweep-poses", 0, *AIR)
    status = tripod.operate(process, lambda _state: "accept", bearer.react)
    site.stop("ols-station-alfa")
    site.stop("ols-sim")
    assert status == 0, tripod.log.read_text()
    asked, again, off = bearer.texts
    assert "Put the sun filter on" in asked
    assert "is not black: no filter is on" in again
    assert "Take the sun filter off" in off
    assert sightings(tripod, "sun") >= 6
    print(f"heading of the picture off by {off_arcsec(tripod):+.1f} arcsec")
    assert abs(off_arcsec(tripod)) < MOST_ARCSEC
    assert nearest_deg(tripod, bearer.bare) > KEPT_DEG
    assert nearest_deg(tripod, [[0, 1 << 60]]) < 3.0, "with the filter it looked there"


class Pilot:
    """Lets a drone's receiver append to the references what RTK says, and points at the drone."""

    HEADER = "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us\n"
    EVERY_US = 200_000

    def __init__(self, tripod, path):
        self.tripod, self.path = tripod, path
        self.generator = np.random.default_rng(SEED)
        self.last_us = 0
        self.pointed = 0
        path.write_text(self.HEADER)
        tripod.listener.bus.lcm.subscribe("OLS_SIM_TRUTH", self._position)

    def _position(self, _channel, data):
        truth = ols_msg.truth_target_t.decode(data)
        if truth.utime < self.last_us + self.EVERY_US:
            return
        self.last_us = truth.utime
        told = np.array(truth.position_ecef_m) + self.generator.normal(0, 0.02, 3)
        place = ols.geodetic_from_ecef(told)
        with self.path.open("a") as file:
            file.write(
                f"drone,{np.degrees(place.latitude_rad):.10f},"
                f"{np.degrees(place.longitude_rad):.10f},{place.height_m:.4f},0.02,{truth.utime}\n"
            )

    def react(self):
        state = self.tripod.state
        if "sight" in state.choice:
            self.tripod.answer("sight")
            return
        [*_, frame] = self.tripod.frames("*.running")
        view = self.tripod.view_of(frame)
        assert view.visible, state.text
        self.pointed += 1
        crosshair, there = np.array(state.crosshair_px), np.array(view.centre_px)
        if state.has_crosshair and np.linalg.norm(crosshair - there) < 2.0:
            self.tripod.answer("confirm")
        else:
            self.tripod.answer("exactly" if state.has_crosshair else "point", there)


def test_a_drone_calibrates_whose_positions_come_while_it_flies(site, tmp_path):
    tripod = Tripod(tmp_path, site, timed=True)
    tripod.ready()
    path = tmp_path / "references.csv"
    pilot = Pilot(tripod, path)
    tripod.listener.wait(lambda: path.read_text().count("\n") > 3, "positions of the drone")
    options = ("--references", path, "--drone", "drone", "--drone-points", 14)
    process = tripod.begin("field", *options, "--sweep-poses", 0)
    status = tripod.operate(process, lambda _state: "accept", pilot.react)
    site.stop("ols-station-alfa")
    site.stop("ols-sim")
    assert status == 0, tripod.log.read_text()
    assert sightings(tripod, "drone") >= 14
    off = off_arcsec(tripod)
    print(f"heading of the picture off by {off:+.1f} arcsec; {pilot.pointed} answers")
    assert abs(off) < MOST_ARCSEC
    assert pilot.pointed < 10, "later it is found by itself"
