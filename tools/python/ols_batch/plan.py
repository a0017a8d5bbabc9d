"""What there is to do: the hours of an archive, and what an hour's result depends on."""

import functools
import hashlib
import json
import zlib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from pathlib import Path

import ols
from ols_archive import kinds, message_types, partitions
from ols_archive.partitions import HOUR_US, Damaged, Hour, file_of, hours_of, metadata, read

AHEAD_US = 1_000_000


@functools.cache
def digest_of(path: str) -> str:
    return hashlib.blake2b(Path(path).read_bytes(), digest_size=16).hexdigest()


def program() -> str:
    """Names what computes and writes: a version does not change with each build."""
    modules = (ols._core, kinds, message_types, partitions)
    own = (str(Path(__file__).with_name(name)) for name in ("plan.py", "task.py"))
    parts = [*(module.__file__ for module in modules), *own]
    return " ".join(map(digest_of, parts))


@dataclass(frozen=True)
class Settings:
    archive: Path
    output: Path
    warm_up_s: float = 1800.0  # biases need up to half an hour
    run_out_s: float = 30.0  # tracks that begin at the end, and duplicates, are decided later
    estimator: str = "filter"
    smooth: bool = False
    program: str = field(default_factory=program)

    def inputs(self, hour: Hour) -> list[Hour]:
        """The hours whose bearings the task of an hour reads, with a file or without."""
        first = Hour.of(hour.region, self.first_us(hour))
        count = (self.last_us(hour) - 1 - first.start_us) // HOUR_US + 1
        return [first.next(i) for i in range(count)]

    def first_us(self, hour: Hour) -> int:
        return hour.start_us - round(self.warm_up_s * 1e6)

    def estimated_until_us(self, hour: Hour) -> int:
        """A filter's fix needs the bearings of 0.15 s after it; what uses later ones gets them."""
        looks_ahead = self.smooth or self.estimator != "filter"
        return (
            self.last_us(hour) if looks_ahead else min(self.last_us(hour), hour.end_us + AHEAD_US)
        )

    def last_us(self, hour: Hour) -> int:
        """Of what the task reads; not included."""
        return hour.end_us + round(self.run_out_s * 1e6)


@functools.cache
def content(path: Path) -> str:
    """Names what is in a file of the archive, by its end alone."""
    try:
        about = metadata(path)
    except FileNotFoundError:
        return "none"
    except Damaged:
        return "damaged"
    stat = path.stat()  # a file that is not the archiver's
    return about.get("content") or f"{stat.st_size} {stat.st_mtime_ns}"


def fingerprint(settings: Settings, hour: Hour) -> str:
    """Of all that the result of an hour depends on. Not of where archive and output are."""
    chosen = asdict(settings)
    del chosen["archive"], chosen["output"]
    contents = {
        str(one): content(file_of(settings.archive, "bearing", one))
        for one in settings.inputs(hour)
    }
    text = json.dumps([chosen, contents], sort_keys=True)
    return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


def checksum(path: Path) -> str:
    """Of all bytes: damage is to be found, not malice. Much quicker than reading the rows."""
    return f"{zlib.crc32(path.read_bytes()):08x}"


def told_by(settings: Settings, hour: Hour, wanted: str) -> str | None:
    """What the task said when it made just this result; None if it is to be done. The seam is
    written last, and has the checksum of the fixes; its own pages have theirs."""
    fixes, seam = (file_of(settings.output, kind, hour) for kind in ("fixes", "seam"))
    try:
        about, last = metadata(fixes), metadata(seam)
        if not about.get("fingerprint") == last.get("fingerprint") == wanted:
            return None
        if last.get("fixes") != checksum(fixes):
            return None
        read(seam)
    except (OSError, Damaged):
        return None
    return about.get("result")


@dataclass
class Plan:
    to_do: list[tuple[Hour, str]]  # with their fingerprints
    done: dict[Hour, str]  # and what was told of them


def plan(settings: Settings, region: str | None, from_us: int, to_us: int) -> Plan:
    """In the order of region and time."""
    content.cache_clear()
    result, chosen = Plan([], {}), []
    for hour in hours_of(settings.archive, "bearing"):
        if region not in (None, hour.region) or not from_us <= hour.start_us < to_us:
            continue
        chosen.append(hour)
    wanted = [fingerprint(settings, hour) for hour in chosen]
    # Both read and check without Python's lock.
    with ThreadPoolExecutor() as pool:
        told = pool.map(lambda one: told_by(settings, *one), zip(chosen, wanted, strict=True))
        for hour, print_, text in zip(chosen, wanted, told, strict=True):
            if text is None:
                result.to_do.append((hour, print_))
            else:
                result.done[hour] = text
    return result
