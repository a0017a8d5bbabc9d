"""Stationing against the reference: landmarks put where the reference's rays go."""

from dataclasses import replace

import numpy as np
import ols
import pytest
import reference
from stations import as_product, pan_tilt, random_angles_deg, random_pixel, random_station

TRIALS = 10


def sightings(rng, station, count):
    for _ in range(count):
        angles, pixel = random_angles_deg(rng), random_pixel(rng)
        centre, direction = reference.look(station, *angles, pixel)
        yield ols.LandmarkSighting(
            landmark_ecef=centre + rng.uniform(50, 5000) * direction,
            landmark_sd_m=0.1,
            pixel=pixel,
            pixel_sd_px=0.5,
            angles=pan_tilt(*angles),
        )


def test_the_heading_is_the_references(rng):
    for _ in range(TRIALS):
        station = random_station(rng)
        rough = replace(station, heading=rng.uniform(0, 360))
        seen = list(sightings(rng, station, 3))
        found = ols.station_by_landmarks(as_product(rough), seen, 0.2)
        off = np.degrees(found.station.chain.heading_rad) - station.heading
        assert abs((off + 180) % 360 - 180) < 1e-5
        assert max(np.abs(found.residuals).max(axis=1)) < 1e-2


def test_tilts_and_mounting_are_the_references(rng):
    """They start wrong by a degree; ten landmarks all around leave little of it."""
    names = ("tilt_x", "tilt_y", "mount_z", "mount_x", "mount_y")
    prior = ols.CalibrationSd(
        tilt_rad=np.radians(1), mount_rad=np.radians(1), mount_roll_rad=np.radians(1)
    )
    for _ in range(TRIALS):
        station = random_station(rng)
        wrong = {name: getattr(station, name) + rng.normal() for name in names}
        rough = replace(station, heading=rng.uniform(0, 360), **wrong)
        seen = list(sightings(rng, station, 10))
        found = ols.station_by_landmarks(as_product(rough, prior), seen, 0.2).station
        for sighting in sightings(rng, station, 5):
            line = ols.sight(found, ols.PixelSight(pixel=sighting.pixel, angles=sighting.angles))
            to_landmark = sighting.landmark_ecef - line.origin_ecef
            off = np.cross(ols.direction_ecef(line), to_landmark / np.linalg.norm(to_landmark))
            assert np.degrees(np.linalg.norm(off)) < 0.02


def test_a_bad_sighting_is_named(rng):
    station = random_station(rng)
    seen = list(sightings(rng, station, 3))
    seen[1].pixel_sd_px = np.nan
    with pytest.raises(ValueError, match="sighting 2"):
        ols.station_by_landmarks(as_product(station), seen, 0.2)
