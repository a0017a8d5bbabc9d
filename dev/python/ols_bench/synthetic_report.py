"""The synthetic benchmark's figures as Markdown, JSON and plots."""

import json
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from ols_bench.style import BOUND, FAINT, OURS, PAPER, TRUTH, pyplot
from ols_bench.synthetic import HIDDEN_SWEEPS, REACQUIRED_IN_S
from ols_bench.tables import finite, table, text

# Sweep -> what it varies, and whether on a logarithmic axis.
PROPERTIES = {
    "size": ("target's width [px]", True),
    "contrast": ("peak contrast [σ of pixel noise]", True),
    "blur": ("lens blur, sd [px]", False),
    "speed": ("speed in the image [px/s]", False),
    "growth": ("growth of the target [1/s]", False),
}
CAMERA = {
    "pan_woods": ("pan [°/s], woods, image only", False),
    "pan_woods_ptu": ("pan [°/s], woods, angles given", False),
    "pan_clouds_ptu": ("pan [°/s], clouds, angles given", False),
    "slew_blank": ("pan [°/s], blank sky, angles given", False),
    "swing_blank": ("to and fro [°/s], blank sky, angles given", False),
    "swing_blank_alone": ("to and fro [°/s], blank sky, image only", False),
}
EVENTS = {
    "occlusion_blank": ("speed [px/s], hidden 1 s, blank sky", False),
    "occlusion_clouds": ("speed [px/s], hidden 1 s, clouds", False),
    "occlusion_woods": ("speed [px/s], hidden 1 s, woods", False),
    "skyline": ("speed across the skyline [px/s]", False),
    "skyline_size": ("width, across the skyline [px]", True),
}
LIMIT_PX, LIMIT_BOUNDS, NEES_BAND = 0.2, 2.0, (0.7, 1.4)
# Where the limits above apply.
LEAST_WIDTH_PX, LEAST_CONTRAST = 8.0, 10.0


def judged(point: dict) -> bool:
    if point["sweep"] not in PROPERTIES or point["sweep"] == "growth":
        return False
    too_small = point["sweep"] == "size" and point["value"] < LEAST_WIDTH_PX
    too_faint = point["sweep"] == "contrast" and point["value"] < LEAST_CONTRAST
    return not too_small and not too_faint


def share_over(points: list[dict], sweeps: tuple, key: str, value: float | None = None) -> float:
    chosen = [p for p in points if p["sweep"] in sweeps and (value is None or p["value"] == value)]
    return float(np.mean([p[key] for p in chosen])) if chosen else np.nan


def summary(points: list[dict]) -> list[tuple[str, str, str]]:
    """What is asked, what was measured, the limit."""
    good = [p for p in points if judged(p)]
    rows = []
    if good:
        rms = [value for p in good for value in p["rms_px"]]
        ratio = [value for p in good for value in p["over_bound"]]
        nees = [value for p in good for value in p["nees"]]
        inside = np.mean([NEES_BAND[0] <= value <= NEES_BAND[1] for value in nees])
        rows = [
            ("RMS error, worst point and axis", f"{max(rms):.3f} px", "≤ 0.2 px"),
            ("over the bound, worst", f"{max(ratio):.2f}", "≤ 2"),
            ("over the bound, median", f"{np.median(ratio):.2f}", ""),
            ("NEES per axis", f"{min(nees):.2f} to {max(nees):.2f}", "0.7 to 1.4"),
            ("points and axes inside that", f"{100 * inside:.0f} %", "100 %"),
        ]
    rows += [
        (
            "reacquired within 1 s after 1 s hidden",
            percent(share_over(points, HIDDEN_SWEEPS, "reacquired")),
            "≥ 90 %",
        ),
        (
            "blank sky, 20°/s, angles given: runs that keep lock",
            percent(share_over(points, ("slew_blank", "swing_blank"), "kept_lock", 20.0)),
            "≥ 95 %",
        ),
        (
            "across the skyline: runs that keep lock",
            percent(share_over(points, ("skyline", "skyline_size"), "kept_lock")),
            "",
        ),
    ]
    return rows


def percent(share: float) -> str:
    return "–" if np.isnan(share) else f"{100 * share:.0f} %"


def pair(values: list[float], form: str) -> str:
    return " / ".join(text(value, form) for value in values)


def point_table(points: list[dict]) -> str:
    columns = ["sweep", "value", "within 20 px", "keep lock", "RMS x / y [px]",
               "bound x / y [px]", "over bound", "NEES x / y", "reacquired ≤ 1 s"]  # fmt: skip
    rows = [
        [
            p["sweep"],
            f"{p['value']:g}",
            text(p["near"]),
            text(p["kept_lock"], ".2f"),
            pair(p["rms_px"], ".3f"),
            pair(p["bound_px"], ".3f"),
            pair(p["over_bound"], ".1f"),
            pair(p["nees"], ".2f"),
            text(p.get("reacquired"), ".2f"),
        ]
        for p in points
    ]
    return table(columns, rows)


def write(output: Path, points: list[dict], about: str) -> None:
    asked = table(["measure", "measured", "asked"], [list(row) for row in summary(points)])
    parts = ["# The tracker on synthetic images", about, asked, point_table(points)]
    (output / "synthetic.md").write_text("\n\n".join(parts) + "\n")
    (output / "synthetic.json").write_text(json.dumps(finite(points), indent=1) + "\n")


def plain_numbers(axes: Axes) -> None:
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())


def draw_errors(axes: Axes, rows: list[dict], logarithmic: bool) -> None:
    values = [p["value"] for p in rows]
    bound = np.array([np.sqrt(np.mean(np.square(p["bound_px"]))) for p in rows])
    axes.fill_between(values, bound, LIMIT_BOUNDS * bound, color=BOUND, alpha=0.13, linewidth=0)
    axes.plot(values, bound, color=BOUND, linewidth=1.4)
    axes.axhline(LIMIT_PX, color=FAINT, linewidth=1.0, linestyle=":")
    for axis, colour, marker in ((0, OURS, "o"), (1, PAPER, "s")):
        rms = [p["rms_px"][axis] for p in rows]
        axes.plot(values, rms, marker=marker, color=colour, markersize=4.5)
    plain_numbers(axes)
    if logarithmic:
        axes.set_xscale("log")
        axes.set_xticks(values, [f"{v:g}" for v in values], fontsize=8)
        axes.minorticks_off()


def draw_nees(axes: Axes, rows: list[dict], label: str) -> None:
    values = [p["value"] for p in rows]
    axes.axhspan(*NEES_BAND, color=TRUTH, alpha=0.15, linewidth=0)
    axes.axhline(1.0, color=TRUTH, linewidth=1.0)
    for axis, colour, marker in ((0, OURS, "o"), (1, PAPER, "s")):
        axes.plot(
            values, [p["nees"][axis] for p in rows], marker=marker, color=colour, markersize=4.5
        )
    plain_numbers(axes)
    axes.set_xlabel(label, fontsize=9)


def legend(figure) -> None:
    line, patch = pyplot.Line2D, pyplot.Rectangle
    handles = [
        line([], [], color=OURS, marker="o", markersize=4.5),
        line([], [], color=PAPER, marker="s", markersize=4.5),
        line([], [], color=BOUND, linewidth=1.4),
        patch((0, 0), 1, 1, color=BOUND, alpha=0.13),
        line([], [], color=FAINT, linewidth=1.0, linestyle=":"),
        patch((0, 0), 1, 1, color=TRUTH, alpha=0.25),
    ]
    names = ["x", "y", "Cramér–Rao bound", "up to twice the bound", "0.2 px", "NEES 0.7 to 1.4"]
    figure.legend(handles, names, loc="upper right", ncol=6, fontsize=9)


def draw_sweeps(path: Path, points: list[dict], sweeps: dict, title: str) -> None:
    sweeps = {name: how for name, how in sweeps.items() if any(p["sweep"] == name for p in points)}
    if not sweeps:
        return
    figure, axes = pyplot.subplots(
        2, len(sweeps), figsize=(3.3 * len(sweeps) + 0.8, 6.2), sharex="col", sharey="row",
        squeeze=False, height_ratios=(3, 2),
    )  # fmt: skip
    for column, (name, (label, logarithmic)) in enumerate(sweeps.items()):
        rows = sorted((p for p in points if p["sweep"] == name), key=lambda p: p["value"])
        draw_errors(axes[0, column], rows, logarithmic)
        draw_nees(axes[1, column], rows, label)
        axes[0, column].set_title(name.replace("_", " "))
    axes[0, 0].set_ylabel("RMS error [px]")
    axes[1, 0].set_ylabel("NEES per axis")
    figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    legend(figure)
    figure.tight_layout(rect=(0, 0, 1, 0.975))
    figure.savefig(path)
    pyplot.close(figure)


def draw_reacquisition(axes: Axes, points: list[dict]) -> None:
    for name, colour in zip(HIDDEN_SWEEPS, (OURS, PAPER, TRUTH), strict=True):
        times = sorted(t for p in points if p["sweep"] == name for t in p["reacquired_s"])
        if not times:
            continue
        share = np.arange(len(times) + 1) / len(times)
        seconds = [0.0, *times]
        kept = [k for k, t in enumerate(seconds) if t <= 1.5]
        x = [seconds[k] for k in kept] + [1.5]
        y = [share[k] for k in kept] + [share[kept[-1]]]
        label = f"{name.split('_')[1]}  {np.mean(np.array(times) <= REACQUIRED_IN_S):.2f}"
        axes.step(x, y, where="post", color=colour, label=label, linewidth=2.2)
    axes.axvline(REACQUIRED_IN_S, color=FAINT, linewidth=1.0, linestyle=":")
    axes.axhline(0.9, color=FAINT, linewidth=1.0, linestyle=":")
    axes.set_ylim(0, 1.03)
    axes.set_xlim(0, 1.5)
    axes.set_title("Found again after 1 s hidden")
    axes.set_xlabel("seconds since it came back")
    axes.set_ylabel("share of runs")
    axes.legend(title="within 1 s, before", loc="lower right", alignment="left")


def draw_lock(axes: Axes, points: list[dict]) -> None:
    names = [name for name in (*CAMERA, *EVENTS) if any(p["sweep"] == name for p in points)]
    for place, name in enumerate(reversed(names)):
        rows = sorted((p for p in points if p["sweep"] == name), key=lambda p: p["value"])
        for k, p in enumerate(rows):
            shade = pyplot.get_cmap("RdYlGn")(p["kept_lock"])
            axes.barh(place, 0.92, left=k, color=shade, height=0.8, alpha=0.6)
            axes.text(k + 0.45, place, f"{p['value']:g}: {100 * p['kept_lock']:.0f} %",
                      ha="center", va="center", fontsize=8)  # fmt: skip
    labels = [(CAMERA | EVENTS)[name][0] for name in reversed(names)]
    axes.set_yticks(range(len(names)), labels, fontsize=8)
    axes.tick_params(length=0)
    axes.set_xticks([])
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    axes.set_title("Runs that keep lock, at each point")


def draw_events(path: Path, points: list[dict]) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(14, 5.0), width_ratios=(1, 1.5))
    draw_reacquisition(left, points)
    draw_lock(right, points)
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)


def draw(output: Path, points: list[dict]) -> None:
    draw_sweeps(output / "precision.png", points, PROPERTIES, "Sub-pixel error and its consistency")
    draw_sweeps(output / "camera.png", points, CAMERA, "The same while the camera turns")
    draw_events(output / "events.png", points)
