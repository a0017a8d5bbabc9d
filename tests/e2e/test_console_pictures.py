"""What the console draws into a station's picture: the horizon, targets and stations with a place,
the tracker's belief; and the gamepad that turns the unit."""

import re
from dataclasses import replace

import numpy as np
import ols
import pytest
from conftest import wait
from console_page import PAD, enlarge, picture
from console_site import FULL_PX, PLACES, TARGET, paper_site
from ols_bench.paper_video import PaperCamera, PaperVideo
from ols_demo.places import geodetic
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

FOCAL_LENGTH_PX = 4000.0
ELEVATION_RAD = np.radians(1.0)
PRINCIPAL_PX = (760.0, 560.0)  # of bravo's camera


def camera_at(station, towards, elevation_rad):
    """At the station's place, level, its axis in the direction of a place, at an elevation."""
    own = ols.ecef_from_geodetic(geodetic(*PLACES[station], 300.0))
    axes = ols.R_ecef_enu(own)
    east, north, _ = axes.T @ (ols.ecef_from_geodetic(towards) - own)
    azimuth = np.arctan2(east, north)
    s, c = np.sin(azimuth), np.cos(azimuth)
    forward = np.array(
        [s * np.cos(elevation_rad), c * np.cos(elevation_rad), np.sin(elevation_rad)]
    )
    right = np.array([c, -s, 0.0])
    from_enu = np.array([right, np.cross(forward, right), forward])
    return PaperCamera(list(own), (from_enu @ axes.T).ravel().tolist(), FOCAL_LENGTH_PX)


@pytest.fixture(scope="module")
def paper(network):
    bravo = geodetic(*PLACES["bravo"], 300.0)
    own = ols.ecef_from_geodetic(geodetic(*PLACES["charlie"], 300.0))
    east, north, up = ols.R_ecef_enu(own).T @ (ols.ecef_from_geodetic(TARGET) - own)
    to_target = np.arctan2(up, np.hypot(east, north))
    to_alfa = camera_at("bravo", geodetic(*PLACES["alfa"], 300.0), ELEVATION_RAD)
    videos = {
        "bravo": PaperVideo("bravo", 0.2, replace(to_alfa, principal_px=PRINCIPAL_PX)),
        "alfa": PaperVideo("alfa", 0.2, camera_at("alfa", bravo, ELEVATION_RAD)),
        "charlie": PaperVideo("charlie", 0.2, camera_at("charlie", TARGET, to_target)),
    }
    with paper_site() as site:
        for name, video in videos.items():
            site.devices[name] = {"video": video.address}
        yield site
    for video in videos.values():
        video.shutdown()
        video.server_close()


def pixels(page, station, x, y, width, height):
    """Of the picture as it is drawn, in full-frame pixels; height x width x RGB."""
    data = page.evaluate(
        """([name, full, x, y, width, height]) => {
          const c = document.querySelector(`[role=img][aria-label=${name}]`);
          const s = c.width / full[0];
          const [w, h] = [Math.round(width * s), Math.round(height * s)];
          const [left, top] = [Math.round(x * s), Math.round(y * s)];
          return { w, h, d: [...c.getContext('2d').getImageData(left, top, w, h).data] };
        }""",
        [station, list(FULL_PX), x, y, width, height],
    )
    return np.array(data["d"]).reshape(data["h"], data["w"], 4)[:, :, :3]


def test_the_horizon_is_where_a_level_camera_sees_it(page):
    picture(page, "alfa")
    row = FULL_PX[1] / 2 + FOCAL_LENGTH_PX * np.tan(ELEVATION_RAD)
    reach = 40

    def brightest():
        columns = pixels(page, "alfa", 20, row - reach, 40, 2 * reach).mean(axis=(1, 2))
        found = columns.argmax() * 2 * reach / len(columns) - reach
        return columns.max() > np.median(columns) + 10 and abs(found) < 4

    wait(brightest, "a bright line at the horizon")


def test_targets_and_stations_are_where_the_camera_sees_them(page):
    picture(page, "alfa")
    middle = [v / 2 for v in FULL_PX]

    def has(station, is_colour, x, y):
        around = pixels(page, station, x - 40, y - 40, 80, 80).reshape(-1, 3)
        return sum(1 for r, g, b in around if is_colour(r, g, b)) > 5

    def is_station(r, g, b):  # --mark-station
        return b > 180 and g > 150 and r < 160

    def is_target(r, g, b):  # --mark-target
        return r > 200 and 120 < g < 210 and b < 140

    below = FULL_PX[1] / 2 + FOCAL_LENGTH_PX * np.tan(ELEVATION_RAD)
    wait(
        lambda: (
            has("alfa", is_station, middle[0], below)
            and not has("alfa", is_target, middle[0], below)
        ),
        "bravo in alfa's picture, and no target there",
    )
    enlarge(page, "charlie")
    wait(lambda: has("charlie", is_target, *middle), "the target in charlie's picture")


def test_the_caption_says_where_the_axis_of_this_picture_pointed(page):
    """From alfa to bravo it is due east, one degree up: by the frame, not by the status."""
    caption = picture(page, "alfa").locator("xpath=..")
    expect(caption).to_contain_text(re.compile(r"090\.0\d°\s+1\.00°"))


def test_the_cross_is_where_the_axis_meets_the_picture(page):
    enlarge(page, "bravo")

    def is_cross(x, y):
        around = pixels(page, "bravo", x - 20, y - 20, 40, 40).astype(int).min(axis=2)
        return (around - np.median(around)).max() > 25

    middle = [v / 2 for v in FULL_PX]
    wait(lambda: is_cross(*PRINCIPAL_PX) and not is_cross(*middle), "the cross at the axis")


def test_the_exposure_is_in_milliseconds(page, paper):
    paper.readings["alfa"] = {"camera_exposure_us": 2500.0}
    caption = picture(page, "alfa").locator("xpath=..")
    expect(caption).to_contain_text("exposure 2.5 ms")
    paper.readings.clear()


def test_the_delay_is_in_milliseconds_while_the_picture_is_live(page):
    caption = picture(page, "alfa").locator("xpath=..")
    expect(caption).to_contain_text(re.compile(r"\d{1,3} ms"))


def test_a_gamepads_stick_turns_the_unit_and_letting_go_halts(page, paper):
    page.evaluate(PAD)
    paper.commands.clear()
    picture(page, "alfa").click()
    wait(lambda: paper.commands, "the click's own command")
    paper.ptu_commands.clear()
    page.evaluate("window.pad.axes = [0.05, -0.05, 0, 0]")  # at rest, worn
    page.evaluate("window.pad.axes = [0.6, 0, 0, 0]")
    wait(lambda: len(paper.ptu_commands) > 2, "rates that are renewed")
    page.evaluate("window.pad.axes = [0, 0, 0, 0]")
    wait(lambda: is_halted(paper), "the halt")
    sent = list(paper.ptu_commands)
    assert {m.command for m in sent} == {sent[0].COMMAND_RATE}
    assert all(m.station == "alfa" and m.lease_s <= 0.3 for m in sent)
    assert sent[0].pan_rate_rad_s < 0, "to the right, of a unit that counts to the left"
    assert [m.tilt_rate_rad_s for m in sent] == [0.0] * len(sent)


def is_halted(paper):
    """The newest rate is none; the click's own command may come after it."""
    rates = [m for m in paper.ptu_commands if m.command == m.COMMAND_RATE]
    return bool(rates) and rates[-1].pan_rate_rad_s == 0


def test_a_worn_stick_and_a_pad_that_vanishes_turn_nothing(page, paper):
    page.evaluate(PAD)
    paper.commands.clear()
    paper.ptu_commands.clear()
    picture(page, "alfa").click()
    wait(lambda: paper.commands, "the click's own command")
    page.evaluate("window.pad.axes = [0.6, 0, 0, 0]")
    wait(lambda: any(m.pan_rate_rad_s for m in paper.ptu_commands), "a rate")
    page.evaluate("window.pad.connected = false")
    wait(lambda: is_halted(paper), "the halt")
    sent = len(paper.ptu_commands)
    page.evaluate("Object.assign(window.pad, { connected: true, axes: [0.1, -0.1, 0, 0] })")
    looks = page.evaluate("window.looks")
    page.wait_for_function("(before) => window.looks > before + 6", arg=looks)
    rates = [(m.pan_rate_rad_s, m.tilt_rate_rad_s) for m in paper.ptu_commands[sent:]]
    assert set(rates) <= {(0.0, 0.0)}, "the halt may be told again"
