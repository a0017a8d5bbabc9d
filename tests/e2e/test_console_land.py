"""The imported land on the console's page, in a real browser: the skyline in a station's picture,
from whom the land hides a target, profiles, heights, its map, and the view in three dimensions."""

import math
import re

import numpy as np
import ols
import ols_msg
import pytest
from conftest import BIN, ROOT, finished, wait
from console_page import enlarge, region, watched_page
from console_site import (
    FULL_PX,
    LIVE_URL,
    PLACES,
    Api,
    PaperTarget,
    address_of,
    console_command,
    paper_site,
)
from ols_bench.paper_video import PaperCamera, PaperVideo
from ols_demo.places import geodetic
from ols_demo.site import Site
from PIL import Image
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

STEP_DEG = 0.0002
SOUTH_WEST, ROWS, COLUMNS = (49.215, 16.58), 150, 175
GROUND_M, RIDGE_M, RIDGE_DEG = 290.0, 340.0, 49.235  # north of all stations
FOCAL_LENGTH_PX, ELEVATION_DEG = 4000.0, 1.0
WGS84 = (
    'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
    'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]'
)


def import_land(folder):
    """Level, with a ridge from west to east."""
    heights = np.full((ROWS, COLUMNS), GROUND_M)
    heights[ROWS - 1 - round((RIDGE_DEG - SOUTH_WEST[0]) / STEP_DEG)] = RIDGE_M
    model = folder / "model.asc"
    head = {"ncols": COLUMNS, "nrows": ROWS, "xllcenter": SOUTH_WEST[1], "yllcenter": SOUTH_WEST[0]}
    rows = [f"{key} {value}" for key, value in {**head, "cellsize": STEP_DEG}.items()]
    model.write_text("\n".join([*rows, *(" ".join(map(str, row)) for row in heights)]) + "\n")
    model.with_suffix(".prj").write_text(WGS84)
    made = finished(
        *(BIN / "ols-land", "import", "--site", "49.23,16.597", "--radius-km", "2"),
        *("--elevation", model, "--heights", "ellipsoid", "--sd", "1", "--licence", "made"),
        *("--output", folder / "land"),
    )
    assert made.returncode == 0, made.stderr
    return folder / "land"


def to_the_north(station):
    """Level across, its axis due north, one degree up."""
    own = ols.ecef_from_geodetic(geodetic(*PLACES[station], 300.0))
    s, c = math.sin(math.radians(ELEVATION_DEG)), math.cos(math.radians(ELEVATION_DEG))
    from_enu = np.array([[1, 0, 0], [0, s, -c], [0, c, s]], float)
    rows = (from_enu @ ols.R_ecef_enu(own).T).ravel().tolist()
    return PaperCamera(list(own), rows, FOCAL_LENGTH_PX)


@pytest.fixture(scope="module")
def paper(network):
    video = PaperVideo("alfa", 0.2, to_the_north("alfa"))
    with paper_site() as site:
        site.devices["alfa"] = {"video": video.address}
        yield site
    video.shutdown()
    video.server_close()


@pytest.fixture(scope="module")
def consoles(paper, tmp_path_factory):
    folder = tmp_path_factory.mktemp("land")
    config = folder / "console.toml"
    config.write_text(f'lcm_url = "{LIVE_URL}"\n[land]\nfolder = "{import_land(folder)}"\n')
    with Site(folder / "logs") as site:
        command = console_command(folder / "nobody", "--config", str(config), "--port", "0")
        site.start_and_wait("console", command, "ready")
        yield [address_of(site, "console")]
        site.check()


@pytest.fixture
def page(chromium, consoles):
    with watched_page(chromium, consoles[0]) as opened:
        yield opened


def marked_row(page, station, column, is_mark):
    """The row of the full frame at which a mark's colour is, about this column; None: none."""
    data = page.evaluate(
        """([name, full, column]) => {
          const c = document.querySelector(`[role=img][aria-label=${name}]`);
          const x = Math.round((column * c.width) / full[0]);
          return { h: c.height, d: [...c.getContext('2d').getImageData(x, 0, 1, c.height).data] };
        }""",
        [station, list(FULL_PX), column],
    )
    colours = np.array(data["d"], int).reshape(-1, 4)
    r, g, b = colours[:, 0], colours[:, 1], colours[:, 2]
    rows = np.flatnonzero(is_mark(r, g, b))
    return rows.mean() * FULL_PX[1] / data["h"] if rows.size else None


def green_row(page, station, column):
    return marked_row(page, station, column, lambda r, g, b: (g > r + 40) & (g > b + 25))


def red_row(page, station, column):
    return marked_row(page, station, column, lambda r, g, b: (r > g + 80) & (r > b + 80))


def test_the_skyline_is_where_the_camera_sees_the_ridge(page):
    enlarge(page, "alfa")
    own = ols.ecef_from_geodetic(geodetic(*PLACES["alfa"], 300.0))
    for column in (340, 640, 940):
        across = (column - FULL_PX[0] / 2) / FOCAL_LENGTH_PX
        crest = geodetic(RIDGE_DEG, PLACES["alfa"][1] + across * 0.0153, RIDGE_M)
        east, north, up = ols.R_ecef_enu(own).T @ (ols.ecef_from_geodetic(crest) - own)
        camera = np.array(to_the_north("alfa").from_ecef).reshape(3, 3) @ ols.R_ecef_enu(own)
        x, y, z = camera @ [east, north, up]
        row = FULL_PX[1] / 2 + FOCAL_LENGTH_PX * y / z
        assert abs(FULL_PX[0] / 2 + FOCAL_LENGTH_PX * x / z - column) < 5
        found = wait(lambda at=column: green_row(page, "alfa", at), "the skyline")
        assert abs(found - row) < 4, (column, found, row)
    page.get_by_label("Skyline of the land").uncheck()
    wait(lambda: green_row(page, "alfa", 640) is None, "a picture without it")
    page.get_by_label("Skyline of the land").check()
    wait(lambda: green_row(page, "alfa", 640), "the skyline again")


def test_where_the_picture_disagrees_with_the_skyline_it_is_red(page, paper):
    """Something three degrees high and two degrees wide, due north of alfa."""
    elevation_deg, half_deg = 3.0, 1.0
    m = ols_msg.skyline_t()
    m.schema_version, m.station, m.boot_id = m.SCHEMA_VERSION, "alfa", 1
    enlarge(page, "alfa")
    for sector, columns in ((0, range(0, 40)), (71, range(7160, 7200))):
        m.utime, m.begun_utime = paper.utime_us(), 1
        m.sector, m.columns, m.column = sector, len(columns), list(columns)
        m.elevation_rad = [math.radians(elevation_deg)] * len(columns)
        m.sd_rad, m.hides_from_m = [1e-4] * len(columns), [300.0] * len(columns)
        m.disagrees = [min(i, 7199 - i) * 0.05 < half_deg for i in columns]
        paper._publish("OLS_SKYLINE_alfa", m)
    found = wait(lambda: red_row(page, "alfa", 640), "the red line")
    row = FULL_PX[1] / 2 - FOCAL_LENGTH_PX * math.tan(math.radians(elevation_deg - ELEVATION_DEG))
    assert abs(found - row) < 4, (found, row)
    width_px = FOCAL_LENGTH_PX * math.tan(math.radians(half_deg))
    for column in (640 - 0.8 * width_px, 640 + 0.8 * width_px):
        assert red_row(page, "alfa", column)
    for column in (640 - 1.3 * width_px, 640 + 1.3 * width_px):
        assert red_row(page, "alfa", column) is None
        wait(lambda at=column: green_row(page, "alfa", at), "the skyline as the land has it")


@pytest.fixture
def hidden(paper):
    """The land hides the target from alfa, which the fusion says until the test is over."""
    m = ols_msg.occlusion_t()
    m.schema_version, m.boot_id, m.station = m.SCHEMA_VERSION, paper.fusion_boot, "alfa"
    m.target_id, m.hidden, m.lease_s, m.holds_s = 7, 0.99, 1.0, 60.0
    m.utime = paper.utime_us()
    m.exit_utime = m.utime + 30_000_000
    paper._publish("OLS_OCCLUSION_alfa", m)
    yield
    m.holds_s = 0.0
    paper._publish("OLS_OCCLUSION_alfa", m)


def select_target(page):
    region(page, "Targets").get_by_role("row").nth(1).click()
    return page.get_by_role("complementary", name="Target 7")


def test_from_whom_the_land_hides_a_target_and_for_how_long(page, consoles, hidden):
    def is_told():
        target = Api(consoles[0]).state()["targets"][0]
        return (target["hidden"] or {}).get("from", [{}])[0].get("id") == "alfa"

    wait(is_told, "the console to know it")
    panel = select_target(page)
    expect(panel).to_contain_text(re.compile(r"alfa for \d+ s, back \d\d:\d\d:\d\d"))

    def points():
        trail = Api(consoles[0]).state()["targets"][0]["trail"]
        return [point[3] for point in trail if point and len(point) > 3]

    wait(lambda: ["alfa"] in points(), "bravo sees it: a trail that is hidden from alfa alone")


def test_the_profile_below_a_line_of_sight(page, paper):
    """From charlie, 667 m south of the ridge."""
    panel = select_target(page)
    panel.get_by_role("combobox", name="Line of sight from").select_option("charlie")
    expect(panel.get_by_role("img", name="Line of sight from charlie: clear")).to_be_visible()
    behind = geodetic(RIDGE_DEG + 0.003, PLACES["charlie"][1], 310.0)
    before = paper.targets[7]
    beyond = geodetic(SOUTH_WEST[0] - 0.02, PLACES["charlie"][1], 400.0)
    paper.targets[7] = PaperTarget(at=lambda _time_s: beyond)
    unknown = re.compile(r"charlie: clear, known up to 1\.5\d km")
    expect(panel.get_by_role("img", name=unknown)).to_be_visible()
    paper.targets[7] = PaperTarget(at=lambda _time_s: behind)
    blocked = re.compile(r"charlie: blocked at 6[4-8]\d m")
    expect(panel.get_by_role("img", name=blocked)).to_be_visible()
    paper.targets[7] = before


def test_the_height_of_the_ground_under_the_cursor(page):
    chart = region(page, "Map")
    chart.get_by_role("button", name="Whole site").click()
    box = chart.bounding_box()
    shown = chart.locator(".map-ground")

    def move():
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 + 10)
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)

    wait(lambda: shown.count() and "Ground 290 m" in shown.inner_text(), "the height", turn=move)
    page.mouse.move(2, 2)
    expect(shown).to_have_count(0)


def test_the_terrain_is_in_the_3d_view(page):
    chart = region(page, "Map")
    chart.get_by_role("button", name="3-D").click()
    shades = """() => {
      const c = document.querySelector('.view-3d canvas');
      const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
      const seen = new Set();
      for (let i = 0; i < d.length; i += 4) seen.add(d.slice(i, i + 3).join());
      return seen.size;
    }"""
    chart.get_by_text("Layers").click()
    chart.get_by_role("button", name="Terrain").click()
    flat = page.evaluate(shades)
    chart.get_by_role("button", name="Terrain").click()
    wait(lambda: page.evaluate(shades) > 1.3 * flat, "the land's shades")


def test_the_folder_becomes_a_map_of_its_relief(consoles, tmp_path):
    """Darker on the side of the ridge that is turned away from the light."""
    tool = ROOT / "tools/maps/ols-map-import"
    made = finished(tool, "--land", import_land(tmp_path), tmp_path / "relief.mbtiles")
    assert made.returncode == 0, made.stderr
    finished("gdal_translate", "-q", tmp_path / "relief.mbtiles", tmp_path / "relief.tif")
    seen = np.asarray(Image.open(tmp_path / "relief.tif").convert("L"), float)
    height, width = seen.shape
    north = SOUTH_WEST[0] + (ROWS - 0.5) * STEP_DEG
    row = round(height * (north - RIDGE_DEG) / (ROWS * STEP_DEG))
    beside = seen[row - 30 : row + 30, width // 4 : width // 2].mean(axis=1)
    assert beside.max() - beside.min() > 30, beside
    refused = finished(tool, "--land", tmp_path, tmp_path / "other.mbtiles")
    assert refused.returncode == 2
    assert "is no folder of ols-land import" in refused.stderr
