"""The paper's rectification targets, put up a little wrong, and the angles that they tell."""

import numpy as np

from .model import ARCSEC, HEIGHT, TURN, WIDTH, rx, ry, rz

MIDDLE = ((WIDTH - 1) / 2, (HEIGHT - 1) / 2)
SD_PX = 0.1
LEVEL_SD = 30 * ARCSEC  # of a board's lines
CROSS_SD_M, RULER_SD_M, TAPE_SD_M = 0.003, 0.001, 0.01
PICTURES = 4


def head(unit, shafts):
    """Axes of the head without its camera: X ahead, Y along the tilt axis."""
    origin = rz(np.pi / 2 - unit.heading) @ rx(unit.tilt[0]) @ ry(unit.tilt[1])
    return origin, origin @ rz(shafts[0]) @ rx(unit.values["trunnion"]) @ ry(-shafts[1])


def pan_axis(unit):
    return np.array([0, 0, 1.5]) + head(unit, (0, 0))[0] @ [0, 0, 0.09]


def counts_near(rng, unit, pan):
    """Counts that look level in this direction of pan; where the camera really looks is unknown."""
    return np.round(np.array([pan, 0.0]) / (2 * np.pi) * TURN) + rng.integers(-60, 60, 2)


def pictures(rng, one, pan):
    """Poses around a target, from both sides: (pose, counts, approach, shafts)."""
    first = counts_near(rng, one.unit, pan)
    for k in range(PICTURES):
        counts = first + 7 * k
        approach = (1, 1) if k % 2 == 0 else (-1, -1)
        one.poses += 1
        yield one.poses, counts, approach, one.unit.posed(rng, *counts, approach)


def ahead_of(unit, shafts, away_m):
    """Where the middle of the picture is, so far away, and the level direction to the right."""
    ray = unit.look(shafts, MIDDLE)
    level = ray[:2] / np.hypot(*ray[:2])
    middle = unit.camera(shafts)[1] + ray / np.hypot(*ray[:2]) * away_m
    return middle, np.array([*level, 0.0]), np.array([level[1], -level[0], 0.0])


def level_line(rng, one):
    """Lines at five heights on a board that leans and stands a little askew."""
    poses = list(pictures(rng, one, rng.uniform(-1, 1)))
    middle, forward, right = ahead_of(one.unit, poses[0][3], 30.0)
    askew, leans = rng.normal(0, np.radians(2)), rng.normal(0, LEVEL_SD)
    along = np.cos(askew) * right + np.sin(askew) * forward + np.array([0, 0, leans])
    for pose, counts, approach, shafts in poses:
        for up in (-0.8, -0.4, 0.0, 0.4, 0.8):
            ends = [
                one.unit.image(shafts, middle + np.array([0, 0, up]) + side * along)
                for side in (-0.9, 0.9)
            ]
            second = ends[1] + rng.normal(0, SD_PX, 2)
            one.add(
                *("level_line", counts, approach, ends[0], SD_PX),
                **{"reference": "board", "x2_px": float(second[0]), "y2_px": float(second[1])},
                level_sd_deg=float(np.degrees(LEVEL_SD)),
                pose=pose,
            )
    _, counts, approach, _ = poses[0]
    rotation, _ = one.unit.camera(one.unit.shafts(*counts, approach))
    return np.arctan2(-rotation[2, 0], -rotation[2, 1])


def cross(rng, one):
    """It stands where the unit points, but for some millimetres; the unit does not turn."""
    away_m, apart_m = 25.0, 0.2
    pose, counts, approach, shafts = next(pictures(rng, one, rng.uniform(-1, 1)))
    _, axes = head(one.unit, shafts)
    beside = -(apart_m + rng.normal(0, CROSS_SD_M))
    rotation, centre = one.unit.camera(shafts)
    # So high that the camera sees it: anywhere in the picture.
    up = centre + rotation @ [0, 0, away_m]
    height = (axes.T @ (up - pan_axis(one.unit)))[2] + rng.uniform(-0.3, 0.3)
    ahead = np.sqrt(away_m**2 - height**2)
    point = pan_axis(one.unit) + axes @ [ahead, beside, height]
    for _ in range(PICTURES):
        one.add(
            *("cross", counts, approach, one.unit.image(shafts, point), SD_PX),
            **{"reference": "cross", "distance_m": away_m + rng.normal(0, TAPE_SD_M)},
            **{"offset_m": apart_m, "offset_sd_m": CROSS_SD_M, "pose": pose},
        )
    ray = axes.T @ one.unit.look(shafts, MIDDLE)
    return np.arctan2(-ray[1], np.hypot(ray[0], ray[2]))


def rulers(rng, one):
    """Read at the row in the middle of the picture."""
    stated = {"near": 20.0, "far": 40.0}
    true = {name: away + rng.normal(0, TAPE_SD_M) for name, away in stated.items()}
    zero = {name: 1.5 + rng.normal(0, RULER_SD_M) for name in stated}
    poses = list(pictures(rng, one, rng.uniform(-1, 1)))
    for pose, counts, approach, shafts in poses:
        _, centre = one.unit.camera(shafts)
        for name, column in (("near", 400.0), ("far", 900.0)):
            ray = one.unit.look(shafts, (column, MIDDLE[1]))
            level = np.hypot(*ray[:2])
            away_m = true[name] - centre[:2] @ ray[:2] / level
            reading = centre[2] + away_m * ray[2] / level - zero[name]
            one.add(
                *("ruler", counts, approach, np.array([column, MIDDLE[1]]), SD_PX),
                **{"reference": name, "distance_m": stated[name], "height_m": float(reading)},
                height_sd_m=RULER_SD_M,
                pose=pose,
            )
    _, counts, approach, _ = poses[0]
    ray = one.unit.look(one.unit.shafts(*counts, approach), MIDDLE)
    return np.arctan2(ray[2], np.hypot(*ray[:2])) - 2 * np.pi * counts[1] / TURN


def put_up(rng, one):
    """All three; the station keeps the angles that they should tell."""
    one.angles = {
        "roll": level_line(rng, one),
        "azimuth": cross(rng, one),
        "elevation": rulers(rng, one),
    }
