"""An update of a station's packages: kept, put into use when the station is idle, taken back when
it is bad.
"""

import shutil

import pytest
from raised_alarms import table
from update_host import BRIEFLY, BUSY, OTHER, RESTART, START_S, STATION, Host, took_s, went_back


@pytest.fixture(name="host")
def fixture_host(tmp_path):
    return Host(tmp_path)


def test_the_packages_of_two_versions_are_kept(host):
    for version in ("1.0", "1.1", "1.2"):
        host.install(version)
    kept = sorted(path.name for path in host.packages.iterdir() if path.is_dir())
    assert kept == ["1.1", "1.2"]
    assert (host.packages / "previous").read_text() == "1.1\n"
    assert sorted(path.name for path in (host.packages / "1.1").iterdir()) == [
        "ols-common_1.1_amd64.deb",
        "ols-station_1.1_amd64.deb",
    ]


def test_the_same_version_again_is_not_an_earlier_one(host):
    host.install("1.0")
    host.install("1.0")
    assert not (host.packages / "previous").exists()


def test_what_was_installed_before_anything_was_kept_is_packed_again(host):
    """The first version brings the script that keeps packages: nobody kept that version."""
    host.set(installed="ols-common 1.0\nols-station 1.0")
    host.install("1.1")
    assert (host.packages / "previous").read_text() == "1.0\n"
    assert sorted(path.name for path in (host.packages / "1.0").iterdir()) == [
        "ols-common_1.0_amd64.deb",
        "ols-station_1.0_amd64.deb",
    ]


def test_what_cannot_be_kept_stops_no_update_and_is_no_half_version(host):
    host.set(installed="ols-common 1.0\nols-station 1.0", no_repack="")
    assert "ols-common 1.0 cannot be kept" in host.install("1.1").stderr
    assert sorted(path.name for path in host.packages.iterdir()) == ["1.1"]


def test_a_station_at_work_is_restarted_when_it_is_idle(host):
    host.set(state="tracking; 33 fps\ncoasting\nno bus; tracking\nidle")
    done = host.restart(*BRIEFLY)
    assert done.returncode == 0, done.stderr
    assert "goes on with the program that it has" in done.stdout
    assert host.done() == [
        f"systemctl reset-failed {STATION}",
        f"systemctl restart --no-block {STATION}",
    ]
    assert (host.folder / "state").read_text() == "idle\n"  # every earlier state was waited out


@pytest.mark.parametrize("state", ["idle; camera absent", "stopped", "no bus; idle", "emergency"])
def test_a_station_that_follows_nothing_is_restarted_at_once(host, state):
    host.set(state=state)
    assert "at work" not in host.restart(*BRIEFLY).stdout
    assert f"systemctl restart --no-block {STATION}" in host.done()


def test_without_a_running_station_nothing_happens(host):
    host.set(units="")
    assert host.restart(*BRIEFLY).returncode == 0
    assert host.done() == []


def bad(host, *words):
    host.install("1.0")
    host.install("1.1")
    done = host.restart(*words)
    assert done.returncode == 1, done.stderr
    return done


def test_a_new_failure_takes_the_update_back(host):
    host.set(failures_after="camera")
    done = bad(host)
    assert "back to version 1.0" in done.stderr
    assert len(went_back(host)) == 1
    assert host.done()[-1] == f"systemctl restart --no-block {STATION}"
    # Six minutes at most, however long ols-doctor takes.
    assert took_s(host) < 360.0


def test_a_version_that_was_taken_back_is_not_installed_again(host):
    host.set(failures_after="camera")
    bad(host, *BRIEFLY)
    assert host.refused.read_text().endswith(
        "Package: ols-* python3-ols\nPin: version 1.1\nPin-Priority: -1\n"
    )


def test_the_journal_is_told_once_and_by_its_kind(host):
    """Whether it listens is said by JOURNAL_STREAM, as systemd sets it for a service."""
    (host.folder / "bin/logger").write_text(
        '#!/bin/sh\n[ "$1" = --journald ] && cat >"$HOST/told"\n'
    )
    (host.folder / "bin/logger").chmod(0o755)
    host.set(failures_after="camera")
    assert "version 1.0 is back" in bad(host, *BRIEFLY).stderr
    assert not (host.folder / "told").exists()
    listens = 'JOURNAL_STREAM=$(stat -L -c %d:%i /dev/stderr) exec "$0" "$@"'
    (host.folder / "restarted").unlink()
    assert "version 1.0 is back" not in host.run("sh", "-c", listens, RESTART, *BRIEFLY).stderr
    told = (host.folder / "told").read_text().splitlines()
    number = table.events()["UpdateTakenBack"]["id"]
    assert told[0].startswith("MESSAGE=version 1.1 of ols-station does not work")
    assert f"MESSAGE_ID={number}" in told


def candidate(host, *versions):
    """Which of the versions of a repository apt would install by what host.refused says."""
    here = host.folder
    (here / "lists").mkdir(exist_ok=True)
    (here / "Packages").write_text(
        "\n".join(
            f"Package: ols-station\nVersion: {version}\nArchitecture: all\n"
            f"Filename: ./{version}.deb\nSize: 1\nSHA256: {0:064}\n"
            for version in versions
        )
    )
    (here / "sources.list").write_text(f"deb [trusted=yes] file:{here} ./\n")
    options = [
        f"Dir::Etc::sourcelist={here}/sources.list",
        "Dir::Etc::sourceparts=/dev/null",
        f"Dir::Etc::preferences={host.refused}",
        "Dir::Etc::preferencesparts=/dev/null",
        f"Dir::State={here}",
        f"Dir::Cache={here}",
        "Dir::State::status=/dev/null",
        "Debug::NoLocking=true",
        "APT::Sandbox::User=root",
    ]
    words = [word for option in options for word in ("-o", option)]
    assert host.run("apt-get", "update", *words).returncode == 0
    policy = host.run("apt-cache", "policy", "ols-station", *words).stdout
    return policy.split("Candidate: ")[1].split()[0]


@pytest.mark.skipif(shutil.which("apt-get") is None, reason="no apt")
def test_apt_leaves_out_what_was_taken_back_and_takes_what_comes_later(host):
    host.set(failures_after="camera")
    bad(host, *BRIEFLY)
    assert candidate(host, "1.0", "1.1") == "1.0"
    assert candidate(host, "1.0", "1.1", "1.2") == "1.2"


def test_a_program_that_does_not_run_takes_the_update_back(host):
    host.set(failures="camera", failures_after="camera", active_after="failed")
    bad(host, *BRIEFLY)
    assert len(went_back(host)) == 1


def test_a_program_that_ends_again_and_again_takes_the_update_back(host):
    host.set(crashes="")
    bad(host, *BRIEFLY)
    assert len(went_back(host)) == 1


@pytest.mark.parametrize(
    "state",
    [{"failures_after": "crash"}, {"failures": "crash", "failures_after": "crash"}, {"hangs": ""}],
    ids=["crashes", "never ran: it is of the update itself", "hangs"],
)
def test_a_doctor_that_does_not_come_to_its_end_takes_the_update_back(host, state):
    host.set(**state)
    bad(host, *BRIEFLY)
    assert len(went_back(host)) == 1


def test_what_was_broken_before_hides_no_new_failure(host):
    host.set(failures="gnss", failures_after="gnss\nptu")
    bad(host, *BRIEFLY)
    assert len(went_back(host)) == 1


def test_what_was_broken_before_is_not_the_updates_fault(host):
    host.set(failures="gnss\ncamera", failures_after="gnss")
    host.install("1.0")
    host.install("1.1")
    done = host.restart()
    assert done.returncode == 0, done.stderr
    assert went_back(host) == []
    assert not host.refused.exists()


def test_a_station_that_had_failed_before_is_restarted_and_counts_for_nothing(host):
    host.set(units=f"{STATION} loaded active running\n{OTHER} loaded failed failed")
    host.install("1.0")
    host.install("1.1")
    done = host.restart(*BRIEFLY)
    assert done.returncode == 0, done.stderr
    assert f"systemctl restart --no-block {OTHER}" in host.done()
    assert went_back(host) == []


def test_a_station_that_had_failed_before_hides_no_other(host):
    host.set(units=f"{STATION} loaded active running\n{OTHER} loaded failed failed", crashes="")
    bad(host, *BRIEFLY)
    assert len(went_back(host)) == 1


def test_what_becomes_worse_at_the_end_of_the_watch_is_watched_on(host):
    host.set(failures_after="camera", not_before_s=str(START_S + 800))
    bad(host)
    assert len(went_back(host)) == 1
    assert took_s(host) > 1050.0


def test_what_cannot_be_taken_back_is_not_called_well(host):
    host.set(failures_after="camera", dpkg_broken="")
    done = bad(host)
    assert "given up" in done.stderr
    assert "well" not in done.stdout
    assert took_s(host) < 1300.0


def test_it_waits_for_whoever_else_is_installing(host):
    host.set(failures_after="camera", dpkg_busy="")
    assert "trying again" in bad(host, *BRIEFLY).stderr
    assert len(went_back(host)) == 1


def test_the_next_update_is_put_into_use_while_this_one_is_watched(host):
    host.install("1.0")
    host.set(next="ols-common 1.1\nols-station 1.1")
    assert host.restart(*BRIEFLY).returncode == 0
    assert host.done().count(f"systemctl restart --no-block {STATION}") == 2


def test_what_breaks_while_the_station_is_at_work_is_not_the_updates_fault(host):
    host.set(state="tracking\n" * 4 + "idle", not_before_s=str(START_S + 5))
    host.set(failures="camera", failures_after="camera")
    host.install("1.0")
    host.install("1.1")
    done = host.restart(*BRIEFLY)
    assert done.returncode == 0, done.stderr
    assert "at work" in done.stdout
    assert went_back(host) == []


def test_a_station_is_watched_while_another_is_at_work(host):
    host.set(units=f"{STATION} loaded active running\n{BUSY} loaded active running", crashes="")
    bad(host)
    assert len(went_back(host)) == 1
    assert took_s(host) < 360.0


def test_without_an_earlier_version_it_says_so(host):
    host.set(failures_after="camera")
    host.install("1.0")
    done = host.restart(*BRIEFLY)
    assert done.returncode == 1
    assert "nothing to go back to" in done.stderr
    assert went_back(host) == []
