"""The demo's stand-in for the operator: points each station roughly and designates the target.

It sees what a person would see in the pictures (the simulator tells it where the target is in each
view) and acts through the same messages as `ols-ctl`.
"""

import random
import time
from typing import Any

import numpy as np
import ols
import ols_msg

from ols_demo.observer import Observer
from ols_demo.places import geodetic

POINT_INTERVAL_S = 1.5  # time for the unit to arrive and stand
AT_REST_RAD_S = np.radians(0.3)
PATIENCE_S = 2.0  # after a designation, before the next attempt
MARGIN = 0.12  # of the picture: no designation so near to its edge
LEAST_BOX_PX = 8.0  # of a side: nobody draws a smaller one
LEASE_S = 2.0
FRESH_S = 0.8
PICTURE_S = 0.25  # until a picture that was exposed is before a person, and at its station


class Operator:
    """One person who looks after all stations; seeded, so that a run can be repeated."""

    def __init__(self, bus: Any, observer: Observer, seed: int, box_sd_px: float = 1.0):
        self._bus, self._observer, self._box_sd_px = bus, observer, box_sd_px
        self._random = random.Random(seed)
        self._boot_id = seed + 1
        self._sequence = 0
        self._pointed: dict[str, float] = {}  # when, by the monotonic clock
        self._designated: dict[str, float] = {}
        self._aim_error: dict[str, list[float]] = {}
        self.tracking: set[str] = set()  # stations that have tracked since they were designated

    def act(self, stations: set[str] | None = None) -> None:
        """One look at every station, or at these: those that have never tracked are attended to;
        later losses are the fusion's task."""
        for station in list(self._observer.status):
            if stations is not None and station not in stations:
                continue
            if self._observer.status[station].kind == ols_msg.station_status_t.KIND_OVERVIEW:
                self._aim_once(station)
            elif self._observer.state(station) == "tracking":
                self.tracking.add(station)
            elif station not in self.tracking:
                self._attend(station)

    def _aim_once(self, station: str) -> None:
        """Afterwards it belongs to whoever looks at the console."""
        if station not in self._pointed and self._observer.truth is not None:
            self._point(station)
            self._pointed[station] = time.monotonic()

    def _attend(self, station: str) -> None:
        now = time.monotonic()
        if now < self._designated.get(station, -np.inf) + PATIENCE_S:
            return
        if self._sees_target(station):
            self._designate(station)
            self._designated[station] = now
        elif (
            self._observer.status[station].kind != ols_msg.station_status_t.KIND_FIXED
            and now >= self._pointed.get(station, -np.inf) + POINT_INTERVAL_S
        ):
            self._point(station)
            self._pointed[station] = now

    def _sees_target(self, station: str) -> bool:
        view = self._observer.view_before(station, PICTURE_S)
        status = self._observer.status[station]
        if view is None or not view.visible or status.image_width_px == 0:
            return False
        if time.time() - view.utime * 1e-6 > FRESH_S:
            return False
        # A person cannot draw a box while the image moves fast.
        if self._observer.turning_rad_s.get(station, np.inf) > AT_REST_RAD_S:
            return False
        x, y = view.centre_px[0] / status.image_width_px, view.centre_px[1] / status.image_height_px
        return MARGIN < x < 1 - MARGIN and MARGIN < y < 1 - MARGIN

    def _address(self, message: Any, station: str) -> Any:
        self._sequence += 1
        message.utime = time.time_ns() // 1000
        message.schema_version = message.SCHEMA_VERSION
        message.boot_id = self._boot_id
        message.sequence = self._sequence
        message.station = station
        message.lease_s = LEASE_S
        return message

    def _designate(self, station: str) -> None:
        view = self._observer.view_before(station, PICTURE_S)
        x, y, *size = view.box_px
        width, height = (max(side, LEAST_BOX_PX) for side in size)
        message = self._address(ols_msg.designate_t(), station)
        message.frame_utime = view.stamp_utime
        message.x_px = x - (width - size[0]) / 2 + self._random.gauss(0.0, self._box_sd_px)
        message.y_px = y - (height - size[1]) / 2 + self._random.gauss(0.0, self._box_sd_px)
        message.width_px, message.height_px = width, height
        self._bus.publish(f"OLS_DESIGNATE_{station}", message.encode())

    def _point(self, station: str) -> None:
        """Turns by the difference between where the station looks and where the target will be."""
        status, truth = self._observer.status[station], self._observer.truth
        known = (status.azimuth_rad, status.latitude_deg, status.longitude_deg, status.height_m)
        if truth is None or not np.isfinite(known).all():
            return
        error = self._aim_error.setdefault(
            station, [np.radians(self._random.gauss(0.0, 0.3)) for _ in range(2)]
        )
        position = np.array(truth.position_ecef_m)
        ahead_s = time.time() - truth.utime * 1e-6 + POINT_INTERVAL_S / 2
        position = position + np.array(truth.velocity_ecef_m_s) * ahead_s
        place = geodetic(status.latitude_deg, status.longitude_deg, status.height_m)
        seen = ols.azimuth_elevation_from_enu(ols.LocalFrame(place).to_enu(position))
        turn = np.angle(np.exp(1j * (seen.azimuth_rad - status.azimuth_rad)))
        message = self._address(ols_msg.ptu_command_t(), station)
        message.command = ols_msg.ptu_command_t.COMMAND_POINT
        message.pan_rad = status.pan_rad - turn + error[0]  # pan grows to the left
        message.tilt_rad = status.tilt_rad + seen.elevation_rad - status.elevation_rad + error[1]
        self._bus.publish(f"OLS_PTU_{station}", message.encode())
