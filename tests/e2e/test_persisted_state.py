"""A station whose persisted state is missing or damaged starts stopped and raises an alarm."""

import os
import shutil
import signal
import time

import ols_msg
import pytest
from conftest import BIN
from helpers import Listener, StopSwitch, addressed, slew, station_without_devices
from ols_demo.site import Site

CONFIG = f"""\
state_folder = "{{folder}}/state"
{station_without_devices("kept")}
[gpio]
chip = "socket:{{folder}}/gpio"
stop_line = 17
"""
STATUS, PTU = ols_msg.station_status_t, ols_msg.ptu_command_t
NOT_KNOWN = "stop: state before the restart is unknown"


class Kept(Listener):
    def __init__(self, site, folder):
        super().__init__()
        self.site, self.folder = site, folder
        self.state_folder = folder / "state"
        self.state_folder.mkdir()
        self.switch = StopSwitch(folder / "gpio")
        (folder / "kept.toml").write_text(CONFIG.format(folder=folder))

    def start(self):
        self.observer.status.pop("kept", None)
        command = [str(BIN / "ols-station"), "--config", str(self.folder / "kept.toml")]
        self.site.start_and_wait("station", command, "ready")
        self.wait_for_status("kept")

    def kill(self):
        self.site.stop("station", signal.SIGKILL)

    def alarmed(self, beginning):
        return any(a.startswith(beginning) for a in self.observer.status["kept"].alarm)

    def command(self, kind):
        message = addressed(PTU(), "kept", time.time_ns())
        message.command = kind
        self.publish("OLS_PTU_kept", message.encode())

    def wait_for_state(self, state):
        self.wait(lambda: self.observer.status["kept"].state == state, f"state {state}")

    def wait_for_hold(self, word):
        file = self.state_folder / "kept.hold"
        self.wait(lambda: file.is_file() and file.read_text() == word + "\n", f"{word} in {file}")

    def refuses_slews(self):
        reason = "refused_emergency" if self.emergency() else "refused_precedence"
        before = self.counter("kept", reason)

        def refused():  # a slew is short-lived: on a busy machine some are stale when they are read
            self.publish("OLS_SLEW_kept", slew("kept", time.time_ns(), 0.1).encode())
            return self.counter("kept", reason) >= before + 3

        self.wait(refused, f"three {reason}")
        assert self.observer.status["kept"].state in (STATUS.STATE_STOPPED, STATUS.STATE_EMERGENCY)

    def emergency(self):
        return self.observer.status["kept"].state == STATUS.STATE_EMERGENCY


@pytest.fixture
def station(network, tmp_path):
    with Site(tmp_path / "logs") as site:
        yield Kept(site, tmp_path)


def free(station):
    """As it is left by a person who has released it."""
    station.start()
    station.command(PTU.COMMAND_RELEASE)
    station.wait_for_state(STATUS.STATE_IDLE)
    station.wait_for_hold("free")


def test_a_free_station_comes_up_free(station):
    free(station)
    station.kill()
    station.start()
    station.wait_for_state(STATUS.STATE_IDLE)
    assert not station.alarmed("stop: ")


def test_a_folder_that_was_taken_away_is_no_leave_to_move(station):
    """Pressed, released, not re-armed, killed, the folder taken away, started again."""
    free(station)
    station.switch.press(True)
    station.wait_for_state(STATUS.STATE_EMERGENCY)
    station.switch.press(False)
    station.wait(lambda: station.alarmed("emergency stop: not rearmed yet"), "released")
    station.wait_for_hold("emergency")
    station.kill()
    shutil.rmtree(station.state_folder)
    station.start()
    station.wait_for_state(STATUS.STATE_STOPPED)
    assert station.alarmed(f"{NOT_KNOWN} ({station.state_folder} is missing)")
    station.refuses_slews()
    station.wait(
        lambda: station.alarmed("stop: state cannot be saved: "), "that it cannot remember"
    )
    assert not station.state_folder.exists()
    station.state_folder.mkdir()
    station.wait(lambda: not station.alarmed("stop: state cannot be saved: "), "that it can again")
    station.kill()  # no operator has acted: it is still unknown
    station.start()
    station.wait_for_state(STATUS.STATE_STOPPED)
    assert station.alarmed(NOT_KNOWN)
    station.command(PTU.COMMAND_RELEASE)
    station.wait_for_state(STATUS.STATE_IDLE)
    station.wait(lambda: not station.alarmed(NOT_KNOWN), "its alarm to go")


def test_what_is_damaged_needs_a_hand_at_the_station(station):
    """A stop may have been pressed. The unit test has every file in every condition."""
    station.state_folder.joinpath("kept.hold").write_text("holiday\n")
    station.state_folder.joinpath("kept.doubt").mkdir()
    station.start()
    station.wait_for_state(STATUS.STATE_EMERGENCY)
    assert station.alarmed(NOT_KNOWN)
    assert station.alarmed("ptu: reference before the restart is unknown")
    station.refuses_slews()
    station.command(PTU.COMMAND_REARM)
    station.wait_for_counter("kept", "refused_rearm_needs_a_hand", 1)
    os.kill(station.site.processes["station"].pid, signal.SIGUSR1)
    station.wait_for_state(STATUS.STATE_STOPPED)
    station.command(PTU.COMMAND_RELEASE)
    station.wait_for_state(STATUS.STATE_IDLE)
    station.wait(lambda: not station.alarmed(NOT_KNOWN), "its alarm to go")
