"""Plots of the paper's experiments in simulation."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import ols
from matplotlib.axes import Axes
from ols_demo.places import geodetic

from ols_accuracy.runs import EACH_OTHER, LANDMARKS, RANDOM, Run, horizontal
from ols_accuracy.style import OURS, PAPER, RANDOM_COLOUR, STATION, TRUTH, save
from ols_accuracy.theory_plots import columns

LOOKS = {
    EACH_OTHER: ("#8fbfe8", "all errors, stations aimed at each other"),
    LANDMARKS: (OURS, "all errors, headings from landmarks"),
    RANDOM: (RANDOM_COLOUR, "random errors only"),
}


def figure9(rows: list[dict], output: Path) -> None:
    """Estimated and measured errors of the landmarks: the paper's and ours."""
    figure, axes = plt.subplots(figsize=(10, 4.8))
    place = np.arange(len(rows))
    series = [
        ("paper_measured_m", PAPER, "the paper, measured"),
        ("paper_estimated_m", "#f0c48f", "the paper, estimated (p = 4 px)"),
        *((kind, colour, f"ours, {label}") for kind, (colour, label) in LOOKS.items()),
    ]
    for k, (key, colour, label) in enumerate(series):
        shift = place + 0.17 * (k - 2)
        axes.bar(shift, [row[key] for row in rows], 0.16, color=colour, label=label)
        if key in LOOKS:
            bounds = [row[f"{key}_bound"] for row in rows]
            axes.plot(shift, bounds, "_", color=TRUTH, markersize=8, markeredgewidth=1.6)
    axes.plot([], [], "_", color=TRUTH, markersize=8, label="the bound (1-sigma) of each")
    axes.set_yscale("log")
    names = [f"{row['object']}\n{row['distance_m']:.0f} m" for row in rows]
    axes.set_xticks(place, names)
    axes.set(ylabel="horizontal error, m", title="Static landmarks before a base of 30 m (Fig. 9)")
    axes.grid(axis="x", visible=False)
    axes.legend(ncols=2, fontsize=9, loc="upper left")
    axes.set_ylim(top=axes.get_ylim()[1] * 12)
    save(figure, output)


def local(site: ols.LocalFrame, table: dict[str, np.ndarray]) -> np.ndarray:
    keys = ("latitude_deg", "longitude_deg", "height_m")
    places = map(geodetic, *(table[key] for key in keys))
    return np.array([site.to_enu(ols.ecef_from_geodetic(place)) for place in places])


def draw_walk(plan: Axes, error: Axes, run: Run, site: ols.LocalFrame, kind: str) -> None:
    colour, label = LOOKS[kind]
    fixes, errors = local(site, columns(run.folder / "fixes.csv")), run.errors_enu()
    distances = horizontal(errors)
    plan.plot(fixes[:, 0], fixes[:, 1], ".", markersize=2, color=colour)
    true_range = np.hypot(*(fixes - errors)[:, :2].T)
    error.plot(true_range, distances, ".", markersize=2.5, color=colour)
    label = f"ours, {label}: mean {np.mean(distances):.2f} m"
    error.plot([], [], "o", color=colour, label=label)


def figure10(runs: dict[str, Run], site: ols.LocalFrame, output: Path) -> None:
    """The walk: its path and the error over the distance. Of what there is, of `runs` by kind."""
    figure, (plan, error) = plt.subplots(1, 2, figsize=(12, 5), width_ratios=(1, 2.6))
    for kind in LOOKS:
        if kind in runs:
            draw_walk(plan, error, runs[kind], site, kind)
    error.axhline(6.25, color=PAPER, linewidth=1.2, label="the paper: mean 6.25 m")
    error.axhline(13.35, color=PAPER, linewidth=1.2, linestyle=":", label="its greatest, 13.35 m")
    if runs:
        truth = local(site, columns(next(iter(runs.values())).folder / "truth.csv"))
        plan.plot(truth[:, 0], truth[:, 1], "-", color=TRUTH, lw=0.8, label="truth", zorder=3)
    plan.plot([-15, 15], [0, 0], "^", color=STATION, markersize=9, label="stations")
    plan.set(xlabel="east, m", ylabel="north, m", aspect="equal", title="Plan", xlim=(-60, 90))
    plan.legend(fontsize=8, loc="lower right")
    error.set(xlabel="distance from the base, m", ylabel="horizontal error, m", yscale="log")
    error.set(title="A walk of 120 s (Fig. 10)", ylim=(0.003, 800))
    error.legend(fontsize=8, loc="upper left")
    save(figure, output)


def budget(rows: dict[str, list[dict]], targets: list[str], output: Path) -> None:
    """Which source costs how many metres: the filter (bars), the paper's
    estimator (dots) and the bound (ticks), a panel each way of stationing."""
    figure, panels = plt.subplots(2, 1, figsize=(10, 7.2), sharex=True, sharey=True)
    colours = ("#b9dcc6", "#8fbfe8", "#0b6fb8", "#777777")
    for axes, (kind, each) in zip(panels, rows.items(), strict=True):
        place = np.arange(len(each))
        for k, (target, colour) in enumerate(zip(targets, colours, strict=True)):
            shift = place + 0.2 * (k - 1.5)
            bound, simulated, paper = zip(*(row[target] for row in each), strict=True)
            axes.bar(shift, simulated, 0.18, color=colour, label=target)
            axes.plot(shift, bound, "_", color=TRUTH, markersize=10, markeredgewidth=1.6)
            axes.plot(shift, paper, ".", color=PAPER, markersize=6)
        axes.plot([], [], "_", color=TRUTH, label="the bound (1-sigma)")
        axes.plot([], [], ".", color=PAPER, label="the paper's estimator")
        axes.set(yscale="log", ylabel="horizontal error, m", title=LOOKS[kind][1].split(", ")[1])
        axes.grid(axis="x", visible=False)
    panels[0].legend(fontsize=9, ncols=6, loc="upper left")
    panels[0].set_ylim(0.01, 2e3)
    names = [row["source"].replace(", ", ",\n") for row in next(iter(rows.values()))]
    panels[1].set_xticks(np.arange(len(names)), names)
    save(figure, output)
