"""A browser's WebSocket to the console without the browser."""

import base64
import contextlib
import json
import os
import socket
import struct
import threading
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
        first, content = None, b""
        while True:
            head, length = self._read(2)
            if length >= 126:
                length = int.from_bytes(self._read(2 if length == 126 else 8))
            first = head if first is None else first
            content += self._read(length)
            if head & 0x80:  # the last fragment (RFC 6455, section 5.4)
                return json.loads(content) if first & 0x0F == 1 else None

    def answer_to(self, message: dict) -> dict:
        self.say(message)
        while True:
            heard = self.heard()
            is_answer = heard and heard["kind"] == "answer"
            if is_answer and heard["number"] == message["number"]:
                return heard


class PlainViewer(threading.Thread):
    """Takes the pictures of these stations as fast as they come."""

    def __init__(self, address: str, stations: list[str]):
        super().__init__(daemon=True)
        self.bytes = 0
        live = LiveSocket(address)
        live.say({"do": "watch", "pictures": stations})
        self._socket = live.socket

    def run(self) -> None:
        with contextlib.suppress(OSError):
            while data := self._socket.recv(1 << 16):
                self.bytes += len(data)

    def end(self) -> None:
        self._socket.shutdown(socket.SHUT_RDWR)
        self.join()
        self._socket.close()
