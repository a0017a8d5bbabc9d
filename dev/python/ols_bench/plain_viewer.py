"""A browser's WebSocket to the console without the browser: asks for pictures, reads everything,
takes no more than so many of each station a second."""

import base64
import json
import os
import socket
import struct
import threading
import time
from urllib.parse import urlparse


class LiveSocket:
    """The console's WebSocket, open."""

    def __init__(self, address: str):
        where = urlparse(address)
        self.socket = socket.create_connection((where.hostname, where.port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /api/live HTTP/1.1\r\nHost: {where.netloc}\r\nUpgrade: websocket\r\n"
            f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n"
            "".encode()
        )
        said = b""
        while b"\r\n\r\n" not in said:
            said += self.socket.recv(1)
        if b" 101 " not in said:
            raise ConnectionError(said.decode(errors="replace"))

    def say(self, message: dict) -> None:
        text = json.dumps(message).encode()
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(text))
        # RFC 6455, section 5.2: the shortest form of the length.
        length = (
            struct.pack(">B", 0x80 | len(text))
            if len(text) < 126
            else struct.pack(">BH", 0x80 | 126, len(text))
        )
        self.socket.sendall(b"\x81" + length + mask + masked)

    def _read(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            more = self.socket.recv(count - len(data))
            if not more:
                raise ConnectionError("the console has closed the connection")
            data += more
        return data

    def heard(self) -> dict | None:
        """The next message; None for one that is no text."""
        kind, length = self._read(2)
        if length >= 126:
            length = int.from_bytes(self._read(2 if length == 126 else 8))
        content = self._read(length)
        return json.loads(content) if kind & 0x0F == 1 else None

    def answer_to(self, message: dict) -> dict:
        self.say(message)
        while True:
            heard = self.heard()
            is_answer = heard and heard["kind"] == "answer"
            if is_answer and heard["number"] == message["number"]:
                return heard


class PlainViewer(threading.Thread):
    def __init__(self, address: str, stations: list[str], rate_hz: float | None = None):
        """rate_hz: None: as fast as they come."""
        super().__init__(daemon=True)
        self._period_s = 1.0 / rate_hz if rate_hz else None
        self._stations = stations
        self.bytes = 0
        self._live = LiveSocket(address)
        self._socket = self._live.socket
        self._live.say({"do": "watch", "pictures": stations})
        if self._period_s:
            self._socket.settimeout(self._period_s)
            self._take()

    def _take(self) -> None:
        self._live.say({"do": "taken", "pictures": self._stations, "state": True})

    def _receive(self) -> bytes | None:
        """None: nothing for a period."""
        try:
            return self._socket.recv(1 << 16)
        except TimeoutError:
            return None

    def run(self) -> None:
        taken_s = time.monotonic()
        try:
            while (data := self._receive()) != b"":
                self.bytes += len(data or b"")
                if self._period_s and time.monotonic() >= taken_s + self._period_s:
                    taken_s += self._period_s
                    self._take()
        except OSError:
            return

    def end(self) -> None:
        self._socket.shutdown(socket.SHUT_RDWR)
        self.join()
        self._socket.close()
