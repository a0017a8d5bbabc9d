"""Clips with ground truth, and boxes that a tracker gave for them.

A folder of clips holds NAME.mp4, NAME.avi or a folder NAME/ of pictures, and NAME.csv
(frame,x,y,w,h: frames from 0, pixels, top-left corner; no x,y,w,h where the target is absent).
Boxes of a tracker are NAME.csv with the same columns and, where it has an opinion on itself,
belief.
"""

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

COORDINATES = "xywh"
KINDS = (".mp4", ".avi")
PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".tif", ".tiff")  # as ols-track has


class BadInput(Exception):
    """One line that names the file."""


@dataclass
class Boxes:
    """Row k is frame k; nan where there is no box."""

    xywh: np.ndarray  # frames x 4
    belief: np.ndarray | None  # frames; nothing when the file has no such column

    @property
    def there(self) -> np.ndarray:
        return np.isfinite(self.xywh).all(axis=1)


@dataclass
class Clip:
    path: Path  # of the video, or of the folder of pictures
    truth: Boxes
    given: np.ndarray | None = None  # the tracker's first box, where it is not the true one

    @property
    def name(self) -> str:
        return self.path.name if self.path.is_dir() else self.path.stem

    @property
    def first_box(self) -> list[float]:
        box = self.truth.xywh[self.first] if self.given is None else self.given
        return [float(value) for value in box]

    @property
    def frames(self) -> int:
        return len(self.truth.xywh)

    @property
    def first(self) -> int:
        """The frame that the tracker is given the target in."""
        return int(np.argmax(self.truth.there))


def number(row: dict, key: str, path: Path, line: int) -> float:
    text = (row.get(key) or "").strip()
    if not text:
        return np.nan
    try:
        return float(text)
    except ValueError:
        raise BadInput(f"{path}:{line}: {key}: not a number: {text}") from None


def read_boxes(path: Path, frames: int | None = None) -> Boxes:
    """As many frames as asked for, or as are listed. Missing rows are missing boxes."""
    with open(path, newline="") as file:
        reader = csv.DictReader(file)
        missing = {"frame", *COORDINATES} - set(reader.fieldnames or ())
        if missing:
            raise BadInput(f"{path}:1: no column {sorted(missing)[0]}")
        rows = {}
        for line, row in enumerate(reader, start=2):
            frame = number(row, "frame", path, line)
            if not frame >= 0 or frame != int(frame):
                raise BadInput(f"{path}:{line}: frame: not a frame's number")
            box = [number(row, key, path, line) for key in COORDINATES]
            rows[int(frame)] = (box, number(row, "belief", path, line))
        has_belief = "belief" in reader.fieldnames
    count = frames if frames is not None else max(rows, default=-1) + 1
    xywh = np.full((count, 4), np.nan)
    belief = np.zeros(count)
    for frame, (box, value) in rows.items():
        if frame < count:
            xywh[frame] = box if np.isfinite(box).all() else np.nan
            belief[frame] = value if np.isfinite(value) else 1.0
    return Boxes(xywh, belief if has_belief else None)


def in_order(path: Path) -> tuple:
    """Sorts 2.png before 10.png, as ols-track does."""
    parts = re.split(r"(\d+)", path.name)
    return ([int(p) if p.isdigit() else p for p in parts], path.name)


def picture_files(folder: Path) -> list[Path]:
    return sorted((p for p in folder.iterdir() if p.suffix.lower() in PICTURES), key=in_order)


def is_clip(path: Path) -> bool:
    return bool(picture_files(path)) if path.is_dir() else path.suffix.lower() in KINDS


def truth_path(path: Path) -> Path:
    return path.with_name((path.name if path.is_dir() else path.stem) + ".csv")


def read_folder(folder: Path) -> list[Clip]:
    """The clips of a folder by name."""
    if not folder.is_dir():
        raise BadInput(f"{folder}: no such folder")
    clips = []
    for path in sorted(p for p in folder.iterdir() if is_clip(p)):
        truth = truth_path(path)
        if not truth.exists():
            raise BadInput(f"{truth}: the ground truth of {path.name} is missing")
        clip = Clip(path, read_boxes(truth))
        if not clip.truth.there.any():
            raise BadInput(f"{truth}: no row has a box")
        clips.append(clip)
    if not clips:
        raise BadInput(f"{folder}: no clips ({', '.join(KINDS)}, folders of pictures)")
    return clips


def write_boxes(path: Path, boxes: np.ndarray) -> None:
    """The truth of a clip: one row a frame, empty where a box is nan."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("frame", *COORDINATES))
        for frame, box in enumerate(boxes):
            there = np.isfinite(box).all()
            writer.writerow((frame, *(f"{v:.2f}" for v in box)) if there else (frame, *[""] * 4))
