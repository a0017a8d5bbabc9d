"""Every program refuses a bad configuration with one line, exit 2, before it touches a device."""

import subprocess

import pytest
from conftest import BIN, SCENARIO, finished, lines_said
from helpers import station_without_devices

GOOD = station_without_devices("s1")


def run(program: str, *arguments: str) -> subprocess.CompletedProcess:
    return finished(BIN / program, *arguments)


def refused(result: subprocess.CompletedProcess, *parts: str) -> None:
    assert result.returncode == 2, result.stderr
    assert len(lines_said(result.stderr)) == 1, result.stderr
    for part in parts:
        assert part in result.stderr


def test_a_good_configuration_passes(tmp_path):
    config = tmp_path / "s.toml"
    config.write_text(GOOD)
    result = run("ols-station", "--check-config", "--config", str(config))
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize(
    ("old", "new", "line", "key"),
    [
        ("height_m", "heigth_m", 5, "heigth_m: unknown key; did you mean height_m?"),
        ("latitude_deg = 49.2", "latitude_deg = 149.2", 3, "latitude_deg"),
        ('id = "s1"', 'id = "s 1"', 1, "id"),
        ("[pose]", "[pose", 2, ""),
    ],
)
def test_station(tmp_path, old, new, line, key):
    config = tmp_path / "s.toml"
    config.write_text(GOOD.replace(old, new))
    result = run("ols-station", "--config", str(config))
    refused(result, f"{config}:{line}:", key)


def test_missing_files(tmp_path):
    missing = str(tmp_path / "none.toml")
    refused(run("ols-station", "--config", missing), missing)
    refused(run("ols-fusion", "--config", missing), missing)
    refused(run("ols-sim", "--scenario", missing), missing)


@pytest.mark.parametrize("program", ["ols-station", "ols-fusion", "ols-sim", "ols-ctl"])
def test_unknown_options(program):
    refused(run(program, "--no-such-option"), program)


def test_fusion_names_file_line_and_key(tmp_path):
    config = tmp_path / "f.toml"
    config.write_text("# fusion\nno_such_key = 1\n")
    refused(run("ols-fusion", "--config", str(config)), f"{config}:2:", "no_such_key")


@pytest.mark.parametrize("program", ["ols-fusion", "ols-console"])
def test_a_folder_without_land_is_named(tmp_path, program):
    config = tmp_path / "c.toml"
    config.write_text(f'[land]\nfolder = "{tmp_path}"\n')
    checked = run(program, "--check-config", "--config", str(config))
    refused(checked, f"{program}: [land] folder: ", f"{tmp_path}/land.json")


def test_a_stations_folder_without_land_is_named(tmp_path):
    """Only by the check: the station itself runs without it, and says so."""
    config = tmp_path / "s.toml"
    config.write_text(f'{GOOD}\n[land]\nfolder = "{tmp_path}"\n')
    checked = run("ols-station", "--check-config", "--config", str(config))
    refused(checked, "ols-station: [land] folder: ", f"{tmp_path}/land.json")
    (tmp_path / "land.json").write_text("{}")
    checked = run("ols-station", "--check-config", "--config", str(config))
    refused(checked, f"[land] folder: {tmp_path}/land.json: format: is missing")


@pytest.mark.parametrize("option", ["--lcm-url", "--slew-url"])
def test_fusion_checks_the_urls_of_its_command_line(option):
    url = "udpm://239.255.76.67:7667?ttl=x"
    refused(run("ols-fusion", "--check-config", option, url), option, "is not a ttl")


def test_scenario_names_file_line_and_key(tmp_path):
    scenario = tmp_path / "s.toml"
    scenario.write_text(SCENARIO.read_text().replace("frame_rate_hz", "frame_rate"))
    refused(run("ols-sim", "--scenario", str(scenario)), str(scenario), "frame_rate")


@pytest.mark.parametrize(
    ("option", "value"),
    [("--seconds", "nan"), ("--seconds", "inf"), ("--pixel-sd", "nan"), ("--seed", "-1")],
)
def test_simulator_refuses_absurd_numbers(tmp_path, option, value):
    output = tmp_path / "run"
    lockstep = ["--lockstep", "--pixels", "--output", str(output)]
    refused(run("ols-sim", "--scenario", str(SCENARIO), *lockstep, option, value), option)
    assert not output.exists()
