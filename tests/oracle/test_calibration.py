"""ols-calibrate against scipy, on the model that the simulator in dev/python has written anew."""

import csv
import json
import os
from pathlib import Path

import erfa
import numpy as np
import pytest
from conftest import finished
from ols_calibration import cases
from ols_calibration.model import (
    ANGLE_SD,
    NEW,
    PLAIN,
    Place,
    Unit,
    azimuth_elevation,
    from_azimuth_elevation,
    geodetic,
    refracted,
)
from ols_calibration.site import PRESSURE_HPA, TEMPERATURE_DEGC, UT1_UTC_S, UTIME_US, icrs_of
from scipy.optimize import least_squares

SEED = 20260119
LEAST_ARCSEC = 0.3  # a second of UT1 is 15
ROOT = Path(__file__).resolve().parents[2]
BIN = Path(os.environ.get("OLS_BIN", ROOT / "build/release/bin"))
NAMES = [*NEW, "heading", "tilt_x", "tilt_y", "east_m", "north_m", "up_m", "refraction_k"]
PLAIN_NAMES = {*PLAIN, "east_m", "north_m", "up_m", "refraction_k"}


def adjust(folder, *arguments):
    done = finished(BIN / "ols-calibrate", "adjust", *arguments, "--output", folder / "out")
    assert done.returncode in (0, 1), done.stderr  # 1: a finding is beyond its limit
    return json.loads((folder / "out/report.json").read_text())


def in_file(name, value):
    return value if name in PLAIN_NAMES else np.degrees(value)


class Problem:
    """Landmarks and an inclinometer's readings, as one least-squares problem without groups: all
    unknowns beside each other, every prior a residual."""

    def __init__(self, site):
        self.one = site.stations[0]
        self.lines = [line for line in self.one.lines if line["kind"] == "landmark"]
        self.level = next(line for line in self.one.lines if line["kind"] == "inclinometer")
        self.places, self.place_sds = {}, {}
        for row in site.references:
            name, latitude, longitude, height, sd = row.split(",")[:5]
            self.places[name] = Place(float(latitude), float(longitude), float(height)).origin
            self.place_sds[name] = float(sd)
        self.prior_mean = np.array([*self.one.known.values(), 0, 0, 0, 0, 0, 0, 0.13])
        sizes = [
            size if name in PLAIN else np.radians(size / 3600)
            for name, size in self.one.sizes.items()
        ]
        self.prior_sd = np.array(
            [*sizes, np.inf, *[np.radians(0.5)] * 2, *[site.position_sd] * 3, 0.3]
        )
        self.unknowns = len(NAMES) + 2 * len(self.lines) + 3 * len(self.places) + 2

    def residuals(self, x):
        values, rest = np.split(x, [len(NAMES)])
        poses, rest = np.split(rest, [2 * len(self.lines)])
        offsets, zero = np.split(rest, [3 * len(self.places)])
        offsets = dict(zip(self.places, offsets.reshape(-1, 3), strict=True))
        instrument = dict(zip(NAMES, values, strict=True))
        unit = Unit(instrument, instrument["heading"], (instrument["tilt_x"], instrument["tilt_y"]))
        unit.second_worm = 0.0
        place = self.one.place
        origin = place.to_ecef(values[-4:-1])
        moved = Place(*np.degrees(geodetic(origin)[:2]), geodetic(origin)[2])
        parts = [((values - self.prior_mean) / self.prior_sd), poses / ANGLE_SD]
        for line, pose in zip(self.lines, poses.reshape(-1, 2), strict=True):
            name = line["reference"]
            point = moved.to_enu(self.places[name] + offsets[name])
            approach = (line["approach_pan"], line["approach_tilt"])
            shafts = unit.shafts(line["pan_counts"], line["tilt_counts"], approach)
            pixel = unit.image(np.array(shafts) + pose, refracted(point, values[-1]))
            parts.append((pixel - [line["x_px"], line["y_px"]]) / line["sd_px"])
        parts += [offset / self.place_sds[name] for name, offset in offsets.items()]
        tilt = np.array([instrument["tilt_x"], instrument["tilt_y"]])
        read = np.radians([self.level["x_deg"], self.level["y_deg"]])
        parts.append((tilt + zero - read) / np.radians(self.level["sd_deg"]))
        parts.append(zero / np.radians(self.level["zero_sd_deg"]))
        return np.concatenate(parts)

    def solve(self):
        start = np.zeros(self.unknowns)
        start[: len(NAMES)] = self.prior_mean
        start[len(NEW)] = self.one.unit.heading
        sd = self.prior_sd.copy()
        sd[len(NEW)] = 1e-3
        scale = np.concatenate(
            [
                sd,
                np.full(2 * len(self.lines), ANGLE_SD),
                *[np.full(3, self.place_sds[name]) for name in self.places],
                np.full(2, 1e-4),
            ]
        )

        def residuals(z):
            return self.residuals(z * scale)

        def jacobian(z):
            # Steps of a hundredth of a deviation: scipy's own are so short that the rounding of
            # geocentric coordinates (1e-9 m) is a percent of the change.
            steps = 1e-2 * np.eye(self.unknowns)
            return np.array([residuals(z + step) - residuals(z - step) for step in steps]).T / 2e-2

        found = least_squares(
            residuals,
            start / scale,
            jac=jacobian,
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
        covariance = np.linalg.inv(found.jac.T @ found.jac) * np.outer(scale, scale)
        return found.x * scale, covariance


@pytest.mark.parametrize(
    "build",
    [
        cases.rtk_landmarks,
        pytest.param(cases.cadastral_landmarks, marks=pytest.mark.night),  # the same path
    ],
)
def test_estimate_and_covariance_are_scipys(tmp_path, build):
    print(f"seed {SEED}")
    site = build(np.random.default_rng(SEED))
    problem = Problem(site)
    x, covariance = problem.solve()
    arguments = site.write(tmp_path, "pan_counts,tilt_counts,x_px,y_px\n0,0,640,480\n")
    report = adjust(tmp_path, *arguments)
    scale = report["deviations_scaled_by"]
    found = {one["parameter"]: one for one in report["stations"][0]["parameters"]}
    for i, name in enumerate(NAMES):
        one = found[name if name in PLAIN_NAMES else name + "_deg"]
        sd = in_file(name, np.sqrt(covariance[i, i]))
        off = one["value"] - in_file(name, x[i])
        if name == "heading":
            off = (off + 180) % 360 - 180
        assert one["sd"] == pytest.approx(scale * sd, rel=1e-3), name
        assert abs(off) < 1e-2 * sd, name
    # The whole matrix: what matters is the error of directions, differences of huge numbers.
    rows = (tmp_path / "out/covariance.csv").read_text().splitlines()
    keys = [name if name in PLAIN_NAMES else name + "_deg" for name in NAMES]
    at = [rows[0].split(",").index(key) - 1 for key in keys]
    matrix = np.array([row.split(",")[1:] for row in rows[1:]], dtype=float)[np.ix_(at, at)]
    unit = np.array([1.0 if name in PLAIN_NAMES else np.degrees(1) for name in NAMES])
    expected = covariance[: len(NAMES), : len(NAMES)] * np.outer(unit, unit) * scale**2
    sds = np.sqrt(np.diag(expected))
    assert np.abs((matrix - expected) / np.outer(sds, sds)).max() < 2e-3


def sun_enu(place, utime_us, planet=None):
    """The sun's centre, or a planet's, as it appears: from the Earth's place and speed, the
    observer's own place, the light's time, the Earth's orientation, and the air."""
    tt = (2440587.5, utime_us / 86400e6 + (37 + 32.184) / 86400)
    ut1 = (2440587.5, utime_us / 86400e6 + UT1_UTC_S / 86400)
    heliocentric, barycentric = erfa.epv00(*tt)
    to_terrestrial = erfa.c2t06a(*tt, *ut1, 0.0, 0.0)
    au_m, light_au_day = 149597870700.0, 173.1446326742
    observer = to_terrestrial.T @ place.origin / au_m
    direction = -heliocentric["p"] - observer
    for _ in range(5 if planet else 0):
        earlier = (tt[0], tt[1] - np.linalg.norm(direction) / light_au_day)
        direction = erfa.plan94(*earlier, planet)["p"] - heliocentric["p"] - observer
    direction /= np.linalg.norm(direction)
    direction = direction + barycentric["v"] / light_au_day
    azimuth, elevation = azimuth_elevation(place.axes @ (to_terrestrial @ direction))
    a, b = erfa.refco(PRESSURE_HPA, TEMPERATURE_DEGC, 0.5, 0.55)
    lift = 0.0
    for _ in range(10):
        t = np.tan(np.pi / 2 - elevation - lift)
        lift = a * t + b * t**3
    return from_azimuth_elevation(azimuth, elevation + lift)


def perfect_station(seed):
    """A unit without any error, and its site."""
    site, one = cases.one_station(np.random.default_rng(seed), is_new=True)
    one.unit.values = one.known
    one.unit.wave = one.unit.second_worm = 0.0
    one.unit.tilt = (0.0, 0.0)
    one.lines.clear()
    return site, one


def worst_direction_arcsec(folder, site):
    """Of the directions found for the pixels that were sighted, from the simulated ones. Residuals
    alone would not show an error that turns the sky, such as a wrong sign of UT1."""
    one = site.stations[0]
    keys = ("pan_counts", "tilt_counts", "x_px", "y_px")
    rows = [",".join(str(line[key]) for key in keys) for line in one.lines]
    adjust(folder, *site.write(folder, "\n".join([",".join(keys), *rows]) + "\n"))
    worst = 0.0
    with (folder / "out/predictions.csv").open() as file:
        for line, row in zip(one.lines, csv.DictReader(file), strict=True):
            shafts = one.unit.shafts(line["pan_counts"], line["tilt_counts"])
            true = one.unit.look(shafts, (line["x_px"], line["y_px"]))
            found = np.radians([float(row["azimuth_deg"]), float(row["elevation_deg"])])
            off = np.cross(from_azimuth_elevation(*found), true)
            worst = max(worst, np.degrees(np.linalg.norm(off)) * 3600)
    return worst


def sky_line(one, kind, counts, pixel, utime_us, reference=None):
    return {
        **{"kind": kind, "station": one.name, "utime_us": utime_us, "sd_px": 0.01},
        **{"pan_counts": counts[0], "tilt_counts": counts[1], "reference": reference},
        **{"x_px": pixel[0], "y_px": pixel[1]},
    }


def test_the_sun_stands_where_the_earths_motion_has_it(tmp_path):
    site, one = perfect_station(SEED + 2)
    one.unit.heading = np.pi
    noon_us = 1_779_966_000_000_000
    for hour in np.linspace(-5, 4, 12):
        utime_us = noon_us + int(3.6e9 * hour)
        direction = sun_enu(one.place, utime_us)
        counts = one.unit.counts_to(direction)
        pixel = one.unit.image(one.unit.shafts(*counts), direction, at_infinity=True)
        one.lines.append(sky_line(one, "sun", counts, pixel, utime_us))
    site.refer("unused", one.place.to_ecef(np.array([0, 100.0, 0])), 1.0)
    assert worst_direction_arcsec(tmp_path, site) < LEAST_ARCSEC


@pytest.mark.parametrize(("name", "planet"), [("venus", 2), ("mars", 4), ("saturn", 6)])
def test_a_planet_stands_where_its_light_comes_from(tmp_path, name, planet):
    site, one = perfect_station(SEED + 3)
    one.unit.heading = np.pi
    for hour in np.linspace(0, 24, 60):
        utime_us = UTIME_US + int(3.6e9 * hour)
        direction = sun_enu(one.place, utime_us, planet)
        counts = one.unit.counts_to(direction)
        low, high = np.sin(np.radians([11, 70]))
        if not low < direction[2] < high or abs(counts[0]) > 49000:
            continue
        pixel = one.unit.image(one.unit.shafts(*counts), direction, at_infinity=True)
        one.lines.append(sky_line(one, "star", counts, pixel, utime_us, name))
    site.refer("unused", one.place.to_ecef(np.array([0, 100.0, 0])), 1.0)
    assert len(one.lines) > 5
    assert worst_direction_arcsec(tmp_path, site) < LEAST_ARCSEC


def test_stars_stand_where_erfas_own_inverse_has_them(tmp_path):
    """A unit without errors, sighted stars whose places ERFA's atoc13 has found."""
    site, one = perfect_station(SEED + 1)
    for k in range(24):
        direction = from_azimuth_elevation(one.rng.uniform(0, 2 * np.pi), np.radians(12 + k))
        counts = one.unit.counts_to(direction)
        if abs(counts[0]) > 49000:
            continue
        pixel = np.array([500.0, 300.0])
        utime_us = UTIME_US + 3_600_000_000 * k
        seen = one.unit.look(one.unit.shafts(*counts), pixel)
        site.refer_star(f"star{k}", *icrs_of(one.place, seen, utime_us))
        one.lines.append(sky_line(one, "star", counts, pixel, utime_us, f"star{k}"))
    assert worst_direction_arcsec(tmp_path, site) < LEAST_ARCSEC
