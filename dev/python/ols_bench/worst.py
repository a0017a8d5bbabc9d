"""A contact sheet of a tracker's worst moments: where it was surest while it was most wrong."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from ols_bench.clips import Clip, read_boxes
from ols_bench.measures import NEAR_PX, Judged
from ols_bench.pictures import pictures
from ols_bench.places import places_of
from ols_bench.results import Result
from ols_bench.style import FAINT, TRUTH, pyplot

TILES = 12
COLUMNS = 4
FAR_PX = 200.0  # what is farther is no worse
OUR_BOX = "#ff9d2e"


@dataclass
class Moment:
    clip: Clip
    frame: int
    severity: float
    text: str
    truth: np.ndarray  # x, y, w, h; nan when absent
    ours: np.ndarray


def severity(judged: Judged) -> np.ndarray:
    """0..1.25 of each judged frame."""
    wrong = np.minimum(judged.distance, FAR_PX) / FAR_PX
    # On target, a box of the wrong size is a small fault.
    loose = (1.0 - judged.overlap) * NEAR_PX / FAR_PX
    seen = np.where(judged.distance <= NEAR_PX, loose, np.maximum(wrong, loose))
    unseen = np.where(judged.believed, 1.0, 0.0)
    sure = judged.belief if judged.belief is not None else np.ones_like(wrong)
    return np.where(judged.visible, seen, unseen) * (0.25 + sure)


def describe(judged: Judged, k: int) -> str:
    sure = f"belief {judged.belief[k]:.2f}"
    if not judged.visible[k]:
        return f"target absent, {sure}"
    if not judged.has_box[k]:
        return f"no box, {sure}"
    return f"off by {judged.distance[k]:.0f} px, overlap {judged.overlap[k]:.2f}, {sure}"


def worst_moments(
    output: Path, tracker: str, folders: dict[str, list[Clip]], results: dict[str, Result]
) -> list[Moment]:
    """The worst one of each clip, the worst first."""
    moments = []
    for folder, clips in folders.items():
        for clip, judged in zip(clips, results[folder].judged, strict=True):
            level = severity(judged)
            k = int(np.argmax(level))
            frame = clip.first + 1 + k
            boxes = read_boxes(places_of(output, tracker, folder, clip).boxes, clip.frames)
            moments.append(
                Moment(
                    clip,
                    frame,
                    float(level[k]),
                    describe(judged, k),
                    clip.truth.xywh[frame],
                    boxes.xywh[frame],
                )
            )
    return sorted(moments, key=lambda moment: -moment.severity)[:TILES]


def picture_of(moment: Moment) -> np.ndarray:
    for frame, picture in enumerate(pictures(moment.clip)):
        if frame == moment.frame:
            return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)
    raise ValueError(f"{moment.clip.path}: ends before frame {moment.frame}")


def window(moment: Moment, size: tuple[int, int]) -> tuple[float, float, float]:
    """Corner and side of a square with both boxes and what is around them."""
    boxes = [box for box in (moment.truth, moment.ours) if np.isfinite(box).all()]
    if not boxes:
        return 0.0, 0.0, float(min(size))
    low = np.min([box[:2] for box in boxes], axis=0)
    high = np.max([box[:2] + box[2:] for box in boxes], axis=0)
    side = min(
        max(64.0, 1.35 * float((high - low).max()), 4.0 * max(b[2:].max() for b in boxes)),
        float(min(size)),
    )
    x, y = (low + high) / 2 - side / 2
    return min(max(x, 0.0), size[0] - side), min(max(y, 0.0), size[1] - side), side


def draw_box(axes: Axes, box: np.ndarray, colour: str) -> None:
    if np.isfinite(box).all():
        # Pixel (0, 0) is drawn from -0.5 to 0.5.
        corner = (box[0] - 0.5, box[1] - 0.5)
        axes.add_patch(
            Rectangle(
                corner, box[2], box[3], fill=False, edgecolor="black", linewidth=3.2, alpha=0.5
            )
        )
        axes.add_patch(
            Rectangle(corner, box[2], box[3], fill=False, edgecolor=colour, linewidth=1.8)
        )


def draw_tile(axes: Axes, moment: Moment) -> None:
    picture = picture_of(moment)
    size = (picture.shape[1], picture.shape[0])
    x, y, side = window(moment, size)
    axes.imshow(picture, interpolation="nearest")
    axes.set_xlim(x - 0.5, x + side - 0.5)
    axes.set_ylim(y + side - 0.5, y - 0.5)
    axes.set_axis_off()
    draw_box(axes, moment.truth, TRUTH)
    draw_box(axes, moment.ours, OUR_BOX)
    axes.set_title(f"{moment.clip.name}, frame {moment.frame}", fontsize=9.5, pad=18)
    axes.text(0.0, 1.015, moment.text, transform=axes.transAxes, fontsize=8, color=FAINT)
    axes.text(
        0.98,
        0.02,
        f"{side:.0f} px",
        transform=axes.transAxes,
        fontsize=7,
        color="white",
        ha="right",
        bbox={"facecolor": "black", "alpha": 0.45, "pad": 1.5, "linewidth": 0},
    )


def draw(
    output: Path, tracker: str, folders: dict[str, list[Clip]], results: dict[str, Result]
) -> None:
    moments = worst_moments(output, tracker, folders, results)
    rows = -(-len(moments) // COLUMNS)
    figure, axes = pyplot.subplots(
        rows, COLUMNS, figsize=(3.1 * COLUMNS, 3.55 * rows + 0.6), squeeze=False
    )
    for place in axes.flat:
        place.set_axis_off()
    for place, moment in zip(axes.flat, moments, strict=False):
        draw_tile(place, moment)
    figure.suptitle(
        f"The worst moment of the {len(moments)} worst clips, {tracker}",
        x=0.012,
        ha="left",
        fontweight="bold",
    )
    handles = [
        Rectangle((0, 0), 1, 1, fill=False, edgecolor=colour, linewidth=1.8)
        for colour in (TRUTH, OUR_BOX)
    ]
    figure.legend(handles, ["truth", "ours"], loc="upper right", ncol=2, frameon=False)
    figure.tight_layout(rect=(0, 0, 1, 0.985))
    figure.savefig(output / "worst.png")
    pyplot.close(figure)
