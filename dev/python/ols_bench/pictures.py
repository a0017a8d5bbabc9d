"""Reads the pictures of a clip, video or folder, and writes clips without loss."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import cv2
import numpy as np

from ols_bench.clips import BadInput, Clip, picture_files

USUAL_RATE = 30.0  # [Hz] where nothing states one, as ols-track has it


def frames_per_second(clip: Clip) -> float:
    if clip.path.is_dir():
        return USUAL_RATE
    rate = cv2.VideoCapture(str(clip.path)).get(cv2.CAP_PROP_FPS)
    return rate if np.isfinite(rate) and 0.1 < rate < 10000 else USUAL_RATE


def every_picture(path: Path) -> Iterator[np.ndarray]:
    if path.is_dir():
        for file in picture_files(path):
            picture = cv2.imread(str(file))
            if picture is None:
                raise BadInput(f"{file}: cannot be read as a picture")
            yield picture
        return
    video = cv2.VideoCapture(str(path))
    while (read := video.read())[0]:
        yield read[1]


def pictures(clip: Clip) -> Iterator[np.ndarray]:
    """Blue, green, red; of every frame that has a row in the truth, where the clip has it."""
    for _, picture in zip(range(clip.frames), every_picture(clip.path), strict=False):
        yield picture


def write_clip(path: Path, frames: Iterable[np.ndarray], rate: float) -> None:
    """An AVI file of FFV1, which loses nothing."""
    video = None
    for picture in frames:
        if video is None:
            size = (picture.shape[1], picture.shape[0])
            video = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"FFV1"), rate, size)
            if not video.isOpened():
                raise BadInput(f"{path}: cannot be written")
        video.write(picture)
    if video is not None:
        video.release()
