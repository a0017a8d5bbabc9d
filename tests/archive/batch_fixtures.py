"""Fixtures of the tests of ols-batch: `pytest_plugins = ["batch_fixtures"]`."""

import dataclasses
import os
import shutil
from pathlib import Path

import pytest
from archive_site import archived, flown
from batch_site import here
from ols_batch import identities
from ols_batch.plan import Settings
from ols_demo.site import bring_up_loopback


@pytest.fixture(scope="module", name="archive")
def fixture_archive(tmp_path_factory) -> Path:
    """Nobody changes it."""
    return archived(tmp_path_factory.mktemp("site"), flown())


@pytest.fixture(scope="module", name="loopback")
def fixture_loopback() -> None:
    """Of the network namespace that the tests may be in: workers are reached over it."""
    if os.environ.get("OLS_NAMESPACE") == "1":
        bring_up_loopback([])


@pytest.fixture(scope="module", name="done")
def fixture_done(archive, tmp_path_factory) -> Settings:
    """A run without any trouble, tasks in the order of time, and its identities."""
    settings = Settings(archive, tmp_path_factory.mktemp("done"))
    here(settings)
    identities.join(settings.output)
    return settings


@pytest.fixture(name="own")
def fixture_own(done, tmp_path) -> Settings:
    """Archive and result that a test may change."""
    shutil.copytree(done.archive, tmp_path / "archive")
    shutil.copytree(done.output, tmp_path / "output")
    return dataclasses.replace(done, archive=tmp_path / "archive", output=tmp_path / "output")
