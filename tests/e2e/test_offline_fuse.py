"""ols-fuse as its users meet it: good and bad files, and real recordings where there are some."""

import csv
import json
import math
import re
import subprocess
import sys

import numpy as np
import ols
import pytest
from conftest import BIN, finished, lines_said
from ols_demo.places import geodetic

STATIONS = """\
station,latitude_deg,longitude_deg,height_m
west,49.2,16.598,250
east,49.2,16.602,250
"""
BEARINGS = """\
utime_us,station,azimuth_deg,elevation_deg,sigma_deg
1600000000000000,west,45,10,0.01
1600000000000000,east,315,10,0.01
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "stations.csv").write_text(STATIONS)
    (tmp_path / "bearings.csv").write_text(BEARINGS)
    return tmp_path


def fuse(stations, bearings, output, *options):
    files = ("--stations", stations, "--bearings", bearings, "--output", output)
    return finished(BIN / "ols-fuse", *files, *options)


def fuse_in(folder, *options):
    files = (folder / name for name in ("stations.csv", "bearings.csv", "fixes.csv"))
    return fuse(*files, *options)


@pytest.mark.parametrize(
    "options",
    [
        ["--estimator", "filter"],
        ["--smooth"],
        ["--estimator", "least-squares"],
        ["--estimator", "paper"],
        ["--estimator", "paper", "--paper-pairs", "best-baseline", "--paper-halves"],
    ],
)
def test_a_symmetric_pair(folder, options):
    result = fuse_in(folder, *options)
    assert result.returncode == 0, result.stderr
    (fix,) = csv.DictReader((folder / "fixes.csv").open())
    assert fix["utime_us"] == "1600000000000000"
    assert float(fix["longitude_deg"]) == pytest.approx(16.6, abs=1e-6)
    # The stations are 291.5 m apart: the target is half of that north, at 206 m tan(10 deg).
    assert float(fix["latitude_deg"]) == pytest.approx(49.2 + 145.7 / 111_200, abs=2e-5)
    assert float(fix["height_m"]) == pytest.approx(250 + 36.3, abs=0.2)
    assert float(fix["up_sd_m"]) > 0
    assert (fix["residual"] == "") == ("paper" in options)
    assert result.stderr == ""


def test_targets_are_kept_apart(folder):
    header, first, second = BEARINGS.splitlines()
    rows = [header + ",target", first + ",a", second + ",a", first + ",b", second + ",b"]
    (folder / "bearings.csv").write_text("\n".join(rows))
    assert fuse_in(folder).returncode == 0
    assert [fix["target"] for fix in csv.DictReader((folder / "fixes.csv").open())] == ["a", "b"]


SITE = ols.LocalFrame(geodetic(49.2, 16.6, 250.0))
PLACES = {"a": (-200.0, 0.0, 0.0), "b": (200.0, 0.0, 2.0), "c": (0.0, 250.0, -1.0)}


def where(target, time_s):
    """Three targets, each at its own height; the first two cross in every station's view."""
    start, velocity = [
        ((-60.0, 40.0, 60.0), (12.0, 5.0, 0.5)),
        ((60.0, 60.0, 90.0), (-12.0, -4.0, -0.5)),
        ((0.0, 130.0, 130.0), (3.0, -11.0, 0.0)),
    ][target]
    return np.array(start) + time_s * np.array(velocity)


def anonymous_recording(folder, duration_s=8.0, rate_hz=25.0, noise_rad=3e-4):
    random = np.random.default_rng(19)
    stations, bearings = [STATIONS.splitlines()[0]], [BEARINGS.splitlines()[0]]
    cameras = {name: SITE.to_ecef(np.array(place)) for name, place in PLACES.items()}
    for name, camera in cameras.items():
        place = ols.geodetic_from_ecef(camera)
        latitude, longitude = math.degrees(place.latitude_rad), math.degrees(place.longitude_rad)
        stations.append(f"{name},{latitude:.9f},{longitude:.9f},{place.height_m:.4f}")
    for k in range(int(duration_s * rate_hz)):
        for i, (name, camera) in enumerate(cameras.items()):
            time_s = (k + i / 3) / rate_hz
            for target in random.permutation(3):
                line = ols.R_ecef_enu(camera).T @ (SITE.to_ecef(where(target, time_s)) - camera)
                direction = ols.azimuth_elevation_from_enu(line)
                elevation = direction.elevation_rad + random.normal(0.0, noise_rad)
                across = random.normal(0.0, noise_rad) / math.cos(direction.elevation_rad)
                bearings.append(
                    f"{1_600_000_000_000_000 + round(1e6 * time_s)},{name},"
                    f"{math.degrees(direction.azimuth_rad + across):.6f},"
                    f"{math.degrees(elevation):.6f},{math.degrees(noise_rad):.6f}"
                )
    (folder / "stations.csv").write_text("\n".join(stations))
    (folder / "bearings.csv").write_text("\n".join(bearings))


@pytest.mark.parametrize("options", [[], ["--smooth"], ["--estimator", "least-squares"]])
def test_several_targets_without_names_are_those_of_the_live_tracks(tmp_path, options):
    anonymous_recording(tmp_path)
    result = fuse_in(tmp_path, *options)
    assert result.returncode == 0, result.stderr
    followed, errors_m = {}, []
    for fix in csv.DictReader((tmp_path / "fixes.csv").open()):
        keys = ("latitude_deg", "longitude_deg", "height_m")
        place = geodetic(*(float(fix[key]) for key in keys))
        at = SITE.to_enu(ols.ecef_from_geodetic(place))
        time_s = 1e-6 * (int(fix["utime_us"]) - 1_600_000_000_000_000)
        off_m = [float(np.linalg.norm(at - where(target, time_s))) for target in range(3)]
        errors_m.append(min(off_m))
        followed.setdefault(fix["target"], []).append(int(np.argmin(off_m)))
    assert sorted(map(set, followed.values()), key=min) == [{0}, {1}, {2}]
    assert min(map(len, followed.values())) > 0.9 * 3 * 200
    assert np.percentile(errors_m, 95) < 0.5
    unused = re.search(r"(\d+) of 1800 bearings not used", result.stderr)
    assert unused is None or int(unused[1]) < 90


@pytest.mark.parametrize(
    ("name", "row", "expected"),
    [
        ("bearings.csv", "1600000000000000,south,45,10,0.01", "bearings.csv:4: station"),
        ("stations.csv", "north,149.2,16.6,250", "stations.csv:4: latitude_deg"),
    ],
)
def test_a_bad_row_is_named_and_nothing_is_written(folder, name, row, expected):
    (folder / "fixes.csv").write_text("what was there before\n")
    with (folder / name).open("a") as file:
        file.write(row + "\n")
    result = fuse_in(folder)
    assert result.returncode == 2
    assert len(lines_said(result.stderr)) == 1
    assert expected in result.stderr
    assert (folder / "fixes.csv").read_text() == "what was there before\n"
    assert len(list(folder.iterdir())) == 3


def test_tells_what_was_not_used(folder):
    header, first, second = BEARINGS.splitlines()
    rows = [header + ",belief", first + ",1", second + ",1", second + ",1", second + ",0.1"]
    (folder / "bearings.csv").write_text("\n".join(rows))
    result = fuse_in(folder)
    assert result.returncode == 0
    assert result.stderr == (
        "ols-fuse: 2 of 4 bearings not used: 1 of low belief, "
        "1 with an earlier bearing's station and time\n"
    )


@pytest.mark.parametrize("estimator", ["filter", "filter --smooth", "least-squares", "paper"])
@pytest.mark.parametrize(
    ("azimuth_deg", "why"), [(None, "bearing-only|too-few-rays"), (45, "parallel-rays")]
)
def test_says_why_there_is_no_position(folder, estimator, azimuth_deg, why):
    rows = [BEARINGS.splitlines()[0]]
    for i in range(60):
        rows.append(f"{1600000000000000 + 40000 * i},west,45,10,0.01")
        if azimuth_deg is not None:
            rows.append(f"{1600000000000000 + 40000 * i},east,{azimuth_deg},10,0.01")
    (folder / "bearings.csv").write_text("\n".join(rows))
    (folder / "fixes.csv").write_text("of an earlier run")
    result = fuse_in(folder, "--estimator", *estimator.split())
    assert result.returncode == 1
    assert "no position at all" in result.stderr
    assert (folder / "fixes.csv").read_text() == "of an earlier run"
    said = r"ols-fuse: target 1: no position at .*60 instants \((" + why + r")\)"
    assert re.search(said, result.stderr), result.stderr
    assert re.search(rf"ols-fuse: ({why}): .*(two stations|too close)", result.stderr)


def test_stations_that_are_exchanged_are_suspected(folder):
    lines = STATIONS.replace("west", "x").replace("east", "west").replace("x", "east")
    (folder / "stations.csv").write_text(lines)
    result = fuse_in(folder)
    assert result.returncode == 1
    assert "ols-fuse: behind-camera: the lines of sight meet behind a station: is" in result.stderr


def test_latitude_and_longitude_that_are_exchanged_are_named(folder):
    with (folder / "stations.csv").open("a") as file:
        file.write("south,16.6,49.197,250\n")
    (folder / "fixes.csv").write_text("of an earlier run")
    result = fuse_in(folder)
    assert result.returncode == 2
    said = r"stations.csv: south is 455\d km from the other stations: are latitude and longitude ex"
    assert re.search(said, result.stderr), result.stderr
    assert (folder / "fixes.csv").read_text() == "of an earlier run"


@pytest.mark.parametrize("sigma_deg", [0.01, 0.0001745])
def test_radians_are_told_from_degrees(folder, sigma_deg):
    """A target east of both stations that flies north; their headings are far from north."""
    rows = [BEARINGS.splitlines()[0]]
    for i in range(60):
        utime_us = 1600000000000000 + 100_000 * i
        for station, east_m in (("west", 1000), ("east", 708.5)):
            azimuth_rad = math.atan2(east_m, 20.0 * i / 10)
            elevation_rad = math.atan2(100, math.hypot(east_m, 20.0 * i / 10))
            rows.append(f"{utime_us},{station},{azimuth_rad:.9f},{elevation_rad:.9f},{sigma_deg}")
    (folder / "bearings.csv").write_text("\n".join(rows))
    result = fuse_in(folder)
    assert result.returncode == 2 and not (folder / "fixes.csv").exists()
    assert "bearings.csv: azimuth_deg, elevation_deg: these seem to be radians" in result.stderr


def test_small_angles_are_no_radians(folder):
    text = BEARINGS.replace("45,10", "3,1").replace("315,10", "-3,1")
    (folder / "bearings.csv").write_text(text)
    assert fuse_in(folder).returncode == 0


def test_bearings_without_rows(folder):
    (folder / "bearings.csv").write_text(BEARINGS.splitlines()[0] + "\n")
    result = fuse_in(folder)
    assert result.returncode == 2
    assert len(lines_said(result.stderr)) == 1
    assert "bearings.csv:2: row: the file has a header but no rows" in result.stderr


@pytest.mark.parametrize("rate", ["nan", "10000"])
def test_a_rate_without_an_end_is_refused(folder, rate):
    late = "1600003600000000,west,45,10,0.01\n"  # an hour later
    (folder / "bearings.csv").write_text(BEARINGS + late)
    result = fuse_in(folder, "--rate", rate)
    assert result.returncode == 2
    assert len(lines_said(result.stderr)) == 1
    assert not (folder / "fixes.csv").exists()


def test_bad_options_and_files(folder):
    assert fuse_in(folder, "--estimator", "guess").returncode == 2
    assert fuse_in(folder, "--rate", "-1").returncode == 2
    assert fuse_in(folder, "--estimator", "paper", "--smooth").returncode == 2
    assert fuse(folder / "no.csv", folder / "bearings.csv", folder / "f.csv").returncode == 2
    result = fuse(folder / "stations.csv", folder / "bearings.csv", folder / "no" / "f.csv")
    assert result.returncode == 2
    assert "f.csv" in result.stderr


@pytest.mark.parametrize(
    ("recording", "median_m", "p95_m", "least"),
    # The meteor's sigmas are stated too large, and a third of a second shows too little of that.
    [("drone4", 0.15, 0.5, 0.5), ("meteor_wmpl", 80.0, 150.0, 0.25)],
)
def test_real_recordings(shared, tmp_path, recording, median_m, p95_m, least):
    data = shared / "data/fusion" / recording
    fixes = tmp_path / "fixes.csv"
    result = fuse(data / "stations.csv", data / "bearings.csv", fixes)
    assert result.returncode == 0, result.stderr
    scorer = shared / "tools/score_fixes.py"
    files = [data / "truth.csv", fixes, data / "stations.csv"]
    command = [sys.executable, str(scorer), *map(str, files), "--json"]
    score = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    assert score["error_3d"]["median"] <= median_m
    assert score["error_3d"]["p95"] <= p95_m
    assert score["coverage"] >= 0.95
    for axis in ("east", "north", "up"):
        assert least < score["consistency"][axis] < 2.0
