"""The same estimators over the whole archive at once, without hours, warm-ups or workers: what the
result of ols-batch is compared with."""

from dataclasses import dataclass
from pathlib import Path

import duckdb
import numpy as np
import ols
import pyarrow as pa
from ols_archive.partitions import file_of, hours_of, read
from ols_batch.task import NEEDED, bearings_of, objects_of

BATCH = """
SELECT f.utime, i.target, f.position_ecef_m AS p
FROM read_parquet('{output}/fixes/*/*/*/fixes.parquet', hive_partitioning = true) f
JOIN read_parquet('{output}/identities.parquet') i USING (region, day, hour, object)
"""
# An uncut object is the target near which it is at the most instants.
APART = "sqrt((u.p[1] - b.p[1])**2 + (u.p[2] - b.p[2])**2 + (u.p[3] - b.p[3])**2)"
SAME = f"""
SELECT u.object, b.target
FROM uncut u JOIN batch b USING (utime)
GROUP BY u.object, b.target HAVING avg({APART}) < 5.0
QUALIFY row_number() OVER (PARTITION BY u.object ORDER BY count(*) DESC, b.target) = 1
"""
COMPARED = f"""
SELECT count(*), count(u.utime), count(b.utime), count(*) FILTER (u.p = b.p),
       coalesce(max({APART}), 0)
FROM (SELECT uncut.*, target FROM uncut LEFT JOIN same USING (object) WHERE utime >= $from_us) u
FULL JOIN (SELECT * FROM batch WHERE utime >= $from_us) b USING (utime, target)
"""


@dataclass(frozen=True)
class Comparison:
    """Of the fixes after the first warm-up."""

    rows: int  # of either
    uncut: int
    batch: int
    identical: int  # to the last bit of the position
    greatest_m: float  # distance between two that belong together
    twice: int  # fixes of one target at one instant, beyond the first
    uncut_objects: int
    batch_targets: int

    @property
    def is_same(self) -> bool:
        return self.rows == self.uncut == self.batch and self.twice == 0


def uncut_fixes(archive: Path) -> pa.Table:
    """utime, object, p [m, ECEF]."""
    hours = hours_of(archive, "bearing")
    table = pa.concat_tables(
        [read(file_of(archive, "bearing", one), list(NEEDED)) for one in hours]
    )
    bearings = bearings_of(table)
    objects = objects_of(table, (0, 1 << 62))
    parts = []
    for number in np.unique(objects[objects > 0]).tolist():
        columns, _, _ = ols.fuse_columns(bearings, np.flatnonzero(objects == number))
        places = pa.FixedSizeListArray.from_arrays(columns["position_ecef_m"].ravel(), 3)
        count = len(columns["utime"])
        parts.append(pa.table({"utime": columns["utime"], "object": [number] * count, "p": places}))
    return pa.concat_tables(parts)


def compare(uncut: pa.Table, output: Path, from_us: int) -> Comparison:
    with duckdb.connect() as connection:
        connection.register("uncut", uncut)
        connection.execute(f"CREATE TABLE batch AS {BATCH.format(output=output)}")
        connection.execute(f"CREATE TABLE same AS {SAME}")
        rows = connection.execute(COMPARED, {"from_us": from_us}).fetchone()
        twice = connection.execute(
            "SELECT count(*) - count(DISTINCT (utime, target)) FROM batch"
        ).fetchone()[0]
        objects = connection.execute(
            "SELECT (SELECT count(DISTINCT object) FROM uncut), count(DISTINCT target) FROM batch"
        ).fetchone()
    return Comparison(*rows, twice, *objects)
