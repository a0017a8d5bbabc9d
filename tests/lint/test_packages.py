"""The packages' scripts: what a package has started ends when it is removed, and only then."""

import os
import re
import subprocess
from fnmatch import fnmatch
from pathlib import Path

import pytest

DEBIAN = Path(__file__).resolve().parents[2] / "debian"
SERVICES = {
    path.stem: [
        Path(line.split()[0]).name
        for line in path.read_text().splitlines()
        if line.split()[0].endswith((".service", ".timer"))
    ]
    for path in sorted(DEBIAN.glob("*.install"))
}
WITH_SERVICES = [package for package, services in SERVICES.items() if services]


def run_script(folder, script, *words):
    """What it stops. Services run on this host, and the programs of the script are this test's."""
    running, programs, stopped = folder / "system", folder / "bin", folder / "stopped"
    for path in (running, programs):
        path.mkdir(exist_ok=True)
    invoke = programs / "deb-systemd-invoke"
    invoke.write_text(f'#!/bin/sh\necho "$*" >>{stopped}\nexit 1\n')
    invoke.chmod(0o755)
    text = (DEBIAN / script).read_text().replace("/run/systemd/system", str(running))
    environment = {"PATH": f"{programs}:{os.environ['PATH']}", "DPKG_ROOT": str(folder / "root")}
    subprocess.run(["sh", "-s", *words], input=text, text=True, check=True, env=environment)
    if not stopped.exists():
        return []
    command, *units = stopped.read_text().split()
    assert command == "stop"
    return units


def test_removing_a_package_stops_its_services(tmp_path):
    left = []
    for package in WITH_SERVICES:
        folder = tmp_path / package
        folder.mkdir()
        units = run_script(folder, f"{package}.prerm", "remove")
        left += [
            service
            for service in SERVICES[package]
            if not any(fnmatch(service.replace("@.", "@alfa."), unit) for unit in units)
        ]
    assert WITH_SERVICES and left == []


def test_an_upgrade_stops_none(tmp_path):
    stopped = [run_script(tmp_path, f"{one}.prerm", "upgrade", "0.2.0") for one in WITH_SERVICES]
    assert stopped == [[]] * len(WITH_SERVICES)


@pytest.mark.parametrize(
    ("package", "instance"), [("ols-station", "ols-station@alfa"), ("ols-common", "ols-ptp@eth1")]
)
def test_instances_are_not_enabled_any_more_when_the_package_comes_back(
    tmp_path, package, instance
):
    wants = tmp_path / "root/etc/systemd/system/multi-user.target.wants"
    wants.mkdir(parents=True)
    (wants / "ssh.service").symlink_to("/lib/systemd/system/ssh.service")
    link = wants / f"{instance}.service"
    link.symlink_to(f"/lib/systemd/system/{instance.split('@')[0]}@.service")
    script = f"{package}.postrm"
    # It is run on this machine: each of its paths is below that root.
    assert not re.search(r"\s/(?!dev/null)\w", (DEBIAN / script).read_text().split("\n", 1)[1])
    run_script(tmp_path, script, "remove")
    assert link.is_symlink()
    run_script(tmp_path, script, "purge")
    assert [path.name for path in wants.iterdir()] == ["ssh.service"]
