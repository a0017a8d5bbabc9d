"""The console's page at the sizes of screens, tablets and telephones, in each language: nothing on
it is cut or covered; what is large is a choice, and so are units and positions."""

import math
import re
import tomllib

import ols_msg
import pytest
from conftest import ROOT, wait
from console_page import (
    DRAWN_TEXT,
    SIZES,
    found_at_each_size,
    picture,
    region,
    unreadable,
    watched_page,
)
from console_site import DEADLINE_S, LOW_SUPPLY, PASSWORD
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

LONGEST_NAME = "bereitschaft-flugplatz-nord-schicht-zwei"
STATUS = ols_msg.station_status_t


@pytest.fixture
def busy(page, paper):
    """The page with what takes the most room: a station and a target open, an alarm."""
    page.add_init_script(DRAWN_TEXT)
    page.reload()
    paper.states |= {"alfa": STATUS.STATE_TRACKING, "bravo": STATUS.STATE_STOPPED}
    paper.alarms["charlie"] = [LOW_SUPPLY]
    region(page, "Stations").get_by_role("button", name="charlie").click()
    region(page, "Targets").get_by_role("row").nth(1).click()
    picture(page, "bravo")
    expect(region(page, "History")).to_contain_text("supply voltage low")
    yield page
    paper.states |= dict.fromkeys(paper.states, STATUS.STATE_IDLE)
    paper.alarms.clear()


def test_no_text_is_cut_or_covered(busy):
    languages = busy.get_by_label("Language")
    assert found_at_each_size(busy) == {}
    for width, height in SIZES:
        busy.set_viewport_size({"width": width, "height": height})
        expect(busy.locator(".utc")).to_be_in_viewport(ratio=1)
    languages.select_option("de")
    expect(busy.get_by_role("complementary", name="Ziel 7")).to_be_visible()
    busy.set_viewport_size({"width": 1280, "height": 720})
    busy.get_by_text("Maus und Tasten").click()
    hint = busy.get_by_text("Rahmen um das Objekt ziehen")
    expect(hint).to_be_visible()
    assert found_at_each_size(busy) == {}
    busy.keyboard.press("Escape")
    expect(hint).to_be_hidden()


def enter(page, password):
    page.locator("[name=name]").fill("eva")
    page.locator("[name=password]").fill(password)
    page.locator("form button").click()


def answer_with_many_users(route):
    """As of a large site, one of them with the longest name."""
    names = ["eva", LONGEST_NAME, *(f"operator-{number}" for number in range(18))]
    route.fulfill(json={"users": [{"name": n, "role": "admin", "sessions": 1} for n in names]})


@pytest.mark.parametrize("language", ["en", "de"])
def test_who_logs_in_and_who_keeps_the_users_can_read_all_of_it(chromium, consoles, language):
    context = chromium.new_context(color_scheme="dark", locale="fr-FR")
    page = context.new_page()
    page.set_default_timeout(DEADLINE_S * 1000)
    page.goto(consoles[1])
    enter(page, "not " + PASSWORD)
    expect(page.get_by_role("alert")).not_to_be_empty()
    page.get_by_label("Language").select_option(language)
    expect(page.locator("form button")).to_have_text({"en": "Log in", "de": "Anmelden"}[language])
    assert unreadable(page) == []
    enter(page, PASSWORD)
    page.route("**/api/users", answer_with_many_users)
    page.get_by_role("button", name=re.compile("Users|Benutzer")).click()
    row = page.get_by_role("dialog").get_by_role("row").filter(has_text=LONGEST_NAME)
    row.get_by_role("button").last.click()
    expect(row.get_by_role("alert")).to_be_visible()
    assert unreadable(page, ".bar") == [], "the dialog is below it and covers nothing of it"
    context.close()


WORD = re.compile(r"[A-Za-zÄÖÜäöüß]{3,}")
NAMES = {"alfa", "bravo", "charlie", "made", "paper", "gpiochip", "srv", "Esc"}


def words_of(page):
    """All that is written on it, and what a screen reader says."""
    texts = page.evaluate(
        """() => [...document.querySelectorAll("body *")].flatMap((one) => [
             ...[...one.childNodes].filter((node) => node.nodeType === 3).map((node) => node.data),
             ...["aria-label", "title", "alt"].map((name) => one.getAttribute(name) ?? ""),
           ])"""
    )
    return {word for text in texts for word in WORD.findall(text)}


def german_words():
    """Of the page's own texts and of what programs say: those that are the same in English, too."""
    words = (ROOT / "console/page/src/words.ts").read_text()
    pairs = re.findall(r'^  "?[\w ]+"?: \["(.*?)", "(.*)"\],$', words, re.M)
    table = tomllib.loads((ROOT / "conditions/conditions.toml").read_text())
    texts = [german for _, german in pairs]
    texts += [
        german
        for group in table["group"]
        for row in group["alarm"]
        for _, german in (*row["says"].values(), row["meaning"], row["action"])
    ]
    texts += [german for part in ("phrases", "words", "names") for german in table[part].values()]
    return {word for text in texts for word in WORD.findall(text)}


def test_no_english_stays_on_the_german_page(busy, paper):
    """Of a station with rare texts of devices, counters, and alarms with what stands in them."""
    paper.devices["charlie"] = {
        "inclinometer": "waiting for readings",
        "recorder": "12 events in /srv, recording",
        "lens": "not executable now",
        "gpio": "gpiochip0, stop pressed",
    }
    paper.counters["charlie"] |= {"frames_captured": 7, "refused_no_lens": 1, "seconds_tracking": 3}
    paper.readings["charlie"] = {"ptu_supply_V": 11.2, "turn_p99_s": 0.01}
    paper.alarms["charlie"] = [
        ("ptu_halted", {"why": "no plausible position: positions that contradict each other"}),
        (
            "calibration_not_checked",
            {"hours": "26.0", "why": "the unit does not come to its reference views"},
        ),
    ]
    expect(region(busy, "Stations")).to_contain_text("contradict each other")
    expect(region(busy, "Stations")).to_contain_text("refused no lens")
    english = words_of(busy)
    busy.get_by_label("Language").select_option("de")
    expect(region(busy, "Stationen")).to_contain_text("widersprechen")
    german = words_of(busy)
    assert len(english) > 150
    assert (english & german) - german_words() - NAMES == set()
    for of in (paper.devices, paper.readings, paper.counters):
        of.pop("charlie", None)
    paper.counters["charlie"] = {}


def test_what_is_large_is_a_choice_and_is_remembered(busy):
    def width_of(one):
        return one.bounding_box()["width"]

    busy.set_viewport_size({"width": 1500, "height": 900})
    small = width_of(picture(busy, "charlie"))
    busy.get_by_role("button", name="Pictures large").click()
    assert width_of(picture(busy, "charlie")) > 1.3 * small
    assert width_of(region(busy, "Map")) < width_of(region(busy, "Targets"))
    busy.get_by_text("Mouse and keys").click()
    assert found_at_each_size(busy) == {}
    busy.set_viewport_size({"width": 1500, "height": 900})
    busy.get_by_role("button", name="Only this picture").click()
    assert width_of(picture(busy, "charlie")) > 2 * small
    expect(busy.get_by_role("button", name="Stop all")).to_be_in_viewport()
    assert found_at_each_size(busy) == {}
    busy.reload()
    expect(region(busy, "Map")).to_be_hidden()
    busy.get_by_role("button", name="Only this picture").click()
    busy.get_by_role("button", name="Map large").click()
    expect(region(busy, "Map")).to_be_visible()


def test_units_and_positions_are_a_choice_and_are_remembered(page):
    row = region(page, "Targets").get_by_role("row").nth(1)
    expect(row).to_contain_text("49.226500° 16.597000°")
    page.get_by_label("Units").select_option("nautical")
    expect(row).to_contain_text("1247 ft")
    expect(row).to_contain_text("9.7 kn")
    for name, wanted in (
        ("minutes", "49°13.5900'N 16°35.8200'E"),
        ("seconds", "49°13'35.40\"N 16°35'49.20\"E"),
        ("mgrs", "33U XQ 16275 53862"),
    ):
        page.get_by_label("Positions").select_option(name)
        expect(row).to_contain_text(wanted)
        assert [*found_at_each_size(page, ".targets").values()] == []
    page.reload()
    expect(row).to_contain_text("33U XQ")
    expect(row).to_contain_text("9.7 kn")


def test_a_selected_target_shows_what_is_known_of_it(page, paper, chromium, consoles):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    region(page, "Targets").get_by_role("row").nth(1).click()
    panel = page.get_by_role("complementary", name="Target 7")
    for part in ("380.0 m", "5.0 m/s, 037°", "2.00 m · 1.00 m · 1.41 m", "alfa 0.0 s"):
        expect(panel).to_contain_text(part)
    panel.get_by_text("2.00 m ·").click()
    expect(panel.get_by_role("table", name="Covariance").get_by_role("cell")).to_have_text(
        ["4", "1", "0", "1", "1", "0", "0", "0", "2"]
    )
    panel.get_by_role("button", name="Copy").click()
    expect(panel.get_by_role("button", name="Copied")).to_be_visible()
    assert page.evaluate("navigator.clipboard.readText()") == "49.226500° 16.597000°"
    panel.get_by_role("button", name="Name it").click()
    page.keyboard.type("Drohne grün")
    page.keyboard.press("Enter")
    with watched_page(chromium, consoles[0]) as other:
        expect(region(other, "Targets")).to_contain_text("Drohne grün")
    panel.get_by_role("button", name="Close").click()
    expect(panel).to_have_count(0)


def test_a_station_is_pointed_at_a_target_and_at_a_place_on_the_map(page, paper):
    paper.states["alfa"] = STATUS.STATE_TRACKING
    paper.ptu_commands.clear()
    region(page, "Targets").get_by_role("row").nth(1).click()
    there = page.get_by_role("group", name="Point there")
    expect(there.get_by_role("button", name="alfa")).to_be_disabled()
    there.get_by_role("button", name="bravo").click()
    (first,) = wait(lambda: paper.ptu_commands, "the station that is pointed")
    assert (first.station, first.command) == ("bravo", first.COMMAND_POINT)
    # It counts pan to the left and looks to 1 rad at zero; the target is at 307.3 degrees.
    assert first.pan_rad == pytest.approx(1.0 - math.radians(307.3 - 360.0), abs=0.01)
    assert first.tilt_rad == pytest.approx(math.atan2(80.0, 275.0) - 0.2, abs=0.01)
    page.get_by_role("button", name="Place").click()
    box = region(page, "Map").bounding_box()
    page.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + 0.5 * box["height"])
    place = page.get_by_role("complementary", name="Place")
    expect(place).to_contain_text("33U XQ")
    place.get_by_role("button", name="charlie").click()
    wait(lambda: paper.ptu_commands[1:], "the other station that is pointed")
    assert paper.ptu_commands[1].station == "charlie"
    paper.states["alfa"] = STATUS.STATE_IDLE
