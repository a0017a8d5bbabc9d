"""A site with a mount of every kind: FLIR, ONVIF, INDI, and two cameras that stand still."""

import json
import sys
from os.path import relpath

from conftest import BIN, ROOT, finished
from helpers import at_frame_rate


def test_stations_of_every_kind_locate_the_target(network, tmp_path):
    report = tmp_path / "r.json"
    scenario = at_frame_rate(ROOT / "sim/scenarios/mixed.toml", 6.0, tmp_path)
    with scenario.open("a") as file:
        # Switched on in time: it would answer nothing for twenty seconds.
        file.write("\n[ptu]\nhome_at_power_up = false\n")
    command = [sys.executable, "-m", "ols_demo", "--operator", "--headless", "--seconds", "5"]
    command += ["--scenario", str(scenario), "--report", str(report)]
    command += ["--output", str(tmp_path), "--bin", relpath(BIN, ROOT)]
    done = finished(*command, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr
    told = json.loads(report.read_text())
    assert set(told["stations"]) == {"alfa", "bravo", "charlie", "delta", "echo"}
    for name, station in told["stations"].items():
        assert station["seconds"].get("tracking", 0.0) > 0.0, name
        assert station["bearings"] > 0, name
    assert told["fixes"] > 10
    # Metres at 250 to 400 m: a mount whose angles are wrong by a degree would shift it by several.
    assert told["rmse_m"] < 2.0
