"""What the synthetic benchmark makes of its rows."""

import csv
import math

import numpy as np
import pytest
from ols_bench.synthetic import point_measures, read_points

HEADER = "sweep,value,seed,frame,visible,true_x,true_y,x,y,w,h,var_x,var_y,belief,bound_x,bound_y"


def write(path, sweep: str, rows: list) -> None:
    """Rows: visible, error x, error y, belief."""
    with open(path, "w", newline="") as file:
        file.write(HEADER + "\n")
        writer = csv.writer(file)
        for frame, (visible, dx, dy, belief) in enumerate(rows):
            truth = (100 + frame, 50)
            writer.writerow(
                [sweep, 8, 1, frame, visible, *truth, truth[0] + dx, truth[1] + dy, 9, 9]
                + [0.04, 0.01, belief, 0.01, 0.0025]
            )


def test_errors_are_relative_to_the_initialisation(tmp_path):
    path = tmp_path / "frames.csv"
    # Marked 3 px beside it; from then on 0.2 px to and fro in x, 0.1 in y.
    rows = [(1, 3.0, 0.0, 1.0)] + [(1, 3.0 + s * 0.2, s * 0.1, 1.0) for s in (1, -1) * 10]
    write(path, "size", rows)
    (point,) = read_points(path)
    got = point_measures(point)
    assert got["rms_px"] == pytest.approx([0.2, 0.1])
    assert got["bound_px"] == pytest.approx([0.1, 0.05])
    assert got["over_bound"] == pytest.approx([2.0, 2.0])
    assert got["nees"] == pytest.approx([1.0, 1.0])
    assert got["near"] == 1.0 and got["kept_lock"] == 1.0


def test_a_lost_target_is_no_error_but_a_lost_lock(tmp_path):
    path = tmp_path / "frames.csv"
    write(path, "size", [(1, 0, 0, 1)] + [(1, 0.1, 0, 1)] * 8 + [(1, 60.0, 0, 1)] * 2)
    got = point_measures(read_points(path)[0])
    assert got["rms_px"][0] == pytest.approx(0.1)
    assert got["near"] == pytest.approx(0.8) and got["kept_lock"] == 0.0


@pytest.mark.parametrize(
    ("after", "seconds"),
    [
        ([(1, 0, 0, 0.9)] * 40, 0.0),
        ([(1, 0, 0, 0.3)] * 6 + [(1, 0, 0, 0.9)] * 34, 0.2),  # there, but not believed in
        ([(1, 50, 0, 0.9)] * 40, math.inf),  # believed in, but not there
    ],
)
def test_reacquired_is_believed_in_and_on_target(tmp_path, after, seconds):
    path = tmp_path / "frames.csv"
    rows = [(1, 0, 0, 1)] * 31 + [(0, 0, 0, 0.1)] * 15 + [(0, 0, 0, 0.8)] * 15 + after
    write(path, "occlusion_blank", rows)
    got = point_measures(read_points(path)[0])
    assert got["reacquired_s"] == pytest.approx([seconds])
    assert got["reacquired"] == float(seconds <= 1.0)
    assert got["believed_hidden"] == pytest.approx(0.5)
    assert np.isfinite(got["near"])
