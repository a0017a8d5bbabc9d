"""An update that was waited for or watched when the computer was started again."""

import pytest
from update_host import BRIEFLY, OTHER, STATION, Host, took_s, went_back


@pytest.fixture(name="host")
def fixture_host(tmp_path):
    return Host(tmp_path)


def test_an_update_is_watched_on_when_the_computer_was_started_again(host):
    host.install("1.0")
    host.install("1.1")
    host.set(active="failed")
    done = host.start_again("1.1 first\n")
    assert done.returncode == 1
    assert "back to version 1.0" in done.stderr
    assert len(went_back(host)) == 1
    assert not (host.packages / "watch").exists()


def test_elsewhere_only_a_station_that_does_not_run_counts(host):
    host.install("1.0")
    host.install("1.1")
    host.set(failures="gnss", failures_after="gnss")
    host.set(units=f"{STATION} loaded active running\n{OTHER} loaded failed failed")
    done = host.start_again(f"1.1 first\n{OTHER}\n")
    assert done.returncode == 0, done.stderr
    assert host.done() == [], "all run the new program by now"
    assert took_s(host) > 900.0
    assert not (host.packages / "watch").exists()


@pytest.mark.parametrize("watch", ["", "1.0 first\n", "1.1 second\n"])
def test_another_watch_is_not_gone_on_with(host, watch):
    """One that has only just begun, of another version, of the present boot."""
    host.install("1.0")
    host.install("1.1")
    assert host.start_again(watch, *BRIEFLY).returncode == 0
    assert f"systemctl restart --no-block {STATION}" in host.done()


def test_whoever_waits_has_written_down_what_for(host):
    host.set(units=f"{STATION} loaded active running\n{OTHER} loaded failed failed")
    host.install("1.1")
    (host.folder / "bin/sync").write_text('#!/bin/sh\ncp "$1" "$HOST/watch"\n')
    (host.folder / "bin/sync").chmod(0o755)
    host.restart(*BRIEFLY)
    assert (host.folder / "watch").read_text() == f"1.1 first\n{OTHER}\n"
