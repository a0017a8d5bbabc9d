# %% [markdown]
# # Positions from a CSV of bearings
#
# Two files, as `ols-fuse` reads them: where the stations stand, and what they saw when. Run it as a
# script, `python triangulate_csv.py stations.csv bearings.csv`, or cell by cell in an editor that
# knows `# %%`. It needs pandas and matplotlib (requirements-archive.txt, requirements.txt).

# %%
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import ols
import ols.frames as frames

HERE = Path(__file__).parent if "__file__" in globals() else Path.cwd()
parser = argparse.ArgumentParser(description="Positions from a CSV of bearings.")
parser.add_argument("stations", nargs="?", default=HERE / "example/stations.csv")
parser.add_argument("bearings", nargs="?", default=HERE / "example/bearings.csv")
parser.add_argument("--output", type=Path, default=Path(), help="folder of fixes.csv and the plot")
given = parser.parse_args()
given.output.mkdir(parents=True, exist_ok=True)

# %% [markdown]
# One row a bearing: direction, covariance, where the camera stands. Angles are radians.

# %%
bearings = frames.read_csv(given.stations, given.bearings)
print(bearings.groupby("station")[["azimuth_rad", "elevation_rad"]].describe().iloc[:, [0, 1, 9]])

# %% [markdown]
# Every instant by itself, by least squares; the paper's way (pairs of stations, averaged); and the
# filter, which knows that an object does not leap and learns what stays wrong with each station.
# Each position says how far it may be off.

# %%
fixes = {}
for estimator in ("least-squares", "paper", "filter"):
    config = ols.OfflineConfig(estimator=estimator)
    fixes[estimator] = frames.locate(bearings, config, separate=False)
for name, found in fixes.items():
    sd_m = found[["east_sd_m", "north_sd_m", "up_sd_m"]].median()
    print(
        f"{name:14s} {len(found):4d} positions, stated deviations "
        f"{sd_m.iloc[0]:.3f} {sd_m.iloc[1]:.3f} {sd_m.iloc[2]:.3f} m east, north, up"
    )

# %% [markdown]
# Metres east, north and up of the first position. What the two estimates differ by is a check: of
# all differences a two-thirds share lies within one stated deviation.

# %%
origin = ols.LocalFrame(ols.geodetic_from_ecef(fixes["filter"]["position_ecef_m"].iloc[0]))


def enu(found):
    """(n, 3) [m]."""
    return np.array([origin.to_enu(p) for p in found["position_ecef_m"]])


both = fixes["least-squares"].merge(fixes["filter"], on="utime", suffixes=("", "_filter"))
apart = np.stack(both["position_ecef_m"]) - np.stack(both["position_ecef_m_filter"])
print(f"least squares and filter are {np.median(np.linalg.norm(apart, axis=1)):.3f} m apart")

# %%
figure, (plan, height) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
for name, found in fixes.items():
    east, north, up = enu(found).T
    seconds = (found["utime"] - found["utime"].iloc[0]) * 1e-6
    plan.plot(east, north, ".-", markersize=3, linewidth=0.7, label=name)
    if name == "paper":  # its deviation is that of pairs of cameras and hides the others'
        continue
    height.errorbar(seconds, up, found["up_sd_m"], fmt=".", markersize=3, label=name)
plan.set(xlabel="east [m]", ylabel="north [m]", aspect="equal", title="Plan")
height.set(xlabel="time [s]", ylabel="up [m]", title="Height, 1-sigma")
plan.legend()
figure.savefig(given.output / "triangulated.png", dpi=120)

# %%
columns = ["utime", "latitude_deg", "longitude_deg", "height_m"]
columns += ["east_sd_m", "north_sd_m", "up_sd_m", "stations_used"]
fixes["filter"][columns].to_csv(given.output / "fixes.csv", index=False)
