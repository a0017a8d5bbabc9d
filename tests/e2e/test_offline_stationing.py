"""ols-stationing as a surveyor meets it."""

import math
import subprocess
import tomllib

import numpy as np
import ols
import pytest
from conftest import BIN, finished, lines_said
from ols_demo.places import geodetic

CONFIG = """\
id = "s1"
[pose]
latitude_deg = 49.2
longitude_deg = 16.6
height_m = 300.0
heading_deg = 40.0
level_sd_deg = 1.0
[calibration]
id = 4
[calibration.sd]
heading_deg = 2.0
mount_deg = 0.1
[camera]
device = "127.0.0.99"
[ptu]
device = "/dev/null"
[lens]
fx_px = 13333.3
fy_px = 13333.3
"""
PLACES = {
    "tower": (800.0, 300.0, 40.0),
    "spire": (-500.0, 900.0, 10.0),
    "mast": (-1500.0, -700.0, 90.0),
    "chimney": (200.0, -400.0, 5.0),
}
SITE = geodetic(49.2, 16.6, 300.0)


def truth():
    """As it stands: neither level nor turned as its configuration says."""
    station = ols.StationGeometry()
    station.position = SITE
    station.chain.heading_rad = math.radians(211.0)
    station.chain.tilt_x_rad = math.radians(0.4)
    station.chain.tilt_y_rad = math.radians(-0.3)
    station.camera.fx_px = station.camera.fy_px = 13333.3
    return station


def point(name):
    return ols.LocalFrame(SITE).to_ecef(np.array(PLACES[name]))


def row(name, utm):
    place = SITE if name == "mark" else ols.geodetic_from_ecef(point(name))
    end = f"{place.height_m:.4f},0.05"
    if not utm:
        degrees = math.degrees(place.latitude_rad), math.degrees(place.longitude_rad)
        return f"{name},{degrees[0]:.9f},{degrees[1]:.9f},,,,{end}"
    grid = ols.utm_from_geodetic(place).position
    return f"{name},,,{grid.zone}N,{grid.easting_m:.4f},{grid.northing_m:.4f},{end}"


@pytest.fixture
def survey(tmp_path):
    """The files, landmarks in both forms; one is sighted beside the optical axis."""
    header = "landmark,latitude_deg,longitude_deg,zone,easting_m,northing_m,height_m,sd_m"
    rows = [row(name, utm=i % 2 == 0) for i, name in enumerate([*PLACES, "mark"])]
    (tmp_path / "landmarks.csv").write_text("\n".join([header, *rows]) + "\n")
    sighted = ["landmark,pan_deg,tilt_deg,x_px,y_px"]
    for name in PLACES:
        pixel = np.array([700.0, 400.0]) if name == "spire" else None
        angles = ols.aim_at(truth(), point(name), pixel)
        degrees = math.degrees(angles.pan_rad), math.degrees(angles.tilt_rad)
        at = "700,400" if name == "spire" else ","
        sighted.append(f"{name},{degrees[0]:.6f},{degrees[1]:.6f},{at}")
    (tmp_path / "sightings.csv").write_text("\n".join(sighted) + "\n")
    (tmp_path / "station.toml").write_text(CONFIG)
    return tmp_path


def run(folder, *more):
    command = [BIN / "ols-stationing", "--station", folder / "station.toml"]
    command += ["--landmarks", folder / "landmarks.csv", "--sightings", folder / "sightings.csv"]
    command = [str(part) for part in (*command, *more)]
    return finished(*command)


def change(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_finds_heading_and_tilt(survey):
    result = run(survey)
    assert result.returncode == 0, result.stderr
    found = tomllib.loads(result.stdout)
    pose, sd = found["pose"], found["calibration"]["sd"]
    assert "latitude_deg" not in pose
    assert abs(pose["heading_deg"] - 211.0) < 0.05
    assert abs(pose["tilt_x_deg"] - 0.4) < 0.02 and abs(pose["tilt_y_deg"] + 0.3) < 0.02
    assert 0.001 < sd["heading_deg"] < 0.1 and 0.001 < sd["tilt_deg"] < 0.1
    assert found["calibration"]["id"] == 5
    assert "REJECTED as mistaken" not in result.stdout and "accepted" in result.stdout
    for name in PLACES:
        assert f"#   {name}: " in result.stdout


def test_improves_a_position_read_on_a_map(survey):
    change(survey / "station.toml", "latitude_deg = 49.2\n", "latitude_deg = 49.20003\n")
    change(survey / "station.toml", "mount_deg = 0.1", "mount_deg = 0.1\nposition_m = 3.0")
    assert "latitude_deg" not in tomllib.loads(run(survey).stdout)["pose"]
    found = tomllib.loads(run(survey, "--find-position").stdout)
    assert abs(found["pose"]["latitude_deg"] - 49.2) < 2e-6
    assert found["calibration"]["sd"]["position_m"] < 0.5


def test_is_what_a_station_reads(survey):
    """In the place of the configuration's own tables; the position is that of the mark."""
    output = survey / "found.toml"
    assert run(survey, "--at", "mark", "--output", output).returncode == 0
    pose = tomllib.loads(output.read_text())["pose"]
    assert abs(pose["latitude_deg"] - 49.2) < 1e-7 and abs(pose["longitude_deg"] - 16.6) < 1e-7
    assert abs(pose["height_m"] - 300.0) < 1e-3
    others = CONFIG[CONFIG.index("[camera]") :]
    (survey / "new.toml").write_text(f'id = "s1"\n{output.read_text()}\n{others}')
    checked = finished(BIN / "ols-station", "--check-config", "--config", survey / "new.toml")
    assert checked.returncode == 0, checked.stderr
    assert f"heading {pose['heading_deg']:.3f} deg" in checked.stdout


def test_changes_the_configuration_in_place(survey):
    """The values alone: comments, order and all other tables stay; the old file is kept."""
    old = CONFIG.replace("heading_deg = 40.0", "heading_deg = 40.0  # by compass").replace(
        "[camera]", "# beside the ladder\n[camera]"
    )
    target = survey / "real.toml"
    target.write_text(old)
    (survey / "station.toml").unlink()
    (survey / "station.toml").symlink_to("real.toml")
    for copy in ("station.toml.old", "station.toml.old-2"):
        before = target.read_text()
        result = run(survey, "--at", "mark", "--in-place")
        assert result.returncode == 0 and copy in result.stderr
        assert (survey / copy).read_text() == before
    text, found = target.read_text(), tomllib.loads(result.stdout)
    assert "  # by compass\n" in text and "# beside the ladder\n[camera]\n" in text
    merged = tomllib.loads(text)
    assert merged["calibration"]["id"] == 6
    for table in ("pose", "chain", "calibration"):
        for key, value in found[table].items():
            assert merged[table][key] == value
    others = tomllib.loads(old)
    for table in ("camera", "ptu", "lens"):
        assert merged[table] == others[table]
    assert merged["pose"]["level_sd_deg"] == 1.0
    command = [str(BIN / "ols-station"), "--check-config", "--config", str(target)]
    assert subprocess.run(command, capture_output=True, timeout=60, check=False).returncode == 0
    assert run(survey, "--in-place", "--output", survey / "x.toml").returncode == 2


def mistake(survey, *names):
    """Each of them was taken for something 10 degrees and more beside it."""
    for i, name in enumerate(names):
        pan_deg = math.degrees(ols.aim_at(truth(), point(name)).pan_rad)
        change(survey / "sightings.csv", f"{name},{pan_deg:.6f}", f"{name},{pan_deg + 10 + 7 * i}")


def test_sets_a_mistaken_landmark_aside_by_name(survey):
    mistake(survey, "mast")
    result = run(survey)
    assert result.returncode == 0, result.stderr
    (said,) = [line for line in result.stdout.splitlines() if "REJECTED as mistaken" in line]
    assert said.startswith("#   mast: w ") and "(line 4)" in said
    assert "deg across" in said and "detectable: " in said
    assert "sightings.csv:4: landmark: 'mast' is rejected as mistaken" in result.stderr
    found = tomllib.loads(result.stdout)
    assert abs(found["pose"]["heading_deg"] - 211.0) < 0.05


def test_names_landmarks_that_contradict_each_other(survey):
    mistake(survey, "mast", "tower")
    result = run(survey, "--output", survey / "found.toml")
    assert result.returncode == 2 and not (survey / "found.toml").exists()
    (said,) = lines_said(result.stderr)
    assert "sightings.csv: the landmarks contradict each other: " in said
    assert "without tower (line 2), mast (line 4) on a heading of 211.0" in said


def test_scales_the_deviations_with_the_misfit(survey):
    """Pans that were read to half a degree and stated as a hundredth."""
    sd = tomllib.loads(run(survey).stdout)["calibration"]["sd"]
    text = (survey / "sightings.csv").read_text().splitlines()
    for i, off in enumerate((0.06, -0.05, 0.05, -0.06), 1):
        cells = text[i].split(",")
        text[i] = ",".join([cells[0], str(float(cells[1]) + off), *cells[2:]])
    (survey / "sightings.csv").write_text("\n".join(text) + "\n")
    result = run(survey)
    assert result.returncode == 0, result.stderr
    assert "Global test (5 %)" in result.stdout and "scaled up by" in result.stdout
    assert "REJECTED as mistaken" not in result.stdout
    scaled = tomllib.loads(result.stdout)["calibration"]["sd"]
    assert scaled["heading_deg"] > 2.0 * sd["heading_deg"]
    assert scaled["tilt_deg"] > 2.0 * sd["tilt_deg"]


def test_says_what_one_landmark_leaves_open(survey):
    lines = (survey / "sightings.csv").read_text().splitlines()
    (survey / "sightings.csv").write_text("\n".join(lines[:2]) + "\n")
    result = run(survey)
    assert result.returncode == 0, result.stderr
    for said in ("ONE LANDMARK ALONE", "nothing across", "NOT DETERMINED there"):
        assert said in result.stdout


@pytest.mark.parametrize(
    ("name", "old", "new", "where"),
    [
        ("landmarks.csv", ",33N,", ",33U,", "landmarks.csv:2: zone: '33U'"),
        (
            "landmarks.csv",
            "tower,,",
            "tower,49.2,",
            "landmarks.csv:2: zone: must be empty: latitude",
        ),
        ("landmarks.csv", "spire,", "tower,", "landmarks.csv:3: landmark: 'tower' appears twice"),
        ("sightings.csv", "mast,", "must,", "sightings.csv:4: landmark: 'must' is not one of"),
        ("sightings.csv", "mast,", "mark,", "sightings.csv:4: landmark: the station stands at it"),
        ("sightings.csv", ",700,400", ",700,", "sightings.csv:3: y_px: is empty"),
        ("landmarks.csv", ",33N,", ",32N,", "sightings.csv:2: landmark: 'tower' is 4"),
        (
            "station.toml",
            "id = 4",
            f"id = {2**63 - 1}",
            "station.toml:9: calibration.id: is the highest",
        ),
        ("station.toml", "heading_deg = 40.0", "haeding_deg = 1", "station.toml:6: "),
    ],
)
def test_refuses_bad_input_by_name(survey, name, old, new, where):
    change(survey / name, old, new)
    result = run(survey, "--at", "mark")
    assert result.returncode == 2
    assert result.stdout == ""
    said = lines_said(result.stderr)
    assert len(said) == 1 and where in said[0], said


def test_a_pixel_outside_of_the_lens_model_is_named(survey):
    change(survey / "station.toml", "fy_px = 13333.3", "fy_px = 13333.3\nk1 = -0.2")
    change(survey / "sightings.csv", ",700,400", ",700,90000")
    result = run(survey)
    assert result.returncode == 2
    assert "sightings.csv:3: x_px: 'spire' is outside of the lens model" in result.stderr


@pytest.mark.parametrize("option", ["--pixel-sd", "--angles-sd", "--highest"])
def test_refuses_options_that_are_no_number(survey, option):
    for value in ("nan", "inf"):
        result = run(survey, option, value)
        assert result.returncode == 2 and option in result.stderr, result.stderr


def test_says_where_the_place_is_missing(survey):
    """Neither surveyed nor at a landmark: a receiver's position is not in the configuration."""
    for key in ("latitude_deg = 49.2\n", "longitude_deg = 16.6\n", "height_m = 300.0\n"):
        change(survey / "station.toml", key, "")
    with (survey / "station.toml").open("a") as file:
        file.write('[gnss]\nhost = "127.0.0.1"\n')
    result = run(survey)
    assert result.returncode == 2 and "pose.latitude_deg: is needed" in result.stderr
    assert run(survey, "--at", "mark").returncode == 0
    result = run(survey, "--at", "nowhere")
    assert result.returncode == 2 and "--at: 'nowhere' is not in " in result.stderr
