"""What a station tells the system's journal: each event once, with its fields, and explained.

With the real journal, in a mount namespace of its own.
"""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import BIN, finished
from helpers import station_without_devices
from raised_alarms import table

JOURNALD = Path("/lib/systemd/systemd-journald")
IDS = {name: one["id"] for name, one in table.events().items()}
# The journal begins, the station runs until its alarm is there and ends, and what it said is kept.
RUN = r"""
set -eu
mount -t tmpfs none /run
mount -t tmpfs none /var/log
mount -t tmpfs none /var/lib/systemd/catalog
cp "$CATALOG" /run/ols.catalog
mount -t tmpfs none /usr/lib/systemd/catalog
cp /run/ols.catalog /usr/lib/systemd/catalog/
journalctl --update-catalog
"$JOURNALD" 2>"$OUT/journald.txt" &
journald=$!
trap 'kill $journald' EXIT
await() { timeout 30 sh -c 'until eval "$1"; do sleep 0.1; done' - "$1"; }
await '[ -S /run/systemd/journal/stdout ]'
# As systemd starts a service.
run='JOURNAL_STREAM=$(stat -L -c %d:%i /dev/stderr) exec "$STATION" --config "$CONFIG"'
systemd-cat sh -c "$run" &
station=$!
await "journalctl -q MESSAGE_ID=$ALARM OLS_STATION=lone | grep -q ."
kill $station
wait $station
journalctl --sync
journalctl -q -o json _PID=$station >"$OUT/entries.json"
journalctl -q -x _PID=$station >"$OUT/explained.txt"
"""


def can_have_a_journal():
    if not JOURNALD.exists() or shutil.which("systemd-cat") is None:
        return False
    mounts = "mount -t tmpfs none /run && mount -t tmpfs none /usr/lib/systemd/catalog"
    return subprocess.run(["unshare", "--mount", "sh", "-c", mounts], check=False).returncode == 0


@pytest.fixture(name="journal", scope="module")
def fixture_journal(unsigned, tmp_path_factory):
    """Its entries, and the text for a person."""
    if not can_have_a_journal():
        pytest.skip("no systemd-journald, or no right to mount")
    folder = tmp_path_factory.mktemp("journal")
    config = folder / "lone.toml"
    config.write_text(station_without_devices("lone"))
    catalogue = folder / "ols.catalog"
    catalogue.write_text(table.catalogue())
    environment = {
        "PATH": "/usr/bin:/bin",
        "CATALOG": str(catalogue),
        "JOURNALD": str(JOURNALD),
        "STATION": str(BIN / "ols-station"),
        "CONFIG": str(config),
        "ALARM": IDS["StationAlarmBegins"],
        "OUT": str(folder),
    }
    done = finished("unshare", "--mount", "bash", "-c", RUN, env=environment)
    assert done.returncode == 0, done.stderr
    entries = [json.loads(line) for line in (folder / "entries.json").read_text().splitlines()]
    return entries, (folder / "explained.txt").read_text()


def of_kind(journal, name):
    return [entry for entry in journal[0] if entry.get("MESSAGE_ID") == IDS[name]]


@pytest.mark.parametrize("kind", ["Ready", "StationAlarmBegins", "DeviceLost", "Stops"])
def test_an_event_has_its_kind_and_its_station(journal, kind):
    entries = of_kind(journal, kind)
    assert entries
    for entry in entries:
        assert entry["OLS_STATION"] == "lone"
        assert entry["SYSLOG_IDENTIFIER"] == "ols-station"


def test_a_lost_device_is_named_with_the_reason(journal):
    lost = {entry["OLS_DEVICE"]: entry for entry in of_kind(journal, "DeviceLost")}
    assert {"camera", "ptu"} <= set(lost)
    assert lost["ptu"]["OLS_REASON"] in lost["ptu"]["MESSAGE"]
    assert lost["ptu"]["PRIORITY"] == "4"


def test_nothing_is_written_twice(journal):
    """A line of the log would be an entry without a kind."""
    assert [entry["MESSAGE"] for entry in journal[0] if "MESSAGE_ID" not in entry] == []
    assert len(of_kind(journal, "Ready")) == len(of_kind(journal, "Stops")) == 1


def test_the_catalogue_explains_it_with_all_its_fields(journal):
    explained = journal[1]
    assert "Station lone: ptu does not work" in explained
    assert "docs/troubleshooting.md" in explained
    assert not re.search(r"@|OLS_[A-Z]", explained)
