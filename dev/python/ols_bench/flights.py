"""Simulated bearings of a site over many hours: two drones that fly past four stations, again and
again, some across the border of two hours. For the tests and the benchmark of the archive."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import ols
import ols_msg
from ols_demo.places import geodetic

START_US = 1_780_272_000_000_000  # 2026-06-01T00:00 UTC
HOUR_S = 3600.0
PIXEL_RAD, HEADING_RAD = 7.5e-5, 3e-4
PLACE_SD_M, CLOCK_SD_S = 0.02, 5e-4
BOOT = 100
SITE = geodetic(49.2266, 16.5969, 310.0)
FRAME = ols.LocalFrame(SITE)
STATIONS = {
    "alfa": (-300.0, -250.0, 2.0),
    "bravo": (320.0, -240.0, 4.0),
    "charlie": (310.0, 260.0, 0.0),
    "delta": (-290.0, 270.0, 3.0),
}


@dataclass(frozen=True)
class Flight:
    start_s: float  # since START_US
    seconds: float


def schedule(
    hours: int, seconds: float, random: np.random.Generator, crossing: int = 3
) -> list[Flight]:
    """One flight an hour, at any time; of so many one goes on into the next hour."""
    flights = []
    for hour in range(hours):
        across = hour % crossing == 0 and hour + 1 < hours
        offset_s = HOUR_S - seconds / 2 if across else random.uniform(60.0, HOUR_S - 2 * seconds)
        flights.append(Flight(hour * HOUR_S + offset_s, seconds))
    return flights


def place(drone: int, time_s: float) -> np.ndarray:
    """Metres east, north, up."""
    if drone == 0:
        return np.array([150.0 * math.sin(0.1 * time_s), 60.0 * math.cos(0.1 * time_s), 140.0])
    return np.array([-60.0 * math.cos(0.12 * time_s), 130.0 * math.sin(0.12 * time_s), 85.0])


def bearings(
    flights: list[Flight], rate_hz: float, random: np.random.Generator
) -> Iterator["ols_msg.bearing_t"]:
    """In order of time, as the stations send them."""
    headings = {name: HEADING_RAD * random.standard_normal() for name in STATIONS}
    sequences = dict.fromkeys(STATIONS, 0)
    for number, flight in enumerate(flights):
        for frame in range(round(flight.seconds * rate_hz)):
            for index, (name, position) in enumerate(STATIONS.items()):
                time_s = (frame + index / len(STATIONS)) / rate_hz
                for drone in (0, 1):
                    line = place(drone, time_s) - np.array(position)
                    message = bearing(name, line, headings[name], random)
                    message.utime = START_US + round(1e6 * (flight.start_s + time_s))
                    message.track_id = 1 + 2 * number + drone
                    sequences[name] += 1
                    message.sequence = sequences[name]
                    yield message


def bearing(
    name: str, line_enu: np.ndarray, heading_rad: float, random: np.random.Generator
) -> "ols_msg.bearing_t":
    message = ols_msg.bearing_t()
    message.schema_version = ols_msg.bearing_t.SCHEMA_VERSION
    message.station, message.boot_id, message.belief = name, BOOT, 0.9
    elevation = math.atan2(line_enu[2], math.hypot(line_enu[0], line_enu[1]))
    noise = PIXEL_RAD * random.standard_normal(2)
    azimuth = math.atan2(line_enu[0], line_enu[1]) + heading_rad + noise[0] / math.cos(elevation)
    message.azimuth_rad = azimuth % math.tau
    message.elevation_rad = elevation + noise[1]
    message.camera_ecef_m = list(CAMERAS[name])
    message.covariance_white_rad2 = [PIXEL_RAD**2, 0.0, PIXEL_RAD**2]
    message.covariance_systematic_rad2 = [HEADING_RAD**2, 0.0, (HEADING_RAD / 3) ** 2]
    message.camera_position_sd_m = [PLACE_SD_M] * 3
    message.clock_state = ols_msg.bearing_t.CLOCK_SYNCHRONISED
    message.clock_error_s = CLOCK_SD_S
    return message


CAMERAS = {name: FRAME.to_ecef(np.array(position)) for name, position in STATIONS.items()}
