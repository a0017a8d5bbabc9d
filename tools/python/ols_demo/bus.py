"""The messages of the site's LCM bus in Python."""

import re
import struct
from collections.abc import Callable
from typing import Any

import lcm
import ols_msg

LIVE_URL = "udpm://239.255.76.67:7667?ttl=0"

TYPES: list[tuple[str, Any]] = [
    (r"OLS_BEARING_.+", ols_msg.bearing_t),
    (r"OLS_STATUS_.+", ols_msg.station_status_t),
    (r"OLS_TARGET(_PAPER)?", ols_msg.target_t),
    (r"OLS_FUSION_STATUS", ols_msg.fusion_status_t),
    (r"OLS_CUE", ols_msg.cue_t),
    (r"OLS_CUE_ORDER", ols_msg.cue_order_t),
    (r"OLS_INCIDENT", ols_msg.incident_t),
    (r"OLS_SIM_TRUTH", ols_msg.truth_target_t),
    (r"OLS_SIM_VIEW_.+", ols_msg.truth_view_t),
    (r"OLS_SIM_PTU_.+", ols_msg.truth_ptu_t),
]


def decode(channel: str, data: bytes) -> Any | None:
    """The message, or None for an unknown channel."""
    for pattern, kind in TYPES:
        if re.fullmatch(pattern, channel):
            message = kind.decode(data)
            # lcm-gen's Python returns an array of booleans as an iterator, which can be read once.
            if isinstance(message, ols_msg.target_t):
                message.used = list(message.used)
            return message
    return None


def counters(status: Any) -> dict[str, float]:
    """The named counters of a station's or the fusion's status."""
    return dict(zip(status.counter_name, status.counter_value, strict=True))


class Bus:
    """Calls `handler(channel, message)` for every message that is known."""

    def __init__(self, url: str, handler: Callable[[str, Any], None], trust: Any = None):
        """trust: an ols.Trust or keys.Members, by whose keys `publish` signs."""
        self.lcm = lcm.LCM(url)
        self._handler, self._trust = handler, trust
        self.undecodable = 0
        for pattern, _ in TYPES:
            self.lcm.subscribe(pattern, self._receive).set_queue_capacity(1000)

    def _receive(self, channel: str, data: bytes) -> None:
        # For the stations' boots, which commands must name. Whoever only looks believes everything.
        if self._trust is not None and channel.startswith("OLS_STATUS_"):
            self._trust.hear(channel, data)
        try:
            message = decode(channel, data)
        except (ValueError, struct.error):  # any program can send anything on any channel
            self.undecodable += 1
            return
        if message is not None:
            self._handler(channel, message)

    def publish(self, channel: str, data: bytes) -> None:
        self.lcm.publish(channel, self._trust.sign(channel, data) if self._trust else data)

    def handle(self, timeout_s: float) -> None:
        """Handles what has arrived, waiting at most timeout_s for the first."""
        timeout_ms = int(timeout_s * 1e3)
        while self.lcm.handle_timeout(timeout_ms) > 0:
            timeout_ms = 0
