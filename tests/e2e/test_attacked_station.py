"""A station that requires signatures obeys no attacker, and counts each attack by reason."""

import os
import subprocess

import lcm
import ols
import ols_msg
import pytest
from conftest import BIN, finished, wait
from helpers import Listener, addressed, slew, station_without_devices
from ols_demo.bus import LIVE_URL, counters
from ols_demo.keys import make_keys
from ols_demo.site import Site

Ptu = ols_msg.ptu_command_t
MANY = 150  # below a member's rate, so that each has the reason that it deserves


class Attacked(Listener):
    """The station, its members' keys, and a bus on which anybody sends anything."""

    def __init__(self, keys, site):
        super().__init__()
        self.wire = lcm.LCM(LIVE_URL)
        self.site = site
        self.members = {n: ols.Trust(keys, n, 7) for n in ("operator", "fusion", "bravo")}
        self.sequence = 0
        self.wire.subscribe("OLS_STATUS_alfa", self._learn)

    def _learn(self, channel, data):
        for member in self.members.values():
            member.hear(channel, data)

    def learn_boot(self):
        """Until the members have heard a status, and can name the station's boot."""
        wait(lambda: self.wire.handle_timeout(200) > 0, "a status")

    def command(self, what):
        self.sequence += 1
        message = addressed(Ptu(), "alfa", self.sequence)
        message.command = what
        return message.encode()

    def distrusted(self, reason):
        return self.counter("alfa", f"bus_distrusted_{reason}")

    def expect_refused(self, reason, channel, messages):
        """All are counted under this reason, and the station stays as it is."""
        before = self.distrusted(reason)
        for data in messages:
            self.wire.publish(channel, data)
        self.wait_for_counter("alfa", f"bus_distrusted_{reason}", before + len(messages))
        self.wait_for_status("alfa")
        assert self.distrusted(reason) == before + len(messages)
        assert self.observer.state("alfa") == "stopped"
        accepted = {n: v for n, v in counters(self.observer.status["alfa"]).items() if v}
        assert not [name for name in accepted if name.endswith("_accepted")]


@pytest.fixture
def attacked(network, tmp_path):
    keys = make_keys(BIN, tmp_path / "keys", ["alfa", "bravo"])
    config = tmp_path / "alfa.toml"
    config.write_text(station_without_devices("alfa"))
    with Site(tmp_path / "logs") as site:
        station = [str(BIN / "ols-station"), "--config", str(config)]
        site.start_and_wait("station", station, "ready", keys)
        listener = Attacked(keys["OLS_KEYS"], site)
        listener.wait_for_status("alfa")
        listener.restart = lambda: (
            site.stop("station"),
            site.start_and_wait("station", station, "ready", keys),
        )
        yield listener


def test_no_attack_moves_a_station_and_each_is_counted(attacked):
    a = attacked
    release = [a.command(Ptu.COMMAND_RELEASE) for _ in range(MANY)]
    channel = "OLS_PTU_alfa"
    a.expect_refused("unsigned", channel, release)
    # Signed, but before the station's boot was known: it names none.
    early = [a.members["operator"].sign(channel, one) for one in release[:10]]
    before = a.counter("alfa", "messages_refused_other_boot")
    for data in early:
        a.wire.publish(channel, data)
    a.wait_for_counter("alfa", "messages_refused_other_boot", before + len(early))
    a.learn_boot()
    good = [a.members["operator"].sign(channel, one) for one in release]
    forged = [data[:-40] + bytes([data[-40] ^ 1]) + data[-39:] for data in good]
    a.expect_refused("stranger", channel, forged)
    a.expect_refused("stranger", "OLS_RECORD_alfa", good)  # moved to another channel
    other_role = [a.members["bravo"].sign(channel, one) for one in release]
    a.expect_refused("channel", channel, other_role)
    slews = [
        a.members["operator"].sign("OLS_SLEW_alfa", slew("alfa", n, 0.1).encode())
        for n in range(MANY)
    ]
    a.expect_refused("channel", "OLS_SLEW_alfa", slews)
    # A recording of good commands, played to the station's next boot.
    a.restart()
    a.wait_for_status("alfa")
    a.wait(lambda: a.distrusted("stranger") == 0, "the new boot's status")
    a.expect_refused("other_boot", channel, good)


def test_a_member_is_obeyed_once_and_a_revoked_one_no_more(attacked, tmp_path):
    a = attacked
    a.learn_boot()
    operator = a.members["operator"]
    free = operator.sign("OLS_PTU_alfa", a.command(Ptu.COMMAND_RELEASE))
    a.wire.publish("OLS_PTU_alfa", free)
    a.wait(lambda: a.observer.state("alfa") == "idle", "the release")
    # By hand, as a person does: it finds its key, hears the boot, and is obeyed.
    environment = {**os.environ, "OLS_TRUST": "require", "OLS_KEYS": str(tmp_path / "keys")}
    done = finished(BIN / "ols-ctl", "alfa", "stop", env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    a.wait(lambda: a.observer.state("alfa") == "stopped", "the stop")
    before = a.distrusted("replayed")
    a.wire.publish("OLS_PTU_alfa", free)
    a.wait_for_counter("alfa", "bus_distrusted_replayed", before + 1)
    assert a.observer.state("alfa") == "stopped"
    revoke = [str(BIN / "ols-key"), "revoke", "operator"]
    subprocess.run(revoke, cwd=tmp_path / "keys", check=True, capture_output=True, timeout=60)

    def refused():
        again = operator.sign("OLS_PTU_alfa", a.command(Ptu.COMMAND_STOP))
        a.wire.publish("OLS_PTU_alfa", again)
        return a.distrusted("revoked") > 0

    a.wait(refused, "the new list to be in force without a restart")
