# %% [markdown]
# # Where to put the tripods
#
# The bound of Cramer and Rao says, before anything is built, how well a position can be known. Here
# four tripods are put on the best of many possible places around a field, and the choice is
# compared with four in a row along its edge. `ols-precision` does the same from files.

# %%
import argparse
import itertools
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import ols

parser = argparse.ArgumentParser(description="Where to put the tripods of a site.")
parser.add_argument("--stations", type=int, default=4)
parser.add_argument("--height", type=float, default=80.0, help="of what flies [m]")
parser.add_argument("--output", type=Path, default=Path(), help="folder of the plot")
given = parser.parse_args()
given.output.mkdir(parents=True, exist_ok=True)

SITE = ols.LocalFrame(
    ols.Geodetic(latitude_rad=np.radians(49.2266), longitude_rad=np.radians(16.5969), height_m=310)
)

# %% [markdown]
# What is known of a station: a pixel of 15 arc seconds, a calibration whose heading is off by 20, a
# place surveyed to 2 cm, a clock to half a millisecond.

# %%
ARCSEC = np.radians(1 / 3600)


def station_at(east_m, north_m):
    at = ols.geodetic_from_ecef(SITE.to_ecef(np.array([east_m, north_m, 2.0])))
    calibration = ols.CalibrationSd(
        heading_rad=20 * ARCSEC, tilt_rad=10 * ARCSEC, mount_rad=10 * ARCSEC, position_m=0.02
    )
    return ols.PlannedStation(
        place=ols.LocalFrame(at), white_rad=15 * ARCSEC, calibration=calibration, clock_sd_s=5e-4
    )


def target_at(east_m, north_m, speed_m_s=15.0):
    moment = np.eye(3) * speed_m_s**2 / 3
    there = SITE.to_ecef(np.array([east_m, north_m, given.height]))
    return ols.PlannedTarget(p_ecef=there, velocity_moment_ecef=moment)


# %% [markdown]
# The field is 800 m by 500 m; a tripod may stand anywhere on its edge, every 50 m.

# %%
HALF_EAST_M, HALF_NORTH_M = 400.0, 250.0
edge = [
    (float(e), float(n))
    for e, n in itertools.product(np.arange(-400, 401, 50), np.arange(-250, 251, 50))
    if abs(e) == HALF_EAST_M or abs(n) == HALF_NORTH_M
]
grid = [(e, n) for e in np.linspace(-380, 380, 20) for n in np.linspace(-230, 230, 12)]
problem = ols.PlacementProblem(
    places=[station_at(*p) for p in edge],
    area=[target_at(*p) for p in grid],
    stations=given.stations,
    goal=ols.PlacementGoal.WORST,
)
best = ols.place_stations(problem, seed=1)
south = [k for k, (_, n) in enumerate(edge) if n == -HALF_NORTH_M]
row = [south[round(k)] for k in np.linspace(0, len(south) - 1, given.stations)]
in_a_row = ols.rate_placement(problem, row)
for words, placement in (("best places", best), ("in a row", in_a_row)):
    print(f"{words:12s} mean {placement.mean_m:.3f} m, worst {placement.worst_m:.3f} m")


# %% [markdown]
# The bound over the field, and what it consists of in the middle: the part that more pictures make
# smaller is the white one.


# %%
def bound_m(chosen, east_m, north_m):
    """1-sigma of the position, all three axes together [m]."""
    stations = [problem.places[k] for k in chosen]
    found = ols.position_precision(stations, target_at(east_m, north_m))
    return np.sqrt(np.trace(found.covariance_ecef)) if found else np.nan


figure, axes = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
east, north = np.linspace(-400, 400, 41), np.linspace(-250, 250, 26)
maps = [
    np.array([[bound_m(placement.chosen, e, n) for e in east] for n in north])
    for placement in (best, in_a_row)
]
most = max(np.nanpercentile(m, 95) for m in maps)
for axis, values, placement, title in zip(
    axes, maps, (best, in_a_row), ("best places", "in a row"), strict=True
):
    drawn = axis.pcolormesh(east, north, values, vmin=0, vmax=most, shading="nearest")
    places = np.array([edge[k] for k in placement.chosen])
    axis.plot(*places.T, "r^", markersize=9)
    axis.set(xlabel="east [m]", ylabel="north [m]", aspect="equal", title=title)
figure.colorbar(drawn, ax=axes, label="1-sigma of the position [m]")
figure.savefig(given.output / "plan.png", dpi=120)

# %%
middle = ols.position_precision([problem.places[k] for k in best.chosen], target_at(0, 0))
for source, part in middle.parts_ecef.items():
    print(f"{source.name.lower():10s} {np.sqrt(np.trace(part)):.3f} m")
