"""ols-precision as its users meet it."""

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
from conftest import BIN, finished, lines_said

ROOT = Path(__file__).resolve().parents[2]
TABLE1 = ROOT / "dev/python/ols_accuracy/table1.csv"
STATIONS = """\
station,latitude_deg,longitude_deg,height_m
west,49.2,16.598,250
east,49.2,16.602,250
north,49.203,16.6,250
"""


@pytest.fixture
def stations(tmp_path):
    path = tmp_path / "stations.csv"
    path.write_text(STATIONS)
    return path


def precision(*arguments):
    command = [str(part) for part in (BIN / "ols-precision", *arguments)]
    return finished(*command)


def rows(path):
    return list(csv.DictReader(path.open()))


def column(path, name):
    return np.array([float(row[name] or "nan") for row in rows(path)])


def test_table1_is_the_papers(tmp_path):
    """Every row within 8 %, the mean within 4 % of the paper's estimates."""
    output = tmp_path / "table.csv"
    assert precision("table", "--input", TABLE1, "--output", output).returncode == 0
    ratio = column(output, "estimated_m") / column(output, "paper_estimated_m")
    assert len(ratio) == 9
    assert np.all(np.abs(ratio - 1) <= 0.08)
    assert abs(ratio.mean() - 1) <= 0.04
    by_side = column(output, "estimated_by_side_m") / column(output, "paper_estimated_m")
    assert np.abs(by_side - 1).max() < 0.025 and np.abs(by_side - 1).mean() < 0.005


def test_figures(tmp_path):
    output = tmp_path / "figure.csv"
    assert precision("figure3", "--steps", 20, "--output", output).returncode == 0
    # B = D = 100 m at p = 10: 100 * 2 t / (1 - t) with t = 7.5e-4.
    row = next(r for r in rows(output) if r["base_m"] == "100" and r["distance_m"] == "100")
    assert float(row["rotating_pair_m"]) == pytest.approx(100 * 2 * 7.5e-4 / (1 - 7.5e-4))
    assert precision("figure4", "--steps", 40, "--output", output).returncode == 0
    two, three = column(output, "two_cameras_m"), column(output, "three_cameras_m")
    assert np.isnan(two).sum() > 0 and np.isnan(three).sum() == 0
    assert np.nanmedian(three) < np.nanmedian(two)


def test_map_of_a_site(stations, tmp_path):
    output, geojson = tmp_path / "map.csv", tmp_path / "map.geojson"
    options = ("--heights", "30,100", "--cells", 10, "--output", output, "--geojson", geojson)
    result = precision("map", "--stations", stations, *options)
    assert result.returncode == 0, result.stderr
    assert sorted({row["above_stations_m"] for row in rows(output)}) == ["100", "30"]
    features = json.loads(geojson.read_text())["features"]
    cells = [f for f in features if f["geometry"]["type"] == "Polygon"]
    assert len(cells) == len(rows(output)) and len(features) == len(cells) + 3
    assert all(f["properties"]["horizontal_m"] > 0 for f in cells)
    ring = cells[0]["geometry"]["coordinates"][0]
    assert ring[0] == ring[-1] and 16 < ring[0][0] < 17 and 49 < ring[0][1] < 50


def test_a_map_that_one_station_determines_nowhere_is_refused(stations, tmp_path):
    stations.write_text("\n".join(STATIONS.splitlines()[:2]) + "\n")
    output = tmp_path / "map.csv"
    result = precision("map", "--stations", stations, "--output", output)
    assert result.returncode == 2 and not output.exists()
    assert f"{stations}: the stations determine no position 50 m above them" in result.stderr


@pytest.mark.parametrize("middle_deg", [180.0, -180.0])
def test_map_across_the_date_line_is_cut_there(tmp_path, middle_deg):
    places = {"west": 179.998, "east": -179.998, "north": middle_deg}
    lines = [f"{name},49.2,{longitude},250" for name, longitude in places.items()]
    lines[-1] = lines[-1].replace("49.2,", "49.203,")
    stations, output = tmp_path / "stations.csv", tmp_path / "map.csv"
    stations.write_text("\n".join([STATIONS.splitlines()[0], *lines]) + "\n")
    geojson = tmp_path / "map.geojson"
    options = ("--cells", 9, "--output", output, "--geojson", geojson)
    result = precision("map", "--stations", stations, *options)
    assert result.returncode == 0, result.stderr
    cells = [f["geometry"] for f in json.loads(geojson.read_text())["features"]][3:]
    assert len(cells) == len(rows(output))
    assert {cell["type"] for cell in cells} == {"Polygon", "MultiPolygon"}
    area_m2 = 0.0
    for cell in cells:
        polygons = cell["coordinates"]
        for (ring,) in polygons if cell["type"] == "MultiPolygon" else [polygons]:
            east, north = np.array(ring).T
            assert ring[0] == ring[-1] and np.ptp(east) < 0.01 and np.abs(east).max() <= 180
            x, y = east * 72_870, (north - 49.2) * 111_220
            area_m2 += np.abs(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1])) / 2
    middle = [cell for cell in cells if cell["type"] == "Polygon"][0]["coordinates"][0]
    side_m = np.ptp(np.array(middle)[:, 1]) * 111_220
    assert area_m2 == pytest.approx(len(cells) * side_m**2, rel=0.01)


def test_budget_sums_to_the_whole(stations, tmp_path):
    output = tmp_path / "budget.csv"
    at = ("--at", "49.201,16.6,300", "--speed", 10)
    assert precision("budget", "--stations", stations, *at, "--output", output).returncode == 0
    parts = {row["source"]: float(row["horizontal_m"]) for row in rows(output)}
    whole = parts.pop("all")
    assert sum(part**2 for part in parts.values()) == pytest.approx(whole**2, rel=1e-4)
    assert min(parts.values()) > 0


def circle(radius_m, count):
    angles = 2 * np.pi * np.arange(count) / count
    east = 16.6 + radius_m * np.cos(angles) / 72_870
    return np.column_stack([east, 49.2 + radius_m * np.sin(angles) / 111_220])


def test_advice_is_the_regular_polygon_where_nothing_prevents_it(tmp_path):
    area, places, output = (tmp_path / n for n in ("area.geojson", "places.geojson", "out.csv"))
    ring = circle(300, 24).tolist()
    area.write_text(json.dumps({"type": "Polygon", "coordinates": [ring + ring[:1]]}))
    points = [*circle(300, 36).tolist(), *circle(400, 36).tolist()]
    places.write_text(json.dumps({"type": "MultiPoint", "coordinates": points}))
    result = precision(
        *("advise", "--places", places, "--area", area, "--stations", 4, "--ground", 250),
        *("--spacing", 60, "--heading-sd-deg", 0, "--tilt-sd-deg", 0, "--output", output),
    )
    assert result.returncode == 0, result.stderr
    east = (column(output, "longitude_deg") - 16.6) * 72_870
    north = (column(output, "latitude_deg") - 49.2) * 111_220
    np.testing.assert_allclose(np.hypot(east, north), 300, atol=2)
    angles = np.sort(np.degrees(np.arctan2(north, east)) % 360)
    np.testing.assert_allclose(np.diff(angles), 90, atol=10.5)
    assert "worst" in result.stdout


def test_advice_says_what_a_lone_station_leaves_open(stations, tmp_path):
    area, output = tmp_path / "area.geojson", tmp_path / "out.csv"
    ring = circle(300, 24).tolist()
    area.write_text(json.dumps({"type": "Polygon", "coordinates": [ring + ring[:1]]}))
    result = precision(
        *("advise", "--places", stations, "--area", area, "--stations", 1, "--ground", 250),
        *("--spacing", 60, "--output", output),
    )
    assert result.returncode == 0 and len(rows(output)) == 1
    assert "undetermined" in result.stdout and "e+" not in result.stdout


@pytest.fixture(scope="module", name="ridge")
def fixture_ridge(tmp_path_factory):
    """The folder of a level land at 250 m with a ridge of 150 m from north to south, at 16.6 E."""
    folder = tmp_path_factory.mktemp("ridge")
    step, half = 0.0005, 100  # degrees
    row = np.where(np.abs(np.arange(-half, half + 1)) <= 2, 400.0, 250.0)
    corner = f"xllcenter {16.6 - half * step}\nyllcenter {49.2 - half * step}\n"
    head = f"ncols {2 * half + 1}\nnrows {2 * half + 1}\n{corner}cellsize {step}\n"
    line = " ".join(f"{height:g}" for height in row)
    (folder / "ridge.asc").write_text(head + "\n".join([line] * (2 * half + 1)) + "\n")
    spheroid = 'DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]]'
    units = 'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]'
    (folder / "ridge.prj").write_text(f'GEOGCS["WGS 84",{spheroid},{units}]')
    command = [BIN / "ols-land", "import", "--site", "49.2,16.6", "--radius-km", 3, "--sd", 1]
    command += ["--elevation", folder / "ridge.asc", "--heights", "ellipsoid"]
    done = finished(*map(str, [*command, "--output", folder / "land"]))
    assert done.returncode == 0, done.stderr
    return folder / "land"


def test_a_ridge_hides_what_is_low_behind_it(ridge, tmp_path):
    """Two stations 1 km west of it, 2 m above the ground: shadows by similar triangles."""
    stations, output = tmp_path / "stations.csv", tmp_path / "coverage.csv"
    east = 16.6 - 1000 / 72_990
    lines = [f"{name},{49.2 + off},{east},252" for name, off in (("a", -0.002), ("b", 0.002))]
    stations.write_text("\n".join([STATIONS.splitlines()[0], *lines]) + "\n")
    files = ("--geojson", tmp_path / "c.geojson", "--geotiff", tmp_path / "c.tif")
    site = ("--stations", stations, "--land", ridge, "--reach", 1800)
    done = precision("coverage", *site, "--spacing", 60, *files, "--output", output)
    assert done.returncode == 0, done.stderr
    offset_m = (column(output, "longitude_deg") - 16.6) * 72_990
    near = np.abs(column(output, "latitude_deg") - 49.2) < 0.001
    two = column(output, "two_m")
    before, behind = near & (offset_m < -200), near & (offset_m > 250)
    assert np.abs(two[before]).max() < 3
    shadow_m = 148 * (1000 + offset_m) / 1000 + 2  # over the ridge's crest
    assert np.abs(two[behind] / shadow_m[behind] - 1).max() < 0.1
    assert np.isnan(column(output, "error_30_m")[behind]).all()
    assert np.isfinite(column(output, "error_300_m")[behind & (offset_m < 700)]).all()
    features = json.loads(files[1].read_text())["features"]
    assert [f["properties"].get("above_ground_m") for f in features[2:]] == [10, 30, 100, 300]
    assert "seen by one" in done.stdout and files[3].stat().st_size > 1000

    diagram = tmp_path / "vertical.csv"
    options = (*site, "--azimuths", "90", "--output", diagram)
    assert precision("vertical", *options).returncode == 0
    lowest, distance = column(diagram, "lowest_m"), column(diagram, "distance_m")
    assert lowest[distance == 1500][0] == pytest.approx(252 + 148 * 1.5, rel=0.05)
    for kind, source in (("coverage", output), ("vertical", diagram)):
        picture = tmp_path / f"{kind}.png"
        plot = finished(str(ROOT / "tools/precision-plot"), kind, str(source), str(picture))
        assert plot.returncode == 0, plot.stderr
        assert picture.stat().st_size > 5_000


def test_advice_stands_where_the_ridge_leaves_the_area_in_sight(ridge, tmp_path):
    area, places, output = (tmp_path / n for n in ("area.geojson", "places.geojson", "out.csv"))
    corners = [[16.602, 49.197], [16.612, 49.197], [16.612, 49.203], [16.602, 49.203]]
    area.write_text(json.dumps({"type": "Polygon", "coordinates": [corners + corners[:1]]}))
    west = [[16.586, 49.198], [16.586, 49.202]]
    points = [*west, [16.617, 49.198], [16.6165, 49.203]]
    places.write_text(json.dumps({"type": "MultiPoint", "coordinates": points}))
    options = ("--places", places, "--area", area, "--stations", 2, "--spacing", 100)
    advise = ("advise", *options, "--heights", 20, "--output", output)
    done = precision(*advise, "--land", ridge)
    assert done.returncode == 0, done.stderr
    assert column(output, "longitude_deg").min() > 16.6 and "undetermined" not in done.stdout
    np.testing.assert_allclose(column(output, "height_m"), 252, atol=0.1)
    places.write_text(json.dumps({"type": "MultiPoint", "coordinates": west}))
    assert "stay undetermined" in precision(*advise, "--land", ridge).stdout
    for ground in ((), ("--land", ridge, "--ground", 250)):
        assert "give either --ground or --land" in precision(*advise, *ground).stderr
    far = ("--land", tmp_path)
    assert f"{tmp_path}/land.json" in precision(*advise, *far).stderr


def test_latitude_and_longitude_that_are_exchanged_are_named(stations, tmp_path):
    """In the area, in one station, at one place: each is on another continent."""
    area, output = tmp_path / "area.geojson", tmp_path / "out.csv"
    ring = circle(300, 24)[:, ::-1].tolist()
    area.write_text(json.dumps({"type": "Polygon", "coordinates": [ring + ring[:1]]}))
    one = tmp_path / "one.csv"
    one.write_text(STATIONS + "south,16.6,49.197,250\n")
    advise = ("advise", "--places", stations, "--area", area, "--stations", 2, "--ground", 250)
    budget = ("budget", "--stations", stations, "--at", "16.6,49.2,300")
    for arguments, who in (
        ((*advise, "--spacing", 60), f"{stations}: west is 4558 km from the area"),
        (("map", "--stations", one), f"{one}: south is 4558 km from station west"),
        (budget, "--at is 4558 km from the stations"),
    ):
        result = precision(*arguments, "--output", output)
        assert result.returncode == 2 and not output.exists()
        said = re.sub(r"is 455\d km", "is 4558 km", result.stderr)
        assert f"{who}: are latitude and longitude exchanged?" in said


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{", "is not JSON"),
        ('{"type": "Polygon"}', "coordinates is missing"),
        ('{"type": "Point", "coordinates": [16.6]}', "a position must be"),
        ('{"type": "Point", "coordinates": [16.6, 149.2]}', "latitude is outside"),
        ('{"type": "Polygon", "coordinates": [[[16, 49], [17, 49], [17, 50]]]}', "a ring must"),
        (
            '{"type": "FeatureCollection", "features": [{"type": "Feature", "geometry":'
            ' {"type": "LineString", "coordinates": []}}]}',
            "features[0]: type 'LineString'",
        ),
        ('{"type": "Point", "coordinates": [16.6, 49.2]}', "has no polygon"),
    ],
)
def test_bad_geojson_is_named_and_nothing_is_written(stations, tmp_path, text, expected):
    area, output = tmp_path / "area.geojson", tmp_path / "out.csv"
    area.write_text(text)
    result = precision(
        *("advise", "--places", stations, "--area", area, "--stations", 2, "--ground", 250),
        *("--spacing", 60, "--output", output),
    )
    assert result.returncode == 2
    assert expected in result.stderr and str(area) in result.stderr
    assert len(lines_said(result.stderr)) == 1 and not output.exists()


@pytest.mark.parametrize(
    ("row", "expected"),
    [
        ("pillar,ninety,0.3,0", ":2: distance_m"),
        ("pillar,90,1.6,0", ":2: alpha_rad"),
        ("pillar,90,0.3,2", ":2: side"),
        ("", ":2: row: the file has a header but no rows"),
        ("pillar,1,1.4,1", ": object pillar: distance_m"),
    ],
)
def test_a_bad_landmark_is_named(tmp_path, row, expected):
    table, output = tmp_path / "table.csv", tmp_path / "out.csv"
    table.write_text(f"object,distance_m,alpha_rad,side\n{row}\n")
    result = precision("table", "--input", table, "--output", output)
    assert result.returncode == 2 and f"{table}{expected}" in result.stderr
    assert not output.exists()


def test_bad_arguments_are_one_clear_line(stations, tmp_path):
    output = tmp_path / "out.csv"
    for arguments, expected in (
        ((), "subcommand"),
        (("table", "--input", "none.csv", "--output", output), "none.csv: cannot be read"),
        (("budget", "--stations", stations, "--at", "49,16", "--output", output), "--at"),
        (("budget", "--stations", stations, "--at", "95,16,300", "--output", output), "latitude"),
        (("budget", "--stations", stations, "--at", "49,999,300", "--output", output), "longitude"),
        (("budget", "--stations", stations, "--at", "49,16,9e9", "--output", output), "height"),
        (("map", "--stations", stations, "--cells", 1, "--output", output), "--cells"),
    ):
        result = precision(*arguments)
        assert result.returncode == 2 and expected in result.stderr
        assert not output.exists()
