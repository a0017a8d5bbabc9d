"""The fusion with stations that exist only as messages: what it takes, refuses and withholds."""

import itertools
import signal
import time

import lcm
import numpy as np
import ols
import ols_msg
import pytest
from conftest import BIN, wait
from ols_demo.bus import LIVE_URL, counters, decode
from ols_demo.keys import members_of_environment
from ols_demo.observer import Observer
from ols_demo.places import geodetic
from ols_demo.site import Site

PLACE = geodetic(49.2, 16.6, 250.0)
SITE = ols.LocalFrame(PLACE)
CAMERAS = {"a": (-200.0, 0.0, 0.0), "b": (200.0, 0.0, 2.0), "c": (0.0, 250.0, -1.0)}
TARGET_ENU = (30.0, 60.0, 90.0)
SEQUENCES = itertools.count(1)  # no message is believed twice


def bearing(station, utime_us):
    camera = SITE.to_ecef(np.array(CAMERAS[station]))
    line = ols.R_ecef_enu(camera).T @ (SITE.to_ecef(np.array(TARGET_ENU)) - camera)
    direction = ols.azimuth_elevation_from_enu(line)
    message = ols_msg.bearing_t()
    message.utime = utime_us
    message.schema_version = message.SCHEMA_VERSION
    message.station = station
    message.boot_id, message.sequence = 5, next(SEQUENCES)
    message.belief = 0.9
    message.camera_ecef_m = list(camera)
    message.azimuth_rad, message.elevation_rad = direction.azimuth_rad, direction.elevation_rad
    message.covariance_white_rad2 = [1e-8, 0.0, 1e-8]
    message.covariance_systematic_rad2 = [1e-8, 0.0, 1e-8]
    return message


class FusionAlone:
    """Feeds bearings while it waits: the fusion's time is that of its messages."""

    def __init__(self):
        self.slews = 0
        self.stations = itertools.cycle(CAMERAS)
        self.told_us = []  # stamps of the targets with a position
        self.observer = Observer()
        self.lcm = lcm.LCM(LIVE_URL)
        self.signing = members_of_environment()
        # Not the bearings: some of them cannot be decoded.
        self.lcm.subscribe("OLS_(TARGET.*|FUSION_STATUS)", self.receive)
        self.lcm.subscribe("OLS_SLEW_.+", self.count_slew)

    def receive(self, channel, data):
        message = decode(channel, data)
        self.observer.receive(channel, message)
        if channel == "OLS_TARGET" and message.solution == ols_msg.target_t.SOLUTION_OK:
            self.told_us.append(message.utime)

    def count_slew(self, _channel, _data):
        self.slews += 1

    def publish(self, channel, data):
        self.lcm.publish(channel, self.signing.sign(channel, data))

    def feed(self):
        station = next(self.stations)
        message = bearing(station, time.time_ns() // 1000)
        message.clock_error_s = 1e-3
        self.publish(f"OLS_BEARING_{station}", message.encode())
        timeout_ms = 20
        while self.lcm.handle_timeout(timeout_ms) > 0:
            timeout_ms = 0

    def feed_until(self, condition, what):
        wait(condition, what, turn=self.feed)

    def count(self, name):
        return counters(self.observer.fusion).get(name, 0.0) if self.observer.fusion else 0.0

    def alarms(self, words):
        status = self.observer.fusion
        return [alarm for alarm in status.alarm if words in alarm] if status else []

    def located(self):
        target = self.observer.target.get("OLS_TARGET")
        return target is not None and target.solution == ols_msg.target_t.SOLUTION_OK


@pytest.fixture
def fusion(network, tmp_path):
    listener = FusionAlone()
    with Site(tmp_path) as site:
        site.start_and_wait("fusion", [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL], "ready")
        listener.site = site
        yield listener
        site.check()
        assert site.stop("fusion") == 0


def test_locates_and_slews(fusion):
    fusion.feed_until(lambda: fusion.located() and fusion.slews > 3, "a target and slews")
    target = fusion.observer.target["OLS_TARGET"]
    error = SITE.to_enu(np.array(target.position_ecef_m)) - np.array(TARGET_ENU)
    assert np.linalg.norm(error) < 0.05
    assert list(target.station) == ["a", "b", "c"]
    fusion.feed_until(lambda: "OLS_TARGET_PAPER" in fusion.observer.target, "the paper's target")


def test_damaged_and_foreign_messages_are_counted(fusion):
    whole = bearing("a", time.time_ns() // 1000).encode()
    for size in (0, 3, 20, len(whole) - 1):
        fusion.publish("OLS_BEARING_a", whole[:size])
    fusion.publish("OLS_BEARING_a", whole[:20] + b"\0\0\0\0" + whole[24:])  # absurd length
    fusion.publish("OLS_STATUS_a", whole)
    fusion.publish("OLS_BEARING_b", whole)
    # What is not even the beginning of a message ends where signatures are judged, and so does what
    # a member says in another's place.
    fusion.feed_until(lambda: fusion.count("bus_distrusted_malformed") == 4, "four without a head")
    fusion.feed_until(lambda: fusion.count("messages_malformed") == 2, "two malformed messages")
    assert fusion.count("bus_distrusted_channel") == 1
    fusion.feed_until(fusion.located, "a target all the same")


def test_after_a_standstill_nothing_old_is_told(fusion):
    """A closed lid: what has waited is worked off, and what is made of it withheld."""
    stands_s = 6.0
    fusion.feed_until(fusion.located, "a target")
    fusion.site.processes["fusion"].send_signal(signal.SIGSTOP)
    end = time.monotonic() + stands_s
    fusion.feed_until(lambda: time.monotonic() > end, "the standstill")
    fusion.told_us.clear()
    oldest_us = time.time_ns() // 1000 - 2_000_000
    fusion.site.processes["fusion"].send_signal(signal.SIGCONT)
    fusion.feed_until(lambda: len(fusion.told_us) > 30, "targets again")
    assert min(fusion.told_us) > oldest_us
    fusion.feed_until(lambda: fusion.count("targets_withheld") > 10, "targets withheld")
    assert "withheld" in fusion.observer.fusion.last_error
    fusion.feed_until(lambda: not fusion.alarms("host's clock"), "the end of the alarm")
