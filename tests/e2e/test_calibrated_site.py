"""New units on a site, calibrated: what ols-calibrate makes of the fusion's positions."""

import json

import pytest
from conftest import BIN, ROOT, finished

SEED = 2
SECONDS = 20
SCENARIO = ROOT / "sim" / "scenarios" / "new_units.toml"
STATIONS = ("alfa", "bravo", "charlie", "delta")


def run(*command, code=0):
    done = finished(*command)
    assert done.returncode == code, done.stderr
    return done


def simulate(*more):
    return run(BIN / "ols-sim", "--scenario", SCENARIO, "--seed", SEED, *more)


def fly(output, *more):
    """Without the designations' errors, which no calibration removes."""
    flight = ("--lockstep", "--pixels", "--seconds", SECONDS, "--without", "designation")
    simulate(*flight, "--output", output, *more)
    return json.loads((output / "summary.json").read_text())["joint"]


@pytest.fixture(name="site", scope="module")
def fixture_site(tmp_path_factory):
    """The folder of a site's observations and its stations' calibrations."""
    print(f"seed {SEED}")
    folder = tmp_path_factory.mktemp("site")
    simulate("--write-observations", folder / "round")
    for name in STATIONS:
        stem = folder / "round" / name
        done = run(
            *(BIN / "ols-calibrate", "adjust", "--station", f"{stem}.toml"),
            *("--observations", f"{stem}.observations.jsonl"),
            *("--references", f"{stem}.references.csv"),
            *("--pressure", 980, "--temperature", 10, "--ut1-utc", 0.03),
            *("--output", folder / "calibrations" / name),
            code=1,
        )
        assert "'landmark4' is rejected" in done.stderr, "it has moved by a metre"
    return folder


def test_positions_become_better_by_more_than_five(site):
    before = fly(site / "before")
    after = fly(site / "after", "--calibrations", site / "calibrations")
    assert before["fixes"] > 100
    assert after["fixes"] > 100
    assert after["rmse_m"] < before["rmse_m"] / 5
    # Of one flight: its mean over many is docs/calibration.md's.
    assert 0.1 < after["nees"] < 5


def test_a_calibration_of_another_station_is_refused(site, tmp_path):
    (tmp_path / "bravo").symlink_to(site / "calibrations" / "alfa")
    done = finished(
        *(BIN / "ols-sim", "--scenario", SCENARIO, "--seed", SEED, "--lockstep"),
        *("--pixels", "--seconds", 1, "--output", tmp_path / "out"),
        *("--calibrations", tmp_path),
    )
    assert done.returncode == 2
    assert "setup.toml:3: station: is 'alfa', this is 'bravo'" in done.stderr


def check_config(config):
    return finished(BIN / "ols-station", "--config", config, "--check-config")


def test_a_station_adopts_its_folder(site, tmp_path):
    config = tmp_path / "alfa.toml"
    text = (site / "round" / "alfa.toml").read_text()
    folder = site / "calibrations" / "alfa"
    config.write_text(text.replace("[calibration]", f'[calibration]\nfolder = "{folder}"'))
    done = check_config(config)
    assert done.returncode == 0, done.stderr
    assert "ok calibration: " in done.stdout
    config.write_text(text.replace("[calibration]", '[calibration]\nfolder = "/nowhere"'))
    done = check_config(config)
    assert done.returncode != 0
    assert "/nowhere/setup.toml" in done.stderr
