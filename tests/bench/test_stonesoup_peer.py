"""What the comparison with Stone Soup holds its figures against."""

import pytest

pytest.importorskip("stonesoup", reason="tools/install-benchmarks requirements-estimators.txt")

from ols_bench.stonesoup_peer import misses


@pytest.mark.parametrize(
    ("ratio_95", "times_faster", "missed"),
    [
        ([0.999, 1.001], 300.0, 0),
        ([1.001, 1.002], 300.0, 1),
        ([0.999, 1.001], 299.0, 1),
        ([float("nan")] * 2, float("nan"), 2),
    ],
)
def test_a_miss_is_said(ratio_95, times_faster, missed):
    assert len(misses({"ratio_95": ratio_95, "times_faster": times_faster})) == missed
