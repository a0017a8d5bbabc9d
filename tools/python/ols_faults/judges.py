"""What several cases judge in the same way."""

import numpy as np
from ols_demo import evaluate

from ols_faults import measure
from ols_faults.case import Outcome
from ols_faults.session import Session

SPEED_LIMIT_DEG_S = 57.5  # ServoConfig::max_speed_rad_s
SIGMAS = 3.0
HONEST = 2.0  # RMS error of a few seconds over what the covariances say


def judge_angles(session: Session, outcome: Outcome, station: str, window: tuple[int, int]) -> None:
    """No bearing beyond three of its sigmas, but for what a Gaussian has there."""
    errors, sigmas = measure.bearing_errors(session.heard, station, *window)
    outcome.at_least("bearings to judge", float(len(errors)), 5.0)
    if not len(errors):
        return
    ratio = np.abs(errors / sigmas).max(axis=1)
    # Of n pairs so many are beyond by right; three deviations of that count on top.
    expected = 2 * 0.0027 * len(ratio)
    allowed = int(np.ceil(expected + 3.0 * np.sqrt(expected))) if len(ratio) >= 20 else 0
    beyond = int((ratio > SIGMAS).sum())
    outcome.at_most(f"of {len(ratio)} bearings beyond {SIGMAS:g} sigmas", beyond, allowed)
    outcome.at_most("greatest error in sigmas", float(ratio.max()), 4.5)


def judge_motion(session: Session, outcome: Outcome, station: str, window: tuple[int, int]) -> None:
    fastest = measure.fastest_deg_s(session.heard, station, *window)
    outcome.at_most("fastest motion", fastest, SPEED_LIMIT_DEG_S, "deg/s")


def judge_target(session: Session, outcome: Outcome, window: tuple[int, int]) -> None:
    """Fewer stations are less exact: what they publish of their own error counts."""
    found = evaluate.accuracy(session.heard, evaluate.JOINT, window)
    outcome.at_most("RMS error over predicted", found.get("rmse_over_predicted"), HONEST)
    outcome.at_most("RMS error", found["rmse_m"], 1.0, "m")
