"""The units of systemd/: systemd itself understands them, and they give away little."""

import re
import shutil
from pathlib import Path

import pytest
from conftest import BIN, finished

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "systemd"
UNITS = sorted((FOLDER / "units").iterdir())
SERVICES = [unit for unit in UNITS if unit.suffix == ".service"]
EXPOSURE_LIMIT = 1.9
# Those that cannot be confined, and why.
UNCONFINED = {"ols-station-restart.service": "installs packages"}
CONFINED = [service for service in SERVICES if service.name not in UNCONFINED]
needs_analyze = pytest.mark.skipif(
    shutil.which("systemd-analyze") is None, reason="systemd-analyze is not installed"
)


def instance(name: str) -> str:
    return name.replace("@.", "@ols-fusion.service." if "retry" in name else "@alfa.")


@pytest.fixture(name="units")
def fixture_units(tmp_path):
    """The units as installed, but for the programs, which need not be on this machine."""
    for unit in UNITS:
        text = re.sub(
            r"^(Exec\w+=)(ols-\S+|chronyc|ptp4l)", r"\1/bin/true", unit.read_text(), flags=re.M
        )
        (tmp_path / unit.name).write_text(text)
    return tmp_path


@needs_analyze
def test_systemd_understands_the_units(units):
    targets = [units / instance(unit.name) for unit in UNITS]
    for unit, target in zip(UNITS, targets, strict=True):
        (units / unit.name).rename(target)
    done = finished("systemd-analyze", "verify", "--man=no", "--recursive-errors=no", *targets)
    assert [line for line in done.stderr.splitlines() if "ols-" in line] == []


def test_the_bridges_queues_fit_into_its_memory():
    """Twice: the libraries need as much again around each message. The rest is its books'."""
    header = (ROOT / "bridge/memory_budget.h").read_text()
    queues = [int(n.replace("'", "")) for n in re.findall(r"QueueBytes = ([\d']+)", header)]
    unit = (FOLDER / "units/ols-bridge.service").read_text()
    most = int(re.search(r"^MemoryMax=(\d+)M$", unit, re.M)[1]) << 20
    assert len(queues) == 2 and 2 * sum(queues) <= 0.8 * most


@needs_analyze
def test_a_wrong_unit_is_found(units):
    unit = units / "ols-fusion.service"
    unit.write_text(unit.read_text() + "\nWatchdogSeconds=5\n")
    done = finished("systemd-analyze", "verify", "--man=no", "--recursive-errors=no", unit)
    assert "WatchdogSeconds" in done.stderr


@needs_analyze
def test_a_service_exposes_little():
    for service in CONFINED:
        limit = int(EXPOSURE_LIMIT * 10)
        done = finished(
            "systemd-analyze", "security", "--offline=yes", f"--threshold={limit}", service
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert "Overall exposure level" in done.stdout, service


def test_a_service_never_opens_packet_sockets():
    for service in CONFINED:
        text = service.read_text()
        families = re.findall(r"^RestrictAddressFamilies=(.*)$", text, flags=re.M)
        assert families and "AF_PACKET" not in " ".join(families), service
        capabilities = re.findall(r"^CapabilityBoundingSet=(.*)$", text, flags=re.M)
        assert capabilities and "CAP_NET_RAW" not in " ".join(capabilities), service


def test_a_program_is_watched_and_comes_back():
    for name, watchdog_s in {
        "ols-station@": 5,
        "ols-fusion": 5,
        "ols-console": 10,
        "ols-bridge": 10,
        "ols-cue": 10,
        "ols-export": 10,
        "ols-exporter": 10,
        "ols-logger": 30,
    }.items():
        text = (FOLDER / f"units/{name}.service").read_text()
        watchdog = f"WatchdogSec={watchdog_s}"
        for line in ("Type=notify", watchdog, "Restart=always", "OnFailure=ols-retry@%n.timer"):
            assert f"\n{line}\n" in text, f"{name}: {line}"
        assert "time-sync.target" not in text and "network-online.target" not in text, name


def allowed_calls(unit: Path) -> set[str]:
    """The system calls that are left by its filters, which apply in the order of their lines."""
    sets: dict[str, set[str]] = {}
    for line in finished("systemd-analyze", "syscall-filter").stdout.splitlines():
        if line.startswith("@"):
            members = sets.setdefault(line.strip(), set())
        elif line.startswith("    ") and not line.lstrip().startswith("#"):
            members.add(line.strip())

    def expanded(name: str) -> set[str]:
        if not name.startswith("@"):
            return {name}
        return set().union(*(expanded(member) for member in sets[name]))

    calls: set[str] = set()
    for line in re.findall(r"^SystemCallFilter=(.*)$", unit.read_text(), flags=re.M):
        names = set().union(*(expanded(name) for name in line.lstrip("~").split()))
        calls = calls - names if line.startswith("~") else calls | names
    return calls


@needs_analyze
def test_the_station_can_put_threads_behind_its_control_loop():
    """Else pictures and disks compete with the loop, and nobody is told."""
    source = (ROOT / "edge/device/behind_control_loop.cpp").read_text()
    calls = set(re.findall(r"(?<!\w)::(\w+)\(", source))
    assert "setpriority" in calls
    allowed = allowed_calls(FOLDER / "units/ols-station@.service")
    assert calls <= allowed
    assert not {"sched_setscheduler", "setrlimit", "mount", "ptrace"} & allowed


@needs_analyze
def test_the_clock_can_be_asked_by_the_station():
    """ProtectClock=, and a filter without these calls, would make every clock look bad."""
    text = (FOLDER / "units" / "ols-station@.service").read_text()
    assert "\nProtectClock=yes" not in text
    assert text.rindex("SystemCallFilter=adjtimex clock_adjtime") > text.rindex("~@privileged")


def test_the_kernel_knows_the_device_classes_before_the_station_starts():
    """A class of a module that is not loaded yet is ignored without a word."""
    by_module = {
        "char-ttyUSB": "usbserial",
        "char-ttyACM": "cdc_acm",
        "char-video4linux": "videodev",
    }
    always_there = {"char-ttyS", "char-gpiochip"}
    text = (FOLDER / "units" / "ols-station@.service").read_text()
    loaded = (FOLDER / "modules-load.d" / "ols.conf").read_text().split()
    classes = set(re.findall(r"^DeviceAllow=(\S+) rw$", text, flags=re.M))
    assert {by_module[c] for c in classes - always_there} <= set(loaded)


def test_udev_rules_are_well_formed():
    """udevadm of Debian 12 cannot verify rules: each is a list of key, operator, quoted value."""
    well_formed = re.compile(r'^(\w+(\{[^}]+\})?(==|!=|\+=|=)"[^"]*"(, |$))+$')
    for name in ("udev/61-ols.rules", "examples/61-ols-site.rules"):
        lines = [re.sub(r"^#(?=\w)", "", one) for one in (FOLDER / name).read_text().splitlines()]
        rules = [line for line in lines if line and not line.startswith("#")]
        assert len(rules) >= 3, name
        assert [rule for rule in rules if not well_formed.match(rule)] == []


def test_udev_rules_come_after_those_that_identify_the_adapter():
    """60-serial.rules imports ID_BUS and ID_SERIAL_SHORT; rules are read in the order of names."""
    for rules in [*FOLDER.glob("udev/*.rules"), *FOLDER.glob("examples/*.rules")]:
        assert rules.name > "60-serial.rules"


def test_a_stop_ends_the_retries_too():
    for unit in UNITS:
        lines = unit.read_text().splitlines()
        retried = "OnFailure=ols-retry@%n.timer" in lines
        assert retried == ("PropagatesStopTo=ols-retry@%n.timer" in lines), unit.name


@pytest.mark.skipif(shutil.which("systemd-sysusers") is None, reason="no systemd-sysusers")
def test_users_groups_and_folders_can_be_made(tmp_path):
    etc = tmp_path / "etc"
    etc.mkdir()
    done = finished("systemd-sysusers", f"--root={tmp_path}", FOLDER / "sysusers.d/ols.conf")
    assert done.returncode == 0, done.stderr
    groups = dict(line.split(":", 1) for line in (etc / "group").read_text().splitlines())
    assert groups["dialout"].endswith("ols") and groups["gpio"].endswith("ols")
    for line in (FOLDER / "tmpfiles.d/ols.conf").read_text().splitlines():
        if not line.startswith("#"):
            kind, path, mode, user, group = line.split()
            assert (kind, mode, user, group) == ("d", "0750", "ols", "ols"), path


def test_the_installed_tree_is_complete(tmp_path):
    build = BIN.parent
    if not (BIN / "ols-station").exists():
        pytest.skip(f"nothing is built in {build}")
    done = finished(
        *("cmake", "--install", build, "--prefix", "/usr"),
        env={"DESTDIR": str(tmp_path), "PATH": "/usr/bin:/bin"},
    )
    assert done.returncode == 0, done.stderr
    usr = tmp_path / "usr"
    for unit in UNITS:
        installed = usr / "lib/systemd/system" / unit.name
        assert installed.read_text() == unit.read_text()
        for program in re.findall(r"^Exec\w+=(ols-\S+)", unit.read_text(), flags=re.M):
            assert (usr / "bin" / program).exists(), f"{unit.name} runs {program}"
    for path in (
        "lib/sysusers.d/ols.conf",
        "lib/tmpfiles.d/ols.conf",
        "lib/modules-load.d/ols.conf",
        "lib/sysctl.d/60-ols.conf",
        "lib/udev/rules.d/61-ols.rules",
        "lib/systemd/catalog/ols.catalog",
        "share/doc/ols/docs/field-guide.md",
    ):
        assert (usr / path).exists(), path
    assert sorted(path.name for path in (usr / "bin").glob("ols-sim*")) == []
    for program in ("station", "fusion", "logger", "console", "export", "exporter", "bridge"):
        config = usr / "share/ols/examples" / f"{program}.toml"
        done = finished(usr / "bin" / f"ols-{program}", "--config", config, "--check-config")
        assert done.returncode == 0, done.stderr
