"""The bus as bare datagrams: receives whole messages, and sends anything.

liblcm's own receiver dies of the fragments that are sent on purpose here, and this process must
outlive what it does to others. Only whole messages (LC02) are heard: none of ours is a fragment.
"""

import contextlib
import queue
import re
import socket
import struct
import threading
import time
from collections.abc import Callable
from typing import Any

import lcm
from ols_demo.bus import decode

WHOLE = b"LC02"
LARGEST = 65536  # [byte]
BUFFER = 1 << 25  # [byte] asked for; the kernel gives what it may
DRAIN_US = 50_000  # what has waited is handled for so long at most, then the caller looks around

WANTED = (b"OLS_BEARING_", b"OLS_STATUS_", b"OLS_TARGET", b"OLS_FUSION_STATUS", b"OLS_SIM_")
PTU = b"OLS_PTU_"
STOP_BYTES = 106  # of a ptu_command_t, beside its station's name
STOP_AT = 49  # its command byte, likewise


def address(url: str) -> tuple[str, int]:
    group, port = re.fullmatch(r"udpm://([\d.]+):(\d+).*", url).groups()
    return group, int(port)


def is_stop(channel: bytes, payload: bytes) -> bool:
    """Whether this is a STOP for the station of its channel. Cheap enough to ask during a flood."""
    name = len(channel) - len(PTU)
    return len(payload) == STOP_BYTES + name and payload[STOP_AT + name] == 1


class Sender:
    """Sends the datagrams to the bus unchanged."""

    def __init__(self, url: str):
        self._address = address(url)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)

    def send(self, datagram: bytes) -> None:
        self._socket.sendto(datagram, self._address)

    def message(self, channel: str, payload: bytes) -> None:
        self.send(struct.pack(">4sI", WHOLE, 0) + channel.encode() + b"\0" + payload)

    def close(self) -> None:
        self._socket.close()


class Ear:
    """A thread that receives; handle() hands on what it got, with the instant of its arrival."""

    def __init__(self, url: str, handler: Callable[[str, Any, int], None]):
        self.lcm = lcm.LCM(url)  # to publish: without a subscription it never listens
        self.stops_us: dict[str, list[int]] = {}  # by station: when a STOP was heard
        self._handler = handler
        self._queue: queue.SimpleQueue = queue.SimpleQueue()
        self._closed = False
        self._socket = self._listening(url)
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    @staticmethod
    def _listening(url: str) -> socket.socket:
        group, port = address(url)
        ear = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        ear.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        ear.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
        ear.bind(("", port))
        member = struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton("0.0.0.0"))
        ear.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
        ear.settimeout(0.5)
        return ear

    def _listen(self) -> None:
        receive = self._socket.recv
        while not self._closed:
            try:
                datagram = receive(LARGEST)
            except TimeoutError:
                continue
            except OSError:
                return
            if datagram[:4] != WHOLE:
                continue
            end = datagram.find(b"\0", 8)
            channel = datagram[8:end]
            if channel.startswith(WANTED):
                self._queue.put((channel, datagram[end + 1 :], time.time_ns() // 1000))
            elif channel.startswith(PTU) and is_stop(channel, datagram[end + 1 :]):
                station = channel[len(PTU) :].decode(errors="replace")
                self.stops_us.setdefault(station, []).append(time.time_ns() // 1000)

    def handle(self, timeout_s: float) -> None:
        """Handles what has arrived, waiting at most timeout_s for the first."""
        wait: dict[str, Any] = {"timeout": timeout_s} if timeout_s > 0 else {"block": False}
        began = time.monotonic()
        with contextlib.suppress(queue.Empty):
            while time.monotonic() - began < timeout_s + DRAIN_US * 1e-6:
                self._handle(*self._queue.get(**wait))
                wait = {"block": False}

    def _handle(self, channel: bytes, payload: bytes, at_us: int) -> None:
        try:
            name = channel.decode()
            message = decode(name, payload)
        except (ValueError, struct.error):  # any program can send anything on any channel
            return
        if message is not None:
            self._handler(name, message, at_us)

    def close(self) -> None:
        self._closed = True
        self._thread.join()
        self._socket.close()
