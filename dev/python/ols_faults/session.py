"""The simulated site under test: its processes, bus, recorded messages and recovery."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import ols_msg
from ols_demo import evaluate
from ols_demo.bus import LIVE_URL
from ols_demo.observer import STATES, Observer
from ols_demo.operator import Operator
from ols_demo.recording import Recording
from ols_demo.site import Site, SiteError
from ols_demo.wiring import Wiring

from ols_faults import measure
from ols_faults.evidence import TWIN
from ols_faults.wire import Ear

QUIET_URL = "udpm://239.255.76.70:7670?ttl=0"  # of a second, undisturbed fusion
TO_FUSION = ("OLS_BEARING_", "OLS_STATUS_")
RESTORE_S = 90.0
BY_SLEWS_S = 8.0  # after that the operator designates again
OTHER_OBJECT_DEG = 0.5
REARM_HELD_S = 1.5  # a second is asked for
REARM_AGAIN_S = 2.5
OF_STATIONS = ("OLS_BEARING_", "OLS_STATUS_", "OLS_SIM_VIEW_", "OLS_SIM_PTU_")


def belongs(channel: str, message: Any) -> bool:
    """Not what calls itself another station's than its channel is."""
    prefix = next((p for p in OF_STATIONS if channel.startswith(p)), None)
    return prefix is None or message.station == channel.removeprefix(prefix)


class Session:
    """One simulated site. Nothing here judges."""

    def __init__(self, wiring: Wiring, site: Site, seed: int, disk: Path):
        self.wiring, self.site, self.seed = wiring, site, seed
        self.disk = disk  # of disk_station: a small one of its own
        self.heard = Recording()
        self.observer = Observer()
        self.bus = Ear(LIVE_URL, self.hear)
        self.operator = Operator(self.bus.lcm, self.observer, seed)
        self._sequence = 0
        self._restoring_us = 0
        self._rearmed: dict[str, float] = {}
        self._handlers: list[Callable[[], None]] = []
        self._listeners: list[Callable[[str, Any], None]] = []

    def add_handler(self, handler: Callable[[], None]) -> None:
        """Is called in every turn."""
        self._handlers.append(handler)

    def remove_handler(self, handler: Callable[[], None]) -> None:
        self._handlers.remove(handler)

    def hear(self, channel: str, message: Any, at_us: int) -> None:
        if not belongs(channel, message):
            return
        self.heard.receive(channel, message, at_us)
        self.observer.receive(channel, message)
        for listener in self._listeners:
            listener(channel, message)

    @contextmanager
    def twin(self) -> Iterator[None]:
        """A second fusion meanwhile: it hears what the stations sent on a bus of its own, where
        nothing is disturbed; its targets are recorded as OLS_TARGET_TWIN. Its slews are ignored."""

        def hear_target(channel: str, message: Any, at_us: int) -> None:
            if channel == evaluate.JOINT:
                self.heard.receive(TWIN, message, at_us)

        ear = Ear(QUIET_URL, hear_target)

        def pass_on(channel: str, message: Any) -> None:
            if channel.startswith(TO_FUSION):
                ear.lcm.publish(channel, message.encode())

        def handle() -> None:
            ear.handle(0.0)

        self.wiring.start_fusion(self.site, QUIET_URL, "twin")
        self._listeners.append(pass_on)
        self.add_handler(handle)
        try:
            yield
        finally:
            self.remove_handler(handle)
            self._listeners.remove(pass_on)
            if "twin" in self.site.processes:
                self.site.stop("twin")
            ear.close()

    @property
    def sensor_station(self) -> str:
        """The station whose pose is not surveyed."""
        return self.stations[-1]

    @property
    def clock_station(self) -> str:
        return self.stations[2]

    @property
    def disk_station(self) -> str:
        return self.stations[0]

    @property
    def stations(self) -> list[str]:
        return self.wiring.stations

    @staticmethod
    def now_us() -> int:
        return time.time_ns() // 1000

    def turn(self, timeout_s: float = 0.02) -> None:
        self.bus.handle(timeout_s)
        for handler in self._handlers:
            handler()

    def run(self, seconds: float) -> tuple[int, int]:
        """Lets the site run; returns the window of that time [us]."""
        start_us, end = self.now_us(), time.monotonic() + seconds
        while time.monotonic() < end:
            self.turn()
        return start_us, self.now_us()

    def wait(self, condition: Callable[[], bool], deadline_s: float) -> float | None:
        """Seconds until the condition held, or None if it did not hold before the deadline."""
        start = time.monotonic()
        while not condition():
            if time.monotonic() - start > deadline_s:
                return None
            self.turn()
        return time.monotonic() - start

    @contextmanager
    def without_log(self) -> Iterator[None]:
        """The public lcm-logger, which the run is recorded with, is no part of the product: it dies
        of fragments, and two million messages are much for a disk."""
        logged = "lcm-logger" in self.site.processes
        if logged:
            self.site.stop("lcm-logger")
        try:
            yield
        finally:
            if logged:
                self.wiring.start_log(self.site)

    # What stations say.

    def status(self, station: str) -> Any:
        return self.observer.status.get(station)

    def statuses_since(self, station: str, since_us: int) -> list[Any]:
        return measure.statuses(self.heard, station, since_us, self.now_us())

    def state(self, station: str) -> str:
        return self.observer.state(station)

    def fresh_status(self, station: str, deadline_s: float = 3.0) -> Any:
        """Waits for a status sent after this call; None if none comes."""
        since_us = self.now_us()
        if self.wait(lambda: bool(self.statuses_since(station, since_us)), deadline_s) is None:
            return None
        return self.status(station)

    def tracks(self, station: str, since_us: int = 0) -> bool:
        """Whether it tracks by its newest status since then."""
        recent = self.statuses_since(station, since_us)
        return bool(recent) and STATES.get(recent[-1].state) == "tracking"

    def wait_for_tracking(self, station: str, since_us: int, deadline_s: float) -> None:
        """Waits until it has sent a bearing of an image taken since then, or until the deadline."""
        self.wait(
            lambda: (
                measure.tracking_again_s(self.heard, station, since_us, self.now_us()) is not None
            ),
            deadline_s,
        )

    def speed_deg_s(self, station: str) -> float:
        """The present speed of the PTU's true shafts."""
        now_us = self.now_us()
        times, angles = measure.ptu_track(self.heard, station, now_us - 150_000, now_us)
        return float(np.median(measure.speeds(times, angles))) if len(times) > 10 else 0.0

    def wait_until_turning(self, station: str, deg_s: float, deadline_s: float) -> None:
        self.wait(lambda: self.speed_deg_s(station) > deg_s, deadline_s)

    # Actions on the site.

    def publish(self, channel: str, message: Any) -> None:
        self.bus.lcm.publish(channel, message.encode())

    def fault(self, kind: str, station: str, duration_s: float, value: float = float("nan")) -> int:
        """Applies a fault from now on; returns the time."""
        message = ols_msg.sim_fault_t()
        message.utime, message.kind, message.station = self.now_us(), kind, station
        message.duration_s, message.value = duration_s, value
        self.publish("OLS_SIM_FAULT", message)
        return message.utime

    def address(self, message: Any, station: str) -> Any:
        """Fills the fields that all commands share: fresh, valid, for this station."""
        self._sequence += 1
        message.utime = self.now_us()
        message.schema_version = message.SCHEMA_VERSION
        message.boot_id = 1_000_000 + os.getpid()
        message.sequence = self._sequence
        message.station = station
        message.lease_s = 1.0
        return message

    def command(self, station: str, what: int, pan_rad: float = 0.0, tilt_rad: float = 0.0) -> None:
        message = self.address(ols_msg.ptu_command_t(), station)
        message.command, message.pan_rad, message.tilt_rad = what, pan_rad, tilt_rad
        self.publish(f"OLS_PTU_{station}", message)

    def process(self, station: str) -> str:
        return f"ols-station-{station}"

    def pid(self, name: str) -> int:
        return self.site.processes[name].pid

    def kill(self, name: str) -> int:
        """Sends SIGKILL; returns the time."""
        at_us = self.now_us()
        self.site.stop(name, signal.SIGKILL)
        return at_us

    def send_signal(self, name: str, how: signal.Signals) -> int:
        at_us = self.now_us()
        self.site.processes[name].send_signal(how)
        return at_us

    def start_station(self, station: str, environment: dict[str, str] | None = None) -> int:
        """Starts its process and forgets its earlier status; returns the time."""
        at_us = self.now_us()
        self.observer.status.pop(station, None)
        self.wiring.start_station(self.site, station, environment)
        return at_us

    def start_fusion(self, url: str = LIVE_URL) -> int:
        at_us = self.now_us()
        self.wiring.start_fusion(self.site, url)
        return at_us

    def release_held(self, station: str) -> None:
        """Releases a station that comes up stopped because it was in manual control when killed."""
        self.wait(lambda: self.state(station) == "stopped", 5.0)
        self.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)

    def rearm(self, station: str) -> None:
        """Holds the station's button, unless it is held already: it must be released in between."""
        now = time.monotonic()
        if now - self._rearmed.get(station, -REARM_AGAIN_S) >= REARM_AGAIN_S:
            self._rearmed[station] = now
            self.fault("rearm-button", station, REARM_HELD_S)

    # Processes that ended on their own.

    def ended(self) -> list[str]:
        return [name for name, p in self.site.processes.items() if p.poll() is not None]

    def bury(self) -> list[str]:
        """Removes ended processes, so that restore() starts them again; returns their names."""
        names = self.ended()
        for name in names:
            del self.site.processes[name]
        return names

    def can_go_on(self) -> bool:
        """Whether the site can continue: only the simulation cannot be restarted."""
        return "ols-sim" in self.site.processes and not self.ended()

    def close(self) -> None:
        self.bus.close()

    # Back to normal.

    def restore(self) -> None:
        """Restarts what ended; waits until all stations track and targets arrive, or SiteError."""
        self.fault_ends()
        if "ols-fusion" not in self.site.processes:
            self.start_fusion()
        for station in self.stations:
            if self.process(station) not in self.site.processes:
                self.start_station(station)
        self.site.check()
        start, self._restoring_us = time.monotonic(), self.now_us()
        looked = 0.0
        by_hand: set[str] = set()
        while not self.well():
            now = time.monotonic()
            if now - start > RESTORE_S:
                missing = [s for s in self.stations if not self.on_target(s)]
                raise SiteError(f"not back to normal after {RESTORE_S:.0f} s: {missing}")
            if now - looked > 1.0:
                looked = now
                self._free(by_hand)
                if now - start > BY_SLEWS_S or not self.operator.tracking:
                    by_hand |= self._take_in_hand()
            if by_hand:
                self.operator.act(by_hand)
            self.turn()

    def fault_ends(self) -> None:
        self.fault("all", "", 0.0)

    def well(self) -> bool:
        since_us = self.now_us() - 1_500_000
        recent = self.heard.targets.get("OLS_TARGET", [])[-1:]
        located = bool(recent) and recent[0].utime > since_us and sum(recent[0].used) >= 3
        return located and all(self.on_target(s) for s in self.stations)

    def on_target(self, station: str) -> bool:
        """Whether it now tracks the target itself: a station believes in other objects, too."""
        now_us = self.now_us()
        since_us = max(now_us - 1_500_000, self._restoring_us)
        if not self.tracks(station, since_us):
            return False
        errors, _ = measure.bearing_errors(self.heard, station, since_us, now_us)
        return len(errors) > 0 and bool(np.hypot(*errors[-1]) < np.radians(OTHER_OBJECT_DEG))

    def _free(self, by_hand: set[str]) -> None:
        for station in self.stations:
            if self.state(station) == "emergency":
                self.rearm(station)
            elif self.state(station) in ("manual", "stopped") and station not in by_hand:
                self.command(station, ols_msg.ptu_command_t.COMMAND_RELEASE)

    def _take_in_hand(self) -> set[str]:
        """The stations that the operator must point and designate again."""
        astray = {s for s in self.stations if not self.on_target(s)}
        for station in astray:
            self.operator.tracking.discard(station)
            if self.state(station) == "tracking":  # something else
                self.command(station, ols_msg.ptu_command_t.COMMAND_STOP)
        return astray
