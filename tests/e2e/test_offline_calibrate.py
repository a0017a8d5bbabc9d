"""ols-calibrate as a surveyor meets it."""

import json
import resource
import subprocess
import tomllib

import numpy as np
import pytest
from conftest import BIN
from ols_calibration import cases
from ols_calibration.model import azimuth_elevation

SEED = 20260120
PREDICT = "pan_counts,tilt_counts,approach_pan,approach_tilt,x_px,y_px,utime_us\n"


class Run:
    """A simulated site's files in a folder, and ols-calibrate on them."""

    def __init__(self, folder, build=cases.rtk_landmarks):
        self.folder = folder
        self.site = build(np.random.default_rng(SEED))
        self.one = self.site.stations[0]
        self.output = folder / "out"
        self.arguments = self.site.write(folder, PREDICT + "1000,2000,1,-1,600,500,0\n")

    def lines(self, name):
        return (self.folder / name).read_text().splitlines()

    def change(self, name, line, old, new):
        """In one line of a file, counted from 1."""
        lines = self.lines(name)
        assert old in lines[line - 1]
        lines[line - 1] = lines[line - 1].replace(old, new, 1)
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def adjust(self, *more):
        command = [BIN / "ols-calibrate", "adjust", *self.arguments, "--output", self.output, *more]
        return subprocess.run(
            [str(part) for part in command], capture_output=True, text=True, check=False
        )

    def report(self):
        return json.loads((self.output / "report.json").read_text())

    def rejected(self):
        return [group["name"] for group in self.report()["groups"] if group.get("rejected")]


@pytest.fixture(name="run")
def fixture_run(tmp_path):
    print(f"seed {SEED}")
    return Run(tmp_path)


def test_the_folder_has_all_that_was_found(run):
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in run.output.iterdir()) == [
        *("covariance.csv", "instrument.toml", "predictions.csv"),
        *("report.html", "report.json", "setup.toml"),
    ]
    setup = tomllib.loads((run.output / "setup.toml").read_text())
    assert setup["calibration_id"] == run.report()["stations"][0]["calibration_id"] > 0
    heading = np.degrees(run.one.unit.heading)
    assert abs((setup["pose"]["heading_deg"] - heading + 180) % 360 - 180) < 60 / 3600
    assert run.rejected() == []
    assert "<svg" in (run.output / "report.html").read_text()


def test_a_prediction_is_the_direction_of_the_pixel(run):
    assert run.adjust().returncode == 0
    header, row = run.lines("out/predictions.csv")
    found = dict(zip(header.split(","), map(float, row.split(",")), strict=True))
    shafts = run.one.unit.shafts(1000, 2000, (1, -1))
    azimuth, elevation = np.degrees(azimuth_elevation(run.one.unit.look(shafts, (600, 500))))
    across = (found["azimuth_deg"] - azimuth) * np.cos(np.radians(elevation))
    assert abs(across) < 5 * np.sqrt(found["cross_cross_deg2"]) < 0.03
    off = found["elevation_deg"] - elevation
    assert abs(off) < 5 * np.sqrt(found["elevation_elevation_deg2"]) < 0.03


def test_the_same_input_has_the_same_id_and_another_one_another(run):
    ids = []
    for name in ("a", "b", "c"):
        run.output = run.folder / name
        if name == "c":
            run.change("observations.jsonl", 2, '"x_px": ', '"x_px": 0')
            line = json.loads(run.lines("observations.jsonl")[2])
            line["x_px"] += 0.01
            lines = run.lines("observations.jsonl")
            lines[1] = json.dumps(line)
            (run.folder / "observations.jsonl").write_text("\n".join(lines) + "\n")
        assert run.adjust().returncode == 0
        ids.append(run.report()["stations"][0]["calibration_id"])
    assert ids[0] == ids[1] != ids[2]


def test_the_instrument_found_is_the_next_ones_prior(run):
    assert run.adjust().returncode == 0
    first = run.report()["stations"][0]
    at = run.arguments.index("--instrument") + 1
    run.arguments[at] = run.output / "instrument.toml"
    run.output = run.folder / "again"
    assert run.adjust().returncode == 0
    second = run.report()["stations"][0]
    assert second["systematic_rms_arcsec"] < first["systematic_rms_arcsec"]
    before = {one["parameter"]: one for one in second["parameters"]}["mount_z_deg"]["prior_sd"]
    after = {one["parameter"]: one for one in first["parameters"]}["mount_z_deg"]["sd"]
    assert before == pytest.approx(after, rel=1e-6)


def test_a_landmark_that_is_wrong_by_a_metre_is_named(tmp_path):
    run = Run(tmp_path, cases.wrong_landmark)
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    assert run.rejected() == ["landmark0"]
    assert "landmark 'landmark0' is rejected as mistaken" in done.stderr


def test_one_landmark_alone_is_said_to_be_unchecked(run):
    lines = [line for line in run.lines("observations.jsonl") if "landmark0" in line]
    (run.folder / "observations.jsonl").write_text("\n".join(lines) + "\n")
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    assert "landmark 'landmark0' is the only reference: nothing checks it" in done.stderr
    [group] = run.report()["groups"]
    assert group["detectable_across_arcsec"] is None


def test_landmarks_that_were_exchanged_are_named(run):
    text = (run.folder / "observations.jsonl").read_text()
    for old, new in (("landmark1", "x"), ("landmark3", "landmark1"), ("x", "landmark3")):
        text = text.replace(f'"reference": "{old}"', f'"reference": "{new}"')
    (run.folder / "observations.jsonl").write_text(text)
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    assert "landmarks 'landmark1' and 'landmark3' seem to be exchanged" in done.stderr


BAD_LINES = [
    ("kind", '"landmark"', '"lighthouse"', "kind: 'lighthouse' is not known"),
    ("reference", '"landmark0"', '"nowhere"', "reference: 'nowhere' is not one of the references"),
    ("reference", '"landmark0"', "null", "reference: is missing"),
    ("unknown", '"pose"', '"position"', "position: is not known"),
    ("json", "{", "", "line: is not JSON"),
    ("pixel", '"x_px": ', '"x_px": "a", "y_px": ', "x_px: is not a number"),
    ("deviation", '"sd_px": 0.5', '"sd_px": 0', "sd_px: 0 is outside 0.0001 .. 1000"),
    ("approach", '"approach_pan": ', '"approach_pan": 0, "pose": ', "approach_pan: must be 1 or"),
    ("huge", '"sd_px": 0.5', '"sd_px": 1e999', "line: is not JSON"),
]


@pytest.mark.parametrize(
    ("old", "new", "said"), [case[1:] for case in BAD_LINES], ids=[case[0] for case in BAD_LINES]
)
def test_a_bad_line_is_named_with_its_key(run, old, new, said):
    run.change("observations.jsonl", 2, old, new)
    done = run.adjust()
    assert done.returncode == 2
    assert f"observations.jsonl:2: {said}" in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert not run.output.exists()


def test_a_star_without_a_name_is_refused(run):
    line = json.loads(run.lines("observations.jsonl")[1])
    line |= {"kind": "star", "reference": None, "utime_us": 1_780_000_000_000_000}
    with (run.folder / "observations.jsonl").open("a") as file:
        file.write(json.dumps(line) + "\n")
    done = run.adjust()
    assert done.returncode == 2
    assert "22: reference: a star without a name cannot be used" in done.stderr


def test_a_landmark_of_another_zone_is_refused(run):
    run.change("references.csv", 2, "landmark0,49.", "landmark0,39.")
    done = run.adjust()
    assert done.returncode == 2
    assert "observations.jsonl:2: reference: 'landmark0' is 111" in done.stderr
    assert "km from the station" in done.stderr


def test_without_an_instrument_the_unit_is_a_new_one(run):
    assert run.adjust().returncode == 0
    known = run.report()["stations"][0]["systematic_rms_arcsec"]
    at = run.arguments.index("--instrument")
    del run.arguments[at : at + 2]
    run.output = run.folder / "new"
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    assert run.report()["stations"][0]["systematic_rms_arcsec"] > 1.5 * known


def without_line(lines, start):
    return [line for line in lines if not line.startswith(start)]


def with_cell(lines, row, column, value):
    """One cell of a covariance, by the names of its row and column."""
    at = lines[0].split(",").index(column)
    cells = next(line for line in lines if line.startswith(row + ",")).split(",")
    cells[at] = value
    return [",".join(cells) if line.startswith(row + ",") else line for line in lines]


def without_column(lines, column):
    at = lines[0].split(",").index(column)
    return [",".join(line.split(",")[:at] + line.split(",")[at + 1 :]) for line in lines]


BAD_COVARIANCES = [
    ("empty", lambda lines: ["", ""], ":1: header: is missing"),
    (
        "column",
        lambda lines: without_column(lines, "focal_px"),
        ":1: focal_px: the column is missing",
    ),
    ("row", lambda lines: without_line(lines, "focal_px"), ":32: focal_px: the row is missing"),
    ("twice", lambda lines: [*lines, lines[1]], ":33: focal_px: the row appears twice"),
    ("short", lambda lines: [*lines, "aspect,1"], "row: too few or too many columns"),
    (
        "number",
        lambda lines: with_cell(lines, "focal_px", "focal_px", "1.5abc"),
        "focal_px: '1.5abc' is not a number",
    ),
    (
        "negative",
        lambda lines: with_cell(lines, "focal_px", "focal_px", "-1"),
        "focal_px: the variance is negative",
    ),
    (
        "zero",
        lambda lines: with_cell(lines, "focal_px", "focal_px", "0"),
        "focal_px: the variance is 0, and its covariances are not",
    ),
    (
        "asymmetric",
        lambda lines: with_cell(lines, "focal_px", "mount_z_deg", "1e-3"),
        ":8: focal_px: is not symmetric",
    ),
    (
        "indefinite",
        lambda lines: with_cell(
            with_cell(lines, "focal_px", "mount_z_deg", "1"), "mount_z_deg", "focal_px", "1"
        ),
        ":1: header: the matrix is not positive definite",
    ),
]


@pytest.mark.parametrize(
    ("change", "said"),
    [case[1:] for case in BAD_COVARIANCES],
    ids=[case[0] for case in BAD_COVARIANCES],
)
def test_a_bad_covariance_is_named_with_its_line(run, change, said):
    assert run.adjust().returncode == 0
    lines = change(run.lines("out/covariance.csv"))
    (run.output / "covariance.csv").write_text("\n".join(lines) + "\n")
    run.arguments[run.arguments.index("--instrument") + 1] = run.output / "instrument.toml"
    run.output = run.folder / "again"
    done = run.adjust()
    assert done.returncode == 2
    assert "covariance.csv:" in done.stderr
    assert said in done.stderr
    assert not run.output.exists()


def test_a_covariance_of_another_system_is_the_same(run):
    assert run.adjust().returncode == 0
    ids = []
    for ending in ("\n", "\r\n"):
        text = ending.join(run.lines("out/covariance.csv")) + ending
        (run.folder / "out/covariance.csv").write_bytes(text.encode())
        run.arguments[run.arguments.index("--instrument") + 1] = run.folder / "out/instrument.toml"
        run.output = run.folder / f"again{len(ids)}"
        done = run.adjust()
        assert done.returncode == 0, done.stderr
        ids.append(run.report()["stations"][0]["calibration_id"])
    assert ids[0] == ids[1]


def test_serial_numbers_that_differ_are_refused(run):
    for name, serial in (("alfa.toml", "L-1"), ("alfa-instrument.toml", "L-2")):
        with (run.folder / name).open("a") as file:
            file.write(f'[serials]\nlens = "{serial}"\n')
    done = run.adjust()
    assert done.returncode == 2
    assert "serials.lens: is of lens 'L-2', the station has 'L-1'" in done.stderr
    assert not run.output.exists()


def test_a_calibration_is_never_overwritten(run):
    assert run.adjust().returncode == 0
    before = {path.name: path.read_bytes() for path in run.output.iterdir()}
    done = run.adjust()
    assert done.returncode == 2
    assert "is not empty: a calibration is never overwritten" in done.stderr
    assert before == {path.name: path.read_bytes() for path in run.output.iterdir()}
    run.output = run.folder / "references.csv"
    assert "--output" in run.adjust().stderr


def test_an_output_without_a_name_is_refused(run):
    before = sorted(run.folder.iterdir())
    run.output = ""
    done = run.adjust()
    assert done.returncode == 2
    assert "--output: is empty" in done.stderr
    assert before == sorted(run.folder.iterdir())


def test_a_slash_at_the_end_of_the_output_says_nothing(run):
    run.output.mkdir()
    output, run.output = run.output, f"{run.output}/"
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    assert (output / "report.html").exists()
    assert not output.with_name("out.partial").exists()


def test_what_an_interrupted_run_has_left_is_not_overwritten(run):
    (run.folder / "out.partial").mkdir()
    done = run.adjust()
    assert done.returncode == 2
    assert "out.partial exists" in done.stderr


def test_a_disk_that_is_full_leaves_nothing(run):
    """The instrument still fits below the limit, the covariance does not."""
    before = sorted(run.folder.iterdir())
    command = [BIN / "ols-calibrate", "adjust", *run.arguments, "--output", run.output]
    done = subprocess.run(
        [str(part) for part in command],
        capture_output=True,
        text=True,
        check=False,
        restore_signals=False,  # of a file that grows too large: an error, not the end
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000)),
    )
    assert done.returncode == 2
    assert "covariance.csv" in done.stderr
    assert before == sorted(run.folder.iterdir())


def test_without_ut1_its_uncertainty_is_in_the_result(tmp_path):
    run = Run(tmp_path, cases.stars)
    assert run.adjust().returncode == 0
    stated = run.report()["stations"][0]["systematic_rms_arcsec"]
    at = run.arguments.index("--ut1-utc")
    del run.arguments[at : at + 2]
    run.output = run.folder / "without"
    done = run.adjust()
    assert done.returncode == 0
    assert "UT1 - UTC is not stated" in done.stderr
    assert run.report()["stations"][0]["systematic_rms_arcsec"] > stated + 0.4


def test_two_stations_are_one_network(tmp_path):
    run = Run(tmp_path, cases.joint_track)
    (tmp_path / "predict.csv").write_text(
        "station,pan_counts,tilt_counts,x_px,y_px\nbravo,0,0,1,2\nalfa,0,0,1,2\n"
    )
    done = run.adjust()
    assert done.returncode == 0, done.stderr
    report = run.report()
    assert [one["station"] for one in report["stations"]] == ["alfa", "bravo"]
    [difference] = report["heading_differences"]
    heading = {p["parameter"]: p["sd"] for p in report["stations"][0]["parameters"]}
    assert 0 < difference["sd_arcsec"] < 3600 * heading["heading_deg"]
    assert (run.output / "alfa/setup.toml").exists() and (run.output / "bravo/setup.toml").exists()
