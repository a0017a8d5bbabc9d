"""The streams of site and region over real servers of NATS: complete after the link was cut,
nothing twice, and never a command; and the site's own fusion meanwhile."""

import itertools
import os
import re
import time

import ols_msg
import pytest
from bridge_site import Listener, Network, Watcher, bearing, needs_server, slew, status, wait
from conftest import BIN
from ols_bench.fusion_load import Stations
from ols_demo.site import Site

pytestmark = needs_server

CUT_S = float(os.environ.get("OLS_CUT_S", "6"))
SITE = '[archive]\nkeep = true\ndomain = "s"\n'
REGION = '[archive]\nkeep = true\nhours = 168.0\ndomain = "hub"\nsources = ["s"]\n'


@pytest.fixture
def net(network, tmp_path):
    net = Network(tmp_path, region_tail=REGION, site_tail=SITE)
    net.site.until(lambda s: s["archive"]["kept"], "the site's stream")
    net.region.until(lambda s: s["archive"]["kept"], "the region's stream")
    yield net
    net.close()


def test_complete_after_a_cut_and_nothing_twice(net):
    site, region = Listener(net.site_url), Listener(net.region_url)
    numbers = itertools.count(1)
    sent = {}

    def say():
        number = next(numbers)
        for station in ("alfa", "bravo"):
            data = bearing(station, number)
            sent[f"{station}:7:{number}"] = data
            site.bus.publish(f"OLS_BEARING_{station}", data)
            if number % 20 > 0:  # of statuses more than 20 a second are refused
                continue
            state = status(station, number // 20)
            sent[f"{station}:7:{number // 20}:status"] = state
            site.bus.publish(f"OLS_STATUS_{station}", state)
        region.bus.publish("OLS_SLEW_alfa", slew("alfa", number))
        region.handle(5)

    def say_for(seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            say()
            time.sleep(0.05)

    wait(lambda: say() or region.on("OLS_BEARING_alfa"), "bearings at the region")
    say_for(1.0)
    net.link.cut()
    before = len(sent)
    say_for(CUT_S)
    cut = [data for name, data in [*sent.items()][before:] if re.fullmatch(r"alfa:7:\d+", name)]
    wait(lambda: cut[-1] in site.on("OLS_BEARING_alfa"), "the site goes on")
    assert not set(cut) & set(region.on("OLS_BEARING_alfa")), "the link was cut"
    net.link.mend()
    before = len(region.on("OLS_BEARING_alfa"))
    wait(lambda: say() or len(region.on("OLS_BEARING_alfa")) > before + 2, "live again")
    say_for(0.5)

    watcher = Watcher(4222)
    info = "$JS.hub.API.STREAM.INFO.OLS_r"
    wait(lambda: watcher.request(info, {})["state"]["messages"] >= len(sent), "all of them")
    stored = watcher.stored("hub", "OLS_r")
    names = [name for _, name, _ in stored]
    assert sorted(names) == sorted(sent), "each once"
    assert all(sent[name] == data for _, name, data in stored), "as it was, with its bytes"
    assert not any(".cmd." in subject for subject, _, _ in stored)
    leaf = Watcher(4223)
    assert sorted(name for _, name, _ in leaf.stored("s", "OLS_r_s")) == sorted(sent)
    for one, domain, stream in ((watcher, "hub", "OLS_r"), (leaf, "s", "OLS_r_s")):
        config = one.request(f"$JS.{domain}.API.STREAM.INFO.{stream}", {})["config"]
        assert not any("cmd" in subject or ">" in subject for subject in config.get("subjects", []))
        one.close()
    assert net.region.status()["missing"] > 0, "what was not live is counted"


def test_what_is_said_twice_is_stored_once(net):
    site = Listener(net.site_url)
    data = bearing("alfa", 5)
    for _ in range(20):
        site.bus.publish("OLS_BEARING_alfa", data)
    site.bus.publish("OLS_BEARING_alfa", bearing("alfa", 6))
    leaf = Watcher(4223)
    wait(lambda: len(leaf.stored("s", "OLS_r_s")) >= 2, "both")
    assert [name for _, name, _ in leaf.stored("s", "OLS_r_s")] == ["alfa:7:5", "alfa:7:6"]
    leaf.close()


def test_a_sites_own_targets_go_on_without_the_link(net, tmp_path, monkeypatch):
    monkeypatch.setenv("OLS_TRUST", "off")
    site = Listener(net.site_url)
    stations = Stations(3, 1, 1, site.bus)
    begin_s = time.time()

    def say():
        now_s = time.time()
        for channel, data in stations.encoded(now_s - begin_s, round(1e6 * now_s)):
            site.bus.publish(channel, data)
        site.handle(50)

    def targets():
        heard = [ols_msg.target_t.decode(data) for data in site.on("OLS_TARGET")]
        return [target for target in heard if target.solution == target.SOLUTION_OK]

    with Site(tmp_path) as processes:
        fusion = [str(BIN / "ols-fusion"), "--lcm-url", net.site_url]
        processes.start_and_wait("fusion", fusion, "ready")
        wait(lambda: say() or targets(), "a target")
        net.link.cut()
        cut_s = time.time()
        goes_on = lambda: targets()[-1].utime > 1e6 * (cut_s + CUT_S)  # noqa: E731
        wait(lambda: say() or goes_on(), "targets after the cut", CUT_S + 60.0)
        assert len({target.target_id for target in targets()}) == 1
        net.link.mend()
        assert processes.stop("fusion") == 0
