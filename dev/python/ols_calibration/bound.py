"""The least that any calibration can leave of a case's systematic error.

The Bayesian bound of Cramer and Rao (H. L. Van Trees, Detection, Estimation and Modulation
Theory, part I, 1968, section 2.4): nobody who knows the instruments' distribution, the noise
and all that was observed is better in the mean over the instruments drawn. It is computed on
the simulated truth, from derivatives of the simulator, and shares no code with the product. The
second harmonic of the worm, the differences of the air from landmark to landmark and the
distances of scene points are taken to be known, which only lowers it.

    python -m ols_calibration.bound --case "5 landmarks" [--instruments 40]
"""

import argparse
from collections import defaultdict
from dataclasses import replace

import numpy as np

from .__main__ import HORIZON_COUNTS, volume
from .cases import CASES
from .model import ANGLE_SD, ARCSEC, PLAIN, Place, azimuth_elevation, refracted

LEVEL_SD = np.radians(0.25)  # of the tilts as they are drawn
ZERO_SD = np.hypot(41 * ARCSEC, np.radians(0.001))  # of the inclinometer's readings
REFRACTION_SD = 0.15
ANY = {"heading": 1.0, "direction": 5000.0}  # nothing is known: [rad], [m]


class Parameters:
    """A station's unknowns: names, deviations, and its unit with one of them changed."""

    def __init__(self, one, position_sd):
        self.unit, self.position_sd = one.unit, position_sd
        sizes = {n: s * (1.0 if n in PLAIN else ARCSEC) for n, s in one.sizes.items()}
        self.instrument = list(sizes)
        sd = [*sizes.values(), ANY["heading"], LEVEL_SD, LEVEL_SD, REFRACTION_SD]
        self.sd = np.array([*sd, *3 * [position_sd]])
        self.steps = np.minimum(0.05 * self.sd, 1e-4)[: len(sd)]

    def changed(self, k, by):
        if k < len(self.instrument):
            name = self.instrument[k]
            return replace(self.unit, values=self.unit.values | {name: self.unit.values[name] + by})
        k -= len(self.instrument)
        if k == 0:
            return replace(self.unit, heading=self.unit.heading + by)
        if k < 3:
            tilt = list(self.unit.tilt)
            tilt[k - 1] += by
            return replace(self.unit, tilt=tuple(tilt))
        return replace(self.unit, refraction=self.unit.refraction + by)

    def derivative(self, function):
        """Of function(unit), by all but the position."""
        columns = [
            (function(self.changed(k, step)) - function(self.changed(k, -step))) / (2 * step)
            for k, step in enumerate(self.steps)
        ]
        return np.stack(columns, axis=-1)

    def information(self):
        N = np.diag(self.sd**-2)
        at = len(self.instrument) + 1
        N[at, at] += ZERO_SD**-2
        N[at + 1, at + 1] += ZERO_SD**-2
        return N


def pixel_of(unit, shafts, point):
    return unit.image(shafts, refracted(point, unit.refraction))


def derivatives(of, line, point):
    """Of a sighting's pixel: by the station's parameters, by the point (east, north, up), by the
    shafts."""
    counts = line["pan_counts"], line["tilt_counts"]
    approach = line["approach_pan"], line["approach_tilt"]
    A = of.derivative(lambda unit: pixel_of(unit, unit.shafts(*counts, approach), point))
    shafts = np.array(of.unit.shafts(*counts, approach))

    def by(function, size, step):
        return np.stack(
            [(function(step * e) - function(-step * e)) / (2 * step) for e in np.eye(size)], axis=-1
        )

    B = by(lambda off: pixel_of(of.unit, shafts, point + off), 3, 0.05)
    S = by(lambda off: pixel_of(of.unit, shafts + off, point), 2, 1e-6)
    return np.hstack([A, -B]), B, S  # what moves the station moves the point the other way


def point_of(site, one, line, places):
    """Where a sighting's target is, east-north-up from the station, and how well that is known."""
    if line["kind"] == "landmark":
        place, sd = places[line["reference"]]
        return one.true_place.to_enu(place), sd
    if line["kind"] == "track":
        return one.true_place.to_enu(site.tracked[line["utime_us"]]), ANY["direction"]
    counts = line["pan_counts"], line["tilt_counts"]
    shafts = one.unit.shafts(*counts, (line["approach_pan"], line["approach_tilt"]))
    return 1500.0 * one.unit.look(shafts, (line["x_px"], line["y_px"])), ANY["direction"]


def places_of(site):
    places = {}
    for row in site.references:
        name, latitude, longitude, height, sd = row.split(",")[:5]
        places[name] = Place(float(latitude), float(longitude), float(height)).origin, float(sd)
    return places


def key_of(line):
    """Sightings of one target."""
    return line["kind"], line.get("utime_us") if line["kind"] == "track" else line["reference"]


class Bound:
    def __init__(self, site):
        self.site = site
        self.of = [Parameters(one, site.position_sd) for one in site.stations]
        self.size = len(self.of[0].sd)
        poses = [
            (s, line["pose"])
            for s, one in enumerate(site.stations)
            for line in one.lines
            if line["kind"] == "scene"
        ]
        self.poses = {key: i for i, key in enumerate(sorted(set(poses)))}
        total = len(self.of) * self.size + 2 * len(self.poses)
        self.N = np.zeros((total, total))
        for s, of in enumerate(self.of):
            self.N[self.station(s), self.station(s)] += of.information()
        first = len(self.of) * self.size
        self.N[first:, first:] += np.eye(2 * len(self.poses)) / ANGLE_SD**2
        self.add_targets()

    def station(self, s):
        return slice(s * self.size, (s + 1) * self.size)

    def add_targets(self):
        places, targets = places_of(self.site), defaultdict(list)
        for s, one in enumerate(self.site.stations):
            for line in one.lines:
                if line["kind"] != "inclinometer":
                    targets[key_of(line)].append((s, one, line))
        for sightings in targets.values():
            self.add_target(sightings, places)

    def add_target(self, sightings, places):
        """Eliminates the target's place."""
        total = len(self.N)
        N, M, own = np.zeros((total, total)), np.zeros((total, 3)), np.zeros((3, 3))
        for s, one, line in sightings:
            point, sd = point_of(self.site, one, line, places)
            A, B, S = derivatives(self.of[s], line, point)
            # In one frame for all stations.
            B = B @ one.true_place.axes
            W = line["sd_px"] ** 2 * np.eye(2)
            J = np.zeros((2, total))
            J[:, self.station(s)] = A
            pose = self.poses.get((s, line["pose"])) if line["kind"] == "scene" else None
            if pose is None:
                W += ANGLE_SD**2 * S @ S.T
            else:
                first = len(self.of) * self.size + 2 * pose
                J[:, first : first + 2] = S
            W = np.linalg.inv(W)
            N += J.T @ W @ J
            M += J.T @ W @ B
            own += B.T @ W @ B
        own += np.eye(3) / sd**2
        self.N += N - M @ np.linalg.solve(own, M.T)

    def covariance(self):
        scale = 1 / np.sqrt(np.diag(self.N))
        return scale[:, None] * np.linalg.inv(scale[:, None] * self.N * scale) * scale

    def rows(self, rng):
        """(station, whether at the horizon, derivative of (cross-elevation, elevation)) of each
        direction of the working volume."""
        for one, counts, approach, pixel in volume(self.site, rng):
            s = self.site.stations.index(one)

            def direction(unit, at=(counts, approach, pixel)):
                counts, approach, pixel = at
                return np.array(azimuth_elevation(unit.look(unit.shafts(*counts, approach), pixel)))

            elevation = direction(one.unit)[1]
            off = self.of[s].derivative(direction)
            off[0] *= np.cos(elevation)
            J = np.zeros((2, len(self.N)))
            J[:, self.station(s)] = np.hstack([off, np.zeros((2, 3))])
            yield s, abs(counts[1]) < HORIZON_COUNTS, J


def variance(figure, site, rng):
    """[rad^2] of the figure that the bench measures."""
    bound = Bound(site)
    C, rows = bound.covariance(), list(bound.rows(rng))
    if figure == "systematic":
        return np.mean([np.trace(J @ C @ J.T) / 2 for _, _, J in rows])
    means = [
        np.mean([J[0] for s, level, J in rows if level and s == k], axis=0)
        for k in range(len(site.stations))
    ]
    by = means[0] - means[1] if figure == "difference" else means[0]
    return by @ C @ by


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--instruments", type=int, default=40, help="of each case")
    parser.add_argument("--seed", type=int, default=1, help="of the first")
    parser.add_argument("--case", help="only those whose name contains this")
    arguments = parser.parse_args()
    seeds = range(arguments.seed, arguments.seed + arguments.instruments)
    print(f"{f'case, seeds {seeds[0]}..{seeds[-1]}':44} {'bound':>8} {'limit':>8}")
    kinds = {"landmark", "scene", "track", "inclinometer"}
    for name, (build, limit, figure) in CASES.items():
        if (arguments.case or "") not in name or figure not in ("systematic", "difference"):
            continue
        variances = []
        for seed in seeds:
            rng = np.random.default_rng(seed)
            site = build(rng)
            if {line["kind"] for one in site.stations for line in one.lines} - kinds:
                break
            variances.append(variance(figure, site, rng))
        if variances:
            bound = np.sqrt(np.mean(variances)) / ARCSEC
            print(f"{name:44} {bound:7.1f}″ {limit:7.1f}″", flush=True)


if __name__ == "__main__":
    main()
