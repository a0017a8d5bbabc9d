"""Cursor on Target as pytak receives it: a client of TAK that others build their programs on."""

import asyncio
import configparser
import contextlib
import socket
import threading
import xml.etree.ElementTree as ET

import pytak
import pytest
from export_site import (
    CE_M,
    DEADLINE_S,
    HEIGHT_M,
    LATITUDE_DEG,
    LE_M,
    LONGITUDE_DEG,
    Exporter,
    Publisher,
    output,
)

pytestmark = pytest.mark.usefixtures("network")
UID = "brno.target.000000000000004d.7"


class TakServer:
    """Passes on what any of its clients says to the others."""

    def __init__(self):
        self._clients = []
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while True:
            client = self._socket.accept()[0]
            self._clients.append(client)
            threading.Thread(target=self._pass_on, args=(client,), daemon=True).start()

    def _pass_on(self, speaker):
        with contextlib.suppress(ConnectionError):  # its end, however it comes
            while data := speaker.recv(65536):
                for client in self._clients:
                    if client is not speaker:
                        client.sendall(data)


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        return free.getsockname()[1]


async def receive(publisher, is_wanted, **settings):
    """What pytak's own worker puts into its queue, until one of it is wanted."""
    config = configparser.ConfigParser()
    config["pytak"] = {"PYTAK_MULTICAST_LOCAL_ADDR": "127.0.0.1", **settings}
    queue = asyncio.Queue()
    worker = await pytak.rxworker_factory(queue, config["pytak"])
    running = asyncio.create_task(worker.run())
    try:
        async with asyncio.timeout(DEADLINE_S):
            while True:
                publisher.publish()
                try:
                    said = await asyncio.wait_for(queue.get(), 0.05)
                except TimeoutError:
                    assert not running.done(), running.exception()
                    continue
                if is_wanted(said):
                    return said
    finally:
        running.cancel()


def xml_uid(said):
    return ET.fromstring(said).get("uid")


def check_xml(said):
    event = ET.fromstring(said)
    point = {key: float(value) for key, value in event.find("point").attrib.items()}
    assert point["lat"] == pytest.approx(LATITUDE_DEG, abs=1e-8)
    assert point["lon"] == pytest.approx(LONGITUDE_DEG, abs=1e-8)
    assert point["hae"] == pytest.approx(HEIGHT_M, abs=0.01)
    assert (point["ce"], point["le"]) == (CE_M, LE_M)


def test_a_stream_from_a_server(tmp_path):
    server, publisher = TakServer(), Publisher()
    with Exporter(tmp_path, output("tak", "cot", f"tcp://127.0.0.1:{server.port}")):
        said = asyncio.run(
            receive(
                publisher,
                lambda said: xml_uid(said) == UID,
                COT_URL=f"tcp://127.0.0.1:{server.port}",
                TAK_PROTO="0",
            )
        )
    check_xml(said)


def test_the_mesh(tmp_path):
    port, publisher = free_port(), Publisher()
    to = f"udp://239.2.3.1:{port}?ttl=0&interface=127.0.0.1"
    with Exporter(tmp_path, output("tak", "cot-protobuf", to)):
        said = asyncio.run(
            receive(
                publisher,
                lambda said: said.cotEvent.uid == UID,
                COT_URL=f"udp+ro://239.2.3.1:{port}",
                TAK_PROTO="1",
            )
        )
    event = said.cotEvent
    assert event.lat == pytest.approx(LATITUDE_DEG, abs=1e-8)
    assert event.lon == pytest.approx(LONGITUDE_DEG, abs=1e-8)
    assert event.hae == pytest.approx(HEIGHT_M, abs=0.01)
    assert (event.ce, event.le) == pytest.approx((CE_M, LE_M), abs=0.01)
