"""A recorded log on the console's page: clearly a replay, with a timeline, and without commands."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import BIN, GOLDEN_LOG, finished, wait
from console_page import DRAWN_TEXT, found_at_each_size, unreadable
from console_site import DEADLINE_S, Api, PaperSite, address_of
from ols_demo.site import Site
from PIL import Image
from playwright.sync_api import expect

SECONDS = 60
pytest_plugins = ["console_fixtures"]


def command(log, *options):
    users = ["--users", str(log.parent / "nobody")]
    return [str(BIN / "ols-console"), "--replay", str(log), *users, "--port", "0", *options]


def write_event(folder, utime_us):
    """What a recorder keeps: frames of two seconds, black."""
    event = folder / "20231114T221330.000Z_bird"
    event.mkdir(parents=True)
    rows = ["utime_us,number,file,mid_exposure_sd_s,pixel_format"]
    for number in range(20):
        name = f"{utime_us + 100_000 * number}.png"
        Image.fromarray(np.full((96, 128), 5, np.uint8)).save(event / name)
        rows.append(f"{utime_us + 100_000 * number},{number},{name},0.0001,Mono8")
    (event / "frames.csv").write_text("\n".join(rows) + "\n")


def damage(log):
    """Garbage before it, a cut-off end, and a target of another version."""
    whole = log.read_bytes()
    body = whole.index(b"OLS_TARGET") + len("OLS_TARGET")
    log.write_bytes(b"garbage" + whole[:body] + bytes(8) + whole[body + 8 : -10])


@pytest.fixture(scope="module")
def replay(network, tmp_path_factory):
    """The address of a console that replays, and the log's first time."""
    folder = tmp_path_factory.mktemp("replay")
    start_us = PaperSite().write_log(folder / "run.lcmlog", SECONDS)
    damage(folder / "run.lcmlog")
    write_event(folder / "events", start_us + 40_000_000)
    with Site(folder / "logs") as site:
        options = ("--frames", f"alfa={folder / 'events'}")
        site.start_and_wait("replay", command(folder / "run.lcmlog", *options), "ready")
        yield address_of(site, "replay"), start_us
        site.check()


@pytest.fixture
def page(chromium, replay):
    opened = chromium.new_context(viewport={"width": 1280, "height": 800}).new_page()
    opened.set_default_timeout(DEADLINE_S * 1000)
    opened.goto(replay[0])
    expect(bar(opened).get_by_role("button", name=re.compile("Play|Pause"))).to_be_visible()
    yield opened
    opened.context.close()


def bar(page):
    return page.get_by_role("region", name="Replay", exact=True)


def go(page, seconds):
    slider = bar(page).get_by_label("Instant")
    low, high = (float(slider.get_attribute(name)) for name in ("min", "max"))
    slider.fill(str(round((low + seconds * 1000 - low % 100) / 100) * 100 if high else 0))


def shown_s(replay):
    state = Api(replay[0]).state()
    return (state["time_us"] - replay[1]) / 1e6


def pause(page):
    button = bar(page).get_by_role("button", name=re.compile("Play|Pause"))
    if button.inner_text() == "Pause":
        button.click()
    expect(button).to_have_text("Play")


def test_it_is_clearly_a_replay_without_commands(page):
    expect(bar(page)).to_contain_text("recorded, not now; no command goes out")
    expect(page.get_by_role("button", name="Stop all")).to_have_count(0)
    page.keyboard.press("Escape")
    expect(page.get_by_text("This is a replay: stop at the live console")).to_be_visible()
    stations = page.get_by_role("region", name="Stations", exact=True)
    stations.get_by_role("button", name="alfa").click()
    expect(stations.get_by_text("Control")).to_be_visible()
    expect(stations.get_by_role("button", name="Release")).to_have_count(0)


def test_no_command_goes_out(replay):
    status, said, _ = Api(replay[0]).ask("/api/stop", {})
    assert status == 409
    assert said["error"] == "this is a replay: commands are not sent"


def test_a_log_of_former_messages_is_shown(network, tmp_path):
    with Site(tmp_path / "logs") as site:
        log = tmp_path / GOLDEN_LOG.name
        log.symlink_to(GOLDEN_LOG)
        site.start_and_wait("replay", command(log), "ready")
        api = Api(address_of(site, "replay"))
        wait(lambda: api.state()["replay"]["read"] >= 1, "the whole log")
        _, timeline, _ = api.ask("/api/replay")
        marks = {(mark["station"], mark["text"]) for mark in timeline["marks"]}
        assert {("bravo", "rearm"), ("delta", "stop"), ("alfa", "record golden")} <= marks
        wait(lambda: api.state()["targets"], "a target")
        state = api.state()
    assert [s["id"] for s in state["stations"]] == ["alfa", "bravo", "charlie", "delta"]
    assert state["targets"][0]["class"] == "unknown"
    assert state["targets"][0]["size_m"] is None


def test_scrubbing_shows_the_state_of_the_instant(page, replay):
    pause(page)
    stations = page.get_by_role("region", name="Stations", exact=True)
    go(page, 50)
    wait(lambda: abs(shown_s(replay) - 50) < 0.2, "50 s")
    expect(stations.get_by_role("button", name="alfa")).to_contain_text("stopped")
    expect(page.get_by_role("region", name="History")).to_contain_text("stop → done")
    go(page, 10)
    wait(lambda: abs(shown_s(replay) - 10) < 0.2, "10 s")
    expect(stations.get_by_role("button", name="alfa")).to_contain_text("idle")
    expect(page.get_by_role("region", name="History")).not_to_contain_text("stop")
    expect(page.get_by_role("region", name="Targets")).to_contain_text("380.0 m")


def test_it_plays_and_pauses_at_a_speed(page, replay):
    pause(page)
    go(page, 5)
    wait(lambda: abs(shown_s(replay) - 5) < 0.2, "5 s")
    bar(page).get_by_label("Speed").select_option("30")
    bar(page).get_by_role("button", name="Play").click()
    expect(bar(page).get_by_role("button", name="Pause")).to_be_visible()
    wait(lambda: shown_s(replay) > 30, "30 s of the recording")
    pause(page)
    at = shown_s(replay)
    assert shown_s(replay) == at
    bar(page).get_by_label("Speed").select_option("1")


def test_the_timeline_leads_to_events(page, replay):
    pause(page)
    go(page, 1)
    choice = bar(page).get_by_label("Go to")
    expect(choice.locator("option", has_text="supply voltage low")).to_have_count(1)
    expect(choice.locator("option", has_text="target begins")).to_have_count(1)
    expect(bar(page).locator(".marks .command")).to_have_count(1)
    bar(page).get_by_role("button", name="Next event").click()
    wait(lambda: abs(shown_s(replay) - SECONDS / 2) < 0.3, "the alarm")
    expect(page.locator(".stations .badge")).to_have_count(1)


def test_recorded_frames_are_shown(page, replay):
    pause(page)
    choice = bar(page).get_by_label("Go to")
    choice.select_option(choice.locator("option", has_text="bird").get_attribute("value"))
    wait(lambda: abs(shown_s(replay) - 40) < 0.2, "the recorded event")
    page.wait_for_function(
        """() => {
          const c = document.querySelector('[aria-label=alfa][role=img]');
          return c.getContext('2d').getImageData(c.width * 0.2, c.height * 0.2, 1, 1).data[0] < 30;
        }"""
    )


def test_all_of_it_can_be_read_in_two_languages(page):
    page.add_init_script(DRAWN_TEXT)
    page.reload()
    pause(page)
    go(page, SECONDS / 2)
    expect(page.locator(".stations .badge")).to_have_count(1)
    expect(bar(page).get_by_role("alert")).to_contain_text("damaged, the first is byte 0; the end")
    assert found_at_each_size(page) == {}
    page.get_by_label("Language").select_option("de")
    said = page.get_by_role("region", name="Wiedergabe").get_by_role("alert")
    expect(said).to_contain_text("beschädigt, das erste ist Byte 0; das Ende ist abgeschnitten; 1 ")
    expect(said).not_to_contain_text(re.compile("damaged|cut|another"))
    assert unreadable(page) == []


@pytest.mark.parametrize("content", [None, b"", b"a letter"])
def test_what_is_no_log_is_named(tmp_path, content):
    log = tmp_path / "run.lcmlog"
    if content is not None:
        log.write_bytes(content)
    done = finished(*command(log))
    assert done.returncode == 2
    assert f"ols-console: {log}: " in done.stderr


def test_the_demo_replays_its_log(network, tmp_path):
    """tools/demo --console-only: the console alone, at the address that it prints. The terminal
    says what the page says of a damaged log."""
    log = tmp_path / "run.lcmlog"
    PaperSite().write_log(log, 5)
    damage(log)
    demo = [sys.executable, "-m", "ols_demo", "--console-only", str(log)]
    process = subprocess.Popen(
        [*demo, "--output", str(tmp_path / "out"), "--bin", str(BIN)],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    try:
        address = next(m[1] for line in process.stdout if (m := re.search(r"(http\S+)", line)))
        assert Api(address).state()["replay"]["file"] == "run.lcmlog"
        warning = next(line for line in process.stdout if "[warning]" in line)
        assert "byte 0; the end is cut off; 1 message is damaged or of another version" in warning
    finally:
        process.terminate()
        process.wait(DEADLINE_S)
