"""A whole site of new units, each calibrated by `ols-calibrate field` on its pictures: the fusion's
positions before and after."""

import json
import os
import subprocess
import tomllib

import numpy as np
import pytest
from conftest import BIN, ROOT
from ols_demo.site import Site
from tripod import Tripod, references

SCENARIO = ROOT / "sim/scenarios/new_units.toml"
SEED = 1
SECONDS = 120.0
# East, north, up [m]: all around the site, from the horizon to 25 degrees.
SIGNS = {
    "spire": (310.0, 880.0, 120.0),
    "mast": (720.0, 640.0, 330.0),
    "gable": (930.0, 180.0, -5.0),
    "chimney": (860.0, -330.0, 240.0),
    "barn": (560.0, -770.0, 15.0),
    "tower": (60.0, -940.0, 380.0),
    "bridge": (-420.0, -830.0, 5.0),
    "rock": (-790.0, -520.0, 260.0),
    "silo": (-950.0, -40.0, 25.0),
    "dome": (-810.0, 470.0, 310.0),
    "gate": (-460.0, 800.0, 0.0),
}


def with_signs(path):
    """The demonstration of new units, with signs for a surveyor to measure."""
    text = SCENARIO.read_text()
    for name, place in SIGNS.items():
        text += f'\n[[mark]]\nid = "{name}"\nposition_enu_m = {list(place)}\nsize_m = 1.2\n'
    path.write_text(text)
    return path


def in_reach(station):
    """The signs that a unit can turn to."""
    for name, place in SIGNS.items():
        east, north, up = np.subtract(place, station["position_enu_m"])
        azimuth = np.degrees(np.arctan2(east, north))
        pan = (station["heading_deg"] - azimuth + 180.0) % 360.0 - 180.0
        elevation = np.degrees(np.arctan2(up, np.hypot(east, north)))
        if abs(pan) < 150.0 and elevation < 28.0:
            yield name


def flown(scenario, output, *options):
    """The fusion's figures of one flight."""
    command = [BIN / "ols-sim", "--scenario", scenario, "--seed", SEED, "--output", output]
    command += ["--lockstep", "--pixels", "--seconds", SECONDS, *options]
    subprocess.run(list(map(str, command)), check=True)
    return json.loads((output / "summary.json").read_text())["joint"]


@pytest.mark.skipif(
    os.environ.get("OLS_WHOLE_FIELD") != "1",
    reason="takes a quarter of an hour: OLS_WHOLE_FIELD=1 runs it",
)
def test_positions_of_new_units_before_and_after_field(network, tmp_path):
    scenario = with_signs(tmp_path / "site.toml")
    calibrations = tmp_path / "calibrations"
    calibrations.mkdir()
    for station in tomllib.loads(scenario.read_text())["station"]:
        name = station["id"]
        folder = tmp_path / name
        folder.mkdir()
        signs = list(in_reach(station))
        with Site(folder / "logs") as site:
            tripod = Tripod(folder, site, scenario, SEED, station=name)
            tripod.ready()
            path = references(folder / "references.csv", signs, scenario=scenario)
            process = tripod.begin("field", "--instrument", "new", "--references", path)
            told = []

            def decide(state, told=told):
                told.append(state)
                return "accept" if "accept" in state.choice else "keep"

            status = tripod.operate(process, decide, deadline_s=900.0)
            assert status == 0, tripod.log.read_text()
            assert "accept" in told[0].choice, told[0].text
        print(f"{name}: {told[0].elapsed_s:.0f} s, {len(signs)} signs\n{told[0].text}")
        (calibrations / name).symlink_to((tripod.store / "current").resolve())

    before = flown(scenario, tmp_path / "before")
    after = flown(scenario, tmp_path / "after", "--calibrations", calibrations)
    print(f"before {before['rmse_m']:.3f} m, normalised error squared {before['nees']:.2f}")
    print(f"after {after['rmse_m']:.4f} m, normalised error squared {after['nees']:.2f}")
    assert after["rmse_m"] < before["rmse_m"] / 5.0
    assert 0.5 < after["nees"] < 2.0
