"""Shared by all Python tests: where the built programs are, and the network they may use."""

import ctypes
import fcntl
import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from xdist.scheduler import LoadScopeScheduling

ROOT = Path(__file__).resolve().parents[1]
BIN = Path(os.environ.get("OLS_BIN", ROOT / "build/release/bin"))
SCENARIO = ROOT / "sim/scenarios/fig7.toml"
# A site as it was recorded before any message grew (lcmtypes/README.md).
GOLDEN_LOG = ROOT / "tests/golden/messages/site.lcmlog"
CLONE_NEWNET = 0x40000000  # linux/sched.h
SEED = 20240229


# Every station that a test runs or plays.
STATIONS = [
    "alfa",
    "bravo",
    "charlie",
    "delta",
    "overview",
    "a",
    "b",
    "c",
    "lone",
    "tool",
    "late",
]


# Modules in which simulated stations draw, track and steer in real time. Each needs most of a core,
# so no more of them run at once than this process has cores. They are dealt out to the cores in
# this order, the longest first, so that each core gets about as much; they run in another order.
REAL_TIME = [
    "test_two_ip_cameras.py",
    "test_onvif_station.py",
    "test_ipycam.py",
    "test_attacks.py",
    "test_calibrate_field.py",
    "test_faults.py",
    "test_mixed.py",
    "test_doctor.py",
    "test_console_thin_link.py",
    "test_console_station.py",
    "test_site.py",
    "test_rtsp.py",
    "test_setup.py",
    "test_logger.py",
    "test_sensors.py",
    "test_hardware_in_the_loop.py",
    "test_onvif.py",
    "test_video.py",
]


class Scheduling(LoadScopeScheduling):
    """A module is one worker's, because it has fixtures of its own. So are all modules in real
    time that share a core."""

    def _split_scope(self, nodeid: str) -> str:
        module = nodeid.split("::", 1)[0]
        name = module.rsplit("/", 1)[-1]
        if name not in REAL_TIME:
            return module
        return f"real time {REAL_TIME.index(name) % len(os.sched_getaffinity(0))}"


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadScopeScheduling:
    return Scheduling(config, log)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--all", action="store_true", help="those marked `night` too")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    items.sort(key=lambda item: item.path.name not in REAL_TIME)
    if config.getoption("--all"):
        return
    night = [item for item in items if item.get_closest_marker("night")]
    config.hook.pytest_deselected(items=night)
    items[:] = [item for item in items if not item.get_closest_marker("night")]


def pytest_configure(config: pytest.Config) -> None:
    """Each worker of pytest-xdist gets a network of its own, so that their sites do not meet."""
    if not hasattr(config, "workerinput") or os.environ.get("OLS_NAMESPACE") != "1":
        return
    if ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWNET) != 0:
        raise OSError(ctypes.get_errno(), "unshare: no network namespace for this worker")


def pytest_report_header():
    return f"oracle: random stations from seed {SEED}"


@pytest.fixture
def rng():
    return np.random.default_rng(SEED)


@pytest.fixture(scope="session")
def network(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Multicast on the loopback of a network namespace of our own, which tools/test makes. On it
    all programs require signatures, by throw-away keys."""
    if os.environ.get("OLS_NAMESPACE") != "1":
        pytest.skip("needs a network namespace of its own: run tools/test")
    from ols_demo.site import bring_up_loopback

    bring_up_loopback([f"127.0.0.{n}" for n in range(11, 15)])
    keys = tmp_path_factory.mktemp("keys") / "site"
    shutil.copytree(keys_of_this_run(tmp_path_factory.getbasetemp()), keys)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OLS_TRUST", "require")
        patch.setenv("OLS_KEYS", str(keys))
        yield


def keys_of_this_run(own: Path) -> Path:
    """Made by the worker that is first; two dozen programs run for them."""
    from ols_demo.keys import make_keys

    folder = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "keys-of-all"
    with open(folder.with_suffix(".lock"), "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.exists():
            make_keys(BIN, folder.with_suffix(".new"), STATIONS)
            folder.with_suffix(".new").rename(folder)
    return folder


@pytest.fixture(scope="module")
def unsigned(network: None) -> Iterator[None]:
    """Signatures off, for a module that tests what stands behind them: a message that no member
    would sign must reach it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OLS_TRUST", "off")
        yield


@pytest.fixture(scope="session")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Of two authorities: a certificate for localhost (console.pem, console.key, site-ca.pem)."""
    folders = {}
    for name in ("own", "foreign"):
        folders[name] = tmp_path_factory.mktemp(name)
        make = [str(ROOT / "systemd/ols-console-certificate"), str(folders[name]), "localhost"]
        subprocess.run(make, capture_output=True, check=True)
    return folders


@pytest.fixture(scope="session")
def shared() -> Path:
    """Evaluation data outside of the project, where OLS_SHARED names it."""
    folder = os.environ.get("OLS_SHARED")
    if not folder:
        pytest.skip("OLS_SHARED names no folder with evaluation data")
    return Path(folder)


def wait(
    condition: Callable,
    what: str,
    deadline_s: float = 60.0,
    turn: Callable = lambda: time.sleep(0.02),
) -> Any:
    """The condition's first true result; `turn` is what goes on meanwhile."""
    end = time.monotonic() + deadline_s
    while not (found := condition()):
        assert time.monotonic() < end, f"not within {deadline_s:.0f} s: {what}"
        turn()
    return found


def finished(*command: object, timeout: float = 600.0, **more: Any) -> subprocess.CompletedProcess:
    """A program after its end, with what it wrote as text, whatever its status is."""
    words = [str(word) for word in command]
    return subprocess.run(  # noqa: PLW1510 (`check` may be among the others)
        words, capture_output=True, text=True, timeout=timeout, **more
    )


def made(kind: type, age_s: float = 0.0, **fields: Any) -> Any:
    """A message of this schema and age, with these fields."""
    message = kind()
    message.utime = time.time_ns() // 1000 - int(age_s * 1e6)
    message.schema_version = message.SCHEMA_VERSION
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def lines_said(stderr: str) -> list[str]:
    """What a program of ours wrote. Where memory cannot be locked (containers), libgcrypt,
    which OpenCV's video input brings along, says so before main begins. On a slow machine a program
    says how far it is."""
    others = re.compile(r"Warning: using insecure memory!|ols-\S+: \d+ .* after \d+ s")
    return [line for line in stderr.splitlines() if not others.fullmatch(line)]
