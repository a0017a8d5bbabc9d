"""Further clips made of given ones: do figures hold where nothing was tuned?"""

import zlib
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path

import cv2
import numpy as np

from ols_bench.clips import Clip, read_boxes, truth_path, write_boxes
from ols_bench.hiding import covered, erased
from ols_bench.pictures import frames_per_second, pictures, write_clip

Made = tuple[np.ndarray, Iterator[np.ndarray]]  # truth, pictures
SHIFT = 0.05  # of the box's size
SIZES = {"larger": 1.1, "smaller": 0.9}


def mirrored(clip: Clip) -> Made:
    width = next(pictures(clip)).shape[1]
    boxes = clip.truth.xywh.copy()
    boxes[:, 0] = width - boxes[:, 0] - boxes[:, 2]
    return boxes, (cv2.flip(picture, 1) for picture in pictures(clip))


def half(clip: Clip) -> Made:
    """Half as many pixels in each direction."""
    small = (
        cv2.resize(picture, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
        for picture in pictures(clip)
    )
    return clip.truth.xywh / 2, small


def alternate(clip: Clip) -> Made:
    """Every second frame."""
    return clip.truth.xywh[::2], islice(pictures(clip), 0, None, 2)


def backward(clip: Clip) -> Made:
    """From the last frame to the first: other first images, growth for shrinking."""
    shown = list(pictures(clip))
    return clip.truth.xywh[len(shown) - 1 :: -1], iter(shown[::-1])


def grey(clip: Clip) -> Made:
    """Without colours, as a thermal camera has it."""
    without_colours = (
        cv2.cvtColor(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY), cv2.COLOR_GRAY2BGR)
        for picture in pictures(clip)
    )
    return clip.truth.xywh, without_colours


def shifted(clip: Clip) -> np.ndarray:
    """The first box by a part of its size, to one of its corners."""
    x, y, w, h = clip.first_box
    corner = zlib.crc32(clip.name.encode()) % 4
    across, down = (1 if corner & 1 else -1), (1 if corner & 2 else -1)
    return np.array([x + across * SHIFT * w, y + down * SHIFT * h, w, h])


def resized(clip: Clip, size: float) -> np.ndarray:
    x, y, w, h = clip.first_box
    return np.array([x - (size - 1) * w / 2, y - (size - 1) * h / 2, size * w, size * h])


PICTURES: dict[str, Callable[[Clip], Made | None]] = {
    "erased": erased,
    "covered": covered,
    "mirrored": mirrored,
    "half": half,
    "alternate": alternate,
    "backward": backward,
    "grey": grey,
}
FIRST_BOXES: dict[str, Callable[[Clip], np.ndarray]] = {
    "shifted": shifted,
    "larger": lambda clip: resized(clip, SIZES["larger"]),
    "smaller": lambda clip: resized(clip, SIZES["smaller"]),
}
KINDS = (*PICTURES, *FIRST_BOXES)


def made_clip(kind: str, clip: Clip, folder: Path) -> Clip | None:
    """Written to the folder, unless it is there and newer than what it is made of. Nothing where
    the clip does not serve."""
    path = folder / f"{clip.name}.avi"
    truth = truth_path(path)
    if not truth.exists() or truth.stat().st_mtime < truth_path(clip.path).stat().st_mtime:
        made = PICTURES[kind](clip)
        if made is None:
            return None
        rate = frames_per_second(clip) / (2 if kind == "alternate" else 1)
        write_clip(path, made[1], rate)
        write_boxes(truth, made[0])
    return Clip(path, read_boxes(truth))


def variant(kind: str, clips: list[Clip], folder: Path) -> list[Clip]:
    if kind in FIRST_BOXES:
        return [Clip(clip.path, clip.truth, FIRST_BOXES[kind](clip)) for clip in clips]
    folder.mkdir(parents=True, exist_ok=True)
    made = [made_clip(kind, clip, folder) for clip in clips]
    return [clip for clip in made if clip is not None]
