"""Belief in a target that is away, and its return, from files of truth and boxes."""

import numpy as np
import pytest
from ols_bench.absence import absence_measures, absences, found_after_s, late_frames
from ols_bench.belief import belief_measures
from ols_bench.clips import Clip, read_boxes
from ols_bench.measures import Judged, clip_measures, judge
from ols_bench.places import Places, places_of
from ols_bench.results import results_of, spread, with_repeats
from ols_bench.tables import belief_rows, seed_table

RATE = 30.0
HERE, AWAY = (100.0, 100.0, 10.0, 10.0), (300.0, 100.0, 10.0, 10.0)


def rows(path, boxes: list, belief: list | None = None):
    lines = ["frame,x,y,w,h" + (",belief" if belief else "")]
    for frame, box in enumerate(boxes):
        cells = [f"{v:g}" for v in box] if box else [""] * 4
        lines.append(",".join([str(frame), *cells, *([f"{belief[frame]:g}"] if belief else [])]))
    path.write_text("\n".join(lines) + "\n")
    return path


def judged(tmp_path, truth: list, boxes: list, belief: list | None = None) -> Judged:
    """The first frame is the initialisation."""
    clip = Clip(tmp_path / "clip.avi", read_boxes(rows(tmp_path / "clip.csv", truth)))
    result = read_boxes(rows(tmp_path / "boxes.csv", boxes, belief), clip.frames)
    return judge(clip, result, RATE)


def gone(before: int, absent: int, after: int) -> list:
    return [HERE] * before + [None] * absent + [HERE] * after


def test_the_first_ten_frames_of_each_absence_are_not_held_against_a_belief(tmp_path):
    truth = gone(5, 14, 20) + [None] * 12
    belief = [0.9] * 5 + [0.9] * 11 + [0.6] + [0.4] * 2 + [0.9] * 20 + [0.9] * 10 + [0.1] * 2
    j = judged(tmp_path, truth, [HERE] * len(truth), belief)
    assert absences(j) == [(4, 18), (38, 50)]
    assert list(np.flatnonzero(late_frames(j))) == [14, 15, 16, 17, 48, 49]
    measures = absence_measures([j])
    assert measures["late_absent"] == 6
    assert measures["late_absent_believed"] == pytest.approx(2 / 6)
    assert clip_measures(j)["false_belief"] == pytest.approx(22 / 26)


def test_a_missing_box_is_not_believed_in_after_the_tenth_frame(tmp_path):
    truth = gone(5, 14, 20)
    j = judged(tmp_path, truth, [HERE] * 5 + [None] * 14 + [HERE] * 20, [0.9] * 39)
    assert absence_measures([j])["late_absent_believed"] == 0.0


@pytest.mark.parametrize(
    ("frames", "in_time"),
    [(0, 1.0), (14, 1.0), (15, 1.0), (16, 0.0)],  # of 30 a second
)
def test_found_again_within_half_a_second_of_the_first_label(tmp_path, frames, in_time):
    truth = gone(5, 20, 60)
    boxes = [HERE] * 25 + [AWAY] * frames + [HERE] * (60 - frames)
    j = judged(tmp_path, truth, boxes, [0.9] * 85)
    assert found_after_s(j) == [pytest.approx(frames / RATE)]
    assert absence_measures([j])["found_again_in_time"] == in_time


def test_found_again_means_believed_in(tmp_path):
    truth = gone(5, 20, 60)
    j = judged(tmp_path, truth, [HERE] * 85, [0.9] * 5 + [0.4] * 20 + [0.4] * 20 + [0.9] * 40)
    assert found_after_s(j) == [pytest.approx(20 / RATE)]


def test_a_target_never_found_counts_and_one_that_leaves_at_once_does_not(tmp_path):
    never = judged(tmp_path, gone(5, 20, 60), [AWAY] * 85, [0.9] * 85)
    assert found_after_s(never) == [np.inf]
    short = judged(tmp_path, gone(5, 20, 10) + [None] * 20, [AWAY] * 55, [0.9] * 55)
    assert found_after_s(short) == []
    assert absence_measures([never, short])["returns"] == 1


def test_an_unlabelled_moment_is_no_absence_to_return_from(tmp_path):
    assert found_after_s(judged(tmp_path, gone(5, 4, 60), [AWAY] * 69, [0.9] * 69)) == []
    assert len(found_after_s(judged(tmp_path, gone(5, 5, 60), [AWAY] * 70, [0.9] * 70))) == 1


def test_off_target_and_believed_in_counts_absent_and_wrong_frames(tmp_path):
    truth = gone(11, 10, 10)
    boxes = [HERE] * 11 + [HERE] * 10 + [AWAY] * 10
    belief = [0.9] * 11 + [0.9] * 4 + [0.2] * 6 + [0.7] * 5 + [0.3] * 5
    measures = belief_measures([judged(tmp_path, truth, boxes, belief)])
    assert measures["off_target"] == 20
    assert measures["off_target_believed"] == pytest.approx(9 / 20)
    # Of 10 x 20 pairs, those with equal beliefs (4 of the absent frames) count half.
    assert measures["auroc"] == pytest.approx((10 * 16 + 10 * 4 / 2) / 200)


def test_a_tracker_without_belief_has_only_its_boxes(tmp_path):
    j = judged(tmp_path, gone(5, 20, 60), [HERE] * 5 + [None] * 20 + [HERE] * 60)
    measures = absence_measures([j])
    assert measures["late_absent_believed"] is None
    assert measures["found_again_in_time"] == 1.0


def written(places: Places, boxes: list, belief: list) -> None:
    rows(places.boxes, boxes, belief)
    times = [f"{frame},1.0" for frame in range(1, len(boxes))]
    places.times.write_text("\n".join(["frame,total_ms", *times]) + "\n")


def test_tables_give_mean_and_range_over_the_seeds(tmp_path):
    truth = gone(5, 20, 60)
    clip = Clip(tmp_path / "clip.avi", read_boxes(rows(tmp_path / "clip.csv", truth)))
    folders, found = {"erased": [clip]}, []
    for seed, late in ((None, 0.9), (2, 0.1)):
        places = places_of(tmp_path / "out", "ours (full)", "erased", clip, seed)
        written(places, [HERE] * 85, [0.95] * 5 + [late] * 20 + [0.95] * 60)
        found.append(
            results_of(tmp_path / "out", "ours (full)", folders, {clip.path: RATE}, [], seed)
        )
    results = {"ours (full)": with_repeats(found[0], found[1:])}
    figures = spread([by["erased"] for by in found])
    assert figures["late_absent_believed"] == {"mean": 0.5, "least": 0.0, "greatest": 1.0}
    assert figures["found_again_in_time"] == {"mean": 1.0, "least": 1.0, "greatest": 1.0}
    table = seed_table(results, "erased").splitlines()
    assert len(table) == 3 and "| 0.500 (0.000 to 1.000) | 1.000 (1.000 to 1.000) |" in table[2]
    row = belief_rows("ours (full)", found[0]["erased"])[0]
    assert (row[1], row[5], row[-1]) == ("1.000", "1.000", "1.00 of 1")
