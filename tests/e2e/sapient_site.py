"""A receiver of SAPIENT for the tests, by others' bindings and others' checks of the standard."""

import socket
import struct
import threading
import time
from dataclasses import dataclass

from google.protobuf.unknown_fields import UnknownFieldSet
from sapient_msg.bsi_flex_335_v2_0.location_pb2 import (
    LOCATION_COORDINATE_SYSTEM_LAT_LNG_DEG_M as DEGREES_AND_METRES,
)
from sapient_msg.bsi_flex_335_v2_0.location_pb2 import LOCATION_DATUM_WGS84_E as ELLIPSOID
from sapient_msg.bsi_flex_335_v2_0.sapient_message_pb2 import SapientMessage
from sapient_msg.bsi_flex_335_v2_0.status_report_pb2 import StatusReport
from sapient_msg_pydantic.bsi_flex_335_v2_0.sapient_message import SapientMessage as Model

RECEIVER = "5913c0f4-9f89-4c01-ab90-939099797c4f"
RADAR = "3d1ffd1b-cc01-4c26-a7e8-bf4da3d393b8"
OBJECT = "01ARYZ6S41TSV4RRFFQ69G5FAV"


def framed(message):
    data = message.SerializeToString()
    return struct.pack("<I", len(data)) + data


def stamped(node_id):
    message = SapientMessage(node_id=node_id)
    message.timestamp.FromNanoseconds(time.time_ns())
    return message


def detection(latitude_deg, longitude_deg, height_m):
    """Of a radar's target; 1e-4 degrees of error each, 12 m in height."""
    message = stamped(RADAR)
    report = message.detection_report
    report.report_id = report.object_id = OBJECT
    place = report.location
    place.x, place.y, place.z = longitude_deg, latitude_deg, height_m
    place.x_error = place.y_error = 1e-4
    place.z_error = 12.0
    place.coordinate_system, place.datum = DEGREES_AND_METRES, ELLIPSOID
    return message


def unknown_fields(message):
    found = [field.field_number for field in UnknownFieldSet(message)]
    for field, value in message.ListFields():
        if field.message_type is None:
            continue
        values = [value] if hasattr(value, "ListFields") else value
        for part in values:
            found += unknown_fields(part)
    return found


def check(message):
    """Mandatory fields, forms of identifiers, nothing that the standard does not know."""
    assert unknown_fields(message) == []
    assert Model.from_pb2(message).to_pb2() == message


@dataclass
class Heard:
    at_s: float
    message: SapientMessage

    def stamp_s(self):
        return self.message.timestamp.ToNanoseconds() * 1e-9


class Receiver:
    """Takes nodes; `answer` is what it says to a registration, or nothing."""

    def __init__(self, answer=True):
        self.answer, self.heard, self.connections = answer, [], []
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while True:
            try:
                connection = self._socket.accept()[0]
            except OSError:
                return
            self.connections.append(connection)
            threading.Thread(target=self._read, args=(connection,), daemon=True).start()

    def _read(self, connection):
        stream = connection.makefile("rb")
        try:
            while head := stream.read(4):
                message = SapientMessage.FromString(stream.read(struct.unpack("<I", head)[0]))
                self.heard.append(Heard(time.time(), message))
                if message.HasField("registration") and self.answer is not None:
                    self._acknowledge(connection)
        except OSError:
            pass

    def _acknowledge(self, connection):
        message = self.to_node()
        message.registration_ack.acceptance = self.answer
        if not self.answer:
            message.registration_ack.ack_response_reason.append("the area is taken")
        connection.sendall(framed(message))

    def to_node(self):
        message = stamped(RECEIVER)
        message.destination_id = self.heard[0].message.node_id
        return message

    def say(self, message):
        self.connections[-1].sendall(framed(message))

    def of(self, kind):
        return [heard for heard in list(self.heard) if heard.message.HasField(kind)]

    def reports(self, goodbye=False):
        """Of state; or those with which a node goes."""
        messages = (heard.message for heard in self.of("status_report"))
        end = StatusReport.SYSTEM_GOODBYE
        return [one for one in messages if (one.status_report.system == end) == goodbye]

    def end_connections(self):
        for connection in self.connections:
            connection.shutdown(socket.SHUT_RDWR)
        self.connections = []
