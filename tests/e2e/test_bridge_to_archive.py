"""ols-archive reads the region's stream from a real server, with the rights of the shipped example:
each message once, on from where it was, and the same as from a log."""

import json
import sys

import lcm
import ols_msg
import pytest
from bridge_site import Listener, Network, Watcher, bearing, needs_server, status, wait
from conftest import finished
from ols_archive.partitions import file_of, hours_of, read
from ols_demo.keys import members_of_environment

pytest.importorskip("nats", reason="needs requirements-archive.txt")
pytestmark = needs_server

SITE = '[archive]\nkeep = true\ndomain = "s"\n'
REGION = '[archive]\nkeep = true\nhours = 168.0\ndomain = "hub"\nsources = ["s"]\n'
STREAM = "OLS_r"


class Archived:
    """The region's stream, and what ols-archive makes of it."""

    def __init__(self, folder):
        self.net = Network(folder, region_tail=REGION, site_tail=SITE)
        self.net.site.until(lambda s: s["archive"]["kept"], "the site's stream")
        self.net.region.until(lambda s: s["archive"]["kept"], "the region's stream")
        self.site, self.watcher = Listener(self.net.site_url), Watcher(4222)
        self.folder, self.archive, self.sent = folder, folder / "archive", {}

    def say(self, channel, data):
        self.sent[channel, data] = None
        self.site.bus.publish(channel, data)

    def until_stored(self):
        def stored():
            info = self.watcher.request(f"$JS.hub.API.STREAM.INFO.{STREAM}", {})
            return info["state"]["messages"] >= len(self.sent)

        wait(stored, "all of it at the region", 60.0)

    def run(self, *words, code=0, seed="archive"):
        """The counts."""
        command = [sys.executable, "-m", "ols_archive", str(self.archive), "--region", "r"]
        command += ["--report", str(self.folder / "report.json"), *words]
        if not any(word.endswith(".lcmlog") for word in words):
            command += ["--server", "nats://127.0.0.1:4222", "--domain", "hub"]
            command += ["--seed", str(self.net.seeds[seed])]
        done = finished(*command)
        assert done.returncode == code, done.stderr
        self.said = done.stderr
        return json.loads((self.folder / "report.json").read_text())["counts"]

    def rows(self, kind):
        hours = hours_of(self.archive, kind)
        return [row for h in hours for row in read(file_of(self.archive, kind, h)).to_pylist()]

    def close(self):
        self.watcher.close()
        self.net.close()


@pytest.fixture
def archived(network, tmp_path):
    archived = Archived(tmp_path)
    yield archived
    archived.close()


def test_each_message_once_and_on_from_where_it_was(archived):
    signing = members_of_environment()
    for number in range(1, 41):
        data = bearing("alfa", number)
        archived.say("OLS_BEARING_alfa", signing.sign("OLS_BEARING_alfa", data))
    archived.say("OLS_STATUS_alfa", status("alfa", 1))
    archived.until_stored()
    assert archived.run("--stream", STREAM) == {"added": 41, "repeated": 0}
    rows = archived.rows("bearing")
    assert sorted(row["sequence"] for row in rows) == list(range(1, 41))
    assert {row["channel"] for row in rows} == {"OLS_BEARING_alfa"}
    assert all(len(row["signature"]) > 64 for row in rows)
    assert [row["signature"] for row in archived.rows("station_status")] == [None]
    assert all(abs(row["recorded_utime"] - row["utime"]) < 60_000_000 for row in rows)

    files = sorted(archived.archive.rglob("*.parquet"))
    before = [file.stat().st_mtime_ns for file in files]
    assert archived.run("--stream", STREAM) == {}, "nothing is new, and nothing is read"
    assert archived.run("--stream", STREAM, "--again") == {"added": 0, "repeated": 41}
    assert [file.stat().st_mtime_ns for file in files] == before

    archived.say("OLS_BEARING_alfa", bearing("alfa", 41))
    archived.until_stored()
    assert archived.run("--stream", STREAM) == {"added": 1, "repeated": 0}

    log = lcm.EventLog(str(archived.folder / "same.lcmlog"), "w", overwrite=True)
    for channel, data in archived.sent:
        log.write_event(ols_msg.bearing_t().utime, channel, data)
    log.close()
    again = archived.run(str(archived.folder / "same.lcmlog"))
    assert again == {"added": 0, "repeated": 42}, "it is the same as from a log"


def test_what_was_killed_before_it_knew_how_far_it_was_doubles_nothing(archived):
    archived.say("OLS_BEARING_alfa", bearing("alfa", 1))
    archived.until_stored()
    archived.run("--stream", STREAM)
    (position,) = (archived.archive / ".streams").iterdir()
    position.unlink()
    assert archived.run("--stream", STREAM) == {"added": 0, "repeated": 1}


def test_what_a_stream_has_let_go_of_is_said(archived):
    for number in (1, 2):
        archived.say("OLS_BEARING_alfa", bearing("alfa", number))
    archived.until_stored()
    archived.run("--stream", STREAM)
    for number in (3, 4, 5):
        archived.say("OLS_BEARING_alfa", bearing("alfa", number))
    archived.until_stored()
    purged = archived.watcher.request(f"$JS.hub.API.STREAM.PURGE.{STREAM}", {"keep": 1})
    assert purged["success"]
    assert archived.run("--stream", STREAM, code=1) == {"added": 1, "expired": 2, "repeated": 0}


def test_a_server_or_stream_that_is_none_is_named(archived):
    assert archived.run("--stream", "OLS_other", code=2) == {}
    assert "OLS_other" in archived.said and "Traceback" not in archived.said
    (archived.folder / "damaged.seed").write_text("SUXX\n")
    archived.net.seeds["damaged"] = archived.folder / "damaged.seed"
    assert archived.run("--stream", STREAM, code=2, seed="damaged") == {}
    assert "Traceback" not in archived.said
    archived.net.hub.stop()
    assert archived.run("--stream", STREAM, code=2) == {}
    assert "nats://127.0.0.1:4222" in archived.said and "Traceback" not in archived.said
    archived.net.hub.start()
    for bridge in (archived.net.site, archived.net.region):
        bridge.until(lambda s: s["link"]["open"], "the server is back", 60.0)
