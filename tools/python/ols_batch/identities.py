"""The second job: which objects of successive hours are one target.

Two tasks see the warm-up of an hour. An object of one and an object of the other are the same
target when the same bearings belong to both: no distance has to be judged.
"""

import contextlib
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
from ols_archive.partitions import (
    HOUR_US,
    Damaged,
    Hour,
    file_of,
    hours_of,
    metadata,
    named_if_damaged,
    read,
    write,
)

from ols_batch.plan import digest_of
from ols_batch.task import FIXES, SEAM

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
BEARING = ["border_us", "channel", "boot_id", "sequence"]  # what a bearing is known by
OBJECTS = ["object_before", "object_after"]


@dataclass
class Joined:
    targets: int
    damaged: list[str]
    fixes: list[Path]  # files that can be read
    made: str  # names what identities and fixes are; empty: not yet what they are to be


def same_objects(before: pa.Table, after: pa.Table) -> dict[int, int]:
    """Object of the later hour -> that of the earlier one: each takes the one with which it shares
    the most bearings, if that one shares the most with it, too."""
    both = before.join(after, BEARING, None, "inner", "_before", "_after", use_threads=False)
    pairs = both.group_by(OBJECTS).aggregate([([], "count_all")])
    # The most shared first; of equals the first object.
    pairs = pairs.sort_by([("count_all", "descending"), *((name, "ascending") for name in OBJECTS)])
    earlier, later = (pairs[name].to_pylist() for name in OBJECTS)
    first_later, first_earlier = {}, {}
    for one, other in zip(earlier, later, strict=True):
        first_later.setdefault(one, other)
        first_earlier.setdefault(other, one)
    return {other: one for other, one in first_earlier.items() if first_later[one] == other}


def name_of(hour: Hour, number: int) -> str:
    return f"{hour.region}-{hour.day}T{hour.hour:02}-{number}"


@dataclass
class Seamed:
    """An hour with what its task told of it."""

    hour: Hour
    fixes: Path
    seam: Path
    made: str  # names the result
    objects: list[tuple[int, int, int, int]]


def seamed_hours(output: Path, damaged: list[str]) -> list[Seamed]:
    """In order; those that cannot be read are named."""
    found = []
    for hour in hours_of(output, "fixes"):
        fixes, seam = (file_of(output, kind, hour) for kind in ("fixes", "seam"))
        try:
            about = metadata(fixes, "result", "content", schema=FIXES)
            with named_if_damaged(fixes):
                objects = [tuple(map(int, one)) for one in json.loads(about["result"])["objects"]]
            found.append(Seamed(hour, fixes, seam, about["content"], objects))
        except (Damaged, FileNotFoundError) as error:
            damaged.append(str(error))
    return found


def made_of(hours: list[Seamed]) -> str:
    """Names what identities depend on."""
    text = "\n".join([digest_of(__file__), *(f"{one.hour} {one.made}" for one in hours)])
    return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


def join(output: Path) -> Joined:
    """Writes identities.parquet, of all hours there are, if any of them is new. A target is named
    after its first hour."""
    damaged: list[str] = []
    hours = seamed_hours(output, damaged)
    made = made_of(hours)
    path, fixes = output / "identities.parquet", [one.fixes for one in hours]
    with contextlib.suppress(FileNotFoundError, Damaged):
        about = metadata(path, "made", "targets")
        if about["made"] == made and not damaged:
            return Joined(int(about["targets"]), damaged, fixes, made)
    rows = named_rows(hours, damaged)
    targets = len({row[2] for row in rows})
    if damaged:
        made = ""  # whoever mends the file, perhaps with the same content: all is joined again
    write(path, table_of(rows), {"made": made, "targets": str(targets)})
    return Joined(targets, damaged, fixes, made)


def named_rows(hours: list[Seamed], damaged: list[str]) -> list[tuple]:
    """Region, start, name, number, first and last instant, fixes."""
    rows = []
    names: dict[int, str] = {}
    previous: Hour | None = None
    before = NO_SEAM
    for one in hours:
        try:
            seam = read(one.seam, schema=SEAM)
        except (Damaged, FileNotFoundError) as error:
            damaged.append(str(error))
            seam = NO_SEAM
        same = {}
        if previous is not None and previous.next() == one.hour and len(before) and len(seam):
            same = same_objects(before, seam)
        names = {o[0]: names.get(same.get(o[0], -1), name_of(one.hour, o[0])) for o in one.objects}
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
