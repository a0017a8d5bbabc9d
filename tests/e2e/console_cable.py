"""The cable between a browser and the console, which a test can cut: while it is, nothing passes
either way; what was under way arrives once it is mended, as a network delivers it that was gone."""

import select
import socket
import threading
import time
from urllib.parse import urlparse

CHUNK = 1 << 16


class Cable(threading.Thread):
    """Carries each connection made to `address` on to the console's address."""

    def __init__(self, console_address: str):
        super().__init__(daemon=True)
        to = urlparse(console_address)
        self._to = (to.hostname, to.port)
        self._door = socket.create_server(("127.0.0.1", 0))
        self.address = f"http://127.0.0.1:{self._door.getsockname()[1]}/"
        self._other: dict[socket.socket, socket.socket] = {}
        self._whole, self._over, self._idle = threading.Event(), False, threading.Event()
        self._whole.set()

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self._over = True
        self._whole.set()
        self.join()

    def cut(self) -> float:
        """When: after this instant nothing passes."""
        self._idle.clear()
        self._whole.clear()
        assert self._idle.wait(60.0), "the cable does not end"
        return time.time()

    def mend(self) -> None:
        self._whole.set()

    def run(self) -> None:
        while not self._over:
            if not self._whole.is_set():
                self._idle.set()
                self._whole.wait()
            ready, _, _ = select.select([self._door, *self._other], [], [], 0.01)
            for one in ready:
                if one is self._door:
                    self._connect()
                elif one in self._other:
                    self._carry(one)
        for one in [self._door, *self._other]:
            one.close()

    def _connect(self) -> None:
        near, _ = self._door.accept()
        far = socket.create_connection(self._to)
        self._other |= {near: far, far: near}

    def _carry(self, one: socket.socket) -> None:
        other = self._other[one]
        try:
            data = one.recv(CHUNK)
            other.sendall(data)
        except OSError:
            data = b""
        if data:
            return
        for end in (one, other):
            del self._other[end]
            end.close()
