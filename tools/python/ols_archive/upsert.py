"""Messages into an hour's file, each once, whatever came before and however often."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa

from ols_archive.kinds import Kind, schema_of
from ols_archive.partitions import Damaged, Hour, file_of, named_if_damaged, read, write

KEYS = {"channel", "boot_id", "sequence", "utime", "digest"}


@dataclass
class Merged:
    added: int = 0
    repeated: int = 0
    contradictions: int = 0  # a known key with another content: the archived one stays
    damaged: str = ""  # the file that was there and could not be read, where it is now


def channel_ranks(table: pa.Table) -> np.ndarray:
    """Of each row, the place of its channel among all in the order of their names."""
    encoded = table["channel"].combine_chunks().dictionary_encode()
    names = encoded.dictionary.to_pylist()
    rank = np.empty(len(names), np.int64)
    rank[sorted(range(len(names)), key=names.__getitem__)] = np.arange(len(names))
    return rank[encoded.indices.to_numpy()] if len(table) else np.zeros(0, np.int64)


def numbers(table: pa.Table, name: str) -> np.ndarray:
    return table[name].to_numpy()


def merge(old: pa.Table, new: pa.Table) -> tuple[pa.Table, Merged]:
    """By channel (which names the station), boot id and sequence; the older row stays."""
    # A message of another version has other columns: what one does not have is null.
    both = pa.concat_tables([old, new], promote_options="default")
    is_new = np.arange(len(both)) >= len(old)
    keys = (numbers(both, "sequence"), numbers(both, "boot_id"), channel_ranks(both))
    order = np.lexsort((is_new, *keys))  # stable: of the new ones, the first that came
    starts = np.ones(len(both), bool)
    starts[1:] = np.any([key[order][1:] != key[order][:-1] for key in keys], axis=0)
    digests = numbers(both, "digest")[order]
    first = digests[np.flatnonzero(starts)][np.cumsum(starts) - 1]
    differs = int(np.count_nonzero(digests != first))
    kept = order[starts]
    merged = Merged(
        added=int(np.count_nonzero(is_new[kept])),
        repeated=int(np.count_nonzero(~starts)) - differs,
        contradictions=differs,
    )
    by_time = np.lexsort((*(key[kept] for key in keys), numbers(both, "utime")[kept]))
    return both.take(kept[by_time]), merged


def content_of(table: pa.Table) -> str:
    """Names what the table's messages are, whoever recorded them and when."""
    return hashlib.blake2b(numbers(table, "digest").tobytes(), digest_size=16).hexdigest()


def read_old(path: Path, kind: Kind) -> pa.Table:
    """Damaged also if rows of this kind cannot be added to it. It may have other columns, as those
    of another version, but in the columns that both have the same types."""
    old = read(path)
    with named_if_damaged(path):
        if missing := KEYS - set(old.column_names):
            raise ValueError(f"without {', '.join(sorted(missing))}")
        for name in sorted(KEYS):
            if old[name].null_count:
                raise ValueError(f"column {name} has rows without a value")
        for field in schema_of(kind):
            if field.name not in old.column_names:
                continue
            if (found := old.schema.field(field.name).type) != field.type:
                raise ValueError(f"column {field.name} has {found}, not {field.type}")
        pa.unify_schemas([old.schema, schema_of(kind)])
    return old


def upsert(root: Path, kind: Kind, hour: Hour, new: pa.Table) -> Merged:
    """With the archive locked. A file that cannot be read is kept beside the new one."""
    path = file_of(root, kind.name, hour)
    damaged = ""
    try:
        old = read_old(path, kind)
    except FileNotFoundError:
        old = schema_of(kind).empty_table()
    except Damaged:
        aside = path.with_name(f"{path.name}.damaged")
        path.rename(aside)
        damaged, old = str(aside), schema_of(kind).empty_table()
    table, merged = merge(old, new)
    merged.damaged = damaged
    if merged.added:
        about = {"kind": kind.name, "hour": str(hour), "content": content_of(table)}
        write(path, table, about)
    return merged
