"""What is archived: which channels, in which folder, with which columns."""

import functools
import io
import struct
from dataclasses import dataclass
from typing import Any

import ols_msg
import pyarrow as pa

from ols_archive.message_types import Field, fields_of


class Unusable(ValueError):
    """A message that cannot be archived; the text is the reason under which it is counted."""


@dataclass(frozen=True)
class Kind:
    name: str  # of its folder
    message: str  # of its definition
    channel: str
    of_station: bool  # whether the channel ends in a station's name

    @property
    def type(self) -> Any:
        return getattr(ols_msg, self.message)

    def is_on(self, channel: str) -> bool:
        if not self.of_station:
            return channel == self.channel
        return channel.startswith(self.channel) and len(channel) > len(self.channel)


# Pictures are left out: they are most of a log's bytes, and no estimator reads them.
KINDS = (
    Kind("bearing", "bearing_t", "OLS_BEARING_", True),
    Kind("sighting", "sighting_t", "OLS_SIGHTING_", True),
    Kind("skyline", "skyline_t", "OLS_SKYLINE_", True),
    Kind("station_status", "station_status_t", "OLS_STATUS_", True),
    Kind("target", "target_t", "OLS_TARGET", False),
    Kind("target_paper", "target_t", "OLS_TARGET_PAPER", False),
    Kind("fusion_status", "fusion_status_t", "OLS_FUSION_STATUS", False),
    Kind("slew", "slew_t", "OLS_SLEW_", True),
    Kind("occlusion", "occlusion_t", "OLS_OCCLUSION_", True),
    Kind("ptu_command", "ptu_command_t", "OLS_PTU_", True),
    Kind("lens_command", "lens_command_t", "OLS_LENS_", True),
    Kind("designate", "designate_t", "OLS_DESIGNATE_", True),
    Kind("record", "record_t", "OLS_RECORD_", True),
    Kind("command_reply", "command_reply_t", "OLS_REPLY_", True),
    Kind("incident", "incident_t", "OLS_INCIDENT", False),
    Kind("cue", "cue_t", "OLS_CUE", False),
    Kind("cue_order", "cue_order_t", "OLS_CUE_ORDER", False),
    Kind("cue_reply", "command_reply_t", "OLS_CUE_REPLY", False),
)
BY_NAME = {kind.name: kind for kind in KINDS}

# What the archive adds to each message.
ENVELOPE = (
    Field("channel", pa.string(), "of the bus, on which it came"),
    Field(
        "recorded_utime",
        pa.int64(),
        "[us] UTC since 1970 at which the logger, or the archiver, received it, by its own clock",
    ),
    Field(
        "signature",
        pa.binary(),
        "the trailer behind the message (docs/security.md); null if it was not signed",
    ),
    Field(
        "digest",
        pa.int64(),
        "of message and signature as received: tells a repetition from a contradiction",
    ),
)


def kind_of(channel: str) -> Kind | None:
    return next((kind for kind in KINDS if kind.is_on(channel)), None)


@functools.cache
def columns_of(kind: Kind) -> tuple[Field, ...]:
    return (*ENVELOPE, *fields_of(kind.message))


@functools.cache
def schema_of(kind: Kind) -> pa.Schema:
    return pa.schema(
        [
            pa.field(field.name, field.type, metadata={"description": field.description})
            for field in columns_of(kind)
        ]
    )


def decode(kind: Kind, channel: str, data: bytes) -> Any:
    """The message; Unusable if it is not whole, or not that of its channel."""
    stream = io.BytesIO(data)
    try:
        message = kind.type.decode(stream)
    except (ValueError, struct.error, IndexError, OverflowError, MemoryError):
        raise Unusable("undecodable") from None
    if stream.read(1):
        raise Unusable("undecodable")
    if kind.of_station and channel != kind.channel + message.station:
        raise Unusable("other_station")
    return message


def values_of(message: Any) -> tuple[Any, ...]:
    """In the order of the definition. An array of booleans may be an iterator, to be read once."""
    return tuple(getattr(message, name) for name in message.__slots__)


def table_of(kind: Kind, rows: list[tuple[Any, ...]]) -> pa.Table:
    """Rows of ENVELOPE's values and values_of()."""
    schema = schema_of(kind)
    columns = zip(*rows, strict=True) if rows else ([] for _ in schema)
    arrays = [
        pa.array(list(column), field.type) for column, field in zip(columns, schema, strict=True)
    ]
    return pa.Table.from_arrays(arrays, schema=schema)
