"""What a stranger, an eavesdropper or a stolen tripod sends: attacks as messages to repeat."""

import copy
import itertools
import math
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import ols
import ols_msg

from ols_attacks.sender import Messages

COPIES = 500  # of one attack's message, with sequences of their own
INVENTED = 100  # stations
HOUR_US = 3_600_000_000
OTHER_BOOT = 4242
SIGNATURE_BYTE = -40  # of a trailer


@dataclass
class Attack:
    name: str
    victim: str  # the process whose counters must account for it: "fusion" or a station
    messages: Messages
    most_hz: float = math.inf
    may_be_believed: bool = False  # it has the key of whom it speaks for


@dataclass
class Known:
    """What an eavesdropper on the site has, and the keys of the members that the attacks misuse."""

    keys: str
    stations: list[str]
    heard: dict[str, list[bytes]]  # genuine messages, by channel
    names: int = 100_000  # of the attack with invented names
    seconds: float = 10.0  # of an attack

    @property
    def victim(self) -> str:
        return self.stations[0]

    @property
    def other(self) -> str:
        return self.stations[1]

    def member(self, name: str, boot_id: int = 99) -> Any:
        """Who knows the boots of all stations."""
        member = ols.Trust(self.keys, name, boot_id)
        for station in self.stations:
            channel = f"OLS_STATUS_{station}"
            member.hear(channel, self.heard[channel][-1])
        return member

    def newest(self, kind: str, station: str, message: Any) -> Any:
        return message.decode(self.heard[f"OLS_{kind}_{station}"][-1])


def addressed(message: Any, station: str, sequence: int, utime: int) -> Any:
    message.utime, message.schema_version = utime, message.SCHEMA_VERSION
    message.boot_id, message.sequence = 77, sequence
    message.station, message.lease_s = station, 5.0
    return message


def now_us() -> int:
    return time.time_ns() // 1000


def turns(station: str, utime: int) -> Iterable[bytes]:
    """Commands that would swing the unit away."""
    for sequence in range(1, COPIES + 1):
        message = addressed(ols_msg.ptu_command_t(), station, sequence, utime)
        message.command = message.COMMAND_POINT
        message.pan_rad, message.tilt_rad = 1.0, 0.0
        yield message.encode()


def on(channel: str, messages: Iterable[bytes]) -> Messages:
    return [(channel, data) for data in messages]


def forged_commands(k: Known) -> Messages:
    channel, operator = f"OLS_PTU_{k.victim}", k.member("operator")
    signed = [operator.sign(channel, data) for data in turns(k.victim, now_us())]
    at = SIGNATURE_BYTE
    return on(channel, [d[:at] + bytes([d[at] ^ 1]) + d[at + 1 :] for d in signed])


def replayed_commands(k: Known) -> Messages:
    channel = f"OLS_SLEW_{k.victim}"
    return on(channel, k.heard[channel])


def misaddressed_commands(k: Known) -> Messages:
    return on(f"OLS_SLEW_{k.victim}", k.heard[f"OLS_SLEW_{k.other}"])


def stale_commands(k: Known) -> Messages:
    channel, operator = f"OLS_PTU_{k.victim}", k.member("operator")
    return on(channel, [operator.sign(channel, d) for d in turns(k.victim, now_us() - HOUR_US)])


def commands_of_another_role(k: Known) -> Messages:
    channel, stolen = f"OLS_PTU_{k.victim}", k.member(k.other)
    return on(channel, [stolen.sign(channel, d) for d in turns(k.victim, now_us())])


def commands_to_another_boot(k: Known) -> Messages:
    """Made for a boot that is over, played to this one, as with a clock rolled back."""
    channel, status = f"OLS_PTU_{k.victim}", f"OLS_STATUS_{k.victim}"
    before = k.newest("STATUS", k.victim, ols_msg.station_status_t)
    before.boot_id, before.sequence, before.utime = OTHER_BOOT, 1, now_us()
    former = ols.Trust(k.keys, k.victim, OTHER_BOOT)
    operator = ols.Trust(k.keys, "operator", 98)
    operator.hear(status, former.sign(status, before.encode()))
    return on(channel, [operator.sign(channel, d) for d in turns(k.victim, now_us())])


def unsigned_designations(k: Known) -> Messages:
    made = []
    for sequence in range(1, COPIES + 1):
        message = addressed(ols_msg.designate_t(), k.victim, sequence, now_us())
        message.x_px = message.y_px = 10.0
        message.width_px = message.height_px = 40.0
        made.append(message.encode())
    return on(f"OLS_DESIGNATE_{k.victim}", made)


def bearings_as(k: Known, names: Iterable[str], change: Callable[[Any, int], None]) -> Messages:
    """Copies of a genuine bearing under these names, as the present."""
    genuine = k.newest("BEARING", k.victim, ols_msg.bearing_t)
    made = []
    for number, name in enumerate(names):
        message = copy.copy(genuine)
        message.station, message.utime = name, now_us()
        message.sequence = genuine.sequence + 1000 + number
        change(message, number)
        made.append((f"OLS_BEARING_{name}", message.encode()))
    return made


def aside(message: Any, number: int) -> None:
    message.azimuth_rad = (message.azimuth_rad + 0.05 + 1e-5 * number) % (2.0 * math.pi)


def bearings_in_real_names(k: Known) -> Messages:
    return bearings_as(k, itertools.islice(itertools.cycle(k.stations), 4 * COPIES), aside)


def bearings_of_invented_stations(k: Known) -> Messages:
    names = (f"x{n % INVENTED}" for n in range(20 * INVENTED))
    return bearings_as(k, names, aside)


def invented_names(k: Known) -> Messages:
    return bearings_as(k, (f"n{n}" for n in range(k.names)), aside)


MAD_HZ = 2000.0


def bearings_of_a_stolen_key(k: Known) -> Messages:
    """A member that has gone mad: signed by its own key, each a new message of its time, each
    pointing elsewhere. Its name alone must pay for it."""
    name, begin_us = k.other, now_us() + 1_000_000  # when all are signed
    count = int(MAD_HZ * k.seconds)
    boot_id = k.newest("STATUS", name, ols_msg.station_status_t).boot_id
    mad = k.member(name, boot_id)

    def anywhere(message: Any, number: int) -> None:
        message.utime = begin_us + int(1e6 * number / MAD_HZ)
        message.sequence += 1_000_000
        message.azimuth_rad = 2.0 * math.pi * (0.618 * number % 1.0)

    made = bearings_as(k, itertools.repeat(name, count), anywhere)
    return [(channel, mad.sign(channel, data)) for channel, data in made]


HOSTILE = (math.nan, math.inf, -math.inf, 1e308, -1e308, 0.0, 5e-324)


def hostile_values(k: Known) -> Messages:
    """Half of them in real names, and signed by a stolen tripod's key where it may sign."""
    fields = ("azimuth_rad", "elevation_rad", "belief", "clock_error_s")

    def spoil(message: Any, number: int) -> None:
        value = HOSTILE[number % len(HOSTILE)]
        setattr(message, fields[number // len(HOSTILE) % len(fields)], value)
        message.covariance_white_rad2 = [value] * 3
        message.utime += (number % 3 - 1) * HOUR_US

    names = itertools.cycle([*k.stations, "x1", "x2", "x3"])
    return bearings_as(k, itertools.islice(names, 4 * COPIES), spoil)


def forged_statuses(k: Known) -> Messages:
    """Unsigned, of real and of invented stations, and signed by another station."""
    stolen, made = k.member(k.other), []
    for number in range(COPIES):
        message = k.newest("STATUS", k.victim, ols_msg.station_status_t)
        message.sequence += 1000 + number
        message.latitude_deg += 0.5
        message.state = message.STATE_TRACKING
        data = message.encode()
        made.append((f"OLS_STATUS_{k.victim}", data))
        made.append((f"OLS_STATUS_{k.victim}", stolen.sign(f"OLS_STATUS_{k.victim}", data)))
        message.station = f"x{number % INVENTED}"
        made.append((f"OLS_STATUS_{message.station}", message.encode()))
    return made


def recording(k: Known) -> Messages:
    """All that the fusion listens to, as it was."""
    played = [
        on(channel, messages)
        for channel, messages in k.heard.items()
        if channel.startswith(("OLS_BEARING_", "OLS_STATUS_"))
    ]
    return list(itertools.chain.from_iterable(played))


FLOOD_HZ = 50_000.0


def all_attacks(names: int) -> list[Callable[[Known], Attack]]:
    """Each is made when it begins, of what is known then: its stamps are of that time."""
    on_station = [
        ("forged commands", forged_commands),
        ("replayed commands", replayed_commands),
        ("mis-addressed commands", misaddressed_commands),
        ("stale commands", stale_commands),
        ("commands by another role", commands_of_another_role),
        ("commands to another boot", commands_to_another_boot),
        ("unsigned designations", unsigned_designations),
    ]
    on_fusion = [
        ("bearings in real names", bearings_in_real_names),
        ("bearings of 100 invented stations", bearings_of_invented_stations),
        (f"{names} invented names", invented_names),
        ("hostile values", hostile_values),
        ("forged statuses", forged_statuses),
        ("a recorded log", recording),
    ]
    attacks: list[Callable[[Known], Attack]] = [
        *(lambda k, n=n, make=make: Attack(n, k.victim, make(k)) for n, make in on_station),
        *(lambda k, n=n, make=make: Attack(n, "fusion", make(k)) for n, make in on_fusion),
    ]
    flood = "flood of 50 000 unsigned/s"
    attacks.append(lambda k: Attack(flood, "fusion", bearings_in_real_names(k), FLOOD_HZ))
    return attacks


def stolen_key(k: Known) -> Attack:
    """The last one: its name stays silent."""
    name = "a stolen key gone mad"
    return Attack(name, "fusion", bearings_of_a_stolen_key(k), MAD_HZ, may_be_believed=True)
