"""The second job: which objects of successive hours are one target.

Two tasks see the warm-up of an hour. An object of one and an object of the other are the same
target when the same bearings belong to both: no distance has to be judged.
"""

import contextlib
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

import duckdb
import pyarrow as pa
from ols_archive.partitions import (
    HOUR_US,
    Damaged,
    Hour,
    file_of,
    hours_of,
    metadata,
    read,
    write,
)

IDENTITIES = pa.schema(
    [
        pa.field(name, kind, metadata={"description": text})
        for name, kind, text in (
            ("region", pa.string(), "as in the path of the hour's fixes"),
            ("day", pa.date32(), "the same, UTC"),
            ("hour", pa.int64(), "the same, UTC"),
            ("object", pa.int64(), "number of the object in those fixes"),
            ("target", pa.string(), "name of the target, the same in all of its hours"),
            ("first_utime", pa.int64(), "[us] UTC since 1970: its first fix in this hour"),
            ("last_utime", pa.int64(), "[us] and its last one"),
            ("fixes", pa.int64(), "how many there are"),
        )
    ]
)
# Each object of an hour takes the one of the hour before with which it shares the most bearings, if
# that one shares the most with it, too.
SHARED = """
WITH pairs AS (
  SELECT before.object AS earlier, after.object AS later, count(*) AS shared
  FROM before JOIN after USING (border_us, channel, boot_id, sequence)
  GROUP BY ALL
), ranked AS (
  SELECT *, row_number() OVER (PARTITION BY later ORDER BY shared DESC, earlier) AS of_later,
            row_number() OVER (PARTITION BY earlier ORDER BY shared DESC, later) AS of_earlier
  FROM pairs
)
SELECT later, earlier FROM ranked WHERE of_later = 1 AND of_earlier = 1
"""


@dataclass
class Joined:
    targets: int
    damaged: list[str]
    is_new: bool = True


def same_objects(
    connection: duckdb.DuckDBPyConnection, before: pa.Table, after: pa.Table
) -> dict[int, int]:
    """Object of the later hour -> that of the earlier one."""
    connection.register("before", before)
    connection.register("after", after)
    return dict(connection.execute(SHARED).fetchall())


def name_of(hour: Hour, number: int) -> str:
    return f"{hour.region}-{hour.day}T{hour.hour:02}-{number}"


@dataclass
class Seamed:
    """An hour with what its task told of it."""

    hour: Hour
    seam: Path
    made: str  # names the result
    objects: list[tuple[int, int, int, int]]


def seamed_hours(output: Path, damaged: list[str]) -> list[Seamed]:
    """In order; those that cannot be read are named."""
    found = []
    for hour in hours_of(output, "fixes"):
        try:
            about = metadata(file_of(output, "fixes", hour))
            seam = file_of(output, "seam", hour)
            objects = json.loads(about["result"])["objects"]
            found.append(Seamed(hour, seam, about["content"], objects))
        except (Damaged, FileNotFoundError) as error:
            damaged.append(str(error))
    return found


def join(output: Path) -> Joined:
    """Writes identities.parquet, of all hours there are, if any of them is new. A target is named
    after its first hour."""
    damaged: list[str] = []
    hours = seamed_hours(output, damaged)
    made = hashlib.blake2b("".join(one.made for one in hours).encode(), digest_size=16).hexdigest()
    path = output / "identities.parquet"
    with contextlib.suppress(FileNotFoundError, Damaged):
        about = metadata(path)
        if about["made"] == made and not damaged:
            return Joined(int(about["targets"]), damaged, is_new=False)
    rows = named_rows(hours, damaged)
    targets = len({row[2] for row in rows})
    write(path, table_of(rows), {"made": made, "targets": str(targets)})
    return Joined(targets, damaged)


def named_rows(hours: list[Seamed], damaged: list[str]) -> list[tuple]:
    """Region, start, name, number, first and last instant, fixes."""
    rows = []
    names: dict[int, str] = {}
    previous: Hour | None = None
    before = NO_SEAM
    with duckdb.connect() as connection:
        for one in hours:
            try:
                seam = read(one.seam)
            except (Damaged, FileNotFoundError) as error:
                damaged.append(str(error))
                seam = NO_SEAM
            same = {}
            if previous is not None and previous.next() == one.hour and len(before) and len(seam):
                same = same_objects(connection, before, seam)
            names = {
                o[0]: names.get(same.get(o[0], -1), name_of(one.hour, o[0])) for o in one.objects
            }
            rows += [(one.hour.region, one.hour.start_us, names[o[0]], *o) for o in one.objects]
            previous, before = one.hour, seam
    return rows


NO_SEAM = pa.table({})


def table_of(rows: list[tuple]) -> pa.Table:
    regions, starts, names, numbers, first, last, counts = (
        zip(*rows, strict=True) if rows else [[]] * 7
    )
    days = [start // (24 * HOUR_US) for start in starts]
    hours = [start // HOUR_US % 24 for start in starts]
    columns = (regions, days, hours, numbers, names, first, last, counts)
    arrays = [
        pa.array(list(column), pa.int32()).cast(field.type)
        if field.name == "day"
        else pa.array(list(column), field.type)
        for column, field in zip(columns, IDENTITIES, strict=True)
    ]
    return pa.Table.from_arrays(arrays, schema=IDENTITIES)
