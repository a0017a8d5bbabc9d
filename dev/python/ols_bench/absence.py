"""What a tracker makes of a target that is away: whether it believes on, and finds it again.

Frames without a label. Meant for clips whose target truly is not visible there (`hiding.py`).
"""

import numpy as np

from ols_bench.measures import Judged

FIRST_FRAMES = 10  # of an absence: nobody can be sure sooner
LEAST_ABSENCE = 5  # frames; the end of a shorter one is no return
FOUND_IN_S = 0.5


def absences(judged: Judged) -> list[tuple[int, int]]:
    """First frame without the target and the first one after it, of each."""
    edges = np.diff(np.concatenate([[True], judged.visible, [True]]).astype(int))
    return list(zip(np.flatnonzero(edges < 0), np.flatnonzero(edges > 0), strict=True))


def late_frames(judged: Judged) -> np.ndarray:
    """Absent frames after the tenth of their absence."""
    late = np.zeros(len(judged.visible), dtype=bool)
    for start, end in absences(judged):
        late[start + FIRST_FRAMES : end] = True
    return late


def found_after_s(judged: Judged) -> list[float]:
    """For each return: seconds from the first labelled frame to the first one that is believed in
    and on target, infinite if there is none before the label ends. Returns that end sooner than
    a tracker must have found them, unfound, are not judged."""
    found = judged.on_target & judged.believed
    times = []
    for start, back in absences(judged):
        away = np.flatnonzero(~judged.visible[back:])
        end = back + int(away[0]) if len(away) else len(judged.visible)
        if back == end or back - start < LEAST_ABSENCE:
            continue
        hits = np.flatnonzero(found[back:end])
        if len(hits):
            times.append(float(hits[0] / judged.frames_per_second))
        elif end - back > FOUND_IN_S * judged.frames_per_second:
            times.append(np.inf)
    return times


def absence_measures(judged: list[Judged]) -> dict:
    """Belief is null for a tracker without it; its boxes count as believed in where a target is
    found again."""
    late = sum(int(late_frames(j).sum()) for j in judged)
    times = [time for j in judged for time in found_after_s(j)]
    believed = None
    if late and all(j.belief is not None for j in judged):
        believed = sum(int((late_frames(j) & j.believed).sum()) for j in judged) / late
    return {
        "late_absent": late,
        "late_absent_believed": believed,
        "returns": len(times),
        "found_again_in_time": (
            float(np.mean([time <= FOUND_IN_S for time in times])) if times else None
        ),
    }
