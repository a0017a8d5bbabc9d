"""A station without camera and PTU: it comes up, says so, and refuses what it must refuse.

Without signatures, so that every message reaches the station's own judgement; test_attacked_station
has what ends before that.
"""

import math
import signal
import subprocess
import time

import ols_msg
import pytest
from conftest import BIN, finished
from helpers import Listener, point, station_without_devices
from ols_demo.site import Site


def starts_stopped(station):
    """It saves nothing, so its state before the restart is unknown."""
    status = station.observer.status["lone"]
    assert status.state == ols_msg.station_status_t.STATE_STOPPED
    unknown = "unknown (no state_folder is configured): check it, then ols-ctl lone "
    assert f"stop: state before the restart is {unknown}release" in status.alarm
    assert f"ptu: reference before the restart is {unknown}reference-ok" in status.alarm
    release(station)
    station.wait(
        lambda: not any(a.startswith("stop: state") for a in alarms(station)), "its alarm to go"
    )


def alarms(station):
    return station.observer.status["lone"].alarm


@pytest.fixture(scope="module")
def station(unsigned, tmp_path_factory):
    folder = tmp_path_factory.mktemp("station")
    config = folder / "lone.toml"
    config.write_text(station_without_devices("lone"))
    listener = Listener()
    with Site(folder / "logs") as site:
        command = [str(BIN / "ols-station"), "--config", str(config)]
        site.start_and_wait("station", command, "ready")
        listener.wait_for_status("lone")
        starts_stopped(listener)
        listener.site = site
        yield listener


def refused(station, name, channel, *messages):
    """Publishes and waits until the refusals are counted; nothing else may have happened."""
    before = station.counter("lone", name)
    for data in messages:
        station.publish(channel, data)
    station.wait_for_counter("lone", name, before + len(messages))
    assert station.counter("lone", name) == before + len(messages)
    station.site.check()
    assert station.observer.state("lone") == "idle"


def test_absent_devices_are_reported(station):
    status = station.wait_for_status("lone")
    devices = dict(zip(status.device_name, status.device_state, strict=True))
    absent, ok = ols_msg.station_status_t.DEVICE_ABSENT, ols_msg.station_status_t.DEVICE_OK
    assert devices == {"camera": absent, "ptu": absent, "software": ok}  # which has the version
    assert math.isnan(status.pan_rad)
    assert status.last_error != ""


@pytest.mark.parametrize("kind", ["SLEW", "PTU", "DESIGNATE"])
def test_foreign_and_truncated_messages_are_refused(station, kind):
    whole = point("lone", 1, 0.1).encode()
    # The station's id begins behind fingerprint, utime, version, boot id and sequence.
    no_string = whole[:36] + b"\0\0\0\0" + whole[40:]
    damaged = (b"", b"x", whole[:-1], whole + b"\0", no_string)
    bad = (*damaged, ols_msg.truth_target_t().encode())
    refused(station, "messages_refused_malformed", f"OLS_{kind}_lone", *bad)


def release(station):
    """Again and again: in the first second after a stop it is refused."""

    def released():
        message = point("lone", time.time_ns(), 0.0)
        message.command = ols_msg.ptu_command_t.COMMAND_RELEASE
        station.publish("OLS_PTU_lone", message.encode())
        return station.observer.state("lone") == "idle"

    station.wait(released, "idle")


def ctl(*arguments: str) -> subprocess.CompletedProcess:
    return finished(BIN / "ols-ctl", *arguments)


def test_the_operators_hand(station):
    shown = ctl("lone", "status")
    assert shown.returncode == 0, shown.stderr
    assert "lone" in shown.stdout and "idle" in shown.stdout and "absent" in shown.stdout
    refused_move = ctl("lone", "manual", "10", "5")
    assert refused_move.returncode == 1
    assert "there is no pan-tilt unit" in refused_move.stdout
    slip = ctl("lone", "manual", "500", "5")
    assert slip.returncode == 2 and "PAN 500 is outside -360 .. 360 deg" in slip.stderr
    assert ctl("all", "stop").stdout == "lone: done\n"
    station.wait(lambda: station.observer.state("lone") == "stopped", "stopped")
    assert ctl("lone", "release").returncode == 0
    station.wait(lambda: station.observer.state("lone") == "idle", "idle")


def test_ctl_says_when_nobody_answers(station):
    nobody = ctl("nobody", "stop")
    assert nobody.returncode == 1
    assert nobody.stdout == "nobody: sent repeatedly, no answer\n"
    nobody = ctl("nobody", "release")
    assert nobody.returncode == 1
    assert nobody.stdout == "nobody: no answer\n"


def test_what_the_kernel_drops_is_counted(station):
    """More than its buffer holds, while the process stands still."""
    before = station.counter("lone", "bus_datagrams_dropped")
    process = station.site.processes["station"]
    process.send_signal(signal.SIGSTOP)
    for _ in range(600):
        station.publish("FLOOD", bytes(50_000))
    process.send_signal(signal.SIGCONT)
    station.wait_for_counter("lone", "bus_datagrams_dropped", before + 1)


def test_the_journal_tells_of_devices_and_refusals(station):
    refused(station, "messages_refused_malformed", "OLS_SLEW_lone", b"x")

    def told():
        journal = (station.site.logs / "station.log").read_text()
        return all(
            line in journal
            for line in ("camera absent: ", "ptu absent: ", "bus connected: ", "command: ")
        )

    station.wait(told, "the journal")


def test_it_ends_in_order(station):
    assert station.site.stop("station") == 0
