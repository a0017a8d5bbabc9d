"""Unit tests mirror the product and the simulator: each .cpp file has a test of its name.

The few others stand here with the reason. (dev/ is left out: developers run it and see it fail.)
"""

import re
from fnmatch import fnmatch
from pathlib import Path

import limits
import pytest

TESTS = limits.ROOT / "tests" / "unit"
# Why a group of files has no unit tests of its names -> the files.
WITHOUT: dict[str, str] = {
    "programs: they parse options and connect parts; the end-to-end tests run them": """
        *main.cpp tools/offline/precision_advice.cpp tools/offline/precision_map.cpp
        tools/offline/precision_paper_files.cpp tools/offline/recorded_bearings.cpp
        tools/offline/stationing_files.cpp tools/offline/stationing_report.cpp
        tools/doctor/examination.cpp tools/calibrate/calibrate_case.cpp tools/calibrate/camera.cpp
        tools/calibrate/adjust_command.cpp tools/calibrate/procedure_commands.cpp
        tools/calibrate/procedure_end.cpp tools/calibrate/procedure_stages.cpp
        tools/calibrate/view_check.cpp tools/calibrate/report_*.cpp
        tools/calibrate/result_files.cpp tools/calibrate/tracks.cpp
        tools/calibrate/zoom_command.cpp tools/ctl/subcommands.cpp
        export/factory.cpp""",
    "they own devices, sockets or threads of a process; the end-to-end tests run them": """
        base/lcm_bus.cpp base/multicast_socket.cpp edge/device_set.cpp edge/station_process.cpp
        central/app/fusion_bus.cpp central/app/fusion_process.cpp console/add_user.cpp
        console/console_bus.cpp console/handed_over_socket.cpp console/web_server.cpp
        tools/ctl/operator.cpp
        tools/doctor/bus_listener.cpp tools/doctor/probe_*.cpp tools/logger/bus_recorder.cpp
        export/export_bus.cpp export/outlet/sapient_link.cpp
        export/outlet/stream_link.cpp export/outlet/tcp_socket.cpp export/outlet/udp_outlet.cpp
        bridge/archive_stream.cpp bridge/bridge_bus.cpp bridge/bridge_process.cpp
        bridge/nats_link.cpp bridge/owner_store.cpp
        cue/cue_bus.cpp cue/inlet/*.cpp tools/ctl/cue_operator.cpp""",
    "Aravis and its peer: tested against each other (tests/unit/sim/camera_*_test.cpp)": """
        edge/camera/aravis_*.cpp tools/doctor/aravis_probe.cpp sim/simulated_camera.cpp
        sim/gige_control.cpp sim/gige_device.cpp""",
    "one end of a line: tested from its other end (gnss_test, gpio_lines_socket_test)": """
        edge/sensors/gpsd_link.cpp sim/gnss_line.cpp sim/gpio_socket.cpp""",
    "the kernel's clock, which a test cannot set": """
        edge/camera/tai_reference.cpp sim/stepped_clock.cpp""",
    "Python bindings: tested from Python (tests/oracle)": "tools/python/*.cpp",
    "parts of the fusion, tested through it (tests/unit/central/fusion and /tracking)": """
        central/estimators/estimator.cpp
        central/fusion/bearing_lines.cpp central/fusion/fusion_health.cpp
        central/fusion/track_intake.cpp central/tracking/track.cpp""",
    "targets of an adjustment, tested through it (target_test, pixel_block_test)": """
        calibration/targets/body.cpp calibration/targets/fixed.cpp
        calibration/targets/other_station.cpp calibration/targets/place_seen.cpp
        calibration/targets/scene.cpp calibration/targets/unknown.cpp""",
    "parts of ols-export, tested through it (exporter_test, home_encoder_test, cot_text_test)": """
        export/output.cpp export/home/discovery.cpp export/tak/cot_encoder.cpp""",
    "parts of the simulator, tested through it (scenario_test, world_test, lockstep_test)": """
        sim/lead_times.cpp sim/lockstep_station.cpp sim/panorama.cpp sim/recording.cpp
        sim/report.cpp sim/scenario_places.cpp sim/scenario_trajectory.cpp
        sim/sighted_landmarks.cpp""",
}


def subject(path: Path) -> str:
    return re.sub(r"^test_|_test$", "", path.stem)


TESTED = {subject(path) for path in TESTS.rglob("*.cpp")}
FOLDERS = [folder for folder in limits.FOLDERS if folder != "dev"]
SOURCES = [path for path in limits.sources(FOLDERS) if path.suffix == ".cpp"]
PATTERNS = [pattern for group in WITHOUT.values() for pattern in group.split()]


def is_excused(name: str) -> bool:
    return any(fnmatch(name, pattern) for pattern in PATTERNS)


@pytest.mark.parametrize("path", SOURCES, ids=limits.relative)
def test_a_source_has_a_test_of_its_name(path):
    assert path.stem in TESTED or is_excused(limits.relative(path))


@pytest.mark.parametrize("pattern", PATTERNS)
def test_every_exception_is_needed(pattern):
    """Each pattern names files, and none of them has a test of its name."""
    named = [path for path in SOURCES if fnmatch(limits.relative(path), pattern)]
    assert named
    assert [path for path in named if path.stem in TESTED] == []


def test_a_source_without_a_test_is_found():
    assert not is_excused("edge/a_new_file.cpp")
    assert "a_new_file" not in TESTED


def test_a_test_stands_where_its_source_does():
    folders: dict[str, set[str]] = {}
    for path in SOURCES:
        folder = limits.relative(path.parent).removeprefix("tools/")
        folders.setdefault(path.stem, set()).add(folder)
    misplaced = [
        f"{limits.relative(test)}: its source is in {sorted(folders[subject(test)])}"
        for test in TESTS.rglob("*.cpp")
        if subject(test) in folders
        and test.parent.relative_to(TESTS).as_posix() not in folders[subject(test)]
    ]
    assert misplaced == []
