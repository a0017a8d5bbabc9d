"""A site's settings, signed at the centre, reach a station by the bus: it keeps them, works with
them from its next start on, and refuses what is older or nobody's."""

import time

import ols
import ols_msg
import pytest
from conftest import BIN, finished
from helpers import Listener, station_without_devices
from ols_demo.bus import LIVE_URL
from ols_demo.keys import make_keys
from ols_demo.site import Site


def run(*words, status=0):
    done = finished(BIN / "ols-key", *words)
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


class Tripod:
    """Station alfa, which has no file of the settings: it hears them."""

    def __init__(self, folder, site, listener):
        self.site, self.listener = site, listener
        self.logs, self.name = folder / "logs", "alfa"
        config = folder / "alfa.toml"
        own = 'state_folder = "{}"\nlcm_url = "{}"\n'.format(folder / "state", LIVE_URL)
        config.write_text(
            own + station_without_devices("alfa") + "[watchdog]\ncpu_alarm_degC = 81\n"
        )
        keys = folder / "tripod"
        keys.mkdir()
        for name in ("alfa.key", "trust.toml"):
            (keys / name).write_bytes((folder / "keys" / name).read_bytes())
            (keys / name).chmod(0o600)
        self.command = [str(BIN / "ols-station"), "--config", str(config)]
        self.keys = {"OLS_KEYS": str(keys)}

    def start(self, awaited="ready"):
        self.listener.observer.status.pop("alfa", None)
        self.site.start_and_wait(self.name, self.command, awaited, self.keys)
        self.listener.wait_for_status("alfa")

    def start_again(self, awaited="ready"):
        self.site.stop(self.name)
        self.name += "-again"
        self.start(awaited)

    def log(self):
        return (self.logs / f"{self.name}.log").read_text()

    def number(self):
        """Of the settings that it works with."""
        status = self.listener.observer.status.get("alfa")
        readings = (
            dict(zip(status.reading_name, status.reading_value, strict=True)) if status else {}
        )
        return readings.get("site_settings_number", 0)

    def wait_for_alarm(self, words):
        def says():
            status = self.listener.observer.status.get("alfa")
            return status is not None and any(words in alarm for alarm in status.alarm)

        self.listener.wait(says, f"{words!r} among the alarms")


WAIT = "are used after the station's next start"


@pytest.fixture
def tripod(site, tmp_path):
    tripod = Tripod(tmp_path, site, Listener())
    tripod.start()
    fusion = [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL]
    site.start_and_wait("fusion", fusion, "ready")
    return tripod


def test_settings_reach_the_stations_and_the_own_file_wins(site, tripod, tmp_path):
    centre = Centre(tmp_path)
    assert tripod.number() == 0
    assert "site settings 1" in centre.sign(
        "[station]\nwatchdog.cpu_alarm_degC = 70\nlogic.max_age_s = 0.5\n"
    )
    tripod.wait_for_alarm(WAIT)
    assert tripod.number() == 0, "nothing that comes over the network starts it anew"
    tripod.start_again("site settings 1 in use")
    assert tripod.number() == 1
    assert "this station's file says otherwise for watchdog.cpu_alarm_degC" in tripod.log()
    # What it has heard outlasts a start without the centre.
    site.stop("fusion")
    tripod.start_again("site settings 1 in use")
    site.check()


def test_older_changed_and_absurd_settings_are_named(site, tripod, tmp_path):
    centre = Centre(tmp_path)
    centre.sign("[station]\nlogic.max_age_s = 0.5\n")
    first = centre.made.read_bytes()
    assert "wanted.toml:2: station.logic.max_age_s" in centre.sign(
        "[station]\nlogic.max_age_s = 99\n", status=2
    )
    centre.sign("[station]\nlogic.max_age_s = 0.25\n")
    tripod.wait_for_alarm("settings 2 " + WAIT)
    member = ols.Trust(str(tmp_path / "keys"), "logger", 7)
    offers = ((first, "does not replace 2"), (first.replace(b"0.5", b"5.0"), "is not signed"))
    for sequence, (text, reason) in enumerate(offers, start=1):
        message = ols_msg.site_settings_t()
        message.schema_version, message.boot_id = message.SCHEMA_VERSION, 7
        message.utime = time.time_ns() // 1000
        message.sequence, message.text = sequence, text.decode()
        tripod.listener.bus.lcm.publish("OLS_SITE", member.sign("OLS_SITE", message.encode()))
        tripod.wait_for_alarm(reason)
    tripod.start_again("site settings 2 in use")
    site.check()
