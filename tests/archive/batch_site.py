"""Archives and results of batch runs, for the tests of ols-batch."""

from pathlib import Path

from archive_site import REGION
from ols_archive.partitions import Hour, file_of, read
from ols_batch.plan import Settings, plan
from ols_batch.task import estimate
from ols_bench import flights

ALL = (0, 1 << 62)


def hour(number: int) -> Hour:
    return Hour(REGION, flights.START_US).next(number)


def here(settings: Settings) -> list:
    """All tasks in this process, without workers."""
    return [estimate(settings, *one) for one in plan(settings, None, *ALL).to_do]


def results(output: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(output)): path.read_bytes()
        for path in sorted(output.rglob("*.parquet"))
    }


def fixes(output: Path, number: int) -> list[dict]:
    return read(file_of(output, "fixes", hour(number))).to_pylist()
