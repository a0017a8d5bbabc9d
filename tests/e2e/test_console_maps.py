"""The map's layers on the console's page, in a browser without a graphics processor: users' own
maps, the accuracy, keep-outs, three dimensions; and what an admin does."""

import math
import subprocess

import pytest
from conftest import BIN, wait
from console_page import DRAWN_TEXT, axe_finds, found_at_each_size
from console_site import (
    CHROMIUM,
    DEADLINE_S,
    LIVE_URL,
    PASSWORD,
    PLACES,
    Api,
    add_user,
    address_of,
    console_command,
    paper_site,
)
from ols_demo.site import Site
from own_maps import write_folder, write_mbtiles, write_pmtiles
from playwright.sync_api import expect, sync_playwright

OWN_MAPS = {"Magenta": (255, 0, 255), "cyan": (0, 255, 255), "yellow": (255, 255, 0)}
ATTRIBUTION = "© the <b>painter</b> <img src=x onerror=alert(1)>"
KEEP_OUT = [
    *[(math.radians(40 + 10 * i), 0.0) for i in range(4)],
    *[(math.radians(80), 0.05 * i) for i in range(4)],
    *[(math.radians(80 - 10 * i), 0.2) for i in range(4)],
    *[(math.radians(40), 0.2 - 0.05 * i) for i in range(4)],
]


def write_plan(path):
    """As a planner does: ols-precision's map of the site's stations."""
    stations = path.with_suffix(".csv")
    rows = [f"{name},{north},{east},250" for name, (north, east) in PLACES.items()]
    stations.write_text("station,latitude_deg,longitude_deg,height_m\n" + "\n".join(rows) + "\n")
    command = [BIN / "ols-precision", "map", "--stations", stations, "--heights", "30,100"]
    outputs = ["--cells", "20", "--output", path.with_suffix(".cells.csv"), "--geojson", path]
    subprocess.run(list(map(str, command + outputs)), check=True, timeout=300)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("maps")


@pytest.fixture(scope="module")
def address(network, folder):
    (folder / "maps").mkdir()
    write_mbtiles(folder / "maps/m.mbtiles", "Magenta", OWN_MAPS["Magenta"], ATTRIBUTION)
    write_folder(folder / "maps/cyan", OWN_MAPS["cyan"])
    write_pmtiles(folder / "maps/yellow.pmtiles", OWN_MAPS["yellow"])
    (folder / "maps/damaged.mbtiles").write_bytes(b"x" * 5000)
    write_plan(folder / "maps/plan.geojson")
    (folder / "maps/broken.geojson").write_text('{"type": "FeatureCollection", "features": [7]}')
    config = folder / "console.toml"
    config.write_text(f'lcm_url = "{LIVE_URL}"\n[maps]\nfolder = "{folder / "maps"}"\n')
    add_user(folder / "users", "ana", PASSWORD, "admin")
    with paper_site() as paper, Site(folder / "logs") as site:
        paper.borders["alfa"] = [KEEP_OUT]
        command = console_command(folder / "users", "--config", str(config), "--port", "0")
        site.start_and_wait("console", command, "ready")
        yield address_of(site, "console")
        site.check()


@pytest.fixture(scope="module")
def page(address):
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=["--no-sandbox", "--disable-gpu", "--disable-software-rasterizer"],
        )
        opened = browser.new_page(viewport={"width": 1280, "height": 800}, color_scheme="dark")
        opened.set_default_timeout(DEADLINE_S * 1000)
        opened.add_init_script(DRAWN_TEXT)
        opened.goto(address)
        opened.get_by_label("Name").fill("ana")
        opened.get_by_label("Password").fill(PASSWORD)
        opened.get_by_role("button", name="Log in").click()
        expect(map_of(opened)).to_be_visible()
        yield opened
        browser.close()


def map_of(page):
    return page.get_by_role("region", name="Map", exact=True)


def colours(page, selector):
    """How many pixels of the canvases have which colour, "r,g,b"."""
    return page.evaluate(
        """(selector) => {
          const seen = {};
          for (const c of document.querySelectorAll(selector)) {
            const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
            for (let i = 0; i < d.length; i += 4) {
              const key = d.slice(i, i + 3).join();
              seen[key] = (seen[key] ?? 0) + 1;
            }
          }
          return seen;
        }""",
        selector,
    )


def settled(page):
    """How many colours the map has, once they have stayed the same for ten looks."""
    looks = []

    def is_still():
        looks.append(len(colours(page, ".map-canvas canvas")))
        return len(looks) >= 10 and len(set(looks[-10:])) == 1

    wait(is_still, "a map that stands still")
    return looks[-1]


def open_layers(page):
    if map_of(page).locator("details[open]").count() == 0:
        map_of(page).get_by_text("Layers").click()


def test_it_has_no_webgl(page):
    context = "document.createElement('canvas').getContext"
    assert (
        page.evaluate(f"{context} && document.createElement('canvas').getContext('webgl')") is None
    )


def test_maps_of_the_users_own_are_shown_and_hidden(page):
    """MBTiles, a folder of tiles, PMTiles."""
    open_layers(page)
    for name in OWN_MAPS:
        show_and_hide(page, name)


def show_and_hide(page, name):
    def covered():
        key = ",".join(map(str, OWN_MAPS[name]))
        return colours(page, ".map-canvas canvas").get(key, 0)

    for other in OWN_MAPS:
        button = map_of(page).get_by_role("button", name=other)
        if (button.get_attribute("aria-pressed") == "true") != (other == name):
            button.click()
    wait(lambda: covered() > 10_000, "the map's tiles")
    has_painter = name == "Magenta"
    expect(map_of(page).get_by_text("© the painter")).to_be_visible(visible=has_painter)
    assert map_of(page).locator(".ol-attribution :is(b, img)").count() == 0
    map_of(page).get_by_role("button", name=name).click()
    wait(lambda: covered() == 0, "the map to be hidden")


def test_a_damaged_map_is_said(page):
    open_layers(page)
    expect(map_of(page)).to_contain_text("damaged.mbtiles: file is not a database")
    expect(map_of(page)).to_contain_text("broken.geojson: feature 1: is no feature")


def test_the_accuracy_of_the_site_is_a_layer(page):
    open_layers(page)
    before = settled(page)
    choice = map_of(page).get_by_role("combobox", name="Accuracy")
    choice.select_option(label="at + 100 m")
    expect(map_of(page).get_by_role("list", name="Accuracy")).to_contain_text("≤ 10 m")
    wait(lambda: len(colours(page, ".map-canvas canvas")) > before, "colours")
    shown = settled(page)
    choice.select_option(label="off")
    wait(lambda: len(colours(page, ".map-canvas canvas")) < (before + shown) / 2, "no colours")


def test_the_accuracy_of_a_plan_is_a_layer(page):
    """What `ols-precision map` has computed; it stays where it is when the map moves."""
    open_layers(page)
    map_of(page).get_by_role("button", name="Whole site").click()
    before = settled(page)
    choice = map_of(page).get_by_role("combobox", name="Accuracy")
    choice.select_option(label="plan.geojson, at + 30 m")
    expect(map_of(page).get_by_role("list", name="Accuracy")).to_contain_text("≤ 0.1 m")
    wait(lambda: len(colours(page, ".map-canvas canvas")) > before, "colours")
    choice.select_option(label="plan.geojson, at + 100 m")
    wait(lambda: len(colours(page, ".map-canvas canvas")) > before, "another height's colours")
    expect(map_of(page)).not_to_contain_text("No accuracy is known for this view")
    shown = settled(page)
    choice.select_option(label="off")
    wait(lambda: len(colours(page, ".map-canvas canvas")) < (before + shown) / 2, "no colours")


def test_keep_outs_are_on_the_map(page, address):
    open_layers(page)
    button = map_of(page).get_by_role("button", name="Keep-out regions, travel")
    expect(button).to_have_attribute("aria-pressed", "true")

    def red():
        return sum(
            count
            for key, count in colours(page, ".map-canvas canvas").items()
            if (c := list(map(int, key.split(","))))[0] > 1.3 * c[1] + 8 and c[0] > 1.2 * c[2] + 8
        )

    map_of(page).get_by_role("button", name="Whole site").click()
    shown = wait(red, "the keep-out's colour")
    button.click()
    wait(lambda: red() < shown / 2, "the keep-out to be hidden")
    button.click()


def test_three_dimensions_need_no_webgl(page):
    map_of(page).get_by_role("button", name="3-D").click()
    view = map_of(page).get_by_role("img", name="3-D")
    expect(view).to_be_visible()
    wait(lambda: len(colours(page, ".view-3d canvas")) > 20, "the site")
    before = colours(page, ".view-3d canvas")
    view.focus()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("+")
    wait(lambda: colours(page, ".view-3d canvas") != before, "another view")
    map_of(page).get_by_label("95 % ellipsoids").select_option("100")
    assert axe_finds(page) == []
    map_of(page).get_by_role("button", name="3-D").click()


def test_axe_finds_nothing_in_any_theme(page):
    open_layers(page)
    for theme in ("Night", "Day", "Sunlight"):
        page.get_by_label("Theme").select_option(theme)
        assert axe_finds(page) == [], theme
    page.get_by_label("Theme").select_option("Night")


def test_layers_and_legend_can_be_read_on_every_screen(page):
    open_layers(page)
    map_of(page).get_by_role("combobox", name="Accuracy").select_option(label="at + 100 m")
    expect(map_of(page).get_by_role("list", name="Accuracy")).to_contain_text("≤ 10 m")
    assert found_at_each_size(page, ".layers") == {}
    map_of(page).get_by_text("Layers").click()
    sources = "(all) => (all.innerHTML += '<li>© the survey of a land</li>'.repeat(4))"
    page.locator(".ol-attribution ul").evaluate(sources)
    assert found_at_each_size(page, ".legend") == found_at_each_size(page, ".ol-attribution") == {}
    page.set_viewport_size({"width": 1280, "height": 800})


def test_an_admin_enters_and_removes_a_user(page, address):
    page.get_by_role("button", name="Users").click()
    users = page.get_by_role("dialog", name="Users")
    users.get_by_label("Name").fill("bob")
    users.get_by_label("Role").select_option("viewer")
    users.get_by_label("Password").fill("long enough")
    users.get_by_role("button", name="Enter").click()
    expect(users.get_by_role("row", name="bob")).to_be_visible()
    assert axe_finds(page) == []
    body = {"name": "bob", "password": "long enough"}
    status, said, headers = Api(address).ask("/api/session", body)
    assert (status, said["role"]) == (200, "viewer")
    cookie = {"Cookie": headers["Set-Cookie"].split(";")[0]}
    assert Api(address).ask("/api/users", headers=cookie)[0] == 403
    users.get_by_role("button", name="Remove: bob").click()
    users.get_by_role("group", name="bob").get_by_role("button", name="Remove").click()
    expect(users.get_by_role("row", name="bob")).to_be_hidden()
    assert Api(address).ask("/api/state", headers=cookie)[0] == 401
    users.get_by_role("button", name="Close").click()


def test_users_changed_by_hand_are_not_overwritten(address, folder):
    status, _, headers = Api(address).ask("/api/session", {"name": "ana", "password": PASSWORD})
    assert status == 200
    cookie = {"Cookie": headers["Set-Cookie"].split(";")[0]}
    add_user(folder / "users", "eve", PASSWORD, "viewer")
    bob = {"name": "bob", "role": "viewer", "password": "long enough"}
    status, said, _ = Api(address).ask("/api/users", bob, headers=cookie)
    assert status == 500
    assert "was changed meanwhile: restart the console" in said["error"]
    assert "eve viewer" in (folder / "users").read_text()
