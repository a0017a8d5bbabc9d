"""ols-bridge between two buses over real servers of NATS, hub and leaf, with the permissions of
the shipped examples: bytes unchanged, no command late, no loop, a link that is cut and returns."""

import itertools
import re
import signal
import time

import pytest
from bridge_site import (
    Listener,
    Network,
    Other,
    Server,
    Watcher,
    bearing,
    needs_server,
    slew,
    status,
    target,
    wait,
)
from helpers import Babbler
from ols_demo.keys import members_of_environment

pytestmark = needs_server


@pytest.fixture
def net(network, tmp_path):
    net = Network(tmp_path)
    yield net
    net.close()


class Talk:
    """Says a message again and again until something is heard."""

    def __init__(self, net):
        self.site, self.region = Listener(net.site_url), Listener(net.region_url)
        self.numbers = itertools.count(1)
        self.members = members_of_environment()

    def station(self, name="alfa", age_s=0.0):
        """A signed bearing and a signed status; what was sent is returned."""
        number = next(self.numbers)
        sent = {}
        for channel, data in (
            (f"OLS_STATUS_{name}", status(name, number)),
            (f"OLS_BEARING_{name}", bearing(name, number, age_s=age_s)),
        ):
            sent[channel] = self.members.sign(channel, data)
            self.members.hear(channel, sent[channel])
            self.site.bus.publish(channel, sent[channel])
        return sent

    def until_through(self, name="alfa"):
        before = len(self.region.on(f"OLS_BEARING_{name}"))

        def look():
            self.station(name)
            return len(self.region.on(f"OLS_BEARING_{name}")) > before

        wait(look, f"bearings of {name} at the region")

    def slew(self, age_s=0.0, name="alfa"):
        channel = f"OLS_SLEW_{name}"
        data = self.members.sign(channel, slew(name, next(self.numbers), age_s))
        self.region.bus.publish(channel, data)
        return data


def test_bytes_pass_unchanged_both_ways(net):
    talk = Talk(net)
    talk.until_through()
    sent = talk.station()
    for channel, data in sent.items():
        wait(lambda c=channel, d=data: d in talk.region.on(c), f"{channel} as it was")
    said = talk.slew()
    wait(lambda: said in talk.site.on("OLS_SLEW_alfa"), "the slew as it was")
    # The signature is whole: 96 bytes at the end, and the fusion's key made it.
    assert said.endswith(b"OLST") and len(said) > 96
    assert net.region.status()["missing"] == 0


def test_what_a_station_may_not_say_the_servers_refuse(net):
    """The bridge of the site would pass charlie on; the server's permissions do not name it."""
    talk = Talk(net)
    talk.until_through()
    for _ in range(5):
        talk.station("charlie")
    talk.until_through("bravo")
    assert talk.region.on("OLS_BEARING_charlie") == []
    net.site.until(
        lambda s: [
            alarm
            for alarm in s["alarms"]
            if alarm["id"] == "bridge_refused" and "ols.v1.r.s.charlie" in alarm["text"]
        ],
        "it is said",
    )
    assert net.site.status()["link"]["refusals"] >= 1


def test_a_site_with_a_fusion_sends_its_targets(network, tmp_path):
    net = Network(tmp_path, site_head="targets = true\n")
    watcher = Watcher(4222, "ols.v1.r.target")
    try:
        site = Listener(net.site_url)
        numbers = itertools.count(1)
        wait(
            lambda: site.bus.publish("OLS_TARGET", target(next(numbers))) or watcher.heard,
            "its targets at the hub",
        )
    finally:
        watcher.close()
        net.close()


def test_nothing_comes_back_to_where_it_was_said(net):
    talk = Talk(net)
    talk.until_through()
    numbers = [talk.station() for _ in range(20)]
    last = numbers[-1]["OLS_BEARING_alfa"]
    wait(lambda: last in talk.region.on("OLS_BEARING_alfa"), "all of them")
    for data in (sent["OLS_BEARING_alfa"] for sent in numbers):
        assert talk.region.on("OLS_BEARING_alfa").count(data) == 1
        wait(lambda d=data: talk.site.on("OLS_BEARING_alfa").count(d) == 1, "once at the site")
    refused = net.site.status()["in"]["refused"]
    assert refused["own"] == refused["name"] == 0


def test_a_stale_command_is_refused_and_none_is_kept(net):
    talk = Talk(net)
    talk.until_through()
    old = talk.slew(age_s=5.0)
    wait(lambda: talk.slew() and talk.site.on("OLS_SLEW_alfa"), "fresh ones")
    assert old not in talk.site.on("OLS_SLEW_alfa")
    net.region.until(lambda s: s["out"]["refused"]["stale"] >= 1, "it is counted")
    # So is what is live and was held for long, by whatever buffer.
    held = talk.station(age_s=20.0)["OLS_BEARING_alfa"]
    net.region.until(lambda s: s["in"]["refused"]["stale"] == 1, "the bearing is counted")
    said = re.compile("bridge: late messages are dropped: alfa, 2. s").fullmatch
    net.region.until(lambda s: any(said(one["text"]) for one in s["alarms"]), "it is said")
    assert held not in talk.region.on("OLS_BEARING_alfa")
    # The link is gone: slews of that time are nobody's, also when it is back.
    net.leaf.signal(signal.SIGSTOP)
    held = [talk.slew() for _ in range(20)]
    end = time.monotonic() + 2.0  # older than command_age_s when the link is back
    while time.monotonic() < end:
        talk.site.handle()
    net.leaf.signal(signal.SIGCONT)

    fresh = []

    def through():
        talk.station()
        fresh.append(talk.slew())
        return set(fresh) & set(talk.site.on("OLS_SLEW_alfa"))

    wait(through, "slews pass again")
    heard = talk.site.on("OLS_SLEW_alfa")
    assert [data for data in held if data in heard] == []


def test_the_server_dies_and_the_bridge_comes_back(net):
    talk = Talk(net)
    talk.until_through()
    net.leaf.stop()
    net.site.until(lambda s: not s["link"]["open"], "the loss is seen")
    said = talk.station()
    wait(lambda: said["OLS_BEARING_alfa"] in talk.site.on("OLS_BEARING_alfa"), "the site goes on")
    assert any(alarm["id"] == "bridge_no_server" for alarm in net.site.status()["alarms"])
    net.leaf.start()
    talk.until_through()
    net.site.until(lambda s: s["link"]["open"] and s["link"]["openings"] >= 2, "it is back")
    state = net.site.status()
    assert state["link"]["losses"] >= 1 and state["link"]["unsent"] >= 1
    assert said["OLS_BEARING_alfa"] not in talk.region.on("OLS_BEARING_alfa"), "not queued"


def test_a_wrong_key_is_said_until_the_server_knows_it(net, tmp_path):
    """The library itself gives a server up that has refused a key twice."""
    key, seed = net.keys["archive"], net.seeds["archive"]
    nats = f'servers = ["nats://127.0.0.1:4223"]\nnkey = "{key}"\nseed = "{seed}"'
    bridge = Other(tmp_path, "wrong", nats)
    try:
        wait(lambda: bridge.says("no server: "), "the refusal is said")
        log = net.leaf.log
        wait(lambda: log.read_text().count("authentication error") >= 5, "it is tried anew")
        why = re.findall("tried anew: (.*)", bridge.log.read_text())
        assert why and all(one != next_one for one, next_one in itertools.pairwise(why)), why
        text = net.leaf.config.read_text()
        net.leaf.config.write_text(text.replace("users: [", f"users: [{{nkey: {key}}}\n"))
        net.leaf.signal(signal.SIGHUP)
        wait(lambda: bridge.status()["link"]["open"], "the key is known")
    finally:
        bridge.stop()


def test_over_tls_a_wrong_certificate_is_refused_and_said(network, tmp_path, certificates):
    own = certificates["own"]
    tls = f'tls {{ cert_file: "{own}/console.pem", key_file: "{own}/console.key" }}\n'
    server = Server(tmp_path, "nats-leaf.conf", lambda _: f'listen: "0.0.0.0:4225"\n{tls}')
    nats = 'servers = ["tls://{}:4225"]\nauthority = "{}/site-ca.pem"'
    bridges = {
        "right": Other(tmp_path, "right", nats.format("localhost", own)),
        "foreign": Other(tmp_path, "foreign", nats.format("localhost", certificates["foreign"])),
        "name": Other(tmp_path, "name", nats.format("127.0.0.2", own)),
    }
    try:
        right = bridges["right"]
        wait(lambda: right.status() and right.status()["link"]["open"], "TLS with the right one")
        for name in ("foreign", "name"):
            wait(lambda n=name: bridges[n].says("no server: "), f"{name} is said")
            assert not bridges[name].status()["link"]["openings"]
    finally:
        for bridge in bridges.values():
            bridge.stop()
        server.stop()


def test_a_server_that_sends_rubbish_is_said(network, tmp_path):
    """Before the log-in, in place of it, and long without an end."""
    for name, rubbish in (
        ("text", b"HTTP/1.1 400 Bad Request\r\n\r\n" * 100),
        ("zeroes", bytes(1 << 20)),
        ("info", b'INFO {"server_id":"x","max_payload":-1,"version":7}\r\nMSG a 1 -5\r\n\r\n' * 9),
        (
            "endless",
            b'INFO {"server_id":"x"}\r\nPONG\r\nMSG ols.v1.a.b.c.bearing 1 99999999999\r\n',
        ),
    ):
        babbler = Babbler(rubbish)
        bridge = Other(tmp_path, name, f'servers = ["nats://127.0.0.1:{babbler.port}"]')
        try:
            wait(lambda b=babbler: b.connections > 1, f"{name}: tried again")
            wait(lambda b=bridge: b.says("no server: "), f"{name} is said")
        finally:
            bridge.stop()
