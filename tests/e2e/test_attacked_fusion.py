"""A fusion that requires signatures makes no target of strangers' or recorded bearings."""

import time

import ols
import pytest
from conftest import BIN, wait
from ols_demo.bus import LIVE_URL
from ols_demo.keys import make_keys
from ols_demo.observer import Observer
from ols_demo.site import Site
from test_fusion_alone import CAMERAS, FusionAlone, bearing


class SignedStations(FusionAlone):
    """Each station signs its bearings; what was sent is remembered, as an eavesdropper would."""

    def __init__(self, keys):
        super().__init__()
        self.members = {name: ols.Trust(keys, name, 5) for name in CAMERAS}
        self.recording = []

    def publish(self, channel, data):
        station = channel.removeprefix("OLS_BEARING_")
        signed = self.members[station].sign(channel, data)
        self.recording.append((channel, signed))
        self.lcm.publish(channel, signed)

    def play(self, messages):
        for channel, data in messages:
            self.lcm.publish(channel, data)

    def expect_refused(self, reason, messages):
        """All are counted under this reason, and nothing comes of them."""
        name = f"bus_distrusted_{reason}"
        self.wait_for_status()
        before, targets, slews = self.count(name), self.observer.targets, self.slews
        self.play(messages)
        self.hear_until(lambda: self.count(name) >= before + len(messages), name)
        self.wait_for_status()
        assert self.count(name) == before + len(messages)
        assert (self.observer.targets, self.slews) == (targets, slews)

    def wait_for_status(self):
        before = self.observer.fusion
        self.hear_until(lambda: self.observer.fusion is not before, "a status of the fusion")

    def hear_until(self, condition, what):
        wait(condition, what, turn=lambda: self.lcm.handle_timeout(50))


@pytest.fixture
def fusion(network, tmp_path):
    keys = make_keys(BIN, tmp_path / "keys", CAMERAS)
    (tmp_path / "state").mkdir()
    environment = {**keys, "STATE_DIRECTORY": str(tmp_path / "state")}
    listener = SignedStations(keys["OLS_KEYS"])
    with Site(tmp_path / "logs") as site:
        command = [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL]

        def start():
            site.start_and_wait("fusion", command, "ready", environment)

        start()
        listener.site, listener.start = site, start
        yield listener
        site.check()


def test_neither_strangers_nor_recordings_make_a_target(fusion):
    fusion.feed_until(lambda: fusion.located() and fusion.slews > 3, "a target and slews")
    recording = list(fusion.recording)
    fusion.expect_refused("replayed", recording)
    now = time.time_ns() // 1000
    plain = [(f"OLS_BEARING_{s}", bearing(s, now + n).encode()) for s in CAMERAS for n in range(50)]
    fusion.expect_refused("unsigned", plain)
    invented = [(f"OLS_BEARING_x{n}", plain[0][1]) for n in range(100)]
    fusion.expect_refused("unsigned", invented)
    others = [
        (f"OLS_BEARING_{s}", fusion.members["a"].sign(f"OLS_BEARING_{s}", data))
        for s in ("b", "c")
        for _, data in plain[:20]
    ]
    fusion.expect_refused("channel", others)
    # What was heard outlasts a restart.
    assert fusion.site.stop("fusion") == 0
    fusion.observer = Observer()
    fusion.start()
    fusion.expect_refused("replayed", recording)
    assert not fusion.located()
    fusion.feed_until(lambda: fusion.located(), "a target of the live stations")
