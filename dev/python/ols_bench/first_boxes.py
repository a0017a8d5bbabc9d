"""tools/bench first-boxes: one or two versions of ols-track, from five first boxes each.

One pixel of the first box decides whether a whole clip is kept, so a single run shows nothing.
Each clip is tracked from its true first box, and from that box one pixel to the right, to the
left, further down and further up. A clip's figures are means over the five; the standard error is
that of the mean over clips, and of the difference from the first program clip by clip.
Results that are there and newer than their program are not made again.
"""

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ols_bench.belief import belief_measures
from ols_bench.clips import BadInput, Clip, read_boxes, read_folder
from ols_bench.markdown import table
from ols_bench.measures import Judged, clip_measures, judge
from ols_bench.pictures import frames_per_second
from ols_bench.places import places_of
from ols_bench.tables import text
from ols_bench.trackers import run_ours
from ols_bench.variants import PICTURES, variant

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/bin/ols-track"
STEPS = {"exact": (0, 0), "right": (1, 0), "left": (-1, 0), "down": (0, 1), "up": (0, -1)}  # [px]
TOGETHER = "all clips"
COLUMNS = ("", "clips", "kept lock", "within 20 px", "IoU", "off target, believed in", "AUROC")


@dataclass
class Run:
    """A version of the program, on a clip of a folder, from one of the first boxes."""

    version: str
    program: Path
    folder: str
    clip: Clip
    step: str

    def judged(self, output: Path) -> Judged:
        places = places_of(output / self.step, self.version, self.folder, self.clip)
        newest = self.program.stat().st_mtime
        if not places.complete() or places.boxes.stat().st_mtime < newest:
            start = moved(self.clip, STEPS[self.step])
            run_ours("ours (full)", start, places, 1, self.program, None)
        boxes = read_boxes(places.boxes, self.clip.frames)
        return judge(self.clip, boxes, frames_per_second(self.clip))


@dataclass
class Figures:
    """By clip, each the mean over the first boxes."""

    lock: np.ndarray
    p20: np.ndarray
    iou: np.ndarray
    off_target_believed: float
    auroc: float


def moved(clip: Clip, step: tuple[int, int]) -> Clip:
    return Clip(clip.path, clip.truth, np.array(clip.first_box) + [*step, 0, 0])


def figures(judged: dict[str, list[Judged]]) -> Figures:
    """`judged`: of each first box, the clips."""
    measures = [[clip_measures(clip) for clip in clips] for clips in judged.values()]
    belief = [belief_measures(clips) for clips in judged.values()]

    def by_clip(key: str) -> np.ndarray:
        return np.array([[clip[key] for clip in clips] for clips in measures], float).mean(axis=0)

    def over_boxes(key: str) -> float:
        return float(np.mean([np.nan if one[key] is None else one[key] for one in belief]))

    return Figures(
        *(by_clip(key) for key in ("lock", "p20", "iou")),
        *(over_boxes(key) for key in ("off_target_believed", "auroc")),
    )


def mean_and_error(values: np.ndarray, form: str) -> str:
    error = values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan
    return f"{values.mean():{form}} ± {error:.3f}"


def rows(by_version: dict[str, Figures]) -> list[list[str]]:
    (_, base), *_ = by_version.items()
    made = []
    for name, of in by_version.items():
        cells = [mean_and_error(values, ".3f") for values in (of.lock, of.p20, of.iou)]
        cells[0] = f"{of.lock.sum():.1f} ({cells[0]})"
        made.append([name, str(len(of.p20)), *cells, text(of.off_target_believed), text(of.auroc)])
        if of is not base:
            pairs = ((of.lock, base.lock), (of.p20, base.p20), (of.iou, base.iou))
            gains = [mean_and_error(new - old, "+.3f") for new, old in pairs]
            belief = (of.off_target_believed - base.off_target_believed, of.auroc - base.auroc)
            made.append(["difference", "", *gains, *(text(value, "+.3f") for value in belief)])
    return made


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/bench first-boxes", description=__doc__)
    parser.add_argument("clips", type=Path, nargs="+", metavar="CLIPS", help="folders of clips")
    parser.add_argument(
        "--variant", choices=tuple(PICTURES), help="of clips made of the given ones instead"
    )
    parser.add_argument("--program", type=Path, default=PROGRAM, help="ols-track")
    parser.add_argument("--beside", type=Path, help="the version that it is compared with")
    parser.add_argument("--output", type=Path, default=ROOT / "out/first-boxes")
    parser.add_argument("--jobs", type=int, default=1, help="processes at once")
    return parser.parse_args()


def folders_of(given: argparse.Namespace) -> dict[str, list[Clip]]:
    folders = {path.resolve().name: read_folder(path) for path in given.clips}
    if not given.variant:
        return folders
    made = {}
    for folder, clips in folders.items():
        name = f"{folder}-{given.variant}"
        made[name] = variant(given.variant, clips, given.output / "clips" / name)
    return made


def versions_of(given: argparse.Namespace) -> dict[str, Path]:
    before = {"before": given.beside} if given.beside else {}
    return before | {"new": given.program}


def bench(given: argparse.Namespace) -> None:
    folders, versions = folders_of(given), versions_of(given)
    runs = [
        Run(version, program, folder, clip, step)
        for folder, clips in folders.items()
        for clip in clips
        for version, program in versions.items()
        for step in STEPS
    ]
    judged: dict[tuple, list[Judged]] = {}
    with ThreadPoolExecutor(given.jobs) as pool:
        for run, result in zip(runs, pool.map(lambda r: r.judged(given.output), runs), strict=True):
            for title in (run.folder, TOGETHER):
                judged.setdefault((title, run.version, run.step), []).append(result)
    for title in [*folders, *([TOGETHER] if len(folders) > 1 else [])]:
        of = {v: figures({s: judged[title, v, s] for s in STEPS}) for v in versions}
        print(f"\n## {title}\n\n{table(COLUMNS, rows(of))}", flush=True)


def main() -> None:
    try:
        bench(arguments())
    except (BadInput, OSError) as error:
        sys.exit(f"tools/bench first-boxes: {error}")


if __name__ == "__main__":
    main()
