"""A site's settings, signed at the centre, reach a station by the bus: it keeps them, works with
them from its next start on, and refuses what is older or nobody's."""

import subprocess
import time

import ols
import ols_msg
import pytest
from conftest import BIN
from helpers import Listener, station_without_devices
from ols_demo.bus import LIVE_URL
from ols_demo.keys import make_keys
from ols_demo.site import Site


def run(*words, status=0):
    done = subprocess.run(
        [str(BIN / "ols-key"), *map(str, words)], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture
def site(network, tmp_path, monkeypatch):
    keys = make_keys(BIN, tmp_path / "keys", ["alfa"])
    for name, value in keys.items():
        monkeypatch.setenv(name, value)
    (tmp_path / "state").mkdir()
    with Site(tmp_path / "logs") as running:
        yield running


class Centre:
    """The one who signs, with the stick of the root. The fusion reads site.toml in its keys."""

    def __init__(self, folder):
        self.folder = folder
        self.made = folder / "keys" / "site.toml"

    def sign(self, text, status=0):
        wanted = self.folder / "wanted.toml"
        wanted.write_text(text)
        root = self.folder / "keys" / "root.key"
        return run("settings", wanted, "--root", root, "--output", self.made, status=status)


def test_settings_reach_the_stations_and_the_own_file_wins(site, tmp_path, monkeypatch):
    centre, listener = Centre(tmp_path), Listener()
    config = tmp_path / "alfa.toml"
    own = 'state_folder = "{}"\nlcm_url = "{}"\n'.format(tmp_path / "state", LIVE_URL)
    config.write_text(own + station_without_devices("alfa") + "[watchdog]\ncpu_alarm_degC = 81\n")
    # The station hears: it has no file of the settings.
    alone = tmp_path / "tripod"
    alone.mkdir()
    for name in ("alfa.key", "trust.toml"):
        (alone / name).write_bytes((tmp_path / "keys" / name).read_bytes())
        (alone / name).chmod(0o600)
    command = [str(BIN / "ols-station"), "--config", str(config)]
    tripod = {"OLS_KEYS": str(alone)}
    site.start_and_wait("alfa", command, "ready", tripod)
    site.start_and_wait("fusion", [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL], "ready")

    def number():
        status = listener.observer.status.get("alfa")
        readings = (
            dict(zip(status.reading_name, status.reading_value, strict=True)) if status else {}
        )
        return readings.get("site_settings_number", 0)

    def says(words):
        status = listener.observer.status.get("alfa")
        return status is not None and any(words in alarm for alarm in status.alarm)

    def again(name):
        listener.wait(lambda: says("wait until the station is started again"), "that they wait")
        site.stop(name)
        listener.observer.status.pop("alfa", None)
        site.start_and_wait(f"{name}-again", command, "ready", tripod)
        listener.wait_for_status("alfa")
        return f"{name}-again"

    listener.wait_for_status("alfa")
    assert number() == 0
    assert "site settings 1" in centre.sign(
        "[station]\nwatchdog.cpu_alarm_degC = 70\nlogic.max_age_s = 0.5\n"
    )
    running = again("alfa")
    listener.wait(lambda: number() == 1, "that they are used")
    assert (
        "this station's file says otherwise for watchdog.cpu_alarm_degC"
        in (tmp_path / "logs" / f"{running}.log").read_text()
    )
    assert "wanted.toml:2: station.logic.max_age_s" in centre.sign(
        "[station]\nlogic.max_age_s = 99\n", status=2
    )
    first = centre.made.read_bytes()
    centre.sign("[station]\nlogic.max_age_s = 0.25\n")
    running = again(running)
    listener.wait(lambda: number() == 2, "that newer ones are used")
    # An older one, told by a member, and one that is changed: both are named, nothing happens.
    member = ols.Trust(str(tmp_path / "keys"), "logger", 7)
    for sequence, (text, reason) in enumerate(
        ((first, "does not replace 2"), (first.replace(b"0.5", b"5.0"), "is not signed")), start=1
    ):
        message = ols_msg.site_settings_t()
        message.schema_version, message.boot_id = message.SCHEMA_VERSION, 7
        message.utime = time.time_ns() // 1000
        message.sequence, message.text = sequence, text.decode()

        listener.bus.lcm.publish("OLS_SITE", member.sign("OLS_SITE", message.encode()))
        listener.wait(lambda words=reason: says(words), f"{reason!r} among the alarms")
    assert number() == 2
    # What it has heard outlasts a restart without the centre.
    site.stop("fusion")
    site.stop(running)
    site.start_and_wait("at-last", command, "site settings 2 in use", tripod)
    site.check()
