"""All trackers' figures, from what they wrote."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ols_bench.absence import absence_measures
from ols_bench.belief import belief_measures
from ols_bench.clips import Clip, read_boxes
from ols_bench.measures import Judged, clip_measures, folder_measures, judge
from ols_bench.places import places_of, read_times

ALL = "all clips"


@dataclass
class Speed:
    """Of all frames tracked."""

    milliseconds: np.ndarray
    stages: dict[str, np.ndarray]

    def figures(self) -> dict:
        total_s = self.milliseconds.sum() / 1e3
        return {
            "frames_per_second": float(len(self.milliseconds) / total_s),
            "mean_ms": float(self.milliseconds.mean()),
            "median_ms": float(np.median(self.milliseconds)),
            "p99_ms": float(np.percentile(self.milliseconds, 99)),
            "stages_ms": {name: float(values.mean()) for name, values in self.stages.items()},
        }


@dataclass
class Result:
    """One tracker on one folder, or on all of them, with one seed."""

    judged: list[Judged]
    speed: Speed
    repeats: list["Result"] = field(default_factory=list)  # with the further seeds
    clips: dict[str, dict] = field(init=False)
    total: dict = field(init=False)
    belief: dict | None = field(init=False)
    absence: dict = field(init=False)

    def __post_init__(self) -> None:
        self.clips = {j.name: clip_measures(j) for j in self.judged}
        self.total = folder_measures(self.clips)
        self.belief = belief_measures(self.judged)
        self.absence = absence_measures(self.judged)

    def as_json(self) -> dict:
        return {
            "total": self.total,
            "belief": self.belief,
            "absence": self.absence,
            "seeds": spread([self, *self.repeats]),
            "speed": self.speed.figures(),
            "clips": self.clips,
        }


# Name, and where the figure is found.
SPREAD = {
    "iou": lambda r: r.total["iou"],
    "p20": lambda r: r.total["p20"],
    "lock": lambda r: r.total["lock"],
    "auroc": lambda r: r.belief and r.belief["auroc"],
    "off_target_believed": lambda r: r.belief and r.belief["off_target_believed"],
    "calibration_error": lambda r: r.belief and r.belief["calibration_error"],
    "late_absent_believed": lambda r: r.absence["late_absent_believed"],
    "found_again_in_time": lambda r: r.absence["found_again_in_time"],
}


def spread(results: list[Result]) -> dict[str, dict | None]:
    """Mean, least and greatest of each figure over the seeds; nothing where one has none."""
    rows = {}
    for name, figure in SPREAD.items():
        values = [figure(result) for result in results]
        all_known = None not in values
        kinds = {"mean": np.mean, "least": min, "greatest": max}
        rows[name] = {k: float(of(values)) for k, of in kinds.items()} if all_known else None
    return rows


def joined(times: list[dict[str, np.ndarray]]) -> Speed:
    stages = [name for name in times[0] if name != "total_ms"]
    return Speed(
        np.concatenate([t["total_ms"] for t in times]),
        {name.removesuffix("_ms"): np.concatenate([t[name] for t in times]) for name in stages},
    )


def results_of(
    output: Path,
    tracker: str,
    folders: dict[str, list[Clip]],
    rates: dict[Path, float],
    together: list[str],
    seed: int | None = None,
) -> dict[str, Result]:
    """By folder; where several are to be taken together, also of all of their clips."""
    found = {}
    every_judged, every_time = [], []
    for folder, clips in folders.items():
        judged, times = [], []
        for clip in clips:
            places = places_of(output, tracker, folder, clip, seed)
            judged.append(judge(clip, read_boxes(places.boxes, clip.frames), rates[clip.path]))
            times.append(read_times(places.times))
        found[folder] = Result(judged, joined(times))
        if folder in together:
            every_judged += judged
            every_time += times
    if len(together) > 1:
        found[ALL] = Result(every_judged, joined(every_time))
    return found


def with_repeats(first: dict[str, Result], others: list[dict[str, Result]]) -> dict[str, Result]:
    for folder, result in first.items():
        result.repeats = [other[folder] for other in others]
    return first
