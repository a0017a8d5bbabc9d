"""How good boxes are. Conventions are those of the usual benchmarks.

The first frame is given to the tracker and not judged. Where the target is visible: overlap
(intersection over union; a missing box counts 0) and distance of the centres (a missing box counts
as infinitely far). Where it is absent: whether a box was believed in. What has no belief is taken
at its word. Figures of a folder are plain means over its clips.
"""

from dataclasses import dataclass

import numpy as np

from ols_bench.clips import Boxes, Clip

NEAR_PX = 20.0  # "on target"
LOCK_SHARE = 0.9
BELIEVED = 0.5


def overlap(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Intersection over union, row by row; 0 where a box is missing."""
    corner = np.maximum(a[:, :2], b[:, :2])
    far = np.minimum(a[:, :2] + a[:, 2:], b[:, :2] + b[:, 2:])
    common = np.prod(np.maximum(far - corner, 0.0), axis=1)
    union = np.prod(a[:, 2:], axis=1) + np.prod(b[:, 2:], axis=1) - common
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.nan_to_num(np.where(union > 0, np.minimum(common / union, 1.0), 0.0), nan=0.0)


def distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of the centres [px], row by row; infinite where a box is missing."""
    between = a[:, :2] + a[:, 2:] / 2 - b[:, :2] - b[:, 2:] / 2
    return np.nan_to_num(np.hypot(between[:, 0], between[:, 1]), nan=np.inf)


@dataclass
class Judged:
    """A clip's frames after the first one, and what the tracker made of them."""

    name: str
    visible: np.ndarray
    overlap: np.ndarray
    distance: np.ndarray
    has_box: np.ndarray
    belief: np.ndarray | None
    step: np.ndarray  # [px] from the box of the frame before
    frames_per_second: float

    @property
    def on_target(self) -> np.ndarray:
        return self.visible & (self.distance <= NEAR_PX)

    @property
    def believed(self) -> np.ndarray:
        return self.has_box if self.belief is None else self.has_box & (self.belief >= BELIEVED)


def judge(clip: Clip, boxes: Boxes, frames_per_second: float) -> Judged:
    rest = slice(clip.first + 1, None)
    truth, ours = clip.truth.xywh[rest], boxes.xywh[rest]
    return Judged(
        name=clip.name,
        visible=clip.truth.there[rest],
        overlap=overlap(ours, truth),
        distance=distance(ours, truth),
        has_box=boxes.there[rest],
        belief=None if boxes.belief is None else boxes.belief[rest],
        step=distance(boxes.xywh[clip.first : -1], ours),
        frames_per_second=frames_per_second,
    )


def clip_measures(judged: Judged) -> dict:
    over, far = judged.overlap[judged.visible], judged.distance[judged.visible]
    absent = int((~judged.visible).sum())
    near = float((far <= NEAR_PX).mean())
    return {
        "frames": len(over),
        "missing": int((~judged.has_box[judged.visible]).sum()),
        "iou": float(over.mean()),
        "auc": float(np.mean([(over > limit).mean() for limit in np.arange(21) / 20])),
        "p20": near,
        "p5": float((far <= 5.0).mean()),
        "centre": float(np.median(far)),
        "lock": near > LOCK_SHARE,
        "absent": absent,
        "false_belief": (
            float(judged.believed[~judged.visible].sum() / absent) if absent else None
        ),
    }


def folder_measures(clips: dict[str, dict]) -> dict:
    def mean(key: str) -> float:
        return float(np.mean([clip[key] for clip in clips.values()]))

    absent = sum(clip["absent"] for clip in clips.values())
    believed = sum(
        clip["absent"] * clip["false_belief"] for clip in clips.values() if clip["absent"]
    )
    return {
        "clips": len(clips),
        "frames": sum(clip["frames"] for clip in clips.values()),
        "missing": sum(clip["missing"] for clip in clips.values()),
        **{key: mean(key) for key in ("iou", "auc", "p20", "p5", "lock")},
        "centre": float(np.median([clip["centre"] for clip in clips.values()])),
        "absent": absent,
        "false_belief": believed / absent if absent else None,
    }
