"""What `ols-calibrate adjust` refuses: named by file, line and key, with nothing written."""

import json

import numpy as np
import pytest
from calibrate_run import SEED, Run
from ols_calibration import cases


@pytest.fixture(name="run")
def fixture_run(tmp_path):
    print(f"seed {SEED}")
    return Run(tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"landmark"', '"lighthouse"', "kind: 'lighthouse' is not known"),
        ('"landmark0"', '"nowhere"', "reference: 'nowhere' is not one of the references"),
        ('"landmark0"', "null", "reference: is missing"),
        ('"pose"', '"position"', "position: is not known"),
        ("{", "", "line: is not JSON"),
        ('"sd_px": 0.5', '"sd_px": "a"', "sd_px: is not a number"),
        ('"sd_px": 0.5', '"sd_px": 0', "sd_px: 0 is outside 0.0001 .. 1000"),
        ('"approach_pan": 1', '"approach_pan": 0', "approach_pan: must be 1 or"),
    ],
)
def test_a_bad_line_is_named_with_its_key(run, old, new, said):
    run.change("observations.jsonl", 2, old, new)
    error = run.refused()
    assert f"observations.jsonl:2: {said}" in error
    assert len(error.splitlines()) == 1


def test_too_few_stars_without_a_name_are_refused(run):
    line = run.observations()[1]
    line |= {"kind": "star", "reference": None, "utime_us": 1_780_000_000_000_000}
    run.observe([*run.observations(), line])
    error = run.refused()
    assert "its stars cannot be identified: 1 detections are too few" in error


LOW = "degrees high: below 10 the refraction is not known well enough"
HIDDEN = "degrees below the horizon: are the signs of the position and the time right?"


@pytest.mark.parametrize(
    ("kind", "reference", "latitude", "said"),
    [
        ("star", "HIP 11767", "5", "'HIP 11767' stands 5 " + LOW),
        ("star", "HIP 11767", "-49", "'HIP 11767' stands 50 " + HIDDEN),
        ("sun", None, "49", HIDDEN),
    ],
    ids=["low", "wrong-hemisphere", "night"],
)
def test_what_stands_too_low_for_its_refraction_is_refused(run, kind, reference, latitude, said):
    """Polaris, and the sun at midnight."""
    text = (run.folder / "alfa.toml").read_text()
    text = text.replace("latitude_deg = 49", f"latitude_deg = {latitude}")
    (run.folder / "alfa.toml").write_text(text)
    line = run.observations()[1]
    line |= {"kind": kind, "reference": reference, "utime_us": 1_780_009_200_000_000}
    run.observe([line])
    error = run.refused()
    assert "observations.jsonl:1: reference: " in error
    assert said in error


@pytest.mark.parametrize(
    ("key", "value"), [("pose", 1.5), ("utime_us", 1e16), ("pose", "one"), ("pose", 1e300)]
)
def test_a_number_that_is_not_whole_is_refused(run, key, value):
    line = run.observations()[1] | {key: value}
    run.observe([line])
    error = run.refused()
    assert f"observations.jsonl:1: {key}: is not a whole number within 9e15" in error


def test_a_whole_number_may_have_a_point(run):
    lines = run.observations()
    lines = [line | {"pose": float(n), "utime_us": 1.78e15} for n, line in enumerate(lines)]
    run.observe(lines)
    run.adjusted()


def test_a_refusal_names_the_file_of_its_own_observation(run):
    lines = run.lines("observations.jsonl")
    second = json.loads(lines[2]) | {"reference": "nowhere"}
    (run.folder / "second.jsonl").write_text("\n" + "\n" + json.dumps(second) + "\n")
    error = run.refused("--observations", run.folder / "second.jsonl")
    assert "second.jsonl:3: reference: 'nowhere' is not one of the references" in error


def test_a_pose_at_two_places_names_both_lines(run):
    line = run.observations()[4] | {"pose": 77}
    other = line | {"pan_counts": line["pan_counts"] + 3}
    run.observe([*run.observations(), line, other])
    error = run.refused()
    count = len(run.lines("observations.jsonl"))
    assert f"observations.jsonl:{count}: pose: 77 is another stop already" in error
    assert f"observations.jsonl:{count - 1})" in error


@pytest.mark.parametrize("serial", ["a\\\\b", 'a\\"b', "a\\nb"])
def test_a_serial_number_that_no_file_gives_back_is_refused(run, serial):
    with (run.folder / "alfa-instrument.toml").open("a") as file:
        file.write(f'[serials]\nptu = "{serial}"\n')
    error = run.refused()
    assert "alfa-instrument.toml: serials.ptu: has a quote, a backslash or a control" in error


@pytest.mark.parametrize(
    ("section", "key"), [("unit", "angle_sd_deg"), ("values", "focal_px"), ("values", "aspect")]
)
def test_a_size_of_nothing_is_refused(run, section, key):
    text = (run.folder / "alfa-instrument.toml").read_text()
    lines = [line for line in text.splitlines() if not line.startswith(key + " ")]
    sd = text.split("[sd]")[1]
    lines.insert(lines.index(f"[{section}]") + 1, f"{key} = 0.0")
    text = "\n".join(lines).split("[sd]")[0] + "[sd]" + sd
    (run.folder / "alfa-instrument.toml").write_text(text)
    error = run.refused()
    assert f"{key}: 0" in error


def test_a_landmark_of_another_zone_is_refused(run):
    run.change("references.csv", 2, "landmark0,49.", "landmark0,39.")
    error = run.refused()
    assert "observations.jsonl:2: reference: 'landmark0' is 111" in error
    assert "km from the station" in error


def test_a_covariance_of_another_system_is_the_same(run):
    run.adjusted()
    ids = []
    for ending in ("\n", "\r\n"):
        text = ending.join(run.lines("out/covariance.csv")) + ending
        (run.folder / "out/covariance.csv").write_bytes(text.encode())
        run.arguments[run.arguments.index("--instrument") + 1] = run.folder / "out/instrument.toml"
        run.output = run.folder / f"again{len(ids)}"
        run.adjusted()
        ids.append(run.report()["stations"][0]["calibration_id"])
    assert ids[0] == ids[1]


def test_serial_numbers_that_differ_are_refused(run):
    for name, serial in (("alfa.toml", "L-1"), ("alfa-instrument.toml", "L-2")):
        with (run.folder / name).open("a") as file:
            file.write(f'[serials]\nlens = "{serial}"\n')
    error = run.refused()
    assert "serials.lens: is of lens 'L-2', the station has 'L-1'" in error


def test_a_station_that_sights_itself_is_refused(tmp_path):
    run = Run(tmp_path, cases.other_stations)
    lines = run.lines("observations.jsonl")
    at = next(n for n, line in enumerate(lines, 1) if '"reference": "bravo"' in line)
    run.change("observations.jsonl", at, '"bravo"', f'"{json.loads(lines[at - 1])["station"]}"')
    error = run.refused()
    assert f"observations.jsonl:{at}: reference: the station sights itself" in error


def test_a_board_that_is_not_level_is_named(tmp_path):
    """Of two boards one leans by a tenth of a degree; nothing says which."""
    run = Run(tmp_path, cases.rectification)
    lines = run.observations()
    for one in [line for line in lines if line["kind"] == "level_line"]:
        leaning = one | {"reference": "leaning"}
        leaning["y2_px"] += np.radians(0.1) * (one["x2_px"] - one["x_px"])
        lines.append(leaning)
    run.observe(lines)
    error = run.refused()
    assert "level_line 'leaning'" in error
    assert "level_line 'board'" in error
