"""The view in three dimensions, in a real browser: its layers, what a click on it selects, and what
is measured in it."""

import base64
import io
import itertools
import re

import numpy as np
import ols
import pytest
from conftest import wait
from console_page import axe_finds, region
from console_site import PLACES, PaperTarget
from ols_demo.places import geodetic
from PIL import Image
from playwright.sync_api import expect
from scipy import ndimage

pytest_plugins = ["console_fixtures"]

STATION = np.array([111, 211, 247])  # --map-station
HEIGHT_M = 300.0
DOT_PX = 12  # least area of one that is whole
# A keep-out of each station, once round [rad].
BORDER = [(0.4, 0.1), (1.2, 0.1), (1.2, 0.6), (0.4, 0.6)]


@pytest.fixture
def view(page):
    chart = region(page, "Map")
    chart.get_by_role("button", name="3-D").click()
    solid = chart.get_by_role("img", name="3-D")
    expect(solid).to_be_visible()
    wait(lambda: len(dots(page)) == len(PLACES), "each station in the view")
    return chart


def image(page):
    """What the view shows: height x width x RGB."""
    url = page.evaluate("document.querySelector('.view-3d canvas').toDataURL()")
    picture = Image.open(io.BytesIO(base64.b64decode(url.split(",")[1])))
    return np.asarray(picture.convert("RGB"), int)


def dots(page):
    """Where the stations are drawn, from the left to the right [px on the page]."""
    is_dot = (abs(image(page) - STATION) < 3).all(axis=2)
    labels, count = ndimage.label(is_dot)
    sizes = ndimage.sum(is_dot, labels, range(1, count + 1))
    whole = [k + 1 for k, size in enumerate(sizes) if size >= DOT_PX]
    box = page.locator(".view-3d canvas").bounding_box()
    middles = ndimage.center_of_mass(is_dot, labels, whole)
    return sorted((box["x"] + x + 0.5, box["y"] + y + 0.5) for y, x in middles)


LAYERS = ["UTM/MGRS grid", "Rings", "Trails", "Views", "Keep-out regions, travel"]


def test_layers_are_switched_off_and_on(page, paper, view):
    paper.borders["alfa"] = [BORDER]
    view.get_by_text("Layers", exact=True).click()
    buttons = {name: view.get_by_role("button", name=name, exact=True) for name in LAYERS}
    for button in buttons.values():
        expect(button).to_have_attribute("aria-pressed", "true")
        button.click()
    del buttons["Trails"]
    for layer, button in buttons.items():
        (without,) = wait(lambda: still(page), "the view to stand still")
        button.click()
        wait(
            lambda bare=without: (image(page) != bare).any(axis=2).sum() > 60,
            f"{layer} in three dimensions",
        )
        button.click()
    paper.borders.clear()


def moving(time_s):
    """To and fro, fast."""
    return geodetic(49.2265, 16.597 + 0.003 * np.sin(time_s / 2), 420.0)


def trail_px(page):
    r, g, b = np.moveaxis(image(page), 2, 0)
    return int(((r > g + 20) & (g > b + 20) & (r > 90)).sum())  # --map-trail, --map-target


def test_a_trail_is_switched_off(page, paper, view):
    with paper.another_target(PaperTarget(moving)):
        with_it = wait(lambda: (n := trail_px(page)) > 350 and n, "a trail")
        view.get_by_text("Layers", exact=True).click()
        view.get_by_role("button", name="Trails", exact=True).click()
        wait(lambda: trail_px(page) < 0.7 * with_it, "the view without trails")


def still(page):
    """Its image alone, if two in succession are alike."""
    first = image(page)
    page.wait_for_function(
        "(t) => document.querySelector('.utc').innerText !== t",
        arg=page.locator(".utc").inner_text(),
    )
    return (first,) if np.array_equal(first, image(page)) else None


def test_what_has_no_third_dimension_says_so(page, view):
    view.get_by_text("Layers", exact=True).click()
    expect(view.get_by_text("only on the flat map")).to_be_visible()
    expect(view.get_by_label("Accuracy (1σ)")).to_be_disabled()
    assert axe_finds(page) == []
    view.get_by_role("button", name="3-D").click()
    expect(view.get_by_label("Accuracy (1σ)")).to_be_enabled()
    expect(view.get_by_text("only on the flat map")).to_have_count(0)


def test_a_click_selects(page, view):
    page.mouse.click(*dots(page)[0])
    stations = region(page, "Stations")
    expect(stations.locator("article.open")).to_have_count(1)
    assert stations.locator("article.open .who").inner_text() in PLACES


def place_m(station):
    return np.array(ols.ecef_from_geodetic(geodetic(*PLACES[station], HEIGHT_M)))


def test_two_stations_are_measured(page, view):
    """Each pair: which one a dot is, the distances say."""
    view.get_by_role("button", name="Measure").click()
    expect(view.get_by_role("status")).to_contain_text("Click two stations")
    said = []
    for a, b in itertools.combinations(dots(page), 2):
        page.mouse.click(*a)
        page.mouse.click(*b)
        expect(view.get_by_role("status")).to_contain_text(re.compile(r"\d m .*°"))
        text = view.get_by_role("status").inner_text()
        said.append(float(re.findall(r"([\d.]+) m", text)[0]))
        assert abs(float(re.findall(r"el (-?[\d.]+)°", text)[0])) < 0.1, "all of one height"
    wanted = [
        float(np.linalg.norm(place_m(a) - place_m(b))) for a, b in itertools.combinations(PLACES, 2)
    ]
    assert sorted(said) == pytest.approx(sorted(wanted), abs=1.0)
    view.get_by_role("button", name="Measure").click()
    expect(view.get_by_role("status")).to_have_count(0)


def test_a_place_on_the_ground_is_measured_from(page, view):
    """Beside a station: so far away as the grid's step says."""
    view.get_by_role("button", name="Measure").click()
    near = dots(page)[0]
    page.mouse.click(near[0] - 60, near[1])
    page.mouse.click(*near)
    expect(view.get_by_role("status")).to_contain_text(re.compile(r"\d m .*el -?0\.0°"))
