"""Success and precision, belief, and where the time goes, as PNG."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from ols_bench.measures import DISTANCES, NEAR_PX, OVERLAPS, precision_curve, success_curve
from ols_bench.results import ALL, Result
from ols_bench.style import COLOURS, FAINT, INK, pyplot
from ols_bench.tables import Results

OUR_TRACKERS = ("ours (full)", "ours (paper)")


def main_folder(results: Results) -> str:
    """All clips together, where there are several folders; otherwise the first one."""
    folders = list(next(iter(results.values())))
    return ALL if ALL in folders else folders[0]


def line_style(tracker: str) -> dict:
    ours = tracker in OUR_TRACKERS
    return {
        "color": COLOURS[tracker],
        "linewidth": 2.6 if ours else 1.5,
        "linestyle": "-" if ours else (0, (5, 1.6)),
        "zorder": 4 if ours else 3,
    }


def curves(axes: Axes, x: np.ndarray, lines: dict[str, np.ndarray], scores: dict) -> None:
    for tracker in sorted(lines, key=lambda name: -scores[name]):
        label = f"{tracker}  {scores[tracker]:.3f}"
        axes.plot(x, lines[tracker], label=label, **line_style(tracker))
    axes.set_ylim(0.0, 1.02)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylabel("share of frames, mean over clips")


def draw_success_and_precision(path: Path, results: Results, folder: str) -> None:
    judged = {tracker: by[folder].judged for tracker, by in results.items()}
    totals = {tracker: by[folder].total for tracker, by in results.items()}
    figure, (success, precision) = pyplot.subplots(1, 2, figsize=(11.5, 4.8))
    curves(
        success,
        OVERLAPS,
        {tracker: success_curve(j) for tracker, j in judged.items()},
        {tracker: total["iou"] for tracker, total in totals.items()},
    )
    success.set_title("Success")
    success.set_xlabel("overlap with the truth greater than")
    success.legend(title="mean overlap", loc="upper right", alignment="left")
    curves(
        precision,
        DISTANCES,
        {tracker: precision_curve(j) for tracker, j in judged.items()},
        {tracker: total["p20"] for tracker, total in totals.items()},
    )
    precision.axvline(NEAR_PX, color=FAINT, linewidth=1.0, linestyle=":")
    precision.set_title("Precision")
    precision.set_xlabel("centre within [px]")
    precision.legend(title="within 20 px", loc="lower right", alignment="left")
    clips = next(iter(totals.values()))["clips"]
    figure.suptitle(f"{folder}, {clips} clips", x=0.01, ha="left", color=FAINT, fontsize=10)
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)


def draw_reliability(axes: Axes, counts: Axes, tracker: str, result: Result) -> None:
    rows = result.belief["reliability"]
    colour = COLOURS[tracker]
    belief, share = ([row[key] for row in rows] for key in ("belief", "on_target"))
    auroc = result.belief["auroc"]
    label = f"{tracker}   error {result.belief['calibration_error']:.3f}"
    label += f", AUROC {auroc:.3f}" if auroc is not None else ""
    axes.plot(belief, share, "o-", color=colour, label=label, markersize=6)
    offset = 0.021 * (1 if tracker == OUR_TRACKERS[0] else -1)
    counts.bar(
        [min(int(10 * b), 9) / 10 + 0.05 - offset for b in belief],
        [row["frames"] for row in rows],
        width=0.04,
        color=colour,
    )


def draw_belief(path: Path, results: Results, folder: str) -> None:
    figure, (axes, counts) = pyplot.subplots(
        2, 1, figsize=(6.4, 7.2), sharex=True, height_ratios=(3, 1)
    )
    axes.plot((0, 1), (0, 1), color=FAINT, linewidth=1.0, linestyle=":")
    axes.annotate(
        "as it says",
        (0.5, 0.5),
        (4, -13),
        textcoords="offset points",
        color=FAINT,
        rotation=45,
        rotation_mode="anchor",
        fontsize=9,
    )
    for tracker in OUR_TRACKERS:
        if tracker in results and results[tracker][folder].belief:
            draw_reliability(axes, counts, tracker, results[tracker][folder])
    axes.set_title("Is the target where the belief says?")
    axes.set_ylabel("share of frames on target")
    axes.set_ylim(-0.02, 1.02)
    axes.legend(loc="upper left")
    counts.set_yscale("log")
    counts.set_ylabel("frames")
    counts.set_xlabel("belief")
    counts.set_xlim(0, 1)
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)


def draw_time(path: Path, results: Results, folder: str) -> None:
    speeds = {tracker: by[folder].speed.figures() for tracker, by in results.items()}
    order = sorted(speeds, key=lambda name: -speeds[name]["mean_ms"])
    stages = list(dict.fromkeys(s for f in speeds.values() for s in f["stages_ms"]))
    shades = pyplot.get_cmap("viridis")(np.linspace(0.08, 0.95, max(len(stages), 1)))
    figure, axes = pyplot.subplots(figsize=(9.5, 0.55 * len(order) + 2.2))
    for place, tracker in enumerate(order):
        left = 0.0
        for stage, shade in zip(stages, shades, strict=False):
            width = speeds[tracker]["stages_ms"].get(stage, 0.0)
            axes.barh(place, width, left=left, color=shade, height=0.62)
            left += width
        rest = speeds[tracker]["mean_ms"] - left
        axes.barh(place, rest, left=left, color="#c9c9c9", height=0.62)
        axes.annotate(
            f"{speeds[tracker]['mean_ms']:.2f} ms, {speeds[tracker]['frames_per_second']:.0f}/s",
            (speeds[tracker]["mean_ms"], place),
            (6, 0),
            textcoords="offset points",
            va="center",
            color=INK,
            fontsize=9,
        )
    axes.set_yticks(range(len(order)), order, color=INK)
    axes.set_xlabel("processor time per frame [ms], mean")
    axes.set_xlim(0, 1.2 * max(f["mean_ms"] for f in speeds.values()))
    axes.grid(axis="y", visible=False)
    for stage, shade in zip(stages, shades, strict=False):
        axes.barh(0, 0, color=shade, label=stage.replace("_", " "))
    if stages:
        axes.legend(loc="upper right", ncol=2, fontsize=9)
    axes.set_title("Where a frame's time goes")
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)


def draw(output: Path, results: Results) -> None:
    folder = main_folder(results)
    draw_success_and_precision(output / "success_precision.png", results, folder)
    draw_belief(output / "belief.png", results, folder)
    draw_time(output / "time.png", results, folder)
