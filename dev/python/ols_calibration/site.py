"""A simulated site: units, what they observe, and the files that ols-calibrate reads."""

import json
from dataclasses import dataclass, field

import erfa
import numpy as np

from .model import (
    ANGLE_SD,
    ARCSEC,
    NEW,
    PLAIN,
    WORK,
    Place,
    Unit,
    azimuth_elevation,
    drawn,
    from_azimuth_elevation,
    geodetic,
    key_of,
    nominal,
    refracted,
)

UTIME_US = 1_780_000_000_000_000
PRESSURE_HPA, TEMPERATURE_DEGC, UT1_UTC_S = 976.0, 12.0, 0.0312
LEVEL_SD_DEG = 0.5

STATION = """\
id = "{name}"
[pose]
latitude_deg = {latitude:.10f}
longitude_deg = {longitude:.10f}
height_m = {height:.4f}
heading_deg = {heading:.3f}
level_sd_deg = {level}
[calibration.sd]
heading_deg = 1.0
mount_deg = 0.1
position_m = {position_sd}
[camera]
device = "127.0.0.99"
[mount]
device = "/dev/null"
[lens]
fx_px = 13333.333333
fy_px = 13333.333333
"""


@dataclass
class Station:
    name: str
    unit: Unit
    place: Place
    sizes: dict  # of what is not known of its instrument
    known: dict  # values that the workshop has found; the truth is around them
    rng: np.random.Generator
    lines: list = field(default_factory=list)
    poses: int = 0
    angles: dict = field(default_factory=dict)  # that its rectification targets should tell
    # Of stars that are written without a name, by line, the names that are right; None: of a false
    # detection.
    true_names: list = field(default_factory=list)
    workshop: "Site | None" = None  # whose calibration is what is known of its instrument

    def sight_moving(self, kind, point, reference, counts_s):
        """Sights a point [m] while pan moves; the exposure is later than its counts."""
        counts = self.unit.counts_to(point) + self.rng.integers(-200, 200, 2)
        moved = counts + np.array([counts_s * self.unit.values["exposure_offset_s"], 0])
        approach = (int(np.sign(counts_s)), self.rng.choice([-1, 1]))
        pixel = self.unit.image(self.unit.posed(self.rng, *moved, approach), point)
        self.poses += 1
        self.add(kind, counts, approach, pixel, reference=reference, pan_counts_s=float(counts_s))

    def observe(self, kind, counts, seen, **more):
        """Appends a sighting; `seen(shafts)` gives the pixel, or None if it is not in the image."""
        approach = self.rng.choice([-1, 1], 2)
        shafts = self.unit.posed(self.rng, *counts, approach)
        self.poses += 1
        return self.add(kind, counts, approach, seen(shafts), **more)

    def add(self, kind, counts, approach, pixel, sd_px=0.5, pose=None, **more):
        if pixel is None or not (0 <= pixel[0] < 1280 and 0 <= pixel[1] < 960):
            return False
        noisy = pixel + self.rng.normal(0, sd_px, 2)
        line = {"kind": kind, "station": self.name, "pose": self.poses if pose is None else pose}
        line |= {"pan_counts": float(counts[0]), "tilt_counts": float(counts[1])}
        line |= {"approach_pan": int(approach[0]), "approach_tilt": int(approach[1])}
        line |= {"x_px": float(noisy[0]), "y_px": float(noisy[1]), "sd_px": sd_px, **more}
        self.lines.append(line)
        return True

    def sight(self, kind, point, reference, **more):
        """Drives roughly to a point [m] and sights it."""
        lifted = refracted(point, self.unit.refraction)
        counts = self.unit.counts_to(lifted) + self.rng.integers(-200, 200, 2)
        return self.observe(
            kind, counts, lambda s: self.unit.image(s, lifted), reference=reference, **more
        )

    def level(self):
        """Readings of an inclinometer whose zero is wrong by 41 arc seconds."""
        zero = self.rng.normal(0, 41 * ARCSEC, 2)
        x, y = np.degrees(np.array(self.unit.tilt) + zero)
        line = {"kind": "inclinometer", "station": self.name, "sd_deg": 0.001}
        self.lines.append({**line, "x_deg": x, "y_deg": y, "zero_sd_deg": 41 / 3600})

    def config(self, position_sd):
        p = self.place
        return STATION.format(
            name=self.name,
            latitude=np.degrees(p.latitude),
            longitude=np.degrees(p.longitude),
            height=p.height,
            heading=np.degrees(self.unit.heading) + 1.0,
            level=LEVEL_SD_DEG,
            position_sd=position_sd,
        )

    def instrument(self):
        text = f"[unit]\nangle_sd_deg = {np.degrees(ANGLE_SD):.9f}\n[values]\n"
        for name, value in self.known.items():
            shown = value if name in PLAIN else np.degrees(value)
            text += f"{key_of(name)} = {shown:.12f}\n"
        text += "[sd]\n"
        for name, size in self.sizes.items():
            text += f"{key_of(name)} = {size if name in PLAIN else size / 3600:.12f}\n"
        return text


def station(rng, name, place, is_new, work=WORK):
    """A unit drawn as new, or as after a workshop's calibration and transport."""
    known = nominal()
    if not is_new:
        known = drawn(rng, NEW, known)
    sizes = NEW if is_new else work
    unit = Unit(
        drawn(rng, sizes, known),
        heading=rng.uniform(0, 2 * np.pi),
        tilt=tuple(np.radians(rng.normal(0, LEVEL_SD_DEG / 2, 2))),
        phases=rng.uniform(0, 2 * np.pi, 4),
        refraction=0.13 + 0.15 * rng.normal(),
    )
    return Station(name, unit, place, sizes, known, rng)


@dataclass
class Site:
    rng: np.random.Generator
    stations: list
    position_sd: float = 0.02  # of each station, each axis: by RTK
    references: list = field(default_factory=list)
    tracked: dict = field(default_factory=dict)  # where a track's target was, by utime_us

    def refer(self, name, point_ecef, sd_m, utime_us=None):
        latitude, longitude, height = geodetic(point_ecef)
        self.references.append(
            f"{name},{np.degrees(latitude):.11f},{np.degrees(longitude):.11f},{height:.5f},"
            f"{sd_m},{'' if utime_us is None else utime_us},,"
        )

    def refer_star(self, name, ra, dec):
        degrees = np.degrees([ra, dec])
        self.references.append(f"{name},,,,,,{degrees[0]:.9f},{degrees[1]:.9f}")

    def write(self, folder, predict):
        """Writes all files; returns the arguments of `ols-calibrate adjust`.

        Rectification targets tell no heading, so that no direction can be predicted.
        """
        arguments = []
        lines = [line for one in self.stations for line in one.lines]
        for one in self.stations:
            (folder / f"{one.name}.toml").write_text(one.config(self.position_sd))
            (folder / f"{one.name}-instrument.toml").write_text(one.instrument())
            arguments += ["--station", folder / f"{one.name}.toml"]
        for one in self.stations:
            found = "workshop/out/instrument.toml" if one.workshop else "instrument.toml"
            arguments += ["--instrument", folder / f"{one.name}-{found}"]
        text = "\n".join(json.dumps(line) for line in lines)
        (folder / "observations.jsonl").write_text(text + "\n")
        header = "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us,ra_deg,dec_deg"
        (folder / "references.csv").write_text("\n".join([header, *self.references]) + "\n")
        (folder / "predict.csv").write_text(predict)
        arguments += ["--observations", folder / "observations.jsonl"]
        if self.references:
            arguments += ["--references", folder / "references.csv"]
        if not any(one.angles for one in self.stations):
            arguments += ["--predict", folder / "predict.csv"]
        arguments += ["--ut1-utc", UT1_UTC_S, "--pressure", PRESSURE_HPA]
        return [*arguments, "--temperature", TEMPERATURE_DEGC]


def icrs_of(place, direction, utime_us):
    """Right ascension and declination of a star that appears there: ERFA's own inverse."""
    azimuth, elevation = azimuth_elevation(direction)
    ra, dec = erfa.atoc13(
        "A",
        azimuth,
        np.pi / 2 - elevation,
        2440587.5,
        utime_us / 86400e6,
        UT1_UTC_S,
        place.longitude,
        place.latitude,
        place.height,
        0,
        0,
        PRESSURE_HPA,
        TEMPERATURE_DEGC,
        0.5,
        0.55,
    )
    return ra, dec


def anywhere(rng, unit, elevation_deg, pan_deg=150.0):
    """A random direction that the unit can reach."""
    pan = np.radians(rng.uniform(-pan_deg, pan_deg))
    return from_azimuth_elevation(unit.heading - pan, np.radians(rng.uniform(*elevation_deg)))
