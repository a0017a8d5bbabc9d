"""The stars of the product's own table, as a simulated camera sees them."""

from pathlib import Path

import erfa
import numpy as np

from .model import from_azimuth_elevation
from .site import PRESSURE_HPA, TEMPERATURE_DEGC, UT1_UTC_S, icrs_of

ROOT = Path(__file__).resolve().parents[3]
BLEND_PX = 2.0  # nearer stars are one spot in a picture


def table_stars():
    """Numbers, right ascensions and declinations [rad] of the product's table of stars."""
    rows = (ROOT / "calibration/star_table.inc").read_text().splitlines()
    stars = [row[1:].split(",")[:3] for row in rows if row.startswith("{")]
    table = np.array(stars, dtype=float)
    return table[:, 0].astype(int), *np.radians(table[:, 1:].T / 1e5)


def stars_around(table, place, axis, utime_us):
    """Numbers and apparent directions, east-north-up, of stars within some degrees of one."""
    numbers, ra, dec = table
    ra_there, dec_there = icrs_of(place, axis, utime_us)
    there = from_azimuth_elevation(ra_there, dec_there)
    near = from_azimuth_elevation(ra, dec).T @ there > np.cos(np.radians(4))
    azimuth, zenith, *_ = erfa.atco13(
        *(ra[near], dec[near], 0, 0, 0, 0, 2440587.5, utime_us / 86400e6, UT1_UTC_S),
        *(place.longitude, place.latitude, place.height, 0, 0),
        *(PRESSURE_HPA, TEMPERATURE_DEGC, 0.5, 0.55),
    )
    up = zenith < np.radians(79.5)
    return numbers[near][up], from_azimuth_elevation(azimuth[up], np.pi / 2 - zenith[up]).T


def spots(stars, images):
    """(names, pixel) of what these stars look like in a picture: of a close pair, one spot."""
    found = []
    for _, *pixel in stars:
        if any(np.hypot(*np.subtract(pixel, other)) < BLEND_PX for _, other in found):
            continue
        near = [n for n, *other in images if np.hypot(*np.subtract(pixel, other)) < BLEND_PX]
        found.append(({f"HIP {int(number)}" for number in near}, np.array(pixel)))
    return found
