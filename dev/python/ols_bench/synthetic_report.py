"""The synthetic benchmark's figures as Markdown and JSON."""

import json
from pathlib import Path

import numpy as np

from ols_bench.markdown import table
from ols_bench.synthetic import HIDDEN_SWEEPS
from ols_bench.tables import finite, text

# The sweeps that the limits below judge.
PROPERTIES = ("size", "contrast", "blur", "speed")
NEES_BAND = (0.7, 1.4)
# Where the limits above apply.
LEAST_WIDTH_PX, LEAST_CONTRAST = 8.0, 10.0


def judged(point: dict) -> bool:
    if point["sweep"] not in PROPERTIES:
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
