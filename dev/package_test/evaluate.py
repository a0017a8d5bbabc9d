"""What the recorder at the centre has heard."""

import itertools

import lcm
from ols_msg import target_t


def heard(folder, channel, start_us, end_us):
    for path in sorted(folder.rglob("*.lcmlog*")):
        for event in lcm.EventLog(str(path), "r"):
            if event.channel == channel and start_us <= event.timestamp <= end_us:
                yield event


def bearing_gap_s(folder, station, start_us, end_us):
    """The longest time without one, from start to end."""
    times = [event.timestamp for event in heard(folder, f"OLS_BEARING_{station}", start_us, end_us)]
    times = sorted({start_us, *times, end_us})
    return max(later - earlier for earlier, later in itertools.pairwise(times)) * 1e-6


def target_ids(folder, start_us, end_us):
    """Of the targets that had a position."""
    events = heard(folder, "OLS_TARGET", start_us, end_us)
    decoded = (target_t.decode(event.data) for event in events)
    return sorted({target.target_id for target in decoded if target.solution == target.SOLUTION_OK})
