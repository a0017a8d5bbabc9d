"""The plot of a run: truth, fixes and ellipses on the plan, and the error over time."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import ols
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from ols_demo.evaluate import JOINT, PAPER, covariance_matrix, errors_enu, solved
from ols_demo.places import geodetic
from ols_demo.recording import Recording

TRUTH, FIX, PAPER_COLOUR, STATION = "#222222", "#0b6fb8", "#d9822b", "#b3261e"
ELLIPSES = 30  # at most; more would hide the path
ENLARGED = 60.0
CHI2_95 = 5.991  # two axes


def site_frame(recording: Recording) -> ols.LocalFrame:
    """East-north-up at the mean of the stations."""
    places = [s[-1] for s in recording.statuses.values()]
    mean = np.mean([[p.latitude_deg, p.longitude_deg, p.height_m] for p in places], axis=0)
    return ols.LocalFrame(geodetic(*mean))


def enu(frame: ols.LocalFrame, positions: np.ndarray) -> np.ndarray:
    return np.array([frame.to_enu(np.asarray(p)) for p in positions]).reshape(-1, 3)


def draw_stations(axes: Axes, frame: ols.LocalFrame, recording: Recording) -> None:
    for station, statuses in sorted(recording.statuses.items()):
        last = statuses[-1]
        place = geodetic(last.latitude_deg, last.longitude_deg, last.height_m)
        east, north, _ = frame.to_enu(ols.ecef_from_geodetic(place))
        axes.plot(east, north, "^", color=STATION, markersize=9)
        axes.annotate(station, (east, north), (6, 6), textcoords="offset points", color=STATION)


def draw_ellipses(
    axes: Axes, recording: Recording, indices: list[int], places: np.ndarray, scale: float
) -> None:
    every = max(1, len(indices) // ELLIPSES)
    for place, i in list(zip(places, indices, strict=True))[::every]:
        target = recording.targets[JOINT][i]
        horizontal = covariance_matrix(target.position_covariance_enu_m2)[:2, :2]
        values, vectors = np.linalg.eigh(horizontal)
        width, height = 2 * scale * np.sqrt(CHI2_95 * values)
        angle = np.degrees(np.arctan2(vectors[1, 0], vectors[0, 0]))
        axes.add_patch(
            Ellipse(place[:2], width, height, angle=angle, fill=False, color=FIX, alpha=0.5)
        )


def draw_plan(axes: Axes, recording: Recording, window: tuple[int, int]) -> None:
    frame = site_frame(recording)
    truth = [t for t in recording.truth if window[0] <= t.utime <= window[1]]
    path = enu(frame, np.array([t.position_ecef_m for t in truth]))
    indices = solved(recording, JOINT, window)
    fixes = enu(frame, np.array([recording.targets[JOINT][i].position_ecef_m for i in indices]))
    axes.plot(path[:, 0], path[:, 1], "-", color=TRUTH, linewidth=1, label="truth", zorder=3)
    axes.plot(fixes[:, 0], fixes[:, 1], ".", color=FIX, markersize=3, label="fixes")
    draw_ellipses(axes, recording, indices, fixes, ENLARGED)
    draw_stations(axes, frame, recording)
    axes.plot(
        [],
        [],
        "o",
        fillstyle="none",
        color=FIX,
        label=f"95 % ellipses, {ENLARGED:.0f} times enlarged",
    )
    axes.set(xlabel="east, m", ylabel="north, m", title="Plan", aspect="equal")
    axes.margins(0.12)  # for the names
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3, fontsize=8)
    axes.grid(alpha=0.3)


def draw_errors(axes: Axes, recording: Recording, window: tuple[int, int]) -> None:
    for channel, colour, label in (
        (PAPER, PAPER_COLOUR, "the paper's Algorithm 1, moving average"),
        (JOINT, FIX, "filter"),
    ):
        indices = solved(recording, channel, window)
        if not indices:
            continue
        targets = [recording.targets[channel][i] for i in indices]
        seconds = np.array([(t.utime - window[0]) * 1e-6 for t in targets])
        distance = np.linalg.norm(errors_enu(recording, channel, indices), axis=1)
        axes.semilogy(seconds, distance, "-", color=colour, linewidth=1, label=label)
        if channel == JOINT:
            sd = [np.sqrt(sum(t.position_covariance_enu_m2[k] for k in (0, 3, 5))) for t in targets]
            axes.semilogy(seconds, sd, "--", color=FIX, label="its own prediction, 1 sigma")
    axes.set(xlabel="time, s", ylabel="error, m", title="Distance from the truth")
    axes.legend(fontsize=8)
    axes.grid(alpha=0.3, which="both")


def draw_axes(axes: list[Axes], recording: Recording, window: tuple[int, int]) -> None:
    indices = solved(recording, JOINT, window)
    targets = [recording.targets[JOINT][i] for i in indices]
    seconds = np.array([(t.utime - window[0]) * 1e-6 for t in targets])
    errors = errors_enu(recording, JOINT, indices)
    for axis, name, k, c in zip(axes, ("east", "north", "up"), range(3), (0, 3, 5), strict=True):
        sd = np.sqrt([t.position_covariance_enu_m2[c] for t in targets])
        axis.fill_between(seconds, -2 * sd, 2 * sd, color=FIX, alpha=0.15, label="2 sigma")
        axis.plot(seconds, errors[:, k], color=FIX, linewidth=1)
        axis.axhline(0, color=TRUTH, linewidth=0.6)
        axis.set(xlabel="time, s", ylabel="m", title=f"Error {name}")
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=8)


def labels(figure: Figure) -> str:
    """What is written on each of its parts, without what differs between runs."""
    texts = []
    for axes in figure.axes:
        legend = axes.get_legend()
        texts += [axes.get_title(), axes.get_xlabel(), axes.get_ylabel()]
        texts += [text.get_text() for text in legend.get_texts()] if legend else []
    return "\n".join(texts)


def save(path: Path, recording: Recording, window: tuple[int, int], title: str) -> None:
    """Writes the plot, a PNG file with its labels in the description."""
    figure = plt.figure(figsize=(14, 9), layout="constrained")
    grid = figure.add_gridspec(3, 4)
    draw_plan(figure.add_subplot(grid[:2, :2]), recording, window)
    draw_errors(figure.add_subplot(grid[:2, 2:]), recording, window)
    below = grid[2, :].subgridspec(1, 3)
    draw_axes([figure.add_subplot(below[k]) for k in range(3)], recording, window)
    figure.suptitle(title)
    figure.savefig(path, dpi=110, metadata={"Description": labels(figure)})
    plt.close(figure)
