"""What the demo's terminal says of a site: of what is unknown or over, that it is. And the way into
its network for other programs."""

import math
import os
import re

import ols_msg
import pytest
from conftest import BIN, finished
from ols_demo import __main__ as demo
from ols_demo.evaluate import keep_targets
from ols_demo.finding import Finding
from ols_demo.inside import write_in_site
from ols_demo.live import Screen, at_work, station_lines, target_lines
from ols_demo.observer import Observer
from ols_demo.recording import Recording
from ols_demo.site import Site, SiteError

STATUS, TARGET = ols_msg.station_status_t, ols_msg.target_t
HEARD_US = 1_700_000_000_000_000


def status(station, state, **fields):
    m = STATUS()
    m.station, m.state = station, state
    m.azimuth_rad = m.elevation_rad = m.belief = math.nan
    m.target_offset_px = [math.nan, math.nan]
    for name, value in fields.items():
        setattr(m, name, value)
    return m


def target(**fields):
    m = TARGET()
    m.utime, m.latitude_deg, m.longitude_deg, m.height_m = HEARD_US, 49.2, 16.5, 400.0
    m.stations, m.used = 2, [True, True]
    for name, value in fields.items():
        setattr(m, name, value)
    return m


def heard(*messages):
    observer = Observer()
    for m in messages:
        observer.receive("OLS_TARGET" if isinstance(m, TARGET) else f"OLS_STATUS_{m.station}", m)
    return observer


def test_tracking_are_those_that_track():
    observer = heard(
        status("alfa", STATUS.STATE_LOST),
        status("bravo", STATUS.STATE_TRACKING),
        status("overview", STATUS.STATE_IDLE, kind=STATUS.KIND_OVERVIEW),
    )
    assert at_work(observer) == "1 of 2 stations track"


def test_what_is_unknown_is_a_dash():
    lines = station_lines(heard(status("alfa", STATUS.STATE_LOST)))
    assert len(lines[1]) == len(station_lines(heard(status("alfa", 0, belief=1.0)))[1])
    assert "nan" not in "".join(lines)
    assert "nan" not in "".join(target_lines(heard(target()), HEARD_US))


def test_a_target_without_a_position_has_none():
    nowhere = target(solution=TARGET.SOLUTION_TOO_FEW_RAYS, latitude_deg=math.nan)
    assert target_lines(heard(nowhere), HEARD_US) == ["target     none yet"]
    (place, *_) = target_lines(heard(target(), nowhere), HEARD_US + 100_000)
    assert "49.200000°" in place


def test_a_target_that_is_not_seen_any_more_is_none():
    (said, _) = target_lines(heard(target()), HEARD_US + 7_000_000)
    assert said == "target     none now, seen 7 s ago"


def test_a_file_gets_no_control_characters(capsys):
    screen = Screen()
    for left_s in (60, 50):
        screen.draw(f"4 of 4 stations track, {left_s} s left", heard(target()))
    said = capsys.readouterr().out
    assert said.count("4 of 4 stations track") == 2 and "\x1b" not in said


def test_a_demo_that_fails_leaves_no_report_of_an_earlier_one(tmp_path, monkeypatch, capsys):
    """Its programs are found by a relative path, too."""
    monkeypatch.chdir(BIN)
    for name in ("report.json", "report.png"):
        (tmp_path / name).write_text("of an earlier run")
    words = ["--output", tmp_path, "--bin", ".", "--scenario", tmp_path / "none.toml"]
    monkeypatch.setattr("sys.argv", ["demo", *map(str, words)])
    assert demo.main() == 1
    assert re.match("tools/demo: .*none.toml", capsys.readouterr().err)
    assert list(tmp_path.glob("report.*")) == []


def test_a_command_runs_in_the_network_of_the_demo(tmp_path):
    """Here it is our own; afterwards that of a process that has ended."""
    script = write_in_site(tmp_path, tmp_path, {"OLS_KEYS": "some keys"})
    look = ["sh", "-c", 'readlink /proc/self/ns/net; echo "$OLS_KEYS"; echo "$PATH"']
    done = finished(script, *look)
    assert done.returncode == 0, done.stderr
    network, keys, path = done.stdout.splitlines()
    assert (network, keys) == (os.readlink("/proc/self/ns/net"), "some keys")
    assert path.split(":")[0] == str(tmp_path)
    running = f"process=/proc/{os.readlink('/proc/self')}"
    script.write_text(script.read_text().replace(running, "process=/proc/4194305"))
    done = finished(script, *look)
    assert done.returncode == 1 and done.stderr.endswith("the demo has ended\n")


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["--headless"], "ols-station, ols-fusion, ols-sim, ols-key: build with"),
        (["--console-only", "run.lcmlog"], "ols-console: build with"),
        (["--output", "/dev/null/out"], "Not a directory: '/dev/null/out/report.json'"),
    ],
)
def test_what_is_missing_is_named(tmp_path, monkeypatch, capsys, words, problem):
    line = ["tools/demo", "--bin", str(tmp_path), "--output", str(tmp_path / "out"), *words]
    monkeypatch.setattr("sys.argv", line)
    assert demo.main() == 1
    said = capsys.readouterr().err
    assert said.startswith("tools/demo: ") and problem in said


def test_what_an_unattended_site_finds_is_said_once():
    said = []
    finding = Finding(said.append)
    bearing = ols_msg.bearing_t()
    bearing.station, bearing.detected = "overview", True
    incident = ols_msg.incident_t()
    incident.number, incident.target_id = 1, 2
    incident.object_class, incident.area = "drone", "site"
    fix = {"target_id": 2, "solution": TARGET.SOLUTION_OK, "station": ["alfa", "bravo"]}
    named = fix | {"object_class": TARGET.CLASS_DRONE, "class_probability": 0.93, "size_m": 1.2}
    observer = heard(status("alfa", STATUS.STATE_TRACKING), status("bravo", STATUS.STATE_TRACKING))
    for _ in range(2):
        finding.receive("OLS_BEARING_overview", bearing)
        finding.receive("OLS_TARGET", target(**fix))
        finding.receive("OLS_TARGET", target(**named))
        finding.receive("OLS_INCIDENT", incident)
    assert [line.split("s  ")[1] for line in said] == [
        "overview sees something for the first time",
        "target 2 is located by alfa, bravo",
        "target 2 is named: drone (0.93), 1.2 m",
        "ALARM: drone 2 is inside area site",
    ]
    assert finding.drones == {2}
    assert finding.holds(observer)
    assert not finding.holds(heard(status("alfa", STATUS.STATE_TRACKING)))


def test_a_run_is_judged_by_the_chosen_targets_and_the_first_ones_truth():
    recording = Recording()
    for arrival, number in enumerate((1, 2, 1)):
        recording.receive("OLS_TARGET", target(target_id=number), arrival)
        truth = ols_msg.truth_target_t()
        truth.target_id = number - 1
        recording.receive("OLS_SIM_TRUTH", truth, arrival)
    keep_targets(recording, {1})
    assert [t.target_id for t in recording.targets["OLS_TARGET"]] == [1, 1]
    assert recording.arrivals_us["OLS_TARGET"] == [0, 2]
    assert [t.target_id for t in recording.truth] == [0, 0]


def test_a_process_that_runs_is_not_replaced(tmp_path):
    """Nobody would end it."""
    idle = ["sleep", "600"]
    with Site(tmp_path) as site:
        site.start("idle", idle)
        with pytest.raises(SiteError, match="idle runs already"):
            site.start("idle", idle)
        site.stop("idle")
        site.start("idle", idle)
