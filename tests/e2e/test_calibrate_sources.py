"""What `ols-calibrate` makes of a receiver of aircraft, and of pictures of boards."""

import json
import subprocess
import tomllib

from conftest import BIN


def aircraft(*arguments):
    command = [BIN / "ols-calibrate", "aircraft", *arguments]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)


def test_what_a_receiver_has_heard_becomes_references(tmp_path):
    inputs = []
    for k in range(2):
        one = {"hex": "4ca2d6", "lat": 49.5 + k / 100, "lon": 16.25, "alt_geom": 33000}
        low = {"hex": "4ca2d7", "lat": 49.5, "lon": 16.25, "alt_baro": 33000, "seen_pos": 0.1}
        text = {"now": 1_780_000_010 + k, "aircraft": [one | {"seen_pos": 0.5}, low]}
        path = tmp_path / f"aircraft{k}.json"
        path.write_text(json.dumps(text))
        inputs += ["--input", path]
    output = tmp_path / "references.csv"
    done = aircraft(*inputs, "--format", "json", "--output", output)
    assert done.returncode == 0, done.stderr
    assert "2 positions have a barometric height alone" in done.stderr
    assert output.read_text().splitlines()[1:] == [
        "4ca2d6,49.5000000,16.2500000,10058.4,10.0,1780000009500000",
        "4ca2d6,49.5100000,16.2500000,10058.4,10.0,1780000010500000",
    ]
    assert "is not overwritten" in aircraft(*inputs, "--format", "json", "--output", output).stderr


def test_barometric_heights_are_refused_in_words(tmp_path):
    (tmp_path / "log").write_text("")
    done = aircraft("--input", tmp_path / "log", "--format", "sbs", "--output", tmp_path / "x")
    assert done.returncode == 2
    assert "its heights are barometric" in done.stderr


def test_a_camera_from_chessboards(shared, tmp_path):
    """Against OpenCV's own fit with the same corner window, within its standard errors."""
    data = shared / "data/calibration/opencv_chessboard"
    measured = json.loads((data / "reference.json").read_text())["measured"]
    expected = next(value for key, value in measured.items() if key.endswith("_5"))["left_free"]
    command = [BIN / "ols-calibrate", "camera", "--columns", "9", "--rows", "6", "--pictures"]
    command += [*sorted(data.glob("left*.jpg")), "--output", tmp_path / "camera"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = tomllib.loads((tmp_path / "camera/instrument.toml").read_text())
    values, sds = found["values"], found["sd"]
    for key, name in (("focal_px", "fx"), ("cx_px", "cx"), ("cy_px", "cy")):
        assert abs(values[key] - expected[name]) < 3 * sds[key] < 5, key
    assert abs(values["aspect"] - expected["fy"] / expected["fx"]) < 3 * sds["aspect"]
