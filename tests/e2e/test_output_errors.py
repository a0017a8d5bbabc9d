"""What a program prints must have arrived: a full disk under its standard output is an error."""

import json
import subprocess

import pytest
from conftest import BIN
from helpers import station_without_devices

PROGRAMS = sorted(path.name for path in BIN.glob("ols-*"))
AREA = [[16.6, 49.2], [16.61, 49.2], [16.61, 49.21], [16.6, 49.2]]


def run_into_full_disk(*command):
    words = [str(word) for word in (BIN / command[0], *command[1:])]
    with open("/dev/full", "w") as full:
        return subprocess.run(
            words, stdout=full, stderr=subprocess.PIPE, text=True, timeout=120, check=False
        )


def assert_told(result, program):
    assert result.returncode != 0
    assert f"{program}: standard output: " in result.stderr


# The benchmarking library prints the help of its programs, and does not look.
LIBRARYS_HELP = {"ols-bench-land-speed", "ols-bench-tracker-speed"}


@pytest.mark.parametrize("program", [name for name in PROGRAMS if name not in LIBRARYS_HELP])
def test_help_that_was_not_written_is_an_error(program):
    result = run_into_full_disk(program, "--help")
    assert result.returncode == 2
    assert_told(result, program)


def test_a_configuration_is_not_said_to_be_good_in_vain(tmp_path):
    config = tmp_path / "station.toml"
    config.write_text(station_without_devices("s1"))
    result = run_into_full_disk("ols-station", "--config", config, "--check-config")
    assert result.returncode != 0 and "standard output: " in result.stderr


def test_advice_that_was_not_written_is_an_error(tmp_path):
    area, places = tmp_path / "area.json", tmp_path / "places.json"
    area.write_text(json.dumps({"type": "Polygon", "coordinates": [AREA]}))
    places.write_text(json.dumps({"type": "MultiPoint", "coordinates": AREA[:3]}))
    result = run_into_full_disk(
        *("ols-precision", "advise", "--places", places, "--area", area, "--stations", 2),
        *("--ground", 250, "--spacing", 300, "--output", tmp_path / "out.csv"),
    )
    assert_told(result, "ols-precision")


def test_measures_that_were_not_written_are_an_error():
    result = run_into_full_disk("ols-bench-estimators", "paper", "--runs", 2)
    assert_told(result, "ols-bench-estimators")
