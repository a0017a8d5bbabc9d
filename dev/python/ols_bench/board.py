"""A board in the scene that a target passes behind: a strip across the whole picture.

It is square to the target's path where that crosses it, and as wide as the target goes in the time
that it is to be hidden. It stands still in the scene; where the target moves too little to cross a
board of its own size in that time, the board itself passes before it.
"""

from dataclasses import dataclass

import numpy as np

HIDDEN_SHARE = 0.5  # of the labelled box; when more of it is covered, the target counts as absent
LEAST_WIDTH = 1.2  # of the target's extent along its path
PASSING_WIDTH = 1.5
SAMPLES = 16  # along each side of a box


@dataclass
class Board:
    """In pixels of the reference frame."""

    point: np.ndarray  # on the centre line, in the reference frame
    normal: np.ndarray  # unit vector across the strip
    width: float
    velocity: float  # along the normal, pixels a frame
    reference: int

    def across(self, frame: int, points: np.ndarray) -> np.ndarray:
        """Distance from the centre line, of points (..., 2) of the reference frame."""
        moved = self.velocity * (frame - self.reference)
        return (points - self.point) @ self.normal - moved

    def cover(self, frame: int, points: np.ndarray) -> np.ndarray:
        return self.cover_at(self.across(frame, points))

    def cover_at(self, across: np.ndarray) -> np.ndarray:
        """0 beside the board to 1 on it, with an edge of one pixel."""
        return np.clip(self.width / 2 - np.abs(across) + 0.5, 0.0, 1.0)


def transformed(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Points (..., 2) by an affine 3 x 3 matrix."""
    return points @ matrix[:2, :2].T + matrix[:2, 2]


def hidden_share(board: Board, frame: int, box: np.ndarray, to_reference: np.ndarray) -> float:
    steps = (np.arange(SAMPLES) + 0.5) / SAMPLES
    x, y = np.meshgrid(box[0] + box[2] * steps, box[1] + box[3] * steps)
    points = np.stack([x, y], axis=-1) - 0.5  # pixel (0, 0) reaches from -0.5 to 0.5
    return float(board.cover(frame, transformed(to_reference, points)).mean())


def hidden_frames(board: Board, boxes: np.ndarray, to_reference: np.ndarray) -> np.ndarray:
    return np.array(
        [
            hidden_share(board, k, box, motion) > HIDDEN_SHARE
            for k, (box, motion) in enumerate(zip(boxes, to_reference, strict=True))
        ]
    )


def centres(boxes: np.ndarray, to_reference: np.ndarray) -> np.ndarray:
    middles = boxes[:, :2] + boxes[:, 2:] / 2
    return np.array([transformed(m, p) for m, p in zip(to_reference, middles, strict=True)])


def standing(boxes: np.ndarray, path: np.ndarray, middle: int, hidden: int) -> Board | None:
    before, after = path[middle - hidden // 2], path[middle + hidden - hidden // 2]
    width = float(np.hypot(*(after - before)))
    normal = (after - before) / width if width > 0 else np.array([1.0, 0.0])
    if width < LEAST_WIDTH * float(np.abs(normal) @ boxes[middle, 2:]):
        return None
    return Board((before + after) / 2, normal, width, 0.0, middle)


def passing(boxes: np.ndarray, path: np.ndarray, middle: int, hidden: int) -> Board:
    """Against the target's own motion, however small."""
    speed = (path[middle + hidden - hidden // 2, 0] - path[middle - hidden // 2, 0]) / hidden
    width = PASSING_WIDTH * float(boxes[middle, 2])
    relative = width / hidden
    velocity = speed - relative if speed > 0 else speed + relative
    return Board(path[middle], np.array([1.0, 0.0]), width, velocity, middle)


def suits(hidden: np.ndarray, wanted: int, margin: int) -> bool:
    """Visible at the beginning and the end, hidden for about as long as wanted."""
    free = not hidden[:margin].any() and not hidden[-margin:].any()
    return free and wanted / 2 <= hidden.sum() <= 2 * wanted


def placed(
    boxes: np.ndarray, to_reference: np.ndarray, middle: int, wanted: int, margin: int
) -> tuple[Board, np.ndarray] | None:
    """The board and the frames that it hides the target in; nothing where none suits."""
    path = centres(boxes, to_reference)
    candidates = (standing(boxes, path, middle, wanted), passing(boxes, path, middle, wanted))
    for board in candidates:
        if board is None:
            continue
        hidden = hidden_frames(board, boxes, to_reference)
        if suits(hidden, wanted, margin):
            return board, hidden
    return None
