import numpy as np
import pytest

SEED = 20240229


def pytest_report_header():
    return f"oracle: random stations from seed {SEED}"


@pytest.fixture
def rng():
    return np.random.default_rng(SEED)
