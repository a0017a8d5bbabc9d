"""Two fusions that see the same target, on the real store of owners: one publishes it, a hand-over
at the border, a killed owner replaced, and a store that does not answer."""

import functools
import itertools
import math
import signal
import time

import ols
import ols_msg
import pytest
from bridge_site import (
    Bridge,
    Listener,
    Network,
    Watcher,
    bearing,
    bus_url,
    needs_server,
    slew,
    wait,
)
from conftest import made
from ols_demo.places import geodetic

pytestmark = needs_server

BORDER_DEG, LATITUDE_DEG, HEIGHT_M = 17.0, 49.5, 500.0
METRES_PER_DEGREE = 72216.0
WEST, EAST = (11, "[49.0, 16.0, 50.0, 17.0]"), (22, "[49.0, 17.0, 50.0, 18.0]")
OWNERS = '[ownership]\nshare = true\nname = "{}"\ndomain = "hub"\ncell_deg = {}\n'


def target(target_id, east_m, sequence, speed_m_s=0.0):
    message = made(ols_msg.target_t, boot_id=target_id, sequence=sequence, target_id=target_id)
    message.track_state = message.TRACK_CONFIRMED
    message.latitude_deg = LATITUDE_DEG
    message.longitude_deg = BORDER_DEG + east_m / METRES_PER_DEGREE
    message.height_m = HEIGHT_M
    place = geodetic(message.latitude_deg, message.longitude_deg, HEIGHT_M)
    message.position_ecef_m = list(ols.ecef_from_geodetic(place))
    east = math.radians(message.longitude_deg)
    message.velocity_ecef_m_s = [-speed_m_s * math.sin(east), speed_m_s * math.cos(east), 0.0]
    message.position_covariance_enu_m2 = [4.0, 0.0, 0.0, 4.0, 0.0, 4.0]
    return message.encode()


# Each turn looks at all that was heard until then.
decoded = functools.cache(ols_msg.target_t.decode)


def watcher_of_targets():
    return Watcher(4222, "ols.v1.*.target", "ols.v1.r.s.*.cmd.slew")


class Sky:
    """A target that flies, both fusions, and what receivers hear."""

    def __init__(self, folder):
        self.net = Network(folder, region_tail=OWNERS.format("west", WEST[1]))
        self.west, self.east = self.net.region, self.other_fusion()
        self.buses = [Listener(self.net.region_url), Listener(bus_url(7669))]
        self.watcher = watcher_of_targets()
        self.numbers, self.said_s, self.east_m = itertools.count(1), {}, -3000.0
        self.speed_m_s = 0.0

    def other_fusion(self):
        """Of the same region."""
        return Bridge(
            *(self.net.folder, "east", bus_url(7669)),
            *(self.net.seeds["region"], self.net.keys["region"]),
            port=4222,
            head='role = "region"\nregion = "r"\ntargets = true\n',
            tail=OWNERS.format("east", EAST[1]),
        )

    def say(self):
        number = next(self.numbers)
        self.said_s[number] = time.monotonic()
        for bus, (name, _) in zip(self.buses, (WEST, EAST), strict=True):
            bus.bus.publish("OLS_TARGET", target(name, self.east_m, number, self.speed_m_s))
            bus.bus.publish("OLS_SLEW_alfa", slew("alfa", number, target_id=name))
            bus.handle(10)

    def heard(self):
        """(when its fusion said it and when it was heard, of which fusion, region-wide id, epoch,
        confirmed) of each published target."""
        for at, subject, headers, data in list(self.watcher.heard):
            if subject.endswith(".target"):
                message = decoded(data)
                when, epoch = (self.said_s[message.sequence], at), int(headers["Ols-Epoch"])
                is_confirmed = "Ols-Unconfirmed" not in headers
                yield when, message.target_id, headers["Ols-Target"], epoch, is_confirmed

    def until(self, condition, what):
        wait(lambda: self.say() or ((heard := list(self.heard())) and condition(heard)), what)

    def begin(self):
        """Until both know whose it is: on a busy machine both may take it as new at first. Forgets
        what was heard until then; the region-wide id."""

        def is_known(heard):
            east = self.east.status()["ownership"]
            return heard[-1][1] == WEST[0] and east["owned"] == 0 < east["others"]

        self.until(is_known, "the owner whose region it is in")
        name = list(self.heard())[-1][2]
        self.watcher.heard.clear()
        return name

    def fly(self, to_m, speed_m_s=1500.0):
        """Its messages say how fast: one that was lost for a moment is known again where it is."""
        from_m, begun_s = self.east_m, time.monotonic()
        self.speed_m_s = math.copysign(speed_m_s, to_m - from_m)

        def is_there():
            self.say()
            self.east_m = from_m + self.speed_m_s * (time.monotonic() - begun_s)
            return (to_m - self.east_m) * self.speed_m_s <= 0

        wait(is_there, "the end of the flight")
        self.speed_m_s = 0.0

    def close(self):
        self.watcher.close()
        self.east.process.send_signal(signal.SIGCONT)
        assert self.east.stop() == 0
        self.net.close()


@pytest.fixture
def sky(network, tmp_path):
    sky = Sky(tmp_path)
    yield sky
    sky.close()


def never_two(heard):
    """An owner does not go on once a greater epoch was heard. What it has said before may be on its
    way for long: a receiver tells by the epoch."""
    begun_s = {}
    for (_, heard_s), _, _, epoch, _ in heard:
        begun_s.setdefault(epoch, heard_s)
    for (said_s, _), _, _, epoch, is_confirmed in heard:
        by = [other for other, at_s in begun_s.items() if other > epoch and at_s < said_s]
        assert not (by and is_confirmed), f"owner {epoch} goes on, replaced by {by}"


def test_one_publishes_and_hands_over_at_the_border(sky):
    name = sky.begin()
    sky.fly(3000.0)
    sky.until(lambda heard: heard[-1][1] == EAST[0], "the other one has it")
    sky.fly(-3000.0)
    sky.until(lambda heard: heard[-1][1] == WEST[0], "and back")
    heard = list(sky.heard())
    never_two(heard)
    assert {target for _, _, target, *_ in heard} == {name}, "the same target all the time"
    assert len({epoch for *_, epoch, _ in heard}) >= 3
    assert sky.west.status()["ownership"]["handed_over"] >= 1


def test_a_killed_owner_is_replaced_and_only_the_greatest_epoch_slews(sky):
    # The station is heard, so that slews know the way.
    site = Listener(sky.net.site_url)
    sky.begin()

    def slewed():
        site.bus.publish("OLS_BEARING_alfa", bearing("alfa", next(sky.numbers)))
        sky.say()
        return site.on("OLS_SLEW_alfa")

    wait(slewed, "slews of the owner")
    first = ols_msg.slew_t.decode(site.on("OLS_SLEW_alfa")[0]).target_id
    assert first == WEST[0]
    sky.west.process.kill()
    sky.west.process.wait()
    sky.until(lambda heard: heard[-1][1] == EAST[0], "the other one has it")

    def other():
        slewed()
        return ols_msg.slew_t.decode(site.on("OLS_SLEW_alfa")[-1]).target_id == EAST[0]

    wait(other, "slews of the new owner")
    heard = list(sky.heard())
    never_two(heard)
    assert len({name for _, _, name, *_ in heard}) == 1
    sky.west.start()  # the fusion is back, and the target stays with who has it


def test_a_store_that_does_not_answer_leaves_the_owner(sky):
    sky.begin()
    watcher = Watcher(4222)
    # JetStream is gone, the rest of the server is not.
    assert watcher.request("$JS.API.STREAM.DELETE.KV_OLS_OWNERS", {})["success"]
    sky.until(lambda heard: not heard[-1][4], "it goes on, marked")
    sky.fly(3000.0)
    assert {who for _, who, *_ in sky.heard()} == {WEST[0]}, "no hand-over"
    alarms = lambda: " ".join(one["text"] for one in sky.west.status()["alarms"])  # noqa: E731
    sky.until(lambda _: "does not answer" in alarms(), "it is said")
    watcher.close()


def test_a_target_changes_its_owner_after_the_hub_has_started_anew(sky):
    """What watched the store there before hears of nothing any more, and nobody says so."""
    name = sky.begin()
    sky.net.hub.stop()
    wait(lambda: sky.say() or not sky.west.status()["link"]["open"], "the loss is seen")
    sky.net.hub.start()
    sky.watcher.close()
    # A target that nobody tells of meanwhile is forgotten, and named anew.
    sky.watcher = wait(lambda: sky.say() or watcher_of_targets(), "the hub takes a client")
    sky.until(lambda heard: heard[-1][4], "an owner that is confirmed")
    sky.fly(3000.0)
    sky.until(lambda heard: heard[-1][1] == EAST[0], "the other one has it")
    sky.fly(-3000.0)
    sky.until(lambda heard: heard[-1][1] == WEST[0], "and back")
    heard = list(sky.heard())
    never_two(heard)
    assert {target for _, _, target, *_ in heard} == {name}


def test_a_server_that_forgets_who_watches_the_store_leaves_nobody_deaf(sky):
    sky.begin()

    def names():
        return sky.watcher.request("$JS.API.CONSUMER.NAMES.KV_OLS_OWNERS", {})["consumers"]

    sky.until(lambda _: len(names()) == 2, "both fusions watch")
    for name in names():
        sky.watcher.request(f"$JS.API.CONSUMER.DELETE.KV_OLS_OWNERS.{name}", {})
    sky.fly(3000.0)
    sky.until(lambda heard: heard[-1][1] == EAST[0], "the other one has it")
    heard = list(sky.heard())
    never_two(heard)
    assert len({target for _, _, target, *_ in heard}) == 1
