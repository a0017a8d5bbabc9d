"""The board that a target passes behind: where it stands, whom it hides, and for how long."""

import numpy as np
import pytest
from ols_bench.board import (
    HIDDEN_SHARE,
    Board,
    centres,
    hidden_frames,
    hidden_share,
    passing,
    placed,
    standing,
    suits,
)

FRAMES, MIDDLE, MARGIN = 200, 100, 30
STILL = np.tile(np.eye(3), (FRAMES, 1, 1))


def boxes(speed_x: float, speed_y: float = 0.0) -> np.ndarray:
    frame = np.arange(FRAMES)[:, None]
    corner = np.array([300.0, 200.0]) + (frame - MIDDLE) * np.array([speed_x, speed_y])
    return np.hstack([corner, np.tile([20.0, 10.0], (FRAMES, 1))])


def panned(speed: float) -> np.ndarray:
    """The scene moves to the left in the image: back by as much to the reference frame."""
    motion = STILL.copy()
    motion[:, 0, 2] = speed * (np.arange(FRAMES) - MIDDLE)
    return motion


def one_run(hidden: np.ndarray) -> tuple[int, int]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], hidden, [0]])))
    assert len(edges) == 2
    return int(edges[0]), int(edges[1])


@pytest.mark.parametrize("speed", [(3.0, 0.0), (-3.0, 0.0), (0.0, 3.0), (2.0, -2.0)])
@pytest.mark.parametrize("wanted", [12, 24, 48])
def test_a_target_that_crosses_is_hidden_for_as_long_as_wanted(speed, wanted):
    board, hidden = placed(boxes(*speed), STILL, MIDDLE, wanted, MARGIN)
    start, end = one_run(hidden)
    assert board.velocity == 0.0
    assert start == pytest.approx(MIDDLE - wanted / 2, abs=1)
    assert end - start == pytest.approx(wanted, abs=1)


@pytest.mark.parametrize("speed", [0.0, 0.2, -0.2])
def test_the_board_passes_before_a_target_that_hovers(speed):
    board, hidden = placed(boxes(speed), STILL, MIDDLE, 24, MARGIN)
    start, end = one_run(hidden)
    assert board.velocity * speed <= 0.0 and board.velocity != 0.0
    assert start <= MIDDLE < end
    assert end - start == pytest.approx(24, abs=1)


def test_the_board_stands_in_the_scene_that_a_camera_pans_over():
    """A target that the camera follows crosses the scene, not the image."""
    following, motion = boxes(0.0), panned(3.0)
    board, hidden = placed(following, motion, MIDDLE, 24, MARGIN)
    assert board.velocity == 0.0
    start, end = one_run(hidden)
    assert (start, end - start) == (pytest.approx(88, abs=1), pytest.approx(24, abs=1))
    assert not np.array_equal(hidden, hidden_frames(board, following, STILL))


def test_half_a_box_is_the_limit_of_being_hidden():
    board = Board(np.array([0.0, 0.0]), np.array([1.0, 0.0]), 100.0, 0.0, 0)
    assert HIDDEN_SHARE == 0.5
    for left, share in ((60.0, 0.0), (45.0, 0.25), (35.0, 0.75), (0.0, 1.0)):
        box = np.array([left, 0.0, 20.0, 10.0])
        assert hidden_share(board, 0, box, np.eye(3)) == pytest.approx(share, abs=0.06)


def test_a_board_narrower_than_the_target_cannot_stand():
    slow, fast = boxes(0.9), boxes(1.1)
    assert standing(slow, centres(slow, STILL), MIDDLE, 24) is None
    assert standing(fast, centres(fast, STILL), MIDDLE, 24).width == pytest.approx(26.4)
    assert passing(slow, centres(slow, STILL), MIDDLE, 24).width == 30.0


def test_a_target_hidden_at_the_ends_or_for_too_long_does_not_serve():
    hidden = np.zeros(FRAMES, dtype=bool)
    hidden[90:110] = True
    assert suits(hidden, 20, MARGIN) and suits(hidden, 10, MARGIN) and suits(hidden, 40, MARGIN)
    assert not suits(hidden, 9, MARGIN) and not suits(hidden, 41, MARGIN)
    for frame in (0, MARGIN - 1, FRAMES - MARGIN, FRAMES - 1):
        early = hidden.copy()
        early[frame] = True
        assert not suits(early, 20, MARGIN)
