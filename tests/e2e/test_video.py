"""A viewer of a station's camera, over its socket: pictures of the moment, and where they look."""

import contextlib
import io
import socket

import numpy as np
import ols_msg
import pytest
from conftest import BIN, SCENARIO, wait
from helpers import DEADLINE_S, Listener, VideoViewer, at_frame_rate
from ols_demo.site import Site
from ols_demo.wiring import Wiring
from PIL import Image

STATION = "alfa"
READY_S = 60.0
OK = ols_msg.station_status_t.DEVICE_OK


@pytest.fixture(scope="module")
def site(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("video")
    scenario = at_frame_rate(SCENARIO.parent / "servo.toml", 6.0, folder)
    wiring = Wiring(BIN, scenario, 1, folder)
    wiring.prepare()
    listener = Listener()
    with Site(folder / "logs") as running:
        wiring.start_simulator(running)
        wiring.start_station(running, STATION)
        for name in ("camera", "ptu", "video"):
            listener.wait(lambda name=name: listener.device(STATION, name)[0] == OK, name, READY_S)
        yield listener


@pytest.fixture
def viewer(site):
    viewer = VideoViewer(site.device(STATION, "video")[1])
    yield viewer
    viewer.close()


def test_pictures_follow_each_other(viewer):
    first = viewer.picture()
    assert first.station == STATION
    assert (first.full_width_px, first.full_height_px) == (1280, 960)
    picture = Image.open(io.BytesIO(first.jpeg))
    assert picture.size == (640, 480)
    stamps = [first.utime]
    for _ in range(5):
        stamps.append(viewer.picture(after_utime=stamps[-1]).utime)
    assert np.all(np.diff(stamps) > 0), stamps


def test_a_region_comes_in_full_resolution(viewer):
    frame = viewer.picture(region=(320.0, 240.0, 200.0, 100.0))
    assert frame.scale == 1.0
    assert Image.open(io.BytesIO(frame.jpeg)).size == (200, 100)


def test_a_picture_says_where_the_camera_looked(site, viewer):
    def looked():
        status, frame = site.wait_for_status(STATION), viewer.picture()
        known = np.isfinite([status.azimuth_rad, *frame.camera_from_ecef]).all()
        return (status, frame) if known else None

    status, frame = wait(looked, "status and picture with the unit's angles")
    assert frame.camera_ecef_m == pytest.approx(status.camera_ecef_m, abs=1e-6)
    to_camera = np.reshape(frame.camera_from_ecef, (3, 3))
    latitude, longitude = np.radians([status.latitude_deg, status.longitude_deg])
    east = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
    up = np.array(
        [
            np.cos(latitude) * np.cos(longitude),
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
        ]
    )
    axis = to_camera[2]  # the optical axis in ECEF
    azimuth = np.arctan2(axis @ east, axis @ np.cross(up, east))
    assert np.angle(np.exp(1j * (azimuth - status.azimuth_rad))) == pytest.approx(0.0, abs=1e-4)
    assert np.arcsin(axis @ up) == pytest.approx(status.elevation_rad, abs=1e-4)


def test_what_is_no_request_ends_the_connection_and_is_counted(site):
    address = site.device(STATION, "video")[1]
    with socket.create_connection(address.rsplit(":", 1), timeout=DEADLINE_S) as stranger:
        stranger.sendall(b"GET / HTTP/1.1\r\n\r\n")
        with contextlib.suppress(ConnectionResetError):  # closed with what it had not read
            assert stranger.recv(1) == b""
    site.wait_for_counter(STATION, "video_malformed", 1)
