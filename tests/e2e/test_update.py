"""An update of a station's packages: kept, put into use when the station is idle, taken back when
it is bad.

The scripts are run as they are installed, on a host whose systemctl, dpkg and ols-doctor are
scripts of this test.
"""

import os
import subprocess

import pytest
from conftest import ROOT

RESTART = ROOT / "systemd/ols-station-restart"
KEEP = ROOT / "systemd/ols-keep-packages"
STATION = "ols-station@alfa.service"

SYSTEMCTL = r"""#!/bin/sh
case "$*" in
  list-units*) cat "$HOST/units" ;;
  *ActiveState*) cat "$HOST/active" ;;
  *StatusText*)
    # One line a question; the last one stays.
    head -1 "$HOST/state"
    if [ "$(wc -l <"$HOST/state")" -gt 1 ]; then sed -i 1d "$HOST/state"; fi ;;
  *) echo "systemctl $*" >>"$HOST/done"
     if [ "$1" = restart ] && [ -e "$HOST/active_after" ]; then
       cp "$HOST/active_after" "$HOST/active"
     fi ;;
esac
"""
DOCTOR = r"""#!/bin/sh
if grep -q restart "$HOST/done" 2>/dev/null; then exit "$(cat "$HOST/doctor_after")"; fi
exit "$(cat "$HOST/doctor")"
"""
DPKG = '#!/bin/sh\necho "dpkg $*" >>"$HOST/done"\n'
# Debian's own, for packages that are nothing but a name here.
DPKG_DEB = '#!/bin/sh\nbasename "$2" | cut -d_ -f2\n'


class Host:
    def __init__(self, folder):
        self.folder = folder
        self.packages = folder / "packages"
        commands = folder / "bin"
        commands.mkdir()
        scripts = {
            "systemctl": SYSTEMCTL,
            "ols-doctor": DOCTOR,
            "dpkg": DPKG,
            "dpkg-deb": DPKG_DEB,
            "sleep": "#!/bin/sh\n",
        }
        for name, text in scripts.items():
            (commands / name).write_text(text)
            (commands / name).chmod(0o755)
        self.environment = {
            **os.environ,
            "PATH": f"{commands}:{os.environ['PATH']}",
            "HOST": str(folder),
            "OLS_PACKAGES": str(self.packages),
        }
        self.set(units=f"{STATION} loaded active running", active="active", state="idle")
        self.set(doctor="0", doctor_after="0")

    def set(self, **files):
        for name, text in files.items():
            (self.folder / name).write_text(text + "\n")

    def run(self, *command, **options):
        return subprocess.run(
            [str(part) for part in command],
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
            **options,
        )

    def install(self, version):
        """As apt announces what it is about to install."""
        folder = self.folder / f"archive-{version}"
        folder.mkdir()
        names = [f"ols-station_{version}_amd64.deb", f"ols-common_{version}_amd64.deb"]
        for name in (*names, "chrony_4.3_amd64.deb"):
            (folder / name).write_text(version)
        text = "".join(f"{path}\n" for path in sorted(folder.iterdir()))
        done = self.run(KEEP, input=text)
        assert done.returncode == 0, done.stderr

    def restart(self):
        return self.run(RESTART, "--watch", 60, "--worse", 30)

    def done(self):
        path = self.folder / "done"
        return path.read_text().splitlines() if path.exists() else []


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
    (host.folder / "archive-1.0").rename(host.folder / "archive-before")
    host.install("1.0")
    assert not (host.packages / "previous").exists()


def test_a_station_at_work_is_restarted_when_it_is_idle(host):
    host.set(state="tracking; 33 fps\ncoasting\nno bus; tracking\nidle")
    done = host.restart()
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
    assert "at work" not in host.restart().stdout
    assert f"systemctl restart --no-block {STATION}" in host.done()


def test_without_a_running_station_nothing_happens(host):
    host.set(units="")
    assert host.restart().returncode == 0
    assert host.done() == []


def bad(host):
    host.install("1.0")
    host.install("1.1")
    done = host.restart()
    assert done.returncode == 1
    return done


def went_back(host):
    return [line for line in host.done() if line.startswith("dpkg") and "/1.0/" in line]


def test_a_new_failure_takes_the_update_back(host):
    host.set(doctor="1", doctor_after="2")
    done = bad(host)
    assert "back to version 1.0" in done.stderr
    assert len(went_back(host)) == 1
    assert host.done()[-1] == f"systemctl restart --no-block {STATION}"


def test_a_program_that_does_not_run_takes_the_update_back(host):
    host.set(doctor="2", doctor_after="2", active_after="failed")
    bad(host)
    assert len(went_back(host)) == 1


def test_what_was_broken_before_is_not_the_updates_fault(host):
    host.set(doctor="2", doctor_after="2")
    host.install("1.0")
    host.install("1.1")
    done = host.restart()
    assert done.returncode == 0, done.stderr
    assert went_back(host) == []


def test_without_an_earlier_version_it_says_so(host):
    host.set(doctor_after="2")
    host.install("1.0")
    done = host.restart()
    assert done.returncode == 1
    assert "nothing to go back to" in done.stderr
    assert went_back(host) == []
