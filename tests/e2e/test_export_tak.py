"""Cursor on Target as its own readers read it, by every way; receivers that misbehave."""

import collections
import socket
import ssl
import threading
import xml.etree.ElementTree as ET
from datetime import datetime

import pytest
import takproto
from export_site import (
    CE_M,
    HEIGHT_M,
    LATITUDE_DEG,
    LE_M,
    LONGITUDE_DEG,
    Exporter,
    Publisher,
    output,
    received,
    target,
    udp_receiver,
    wait,
)

pytestmark = pytest.mark.usefixtures("network")
UID = "brno.target.000000000000004d.7"


class Server:
    """Takes one connection after the other and keeps what it hears."""

    def __init__(self, context=None, reads=True):
        self.heard, self.connections, self.reads = b"", [], reads
        self._context = context
        self._socket = socket.create_server(("0.0.0.0", 0))
        if not reads:  # what its own system takes for it is bounded, else by megabytes
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
        self.port = self._socket.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while True:
            try:
                connection = self._socket.accept()[0]
                if self._context:
                    connection = self._context.wrap_socket(connection, server_side=True)
            except ssl.SSLError:
                continue
            except OSError:
                return
            self.connections.append(connection)
            threading.Thread(target=self._read, args=(connection,), daemon=True).start()

    def _read(self, connection):
        try:
            while self.reads and (data := connection.recv(65536)):
                self.heard += data
        except OSError:
            pass

    def end_connections(self):
        for connection in self.connections:
            connection.shutdown(socket.SHUT_RDWR)
            connection.close()
        self.connections = []


def find(events, uid):
    return next((event for event in events if event.get("uid") == uid), None)


def check_proto(message):
    event = message.cotEvent
    assert (event.type, event.how) == ("a-u-A", "m-f")
    assert event.lat == pytest.approx(LATITUDE_DEG, abs=1e-8)
    assert event.lon == pytest.approx(LONGITUDE_DEG, abs=1e-8)
    assert event.hae == pytest.approx(HEIGHT_M, abs=0.01)
    assert event.ce == pytest.approx(CE_M, abs=0.01)
    assert event.le == pytest.approx(LE_M, abs=0.01)
    assert event.staleTime - event.startTime == 10_000
    assert event.detail.contact.callsign == "OLS 7"
    covariance = ET.fromstring(event.detail.xmlDetail).get("covariance_enu_m2").split()
    assert [float(value) for value in covariance] == [4.0, 1.0, 0.5, 9.0, -0.5, 25.0]


def test_xml_by_datagram(tmp_path):
    receiver, port = udp_receiver()
    publisher = Publisher()
    events = []
    with Exporter(tmp_path, output("tak", "cot", f"udp://127.0.0.1:{port}")):

        def heard():
            events.extend(ET.fromstring(data) for data in received(receiver))
            return find(events, UID) is not None and find(events, "brno.station.alfa") is not None

        publisher.until(heard, "target and station")
    event, station = find(events, UID), find(events, "brno.station.alfa")
    point = {key: float(value) for key, value in event.find("point").attrib.items()}
    assert point["lat"] == pytest.approx(LATITUDE_DEG, abs=1e-8)
    assert point["hae"] == pytest.approx(HEIGHT_M, abs=0.01)
    assert (point["ce"], point["le"]) == (CE_M, LE_M)
    times = [datetime.fromisoformat(event.get(key)) for key in ("time", "start", "stale")]
    assert times[0] == times[1] and (times[2] - times[1]).total_seconds() == 10.0
    assert float(station.find("detail/sensor").get("azimuth")) == pytest.approx(57.30, abs=0.01)
    check_proto(takproto.parse_proto(takproto.xml2proto(ET.tostring(event).decode())))


def test_protobuf_to_the_group_of_the_mesh(tmp_path):
    receiver, port = udp_receiver(group="239.2.3.1")
    publisher, messages = Publisher(), []
    to = f"udp://239.2.3.1:{port}?ttl=0&interface=127.0.0.1"
    with Exporter(tmp_path, output("tak", "cot-protobuf", to, stations=False)):

        def heard():
            messages.extend(received(receiver))
            return messages

        publisher.until(heard, "a datagram")
    assert messages[0][:3] == b"\xbf\x01\xbf"
    check_proto(takproto.parse_proto(bytearray(messages[0])))


def test_a_stream_is_made_again(tmp_path):
    server, publisher = Server(), Publisher()
    to = f"tcp://127.0.0.1:{server.port}"
    with Exporter(tmp_path, output("tak", "cot-protobuf", to, stations=False)):
        publisher.until(lambda: server.heard, "something")
        first = server.heard
        assert first[0] == 0xBF
        check_proto(takproto.parse_proto(bytearray(first)))
        server.end_connections()
        server.heard = b""
        publisher.until(lambda: server.heard, "something again")


def tls_server(folder):
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(folder / "console.pem", folder / "console.key")
    return Server(context)


def test_a_wrong_certificate_is_refused_and_said_and_others_go_on(tmp_path, certificates):
    good, bad = tls_server(certificates["own"]), tls_server(certificates["foreign"])
    ca = str(certificates["own"] / "site-ca.pem")
    publisher = Publisher()
    outputs = output("good", "cot", f"tls://localhost:{good.port}", ca=ca)
    outputs += output("bad", "cot", f"tls://localhost:{bad.port}", ca=ca)
    outputs += output("name", "cot", f"tls://127.0.0.2:{good.port}", ca=ca)
    with Exporter(tmp_path, outputs) as exporter:
        publisher.until(lambda: UID.encode() in good.heard, "the target over TLS")
        publisher.until(
            lambda: "certificate is refused" in exporter.output("bad").get("trouble", ""),
            "the wrong certificate is said",
        )
        publisher.until(
            lambda: "certificate is refused" in exporter.output("name").get("trouble", ""),
            "the wrong name is said",
        )
        assert exporter.output("name")["sent"] == 0
        assert not exporter.output("bad")["open"] and exporter.output("bad")["sent"] == 0
    assert bad.heard == b""
    assert "output bad: localhost" in exporter.said()


def test_a_receiver_that_stops_reading_costs_nobody_else(tmp_path):
    deaf = Server(reads=False)
    receiver, port = udp_receiver()
    publisher = Publisher()
    outputs = output("deaf", "cot", f"tcp://127.0.0.1:{deaf.port}", rate_hz=100.0)
    outputs += output("other", "cot", f"udp://127.0.0.1:{port}", rate_hz=100.0)
    with Exporter(tmp_path, outputs) as exporter:
        wait(lambda: deaf.connections, "a connection")
        sent = collections.defaultdict(set)  # to the other, by what the deaf one has taken

        def fills():
            publisher.publish(*[target(number) for number in range(1, 200)])
            outputs = wait(exporter.status, "a status")["outputs"]
            if not outputs["deaf"]["trouble"]:
                sent[outputs["deaf"]["bytes"]].add(outputs["other"]["sent"])
            return "does not read" in outputs["deaf"]["trouble"]

        wait(fills, "the receiver that does not read is given up", 120.0)
        assert max(len(sent[taken]) for taken in sent if taken) > 1, "the other one waits for it"
        assert exporter.output("deaf")["displaced"] > 0
        # The receiver's buffer (twice what it asked for, and the last segment) and what waits
        # unsent here. On a busy machine it has been given up several times until then.
        most = 2 * 65536 + 65536 + 16384
        assert exporter.output("deaf")["bytes"] < most * len(deaf.connections)
        assert exporter.output("other")["trouble"] == ""
