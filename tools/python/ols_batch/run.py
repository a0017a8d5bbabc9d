"""Tasks onto workers: Dask decides who does what, and does it again when a worker is gone."""

from __future__ import annotations

import contextlib
import functools
import os
import sys
import time
import uuid
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ols_archive.partitions import Damaged, Hour, locked, remove_partials

from ols_batch import identities
from ols_batch.plan import Plan, Settings, plan
from ols_batch.task import Result, estimate

if TYPE_CHECKING:
    from dask.distributed import Client, Future

# A worker can die of the machine, not of the task that it happens to have.
DASK = {
    "distributed.scheduler.allowed-failures": 10,
    "distributed.worker.daemon": True,
    "distributed.logging.distributed": "error",
    "distributed.worker.profile.enabled": False,  # nobody looks at it
    "distributed.scheduler.http.routes": [],  # no pages for whoever is on this machine
    "distributed.admin.system-monitor.gil.enabled": False,
}


@dataclass
class Report:
    """Of all hours asked for, those that an earlier run has done included."""

    done: int = 0
    skipped: int = 0
    failed: dict[str, str] = field(default_factory=dict)  # hour: why
    damaged: set[str] = field(default_factory=set)
    bearings: int = 0
    used: int = 0
    unused: Counter[str] = field(default_factory=Counter)
    unlocated: Counter[str] = field(default_factory=Counter)
    fixes: int = 0
    targets: int = 0
    beside: list[str] = field(default_factory=list)
    seconds: float = 0.0
    plots: list[str] = field(default_factory=list)

    def add(self, result: Result) -> None:
        self.bearings += result.bearings
        self.used += result.used
        self.fixes += result.fixes
        self.unused.update(result.unused)
        self.unlocated.update(result.unlocated)
        self.beside += [f"{result.hour}: {text}" for text in result.beside]
        self.damaged.update(result.damaged)

    def as_json(self) -> dict[str, Any]:
        return {
            **self.__dict__,
            "damaged": sorted(self.damaged),
            "unused": dict(sorted(self.unused.items())),
            "unlocated": dict(sorted(self.unlocated.items())),
            "failed": dict(sorted(self.failed.items())),
            "beside": sorted(self.beside),
        }


class Progress:
    """A bar on a terminal; elsewhere a line every few seconds."""

    WIDTH, LINES_S = 30, 5.0

    def __init__(self, tasks: int, skipped: int):
        self._tasks, self._skipped = tasks, skipped
        self._begin_s = self._said_s = time.monotonic()
        self._terminal = sys.stderr.isatty()

    def tell(self, done: int, failed: int) -> None:
        now_s = time.monotonic()
        is_last = done == self._tasks
        if not self._terminal and not is_last and now_s - self._said_s < self.LINES_S:
            return
        self._said_s = now_s
        left_s = (now_s - self._begin_s) / max(1, done) * (self._tasks - done)
        full = self.WIDTH * done // max(1, self._tasks)
        bar = f"[{'#' * full}{' ' * (self.WIDTH - full)}] " if self._terminal else ""
        text = f"ols-batch: {bar}{done} of {self._tasks} hours, {self._skipped} skipped"
        text += f", {failed} failed, {left_s:.0f} s left"
        ends = "\n" if is_last or not self._terminal else ""
        start = "\r\033[K" if self._terminal else ""
        print(start + text, file=sys.stderr, end=ends, flush=True)


@contextlib.contextmanager
def workers(count: int, scheduler: str | None) -> Iterator[Client]:
    """Those of a scheduler that runs elsewhere, or our own, whom only this process can reach."""
    import dask  # it takes a second, and most runs have nothing to do
    from dask.distributed import Client, LocalCluster

    dask.config.set(DASK)
    if scheduler is not None:
        with Client(scheduler) as client:
            yield client
        return
    with (
        LocalCluster(
            n_workers=count,
            threads_per_worker=1,
            host="127.0.0.1",
            protocol="tls://",
            security=True,
            dashboard_address="127.0.0.1:0",
        ) as cluster,
        Client(cluster) as client,
    ):
        yield client


Task = Callable[[Settings, Hour, str], Result]


def carry_out(task: Task, settings: Settings, hour: Hour, fingerprint: str) -> str:
    """In a worker. A text is sent much quicker than what it is made of."""
    return task(settings, hour, fingerprint).as_text()


def told_by(client: Client, futures: list[Future]) -> list[str | Exception]:
    """What each has told, or why it could not. All are asked for at once, which takes no longer
    than one; if any of them has failed, one after the other. Not from the files: this machine's
    view of what another one has written may be old."""
    with contextlib.suppress(Exception):
        return client.gather(futures)
    told: list[str | Exception] = []
    for future in futures:
        try:
            told.append(future.result())
        except Exception as error:
            told.append(error)
    return told


def note(report: Report, hour: Hour, told: str | Exception) -> None:
    if isinstance(told, str):
        report.add(Result.of_text(hour, told))
        report.done += 1
        return
    report.failed[str(hour)] = str(told) or type(told).__name__
    if isinstance(told, Damaged):
        report.damaged.add(str(told))


def run_tasks(client: Client, settings: Settings, to_do: list[tuple[Hour, str]], report: Report):
    """In the order of time, so that what an interrupted run has done is at the beginning."""
    from dask.distributed import as_completed

    progress = Progress(len(to_do), report.skipped)
    run_id = uuid.uuid4().hex  # a scheduler may have other runs, too
    # Tasks of one call are begun in the order of their keys.
    hour_of = {f"{run_id}-{number:08}": hour for number, (hour, _) in enumerate(to_do)}
    prints = [print_ for _, print_ in to_do]
    task = functools.partial(carry_out, estimate, settings)
    futures = client.map(task, list(hour_of.values()), prints, key=list(hour_of), pure=False)
    finished = 0
    for batch in as_completed(futures).batches():
        # What a worker had done when it was killed has been done again.
        for future, told in zip(batch, told_by(client, batch), strict=True):
            note(report, hour_of[future.key], told)
            future.release()
        finished += len(batch)
        progress.tell(finished, len(report.failed))


def run(
    settings: Settings,
    count: int | None = None,
    scheduler: str | None = None,
    region: str | None = None,
    span_us: tuple[int, int] = (0, 1 << 62),
    with_plots: bool = True,
) -> Report:
    """From the archive to fixes, identities and plots."""
    with locked(settings.output, wait=False):
        return run_locked(settings, count, scheduler, plan(settings, region, *span_us), with_plots)


def run_locked(
    settings: Settings, count: int | None, scheduler: str | None, planned: Plan, with_plots: bool
) -> Report:
    report, begin_s = Report(), time.monotonic()
    for hour, text in planned.done.items():
        report.add(Result.of_text(hour, text))
    report.skipped = len(planned.done)
    if planned.to_do:
        count = min(count or os.cpu_count() or 1, len(planned.to_do))
        with workers(count, scheduler) as client:
            run_tasks(client, settings, planned.to_do, report)
    remove_partials(settings.output)
    joined = identities.join(settings.output)
    report.targets = joined.targets
    report.damaged.update(joined.damaged)
    if with_plots and report.targets:
        from ols_batch import plots  # matplotlib takes half a second

        try:
            drawn = plots.draw(settings.output, joined.fixes, joined.made)
            report.plots = [str(path) for path in drawn]
        except Damaged as error:
            report.damaged.add(str(error))
    report.seconds = time.monotonic() - begin_s
    return report
