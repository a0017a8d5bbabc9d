"""Plots of what stations see over the land: `ols-precision coverage` and `vertical`."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, LightSource

from ols_accuracy.style import OURS, save
from ols_accuracy.theory_plots import LocalAxes, columns

HEIGHTS_M = [0, 3, 10, 30, 100, 300, 1000]


def coverage(source: Path, output: Path, stations: Path | None = None) -> None:
    """The lowest heights above the ground at which one station sees, and two do."""
    table = columns(source)
    latitudes, longitudes = np.unique(table["latitude_deg"]), np.unique(table["longitude_deg"])
    axes = LocalAxes(table, stations)
    x, y = axes.east_m(longitudes), axes.north_m(latitudes)

    def picture(name: str) -> np.ndarray:  # rows from the north in the file, from the south here
        return table[name].reshape(len(latitudes), len(longitudes))[::-1]

    shade = LightSource(315, 45).hillshade(
        np.nan_to_num(picture("ground_m")), dx=x[1] - x[0], dy=y[1] - y[0]
    )
    figure, both = plt.subplots(1, 2, figsize=(12.5, 5.2), sharex=True, sharey=True)
    colours = plt.get_cmap("viridis_r", len(HEIGHTS_M))
    extent = (x[0], x[-1], y[0], y[-1])
    for ax, name, who in zip(
        both, ("one_m", "two_m"), ("one station", "two stations"), strict=True
    ):
        ax.imshow(shade, extent=extent, origin="lower", cmap="gray", vmin=-0.4, vmax=1.2)
        norm = BoundaryNorm(HEIGHTS_M, colours.N, extend="max")
        shown = ax.imshow(
            picture(name), extent=extent, origin="lower", cmap=colours, norm=norm, alpha=0.6
        )
        ax.set(title=f"seen by {who} from this height on", xlabel="east, m", ylabel="north, m")
        ax.grid(False)
        axes.mark(ax)
    figure.colorbar(shown, ax=both, label="above the ground, m", extend="max", shrink=0.9)
    save(figure, output)


def vertical(source: Path, output: Path) -> None:
    """For each station and azimuth the land, and what is hidden above it."""
    table = columns(source)
    stations, azimuths = np.unique(table["station"]), np.unique(table["azimuth_deg"])
    figure, rows = plt.subplots(
        *(len(azimuths), len(stations)),
        figsize=(4.2 * len(stations), 1.7 * len(azimuths) + 0.6),
        squeeze=False,
        sharex=True,
    )
    for row, azimuth in zip(rows, azimuths, strict=True):
        for ax, station in zip(row, stations, strict=True):
            mask = (table["station"] == station) & (table["azimuth_deg"] == azimuth)
            km, ground = table["distance_m"][mask] / 1000, table["ground_m"][mask]
            lowest = table["lowest_m"][mask]
            foot = np.nanmin(np.append(ground, lowest[np.isfinite(lowest)]))
            ax.fill_between(km, ground, foot, color="#b9a88f", linewidth=0, label="land")
            ax.fill_between(
                km, lowest, ground, color="#888888", alpha=0.45, linewidth=0, label="hidden"
            )
            ax.plot(km, lowest, color=OURS, linewidth=1, label="lowest visible")
            ax.set_title(f"{station}, {azimuth:g}°", fontsize=9)
    for ax in rows[-1]:
        ax.set_xlabel("distance, km")
    for ax in rows[:, 0]:
        ax.set_ylabel("height, m")
    rows[0, 0].legend(fontsize=7, loc="upper left")
    save(figure, output)
