"""The table of two versions from several first boxes, on boxes whose figures are known by hand."""

import numpy as np
import pytest

pytest.importorskip("cv2", reason="tools/install-benchmarks")

from ols_bench.clips import Boxes, Clip
from ols_bench.first_boxes import STEPS, figures, moved, rows
from ols_bench.measures import Judged


def judged(share: float) -> Judged:
    """Of ten frames, this share on target; believed exactly there."""
    on = np.arange(10) < round(10 * share)
    return Judged(
        name="clip",
        visible=np.ones(10, dtype=bool),
        overlap=np.where(on, 0.8, 0.0),
        distance=np.where(on, 1.0, 100.0),
        has_box=np.ones(10, dtype=bool),
        belief=np.where(on, 0.9, 0.1),
        step=np.zeros(10),
        frames_per_second=30.0,
    )


def test_the_first_box_moves_by_a_pixel_and_the_truth_stays(tmp_path):
    clip = Clip(tmp_path / "clip.mp4", Boxes(np.array([[10.0, 20.0, 5.0, 6.0]] * 3), None))
    assert moved(clip, STEPS["left"]).first_box == [9.0, 20.0, 5.0, 6.0]
    assert moved(clip, STEPS["down"]).first_box == [10.0, 21.0, 5.0, 6.0]
    assert clip.first_box == moved(clip, STEPS["exact"]).first_box
    assert moved(clip, STEPS["up"]).truth is clip.truth


def test_a_clips_figure_is_the_mean_over_its_first_boxes():
    of = figures({"exact": [judged(1.0), judged(0.4)], "right": [judged(0.8), judged(0.6)]})
    assert of.p20 == pytest.approx([0.9, 0.5])
    assert of.lock == pytest.approx([0.5, 0.0])
    assert of.iou == pytest.approx([0.72, 0.4])
    assert of.off_target_believed == 0.0 and of.auroc == 1.0


def test_a_difference_has_the_error_of_the_pairs():
    before = figures({"exact": [judged(0.2), judged(0.8)]})
    new = figures({"exact": [judged(0.4), judged(1.0)]})
    [_, _, difference] = rows({"before": before, "new": new})
    assert difference[:2] == ["difference", ""]
    assert difference[3] == "+0.200 ± 0.000"
    assert rows({"new": new})[0][3] == "0.700 ± 0.300"
