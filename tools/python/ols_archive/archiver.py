"""Collects messages by hour and passes them on to the files."""

import hashlib
from collections import Counter, defaultdict
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ols_archive.kinds import Kind, Unusable, decode, kind_of, table_of, values_of
from ols_archive.partitions import END_US, Hour, locked
from ols_archive.upsert import upsert

MOST_WAITING = 100_000  # messages in memory
MOST_NAMED = 20  # of each reason


@dataclass
class Tally:
    """What became of the messages. Counts only go up."""

    counts: Counter[str] = field(default_factory=Counter)
    named: dict[str, list[str]] = field(default_factory=dict)

    def count(self, reason: str, what: str = "", times: int = 1) -> None:
        """`what` names one case, for a person."""
        self.counts[reason] += times
        cases = self.named.setdefault(reason, []) if what else []
        if what and len(cases) < MOST_NAMED:
            cases.append(what)

    def report(self) -> dict[str, Any]:
        return {"counts": dict(sorted(self.counts.items())), "named": self.named}


# Something is wrong with what came in, or with the archive.
DAMAGE = (
    "undecodable",
    "other_station",
    "time_out_of_range",
    "garbage_bytes",
    "cut_off",
    "unreadable",
    "contradictions",
    "damaged_files",
    "expired",
)


def digest_of(payload: bytes, signature: bytes) -> int:
    whole = hashlib.blake2b(payload + signature, digest_size=8).digest()
    return int.from_bytes(whole, "big", signed=True)


class Archiver:
    """Takes messages in any order; flush() brings them into the files."""

    def __init__(self, root: Path, region: str, keep_signatures: bool = True):
        self.tally = Tally()
        self._root, self._region, self._keep_signatures = root, region, keep_signatures
        self._waiting: dict[tuple[Kind, Hour], list[tuple[Any, ...]]] = defaultdict(list)
        self.waiting = 0

    def take(
        self, recorded_us: int, channel: str, payload: bytes, signature: bytes, where: str
    ) -> None:
        """`where` names the message's source, for a person."""
        kind = kind_of(channel)
        if kind is None:
            self.tally.count("not_archived")  # pictures, and what only a simulation has
            return
        try:
            message = decode(kind, channel, payload)
            if not 0 <= message.utime < END_US:
                raise Unusable("time_out_of_range")
        except Unusable as why:
            self.tally.count(str(why), f"{where}: {channel}")
            return
        kept = (signature or None) if self._keep_signatures else None
        row = (channel, recorded_us, kept, digest_of(payload, signature), *values_of(message))
        self._waiting[kind, Hour.of(self._region, message.utime)].append(row)
        self.waiting += 1
        if self.waiting >= MOST_WAITING:
            self.flush()

    def flush(self) -> None:
        """An hour leaves the memory when it is in its file, so that an error loses nothing."""
        with locked(self._root):
            for kind, hour in sorted(self._waiting, key=lambda key: (key[0].name, key[1])):
                rows = self._waiting[kind, hour]
                merged = upsert(self._root, kind, hour, table_of(kind, rows))
                del self._waiting[kind, hour]
                self.waiting -= len(rows)
                what = f"{kind.name} of {hour}"
                self.tally.count("added", times=merged.added)
                self.tally.count("repeated", times=merged.repeated)
                if merged.contradictions:
                    self.tally.count("contradictions", what, merged.contradictions)
                if merged.damaged:
                    self.tally.count("damaged_files", f"set aside: {merged.damaged}")

    @property
    def found_damage(self) -> bool:
        return any(self.tally.counts[reason] for reason in DAMAGE)
