"""The cases of the measure table: what is observed in each."""

import os
import subprocess
from copy import copy
from functools import cache, partial
from pathlib import Path

import numpy as np

from .model import (
    FOCAL_PX,
    HEIGHT,
    PAIRS,
    TRANSPORT,
    WIDTH,
    WORK,
    Place,
    azimuth_elevation,
    drawn,
    from_azimuth_elevation,
    refracted,
)
from .rectification import put_up
from .site import UTIME_US, Site, anywhere, icrs_of, station
from .star_table import spots, stars_around, table_stars

ROOT = Path(__file__).resolve().parents[3]
BIN = Path(os.environ.get("OLS_BIN", ROOT / "build/release/bin"))

PLACE = (49.2266, 16.5969, 310.0)
WORKSHOP_FRAMES = 40  # of twelve stars
LOWEST_STAR = np.radians(10.1)  # below, ERFA's refraction is wrong


def one_station(rng, is_new, position_sd=0.02, work=WORK):
    site = Site(rng, [station(rng, "alfa", Place(*PLACE), is_new, work)], position_sd)
    one = site.stations[0]
    one.level()
    # The tripod's place is surveyed as well as it is stated.
    one.surveyed = one.place
    off = rng.normal(0, position_sd, 3)
    one.true_place = Place(*PLACE)
    one.true_place.origin = one.place.to_ecef(off)
    return site, one


def landmark_points(rng, one, count, distance_m=(300, 2000), elevation_deg=(-2, 8)):
    return [anywhere(rng, one.unit, elevation_deg) * rng.uniform(*distance_m) for _ in range(count)]


def sight_landmarks(site, one, points, sd_m, times):
    """Each landmark's place is wrong by its own error, and its air differs a little."""
    for k, point in enumerate(points):
        name = f"landmark{k}"
        place = one.true_place.to_ecef(point)
        site.refer(name, place + site.rng.normal(0, sd_m, 3), sd_m)
    k_mean = one.unit.refraction
    for _ in range(times):
        for k, point in enumerate(points):
            one.unit.refraction = k_mean + 0.05 * np.sin(k)
            one.sight("landmark", point, f"landmark{k}")
    one.unit.refraction = k_mean


@cache
def plan(*arguments):
    """(pan, tilt, approach) of each picture [deg], as `ols-calibrate` lays them in the field."""
    program = BIN / "ols-bench-plans"
    command = [str(program), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = [tuple(map(float, line.split(","))) for line in done.stdout.splitlines()[1:]]
    return [(pan, tilt, (int(by_pan), int(by_tilt))) for pan, tilt, by_pan, by_tilt in rows]


def stars(rng, frames=20):
    site, one = one_station(rng, is_new=True)
    reach = ("--pan", 150, "--lowest", 12.1, "--highest", 30.5)
    for frame, (pan_deg, tilt_deg, approach) in enumerate(plan("stars", frames, *reach)):
        counts = np.round(np.array([pan_deg, tilt_deg]) / 360 * 112000)
        shafts = one.unit.posed(rng, *counts, approach)
        utime_us = UTIME_US + 3_000_000 * frame
        for k in range(12):
            pixel = rng.uniform([20, 20], [1260, 940])
            if azimuth_elevation(one.unit.look(shafts, pixel))[1] < LOWEST_STAR:
                continue
            name = f"star{frame}-{k}"
            site.refer_star(name, *icrs_of(one.place, one.unit.look(shafts, pixel), utime_us))
            one.add(
                *("star", counts, approach, pixel),
                **{"sd_px": 0.3, "pose": frame, "reference": name, "utime_us": utime_us},
            )
    return site


def through_workshop(rng, one):
    """The unit becomes one that stars have calibrated in a workshop, and that was transported."""
    one.workshop = stars(rng, WORKSHOP_FRAMES)
    [before] = one.workshop.stations
    one.unit.values = before.unit.values | drawn(rng, TRANSPORT, before.unit.values)
    one.unit.phases = before.unit.phases


def rtk_landmarks(rng, work=WORK, workshop=False):
    site, one = one_station(rng, is_new=False, work=work)
    if workshop:
        through_workshop(rng, one)
    sight_landmarks(site, one, landmark_points(rng, one, 5), 0.02, 4)
    return site


def cadastral_landmarks(rng):
    site, one = one_station(rng, is_new=False)
    sight_landmarks(site, one, landmark_points(rng, one, 8, (500, 3000)), 0.14, 2)
    return site


def wrong_landmark(rng):
    """The first of five stands 1 m beside where the survey has it, 1 km away."""
    site, one = one_station(rng, is_new=False)
    points = landmark_points(rng, one, 5)
    points[0] *= 1000 / np.linalg.norm(points[0])
    sight_landmarks(site, one, points, 0.02, 4)
    across = np.cross(points[0], [0, 0, 1])
    moved = one.true_place.to_ecef(points[0] + across / np.linalg.norm(across))
    site.references = [r for r in site.references if not r.startswith("landmark0,")]
    site.refer("landmark0", moved, 0.02)
    return site


def drone(rng):
    site, one = one_station(rng, is_new=False)
    antenna = rng.normal(0, 0.1, 3)
    for k in range(40):
        point = anywhere(rng, one.unit, (3, 29)) * rng.uniform(100, 300)
        utime_us = UTIME_US + 10_000_000 * k
        if not one.sight("drone", point + antenna, "drone", utime_us=utime_us):
            continue
        measured = one.true_place.to_ecef(point) + rng.normal(0, 0.02, 3)
        for at in (utime_us - 1_000_000, utime_us + 1_000_000):
            site.refer("drone", measured, 0.02, at)
    return site


def sweep(rng):
    """A ring over the scenery and a block, then five landmarks by RTK."""
    site, one = one_station(rng, is_new=True)
    scenery = [
        refracted(
            from_azimuth_elevation(rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(-3, 6)))
            * np.exp(rng.uniform(np.log(200), np.log(8000))),
            one.unit.refraction,
        )
        for _ in range(1500)
    ]
    directions = np.array([point / np.linalg.norm(point) for point in scenery])
    degree = 112000 / 360
    field_deg = 2 * np.degrees(np.arctan(np.array([WIDTH, HEIGHT]) / 2 / FOCAL_PX))
    field = ("--across", field_deg[0], "--up", field_deg[1])
    for pose, (pan, tilt, approach) in enumerate(plan("sweep", 92, *field)):
        counts = np.round(np.array([pan, tilt]) * degree)
        shafts = one.unit.posed(rng, *counts, approach)
        inside = 0
        axis = one.unit.look(shafts, (640, 480))
        near = np.flatnonzero(directions @ axis > np.cos(np.radians(4.5)))
        for k in near:
            point = scenery[k]
            pixel = one.unit.image(shafts, point)
            seen = one.add(
                *("scene", counts, approach, pixel),
                **{"sd_px": 0.2, "pose": 1000 + pose, "reference": str(k)},
            )
            inside += seen
            if inside == 25:
                break
    sight_landmarks(site, one, landmark_points(rng, one, 5), 0.02, 4)
    return site


def aircraft(rng, slow_s=0.0):
    """`slow_s`: of the receiver's clock, in all passes alike."""
    site, one = one_station(rng, is_new=False)
    for k in range(20):
        course, closest = rng.uniform(0, 2 * np.pi), rng.uniform(16e3, 35e3)
        along = np.array([np.sin(course), np.cos(course), 0])
        across = np.array([np.cos(course), -np.sin(course), 0]) * rng.choice([-1, 1])
        latency_s, off = rng.uniform(0.1, 0.9) - slow_s, rng.normal(0, 10, 3)
        start_us = UTIME_US + 1_000_000_000 * k

        def at(seconds, along=along, across=across, closest=closest):
            level = closest * across + 230 * seconds * along + [0, 0, 10000]
            return level - [0, 0, (level[0] ** 2 + level[1] ** 2) / (2 * 6.38e6)]

        for s in range(-70, 71, 2):
            place = one.true_place.to_ecef(at(s) + off)
            site.refer(f"flight{k}", place, 10.0, start_us + int(1e6 * (s + latency_s)))
        for s in np.linspace(-50, 50, 12):
            pan = one.unit.counts_to(at(s))[0] / 112000 * 360
            if abs(pan) < 158:
                one.sight(
                    *("aircraft", at(s), f"flight{k}"), utime_us=start_us + int(round(1e6 * s))
                )
    return site


def surveyed(rng, one, sd_m=0.02):
    """Its true place is where it was surveyed, but for the survey's error."""
    one.true_place = copy(one.place)
    one.true_place.origin = one.place.to_ecef(rng.normal(0, sd_m, 3))


def other_stations(rng):
    """Three stations some 800 m apart: each sights the axes of the two others, and nothing else."""
    offsets = ((0, 0, 0), (0.005, 0.008, 25), (-0.004, 0.009, -10))
    places = [Place(*np.add(PLACE, offset)) for offset in offsets]
    units = [
        station(rng, name, place, False)
        for name, place in zip(("alfa", "bravo", "charlie"), places, strict=True)
    ]
    site = Site(rng, units)
    middle = np.mean([place.origin for place in places], axis=0)
    for one in units:
        # It sees both others: they are not behind its limits.
        towards, _ = azimuth_elevation(one.place.to_enu(middle))
        turned = towards + rng.uniform(-1.7, 1.7)
        one.unit.heading = np.arctan2(np.sin(turned), np.cos(turned))
        one.level()
        surveyed(rng, one)
    for _ in range(4):
        for one in units:
            for other in units:
                if other is one:
                    continue
                crossing = other.true_place.to_ecef(other.unit.crossing())
                one.sight("station", one.true_place.to_enu(crossing), other.name)
    return site


def joint_track(rng, work=WORK, workshop=False):
    """Two stations 2.2 km apart follow what flies across the line through both of them."""
    places = [Place(*PLACE), Place(PLACE[0], PLACE[1] + 0.03, PLACE[2] + 4)]
    units = [
        station(rng, name, p, False, work)
        for name, p in zip(("alfa", "bravo"), places, strict=True)
    ]
    site = Site(rng, units)
    for one in units:
        if workshop:
            through_workshop(rng, one)
        # Either sees east and west: neither is behind its limits.
        one.unit.heading = rng.choice([0, np.pi]) + rng.uniform(-0.7, 0.7)
        one.level()
        surveyed(rng, one)
        point = anywhere(rng, one.unit, (-1, 3)) * 500
        name = f"mark-{one.name}"
        site.refer(name, one.true_place.to_ecef(point) + rng.normal(0, 0.14, 3), 0.14)
        for _ in range(2):
            one.sight("landmark", point, name)
    for k, share in enumerate(np.linspace(-1, 1, 60)):
        # To and fro over the line through both, between them and beyond.
        target = np.array([5000.0 if k % 2 else 1100.0, 250 * share, 500 + 100 * share])
        where = units[0].place.to_ecef(target)
        site.tracked[UTIME_US + 1_000_000 * k] = where
        for one in units:
            point = one.true_place.to_enu(where)
            pan = one.unit.counts_to(point)[0] / 112000 * 360
            if abs(pan) < 158:
                utime_us = UTIME_US + 1_000_000 * k
                one.sight("track", point, "target", utime_us=utime_us, sd_px=0.3)
    return site


def moving_scene(rng):
    """Scenery seen while pan moves to both sides, slowly and fast: at one speed the offset of the
    exposure would look like backlash."""
    site, one = one_station(rng, is_new=True)
    degree = 112000 / 360
    for k, point in enumerate(landmark_points(rng, one, 12)):
        for speed in (5, 20, -5, -20):
            one.sight_moving("scene", point, str(k), speed * degree)
    sight_landmarks(site, one, landmark_points(rng, one, 3), 0.02, 2)
    return site


def nameless_stars(rng, stars=10, false=5, frames=3, is_new=True):
    """Frames of stars without names, with false detections among them."""
    site, one = one_station(rng, is_new)
    one.lines.clear()  # no inclinometer either: level to half a degree
    one.true_names = []
    table = table_stars()
    start_us = UTIME_US + int(rng.integers(0, 31_000_000)) * 1_000_000
    for frame in range(frames):
        utime_us = start_us + 3_000_000 * frame
        counts = np.round(np.array([rng.uniform(-150, 150), rng.uniform(15, 30)]) / 360 * 112000)
        approach = rng.choice([-1, 1], 2)
        shafts = one.unit.posed(rng, *counts, approach)
        axis = one.unit.look(shafts, (640, 480))
        numbers, directions = stars_around(table, one.place, axis, utime_us)
        images = [
            (number, *pixel)
            for number, direction in zip(numbers, directions, strict=True)
            if (pixel := one.unit.image(shafts, direction, at_infinity=True)) is not None
            and (pixel >= 0).all()
            and (pixel < (1280, 960)).all()
        ]
        found = spots(rng.permutation(images)[:stars], images)
        names = [*(names for names, _ in found), *[None] * false]
        pixels = [*(pixel for _, pixel in found), *rng.uniform([0, 0], [1279, 959], (false, 2))]
        order = rng.permutation(len(pixels))
        for k in order:
            if one.add(
                *("star", counts, approach, pixels[k]),
                **{"sd_px": 0.3, "pose": frame, "reference": None, "utime_us": utime_us},
            ):
                one.true_names.append(names[k])
    site.refer("unused", one.place.to_ecef(np.array([0, 100.0, 0])), 1.0)
    return site


# name -> (what is observed, the most its figure may be [arc seconds], which figure)
def rectification(rng):
    """The paper's three targets, and an inclinometer."""
    site, one = one_station(rng, is_new=True)
    put_up(rng, one)
    return site


CASES = {
    "stars, 20 frames of 12, new unit": (stars, 6.0, "systematic"),
    "5 landmarks by RTK, four times, workshop": (rtk_landmarks, 9.0, "systematic"),
    "8 cadastral landmarks, twice, workshop": (cadastral_landmarks, 16.0, "systematic"),
    "RTK drone, 40 points, workshop": (drone, 12.0, "systematic"),
    "sweep + 5 by RTK, new unit": (sweep, 20.0, "systematic"),
    "joint track across both stations' line": (joint_track, 4.0, "difference"),
    "20 passes of aircraft: heading, workshop": (aircraft, 10.0, "heading"),
    "20 passes, a receiver 2 s slow: heading": (partial(aircraft, slow_s=2.0), 10.0, "heading"),
    "3 stations that aim at each other: heading, workshop": (other_stations, 10.0, "heading"),
    "5 landmarks by RTK, gears 5″ in amplitude": (
        partial(rtk_landmarks, work=PAIRS),
        *(9.0, "systematic"),
    ),
    "joint track, gears 5″ in amplitude": (partial(joint_track, work=PAIRS), 4.0, "difference"),
    "5 landmarks by RTK, after stars in a workshop": (
        partial(rtk_landmarks, workshop=True),
        *(9.0, "systematic"),
    ),
    "joint track, after stars in a workshop": (
        partial(joint_track, workshop=True),
        *(4.0, "difference"),
    ),
    "exposure offset, scenery at 5 and 20°/s [ms]": (moving_scene, 0.1, "offset"),
    "stars without names, 10 a frame, 5 false": (nameless_stars, None, "identified"),
    "the paper's level line: roll, new unit": (rectification, 40.0, "roll"),
    "the paper's cross: azimuth, new unit": (rectification, 40.0, "azimuth"),
    "the paper's rulers: elevation, new unit": (rectification, 40.0, "elevation"),
    "a landmark wrong by 1 m at 1 km": (wrong_landmark, None, "named"),
}
