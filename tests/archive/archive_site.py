"""What the tests of archive and batch have in common: logs of simulated flights, and an archive."""

import random
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import lcm
import numpy as np
import ols_msg
import pyarrow.parquet as pq
from ols_archive.__main__ import main as ols_archive
from ols_bench import flights

ROOT = Path(__file__).resolve().parents[2]
SEED = 23
REGION = "brno"
HOURS, FLIGHT_S, RATE_HZ = 5, 12.0, 5.0


print(f"archive: seed {SEED}")


def filled(message: Any, chance: random.Random, utime: int) -> Any:
    """A value in every field, and as many in a list as its message's own count says."""
    for name in message.__slots__:
        value = getattr(message, name)
        if isinstance(value, bool):
            setattr(message, name, chance.random() < 0.5)
        elif isinstance(value, int):
            setattr(message, name, chance.randrange(100))
        elif isinstance(value, float):
            setattr(message, name, chance.gauss(0.0, 1.0))
        elif isinstance(value, str):
            setattr(message, name, "é" * (name != "station") + str(chance.randrange(1000)))
        elif value:  # of a fixed size
            setattr(message, name, [chance.gauss(0.0, 1.0) for _ in value])
        else:
            continue
    lists = ("stations", "borders", "border_points", "devices", "alarms", "readings", "cues")
    for name in (*lists, "alarm_ids", "alarm_parameters", "classes"):
        if name in message.__slots__:
            setattr(message, name, 0)
    if "counters" in message.__slots__:
        message.counters = 2
        message.counter_name, message.counter_value = ["a", "b"], [1.5, float("nan")]
    if isinstance(message, ols_msg.target_t):
        message.stations, message.station, message.used = 2, ["a", "b"], [True, False]
        message.weight, message.age_s = [1.0, 0.0], [0.0, -0.1]
    if isinstance(message, ols_msg.skyline_t):
        message.columns, message.column, message.disagrees = 2, [0, 1], [True, False]
        message.elevation_rad, message.sd_rad = [0.25, 0.5], [0.125, 0.0]
        message.hides_from_m = [0.0, 1500.0]
    message.utime = utime
    return message


def write_log(path: Path, events: Iterable[tuple[int, str, bytes]]) -> Path:
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for utime, channel, data in events:
        log.write_event(utime, channel, data)
    log.close()
    return path


def flown(hours: int = HOURS) -> list["ols_msg.bearing_t"]:
    chance = np.random.default_rng(SEED)
    planned = flights.schedule(hours, FLIGHT_S, chance)
    return list(flights.bearings(planned, RATE_HZ, chance))


def event(message: "ols_msg.bearing_t") -> tuple[int, str, bytes]:
    return message.utime + 5000, f"OLS_BEARING_{message.station}", message.encode()


def archived(folder: Path, messages: Iterable["ols_msg.bearing_t"], name: str = "a.lcmlog") -> Path:
    """An archive with these, beside what is there already."""
    log = write_log(folder / name, map(event, messages))
    assert ols_archive([str(folder / "archive"), "--region", REGION, str(log)]) == 0
    return folder / "archive"


def flip_a_byte(path: Path) -> None:
    """In the middle of the first column's data, which every reader reads."""
    column = pq.ParquetFile(path).metadata.row_group(0).column(0)
    data = bytearray(path.read_bytes())
    data[column.data_page_offset + column.total_compressed_size // 2] ^= 0x40
    path.write_bytes(bytes(data))
