"""Stations' video sockets (docs/video.md) whose pictures carry their own number, so that a browser
can tell which frame it shows, and where its overlay belongs."""

import io
import math
import socket
import socketserver
import struct
import threading
import time
from dataclasses import dataclass, field

import numpy as np
import ols_msg
from PIL import Image

FULL_PX = (1280, 960)
BITS, BIT_PX, CODE_Y_PX = 16, 60, 40  # a row of squares, the most significant first
BOX_PX = 80
BELIEF = 0.87


def box_of(number: int) -> tuple[int, int]:
    """Left and upper edge: another place for each frame."""
    return 100 + (number * 131) % 1000, 300 + (number * 77) % 500


def picture_of(number: int) -> bytes:
    pixels = np.full((FULL_PX[1], FULL_PX[0]), 120, np.uint8)
    for bit in range(BITS):
        value = 250 if number >> (BITS - 1 - bit) & 1 else 5
        left = 100 + bit * BIT_PX
        pixels[CODE_Y_PX : CODE_Y_PX + BIT_PX, left : left + BIT_PX] = value
    buffer = io.BytesIO()
    Image.fromarray(pixels[::2, ::2]).save(buffer, "JPEG", quality=75)
    return buffer.getvalue()


@dataclass
class PaperCamera:
    """Where the pictures were taken; unknown, as while a unit's angles are."""

    ecef_m: list[float] = field(default_factory=lambda: [math.nan] * 3)
    from_ecef: list[float] = field(default_factory=lambda: [math.nan] * 9)  # by rows
    focal_length_px: float = 4000.0
    principal_px: tuple[float, float] = (FULL_PX[0] / 2, FULL_PX[1] / 2)


class PaperVideo(socketserver.ThreadingTCPServer):
    """One station's; a new frame each `period_s`, exposed when it is made."""

    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, station: str, period_s: float, camera: PaperCamera | None = None):
        super().__init__(("127.0.0.1", 0), Viewer)
        self.station, self.period_s = station, period_s
        self.camera = camera or PaperCamera()
        self.exposed_us: dict[int, int] = {}  # number of a frame -> its time
        self.sent = 0
        self._numbers = 0
        self._newest = (0, 0, b"")
        self._new = threading.Condition()
        for work in (self.serve_forever, self._expose):
            threading.Thread(target=work, daemon=True).start()

    @property
    def address(self) -> str:
        return f"127.0.0.1:{self.server_address[1]}"

    def _expose(self) -> None:
        due = time.monotonic()
        while True:
            due += self.period_s
            time.sleep(max(0.0, due - time.monotonic()))
            number = (self._numbers + 1) % 2**BITS
            exposed_us = time.time_ns() // 1000
            jpeg = picture_of(number)
            with self._new:
                self._numbers, self.exposed_us[number] = number, exposed_us
                self._newest = (exposed_us, number, jpeg)
                self._new.notify_all()

    def frame_after(self, utime_us: int) -> bytes:
        with self._new:
            self._new.wait_for(lambda: self._newest[0] > utime_us)
            exposed_us, number, jpeg = self._newest
        m = ols_msg.video_frame_t()
        m.utime, m.schema_version, m.station = exposed_us, m.SCHEMA_VERSION, self.station
        m.boot_id, m.sequence, m.scale = 5, number, 0.5
        m.full_width_px, m.full_height_px = FULL_PX
        m.has_box, m.box_px = True, [*map(float, box_of(number)), BOX_PX, BOX_PX]
        m.belief = BELIEF
        m.camera_ecef_m, m.camera_from_ecef = self.camera.ecef_m, self.camera.from_ecef
        f_px = self.camera.focal_length_px
        m.camera_matrix_px = [f_px, f_px, *self.camera.principal_px, 0.0]
        m.jpeg_bytes, m.jpeg = len(jpeg), jpeg
        self.sent += 1
        return m.encode()


class Viewer(socketserver.BaseRequestHandler):
    def _take(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            part = self.request.recv(count - len(data))
            if not part:
                raise ConnectionError
            data += part
        return data

    def handle(self) -> None:
        self.request.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            while True:
                (length,) = struct.unpack(">I", self._take(4))
                asked = ols_msg.video_request_t.decode(self._take(length))
                frame = self.server.frame_after(asked.after_utime)
                self.request.sendall(struct.pack(">I", len(frame)) + frame)
        except OSError:
            return
