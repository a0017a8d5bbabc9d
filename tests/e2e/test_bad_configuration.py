"""Every program refuses a bad configuration with one line, exit 2, before it touches a device."""

import subprocess

import pytest
from conftest import BIN, SCENARIO, finished, lines_said

GOOD = """\
id = "s1"
[pose]
latitude_deg = 49.2
longitude_deg = 16.6
height_m = 250.0
heading_deg = 0.0
[camera]
device = "127.0.0.99"
[ptu]
device = "/dev/null"
[lens]
fx_px = 13333.3
fy_px = 13333.3
[calibration.sd]
heading_deg = 0.1
mount_deg = 0.1
"""


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
        (
            "height_m = 250.0",
            "heigth_m = 250.0",
            5,
            "heigth_m: unknown key; did you mean height_m?",
        ),
        (
            "heading_deg = 0.0",
            "headign_deg = 0.0",
            6,
            "pose.headign_deg: unknown key; did you mean heading_deg?",
        ),
        ("[lens]", "[lense]", 11, "lense: unknown key; did you mean lens?"),
        ('id = "s1"', 'id = "s1"\nlcm_url = "udpm://239.255.76.67:7667?ttl=x"', 2, "lcm_url"),
        ("heading_deg = 0.0", "heading_deg = 0.0\nhaeding_deg = 1.0", 7, "haeding_deg"),
        ("latitude_deg = 49.2", "latitude_deg = 149.2", 3, "latitude_deg"),
        ("latitude_deg = 49.2", "latitude_deg = nan", 3, "latitude_deg"),
        ("longitude_deg = 16.6", "longitude_deg = 'east'", 4, "longitude_deg"),
        ('device = "/dev/null"', 'device = "/dev/null"\nbaud = 12', 11, "baud"),
        ('id = "s1"', 'id = "s 1"', 1, "id"),
        ('id = "s1"', 'id = "s1"\nlcm_url = "bogus://x"', 2, "lcm_url"),
        ('id = "s1"', 'id = "s1"\nlcm_url = "udpm://300.1.1.1:99"', 2, "lcm_url"),
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
