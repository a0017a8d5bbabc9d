"""Whether belief means what it says, over all judged frames of all clips together.

"On target" is a visible target and a box whose centre is within 20 px of its. Frames without a box
count as well: the tracker says how sure it is there too, and it is not on target.
"""

import numpy as np

from ols_bench.measures import BELIEVED, Judged

BINS = 10
# A loss: off target for this long at least, after having been on it. Shorter excursions end by
# themselves before anybody could notice.
LEAST_LOSS_S = 1.0 / 3.0
NOTICED_IN_TIME_S = 0.33
HALF = 0.5  # of the union of box and label is in both
LEAP_PX = 60.0  # from one frame to the next nothing that is followed goes so far


def reliability(belief: np.ndarray, on_target: np.ndarray) -> list[dict]:
    """For each tenth of belief that occurs: mean belief, share on target, frames."""
    index = np.minimum((belief * BINS).astype(int), BINS - 1)
    return [
        {
            "belief": float(belief[index == i].mean()),
            "on_target": float(on_target[index == i].mean()),
            "frames": int((index == i).sum()),
        }
        for i in range(BINS)
        if (index == i).any()
    ]


def calibration_error(rows: list[dict]) -> float:
    """Expected calibration error: mean gap between belief and truth, weighted by frames."""
    total = sum(row["frames"] for row in rows)
    return sum(abs(row["belief"] - row["on_target"]) * row["frames"] for row in rows) / total


def auroc(belief: np.ndarray, on_target: np.ndarray) -> float | None:
    """Chance that a frame on target is believed in more than one that is not; ties count half."""
    positive, negative = int(on_target.sum()), int((~on_target).sum())
    if not positive or not negative:
        return None
    from scipy import stats  # it takes a second, which most who import this do not need

    ranks = stats.rankdata(belief)
    return float((ranks[on_target].sum() - positive * (positive + 1) / 2) / (positive * negative))


def off_target_believed(judged: list[Judged], on_target: list[np.ndarray]) -> float | None:
    """Share of the frames off target that are believed in, over all of them."""
    off = np.concatenate([~on for on in on_target])
    believed = np.concatenate([j.believed for j in judged])
    return float(believed[off].mean()) if off.any() else None


def losses(judged: Judged, on_target: np.ndarray) -> list[float]:
    """Seconds from the first frame off target to the first one not believed in, for each loss of a
    target that was believed in; infinite where the loss ends or the clip does before that."""
    believed = judged.believed
    least = LEAST_LOSS_S * judged.frames_per_second
    noticed = []
    start = None
    for k in range(len(on_target) + 1):
        off = k < len(on_target) and not on_target[k]
        if off and start is None:
            start = k
        elif not off and start is not None:
            if k - start >= least and (start == 0 or believed[start - 1]):
                doubts = np.flatnonzero(~believed[start:k])
                time = doubts[0] / judged.frames_per_second if len(doubts) else np.inf
                noticed.append(float(time))
            start = None
    return noticed


def followed_on(judged: Judged) -> np.ndarray:
    """Frames without a labelled target in which what was on target in a labelled one is followed
    still: believed in, and without a leap, in every frame since. A tracker that slid from it onto
    something else meanwhile is among them: look at the images."""
    goes_on = False
    frames = np.zeros(len(judged.visible), dtype=bool)
    for k, visible in enumerate(judged.visible):
        unbroken = judged.believed[k] and judged.step[k] < LEAP_PX
        goes_on = bool(unbroken and (judged.on_target[k] if visible else goes_on))
        frames[k] = goes_on and not visible
    return frames


def measures_of(judged: list[Judged], on_target: list[np.ndarray]) -> dict:
    belief, on = np.concatenate([j.belief for j in judged]), np.concatenate(on_target)
    rows = reliability(belief, on)
    times = [t for j, of_clip in zip(judged, on_target, strict=True) for t in losses(j, of_clip)]
    return {
        "calibration_error": calibration_error(rows),
        "auroc": auroc(belief, on),
        "off_target": int((~on).sum()),
        "off_target_believed": off_target_believed(judged, on_target),
        "reliability": rows,
        "losses": len(times),
        "noticed_in_time": (
            float(np.mean([time <= NOTICED_IN_TIME_S for time in times])) if times else None
        ),
        "noticed_median_s": (
            float(np.median(times)) if times and np.isfinite(np.median(times)) else None
        ),
    }


def belief_measures(judged: list[Judged]) -> dict | None:
    """By the labels; with what is followed on where a label ends taken for the target; and with
    what covers half of a label, of which 20 px may be a small part. Nothing for trackers that have
    no belief."""
    if any(j.belief is None for j in judged):
        return None
    same = [followed_on(j) for j in judged]
    absent = sum(int((~j.visible).sum()) for j in judged)
    on_target = [j.on_target | f for j, f in zip(judged, same, strict=True)]
    covering = [j.on_target | (j.visible & (j.overlap >= HALF)) for j in judged]
    return {
        "followed_on": sum(int(f.sum()) for f in same) / absent if absent else None,
        **measures_of(judged, [j.on_target for j in judged]),
        "with_followed_on": measures_of(judged, on_target),
        "with_covering": measures_of(judged, covering),
        "believed_threshold": BELIEVED,
    }
