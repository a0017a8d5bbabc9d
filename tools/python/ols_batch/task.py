"""One task: an hour with its warm-up, through the estimators of ols-fuse.

It is a function of its inputs: the same bytes whoever runs it, and however often. It reads a
warm-up before its hour and a little after it, and writes the hour alone.
"""

import hashlib
import itertools
import json
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
import ols
import pyarrow as pa
from ols_archive.kinds import BY_NAME, schema_of
from ols_archive.message_types import list_of
from ols_archive.partitions import Damaged, Hour, file_of, read, write

from ols_batch.plan import Settings, checksum, program

NEAR_US, SAMPLE = 10_000_000, 8  # of a seam's bearings: all near the border, one in eight elsewhere

SILENCE_US = 60_000_000  # a track is given up after 2 s, its identity forgotten after 5 s

NEEDED = (
    *("station", "channel", "utime", "boot_id", "sequence", "track_id", "calibration_id"),
    *("azimuth_rad", "elevation_rad", "belief", "clock_error_s", "camera_ecef_m"),
    *("camera_position_sd_m", "covariance_white_rad2", "covariance_systematic_rad2"),
    "aim_sd_rad",
)
LATER = {"aim_sd_rad"}  # files of before lack it: unknown, which is zero
TRIPLES = {
    *("camera_ecef_m", "camera_position_sd_m", "covariance_white_rad2"),
    "covariance_systematic_rad2",
}
READ = pa.schema([schema_of(BY_NAME["bearing"]).field(name) for name in NEEDED])


FIXES = pa.schema(
    [
        pa.field(name, kind, metadata={"description": text})
        for name, kind, text in (
            ("utime", pa.int64(), "[us] UTC since 1970: the instant at which the position holds"),
            ("object", pa.int64(), "number of the object within its hour; see identities"),
            ("latitude_deg", pa.float64(), "[deg] WGS84"),
            ("longitude_deg", pa.float64(), "[deg] WGS84"),
            ("height_m", pa.float64(), "[m] above the WGS84 ellipsoid"),
            ("position_ecef_m", list_of(pa.float64(), 3), "[m] Earth-centred Earth-fixed"),
            (
                "velocity_ecef_m_s",
                list_of(pa.float64(), 3),
                "[m/s] the same axes; NaN if unknown",
            ),
            (
                "position_covariance_enu_m2",
                list_of(pa.float64(), 6),
                "[m^2] at the target's own east, north, up: ee, en, eu, nn, nu, uu; white and "
                "systematic parts together",
            ),
            (
                "position_covariance_white_enu_m2",
                list_of(pa.float64(), 6),
                "[m^2] the part that averaging reduces",
            ),
            ("crossing_angle_rad", pa.float64(), "[rad] largest angle between two rays, 0..pi/2"),
            ("residual", pa.float64(), "RMS of the rays' normalised residuals; about 1"),
            ("stations_used", pa.int16(), "stations whose rays were used"),
            ("stations_set_aside", pa.int16(), "stations whose rays were rejected as outliers"),
        )
    ]
)
# Which object bearings near the hour's two borders belong to: what identities are joined by.
SEAM = pa.schema(
    [
        ("border_us", pa.int64()),
        ("channel", pa.string()),
        ("boot_id", pa.int64()),
        ("sequence", pa.int64()),
        ("object", pa.int64()),
    ]
)


@dataclass
class Result:
    """What a task tells; the rest is in its files."""

    hour: Hour
    bearings: int = 0
    used: int = 0
    fixes: int = 0
    # Of each object: number, first and last instant, fixes.
    objects: list[tuple[int, int, int, int]] = field(default_factory=list)
    unused: Counter[str] = field(default_factory=Counter)  # bearings of the hour, by reason
    unlocated: Counter[str] = field(default_factory=Counter)  # instants, warm-up included
    beside: list[str] = field(default_factory=list)
    damaged: list[str] = field(default_factory=list)

    def as_text(self) -> str:
        """Kept with the hour's fixes, so that a rerun that skips the hour knows it, too."""
        return json.dumps({**self.__dict__, "hour": None}, sort_keys=True)

    @classmethod
    def of_text(cls, hour: Hour, text: str) -> "Result":
        result = cls(**{**json.loads(text), "hour": hour})
        result.unused, result.unlocated = Counter(result.unused), Counter(result.unlocated)
        return result


def bearings_around(settings: Settings, hour: Hour, result: Result) -> pa.Table:
    """Of the hour, its warm-up and its run-out. A neighbour that cannot be read is named; the hour
    itself must be readable."""
    tables = []
    window = settings.first_us(hour), settings.last_us(hour)
    for one in settings.inputs(hour):
        try:
            path = file_of(settings.archive, "bearing", one)
            tables.append(read(path, None, window, READ, LATER))
        except FileNotFoundError:
            continue
        except Damaged as error:
            if one == hour:
                raise
            result.damaged.append(str(error))
    return pa.concat_tables(tables)


def triples(table: pa.Table, name: str) -> np.ndarray:
    return table[name].combine_chunks().flatten().to_numpy().reshape(-1, 3)


def bearings_of(table: pa.Table) -> "ols.Bearings":
    columns = {
        name: triples(table, name) if name in TRIPLES else table[name].to_numpy()
        for name in NEEDED
        if name not in ("station", "channel", "sequence")
    }
    return ols.Bearings(table["station"].to_pylist(), **columns)


def fixes_of(columns: dict[str, np.ndarray], number: int, hour: Hour) -> pa.Table:
    """Those of the hour itself."""
    core = (columns["utime"] >= hour.start_us) & (columns["utime"] < hour.end_us)
    place, quality = columns["place"][core], columns["quality"][core]
    plain = {
        "utime": columns["utime"][core],
        "object": np.full(len(place), number),
        "latitude_deg": place[:, 0],
        "longitude_deg": place[:, 1],
        "height_m": place[:, 2],
        "crossing_angle_rad": quality[:, 0],
        "residual": quality[:, 1],
        "stations_used": columns["stations_used"][core],
        "stations_set_aside": columns["stations_set_aside"][core],
    }

    def column(name: str, kind: pa.DataType) -> pa.Array:
        if name in plain:
            return pa.array(plain[name]).cast(kind)
        return pa.FixedSizeListArray.from_arrays(columns[name][core].ravel(), type=kind)

    arrays = [column(one.name, one.type) for one in FIXES]
    return pa.Table.from_arrays(arrays, schema=FIXES)


def seam_of(table: pa.Table, objects: np.ndarray, settings: Settings, hour: Hour) -> pa.Table:
    """At the beginning the warm-up, at the end what is the next hour's warm-up."""
    utime, sequence = table["utime"].to_numpy(), table["sequence"].to_numpy()
    before_us, after_us = (round(s * 1e6) for s in (settings.warm_up_s, settings.run_out_s))
    sides = []
    for border_us in (hour.start_us, hour.end_us):
        off_us = utime - border_us
        chosen = (objects > 0) & (off_us >= -before_us) & (off_us < after_us)
        chosen &= (np.abs(off_us) < NEAR_US) | (sequence % SAMPLE == 0)
        side = table.select(["channel", "boot_id", "sequence"]).filter(pa.array(chosen))
        border = pa.array(np.full(len(side), border_us))
        side = side.add_column(0, "border_us", border)
        sides.append(side.append_column("object", pa.array(objects[chosen])).cast(SEAM))
    return pa.concat_tables(sides)


def fuse_objects(
    bearings: "ols.Bearings",
    utime: np.ndarray,
    objects: np.ndarray,
    settings: Settings,
    result: Result,
) -> pa.Table:
    """The fixes of each object that is seen in the hour: others cost the warm-up nothing more."""
    config = ols.OfflineConfig(estimator=settings.estimator, smooth=settings.smooth)
    tables = [FIXES.empty_table()]
    within = utime < settings.estimated_until_us(result.hour)
    core = (utime >= result.hour.start_us) & (utime < result.hour.end_us)
    for number in sorted(set(objects[core & (objects > 0)].tolist())):
        chosen = np.flatnonzero(within & (objects == number))
        columns, unlocated, beside = ols.fuse_columns(bearings, chosen, config)
        fixes = fixes_of(columns, number, result.hour)
        tables.append(fixes)
        if len(fixes):
            times = fixes["utime"]
            result.objects.append((number, times[0].as_py(), times[-1].as_py(), len(fixes)))
        result.unlocated.update(unlocated)
        result.beside += [f"{name}, object {number}: {why}" for name, why in beside.items()]
    return pa.concat_tables(tables).sort_by([("utime", "ascending"), ("object", "ascending")])


def content_of(*tables: pa.Table) -> str:
    """Names what is in them."""
    digest = hashlib.blake2b(digest_size=16)
    for table in tables:
        for column in table.itercolumns():
            for buffer in column.combine_chunks().buffers():
                digest.update(buffer or b"")
    return digest.hexdigest()


def stretches(utime: np.ndarray) -> list[slice]:
    """Of times in order: the parts between silences, after which no track is left. Objects are told
    apart anew in each, so that how does not depend on how much before it was read."""
    borders = np.flatnonzero(np.diff(utime) >= SILENCE_US) + 1
    ends = [0, *borders.tolist(), len(utime)]
    return [slice(*pair) for pair in itertools.pairwise(ends)]


def objects_of(table: pa.Table, within_us: tuple[int, int]) -> np.ndarray:
    """Of each row the number of its object, or why it has none (ols.REFUSALS). Only in stretches
    with rows of these times: in others 0."""
    utime = table["utime"].to_numpy()
    objects = np.zeros(len(table), np.int64)
    for part in stretches(utime):
        if utime[part.stop - 1] < within_us[0] or utime[part.start] >= within_us[1]:
            continue
        rows = table.slice(part.start, part.stop - part.start)
        found = ols.separate_objects(bearings_of(rows))
        objects[part] = np.where(found > 0, found + max(0, objects.max()), found)
    return objects


def estimate(settings: Settings, hour: Hour, fingerprint: str) -> Result:
    """Writes the hour's fixes and then its seam, by which it is done."""
    if settings.program != program():
        raise RuntimeError("this worker has another build of the program")
    result = Result(hour)
    table = bearings_around(settings, hour, result)
    bearings = bearings_of(table)
    objects = objects_of(table, (hour.start_us, hour.end_us))
    utime = table["utime"].to_numpy()
    fixes = fuse_objects(bearings, utime, objects, settings, result)
    located = np.isin(objects, fixes["object"].to_numpy())
    seam = seam_of(table, np.where(located, objects, 0), settings, hour)
    core = (utime >= hour.start_us) & (utime < hour.end_us)
    result.bearings, result.fixes = int(core.sum()), len(fixes)
    result.used = int(np.count_nonzero(core & (objects > 0)))
    numbers, counts = np.unique(objects[core & (objects <= 0)], return_counts=True)
    for number, count in zip(numbers.tolist(), counts.tolist(), strict=True):
        result.unused[ols.REFUSALS.get(number, "of_no_object")] += count
    # Without a part of its warm-up it is not yet what was asked for: a rerun tries again.
    made = "incomplete" if result.damaged else fingerprint
    about = {
        "hour": str(hour),
        "fingerprint": made,
        # Of the fixes what identities and plots are made of.
        "content": content_of(fixes.select(["utime", "object", "position_ecef_m"]), seam),
        "estimator": settings.estimator,
    }
    path = file_of(settings.output, "fixes", hour)
    # Without waiting for the disk: what a loss of power has torn does not have its checksum, and is
    # done again.
    write(path, fixes, about | {"result": result.as_text()}, is_durable=False)
    about["fixes"] = checksum(path)
    write(file_of(settings.output, "seam", hour), seam, about, is_durable=False)
    return result
