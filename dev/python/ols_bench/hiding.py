"""Clips whose target truly vanishes: painted out, or covered by something in front of it.

Where a clip's labels end, its target is often plainly there still. Here it is not.
"""

import zlib
from collections.abc import Iterator

import cv2
import numpy as np

from ols_bench.board import Board, placed, transformed
from ols_bench.clips import Clip
from ols_bench.egomotion import to_reference
from ols_bench.pictures import frames_per_second, pictures

LEAST_FRAMES = 120
VISIBLE_AT_THE_ENDS = 30  # frames
ERASED_S = 1.5
COVERED_S = (0.4, 0.8, 1.2, 1.6, 2.0)  # by the clip's name
TEXTURE_SIDE = 512  # [px]
CONTRAST = 18.0  # standard deviation of the board's texture, gray levels


def can_hide(clip: Clip) -> bool:
    """Labelled in every frame and long enough."""
    return clip.truth.there.all() and clip.frames >= LEAST_FRAMES


def erased_frames(clip: Clip) -> range:
    first = clip.frames // 2
    frames = round(ERASED_S * frames_per_second(clip))
    return range(first, min(clip.frames - VISIBLE_AT_THE_ENDS, first + frames))


def painted_out(picture: np.ndarray, box: np.ndarray) -> np.ndarray:
    """The box, half as large again, filled from its border (A. Telea, An Image Inpainting Technique
    Based on the Fast Marching Method, 2004)."""
    x, y, w, h = box
    margin_x, margin_y = max(4.0, 0.25 * w), max(4.0, 0.25 * h)
    mask = np.zeros(picture.shape[:2], np.uint8)
    rows = slice(max(0, int(y - margin_y)), max(0, int(y + h + margin_y) + 1))
    columns = slice(max(0, int(x - margin_x)), max(0, int(x + w + margin_x) + 1))
    mask[rows, columns] = 255
    return cv2.inpaint(picture, mask, 5, cv2.INPAINT_TELEA)


def without(boxes: np.ndarray, hidden: np.ndarray | range) -> np.ndarray:
    """The labels with those of the hidden frames emptied."""
    rest = boxes.copy()
    rest[hidden] = np.nan
    return rest


def erased(clip: Clip) -> tuple[np.ndarray, Iterator[np.ndarray]] | None:
    """Truth and pictures; the target is gone from the middle of the clip, and then back."""
    if not can_hide(clip):
        return None
    gone = erased_frames(clip)

    def frames() -> Iterator[np.ndarray]:
        for frame, picture in enumerate(pictures(clip)):
            yield painted_out(picture, clip.truth.xywh[frame]) if frame in gone else picture

    return without(clip.truth.xywh, gone), frames()


def texture(seed: int) -> np.ndarray:
    """Periodic noise with as much in every octave, like foliage; mean 0, deviation 1."""
    noise = np.random.default_rng(seed).normal(size=(TEXTURE_SIDE, TEXTURE_SIDE))
    frequency = np.fft.fftfreq(TEXTURE_SIDE)
    radius = np.hypot(frequency[:, None], frequency[None, :])
    radius[0, 0] = np.inf
    pattern = np.fft.ifft2(np.fft.fft2(noise) / radius).real
    return (pattern / pattern.std()).astype(np.float32)


def level(picture: np.ndarray) -> float:
    """Darker than what is behind, or brighter where that is dark."""
    behind = float(np.median(picture))
    return 0.5 * behind if behind > 80.0 else behind + 60.0


def cover_of(size: tuple[int, int], board: Board, frame: int, motion: np.ndarray) -> np.ndarray:
    """Rows x columns, 0 to 1. The distance from the board's centre line is linear in the pixel."""
    origin, right, down = (
        board.across(frame, transformed(motion, np.array(p))) for p in ((0, 0), (1, 0), (0, 1))
    )
    rows, columns = np.arange(size[0]), np.arange(size[1])
    across = origin + (down - origin) * rows[:, None] + (right - origin) * columns[None, :]
    return board.cover_at(across)


def covered_picture(
    picture: np.ndarray, board: Board, frame: int, motion: np.ndarray, pattern: np.ndarray
) -> np.ndarray:
    """The pattern (gray levels, periodic) where the board is."""
    cover = cover_of(picture.shape[:2], board, frame, motion)
    rows, columns = np.flatnonzero(cover.any(axis=1)), np.flatnonzero(cover.any(axis=0))
    if not len(rows):
        return picture
    part = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    x, y = np.meshgrid(np.arange(columns[0], columns[-1] + 1), np.arange(rows[0], rows[-1] + 1))
    points = transformed(motion, np.stack([x, y], axis=-1))
    points -= board.velocity * (frame - board.reference) * board.normal
    on_board = np.mod(points, TEXTURE_SIDE).astype(np.float32)
    drawn = cv2.remap(pattern, on_board, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP)
    weight = cover[part][..., None]
    result = picture.copy()
    mixed = (1.0 - weight) * picture[part] + weight * drawn[..., None]
    result[part] = np.clip(np.round(mixed), 0, 255).astype(np.uint8)
    return result


def covered(clip: Clip) -> tuple[np.ndarray, Iterator[np.ndarray]] | None:
    """Truth and pictures; the target passes behind a board, in the middle of the clip."""
    if not can_hide(clip):
        return None
    seed = zlib.crc32(clip.name.encode())
    middle = clip.frames // 2
    wanted = round(COVERED_S[seed % len(COVERED_S)] * frames_per_second(clip))
    motion = to_reference(clip, middle)
    boxes = clip.truth.xywh[: len(motion)]
    found = placed(boxes, motion, middle, wanted, VISIBLE_AT_THE_ENDS)
    if found is None:
        return None
    board, hidden = found

    def frames() -> Iterator[np.ndarray]:
        pattern = None
        for frame, picture in enumerate(pictures(clip)):
            if pattern is None:
                pattern = level(picture) + CONTRAST * texture(seed)
            yield covered_picture(picture, board, frame, motion[frame], pattern)

    return without(boxes, hidden), frames()
