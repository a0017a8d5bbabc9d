"""What becomes of a site under attack, judged by what its members have signed."""

import time
from collections import deque
from dataclasses import dataclass, field
from typing import Any

import lcm
import numpy as np
import ols
import ols_msg
from ols_demo.bus import LIVE_URL, counters
from ols_demo.evaluate import errors_enu, solved
from ols_demo.recording import Recording

EAVESDROPPED = 500  # messages kept of each channel
LONGEST_S = 30.0  # until a genuine message of each kind was heard
FALSE_M = 20.0  # a target this far from the true one is another
TRACKING = ols_msg.station_status_t.STATE_TRACKING


def refused(status: Any) -> dict[str, float]:
    """Messages refused before they reached a station or the fusion, by reason."""
    found = {}
    for name, value in counters(status).items():
        for prefix in ("bus_distrusted_", "messages_refused_"):
            if name.startswith(prefix):
                reason = name.removeprefix(prefix)
                found[reason] = found.get(reason, 0.0) + value
    return found


def obeyed(status: Any) -> float:
    """Commands of a person that were obeyed: in a run that nobody commands, none."""
    return sum(
        value
        for name, value in counters(status).items()
        if name.endswith("_accepted") and not name.startswith("slew")
    )


@dataclass
class Phase:
    """What was heard in one span of time."""

    begin_us: int
    recording: Recording = field(default_factory=Recording)
    bearing_s: list[float] = field(default_factory=list)  # exposure to arrival
    offsets_px: list[float] = field(default_factory=list)
    away: int = 0  # statuses of stations that do not track


class Watch:
    """Believes what a member of the site would believe."""

    def __init__(self, keys: str, stations: list[str]):
        self.stations = stations
        self._member = ols.Trust(keys, "logger", 97)
        self._bus = lcm.LCM(LIVE_URL)
        self.heard: dict[str, deque[bytes]] = {}
        self.status: dict[str, Any] = {}
        self.fusion: Any = None
        self.fixes: deque[float] = deque(maxlen=200)  # monotonic arrivals
        self.truth = Recording()
        self.phase = Phase(time.time_ns() // 1000)
        for station in stations:
            for kind in ("BEARING", "STATUS", "SLEW"):
                self._subscribe(f"OLS_{kind}_{station}", getattr(self, f"_{kind.lower()}"))
        self._subscribe("OLS_TARGET", self._target)
        self._subscribe("OLS_FUSION_STATUS", self._fusion)
        self._subscribe("OLS_SIM_TRUTH", self._truth)

    def _subscribe(self, channel: str, take: Any) -> None:
        def receive(name: str, data: bytes) -> None:
            if self._member.hear(name, data) is None:
                take(name, data)

        self._bus.subscribe(channel, receive).set_queue_capacity(20_000)

    def _keep(self, channel: str, data: bytes) -> None:
        self.heard.setdefault(channel, deque(maxlen=EAVESDROPPED)).append(data)

    def _bearing(self, channel: str, data: bytes) -> None:
        self._keep(channel, data)
        message = ols_msg.bearing_t.decode(data)
        self.phase.bearing_s.append(time.time() - message.utime * 1e-6)

    def _slew(self, channel: str, data: bytes) -> None:
        self._keep(channel, data)

    def _status(self, channel: str, data: bytes) -> None:
        self._keep(channel, data)
        message = ols_msg.station_status_t.decode(data)
        self.status[message.station] = message
        self.phase.away += message.state != TRACKING
        offset = np.hypot(*message.target_offset_px)
        if np.isfinite(offset):
            self.phase.offsets_px.append(float(offset))

    def _target(self, _channel: str, data: bytes) -> None:
        message = ols_msg.target_t.decode(data)
        self.fixes.append(time.monotonic())
        self.phase.recording.receive("OLS_TARGET", message, time.time_ns() // 1000)

    def _fusion(self, _channel: str, data: bytes) -> None:
        self.fusion = ols_msg.fusion_status_t.decode(data)

    def _truth(self, _channel: str, data: bytes) -> None:
        self.phase.recording.receive("OLS_SIM_TRUTH", ols_msg.truth_target_t.decode(data), 0)

    def handle(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while (left_s := end - time.monotonic()) > 0.0:
            self._bus.handle_timeout(max(1, int(1e3 * min(left_s, 0.05))))

    def begin(self) -> None:
        while self._bus.handle_timeout(0) > 0:
            pass  # of before
        self.phase = Phase(time.time_ns() // 1000)

    def eavesdropped(self) -> dict[str, list[bytes]]:
        """By channel; waits until each station was heard, and was sent a slew: on a busy machine a
        fusion's first slew may come after the first bearings."""
        kinds = ("BEARING", "STATUS", "SLEW")
        wanted = {f"OLS_{kind}_{station}" for kind in kinds for station in self.stations}
        end = time.monotonic() + LONGEST_S
        while not wanted <= self.heard.keys():
            if time.monotonic() > end:
                missing = ", ".join(sorted(wanted - self.heard.keys()))
                raise TimeoutError(f"not heard within {LONGEST_S:.0f} s: {missing}")
            self.handle(0.1)
        return {channel: list(messages) for channel, messages in self.heard.items()}

    def counted(self, victim: str) -> dict[str, float]:
        """By reason, in a status of its own from now on."""
        newest = self._newest(victim)
        end = time.monotonic() + 20.0
        while self._newest(victim) is newest:
            if time.monotonic() > end:
                raise RuntimeError(f"no status of {victim}")
            self.handle(0.05)
        return refused(self._newest(victim))

    def _newest(self, victim: str) -> Any:
        return self.fusion if victim == "fusion" else self.status.get(victim)

    def obeyed(self) -> float:
        return sum(obeyed(status) for status in self.status.values())

    def fix_rate_hz(self) -> float:
        """Of the last second."""
        now = time.monotonic()
        return float(sum(now - at <= 1.0 for at in self.fixes))

    def follows(self) -> bool:
        """Whether all stations track, as they say themselves."""
        return all(
            station in self.status and self.status[station].state == TRACKING
            for station in self.stations
        )

    def figures(self) -> dict[str, Any]:
        """Of the phase until now."""
        phase, end_us = self.phase, time.time_ns() // 1000
        seconds = (end_us - phase.begin_us) * 1e-6
        window = (phase.begin_us, end_us)
        indices = solved(phase.recording, "OLS_TARGET", window)
        errors = np.linalg.norm(errors_enu(phase.recording, "OLS_TARGET", indices), axis=1)
        errors = errors[np.isfinite(errors)]
        true = errors[errors < FALSE_M]
        targets = phase.recording.targets.get("OLS_TARGET", [])
        arrivals = phase.recording.arrivals_us.get("OLS_TARGET", [])
        target_s = [(a - targets[i].utime) * 1e-6 for i, a in enumerate(arrivals)]

        def rms(values: Any) -> float | None:
            return float(np.sqrt(np.mean(np.square(values)))) if len(values) else None

        def percentiles(values: Any) -> list[float] | None:
            return [float(p) for p in np.percentile(values, [50, 99])] if len(values) else None

        return {
            "fixes_hz": len(indices) / seconds,
            "error_m": rms(true),
            "false_targets": int(np.sum(errors >= FALSE_M)),
            "offset_px": rms(phase.offsets_px),
            "bearing_s": percentiles(phase.bearing_s),
            "target_s": percentiles(target_s),
            "away": phase.away,
        }
