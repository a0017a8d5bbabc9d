"""The direction of dependencies: each folder may include only what stands below it."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)
SOURCES = sorted(
    path
    for folder in ("geometry", "base", "edge", "central", "tools")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".h", ".cpp"}
)

# Folder of the project -> folders of the project that it may include.
ALLOWED = {
    "geometry": {"geometry"},
    "base": {"base"},
    "edge": {"edge", "geometry", "base"},
    "central": {"central", "geometry", "base"},
    "tools": {"tools", "edge", "central", "geometry", "base"},
}
# Pure parts: no clock, file, socket, message bus, device or configuration file.
PURE = [
    "geometry/*",
    "edge/station.*",
    "edge/station_commands.*",
    "edge/station_report.*",
    "edge/trouble_log.*",
    "edge/station_types.*",
    "edge/angular_track.*",
    "edge/command_gate.*",
    "edge/refusal_watch.*",
    "edge/target_tracker.h",
    "edge/camera/frame.h",
    "edge/camera/clock_map.*",
    "edge/camera/frame_clock.*",
    "edge/camera/frame_numbers.*",
    "edge/camera/picture.*",
    "edge/clock/chrony_tracking.*",
    "edge/clock/clock_reading.*",
    "edge/clock/clock_watch.*",
    "edge/gpio/led_pattern.*",
    "edge/gpio/rearm_input.*",
    "edge/gpio/stop_input.*",
    "edge/ptu/budget.*",
    "edge/ptu/codec.*",
    "edge/ptu/keep_out.*",
    "edge/ptu/motion_commands.*",
    "edge/ptu/poll_cycle.*",
    "edge/ptu/position_check.*",
    "edge/ptu/start_sequence.*",
    "edge/ptu/steady_state.*",
    "edge/ptu/unit_model.*",
    "edge/ptu/driver.*",
    "edge/ptu/servo.*",
    "edge/ptu/angle_history.*",
    "edge/sensors/dpg2.*",
    "edge/sensors/gnss_from_gpsd.*",
    "edge/sensors/kept_*",
    "edge/sensors/pose_keeper.*",
    "edge/sensors/standing_value.h",
    "edge/recorder/frame_memory.*",
    "edge/tracker/*",
    "central/*/*",
    "tools/sim/world.*",
    "tools/sim/renderer.*",
    "tools/sim/ptu_unit.*",
    "tools/sim/ptu_axis.*",
    "tools/sim/ptu_controller.*",
]
NOT_PURE = [  # what stands beside them and is not
    "central/app/main.cpp",
    "central/app/messages*",
    "central/app/fusion_bus.*",
    "central/app/fusion_process.*",
    "central/app/fusion_settings.*",
    "edge/tracker/tracker_config.cpp",
]
FORBIDDEN_IN_PURE = re.compile(
    r"^(lcm/|ols_msg/|arv|glib|gio|libserialport|systemd/|spdlog/|CLI/|toml\+\+|base/|"
    r"fstream$|iostream$|filesystem$|thread$|mutex$|condition_variable$|chrono$|ctime$|unistd\.h$|"
    r"fcntl\.h$|sys/|netinet/|arpa/|time\.h$|opencv2/videoio)"
)
CLOCK_OR_GLOBAL = re.compile(
    r"(system_clock|steady_clock|high_resolution_clock)::now|clock_gettime|gettimeofday|"
    r"\btime\(\s*(nullptr|NULL|0)\s*\)|\brand\(\)|random_device"
)
GENERATED = re.compile(r"^(ols_msg/|lcm/)")
MAY_SEE_MESSAGES = re.compile(r"(^|/)(messages[a-z_]*\.(h|cpp)|main\.cpp|lcm_bus\.(h|cpp))$")
ARAVIS_ONLY_IN = re.compile(r"/(aravis_|gige_|camera_server)[a-z_]*\.(h|cpp)$")


def relative(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def matches(path: Path, patterns: list[str]) -> bool:
    return any(path.relative_to(ROOT).match(pattern) for pattern in patterns)


def includes(text: str) -> list[str]:
    return INCLUDE.findall(text)


def violations(name: str, text: str, pure: bool) -> list[str]:
    """What is forbidden in this file; the tests below prove that it is found."""
    own = name.split("/")[0]
    found = []
    for include in includes(text):
        folder = include.split("/")[0]
        if "/" in include and folder in ALLOWED and folder not in ALLOWED[own]:
            found.append(f"{name} includes {include}")
        if pure and FORBIDDEN_IN_PURE.search(include):
            found.append(f"{name} is pure and includes {include}")
        if include.startswith("arv") and not ARAVIS_ONLY_IN.search(name):
            found.append(f"{name} sees Aravis: {include}")
    sees = any(GENERATED.search(include) for include in includes(text)) or "ols_msg::" in text
    if own != "tools" and sees and not MAY_SEE_MESSAGES.search(name):
        found.append(f"{name} sees messages")
    if pure and CLOCK_OR_GLOBAL.search(text):
        found.append(f"{name} is pure and reads a clock or a global generator")
    return found


@pytest.mark.parametrize("path", SOURCES, ids=relative)
def test_includes_only_what_it_may(path):
    pure = matches(path, PURE) and not matches(path, NOT_PURE)
    assert violations(relative(path), path.read_text(), pure) == []


@pytest.mark.parametrize(
    ("name", "text", "pure"),
    [
        ("edge/station.h", '#include "central/fusion/fusion.h"', False),
        ("central/fusion/fusion.h", '#include "edge/station.h"', False),
        ("geometry/sight.h", '#include "base/toml_config.h"', False),
        ("edge/camera/clock_map.h", "#include <fstream>", True),
        ("edge/station.cpp", '#include "ols_msg/bearing_t.hpp"', False),
        ("edge/station_process.cpp", "using M = ols_msg::bearing_t;", False),
        ("edge/main_loop.cpp", "#include <arv.h>", False),
        ("central/fusion/fusion.cpp", "auto t = std::chrono::system_clock::now();", True),
    ],
)
def test_a_forbidden_include_is_found(name, text, pure):
    assert violations(name, text, pure) != []


def test_every_pure_pattern_names_a_file():
    for pattern in PURE:
        assert any(path.relative_to(ROOT).match(pattern) for path in SOURCES), pattern


def test_no_branch_on_simulation_in_the_product():
    branch = re.compile(r"\bif\s*\(.*\b(sim|simulat\w*|fake)\b")
    for path in SOURCES:
        if relative(path).startswith(("geometry", "edge", "central", "base")):
            assert not branch.search(path.read_text()), relative(path)
