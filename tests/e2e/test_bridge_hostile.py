"""ols-bridge and ols-archive with servers of NATS that are not what they should be: a few lines
that speak as much of its protocol as each test needs."""

import itertools
import json
import socket
import sys
import threading

import pytest
from bridge_site import Listener, Other, bearing, bus_url, wait
from conftest import finished

INFO = {
    **{"server_id": "x", "server_name": "x", "version": "2.15.2", "go": "x", "proto": 1},
    **{"host": "127.0.0.1", "port": 4222, "headers": True, "max_payload": 65536, "client_id": 1},
}


class PlainServer:
    """Answers each connection without TLS. `greeting` follows its client's first PING; `refusal`
    stands in the place of all answers while there is one. Whom it does not read still hears from
    it."""

    def __init__(self, greeting: bytes = b"", reads: bool = True):
        self.refusal = b""
        self._greeting, self._reads = greeting, reads
        self._socket = socket.socket()
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.listen()
        self.port = self._socket.getsockname()[1]
        self.heard: list[bytes] = []  # of each connection
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self) -> None:
        while True:
            connection = self._socket.accept()[0]
            self.heard.append(b"")
            try:
                self._speak(connection)
            except OSError:
                connection.close()

    def _speak(self, connection: socket.socket) -> None:
        connection.sendall(f"INFO {json.dumps(INFO)}\r\n".encode())
        greeting = self._greeting
        while data := connection.recv(65536):
            self.heard[-1] += data
            if self.refusal:
                connection.sendall(self.refusal)
                connection.close()
                return
            for _ in range(data.count(b"PING\r\n")):
                connection.sendall(b"PONG\r\n" + greeting)
                greeting = b""
                if not self._reads:
                    self._babble(connection)

    @staticmethod
    def _babble(connection: socket.socket) -> None:
        """Until the other side gives it up: no PING of it is read, and none stays unanswered."""
        connection.settimeout(0.2)
        while True:
            connection.sendall(b"PONG\r\n")
            threading.Event().wait(0.2)  # the peer's time, not the test's


@pytest.fixture(name="authority")
def fixture_authority(certificates):
    return f"{certificates['own']}/site-ca.pem"


def test_a_server_of_tls_that_has_none_hears_no_log_in(network, tmp_path, authority):
    server = PlainServer()
    nats = f'servers = ["tls://127.0.0.1:{server.port}"]\nauthority = "{authority}"'
    bridge = Other(tmp_path, "bridge", nats)
    try:
        wait(lambda: len(server.heard) > 1, "it is tried again")
        wait(lambda: bridge.says("no server: "), "it is said")
        assert b"CONNECT" not in b"".join(server.heard)
    finally:
        bridge.stop()


def test_an_archiver_does_not_log_in_without_tls_either(network, tmp_path, authority):
    pytest.importorskip("nats", reason="needs requirements-archive.txt")
    server = PlainServer()
    command = [sys.executable, "-m", "ols_archive", str(tmp_path / "archive"), "--region", "r"]
    command += ["--stream", "OLS_r", "--server", f"tls://127.0.0.1:{server.port}"]
    done = finished(*command, "--authority", authority)
    assert done.returncode == 2
    assert "without TLS" in done.stderr and "Traceback" not in done.stderr
    assert server.heard and b"CONNECT" not in b"".join(server.heard)


class Station:
    """On the bridge's bus."""

    def __init__(self):
        self._bus, self._numbers = Listener(bus_url(7670)), itertools.count(1)

    def say(self, padding=b""):
        self._bus.bus.publish("OLS_BEARING_alfa", bearing("alfa", next(self._numbers)) + padding)
        self._bus.handle(5)


REFUSALS = (
    b"-ERR 'Permissions Violation for Publish to \"ols.v1.region.site.alfa.bearing\"'\r\n"
    b"-ERR 'Permissions Violation for Subscription to \"ols.v1.region.site.*.cmd.slew\"'\r\n"
)


def test_what_a_server_refuses_is_said_and_counted(network, tmp_path):
    server = PlainServer(greeting=REFUSALS)
    bridge = Other(tmp_path, "bridge", f'servers = ["nats://127.0.0.1:{server.port}"]')
    try:
        wait(lambda: bridge.says("bridge: the server refuses: "), "it is said")
        state = bridge.status()
        assert state["link"]["refusals"] == 2
        assert state["link"]["open"], "the rest goes on"
        assert any("Subscription to" in alarm["text"] for alarm in state["alarms"])
    finally:
        bridge.stop()


def test_a_server_that_does_not_read_is_given_up(network, tmp_path):
    """Although it answers."""
    server = PlainServer(reads=False)
    bridge = Other(tmp_path, "bridge", f'servers = ["nats://127.0.0.1:{server.port}"]')
    station = Station()
    try:
        wait(lambda: server.heard and b"PING" in server.heard[0], "the first connection")
        wait(lambda: station.say(bytes(7000)) or len(server.heard) > 1, "another one", 60.0)
        wait(lambda: bridge.status()["link"]["losses"] >= 1, "it is counted")
    finally:
        bridge.stop()


def test_what_is_known_stays_when_the_server_is_tried_anew(network, tmp_path):
    """The library gives a server up that has refused a key twice."""
    server = PlainServer()
    bridge = Other(tmp_path, "bridge", f'servers = ["nats://127.0.0.1:{server.port}"]')
    station = Station()
    try:
        wait(lambda: station.say() or (bridge.status() or {}).get("out", {}).get("passed"), "one")
        server.refusal = b"-ERR 'Authorization Violation'\r\n"
        refused = len(server.heard)
        wait(lambda: station.say() or len(server.heard) > refused + 3, "it is tried anew", 60.0)
        before = bridge.status()
        server.refusal = b""
        wait(lambda: station.say() or bridge.status()["link"]["open"], "it is back", 60.0)
        after = bridge.status()
        assert after["out"]["passed"] >= before["out"]["passed"] > 10
        assert after["link"]["openings"] >= before["link"]["openings"] + 1 >= 2
    finally:
        bridge.stop()
