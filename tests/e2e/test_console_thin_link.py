"""The pictures of a real station over a thin link: as H.264, in a real browser."""

import pytest
from conftest import BIN, SCENARIO
from console_page import region, watched_page
from console_site import browser
from helpers import at_frame_rate
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring
from playwright.sync_api import expect

# The grey of the picture that is shown, on a coarse raster, without what is drawn over its middle.
GREYS = """() => {
  const c = document.querySelector('.eye.large canvas');
  const g = c.getContext('2d');
  const seen = [];
  for (let y = 0.1; y < 1; y += 0.2)
    for (let x = 0.1; x < 1; x += 0.2) {
      const [left, top] = [Math.round(x * c.width) - 4, Math.round(y * c.height) - 4];
      const d = g.getImageData(left, top, 8, 8).data;
      let sum = 0;
      for (let i = 0; i < d.length; i += 4) sum += d[i];
      seen.push(sum / 64);
    }
  return seen;
}"""


@pytest.fixture(scope="module")
def console(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("thin")
    scenario = at_frame_rate(SCENARIO, 6.0, folder)
    wiring = Wiring(BIN, scenario, 1, folder)
    bring_up_loopback(wiring.prepare())
    with Site(folder / "logs") as started:
        wiring.start_simulator(started)
        wiring.start_station(started, "alfa")
        yield wiring.start_console(started)
        started.check()


@pytest.fixture(scope="module")
def chromium():
    with browser() as started:
        yield started


def caption(page):
    return region(page, "Video").locator("figcaption")


def wait_for_pictures(page, count):
    canvas = "document.querySelector('.eye.large canvas')"
    before = page.evaluate(f"Number({canvas}?.dataset.utimeUs ?? 0)")
    for _ in range(count):
        page.wait_for_function(f"(b) => Number({canvas}?.dataset.utimeUs) > b", arg=before)
        before = page.evaluate(f"Number({canvas}?.dataset.utimeUs)")


def test_a_thin_link_shows_the_same_pictures(chromium, console):
    with watched_page(chromium, console) as page:
        thin = region(page, "Video").get_by_role("checkbox", name="Thin link")
        wait_for_pictures(page, 3)
        jpeg = page.evaluate(GREYS)
        thin.check()
        expect(caption(page)).to_contain_text("H.264")
        wait_for_pictures(page, 3)
        greys = page.evaluate(GREYS)
        # All of the grey scale: as a television's the brightest would be off by five and more.
        assert greys == pytest.approx(jpeg, abs=3.0)
        assert max(jpeg) > 145
        # Another browser comes in the middle of the stream, with the choice that it remembers.
        page.reload()
        expect(caption(page)).to_contain_text("H.264")
        wait_for_pictures(page, 3)
        thin.uncheck()
        expect(caption(page)).not_to_contain_text("H.264")
        wait_for_pictures(page, 3)


def test_a_browser_without_it_says_so_and_shows_jpegs(chromium, console):
    with watched_page(chromium, console) as page:
        page.add_init_script("delete window.VideoDecoder")
        page.reload()
        region(page, "Video").get_by_role("checkbox", name="Thin link").check()
        expect(region(page, "Video")).to_contain_text("This browser cannot decode H.264")
        expect(caption(page)).to_contain_text("JPEG")
        wait_for_pictures(page, 3)
