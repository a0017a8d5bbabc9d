"""The figures as Markdown and JSON."""

import json
from pathlib import Path

import numpy as np

from ols_bench.markdown import table
from ols_bench.results import ALL, Result, spread

Results = dict[str, dict[str, Result]]  # tracker, folder

COLUMNS = (
    "tracker",
    "mean IoU",
    "AUC",
    "within 20 px",
    "within 5 px",
    "kept lock",
    "frames/s",
    "ms median",
    "ms p99",
    "× CSRT",
)
BELIEF_COLUMNS = (
    "tracker",
    "off target, believed in",
    "AUROC",
    "calibration error",
    "absent, believed in",
    "after the tenth frame",
    "of a target followed on",
    "losses",
    "noticed ≤ 0.33 s",
    "median",
    "found again ≤ 0.5 s",
)
SEED_COLUMNS = {
    "mean IoU": "iou",
    "within 20 px": "p20",
    "kept lock": "lock",
    "AUROC": "auroc",
    "off target, believed in": "off_target_believed",
    "calibration error": "calibration_error",
    "absent after the tenth frame, believed in": "late_absent_believed",
    "found again ≤ 0.5 s": "found_again_in_time",
}


def text(value: float | None, form: str = ".3f") -> str:
    return "–" if value is None or not np.isfinite(value) else format(value, form)


def accuracy_row(name: str, result: Result, reference: Result | None) -> list[str]:
    total, speed = result.total, result.speed.figures()
    ratio = None
    if reference:
        ratio = speed["frames_per_second"] / reference.speed.figures()["frames_per_second"]
    kept = round(total["lock"] * total["clips"])
    return [
        name,
        *(text(total[key]) for key in ("iou", "auc", "p20", "p5")),
        f"{kept} of {total['clips']}",
        text(speed["frames_per_second"], ".0f"),
        text(speed["median_ms"], ".2f"),
        text(speed["p99_ms"], ".2f"),
        text(ratio, ".1f"),
    ]


def belief_cells(measures: dict) -> list[str]:
    return [text(measures[key]) for key in ("off_target_believed", "auroc", "calibration_error")]


def loss_cells(measures: dict) -> list[str]:
    median = measures["noticed_median_s"]
    never = "never" if measures["losses"] else "–"
    return [
        str(measures["losses"]),
        text(measures["noticed_in_time"], ".2f"),
        never if median is None else f"{median:.2f} s",
    ]


def found_again(absence: dict) -> str:
    if not absence["returns"]:
        return "–"
    return f"{text(absence['found_again_in_time'], '.2f')} of {absence['returns']}"


def belief_rows(name: str, result: Result) -> list[list[str]]:
    """By the labels, and, where they end before what they label, with that in the count."""
    belief, absence = result.belief, result.absence
    believed = text(result.total["false_belief"])
    found = found_again(absence)
    if belief is None:
        return [[name, *["–"] * 3, believed, *["–"] * 5, found]]
    followed_on = belief["followed_on"]
    away = [believed, text(absence["late_absent_believed"]), text(followed_on)]
    rows = [[name, *belief_cells(belief), *away, *loss_cells(belief), found]]
    if followed_on:
        on_other = text(result.total["false_belief"] - followed_on)
        other = belief["with_followed_on"]
        cells = [*belief_cells(other), on_other, "–", "–", *loss_cells(other), "–"]
        rows.append([f"{name}, followed on", *cells])
    cells = [*belief_cells(belief["with_covering"]), *["–"] * 3]
    rows.append([f"{name}, or half covered", *cells, *loss_cells(belief["with_covering"]), "–"])
    return rows


def seed_cell(figures: dict | None) -> str:
    if figures is None:
        return "–"
    return f"{figures['mean']:.3f} ({figures['least']:.3f} to {figures['greatest']:.3f})"


def seed_table(results: Results, folder: str) -> str:
    """Mean, least and greatest over the seeds, of the trackers that ran with several."""
    rows = []
    for name, by_folder in results.items():
        result = by_folder[folder]
        if result.repeats:
            figures = spread([result, *result.repeats])
            rows.append([name, *(seed_cell(figures[key]) for key in SEED_COLUMNS.values())])
    return table(["mean (least to greatest)", *SEED_COLUMNS], rows)


def stage_table(results: Results, folder: str) -> str:
    """Mean milliseconds a frame of each stage, of the trackers that know theirs."""
    known = {t: r[folder].speed.figures() for t, r in results.items() if r[folder].speed.stages}
    stages = list(dict.fromkeys(s for figures in known.values() for s in figures["stages_ms"]))
    rows = [
        [name, *(text(figures["stages_ms"].get(s), ".2f") for s in stages)]
        + [text(figures["mean_ms"], ".2f")]
        for name, figures in known.items()
    ]
    return table(["ms per frame, mean", *(s.replace("_", " ") for s in stages), "all"], rows)


def clip_table(results: Results, folder: str) -> str:
    of = [by_folder[folder].clips for by_folder in results.values()]
    rows = [[clip, *(clip_cell(clips[clip]) for clips in of)] for clip in of[0]]
    return table(["within 20 px", *results], rows)


def clip_cell(figures: dict) -> str:
    bold = "" if figures["lock"] else "**"
    return bold + text(figures["p20"], ".2f") + bold


def markdown(results: Results, about: str) -> str:
    parts = ["# Trackers on clips with ground truth", about]
    any_result = next(iter(results.values()))
    for folder in any_result:
        parts.append(f"## {folder}")
        total = any_result[folder].total
        parts.append(
            f"{total['clips']} clips, {total['frames']} frames with and {total['absent']} without "
            "the target."
        )
        reference = results["CSRT"][folder] if "CSRT" in results else None
        rows = [accuracy_row(t, by[folder], reference) for t, by in results.items()]
        parts.append(table(COLUMNS, rows))
        rows = [row for t, by in results.items() for row in belief_rows(t, by[folder])]
        parts.append(table(BELIEF_COLUMNS, rows))
        if any(by[folder].repeats for by in results.values()):
            parts.append(seed_table(results, folder))
        if any(by[folder].speed.stages for by in results.values()):
            parts.append(stage_table(results, folder))
        if folder != ALL:
            parts.append("Clip by clip; **bold** where lock was lost:")
            parts.append(clip_table(results, folder))
    return "\n\n".join(parts) + "\n"


def finite(value):
    """The same with infinities as null, for JSON."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def write(output: Path, results: Results, about: str) -> None:
    (output / "tracking.md").write_text(markdown(results, about))
    figures = {t: {f: r.as_json() for f, r in by.items()} for t, by in results.items()}
    (output / "tracking.json").write_text(json.dumps(finite(figures), indent=1) + "\n")
