"""Appends what each test took, with the set-up and tear-down around it, to the file OLS_TIMES_LOG.

A process that a test starts counts when it is waited for: one that serves a whole module counts in
the module's last test, one that serves the session in the session's last test."""

import os
import resource
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from ols_times.measure import append

LOG = Path(os.environ["OLS_TIMES_LOG"])


def processor_s() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


@contextmanager
def spending(name: str) -> Iterator[None]:
    wall, processor = time.monotonic(), processor_s()
    yield
    spent = {"processor_s": processor_s() - processor, "wall_s": time.monotonic() - wall}
    append(LOG, {"name": name, **spent})


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    with spending("(collection)"):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    with spending(item.nodeid):
        return (yield)
