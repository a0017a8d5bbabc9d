"""The benchmark's figures, on boxes whose figures are known by hand, and beside another scorer."""

import importlib.util
import math

import numpy as np
import pytest
from ols_bench.belief import (
    auroc,
    belief_measures,
    calibration_error,
    followed_on,
    losses,
    reliability,
)
from ols_bench.clips import BadInput, Boxes, Clip, read_boxes, read_folder
from ols_bench.measures import Judged, clip_measures, distance, folder_measures, judge, overlap

NONE = [np.nan] * 4


def clip(truth: list, tmp_path) -> Clip:
    return Clip(tmp_path / "clip.mp4", Boxes(np.array(truth, dtype=float), None))


def boxes(rows: list, belief: list | None = None) -> Boxes:
    return Boxes(np.array(rows, dtype=float), None if belief is None else np.array(belief))


def judged(on_target: list, belief: list, frames_per_second: float = 30.0) -> Judged:
    on = np.array(on_target, dtype=bool)
    return Judged(
        name="clip",
        visible=np.ones(len(on), dtype=bool),
        overlap=np.where(on, 0.8, 0.0),
        distance=np.where(on, 1.0, 100.0),
        has_box=np.ones(len(on), dtype=bool),
        belief=np.array(belief, dtype=float),
        step=np.zeros(len(on)),
        frames_per_second=frames_per_second,
    )


def test_overlap_and_distance_of_known_boxes():
    a = np.array([[0, 0, 10, 10], [0, 0, 10, 10], [0, 0, 10, 10], NONE])
    b = np.array([[0, 0, 10, 10], [5, 0, 10, 10], [20, 0, 10, 10], [0, 0, 1, 1]])
    assert overlap(a, b) == pytest.approx([1.0, 1 / 3, 0.0, 0.0])
    assert distance(a, b) == pytest.approx([0.0, 5.0, 20.0, math.inf])


def test_clip_by_hand(tmp_path):
    truth = [[0, 0, 10, 10], [0, 0, 10, 10], [0, 0, 10, 10], [0, 0, 10, 10], NONE, NONE]
    ours = [[90, 0, 10, 10], [5, 0, 10, 10], NONE, [21, 0, 10, 10], [0, 0, 5, 5], [0, 0, 5, 5]]
    got = clip_measures(judge(clip(truth, tmp_path), boxes(ours, [1, 1, 0, 1, 0.6, 0.4]), 30.0))
    assert got["frames"] == 3 and got["missing"] == 1 and got["absent"] == 2
    assert got["iou"] == pytest.approx(1 / 9)
    assert got["p20"] == pytest.approx(1 / 3) and got["p5"] == pytest.approx(1 / 3)
    assert got["centre"] == 21.0
    assert not got["lock"]
    assert got["false_belief"] == 0.5


def test_boxes_without_belief_are_believed_in(tmp_path):
    truth = [[0, 0, 10, 10], [0, 0, 10, 10], NONE, NONE]
    ours = boxes([NONE, [0, 0, 10, 10], [0, 0, 9, 9], NONE])
    assert clip_measures(judge(clip(truth, tmp_path), ours, 30.0))["false_belief"] == 0.5


def test_tracking_begins_with_the_first_box(tmp_path):
    truth = [NONE, NONE, [0, 0, 10, 10], [0, 0, 10, 10]]
    got = judge(clip(truth, tmp_path), boxes([NONE, NONE, NONE, [0, 0, 10, 10]]), 30.0)
    assert got.overlap == pytest.approx([1.0])


def test_calibration_of_a_belief_that_is_right_and_of_one_that_boasts():
    belief = np.array([0.75] * 4 + [0.05] * 10)
    on_target = np.array([True] * 3 + [False] * 11)
    rows = reliability(belief, on_target)
    assert [row["frames"] for row in rows] == [10, 4]
    assert calibration_error(rows) == pytest.approx(10 * 0.05 / 14)
    boasting = reliability(np.ones(10), np.array([True] * 4 + [False] * 6))
    assert calibration_error(boasting) == pytest.approx(0.6)


def test_auroc_counts_pairs_in_the_right_order():
    on_target = np.array([True, True, False, False])
    assert auroc(np.array([0.9, 0.8, 0.2, 0.1]), on_target) == 1.0
    assert auroc(np.array([0.1, 0.2, 0.8, 0.9]), on_target) == 0.0
    assert auroc(np.array([0.5, 0.5, 0.5, 0.5]), on_target) == 0.5
    assert auroc(np.array([0.9, 0.3, 0.5, 0.1]), on_target) == 0.75
    assert auroc(np.array([0.9, 0.3]), np.array([True, True])) is None


def losses_of(j: Judged) -> list[float]:
    return losses(j, j.on_target)


def test_losses_are_timed_from_the_first_frame_off_target():
    on = [True] * 5 + [False] * 20 + [True] * 5
    assert losses_of(judged(on, [1.0] * 8 + [0.2] * 17 + [1.0] * 5)) == [pytest.approx(0.1)]
    assert losses_of(judged(on, [1.0] * 30)) == [math.inf]
    assert losses_of(judged([True] * 5 + [False] * 20, [1.0] * 7 + [0.0] * 18)) == [
        pytest.approx(2 / 30)
    ]


def test_no_losses_are_short_excursions_and_targets_not_believed_in():
    short = [True] * 5 + [False] * 9 + [True] * 5
    assert losses_of(judged(short, [1.0] * 19)) == []
    doubted = [True] * 5 + [False] * 20
    assert losses_of(judged(doubted, [1.0] * 4 + [0.3] * 21)) == []


def test_a_target_is_followed_on_until_a_doubt_or_a_leap():
    j = judged([True, True, False, False, False, False, True, False], [1.0] * 8)
    j.visible = np.array([True, True, False, False, False, False, True, False])
    assert list(np.flatnonzero(followed_on(j))) == [2, 3, 4, 5, 7]
    j.step[4] = 100.0
    assert list(np.flatnonzero(followed_on(j))) == [2, 3, 7]
    j.belief[2] = 0.4
    assert list(np.flatnonzero(followed_on(j))) == [7]


def test_nothing_is_followed_on_that_was_off_a_label():
    j = judged([True] * 5 + [False] * 10, [1.0] * 15)
    j.visible = np.array([True] * 5 + [False] + [True] * 5 + [False] * 4)
    assert list(np.flatnonzero(followed_on(j))) == [5]
    measures = belief_measures([j])["with_followed_on"]
    assert measures["calibration_error"] == pytest.approx(9 / 15)


def test_a_label_that_ends_is_no_loss_of_what_is_followed_on():
    j = judged([True] * 5 + [False] * 20, [1.0] * 25)
    j.visible = np.array([True] * 5 + [False] * 20)
    measures = belief_measures([j])
    assert (measures["losses"], measures["noticed_in_time"]) == (1, 0.0)
    assert measures["followed_on"] == 1.0
    assert measures["with_followed_on"]["losses"] == 0
    assert measures["with_followed_on"]["calibration_error"] == 0.0


def test_what_covers_half_of_a_large_target_is_on_it():
    j = judged([True, False, False], [0.9, 0.9, 0.1])
    j.overlap = np.array([1.0, 0.6, 0.4])
    measures = belief_measures([j])
    assert measures["off_target_believed"] == 0.5
    assert measures["with_covering"]["off_target"] == 1
    assert measures["with_covering"]["off_target_believed"] == 0.0
    assert measures["with_covering"]["auroc"] == 1.0


def test_trackers_without_belief_have_no_such_measures():
    j = judged([True], [1.0])
    j.belief = None
    assert belief_measures([j]) is None


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("frame,x,y,w\n0,1,2,3\n", "no column h"),
        ("frame,x,y,w,h\n0,1,2,3,a\n", ":2: h"),
        ("frame,x,y,w,h\n-1,1,2,3,4\n", ":2: frame"),
        ("frame,x,y,w,h\nx,1,2,3,4\n", ":2: frame"),
        ("", "no column"),
    ],
)
def test_bad_boxes_are_refused_by_line(tmp_path, text, part):
    path = tmp_path / "boxes.csv"
    path.write_text(text)
    with pytest.raises(BadInput, match=part):
        read_boxes(path)


def test_bad_folders_are_refused(tmp_path):
    with pytest.raises(BadInput, match="no such folder"):
        read_folder(tmp_path / "none")
    with pytest.raises(BadInput, match="no clips"):
        read_folder(tmp_path)
    (tmp_path / "a.mp4").touch()
    with pytest.raises(BadInput, match="a.csv"):
        read_folder(tmp_path)
    (tmp_path / "a.csv").write_text("frame,x,y,w,h\n0,,,,\n")
    with pytest.raises(BadInput, match="no row has a box"):
        read_folder(tmp_path)


@pytest.mark.parametrize("folder", ["tracking", "tracking_gaps", "tracking_ground"])
def test_same_figures_as_the_other_scorer(shared, tmp_path, folder):
    """Boxes that are off by more and more, some of them missing."""
    path = shared / "tools/score_boxes.py"
    spec = importlib.util.spec_from_file_location("score_boxes", path)
    scorer = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(scorer)
    random = np.random.default_rng(1)
    ours = {}
    for one in read_folder(shared / "data" / folder):
        lines = ["frame,x,y,w,h,belief,state"]
        reach = random.uniform(2.0, 40.0)
        box = one.truth.xywh[one.first]
        for frame in range(one.frames):
            if one.truth.there[frame]:
                box = one.truth.xywh[frame]
            x, y, w, h = box + random.normal(0.0, reach, 4) * [1, 1, 0.05, 0.05]
            belief = random.uniform()
            if random.uniform() < 0.1:
                lines.append(f"{frame},,,,,{belief:.4f},lost")
            elif random.uniform() < 0.95:
                lines.append(f"{frame},{x:.3f},{y:.3f},{w:.3f},{h:.3f},{belief:.4f},tracking")
        result = tmp_path / f"{one.name}.csv"
        result.write_text("\n".join(lines) + "\n")
        ours[one.name] = clip_measures(judge(one, read_boxes(result, one.frames), 30.0))
    theirs = scorer.score_folder(str(shared / "data" / folder), str(tmp_path))
    assert ours.keys() == theirs.keys()
    for name, clip_figures in theirs.items():
        for key, value in clip_figures.items():
            assert ours[name][key] == pytest.approx(value, abs=1e-12), f"{name}: {key}"
    total = folder_measures(ours)
    for key, value in scorer.aggregate(theirs).items():
        assert total[key] == pytest.approx(value, abs=1e-12), key
