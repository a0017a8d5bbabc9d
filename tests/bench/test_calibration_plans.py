"""Where the bench of the calibration looks: by the product's own plans."""

import numpy as np
from ols_calibration import cases


def test_the_stars_are_looked_for_low_and_high_from_all_sides():
    plan = cases.plan("stars", 20)
    assert len(plan) == 20
    tilts = np.array([tilt for _, tilt, _ in plan])
    assert tilts[::2].max() < tilts[1::2].min()
    assert {approach for *_, approach in plan} == {(1, 1), (1, -1), (-1, 1), (-1, -1)}


def test_the_sweep_is_a_ring_for_the_field_of_view_that_is_given():
    wide, narrow = (
        cases.plan("sweep", 92, "--across", across, "--up", 4.1) for across in (5.5, 2.0)
    )
    assert len(wide) == len(narrow) == 92
    reach_deg = [max(abs(pan) for pan, *_ in plan) for plan in (wide, narrow)]
    assert reach_deg[0] > 100.0
    assert reach_deg[1] < 0.5 * reach_deg[0]
