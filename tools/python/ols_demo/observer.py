"""The newest message of each kind from the running site."""

import time
from collections import deque
from typing import Any

import numpy as np
import ols_msg

FIRST_TARGET = 0  # of the scenario: the one that a run is judged by
STATES = {
    ols_msg.station_status_t.STATE_IDLE: "idle",
    ols_msg.station_status_t.STATE_MANUAL: "manual",
    ols_msg.station_status_t.STATE_TRACKING: "tracking",
    ols_msg.station_status_t.STATE_COASTING: "coasting",
    ols_msg.station_status_t.STATE_LOST: "lost",
    ols_msg.station_status_t.STATE_SLEWED: "slewed",
    ols_msg.station_status_t.STATE_STOPPED: "stopped",
    ols_msg.station_status_t.STATE_EMERGENCY: "emergency",
    ols_msg.station_status_t.STATE_HIDDEN: "hidden",
}


class Observer:
    """Newest messages, by station where they come from one."""

    def __init__(self) -> None:
        self.status: dict[str, Any] = {}
        self.view: dict[str, Any] = {}
        self._views: dict[str, deque[Any]] = {}
        self.turning_rad_s: dict[str, float] = {}  # rate of the camera between the newest views
        self.truth: Any = None
        self.target: dict[str, Any] = {}  # by channel
        self.fix: dict[str, Any] = {}  # the same, the newest with a position
        self.fusion: Any = None
        self.targets = 0

    def receive(self, channel: str, message: Any) -> None:
        if channel.startswith("OLS_STATUS_"):
            self.status[message.station] = message
        elif channel.startswith("OLS_SIM_VIEW_"):
            self._notice_turning(message)
            self.view[message.station] = message
            self._views.setdefault(message.station, deque(maxlen=60)).append(message)
        elif channel == "OLS_SIM_TRUTH" and message.target_id == FIRST_TARGET:
            self.truth = message
        elif channel == "OLS_FUSION_STATUS":
            self.fusion = message
        elif channel.startswith("OLS_TARGET"):
            self.target[channel] = message
            if message.solution == message.SOLUTION_OK and np.isfinite(message.latitude_deg):
                self.fix[channel] = message
            self.targets += channel == "OLS_TARGET"

    def _notice_turning(self, view: Any) -> None:
        before = self.view.get(view.station)
        if before is not None and view.utime > before.utime:
            turned = np.hypot(view.pan_rad - before.pan_rad, view.tilt_rad - before.tilt_rad)
            self.turning_rad_s[view.station] = turned / ((view.utime - before.utime) * 1e-6)

    def view_before(self, station: str, age_s: float) -> Any:
        """The newest view that is at least so old; None: there is none."""
        latest = time.time() - age_s
        views = reversed(self._views.get(station, deque()))
        return next((view for view in views if view.utime * 1e-6 <= latest), None)

    def state(self, station: str) -> str:
        status = self.status.get(station)
        return STATES.get(status.state, "unknown") if status else "silent"
