"""How sure the ratio of two estimators' errors is."""

import numpy as np
import pytest
from ols_bench.fusion_recordings import BLOCK_US, ratio_interval

STEP_US = 100_000


def errors(random, scale, shared):
    """Of a minute: `shared` errors of each block, and noise of each fix."""
    sd = np.ones(3)
    return {
        i * STEP_US: (scale * (shared[i * STEP_US // BLOCK_US] + random.normal(0, 0.3, 3)), sd)
        for i in range(600)
    }


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_ratio_s_interval_has_the_truth(seed):
    random = np.random.default_rng(seed)
    shared = random.normal(0, 1, (20, 3))
    least_squares = errors(random, 1.0, shared)
    instants = sorted(least_squares)
    (low, high), blocks = ratio_interval(errors(random, 1.5, shared), least_squares, instants)
    assert blocks == 20
    assert (low < 1.5).all() and (high > 1.5).all()
    assert (low > 1.2).all() and (high < 1.9).all()


def test_errors_that_are_alike_for_seconds_tell_little():
    """Two estimators of equal worth whose errors have nothing in common."""
    random = np.random.default_rng(4)
    own, other = (errors(random, 1.0, random.normal(0, 1, (20, 3))) for _ in range(2))
    (low, high), _ = ratio_interval(own, other, sorted(own))
    assert (low < 1.0).all() and (high > 1.0).all()
    assert (high - low > 0.15).all(), "600 independent fixes would tell it to a tenth"
