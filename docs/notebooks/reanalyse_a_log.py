# %% [markdown]
# # What a recorded flight says about its stations
#
# A log keeps the bearings, so that a flight can be computed again: by another estimator, without a
# station, with what was learnt since. `python reanalyse_a_log.py out/demo/run.lcmlog` does so for a
# demo's log; without a file a short log is written from the example first.

# %%
import argparse
from pathlib import Path

import lcm
import matplotlib.pyplot as plt
import numpy as np
import ols
import ols.frames as frames
import ols_msg

HERE = Path(__file__).parent if "__file__" in globals() else Path.cwd()
parser = argparse.ArgumentParser(description="What a recorded flight says about its stations.")
parser.add_argument("log", nargs="?", type=Path)
parser.add_argument("--output", type=Path, default=Path(), help="folder of the plot")
given = parser.parse_args()
given.output.mkdir(parents=True, exist_ok=True)

# %% [markdown]
# A log holds messages; anything that can make them can write one.


# %%
def write_example(path):
    """The example's bearings as the messages that stations would have sent."""
    read, _ = ols.read_bearings(
        str(HERE / "example/stations.csv"), str(HERE / "example/bearings.csv")
    )
    columns = read.columns()
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for k, station in enumerate(columns.pop("station")):
        message = ols_msg.bearing_t()
        message.schema_version = ols_msg.bearing_t.SCHEMA_VERSION
        message.station, message.sequence = station, k + 1
        for name, values in columns.items():
            value = values[k].tolist()
            setattr(message, name, value)
        log.write_event(message.utime, f"OLS_BEARING_{station}", message.encode())
    log.close()
    return path


log = given.log or write_example(given.output / "example.lcmlog")
bearings = frames.read_log(log)
print(f"{len(bearings)} bearings of {bearings['station'].nunique()} stations")

# %% [markdown]
# All stations together. Objects are told apart as the live fusion does it.

# %%
config = ols.OfflineConfig(estimator="filter")
fixes = frames.locate(bearings, config)
counts = fixes["object"].value_counts()
print(f"positions of each object: {counts.tolist()}")

# %% [markdown]
# Each station in turn is left out, and what the others say is compared with what all say. A
# station whose absence moves the fixes always to the same side, by more than is stated, is the one
# to calibrate first: `ols-calibrate check` looks at it from the other side.

# %%
origin = ols.LocalFrame(ols.geodetic_from_ecef(fixes["position_ecef_m"].iloc[0]))
stations = sorted(bearings["station"].unique())
moved = {}
for left_out in stations:
    try:
        others = frames.locate(bearings[bearings["station"] != left_out], config)
    except ValueError as why:
        print(f"without {left_out}: {why}")
        continue
    both = fixes.merge(others, on=["utime", "object"], suffixes=("", "_without"))
    if both.empty:
        print(f"without {left_out}: no position")
        continue
    apart = np.stack(both["position_ecef_m_without"]) - np.stack(both["position_ecef_m"])
    east_north_up = apart @ origin.R_ecef_enu
    stated = both[["east_sd_m_without", "north_sd_m_without", "up_sd_m_without"]].to_numpy()
    moved[left_out] = east_north_up
    mean = east_north_up.mean(axis=0)
    share = np.abs(mean) / np.median(stated, axis=0)
    print(
        f"without {left_out:8s} {len(both):4d} positions, moved by {mean[0]:+.3f} {mean[1]:+.3f} "
        f"{mean[2]:+.3f} m east, north, up: {share.max():.1f} of the stated deviation"
    )

# %%
figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained", sharey=True)
for axis, name, k in zip(axes, ("east", "north", "up"), range(3), strict=True):
    axis.boxplot([m[:, k] for m in moved.values()], tick_labels=list(moved), showfliers=False)
    axis.axhline(0.0, color="grey", linewidth=0.7)
    axis.set(title=name, xlabel="left out")
axes[0].set_ylabel("moved by [m]")
figure.savefig(given.output / "left_out.png", dpi=120)
