"""Checks shared by several cases. Pure."""

import numpy as np
from ols_demo import evaluate

from ols_faults import measure, mutations, pursuit
from ols_faults.case import Outcome
from ols_faults.configuration import ACCELERATION_DEG_S2
from ols_faults.evidence import Evidence

Window = tuple[int, int]

FRAME_HZ = 12.0  # of the scenario's cameras
SIGMAS = 3.0
CONSISTENT = 3.0  # RMS error over the predicted one: the systematic error is one draw per window
SIGMA_DEG = 0.06  # greater ones say nothing: errors of 0.03 deg are put into the scenario
ERROR_M = 0.5  # of targets, RMS; 0.03 to 0.2 are seen
PREDICTED_M = 0.3  # what the fusion may say of it; likewise
EXCESS_DEG_S = 2.0  # calm and after faults 0.1 to 0.3 are seen
ACCELERATION_MARGIN = 1.25  # of the shafts, taken over 60 ms
GOES_ON = {"tracking", "coasting"}


def seconds(window: Window) -> float:
    return (window[1] - window[0]) * 1e-6


def judge_angles(
    evidence: Evidence, outcome: Outcome, station: str, window: Window, tracked_s: float
) -> None:
    """No bearing beyond three of its sigmas, but for what a Gaussian has there; and sigmas that say
    something. `tracked_s`: so long of the window it should have published."""
    errors, sigmas = measure.bearing_errors(evidence.heard, station, *window)
    # A third is for frames that are lost, and coasting.
    outcome.at_least(
        f"{station}: bearings to judge",
        float(len(errors)),
        0.66 * FRAME_HZ * tracked_s,
        broken_by=mutations.bearings_lost(station, share=0.78),
    )
    ratio = np.abs(errors / sigmas).max(axis=1) if len(errors) else np.zeros(0)
    # Of n pairs so many are beyond by right; three deviations of that count on top.
    expected = 2 * 0.0027 * len(ratio)
    allowed = int(np.ceil(expected + 3.0 * np.sqrt(expected))) if len(ratio) >= 20 else 0
    wide_deg = float(np.degrees(np.median(sigmas))) if len(errors) else float("nan")
    off_deg = 6.0 * wide_deg
    outcome.at_most(
        f"{station}: bearings beyond {SIGMAS:g} sigmas",
        float((ratio > SIGMAS).sum()) if len(ratio) else None,
        allowed,
        note=f"of {len(ratio)}",
        broken_by=mutations.bearings_turned(station, off_deg, every=5),
    )
    measured = float(ratio.max()) if len(ratio) else None
    broken_by = mutations.bearings_turned(station, 2 * off_deg, every=10)
    outcome.at_most(f"{station}: greatest error in sigmas", measured, 4.5, broken_by=broken_by)
    outcome.at_most(
        f"{station}: median of the published sigmas",
        wide_deg,
        SIGMA_DEG,
        "deg",
        broken_by=mutations.sigmas_scaled(station, 5.0),
    )


def judge_motion(evidence: Evidence, outcome: Outcome, station: str, window: Window) -> None:
    """Checks by the true shafts and the true target that the PTU follows the target."""
    outcome.at_most(
        f"{station}: motion beyond what follows the target",
        pursuit.excess_deg_s(evidence.heard, station, *window),
        EXCESS_DEG_S,
        "deg/s",
        broken_by=mutations.swings(station, window),
    )
    outcome.at_most(
        f"{station}: hardest acceleration",
        pursuit.acceleration_deg_s2(evidence.heard, station, *window),
        ACCELERATION_MARGIN * ACCELERATION_DEG_S2,
        "deg/s^2",
        broken_by=mutations.jerks(station, window, 3 * ACCELERATION_DEG_S2),
    )


def judge_target(evidence: Evidence, outcome: Outcome, window: Window, least_hz: float) -> None:
    """Relative to the published error, because fewer stations are less accurate."""
    found = evaluate.accuracy(evidence.heard, evaluate.JOINT, window)
    measured = found["fixes"] / seconds(window)
    broken_by = mutations.targets_lost(share=0.78)
    outcome.at_least("targets", measured, least_hz, "Hz", broken_by=broken_by)
    measured = found.get("rmse_over_predicted")
    broken_by = mutations.target_sigmas_scaled(0.02)
    outcome.at_most("RMS error over predicted", measured, CONSISTENT, broken_by=broken_by)
    outcome.at_most(
        "RMS error", found["rmse_m"], ERROR_M, "m", broken_by=mutations.targets_shifted(0.7)
    )
    measured = found["predicted_rmse_m"]
    broken_by = mutations.target_sigmas_scaled(10.0)
    outcome.at_most(
        "error that the fusion predicts", measured, PREDICTED_M, "m", broken_by=broken_by
    )


def judge_goes_on(
    evidence: Evidence, outcome: Outcome, station: str, window: Window, least_hz: float
) -> None:
    """Checks that the station goes on tracking and sending bearings."""
    seen = measure.states(evidence.heard, station, *window)
    outcome.holds(
        f"{station}: goes on tracking",
        bool(seen) and not seen - GOES_ON,
        ", ".join(sorted(seen - GOES_ON)) or ("yes" if seen else "no status"),
        broken_by=mutations.in_state(station, "lost", window),
    )
    measured = measure.bearings_hz(evidence.heard, station, *window)
    broken_by = mutations.bearings_lost(station, window, 0.78)
    outcome.at_least(
        f"{station}: bearings meanwhile", measured, least_hz, "Hz", broken_by=broken_by
    )


def judge_outage(evidence: Evidence, outcome: Outcome, station: str, window: Window) -> None:
    """While the device is away there can be no bearing: else the fault was not done, or they are
    made up."""
    sent = measure.between(evidence.heard.bearings.get(station, []), *window)
    broken_by = mutations.goes_on_publishing(station, window)
    outcome.at_most(f"{station}: bearings meanwhile", float(len(sent)), 0.0, broken_by=broken_by)


def judge_tracking_again(
    evidence: Evidence, outcome: Outcome, what: str, station: str, since_us: int, limit_s: float
) -> None:
    """The recovery is its first bearing of an image taken since then."""
    measured = measure.tracking_again_s(evidence.heard, station, since_us, mutations.EVER)
    broken_by = mutations.not_tracking_for(station, since_us, limit_s)
    outcome.recovered(what, measured, limit_s, broken_by=broken_by)


def judge_rest(
    evidence: Evidence, outcome: Outcome, station: str, window: Window, limit_s: float
) -> None:
    """The PTU comes to rest within the limit after the window's start."""
    after_us = window[0] + round((limit_s + 0.1) * 1e6)
    measured = measure.rest_s(evidence.heard, station, *window)
    broken_by = mutations.moves_on(station, (window[0], after_us), 3.0)
    outcome.at_most("PTU at rest", measured, limit_s, "s", broken_by=broken_by)


def alarm_of(status: object, *words: str) -> str:
    """The first alarm that has all of these words; empty: none."""
    return next((a for a in status.alarm if all(word in a for word in words)), "")


def judge_alarm(
    evidence: Evidence,
    outcome: Outcome,
    what: str,
    station: str,
    since_us: int,
    limit_s: float,
    *words: str,
) -> None:
    """An alarm with all these words comes in time; before, there was none with the first."""
    recording, channel = evidence.heard, f"OLS_STATUS_{station}"
    before = [s for s in measure.statuses(recording, station, 0, since_us)][-1:]
    text = ""

    def alarmed(status: object) -> bool:
        nonlocal text
        text = alarm_of(status, *words)
        return bool(text)

    seen_s = measure.first_s(recording, channel, since_us, mutations.EVER, alarmed)
    broken_by = mutations.alarm_instead(station, words[0] + " trouble", (since_us, mutations.EVER))
    outcome.at_most(what, seen_s, limit_s, "s", note=text or "no such alarm", broken_by=broken_by)
    measured = bool(before) and not any(alarm_of(status, *words) for status in before)
    broken_by = mutations.alarm_instead(station, " ".join(words), (0, since_us))
    outcome.holds(f"{what}: not before it", measured, broken_by=broken_by)


def judge_counted(
    evidence: Evidence,
    outcome: Outcome,
    what: str,
    channel: str,
    names: str | tuple[str, ...],
    window: Window,
    least: float,
) -> None:
    """The sum of these counters."""
    names = (names,) if isinstance(names, str) else names
    counted = [measure.grown(evidence.heard, channel, name, *window) for name in names]
    silent = [mutations.without_counter(channel, name) for name in names]
    measured = None if None in counted else sum(counted)
    broken_by = mutations.together(f"{' and '.join(names)} not counted", *silent)
    outcome.at_least(what, measured, least, note=" + ".join(names), broken_by=broken_by)
