"""Plots of the output of ols-precision."""

import csv
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, PowerNorm
from matplotlib.contour import QuadContourSet

from ols_accuracy.style import MAP, OURS, PAPER, STATION, save


class BadTable(ValueError):
    """In words for a person, with the file."""

    def __init__(self, path: Path, what: str):
        super().__init__(f"{path}: {what}")
        self.path = path


class Table(dict[str, np.ndarray]):
    """Columns of the CSV at `path`."""

    def __init__(self, path: Path):
        super().__init__()
        self._path = path

    def __missing__(self, name: str) -> np.ndarray:
        raise BadTable(self._path, f"has no column {name}")


def columns(path: Path) -> Table:
    """Numbers where all cells are, empty ones NaN."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise BadTable(path, "has no row")
    result = Table(path)
    for name in rows[0]:
        cells = [row[name] for row in rows]
        try:
            result[name] = np.array([float(cell) if cell else np.nan for cell in cells])
        except ValueError:
            result[name] = np.array(cells)
    return result


def grid(table: dict[str, np.ndarray], x: str, y: str, value: str) -> tuple[np.ndarray, ...]:
    xs, column = np.unique(table[x], return_inverse=True)
    ys, row = np.unique(table[y], return_inverse=True)
    values = np.full((len(ys), len(xs)), np.nan)
    values[row, column] = table[value]
    return xs, ys, values


def figure3(source: Path, output: Path) -> None:
    """The paper's surface, and cuts through it that tell the two formulas apart."""
    table = columns(source)
    base, distance, error = grid(table, "base_m", "distance_m", "rotating_pair_m")
    figure = plt.figure(figsize=(11, 4.6))
    axes = figure.add_subplot(1, 2, 1, projection="3d")
    shown = np.where(base[None, :] >= 10, error, np.nan)
    axes.plot_surface(*np.meshgrid(base, distance), shown, cmap=MAP, norm=PowerNorm(0.5), lw=0)
    axes.set(xlabel="base b, m", ylabel="distance Z, m", zlabel="error, m")
    axes.set_title("One camera off by p pixels (paper, Fig. 3)")
    axes.view_init(24, -128)
    cuts = figure.add_subplot(1, 2, 2)
    for b, colour in ((10, "#b3261e"), (30, OURS), (100, "#3a9d5d")):
        mask = np.isclose(table["base_m"], b)
        z = table["distance_m"][mask]
        cuts.loglog(z, table["both_cameras_m"][mask], "-", color=colour, label=f"both, b = {b} m")
        cuts.loglog(z, table["rotating_pair_m"][mask], "--", color=colour, label="one")
        cuts.loglog(z, table["canonical_m"][mask], ":", color=colour, label="canonical")
    cuts.set(xlabel="distance Z, m", ylabel="error, m", title="Cuts: rotating and canonical meet")
    cuts.set_xlim(20, None)
    cuts.legend(ncols=3, fontsize=8, loc="upper left")
    cuts.set_ylim(0.003, 4e3)
    save(figure, output)


def filled(axes: Axes, table: dict, value: str, norm: LogNorm) -> QuadContourSet:
    x, y, error = grid(table, "x_m", "y_m", value)
    levels = np.geomspace(norm.vmin, norm.vmax, 15)
    shown = axes.contourf(x, y, error, levels, norm=norm, cmap=MAP, extend="both")
    axes.set(xlabel="x, m", ylabel="y, m", aspect="equal")
    axes.grid(False)
    return shown


def figure4(source: Path, output: Path) -> None:
    table = columns(source)
    norm = LogNorm(0.01, 10.0)
    figure, axes = plt.subplots(1, 3, figsize=(13.5, 4.4), sharey=True)
    shown = filled(axes[0], table, "two_cameras_m", norm)
    filled(axes[1], table, "three_cameras_m", norm)
    figure.colorbar(shown, ax=axes[:2], label="error, m", shrink=0.9, ticks=[0.01, 0.1, 1, 10])
    x, y, two = grid(table, "x_m", "y_m", "two_cameras_m")
    three = grid(table, "x_m", "y_m", "three_cameras_m")[2]
    two, three = (np.where(np.isnan(e), 1e3, e) for e in (two, three))
    ratio = axes[2].contourf(
        x,
        y,
        three / two,
        [0, 0.25, 0.5, 0.75, 0.999, 1.001, 1.25, 1.5, 2],
        cmap="RdBu_r",
        norm=plt.Normalize(0, 2),
        extend="max",
    )
    figure.colorbar(ratio, ax=axes[2], label="three over two", shrink=0.9)
    axes[2].set(xlabel="x, m", aspect="equal", title="Red: three are worse than two")
    axes[2].grid(False)
    base = 20.0
    places = np.array([[-base / 2, 0], [base / 2, 0], [0, base * np.sqrt(0.75)]])
    for ax, count in zip(axes, (2, 3, 3), strict=True):
        ax.plot(*places[:count].T, "^", color=STATION, markersize=7, markeredgecolor="white")
    axes[0].set_title("Two cameras, b = 20 m")
    axes[1].set_title("Three cameras, i = argmax t·n")
    save(figure, output)


def table1(source: Path, output: Path) -> None:
    """How far our estimates are from the paper's, as percent."""
    table = columns(source)
    figure, axes = plt.subplots(figsize=(9, 3.4))
    place = np.arange(len(table["object"]))
    for k, (column, colour, label) in enumerate(
        (
            ("estimated_m", PAPER, "distance from the base's centre"),
            ("estimated_by_side_m", OURS, "distance from the first camera, on its side or not"),
        )
    ):
        percent = 100 * (table[column] / table["paper_estimated_m"] - 1)
        axes.bar(place + 0.38 * (k - 0.5), percent, 0.36, color=colour, label=label)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xticks(place, table["object"])
    axes.set(ylabel="from the paper's, %", title="Table 1, estimated column (p = 4 px, b = 30 m)")
    axes.grid(axis="x", visible=False)
    axes.legend(loc="lower right")
    save(figure, output)


class LocalAxes:
    """Metres east and north of a map's middle, plane, and the stations of a stations.csv."""

    def __init__(self, table: Table, stations: Path | None):
        places = columns(stations) if stations else None
        for name in ("longitude_deg", "latitude_deg") if places else ():
            if places[name].dtype.kind != "f":
                raise BadTable(stations, f"column {name} has a word")
        self._places = places
        self._zero = np.mean(table["longitude_deg"]), np.mean(table["latitude_deg"])

    def east_m(self, longitude_deg: np.ndarray) -> np.ndarray:
        return (longitude_deg - self._zero[0]) * 111_320 * np.cos(np.radians(self._zero[1]))

    def north_m(self, latitude_deg: np.ndarray) -> np.ndarray:
        return (latitude_deg - self._zero[1]) * 111_200

    def mark(self, ax: Axes) -> None:
        """Draws the stations."""
        places = self._places
        if places is None:
            return
        east, north = self.east_m(places["longitude_deg"]), self.north_m(places["latitude_deg"])
        ax.plot(east, north, "^", color=STATION, markersize=9, markeredgecolor="white")
        for x0, y0, label in zip(east, north, places["station"], strict=True):
            ax.annotate(label, (x0, y0), (6, 5), textcoords="offset points", fontsize=8)


def site_map(source: Path, output: Path, stations: Path | None = None) -> None:
    """Maps of the horizontal and the vertical 1-sigma, a row each height."""
    table = columns(source)
    heights = np.unique(table["above_stations_m"])
    figure, axes = plt.subplots(
        len(heights), 2, figsize=(11, 4.6 * len(heights)), squeeze=False, sharex=True, sharey=True
    )
    axes_m = LocalAxes(table, stations)
    for row, above in zip(axes, heights, strict=True):
        mask = table["above_stations_m"] == above
        x = axes_m.east_m(table["longitude_deg"][mask])
        y = axes_m.north_m(table["latitude_deg"][mask])
        for ax, column, name in zip(
            row, ("horizontal_m", "up_sd_m"), ("horizontal", "vertical"), strict=True
        ):
            value = table[column][mask]
            low, high = np.nanpercentile(value, [1, 97])
            levels = np.geomspace(low, high, 13)
            known = np.isfinite(value)
            shown = ax.tricontourf(
                x[known],
                y[known],
                value[known],
                levels,
                cmap=MAP,
                norm=LogNorm(low, high),
                extend="both",
            )
            bar = figure.colorbar(shown, ax=ax, label="1-sigma, m", shrink=0.9)
            bar.set_ticks(levels[::3], labels=[f"{v:.2g}" for v in levels[::3]])
            bar.minorticks_off()
            ax.set(aspect="equal", title=f"{name}, {above:g} m above the stations")
            ax.set(xlabel="east, m", ylabel="north, m")
            ax.grid(False)
            axes_m.mark(ax)
    save(figure, output)
