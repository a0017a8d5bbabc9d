"""The files of the time services are understood by the services themselves."""

import os
import re
import shutil
import subprocess

import pytest
from conftest import ROOT, finished
from ols_demo.site import Site

PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
EXAMPLES = ROOT / "systemd/examples"


def program(name):
    found = shutil.which(name, path=PATH)
    if found is None:
        pytest.skip(f"{name} is not installed")
    return found


def test_ptp4l_tells_the_time_and_takes_none(network, tmp_path):
    """It becomes the grand master of a link to which nobody else says anything."""
    text = (EXAMPLES / "ptp4l.conf").read_text().replace("/run/ols-ptp", str(tmp_path))
    # The unit's own folder for its socket is the one of the file.
    unit = (ROOT / "systemd/units/ols-ptp@.service").read_text()
    assert "RuntimeDirectory=ols-ptp\n" in unit and str(tmp_path) in text
    (tmp_path / "ptp4l.conf").write_text(text + "logMinDelayReqInterval -2\n")
    for words in ("add ptp0 type veth peer name ptp1", "set ptp0 up", "set ptp1 up"):
        subprocess.run(["ip", "link", *words.split()], check=True, env={**os.environ, "PATH": PATH})
    try:
        with Site(tmp_path / "logs") as site:
            config = str(tmp_path / "ptp4l.conf")
            command = [program("ptp4l"), "-f", config, "-i", "ptp0", "-m", "-l", "6"]
            site.start_and_wait("ptp4l", command, "assuming the grand master role")
            said = (tmp_path / "logs/ptp4l.log").read_text()
            assert not re.search("clockcheck|rms|clock_adjtime|failed", said), said
    finally:
        subprocess.run(["ip", "link", "delete", "ptp0"], env={**os.environ, "PATH": PATH})


def test_chrony_reads_the_example_for_a_receiver(tmp_path):
    shutil.copy(EXAMPLES / "chrony-gnss.conf", tmp_path)
    done = finished(program("chronyd"), "-p", "-f", tmp_path / "chrony-gnss.conf")
    assert done.returncode == 0, done.stderr
    assert "refclock SHM 0" in done.stdout
