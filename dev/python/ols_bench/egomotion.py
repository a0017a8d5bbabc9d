"""How the scene moves in a clip's pictures, from corners outside of the target's box."""

from collections.abc import Iterable

import cv2
import numpy as np

from ols_bench.clips import Clip
from ols_bench.pictures import pictures

CORNERS = 300
LEAST_AGREEING = 12  # corners; fewer, such as before blank sky, say nothing
IDENTITY = np.eye(3)


def background_mask(size: tuple[int, int], box: np.ndarray) -> np.ndarray:
    """255 outside of the box made half as large again, 0 inside."""
    mask = np.full(size, 255, np.uint8)
    if np.isfinite(box).all():
        x, y, w, h = box
        left, top = max(0, int(x - w / 4)), max(0, int(y - h / 4))
        mask[top : int(y + 5 * h / 4) + 1, left : int(x + 5 * w / 4) + 1] = 0
    return mask


def between(before: np.ndarray, after: np.ndarray, box: np.ndarray) -> np.ndarray:
    """3 x 3 similarity from the pixels of a gray picture to those of the next one; the identity
    where too few corners agree."""
    corners = cv2.goodFeaturesToTrack(
        before, CORNERS, 0.02, 8, mask=background_mask(before.shape, box)
    )
    if corners is None or len(corners) < LEAST_AGREEING:
        return IDENTITY
    moved, tracked, _ = cv2.calcOpticalFlowPyrLK(before, after, corners, None)
    tracked = tracked.ravel() > 0
    if tracked.sum() < LEAST_AGREEING:
        return IDENTITY
    similarity, agreeing = cv2.estimateAffinePartial2D(
        corners[tracked], moved[tracked], ransacReprojThreshold=1.0
    )
    if similarity is None or agreeing.sum() < max(LEAST_AGREEING, tracked.sum() // 2):
        return IDENTITY
    return np.vstack([similarity, (0.0, 0.0, 1.0)])


def chained(steps: Iterable[np.ndarray], reference: int) -> np.ndarray:
    """From each step between a frame and the next one: frames x 3 x 3, from the pixels of each
    frame to those of the reference frame."""
    from_first = [IDENTITY]
    for step in steps:
        from_first.append(step @ from_first[-1])
    return np.array([from_first[reference] @ np.linalg.inv(motion) for motion in from_first])


def to_reference(clip: Clip, reference: int) -> np.ndarray:
    steps, before = [], None
    for frame, picture in enumerate(pictures(clip)):
        gray = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)
        if before is not None:
            steps.append(between(before, gray, clip.truth.xywh[frame - 1]))
        before = gray
    return chained(steps, reference)
