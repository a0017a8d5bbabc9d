"""A real unit: what its camera shows where, with errors that the product's model does not have."""

from dataclasses import dataclass, field

import erfa
import numpy as np

ARCSEC = np.pi / 648000
TURN = 112000  # counts: 0.9 deg / 70 / 4
WIDTH, HEIGHT = 1280, 960
FOCAL_PX = 50e-3 / 3.75e-6
EARTH_RADIUS_M = 6371000.0

# 1-sigma of a unit of which nothing is known, and after a workshop's calibration and transport:
# arc seconds; focal: of fx; the rest as in the files. Nobody publishes a D46's.
NEW = {
    "focal_px": 0.003 * FOCAL_PX,
    "aspect": 1e-4,
    "cx_px": 20.0,
    "cy_px": 20.0,
    "k1": 0.05,
    "k2": 0.5,
    "mount_z": 360.0,
    "mount_x": 720.0,
    "mount_y": 360.0,
    "trunnion": 60.0,
    "pan_cos1": 40.0,
    "pan_sin1": 40.0,
    "pan_cos2": 40.0,
    "pan_sin2": 40.0,
    "pan_worm_cos": 10.0,
    "pan_worm_sin": 10.0,
    "pan_backlash": 20.0,
    "tilt_cos1": 40.0,
    "tilt_sin1": 40.0,
    "tilt_worm_cos": 10.0,
    "tilt_worm_sin": 10.0,
    "tilt_backlash": 20.0,
    "exposure_offset_s": 2e-3,
}
WORK = {
    **dict.fromkeys(NEW, 5.0),
    "focal_px": 1e-4 * FOCAL_PX,
    "aspect": 2e-5,
    "cx_px": 0.5,
    "cy_px": 0.5,
    "k1": 0.005,
    "k2": 0.05,
    "mount_z": 30.0,
    "mount_x": 30.0,
    "mount_y": 30.0,
    "trunnion": 4.0,
    "exposure_offset_s": 2e-4,
}
# The same where 5 arc seconds are the amplitude of each pair of coefficients, of each harmonic.
PAIRS = {
    **WORK,
    **{name: 5.0 / np.sqrt(2) for name in WORK if name.startswith(("pan_", "tilt_"))},
    **{"pan_backlash": 5.0, "tilt_backlash": 5.0},
}
# What a way to the field does to a unit that was calibrated: the camera on its plate, the axes.
TRANSPORT = {"mount_z": 30.0, "mount_x": 30.0, "mount_y": 30.0, "trunnion": 4.0}
PLAIN = ("focal_px", "aspect", "cx_px", "cy_px", "k1", "k2", "exposure_offset_s")
ANGLE_SD = 5.0 * ARCSEC  # of each angle of a pose: jitter and microstep waves together


def rx(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def ry(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def rz(a):
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def nominal():
    """The values of a unit without errors, angles in radians."""
    return {
        **dict.fromkeys(NEW, 0.0),
        "focal_px": FOCAL_PX,
        "aspect": 1.0,
        "cx_px": (WIDTH - 1) / 2,
        "cy_px": (HEIGHT - 1) / 2,
    }


def key_of(name):
    """The name in instrument.toml."""
    return name if name in PLAIN else name + "_deg"


def drawn(rng, sizes, around):
    """Values around some, each with its deviation."""
    unit = {name: 1.0 if name in PLAIN else ARCSEC for name in sizes}
    return {name: around[name] + rng.normal() * size * unit[name] for name, size in sizes.items()}


@dataclass
class Unit:
    """One station as it stands: its instrument's values, its setup, and what no model has."""

    values: dict
    heading: float = 0.0  # [rad]
    tilt: tuple = (0.0, 0.0)
    wave: float = 3.0 * ARCSEC  # of the microsteps: amplitude
    second_worm: float = 2.0 * ARCSEC  # amplitude of the worm's second harmonic
    phases: np.ndarray = field(default_factory=lambda: np.zeros(4))
    refraction: float = 0.13

    def shafts(self, pan, tilt, approach=(1, 1)):
        """Shaft angles at these counts, as they stay from pose to pose."""
        return (
            self._shaft("pan", pan, approach[0], self.phases[0]),
            self._shaft("tilt", tilt, approach[1], self.phases[1]),
        )

    def _shaft(self, axis, counts, approach, phase):
        v, t = self.values, 2 * np.pi * counts / TURN
        angle = t + v[axis + "_cos1"] * np.cos(t) + v[axis + "_sin1"] * np.sin(t)
        if axis == "pan":
            angle += v["pan_cos2"] * np.cos(2 * t) + v["pan_sin2"] * np.sin(2 * t)
        angle += v[axis + "_worm_cos"] * np.cos(70 * t) + v[axis + "_worm_sin"] * np.sin(70 * t)
        angle += self.second_worm * np.sin(140 * t + phase)
        return angle + 0.5 * v[axis + "_backlash"] * approach

    def posed(self, rng, pan, tilt, approach):
        """The same with what is new in every pose."""
        turns = 2 * np.pi * np.array([pan, tilt]) / 4
        wave = self.wave * np.sin(turns + self.phases[2:])
        noise = np.sqrt(ANGLE_SD**2 - self.wave**2 / 2)
        return np.array(self.shafts(pan, tilt, approach)) + wave + rng.normal(0, noise, 2)

    def stand(self):
        """Rotation of the tripod's head to east-north-up."""
        return rz(np.pi / 2 - self.heading) @ rx(self.tilt[0]) @ ry(self.tilt[1])

    def crossing(self):
        """Where its axes cross [m]: what another station sights."""
        return np.array([0, 0, 1.5]) + self.stand() @ [0, 0, 0.09]

    def camera(self, shafts):
        """Rotation from OpenCV's camera axes to east-north-up, and the camera's centre [m]."""
        v = self.values
        azi = self.stand() @ rz(shafts[0])
        ele = azi @ rx(v["trunnion"]) @ ry(-shafts[1])
        focus = ele @ rz(v["mount_z"]) @ rx(v["mount_x"]) @ ry(v["mount_y"])
        centre = self.crossing() + ele @ [0, 0, 0.06] + focus @ [0.05, 0, 0]
        axes = np.array([[0, 0, 1.0], [-1, 0, 0], [0, -1, 0]])
        return focus @ axes, centre

    def image(self, shafts, point, at_infinity=False):
        """The pixel of a point [m] or a direction, east-north-up; None behind the camera."""
        rotation, centre = self.camera(shafts)
        p = rotation.T @ (np.asarray(point) - (0 if at_infinity else centre))
        if p[2] <= 0:
            return None
        v, (x, y) = self.values, p[:2] / p[2]
        u = x * x + y * y
        radial = 1 + v["k1"] * u + v["k2"] * u * u
        return np.array(
            [
                v["cx_px"] + v["focal_px"] * x * radial,
                v["cy_px"] + v["focal_px"] * v["aspect"] * y * radial,
            ]
        )

    def look(self, shafts, pixel):
        """The direction of a pixel, east-north-up."""
        v = self.values
        target = np.array(
            [
                (pixel[0] - v["cx_px"]) / v["focal_px"],
                (pixel[1] - v["cy_px"]) / (v["focal_px"] * v["aspect"]),
            ]
        )
        xy = target.copy()
        for _ in range(20):
            u = xy @ xy
            xy = target / (1 + v["k1"] * u + v["k2"] * u * u)
        ray = self.camera(shafts)[0] @ np.array([*xy, 1.0])
        return ray / np.linalg.norm(ray)

    def counts_to(self, direction):
        """Counts that bring a direction roughly into the middle of the image."""
        east, north, up = direction
        azimuth = np.arctan2(east, north)
        pan = (self.heading - azimuth + np.pi) % (2 * np.pi) - np.pi
        tilt = np.arctan2(up, np.hypot(east, north))
        return np.round(np.array([pan, tilt]) / (2 * np.pi) * TURN)


def azimuth_elevation(direction):
    east, north, up = direction
    return np.arctan2(east, north) % (2 * np.pi), np.arctan2(up, np.hypot(east, north))


def from_azimuth_elevation(azimuth, elevation):
    return np.array(
        [
            np.sin(azimuth) * np.cos(elevation),
            np.cos(azimuth) * np.cos(elevation),
            np.sin(elevation),
        ]
    )


def refracted(point, k):
    """A point as the air lifts it: by k s / 2R, less where the air is thin at the target."""
    distance = np.linalg.norm(point)
    azimuth, elevation = azimuth_elevation(point)
    # The curvature falls off with the density; integrated along the ray by the midpoint rule.
    share = (np.arange(200) + 0.5) / 200
    bend = np.mean((1 - share) * np.exp(-share * point[2] / 8000.0))
    return distance * from_azimuth_elevation(
        azimuth, elevation + k * distance / EARTH_RADIUS_M * bend
    )


def geodetic(p):
    """[m] WGS84 -> latitude, longitude [rad], height [m]"""
    longitude, latitude, height = erfa.gc2gd(1, p)
    return latitude, longitude, height


class Place:
    """East-north-up at a geodetic position."""

    def __init__(self, latitude_deg, longitude_deg, height_m):
        self.latitude, self.longitude = np.radians([latitude_deg, longitude_deg])
        self.height = height_m
        self.origin = erfa.gd2gc(1, self.longitude, self.latitude, height_m)  # WGS84
        sp, cp = np.sin(self.latitude), np.cos(self.latitude)
        sl, cl = np.sin(self.longitude), np.cos(self.longitude)
        self.axes = np.array([[-sl, cl, 0], [-sp * cl, -sp * sl, cp], [cp * cl, cp * sl, sp]])

    def to_enu(self, p):
        return self.axes @ (p - self.origin)

    def to_ecef(self, p):
        return self.origin + self.axes.T @ p
