"""Files of ols-export as others' programs read them: live, of a log, of ols-fuse's positions."""

import json
import re
import subprocess
import xml.etree.ElementTree as ET

import gpxpy
import jsonschema
import lcm
import pytest
from conftest import BIN, GOLDEN_LOG, finished
from export_site import (
    GEOID_M,
    HEIGHT_M,
    LATITUDE_DEG,
    LONGITUDE_DEG,
    Exporter,
    Publisher,
    output,
    status,
    target,
    wait,
)

pytestmark = pytest.mark.usefixtures("network")
SEA_M = HEIGHT_M - GEOID_M
FIXES = (
    "utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,up_sd_m\n"
    f"1700000000000000,7,{LATITUDE_DEG},{LONGITUDE_DEG},{HEIGHT_M},2,3,5\n"
    f"1700000001000000,7,{LATITUDE_DEG},{LONGITUDE_DEG},{HEIGHT_M},2,3,5\n"
)

# What the format demands (COURAGEOUS 0.4.1), in our own words.
NUMBER = {"type": "number"}
POSITION = {
    "type": "object",
    "required": ["lat", "lon", "height_amsl"],
    "properties": {"lat": NUMBER, "lon": NUMBER, "height_amsl": NUMBER},
}
RECORD = {
    "type": "object",
    "required": ["alarm", "classification", "location", "record_number", "time"],
    "properties": {
        "alarm": {
            "required": ["active", "certainty"],
            "properties": {
                "active": {"type": "boolean"},
                "certainty": {"type": "number", "minimum": 0, "maximum": 1},
            },
        },
        "classification": {"enum": ["Unknown", "UAV", "GCS", "Other"]},
        "location": {
            "required": ["$type"],
            "properties": {"$type": {"enum": ["Position3d", "BearingElevation"]}},
        },
        "record_number": {"type": "integer", "minimum": 0},
        "time": {"type": "integer", "minimum": 0},
        "velocity": {"required": ["east", "north", "up"]},
    },
}
COURAGEOUS = {
    "type": "object",
    "required": [
        *("detection", "static_cuas_location", "system_name", "tracks", "vendor_name", "version")
    ],
    "properties": {
        "version": {"enum": ["0.4.1"]},
        "static_cuas_location": POSITION,
        "tracks": {
            "type": "array",
            "items": {
                "required": ["records", "uas_id"],
                "properties": {
                    "uas_id": {"type": "integer", "minimum": 0},
                    "records": {"type": "array", "items": RECORD},
                },
            },
        },
        "detection": {"type": "array", "items": {"required": ["records"]}},
    },
}
KML = "{http://www.opengis.net/kml/2.2}"
GX = "{http://www.google.com/kml/ext/2.2}"


def check_xml(path):
    done = subprocess.run(["xmllint", "--noout", path], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


def place_by_gdal(path, place, *layer):
    """What stands in the groups of `place` in what ogrinfo says; it complains about nothing."""
    done = finished("ogrinfo", "-ro", "-al" if not layer else "-q", path, *layer)
    assert (done.returncode, done.stderr) == (0, "")
    assert "Warning" not in done.stdout and "ERROR" not in done.stdout
    found = re.search(place, done.stdout, re.DOTALL)
    assert found, done.stdout
    return [float(number) for group in found.groups() for number in group.split()]


def check_geojson(path):
    place = place_by_gdal(path, r"kind \(String\) = target.*?POINT Z \(([^)]*)\)")
    assert place == pytest.approx([LONGITUDE_DEG, LATITUDE_DEG, HEIGHT_M], abs=0.005)
    features = json.loads(path.read_text())["features"]
    here = next(f for f in features if f["properties"]["kind"] == "target")
    assert here["geometry"]["coordinates"] == pytest.approx(
        [LONGITUDE_DEG, LATITUDE_DEG, HEIGHT_M], abs=0.005
    )
    assert here["properties"]["height_above_sea_m"] == pytest.approx(SEA_M, abs=0.02)


def check_kml(path):
    check_xml(path)
    place = place_by_gdal(path, r"Name \(String\) = OLS 7.*?(?:LINESTRING|POINT) Z \(([^,)]*)")
    assert place == pytest.approx([LONGITUDE_DEG, LATITUDE_DEG, SEA_M], abs=0.02)
    coordinates = ET.parse(path).getroot().find(f".//{GX}coord").text.split()
    assert [float(c) for c in coordinates] == pytest.approx(
        [LONGITUDE_DEG, LATITUDE_DEG, SEA_M], abs=0.02
    )
    modes = {mode.text for mode in ET.parse(path).getroot().iter(f"{KML}altitudeMode")}
    assert modes == {"absolute"}


def check_gpx(path):
    check_xml(path)
    place = place_by_gdal(path, r"ele \(Real\) = (\S+).*?POINT \(([^)]*)\)", "track_points")
    assert place == pytest.approx([SEA_M, LONGITUDE_DEG, LATITUDE_DEG], abs=0.02)
    point = gpxpy.parse(path.read_text()).tracks[0].segments[0].points[0]
    assert (point.latitude, point.longitude) == pytest.approx(
        (LATITUDE_DEG, LONGITUDE_DEG), abs=1e-8
    )
    assert point.elevation == pytest.approx(SEA_M, abs=0.02)
    assert point.geoid_height == pytest.approx(GEOID_M, abs=0.02)


def check_courageous(path):
    document = json.loads(path.read_text())
    jsonschema.validate(document, COURAGEOUS)
    place = document["tracks"][0]["records"][0]["location"]
    assert place["height_amsl"] == pytest.approx(SEA_M, abs=0.02)
    assert (place["lat"], place["lon"]) == (LATITUDE_DEG, LONGITUDE_DEG)


CHECKS = {
    "geojson": check_geojson,
    "kml": check_kml,
    "gpx": check_gpx,
    "courageous": check_courageous,
}


def export(*arguments):
    return finished(BIN / "ols-export", *arguments)


def test_the_geoid_is_far_from_the_ellipsoid():
    assert 40 < GEOID_M < 55


def test_live_files_are_whole_and_right(tmp_path):
    outputs = "".join(
        output(kind, kind, f"file://{tmp_path}/site.{kind}", rate_hz=10.0) for kind in CHECKS
    )
    publisher = Publisher()
    with Exporter(tmp_path, outputs):
        files = {kind: tmp_path / f"site.{kind}" for kind in CHECKS}
        link = ET.fromstring(
            wait(lambda: files["kml"].exists() and files["kml"].read_text(), "the link")
        )
        assert link.find(f".//{KML}href").text == "site-live.kml"
        files["kml"] = tmp_path / "site-live.kml"
        publisher.until(
            lambda: (
                all(f.exists() and "OLS 7" in f.read_text() for f in list(files.values())[:3])
                and files["courageous"].exists()  # not before a station is heard
                and "brno.target" in files["courageous"].read_text()
            ),
            "the target in each file",
        )
        for kind, path in files.items():
            CHECKS[kind](path)


@pytest.mark.parametrize("kind", CHECKS)
def test_positions_of_ols_fuse(tmp_path, kind):
    fixes, made = tmp_path / "fixes.csv", tmp_path / f"made.{kind}"
    fixes.write_text(FIXES)
    config = tmp_path / "export.toml"
    config.write_text(
        "[courageous]\nlatitude_deg = 49.0\nlongitude_deg = 16.0\nheight_above_sea_m = 230\n"
    )
    arguments = ("--config", config, "--fixes", fixes, "--format", kind, "--output", made)
    done = export(*arguments)
    assert done.returncode == 0, done.stderr
    assert "2 positions" in done.stderr
    CHECKS[kind](made)


@pytest.fixture(name="log")
def fixture_log(tmp_path):
    path = tmp_path / "site.lcmlog"
    log = lcm.EventLog(str(path), "w")
    for i in range(100):
        utime = 1_700_000_000_000_000 + i * 66_667
        log.write_event(utime, "OLS_STATUS_alfa", status(utime=utime).encode())
        log.write_event(utime, "OLS_TARGET", target(utime=utime).encode())
    log.close()
    return path


@pytest.mark.parametrize("kind", CHECKS)
def test_a_log(tmp_path, log, kind):
    made = tmp_path / f"made.{kind}"
    done = export("--log", log, "--format", kind, "--output", made)
    assert done.returncode == 0, done.stderr
    assert "100 positions, 100 places of stations" in done.stderr
    CHECKS[kind](made)


@pytest.mark.parametrize("kind", CHECKS)
def test_a_log_of_former_messages(tmp_path, kind):
    made = tmp_path / f"made.{kind}"
    done = export("--log", GOLDEN_LOG, "--format", kind, "--output", made)
    assert done.returncode == 0, done.stderr
    assert "22 positions, 8 places of stations" in done.stderr


def test_a_log_at_a_lower_rate(tmp_path, log):
    made = tmp_path / "made.gpx"
    done = export("--log", log, "--format", "gpx", "--output", made, "--rate", 1, "--no-stations")
    assert done.returncode == 0, done.stderr
    gpx = gpxpy.parse(made.read_text())
    assert 6 <= gpx.get_points_no() <= 9 and gpx.waypoints == []


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--format", "gpx", "--output", "a"), "--log or --fixes"),
        (("--fixes", "/no/such", "--format", "gpx", "--output", "a"), "/no/such"),
        (("--log", "/no/such", "--format", "gpx", "--output", "a"), "/no/such"),
        (("--log", "/no/such", "--format", "doc", "--output", "a"), "is not a format"),
        (("--log", "/no/such", "--format", "mqtt", "--output", "a"), "makes no file"),
    ],
)
def test_bad_input_is_one_line(tmp_path, arguments, said):
    done = finished(BIN / "ols-export", *arguments, cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert said in done.stderr and len(done.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []
