"""SAPIENT through Apex, the middleware that most know, where OLS_APEX names its command (4.2.0; it
is on no package registry): our site registers there and reports, and another node is heard there.
"""

import json
import os
import signal
import socket
import sqlite3
import subprocess
import time
from pathlib import Path

import pytest
from conftest import BIN
from export_site import (
    HEIGHT_M,
    LATITUDE_DEG,
    LONGITUDE_DEG,
    Exporter,
    Publisher,
    output,
    target,
    wait,
)
from ols_demo.bus import LIVE_URL
from sapient_msg.bsi_flex_335_v2_0.registration_pb2 import Registration
from sapient_msg.bsi_flex_335_v2_0.sapient_message_pb2 import SapientMessage
from sapient_site import OBJECT, RADAR, RECEIVER, detection, framed, stamped

pytestmark = pytest.mark.usefixtures("network")
NODES, READERS, WEB = 5020, 5004, 8090  # of the network namespace of the test
PLACE = (47.6, 13.3, 900.0)
# As in the configuration that Apex comes with: everything that it can check.
CHECKS = [
    "mandatory_fields_present",
    "mandatory_oneof_present",
    "mandatory_repeated_present",
    "no_unknown_fields",
    "no_unknown_enum_values",
    "id_format_valid",
    "message_timestamp_reasonable",
    "detection_timestamp_reasonable",
    "supported_icd_version",
]
VERSION = "BSI Flex 335 v2.0"


def port(number, kind, **more):
    return {"type": kind, "port": number, "format": "PROTO", "icd_version": VERSION, **more}


CONFIG = {
    "logLevel": "INFO",
    "connections": [port(NODES, "Child"), port(READERS, "Parent", forwardAll=True)],
    "elasticConfig": {"enabled": False},
    "apiConfig": {"host": "127.0.0.1", "port": WEB},
    "enableTimeSyncAdjustment": False,
    "messageMaxSizeKb": 1024,
    "middlewareId": RECEIVER,
    "enableMessageConversion": False,
    "allowPeerRegistration": True,
    "sendRegistrationAck": True,
    "rollover": {"enable": False, "unit": "days", "value": 1},
    "validationOptions": {
        "validationTypes": CHECKS,
        "strictIdFormat": True,
        "messageTimestampRange": [-0.9, 0.1],
        "detectionMinimumGap": 0.08,
        "supportedIcdVersions": [VERSION],
    },
}


class Apex:
    def __init__(self, folder: Path):
        self.folder = folder
        (folder / "apex.json").write_text(json.dumps(CONFIG))
        with (folder / "apex.txt").open("w") as errors:
            self._process = subprocess.Popen(
                [os.environ["OLS_APEX"], "apex.json"], cwd=folder, stderr=errors
            )
        wait(self._listens, "Apex listens")

    @staticmethod
    def _listens():
        try:
            socket.create_connection(("127.0.0.1", NODES)).close()
        except OSError:
            return False
        return True

    def stop(self):
        self._process.send_signal(signal.SIGINT)
        self._process.wait(60.0)

    def messages(self):
        """What it has kept: kind, its complaint, the message. It must have stopped."""
        (data,) = self.folder.glob("data/*.sqlite")
        with sqlite3.connect(data) as kept:
            rows = kept.execute("select parsed_type, error_description, proto from Message")
            return [(*row[:2], SapientMessage.FromString(row[2])) for row in rows]


class Radar:
    """Another node."""

    def __init__(self):
        self._connection = socket.create_connection(("127.0.0.1", NODES))
        self._connection.sendall(framed(self._registration()))
        self._due_s = 0.0

    @staticmethod
    def _registration():
        message = stamped(RADAR)
        said = message.registration
        said.node_definition.add(node_type=Registration.NODE_TYPE_RADAR)
        said.icd_version = VERSION
        said.capabilities.add(category="Radar", type="Range", value="5000", units="m")
        said.status_definition.status_interval.units = Registration.TIME_UNITS_SECONDS
        said.status_definition.status_interval.value = 5.0
        mode = said.mode_definition.add(
            mode_name="Default", mode_type=Registration.MODE_TYPE_PERMANENT
        )
        mode.settle_time.units, mode.settle_time.value = Registration.TIME_UNITS_SECONDS, 1.0
        region = mode.task.region_definition
        region.region_type.append(Registration.REGION_TYPE_AREA_OF_INTEREST)
        region.region_area.add(location_units=1, location_datum=1)
        said.config_data.add(manufacturer="Made", model="Up")
        return message

    def turn(self):
        """No faster than Apex takes it."""
        if time.monotonic() >= self._due_s:
            self._due_s = time.monotonic() + 0.1
            self._connection.sendall(framed(detection(*PLACE)))


class CueInput:
    def __init__(self, folder: Path):
        self._status = folder / "cue.json"
        config = folder / "cue.toml"
        config.write_text(
            f'lcm_url = "{LIVE_URL}"\nstatus_file = "{self._status}"\n[[input]]\nname = "hub"\n'
            f'format = "sapient"\nfrom = "tcp://127.0.0.1:{READERS}"\n'
        )
        self._process = subprocess.Popen([str(BIN / "ols-cue"), "--config", str(config)])

    def input(self):
        return (
            json.loads(self._status.read_text())["inputs"]["hub"] if self._status.exists() else {}
        )

    def stop(self):
        self._process.send_signal(signal.SIGTERM)
        assert self._process.wait(60.0) == 0


@pytest.fixture(name="apex")
def fixture_apex(tmp_path):
    if not os.environ.get("OLS_APEX"):
        pytest.skip("OLS_APEX names no command of Apex")
    apex = Apex(tmp_path)
    yield apex
    apex.stop()


def test_apex_takes_ten_detections_a_second(tmp_path, apex):
    publisher, seconds = Publisher(), 12
    to = output("hub", "sapient", f"tcp://127.0.0.1:{NODES}", rate_hz=10.0)
    with Exporter(tmp_path, to, "[sapient]\nstatus_s = 1.0\n") as exporter:
        publisher.until(lambda: exporter.output("hub").get("sent"), "it is accepted")
        end = time.monotonic() + seconds

        def has_run():
            publisher.publish(*(target(number) for number in (7, 8, 9)))
            return time.monotonic() > end

        wait(has_run, "its time")
        assert exporter.output("hub")["failures"] == 0
        assert exporter.output("hub")["complaints"] == 0
    apex.stop()
    kept = apex.messages()
    assert {complaint for _, complaint, _ in kept} == {None}
    kinds = [kind for kind, _, _ in kept]
    assert kinds.count("registration") == 1 and kinds.count("status_report") >= seconds - 2
    detections = [message for kind, _, message in kept if kind == "detection_report"]
    assert len(detections) >= 3 * 9 * seconds  # 10 Hz in the step in which they are published
    for message in detections:
        place = message.detection_report.location
        assert (place.y, place.x) == pytest.approx((LATITUDE_DEG, LONGITUDE_DEG), abs=1e-8)
        assert place.z == pytest.approx(HEIGHT_M, abs=0.005)


def test_another_nodes_detections_are_cues_and_our_own_are_not(tmp_path, apex):
    publisher, cue, radar = Publisher(), CueInput(tmp_path), Radar()
    heard = []
    publisher.bus.subscribe("OLS_CUE", lambda _channel, data: heard.append(data))
    with Exporter(tmp_path, output("hub", "sapient", f"tcp://127.0.0.1:{NODES}")):

        def both():
            radar.turn()
            publisher.bus.handle_timeout(20)
            told = cue.input()
            return told.get("taken", 0) > 3 and told["refused"]["own"] > 3

        publisher.until(both, "a cue")
    cue.stop()
    apex.stop()
    assert {complaint for _, complaint, _ in apex.messages()} == {None}
    assert f"hub.{OBJECT}".encode() in heard[-1]
