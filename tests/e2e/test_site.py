"""The whole site over its real wires, for a few seconds; then its log, replayed.

Function only: how fast and how exact it is says tools/demo on an idle machine.
"""

import json
import os
import re
import sys
from os.path import relpath

import lcm
import pytest
from conftest import BIN, ROOT, finished, wait
from console_site import Api, address_of
from helpers import at_frame_rate
from ols_demo.bus import decode
from ols_demo.site import Site
from PIL import Image

RUN_S = 5


@pytest.fixture(scope="module")
def run(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    report = folder / "r.json"
    command = [sys.executable, "-m", "ols_demo", "--operator", "--headless"]
    command += ["--seconds", str(RUN_S)]
    # Small and few pictures: two ordinary processors have other tests to run as well.
    scenario = at_frame_rate(ROOT / "sim/scenarios/faults.toml", 6.0, folder)
    command += ["--scenario", str(scenario)]
    command += ["--report", str(report), "--output", str(folder), "--bin", relpath(BIN, ROOT)]
    done = finished(*command, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture(scope="module")
def report(run):
    return json.loads((run / "r.json").read_text())


def test_every_station_tracks_and_sends_bearings(report):
    assert len(report["stations"]) == 4
    for station in report["stations"].values():
        assert station["frames_captured"] > 0
        assert station["bearings"] > 0
        assert station["seconds"].get("tracking", 0.0) > 0.0


def test_the_target_is_located(report):
    assert report["fixes"] > 10
    assert report["rmse_m"] < 5.0  # metres at 200 to 450 m: it is this object and no other
    assert report["predicted_rmse_m"] > 0.0
    assert report["paper"]["rmse_m"] is not None


def test_report_and_plot_are_whole(run, report):
    for key in ("scenario", "seed", "latency", "stations", "fixes"):
        assert key in report
    drawn, in_docs = (Image.open(one).text for one in (run / "r.png", ROOT / "docs/demo.png"))
    assert drawn["Description"].startswith("Plan\neast, m\n")
    assert in_docs == drawn, "docs/demo.png is old: run tools/demo, take its out/demo/report.png"
    assert (run / "run.lcmlog").stat().st_size > 0


def test_a_run_without_faults_is_no_news(run, tmp_path):
    """What comes up is no alarm, and what people are told has no words of programs."""
    command = [str(BIN / "ols-console"), "--port", "0", "--users", str(tmp_path / "nobody")]
    with Site(tmp_path / "logs") as site:
        site.start_and_wait("console", [*command, "--replay", str(run / "run.lcmlog")], "ready")
        api = Api(address_of(site, "console"))
        wait(lambda: api.state()["replay"]["read"] >= 1, "the whole log")
        _, timeline, _ = api.ask("/api/replay")
    news = [m for m in timeline["marks"] if m["kind"] in ("alarm", "error")]
    said = [mark["text"] for mark in news]
    assert not [text for text in said if "_" in text or " " not in text], said
    assert not [text for text in said if "does not answer" in text], said


def test_the_steps_of_getting_started_are_done_again_over_what_is_there(run, tmp_path):
    """Its replay and first look, as they are written, where an earlier time has left a file; it
    slews no station. That its targets are those of the live run, FusedSite judges."""
    blocks = re.findall(r"```\n(.*?)```", (ROOT / "docs/getting-started.md").read_text(), re.S)
    replay = next(block for block in blocks if "lcm-logplayer" in block).split("--net bash\n")[1]
    look = next(block for block in blocks if "lcm.EventLog" in block)
    (tmp_path / "out/demo").mkdir(parents=True)
    (tmp_path / "out/demo/run.lcmlog").symlink_to(run / "run.lcmlog")
    (tmp_path / "out/replay.lcmlog").write_bytes(b"of an earlier time")
    (tmp_path / "build").mkdir()
    (tmp_path / "build/release").symlink_to(BIN.parent)
    (tmp_path / "build/venv").symlink_to(ROOT / "build/venv")
    unsigned = {**os.environ, "OLS_TRUST": "off"}
    steps = replay.replace("lcm-logplayer", "lcm-logplayer -s 3") + look
    done = finished("unshare", "--net", "bash", "-c", steps, cwd=tmp_path, env=unsigned)
    assert re.search(r"^\d{16} 1 49\.\d{7} 16\.\d{7} .* m [2-4]$", done.stdout, re.M), done.stderr
    log = lcm.EventLog(str(tmp_path / "out/replay.lcmlog"), "r")
    assert not [event.channel for event in log if event.channel.startswith("OLS_SLEW_")]


def test_messages_of_the_log_decode(run):
    seen = set()
    for event in lcm.EventLog(str(run / "run.lcmlog"), "r"):
        if decode(event.channel, event.data) is not None:
            seen.add(event.channel.split("_")[1])
    assert {"BEARING", "STATUS", "TARGET", "SIM", "FUSION"} <= seen
