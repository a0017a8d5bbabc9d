"""The evidence of a case: messages and notes recorded during the fault.

Nothing here asks the site. A judge that gets the same evidence says the same, and evidence that is
altered as a broken product would have altered it must be judged as broken: see mutate.py.
"""

from __future__ import annotations

import bisect
import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from ols_demo.recording import Recording

TWIN = "OLS_TARGET_TWIN"  # of a second fusion, on an undisturbed bus: see Session.twin()
BEFORE_US = 20_000_000  # of what was heard before a case began, so much is kept with it

Change = Callable[[Any, int], list[tuple[Any, int]]]


def rows(recording: Recording, channel: str) -> list[Any]:
    """The messages of this channel in the order of arrival. The list may be altered in place."""
    station = channel.rsplit("_", 1)[-1]
    if channel.startswith("OLS_TARGET"):
        return recording.targets.setdefault(channel, [])
    if channel == "OLS_SIM_TRUTH":
        return recording.truth
    if channel == "OLS_FUSION_STATUS":
        return recording.fusion
    for prefix, of_stations in (
        ("OLS_SIM_VIEW_", recording.views),
        ("OLS_SIM_PTU_", recording.ptus),
        ("OLS_STATUS_", recording.statuses),
        ("OLS_BEARING_", recording.bearings),
    ):
        if channel.startswith(prefix):
            return of_stations.setdefault(station, [])
    raise ValueError(f"{channel} is not recorded")


def heard(recording: Recording, channel: str) -> Iterator[tuple[Any, int]]:
    """Each message of the channel with the instant of its arrival [us]."""
    return zip(rows(recording, channel), recording.arrivals_us.get(channel, []), strict=True)


def rewrite(recording: Recording, channel: str, change: Change) -> None:
    """Replaces each message and its arrival by the result of `change`."""
    changed = [
        row for message, at in heard(recording, channel) for row in change(copy.copy(message), at)
    ]
    changed.sort(key=lambda row: row[1])
    rows(recording, channel)[:] = [message for message, _ in changed]
    recording.arrivals_us[channel] = [at for _, at in changed]


def part(recording: Recording, first_us: int, last_us: int) -> Recording:
    """The part that arrived between the two; the messages themselves are shared."""
    result = Recording(start_us=recording.start_us)
    for channel, arrivals in recording.arrivals_us.items():
        span = slice(bisect.bisect_left(arrivals, first_us), bisect.bisect_right(arrivals, last_us))
        result.arrivals_us[channel] = arrivals[span]
        rows(result, channel)[:] = rows(recording, channel)[span]
    return result


@dataclass
class Evidence:
    """`heard` is the session's own recording while the case runs, and its part of it afterwards."""

    heard: Recording
    stations: list[str]
    facts: dict[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        return self.facts[name]

    def __setitem__(self, name: str, value: Any) -> None:
        self.facts[name] = value

    def copy(self) -> Evidence:
        """A copy that can be altered without changing this one."""
        whole = part(self.heard, -(1 << 62), 1 << 62)
        return Evidence(whole, list(self.stations), copy.deepcopy(self.facts))

    def close(self, begun_us: int, ended_us: int) -> None:
        """Ends the case: later messages do not belong to it."""
        self.heard = part(self.heard, begun_us - BEFORE_US, ended_us)
