"""What there is to do: the hours of an archive, and what an hour's result depends on."""

import functools
import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path

import ols
from ols_archive.partitions import HOUR_US, Damaged, Hour, file_of, hours_of, metadata

# A change of what a task computes or writes: results of the version before are made again.
REVISION = 2
AHEAD_US = 1_000_000


@dataclass(frozen=True)
class Settings:
    archive: Path
    output: Path
    warm_up_s: float = 1800.0  # biases need up to half an hour
    run_out_s: float = 30.0  # tracks that begin at the end, and duplicates, are decided later
    estimator: str = "filter"
    smooth: bool = False

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
    text = json.dumps([REVISION, ols.__version__, chosen, contents], sort_keys=True)
    return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


def told_by(settings: Settings, hour: Hour, wanted: str) -> str | None:
    """What the task said when it made just this result; None if it is to be done. Fixes are written
    last."""
    try:
        about = metadata(file_of(settings.output, "fixes", hour))
    except (FileNotFoundError, Damaged):
        return None
    return about.get("result") if about.get("fingerprint") == wanted else None


@dataclass
class Plan:
    to_do: list[tuple[Hour, str]]  # with their fingerprints
    done: dict[Hour, str]  # and what was told of them


def plan(settings: Settings, region: str | None, from_us: int, to_us: int) -> Plan:
    """In the order of region and time."""
    content.cache_clear()
    result = Plan([], {})
    for hour in hours_of(settings.archive, "bearing"):
        if region not in (None, hour.region) or not from_us <= hour.start_us < to_us:
            continue
        wanted = fingerprint(settings, hour)
        told = told_by(settings, hour, wanted)
        if told is None:
            result.to_do.append((hour, wanted))
        else:
            result.done[hour] = told
    return result
