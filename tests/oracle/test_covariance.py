"""The covariances of sight() against sampled errors, sent through the reference."""

import numpy as np
import ols
import pytest
import reference
from stations import as_product, pan_tilt, random_angles_deg, random_pixel, random_station

SAMPLES = 4000
STATIONS = 5
# Standard deviation of a sampled variance is sqrt(2 / SAMPLES) of it: five of those.
TOLERANCE = 5 * np.sqrt(2 / SAMPLES)

COVARIANCE_PX2 = np.array([[2.0, 0.6], [0.6, 1.0]])
COVARIANCE_SYSTEMATIC_PX2 = np.array([[9.0, -2.0], [-2.0, 4.0]])
COVARIANCE_ANGLES_RAD2 = np.array([[4e-8, 1e-8], [1e-8, 1e-8]])
SD = {
    "heading_rad": 8e-4,
    "tilt_rad": 5e-4,
    "mount_rad": 6e-4,
    "mount_roll_rad": 3e-3,
    "position_m": 0.4,
}


@pytest.fixture(params=range(STATIONS))
def case(request, rng):
    rng = np.random.default_rng([rng.integers(2**31), request.param])
    return rng, random_station(rng), *random_angles_deg(rng), random_pixel(rng)


def product_line(station, pan, tilt, pixel):
    return ols.sight(
        as_product(station, ols.CalibrationSd(**SD)),
        ols.PixelSight(
            pixel=pixel,
            covariance_px2=COVARIANCE_PX2,
            covariance_systematic_px2=COVARIANCE_SYSTEMATIC_PX2,
            angles=pan_tilt(pan, tilt),
            angles_covariance_rad2=COVARIANCE_ANGLES_RAD2,
        ),
    )


def tangent_axes(origin_ecef, direction_ecef):
    """Rows: growing azimuth and growing elevation, in ECEF, without the product."""
    latitude, longitude, _ = reference.geodetic(origin_ecef)
    up = reference.east_north_up(latitude, longitude)[2]
    across = np.cross(direction_ecef, up)
    across /= np.linalg.norm(across)
    return np.array([across, np.cross(across, direction_ecef)])


def assert_consistent(stated, shifts):
    """The sampled covariance of shifts (n, 2) is the stated one, judged on its principal axes."""
    whitened = shifts @ np.linalg.inv(np.linalg.cholesky(stated)).T
    sampled = whitened.T @ whitened / len(whitened)
    np.testing.assert_allclose(sampled, np.eye(2), atol=TOLERANCE)


def test_white_covariance(case):
    rng, station, pan, tilt, pixel = case
    line = product_line(station, pan, tilt, pixel)
    origin, direction = reference.look(station, pan, tilt, pixel)
    axes = tangent_axes(origin, direction)
    pixels = rng.multivariate_normal(pixel, COVARIANCE_PX2, SAMPLES)
    angles = rng.multivariate_normal(
        [pan, tilt], COVARIANCE_ANGLES_RAD2 * np.degrees(1) ** 2, SAMPLES
    )
    shifts = [
        axes @ (reference.look(station, *a, p)[1] - direction)
        for a, p in zip(angles, pixels, strict=True)
    ]
    assert_consistent(line.covariance_white, np.array(shifts))


def systematic_sample(rng, station, pan, tilt, pixels):
    """Directions of one sampled calibration each: heading, tilts, mounting, designation."""
    degrees = {key: np.degrees(sd) for key, sd in SD.items() if key.endswith("_rad")}
    heading, tilt_x, tilt_y = station.heading, station.tilt_x, station.tilt_y
    for pixel in pixels:
        station.heading = heading + rng.normal(0, degrees["heading_rad"])
        station.tilt_x = tilt_x + rng.normal(0, degrees["tilt_rad"])
        station.tilt_y = tilt_y + rng.normal(0, degrees["tilt_rad"])
        across = rng.normal(0, degrees["mount_rad"], 2)
        roll = rng.normal(0, degrees["mount_roll_rad"])
        mount = (
            reference.rotation("z", across[0])
            @ reference.rotation("y", across[1])
            @ reference.rotation("x", roll)
        )
        yield reference.look(station, pan, tilt, pixel, mount)[1]


def test_systematic_covariance(case):
    rng, station, pan, tilt, pixel = case
    line = product_line(station, pan, tilt, pixel)
    origin, direction = reference.look(station, pan, tilt, pixel)
    axes = tangent_axes(origin, direction)
    pixels = rng.multivariate_normal(pixel, COVARIANCE_SYSTEMATIC_PX2, SAMPLES)
    shifts = [
        axes @ (sampled - direction)
        for sampled in systematic_sample(rng, station, pan, tilt, pixels)
    ]
    assert_consistent(line.covariance_systematic, np.array(shifts))


def test_position_uncertainty_is_that_of_the_station(case):
    _, station, pan, tilt, pixel = case
    line = product_line(station, pan, tilt, pixel)
    assert line.origin_sd_enu_m == pytest.approx([SD["position_m"]] * 3)
