"""The map on the console's page, in a real browser: its own layers, the ellipse to scale, lines of
single stations, following, measuring."""

import base64
import io
import re

import numpy as np
import ols
import ols_msg
import pytest
from conftest import wait
from console_page import region
from console_site import PaperTarget
from ols_demo.places import geodetic
from PIL import Image
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

SQRT_95 = 2.4477  # of a 1-sigma ellipse: the root of the 95 % point with two degrees of freedom


@pytest.fixture
def chart(page):
    """The map, once it shows the site."""
    expect(region(page, "Targets").get_by_role("row").nth(1)).to_contain_text("380.0 m")
    region(page, "Map").get_by_role("button", name="Whole site").click()
    wait(lambda: pixels(page, is_target).size, "the target on the map")
    return region(page, "Map")


def image(page):
    """What the map shows, once all is drawn that is known now: height x width x RGB."""
    url = page.evaluate(
        """async () => {
          const frame = () => new Promise(requestAnimationFrame);
          await frame(), await frame();
          const all = [...document.querySelectorAll('.map-canvas .ol-layers canvas')];
          const c = document.createElement('canvas');
          [c.width, c.height] = [all[0].clientWidth, all[0].clientHeight];
          const g = c.getContext('2d');
          for (const one of all) g.drawImage(one, 0, 0, c.width, c.height);
          return c.toDataURL();
        }"""
    )
    picture = Image.open(io.BytesIO(base64.b64decode(url.split(",")[1])))
    return np.asarray(picture.convert("RGB"), int)


def is_target(r, g, b):  # --map-target
    return (r > 120) & (g > 80) & (r > b + 60) & (r > g + 20)


def is_line(r, g, b):  # --map-tentative
    return (r > 150) & (g > 150) & (b < 190) & (abs(r - g) < 15) & (r > b + 25)


def is_ray(r, g, b):  # --map-ray
    return (b > r + 40) & (g > r + 30)


def pixels(page, is_colour):
    """Rows and columns of the map's pixels of a colour."""
    return np.argwhere(is_colour(*np.moveaxis(image(page), 2, 0)))


def paint(page, colour):
    """This one of the map's colours is magenta from now on, without what shines through."""
    page.evaluate(f"document.documentElement.style.setProperty('--map-{colour}', '#f0f')")
    theme = page.get_by_label("Theme")
    theme.select_option("day" if theme.input_value() == "night" else "night")


def is_painted(r, g, b):
    return (r > g + 60) & (b > g + 60)


@pytest.mark.parametrize(
    ("layer", "colour"), [("UTM/MGRS grid", "grid"), ("Rings", "ring"), ("Views", "wedge")]
)
def test_layers_can_be_switched_off_and_on(page, chart, layer, colour):
    chart.get_by_text("Layers").click()
    paint(page, colour)
    button = chart.get_by_role("button", name=layer)
    wait(lambda: len(pixels(page, is_painted)) > 200, layer)
    button.click()
    wait(lambda: len(pixels(page, is_painted)) == 0, f"the map without {layer}")
    button.click()
    wait(lambda: len(pixels(page, is_painted)) > 200, f"{layer} to be back")


def test_the_grid_of_an_earlier_view_does_not_come_late(page, chart):
    paint(page, "grid")
    wait(lambda: len(pixels(page, is_painted)) > 200, "the grid")
    asked = []
    page.route("**/api/grid*", lambda route: route.continue_() if asked else asked.append(route))
    chart.locator(".map-canvas").focus()
    page.keyboard.press("ArrowRight")
    wait(lambda: asked, "the question for it", turn=lambda: page.wait_for_timeout(20))
    with page.expect_response("**/api/grid*"):
        page.keyboard.press("ArrowLeft")
    with page.expect_response("**/api/grid*"):
        asked[0].fulfill(
            json={"zone": 33, "northern": True, "step_m": 1, "lines": [], "squares": []}
        )
    assert len(pixels(page, is_painted)) > 200


def moving(time_s):
    """To and fro, fast, and higher to the east."""
    east = np.sin(time_s / 2)
    return geodetic(49.2265, 16.597 + 0.003 * east, 420.0 + 60.0 * east)


def is_low(r, g, b):  # the first of --map-heights
    return (b > r + 60) & (b > g + 60) & (r > 90)


def is_high(r, g, b):  # the last
    return (r > 200) & (g > 180) & (b < 130)


def test_a_target_leaves_a_trail_in_the_colours_of_its_height(page, paper, chart):
    with paper.another_target(PaperTarget(moving)):
        expect(region(page, "Targets").locator("tbody tr")).to_have_count(2)
        wait(lambda: len(pixels(page, is_low)) > 30, "the low part of the trail")
        wait(lambda: len(pixels(page, is_high)) > 30, "the high part of the trail")
        low, high = pixels(page, is_low)[:, 1], pixels(page, is_high)[:, 1]
        assert np.median(low) < np.median(high), "the west is low"
        trail = wait(
            lambda: (n := len(pixels(page, is_target))) > 500 and n, "a trail that is long enough"
        )
        chart.get_by_text("Layers").click()
        chart.get_by_role("button", name="Trails").click()
        wait(lambda: len(pixels(page, is_target)) < 0.8 * trail, "the map without trails")


def test_the_ellipse_is_true_to_the_covariance_and_to_scale(page, paper, chart):
    known = paper.targets[7]
    sd_east_m, sd_north_m = 60.0, 30.0
    variances = (sd_east_m**2, 0.0, 0.0, sd_north_m**2, 0.0, 4.0)
    paper.targets[7] = PaperTarget(covariance_m2=variances)

    def size_px():
        rows, columns = pixels(page, is_target).T
        return np.array([np.ptp(columns), np.ptp(rows)], float)

    wait(lambda: size_px()[0] > 100, "the large ellipse")
    metres_px = measured_m(page, chart, 200) / 200
    chart.get_by_role("button", name="Measure").click()
    wanted_px = 2 * SQRT_95 * np.array([sd_east_m, sd_north_m]) / metres_px
    assert size_px() == pytest.approx(wanted_px, abs=4)
    paper.targets[7] = known


def measured_m(page, chart, across_px):
    """What the page says of two points on a line to the east."""
    chart.get_by_role("button", name="Measure").click()
    box = chart.bounding_box()
    x, y = box["x"] + box["width"] / 2 - across_px / 2, box["y"] + 0.75 * box["height"]
    page.mouse.click(x, y)
    with page.expect_response("**/api/measure*") as asked:
        page.mouse.click(x + across_px, y)
    places = re.findall(r"(?:from|to)=([-\d.]+),([-\d.]+)", asked.value.url)
    a, b = (ols.ecef_from_geodetic(geodetic(float(n), float(e), 0.0)) for n, e in places)
    wanted_m = float(np.linalg.norm(b - a))
    said = asked.value.json()
    assert said["distance_m"] == pytest.approx(wanted_m, rel=1e-4)
    assert said["azimuth_deg"] == pytest.approx(90.0, abs=0.1)
    expect(chart.get_by_role("status")).to_contain_text(f"{wanted_m:.0f} m")
    return wanted_m


def test_a_distance_is_measured_between_two_points(page, chart):
    assert 100 < measured_m(page, chart, 300) < 2000
    chart.get_by_role("button", name="Measure").click()
    expect(chart.get_by_role("status")).to_have_count(0)


def test_a_station_alone_has_a_line(page, paper, chart):
    before = len(pixels(page, is_line))
    paper.lines["charlie"] = (1.2, 0.1)
    expect(region(page, "Targets")).to_contain_text("charlie: line of sight only, az 068.75°")
    wait(lambda: len(pixels(page, is_line)) > before + 50, "the line on the map")
    paper.lines.clear()
    wait(lambda: len(pixels(page, is_line)) < before + 20, "the line to be gone")


def test_a_station_that_tracks_has_a_ray(page, paper, chart):
    before = len(pixels(page, is_ray))
    paper.states["alfa"] = ols_msg.station_status_t.STATE_TRACKING
    wait(lambda: len(pixels(page, is_ray)) > before + 50, "the ray on the map")
    paper.states["alfa"] = ols_msg.station_status_t.STATE_IDLE


def off_middle_px(page):
    """How far the target's symbol is from the middle of the map, beside the panel."""
    shown, panel = image(page), page.locator(".map-panel")
    free_px = shown.shape[1]
    if panel.count():
        free_px = panel.bounding_box()["x"] - page.locator(".map-canvas").bounding_box()["x"]
    rows, columns = np.argwhere(is_target(*np.moveaxis(shown, 2, 0))).T
    return abs(np.median(columns) - free_px / 2), abs(np.median(rows) - shown.shape[0] / 2)


@pytest.mark.parametrize("is_selected", [True, False])
def test_a_target_is_followed(page, chart, is_selected):
    """The one that is selected; where none is, the only one."""
    chart.locator(".map-canvas").focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    wait(lambda: off_middle_px(page)[0] > 100, "the map to be moved")
    if is_selected:
        region(page, "Targets").get_by_role("row").nth(1).click()
    chart.get_by_role("button", name="Follow").click()
    wait(lambda: max(off_middle_px(page)) < 25, "the target in the middle")


def test_a_click_on_the_map_selects(page, chart):
    row, column = np.median(pixels(page, is_target), axis=0)
    box = chart.locator(".map-canvas").bounding_box()
    page.mouse.click(box["x"] + column, box["y"] + row)
    expect(region(page, "Targets").get_by_role("row", selected=True)).to_have_count(1)
