"""Pictures of the paper's experiments as the simulation runs them."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import ols

from ols_accuracy.runs import Run, horizontal
from ols_accuracy.style import OURS, PAPER, RANDOM, STATION, TRUTH, save
from ols_accuracy.theory_plots import columns


def figure9(rows: list[dict], output: Path) -> None:
    """Estimated and measured errors of the landmarks: the paper's and ours."""
    figure, axes = plt.subplots(figsize=(10, 4.6))
    place = np.arange(len(rows))
    series = (
        ("paper_measured_m", PAPER, "paper, measured"),
        ("paper_estimated_m", "#f0c48f", "paper, estimated (p = 4 px)"),
        ("all_m", OURS, "ours, all errors (RMS over the seeds)"),
        ("all_predicted_m", "#8fbfe8", "ours, predicted 1-sigma"),
        ("random_m", RANDOM, "ours, random errors only"),
    )
    for k, (key, colour, label) in enumerate(series):
        values = [row[key] for row in rows]
        axes.bar(place + 0.17 * (k - 2), values, 0.16, color=colour, label=label)
    axes.set_yscale("log")
    names = [f"{row['object']}\n{row['distance_m']:.0f} m" for row in rows]
    axes.set_xticks(place, names)
    axes.set(ylabel="horizontal error, m", title="Static landmarks before a base of 30 m (Fig. 9)")
    axes.grid(axis="x", visible=False)
    axes.legend(ncols=2, fontsize=9, loc="upper left")
    axes.set_ylim(top=axes.get_ylim()[1] * 6)
    save(figure, output)


def local(site: ols.LocalFrame, table: dict[str, np.ndarray]) -> np.ndarray:
    keys = ("latitude_deg", "longitude_deg", "height_m")
    places = [
        ols.Geodetic(latitude_rad=np.radians(a), longitude_rad=np.radians(b), height_m=c)
        for a, b, c in zip(*(table[key] for key in keys), strict=True)
    ]
    return np.array([site.to_enu(ols.ecef_from_geodetic(place)) for place in places])


def figure10(runs: dict[str, Run], site: ols.LocalFrame, output: Path) -> None:
    """The walk: its path and the error over the distance."""
    figure, (plan, error) = plt.subplots(1, 2, figsize=(12, 5), width_ratios=(1, 1.5))
    truth = local(site, columns(runs["all"].folder / "truth.csv"))
    for kind, colour, label in (
        ("all", OURS, "all errors"),
        ("random", RANDOM, "random errors only"),
    ):
        if kind not in runs:
            continue
        run = runs[kind]
        fixes = local(site, columns(run.folder / "fixes.csv"))
        distances = horizontal(run.errors_enu())
        plan.plot(fixes[:, 0], fixes[:, 1], ".", markersize=2, color=colour, label=label)
        true_range = np.hypot(*(fixes - run.errors_enu())[:, :2].T)
        mean = np.mean(distances)
        error.plot(true_range, distances, ".", markersize=2.5, color=colour)
        error.plot([], [], "o", color=colour, label=f"ours, {label}: mean {mean:.2f} m")
    paper = horizontal(runs["all"].errors_enu("fixes_paper"))
    fixes = local(site, columns(runs["all"].folder / "fixes_paper.csv"))
    true_range = np.hypot(*(fixes - runs["all"].errors_enu("fixes_paper"))[:, :2].T)
    error.plot(true_range, paper, ".", markersize=1.5, color="#888888", zorder=1)
    label = f"the paper's estimator on the same bearings: mean {np.mean(paper):.2f} m"
    error.plot([], [], "o", color="#888888", label=label)
    error.axhline(6.25, color=PAPER, linewidth=1.2, label="the paper: mean 6.25 m")
    error.axhline(13.35, color=PAPER, linewidth=1.2, linestyle=":", label="its greatest, 13.35 m")
    plan.plot(truth[:, 0], truth[:, 1], "-", color=TRUTH, linewidth=0.8, label="truth", zorder=3)
    plan.plot([-15, 15], [0, 0], "^", color=STATION, markersize=9, label="stations")
    plan.set(xlabel="east, m", ylabel="north, m", aspect="equal", title="Plan")
    plan.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.02, 1.0))
    error.set(xlabel="distance from the base, m", ylabel="horizontal error, m", yscale="log")
    error.set(title="A walk of 120 s (Fig. 10)", ylim=(0.005, 400))
    error.legend(fontsize=8, loc="upper left")
    save(figure, output)


def budget(rows: list[dict], targets: list[str], output: Path) -> None:
    """Which source costs how many metres: predicted (bars) and simulated (marks)."""
    figure, axes = plt.subplots(figsize=(10, 4.2))
    place = np.arange(len(rows))
    colours = ("#b9dcc6", "#8fbfe8", "#0b6fb8")
    for k, (target, colour) in enumerate(zip(targets, colours, strict=True)):
        shift = place + 0.26 * (k - 1)
        axes.bar(shift, [row[target]["predicted_m"] for row in rows], 0.24, color=colour)
        simulated = [row[target]["simulated_m"] for row in rows]
        axes.plot(shift, simulated, "o", color=TRUTH, markersize=4)
        axes.bar([0], [0], color=colour, label=target)
    axes.plot([], [], "o", color=TRUTH, markersize=4, label="simulated, RMS over the seeds")
    axes.set_yscale("log")
    axes.set_xticks(place, [row["source"] for row in rows])
    axes.set(ylabel="horizontal error, m", title="What each source costs (bars: the bound)")
    axes.grid(axis="x", visible=False)
    axes.legend(fontsize=9, ncols=2, loc="upper left")
    axes.set_ylim(0.01, 3e4)
    save(figure, output)
