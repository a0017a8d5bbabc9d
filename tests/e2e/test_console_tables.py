"""Targets, stations and history on the console's page, in a real browser: sorting, filters, every
command of a station, who has control, the fusion's state."""

import re

import ols_msg
import pytest
from conftest import wait
from console_page import axe_finds, picture, region, watched_page
from console_site import LOW_SUPPLY, PaperTarget
from ols_demo.places import geodetic
from playwright.sync_api import expect

pytest_plugins = ["console_fixtures"]

TARGET_T, PTU = ols_msg.target_t, ols_msg.ptu_command_t


def second_target(paper):
    """Higher than the other, and only just found."""
    place = geodetic(49.2270, 16.598, 500.0)
    return paper.another_target(PaperTarget(lambda _time_s: place, TARGET_T.TRACK_TENTATIVE))


def rows(page, name):
    return region(page, name).locator("tbody tr")


def test_targets_are_sorted_and_filtered(page, paper):
    with second_target(paper):
        targets = region(page, "Targets")
        expect(rows(page, "Targets")).to_have_count(2)
        heights = rows(page, "Targets").locator("td:nth-child(3)")
        for wanted, order in ((["380.0 m", "500.0 m"], "asc"), (["500.0 m", "380.0 m"], "desc")):
            targets.get_by_role("button", name="Height").click()
            expect(heights).to_have_text(wanted)
            heading = targets.get_by_role("columnheader", name="Height")
            expect(heading).to_have_attribute("aria-sort", f"{order}ending")
        targets.get_by_label("Filter").select_option("tentative")
        expect(heights).to_have_text(["500.0 m"])
        targets.get_by_label("Filter").select_option("all")
        expect(rows(page, "Targets")).to_have_count(2)


def test_the_hand_over_changes_when_it_is_set_and_not_when_it_is_chosen(page, paper):
    targets, handover = region(page, "Targets"), page.get_by_label("hand-over")
    expect(handover).to_have_value("off")
    handover.select_option("automatic")
    button = targets.get_by_role("button", name="set hand-over")
    expect(button).to_be_visible()
    assert paper.handover == "off"
    button.click()
    wait(lambda: paper.handover == "automatic", "the order")
    expect(handover).to_have_value("automatic")
    expect(button).to_have_count(0)
    expect(region(page, "History")).to_contain_text("sets the hand-over to automatic → done")
    paper.handover = "off"


def test_history_is_filtered(page, paper):
    paper.alarms["bravo"] = [LOW_SUPPLY]
    region(page, "Stations").get_by_role("button", name="alfa").click()
    region(page, "Stations").get_by_role("button", name="Release").click()
    history = region(page, "History")
    expect(history).to_contain_text("release → done")
    alarm = history.get_by_role("row", name="supply voltage low")
    alarm.get_by_role("button", name="Acknowledge").click()
    expect(alarm).to_contain_text("warning")
    expect(alarm).to_contain_text("acknowledged by operator")
    history.get_by_label("Filter").select_option("command")
    expect(history).not_to_contain_text("supply voltage low")
    history.get_by_label("Filter").select_option("alarm")
    expect(history).to_contain_text("supply voltage low")
    expect(history).not_to_contain_text("release")
    paper.alarms.clear()


def test_an_alarm_that_begins_is_told_to_who_cannot_see_it(page, paper):
    picture(page, "alfa")
    paper.alarms["alfa"] = [("camera_no_frames", {"seconds": "3"})]
    expect(page.get_by_role("alert")).to_have_text("Alarm: alfa camera: no frames for 3 s")
    paper.alarms.clear()


def test_each_command_of_a_station(page, paper):
    stations = region(page, "Stations")
    stations.get_by_role("button", name="charlie").click()
    for button, command in {
        "Home": PTU.COMMAND_HOME,
        "Re-arm": PTU.COMMAND_REARM,
        "Angles confirmed": PTU.COMMAND_REFERENCE_OK,
        "Stop": PTU.COMMAND_STOP,
        "Release": PTU.COMMAND_RELEASE,
    }.items():
        paper.ptu_commands.clear()
        stations.get_by_role("button", name=button, exact=True).click()
        if command in (PTU.COMMAND_HOME, PTU.COMMAND_REFERENCE_OK):
            stations.get_by_role("group", name="?").get_by_role("button", name=button).click()
        (first, *_) = wait(lambda: paper.ptu_commands, f"{button} on the bus")
        assert (first.station, first.command) == ("charlie", command)
        expect(page.locator("output.notice")).to_contain_text("done")


def test_what_may_be_dangerous_is_asked_about_first(page, paper):
    paper.ptu_commands.clear()
    stations = region(page, "Stations")
    stations.get_by_role("button", name="charlie").click()
    stations.get_by_role("button", name="Home", exact=True).click()
    question = stations.get_by_role("group", name="Is the way clear?")
    expect(question.get_by_role("button", name="No")).to_be_focused()
    assert axe_finds(page) == []
    question.get_by_role("button", name="No").click()
    expect(question).to_be_hidden()
    expect(stations.get_by_role("button", name="Home", exact=True)).to_be_focused()
    stations.get_by_role("button", name="Release", exact=True).click()
    wait(lambda: paper.ptu_commands, "the release")
    assert [m.command for m in paper.ptu_commands] == [PTU.COMMAND_RELEASE]


def test_a_question_holds_up_neither_the_stop_nor_its_own_answer(page, paper):
    paper.ptu_commands.clear()
    stations = region(page, "Stations")
    stations.get_by_role("button", name="charlie").click()
    stations.get_by_role("button", name="Home", exact=True).click()
    question = stations.get_by_role("group", name="Is the way clear?")
    page.get_by_role("button", name="Stop all").click()
    wait(lambda: ("charlie", "stop") in paper.commands[-9:], "the stop of all")
    page.wait_for_timeout(3500)  # longer than a command may be late: a person looks first
    paper.ptu_commands.clear()
    question.get_by_role("button", name="Home").click()
    wait(lambda: [m for m in paper.ptu_commands if m.command == PTU.COMMAND_HOME], "home")
    expect(page.locator("output.notice")).to_contain_text("charlie home: done")


def test_a_station_is_pointed_and_records(page, paper):
    paper.ptu_commands.clear()
    paper.records.clear()
    stations = region(page, "Stations")
    stations.get_by_role("button", name="bravo").click()
    expect(stations.get_by_label("Pan °")).to_have_value(re.compile(r"^-?\d+\.\d$"))
    expect(stations.get_by_role("button", name="Record")).to_have_count(0)
    paper.devices["bravo"] = {"recorder": "12 GB free"}
    stations.get_by_label("Pan °").fill("-12.5")
    stations.get_by_label("Tilt °").fill("4")
    stations.get_by_role("button", name="Point", exact=True).click()
    (pointed,) = wait(lambda: paper.ptu_commands, "the angles")
    assert (pointed.station, pointed.command) == ("bravo", PTU.COMMAND_POINT)
    assert pointed.pan_rad == pytest.approx(-0.218166, abs=1e-6)
    assert pointed.tilt_rad == pytest.approx(0.069813, abs=1e-6)
    stations.get_by_label("Label").fill("bird")
    stations.get_by_role("button", name="Record").click()
    (recorded,) = wait(lambda: paper.records, "the recording")
    assert (recorded.station, recorded.label) == ("bravo", "bird")
    assert (recorded.before_s, recorded.after_s) == (5.0, 5.0)
    paper.devices.clear()


def test_one_browser_has_control_until_another_takes_it_over(page, paper, chromium, consoles):
    ours = region(page, "Stations")
    ours.get_by_role("button", name="alfa").click()
    ours.get_by_role("button", name="Release").click()
    expect(ours).to_contain_text("you have control")
    with watched_page(chromium, consoles[0]) as other:
        theirs = region(other, "Stations")
        theirs.get_by_role("button", name="alfa").click()
        paper.ptu_commands.clear()
        theirs.get_by_role("button", name="Release").click()
        expect(other.locator("output.notice")).to_contain_text("has control")
        theirs.get_by_role("button", name="Take over").click()
        expect(theirs).to_contain_text("you have control")
        assert paper.ptu_commands == [], "what was refused is not on the bus"
        told = page.locator("output.notice")
        expect(told).to_have_text("operator 2 has taken control of alfa")
        theirs.get_by_role("button", name="Release").click()
        wait(lambda: paper.ptu_commands, "the command of who took over")
        expect(ours.get_by_role("button", name="Take over")).to_be_visible()
        theirs.get_by_role("button", name="Give up").click()
        expect(ours).to_contain_text("nobody has control")


def test_the_fusions_alarms_come_with_what_to_do(page, paper):
    paper.fusion_alarms = [("another_fusion", {})]
    expect(region(page, "Stations")).to_contain_text("What to do: stop one")
    paper.fusion_alarms = []
    expect(region(page, "Stations")).not_to_contain_text("another fusion")


def test_a_fusion_that_falls_silent_and_restarts(page, paper):
    """Said while it lasts; the numbers of the new one mean other objects."""
    fusion = page.get_by_role("listitem").filter(has_text="Fusion")
    with second_target(paper):
        expect(fusion).to_have_text("Fusion ok")
        expect(rows(page, "Targets")).to_have_count(2)
        paper.is_fusion_silent = True
        expect(fusion).to_have_text("Fusion silent")
        expect(rows(page, "Targets").first).to_have_class("stale")
    paper.fusion_boot, paper.is_fusion_silent = 10, False
    expect(fusion).to_have_text("Fusion ok")
    expect(rows(page, "Targets")).to_have_count(1)
