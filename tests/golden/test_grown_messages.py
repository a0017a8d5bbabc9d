"""A log of bearings and slews as they were when `across_rad`, `acquired` and `let_go_track_id` had
been added: it must open for ever. This file has made it, once, when it was run as a program."""

from pathlib import Path

import lcm
import pytest
from ols_msg import bearing_t, bearing_v2_t, bearing_v3_t, slew_t

LOG = Path(__file__).parent / "messages" / "grown.lcmlog"
# By channel: what wrote it, what reads it, and its last field.
MESSAGES = {
    "BEARING_V2": (bearing_v2_t, bearing_t, "class_probability"),
    "BEARING": (bearing_v3_t, bearing_t, "acquired"),
    "SLEW": (slew_t, slew_t, "let_go_track_id"),
}


def filled(kind):
    """Each field has a value of its own."""
    message = kind()
    for place, name in enumerate(kind.__slots__, 1):
        value = getattr(message, name)
        if isinstance(value, list):
            value = [place + 0.25 * i for i in range(len(value) or 3)]
        elif isinstance(value, str):
            value = f"ä{place}"
        else:
            value = type(value)(place)
        setattr(message, name, value)
    if "classes" in kind.__slots__:
        message.classes = len(message.class_probability)
    return message


def values(message, names):
    return {n: list(v) if isinstance(v := getattr(message, n), tuple) else v for n in names}


@pytest.mark.parametrize("channel", MESSAGES)
def test_what_was_recorded_is_read_with_all_its_fields(channel):
    (event,) = [e for e in lcm.EventLog(str(LOG), "r") if e.channel == channel]
    _, kind, last = MESSAGES[channel]
    end = kind.__slots__.index(last) + 1
    message = kind.decode(event.data)
    assert values(message, kind.__slots__[:end]) == values(filled(kind), kind.__slots__[:end])
    unknown = kind.__slots__[end:]
    assert values(message, unknown) == values(kind(), unknown), "zero, or empty"


if __name__ == "__main__":
    log = lcm.EventLog(str(LOG), "w")
    for number, (channel, (kind, _, _)) in enumerate(MESSAGES.items(), 1):
        log.write_event(number, channel, filled(kind).encode())
    log.close()
