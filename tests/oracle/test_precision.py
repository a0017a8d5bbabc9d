"""The precision theory against a second one in numpy: rays really turned and really intersected."""

import itertools

import numpy as np
import ols
import pytest
import reference
from ols_demo.places import geodetic

TRIALS = 40
SITE = ols.LocalFrame(ols.Geodetic(latitude_rad=0.86, longitude_rad=0.29, height_m=300.0))


def meet(first, angle_first, second, angle_second):
    """Where two lines of a plane meet; angles from the x axis."""
    u = np.array([np.cos(angle_first), np.sin(angle_first)])
    v = np.array([np.cos(angle_second), np.sin(angle_second)])
    along, _ = np.linalg.solve(np.column_stack([u, -v]), second - first)
    return first + along * u


def worst_of_many(first, second, target, angle, steps=9):
    """The greatest error over a grid of both cameras' errors."""
    a, b = (np.arctan2(*(target - camera)[::-1]) for camera in (first, second))
    turns = np.linspace(-angle, angle, steps)
    return max(
        np.linalg.norm(meet(first, a + s, second, b + t) - target)
        for s, t in itertools.product(turns, turns)
    )


def in_space(*points):
    return [np.array([*point, 0.0]) for point in points]


def test_pair_error_is_the_greatest_of_all_turned_rays(rng):
    for _ in range(TRIALS):
        first, second = rng.uniform(-50, 50, (2, 2))
        target = np.array([rng.uniform(-200, 200), rng.uniform(100, 600)])
        angle = 10 ** rng.uniform(-5, -3.3)
        base, to_target = second - first, target - (first + second) / 2
        crossing = abs(base[0] * to_target[1] - base[1] * to_target[0]) / (to_target @ to_target)
        if crossing < 10 * angle:
            continue
        found = ols.pair_error_m(*in_space(first, second, target), angle)
        np.testing.assert_allclose(found, worst_of_many(first, second, target, angle), rtol=1e-8)


def test_rotating_pair_is_one_ray_turned(rng):
    for _ in range(TRIALS):
        base, distance = rng.uniform(5, 100), rng.uniform(20, 1000)
        error = ols.PixelError(pixels=rng.uniform(0.1, 10))
        target, second = np.array([0.0, distance]), np.array([base, 0.0])
        seen = np.arctan2(distance, -base) - np.arctan(error.tangent())
        wrong = meet(np.zeros(2), np.pi / 2, second, seen)
        found = ols.rotating_pair_error_m(error, base, distance)
        np.testing.assert_allclose(found, wrong[1] - target[1], rtol=1e-8)


def numeric_information(station, p_ecef, sigmas, velocity):
    """H' R^-1 H by differences of the reference's own azimuth and elevation."""
    origin = reference.ecef(*station)
    east, north, up = reference.east_north_up(*station[:2])

    def direction(p):
        e, n, u = (axis @ (p - origin) for axis in (east, north, up))
        return np.array([np.arctan2(e, n), np.arctan2(u, np.hypot(e, n))])

    _, elevation = direction(p_ecef)
    scale = np.diag([np.cos(elevation), 1.0])
    steps = np.eye(3) * 1e-3 * np.linalg.norm(p_ecef - origin)
    H = np.column_stack(
        [
            scale @ (direction(p_ecef + s) - direction(p_ecef - s)) / (2 * np.linalg.norm(s))
            for s in steps
        ]
    )
    R = np.eye(2) * (sigmas["white"] ** 2 + sigmas["mount"] ** 2)
    R += np.diag([(sigmas["heading"] * np.cos(elevation)) ** 2, 0.0])
    R += sigmas["tilt"] ** 2 * np.diag([np.sin(elevation) ** 2, 1.0])
    R += sigmas["position"] ** 2 * H @ H.T
    R += sigmas["clock"] ** 2 * np.outer(H @ velocity, H @ velocity)
    return H.T @ np.linalg.inv(R) @ H


@pytest.mark.parametrize(("extent_m", "height_m"), [(500.0, 120.0), (80e3, 100e3)])
def test_position_precision(rng, extent_m, height_m):
    """From a drone over a field to a meteor at 100 km."""
    for _ in range(10):
        corner = 49.0, 16.0
        spread = extent_m / 111_000
        stations = [
            (*np.add(corner, rng.uniform(-spread, spread, 2)), rng.uniform(200, 400))
            for _ in range(4)
        ]
        p = reference.ecef(*np.add(corner, rng.uniform(-spread, spread, 2)), 300 + height_m)
        velocity = rng.normal(size=3) * 20
        sigmas = {
            name: 10 ** rng.uniform(-5, -3) for name in ("white", "mount", "heading", "tilt")
        } | {"position": rng.uniform(0, 0.1), "clock": rng.uniform(0, 0.02)}
        planned = [
            ols.PlannedStation(
                place=ols.LocalFrame(geodetic(lat, lon, h)),
                white_rad=sigmas["white"],
                calibration=ols.CalibrationSd(
                    heading_rad=sigmas["heading"],
                    tilt_rad=sigmas["tilt"],
                    mount_rad=sigmas["mount"],
                    position_m=sigmas["position"],
                ),
                clock_sd_s=sigmas["clock"],
            )
            for lat, lon, h in stations
        ]
        target = ols.PlannedTarget(p_ecef=p, velocity_moment_ecef=np.outer(velocity, velocity))
        found = ols.position_precision(planned, target)
        expected = np.linalg.inv(sum(numeric_information(s, p, sigmas, velocity) for s in stations))
        tolerance = 1e-5 * np.trace(expected)
        np.testing.assert_allclose(found.covariance_ecef, expected, atol=tolerance)
        parts = sum(found.parts_ecef.values())
        np.testing.assert_allclose(parts, expected, atol=tolerance)
        permuted = ols.position_precision(planned[::-1], target)
        np.testing.assert_allclose(permuted.covariance_ecef, found.covariance_ecef, rtol=1e-9)


def test_the_pole_is_a_place_like_others(rng):
    """Turned about the Earth's centre the bound of a site with isotropic errors turns with it."""

    def bound(R):
        planned = [
            ols.PlannedStation(
                place=ols.LocalFrame(ols.geodetic_from_ecef(R @ SITE.to_ecef(np.array(p)))),
                white_rad=1e-4,
            )
            for p in ((-300.0, 0.0, 0.0), (280.0, 40.0, 5.0), (10.0, 330.0, -4.0))
        ]
        p = R @ SITE.to_ecef(np.array([60.0, 90.0, 80.0]))
        return ols.position_precision(planned, ols.PlannedTarget(p_ecef=p)).covariance_ecef

    here = bound(np.eye(3))
    for _ in range(TRIALS):
        R, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        R *= np.sign(np.linalg.det(R))
        np.testing.assert_allclose(bound(R), R @ here @ R.T, atol=1e-8 * np.trace(here))


def test_utm_by_the_textbook_series():
    """Transverse Mercator by Krueger's series to the third order (Karney 2011, eq. 7 to 15)."""
    n = reference.FLATTENING / (2 - reference.FLATTENING)
    radius = reference.A_M / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    alpha = [n / 2 - 2 / 3 * n**2 + 5 / 16 * n**3, 13 / 48 * n**2 - 3 / 5 * n**3, 61 / 240 * n**3]
    e = np.sqrt(reference.E2)
    lat, lon = np.radians(49.2266), np.radians(16.5969 - 15.0)
    t = np.sinh(np.arctanh(np.sin(lat)) - e * np.arctanh(e * np.sin(lat)))
    xi, eta = np.arctan2(t, np.cos(lon)), np.arctanh(np.sin(lon) / np.hypot(1, t))
    northing = xi + sum(
        a * np.sin(2 * j * xi) * np.cosh(2 * j * eta) for j, a in enumerate(alpha, 1)
    )
    easting = eta + sum(
        a * np.cos(2 * j * xi) * np.sinh(2 * j * eta) for j, a in enumerate(alpha, 1)
    )
    place = ols.Geodetic(latitude_rad=lat, longitude_rad=np.radians(16.5969), height_m=0.0)
    found = ols.utm_from_geodetic(place)
    assert found.position.easting_m == pytest.approx(500e3 + 0.9996 * radius * easting, abs=1e-3)
    assert found.position.northing_m == pytest.approx(0.9996 * radius * northing, abs=1e-3)
