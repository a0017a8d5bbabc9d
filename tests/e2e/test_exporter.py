"""ols-exporter tells what the stations and the fusion have signed, and nothing of strangers."""

import re
import urllib.request

import lcm
import ols_msg
import pytest
from conftest import BIN, made
from helpers import Listener, station_without_devices
from ols_demo.bus import LIVE_URL
from ols_demo.site import Site

TOLD = re.compile(r"^(\w+)(?:\{(.*)\})? (\S+)$", re.MULTILINE)


@pytest.fixture
def exporter(network, tmp_path):
    """The address of its page, and the site that it runs in."""
    config = tmp_path / "exporter.toml"
    config.write_text(f'bridge_status = "{tmp_path / "bridge.json"}"\n')
    with Site(tmp_path / "logs") as site:
        command = [str(BIN / "ols-exporter"), "--config", str(config), "--lcm-url", LIVE_URL]
        command += ["--address", "127.0.0.1:19316"]
        site.start_and_wait("exporter", command, "ready")
        yield "http://127.0.0.1:19316/metrics", site
        site.check()


def samples(address):
    with urllib.request.urlopen(address, timeout=60) as page:
        text = page.read().decode()
    return {(name, labels): float(value) for name, labels, value in TOLD.findall(text)}


def test_the_statuses_of_the_site_are_told(exporter, tmp_path):
    address, site = exporter
    config = tmp_path / "alfa.toml"
    config.write_text(station_without_devices("alfa"))
    site.start_and_wait("alfa", [str(BIN / "ols-station"), "--config", str(config)], "ready")
    site.start_and_wait("fusion", [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL], "ready")
    listener = Listener()
    listener.wait_for_status("alfa")
    told = {}

    def is_told():
        told.update(samples(address))
        return ("ols_station_status_age_seconds", 'station="alfa"') in told and (
            "ols_fusion_status_age_seconds",
            "",
        ) in told

    listener.wait(is_told, "the station and the fusion")
    assert told["ols_station_device_up", 'station="alfa",device="camera"'] == 0.0
    versions = [labels for name, labels in told if name == "ols_station_build_info"]
    assert len(versions) == 1 and re.fullmatch(r'station="alfa",version="\d+\.\d+.*"', versions[0])
    assert 0.0 <= told["ols_station_status_age_seconds", 'station="alfa"'] < 20.0
    assert told["ols_station_reading", 'station="alfa",reading="disk_free_bytes"'] > 0.0
    assert told["ols_station_enrolled", 'station="bravo"'] == 1.0, "though it is not there"
    assert ("ols_station_status_age_seconds", 'station="bravo"') not in told


def test_strangers_are_counted_and_not_told(exporter):
    address, _ = exporter
    status = made(ols_msg.station_status_t, station="bravo")
    wire, listener = lcm.LCM(LIVE_URL), Listener()
    for _ in range(20):
        wire.publish("OLS_STATUS_bravo", status.encode())
    reason = ("ols_bus_distrusted_total", 'reason="unsigned"')
    listener.wait(lambda: samples(address).get(reason, 0.0) >= 20.0, "that they are counted")
    names = {name for name, labels in samples(address) if "bravo" in labels}
    assert names == {"ols_station_enrolled"}


def test_the_bridge_is_told_by_its_status(exporter, tmp_path):
    address, site = exporter
    assert samples(address)["ols_bridge_up", ""] == 0.0
    config = tmp_path / "bridge.toml"
    config.write_text(
        f'lcm_url = "{LIVE_URL}"\nstatus_file = "{tmp_path / "bridge.json"}"\n'
        '[nats]\nservers = ["nats://127.0.0.1:1"]\n'
    )
    site.start_and_wait("bridge", [str(BIN / "ols-bridge"), "--config", str(config)], "ready")
    Listener().wait(lambda: samples(address)["ols_bridge_up", ""] == 1.0, "the bridge")
    told = samples(address)
    assert told["ols_bridge_link_up", ""] == 0.0
    assert any(name == "ols_alarm" and "bridge_no_server" in labels for name, labels in told)
    assert told["ols_bridge_refused_total", 'direction="out",reason="stale"'] == 0.0
