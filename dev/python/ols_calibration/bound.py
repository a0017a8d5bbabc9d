"""The least that any calibration can leave of a case's systematic error.

The Bayesian bound of Cramer and Rao (H. L. Van Trees, Detection, Estimation and Modulation
Theory, part I, 1968, section 2.4): nobody who knows the instruments' distribution, the noise
and all that was observed is better in the mean over the instruments drawn. It is computed on
the simulated truth, from derivatives of the simulator, and shares no code with the product. The
second harmonic of the worm, the differences of the air from landmark to landmark and the
distances of scene points are taken to be known, which only lowers it.

The second figure is for those whose model has no second harmonic of the worm: what it does in the
directions is left to them, too. Of both, the standard error over the instruments drawn is told.

    python -m ols_calibration.bound --case "5 landmarks" [--instruments 40]
"""

from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial

import numpy as np

from .__main__ import HORIZON_COUNTS, parser_of, volume
from .cases import CASES
from .model import ANGLE_SD, ARCSEC, PLAIN, Place, azimuth_elevation, refracted

LEVEL_SD = np.radians(0.25)  # of the tilts as they are drawn
ZERO_SD = np.hypot(41 * ARCSEC, np.radians(0.001))  # of the inclinometer's readings
REFRACTION_SD = 0.15
ANY = {"heading": 1.0, "direction": 5000.0}  # nothing is known: [rad], [m]
KNOWN = 1e-9
POSED = ("scene", "star")  # several of them share the angles of a pose


class Parameters:
    """A station's unknowns: names, deviations, and its unit with one of them changed."""

    def __init__(self, one, position_sd):
        self.unit, self.position_sd = one.unit, position_sd
        sizes = {n: s * (1.0 if n in PLAIN else ARCSEC) for n, s in one.sizes.items()}
        self.instrument = list(sizes)
        sd = [*sizes.values(), ANY["heading"], LEVEL_SD, LEVEL_SD, REFRACTION_SD]
        self.sd = np.array([*sd, *3 * [position_sd]])
        steps = np.minimum(0.05 * self.sd, 1e-4)[: len(sd)]
        self.pairs = [(self.changed(k, by), self.changed(k, -by), by) for k, by in enumerate(steps)]

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
        columns = [(function(more) - function(less)) / (2 * by) for more, less, by in self.pairs]
        return np.stack(columns, axis=-1)

    def information(self):
        N = np.diag(self.sd**-2)
        at = len(self.instrument) + 1
        N[at, at] += ZERO_SD**-2
        N[at + 1, at + 1] += ZERO_SD**-2
        return N


def derivatives(of, line, point):
    """Of a sighting's pixel: by the station's parameters, by the point (east, north, up), by the
    shafts."""
    counts = line["pan_counts"], line["tilt_counts"]
    approach = line["approach_pan"], line["approach_tilt"]
    far = line["kind"] == "star"
    shafts = np.array(of.unit.shafts(*counts, approach))
    lifted = {}  # by refraction: most parameters leave it

    def pixel_of(unit, shafts, off=None):
        if far:
            return unit.image(shafts, point, at_infinity=True)
        if off is not None:
            return unit.image(shafts, refracted(point + off, unit.refraction))
        if unit.refraction not in lifted:
            lifted[unit.refraction] = refracted(point, unit.refraction)
        return unit.image(shafts, lifted[unit.refraction])

    A = of.derivative(lambda unit: pixel_of(unit, unit.shafts(*counts, approach)))

    def by(function, size, step):
        return np.stack(
            [(function(step * e) - function(-step * e)) / (2 * step) for e in np.eye(size)], axis=-1
        )

    S = by(lambda off: pixel_of(of.unit, shafts + off), 2, 1e-6)
    B = np.zeros((2, 3)) if far else by(lambda off: pixel_of(of.unit, shafts, off), 3, 0.05)
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
    towards = one.unit.look(shafts, (line["x_px"], line["y_px"]))
    return (towards, KNOWN) if line["kind"] == "star" else (1500.0 * towards, ANY["direction"])


def places_of(site):
    places = {}
    for row in site.references:
        name, latitude, longitude, height, sd = row.split(",")[:5]
        if latitude:  # no star
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
            if line["kind"] in POSED
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
            pose = self.poses.get((s, line["pose"])) if line["kind"] in POSED else None
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


def variances(figure, site, rng):
    """[rad^2] of the figure that the bench measures: at least; and without the second harmonic."""
    bound = Bound(site)
    C, rows = bound.covariance(), list(bound.rows(rng))
    if figure == "systematic":
        least = np.mean([np.trace(J @ C @ J.T) / 2 for _, _, J in rows])
        return least, least + np.mean([of_second_harmonic(bound, s, J) for s, _, J in rows])
    means = [
        np.mean([J[0] for s, level, J in rows if level and s == k], axis=0)
        for k in range(len(site.stations))
    ]
    by = means[0] - means[1] if figure == "difference" else means[0]
    least = by @ C @ by
    return least, least


def of_second_harmonic(bound, s, J):
    """[rad^2] of an axis of a direction, in the mean over its phases. A turn of pan moves the
    direction as a turn of the heading does, one of tilt moves its elevation alone."""
    by_pan = J[0, bound.station(s)][len(bound.of[s].instrument)]
    return bound.of[s].unit.second_worm ** 2 / 2 * (by_pan**2 + 1) / 2


def shown(of_each):
    """Root of the mean, and its standard error, in arc seconds."""
    mean = np.mean(of_each)
    error = np.std(of_each, ddof=1) / np.sqrt(len(of_each)) if len(of_each) > 1 else np.nan
    return f"{np.sqrt(mean) / ARCSEC:6.2f}″ ±{error / (2 * np.sqrt(mean)) / ARCSEC:5.2f}"


def main():
    arguments = parser_of(__doc__).parse_args()
    seeds = range(arguments.seed, arguments.seed + arguments.instruments)
    title = f"case, seeds {seeds[0]}..{seeds[-1]}"
    print(f"{title:44} {'bound':>14} {'without 2nd':>15} {'limit':>8}")
    for name, (_, limit, figure) in CASES.items():
        if (arguments.case or "") not in name or figure not in ("systematic", "difference"):
            continue
        if not can_be_bounded(name):
            continue
        with ProcessPoolExecutor(arguments.jobs) as pool:
            found = np.array(list(pool.map(partial(of_instrument, name), seeds)))
        print(f"{name:44} {shown(found[:, 0])} {shown(found[:, 1])} {limit:7.1f}″", flush=True)


def can_be_bounded(name):
    site = CASES[name][0](np.random.default_rng(0))
    kinds = {line["kind"] for one in site.stations for line in one.lines}
    return not kinds - {"landmark", "scene", "star", "track", "inclinometer"}


def of_instrument(name, seed):
    build, _, figure = CASES[name]
    rng = np.random.default_rng(seed)
    return variances(figure, build(rng), rng)


if __name__ == "__main__":
    main()
