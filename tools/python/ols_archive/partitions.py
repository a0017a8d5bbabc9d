"""Hourly Parquet files: their names, how they are read, and how they are replaced as a whole."""

import contextlib
import fcntl
import os
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

HOUR_US = 3_600_000_000
END_US = 7_258_118_400_000_000  # the year 2200: no clock of a station is beyond it
REGION = re.compile(r"[a-z0-9][a-z0-9-]{0,62}")
FOLDER = re.compile(r"region=([^/]+)/day=(\d{4}-\d\d-\d\d)/hour=(\d{1,2})$")
ROW_GROUP = 32_768  # rows: a warm-up reads only the groups that it needs


class Damaged(Exception):
    """A Parquet file that cannot be read; the text names it."""


@dataclass(frozen=True, order=True)
class Hour:
    """An hour of a region."""

    region: str
    start_us: int  # UTC since 1970, a whole hour

    @classmethod
    def of(cls, region: str, utime_us: int) -> "Hour":
        return cls(region, utime_us // HOUR_US * HOUR_US)

    @classmethod
    def of_folder(cls, folder: Path) -> "Hour | None":
        """By the end of a path, as in .../region=brno/day=2026-06-01/hour=13."""
        found = FOLDER.search(folder.as_posix())
        if found is None:
            return None
        try:
            start = datetime.fromisoformat(f"{found[2]}T{found[3]:0>2}:00:00+00:00")
        except ValueError:
            return None
        return cls(found[1], int(start.timestamp()) * 1_000_000)

    @property
    def end_us(self) -> int:
        return self.start_us + HOUR_US

    def next(self, hours: int = 1) -> "Hour":
        return Hour(self.region, self.start_us + hours * HOUR_US)

    @property
    def day(self) -> str:
        return f"{self._start:%Y-%m-%d}"

    @property
    def hour(self) -> int:
        return self._start.hour

    @property
    def _start(self) -> datetime:
        return datetime.fromtimestamp(self.start_us // 1_000_000, UTC)

    def folder(self) -> Path:
        return Path(f"region={self.region}/day={self.day}/hour={self.hour}")

    def __str__(self) -> str:
        return f"{self.region} {self._start:%Y-%m-%dT%H}"


def file_of(root: Path, kind: str, hour: Hour) -> Path:
    """The file of a kind of rows in an hour."""
    return root / kind / hour.folder() / f"{kind}.parquet"


def hours_of(root: Path, kind: str) -> list[Hour]:
    """Those that have a file, in order of region and time."""
    found = (
        Hour.of_folder(path.parent)
        for path in (root / kind).glob(f"region=*/day=*/hour=*/{kind}.parquet")
    )
    return sorted(hour for hour in found if hour is not None)


@contextlib.contextmanager
def named_if_damaged(path: Path) -> Iterator[None]:
    try:
        yield
    except (FileNotFoundError, Damaged):
        raise
    except (pa.ArrowException, OSError, LookupError, TypeError, ValueError) as error:
        why = (str(error).splitlines() or ["unreadable"])[0]
        raise Damaged(f"{path}: {why}") from None


def read(
    path: Path,
    columns: list[str] | None = None,
    utime_us: tuple[int, int] | None = None,
    schema: pa.Schema | None = None,
    later: Collection[str] = (),
) -> pa.Table:
    """Damaged if anything of what is read is not as it was written, or, with a schema, not of its
    columns and types. utime_us: only the rows from the first instant up to the second one. later:
    columns that a file may lack; they are zero."""
    if schema is None:
        return read_rows(path, columns, utime_us)
    with named_if_damaged(path):
        table = read_rows(path, schema.names, utime_us)
        for name in schema.names:
            if name in later and name not in table.column_names:
                table = table.append_column(name, pa.array(np.zeros(len(table))))
            if name not in table.column_names:
                raise ValueError(f"no column {name}")
            if table[name].null_count:
                raise ValueError(f"column {name} has rows without a value")
        return table.select(schema.names).cast(schema)


def read_rows(path: Path, columns: list[str] | None, utime_us: tuple[int, int] | None) -> pa.Table:
    # Not pyarrow's datasets: they take longer to begin than an hour takes to read.
    with named_if_damaged(path), pq.ParquetFile(path, page_checksum_verification=True) as file:
        groups = range(file.num_row_groups)
        if utime_us is None:
            return file.read_row_groups(groups, columns, use_threads=False)
        groups = [one for one in groups if overlaps(file.metadata.row_group(one), utime_us)]
        table = file.read_row_groups(groups, columns, use_threads=False)
        if "utime" not in table.column_names:
            raise ValueError("no column utime")
        times = table["utime"].to_numpy()
        # In order of time, as all files of the archive.
        first, last = times.searchsorted(utime_us)
        return table.slice(first, last - first)


def overlaps(group: pq.RowGroupMetaData, utime_us: tuple[int, int]) -> bool:
    """By the statistics of the column utime, where there are any."""
    for index in range(group.num_columns):
        column = group.column(index)
        if (
            column.path_in_schema == "utime"
            and column.is_stats_set
            and column.statistics.has_min_max
        ):
            known = column.statistics
            return known.min < utime_us[1] and known.max >= utime_us[0]
    return True


def metadata(path: Path, *needed: str, schema: pa.Schema | None = None) -> dict[str, str]:
    """What write() was given; Damaged without one of what is needed, or with another schema."""
    with named_if_damaged(path):
        footer = pq.read_metadata(path)
        if schema is not None and not footer.schema.to_arrow_schema().equals(schema):
            raise ValueError("other columns than this program's")
        pairs = footer.metadata or {}
        about = {
            key.decode().removeprefix("ols."): value.decode()
            for key, value in pairs.items()
            if key.startswith(b"ols.")
        }
        for name in needed:
            if name not in about:
                raise ValueError(f"no entry ols.{name}: it is not of this program")
        return about


def number_leaves(schema: pa.Schema) -> list[str]:
    """Parquet's paths of the numbers in it, also of those in lists: split by bytes they take less
    room and less time."""
    found = []
    for one in schema:
        name, kind = one.name, one.type
        while pa.types.is_list(kind) or pa.types.is_fixed_size_list(kind):
            name, kind = f"{name}.list.element", kind.value_type
        if kind in (pa.float64(), pa.float32(), pa.int64(), pa.int32()):
            found.append(name)
    return found


def write(path: Path, table: pa.Table, about: dict[str, str], is_durable: bool = True) -> None:
    """Whole or not at all: readers see the file as it was before, or as it is now. is_durable:
    whatever happens to the power."""
    path.parent.mkdir(parents=True, exist_ok=True)
    metadata = {f"ols.{name}": text for name, text in about.items()}  # and nothing from before
    with replaced(path, is_durable) as partial:
        pq.write_table(
            table.replace_schema_metadata(metadata),
            partial,
            compression="lz4",  # of numbers split by bytes: as small as zstd, and quicker
            use_dictionary=[one.name for one in table.schema if one.type == pa.string()],
            use_byte_stream_split=number_leaves(table.schema),
            row_group_size=ROW_GROUP,
            write_page_checksum=True,
        )


@contextlib.contextmanager
def replaced(path: Path, is_durable: bool = True) -> Iterator[Path]:
    """A file beside `path` to write to. It becomes `path` when all of it is written; is_durable: is
    on the disk."""
    partial = path.with_name(f"{path.name}.{os.getpid()}.partial")
    try:
        yield partial
        if is_durable:
            with partial.open("rb+") as file:
                os.fsync(file.fileno())
        partial.rename(path)
    finally:
        partial.unlink(missing_ok=True)
    if not is_durable:
        return
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


def remove_partials(root: Path) -> None:
    """What killed processes have left behind; only while nobody else writes there."""
    for partial in root.rglob("*.partial"):
        partial.unlink(missing_ok=True)


@contextlib.contextmanager
def locked(root: Path, wait: bool = True) -> Iterator[None]:
    """One writer at a time. The lock ends with its process, however that ends. BlockingIOError if
    another one has it and we do not wait."""
    root.mkdir(parents=True, exist_ok=True)
    with (root / ".lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
        except BlockingIOError:
            raise BlockingIOError(f"{root}: another process writes there") from None
        yield
