"""Which way includes point, and which code is pure.

Pure code has no clock, thread, file, socket, message bus or device; time and bytes come in as
arguments. Every file of the product and the simulator is pure, unless

- its name says that it touches the outside, by its first word (`messages_lens.cpp`) or by its last
  (`gpsd_link.cpp`, `video_server.h`), or
- it is at the top of `base`, which wraps the operating system, or
- it is one of the few in OTHER_DEVICES.

Mathematics and decisions stand in PURE_FOLDERS. There a name excuses nothing.
"""

import re
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# Folder of the project -> folders that it may include, besides itself.
PRODUCT = {"bridge", "calibration", "central", "console", "cue", "edge", "export", "land"}
ALLOWED = {
    "geometry": set(),
    "conditions": set(),
    "base": {"conditions"},
    "calibration": {"geometry", "conditions"},
    "land": {"geometry", "base", "conditions"},
    "wire": {"geometry", "base", "conditions"},
    "edge": {"calibration", "land", "geometry", "base", "conditions"},
    "central": {"wire", "land", "geometry", "base", "conditions"},
    "console": {"wire", "land", "geometry", "base", "conditions"},
    "export": {"wire", "land", "geometry", "base", "conditions"},
    "cue": {"wire", "export", "land", "geometry", "base", "conditions"},
    "bridge": {"geometry", "base", "conditions"},
    "sim": {"edge", "central", "calibration", "land", "geometry", "base", "conditions"},
    "tools": {*PRODUCT, "wire", "geometry", "base", "conditions"},
    "dev": {*PRODUCT, "tools", "sim", "wire", "geometry", "base", "conditions"},
}
NOT_JUDGED = {"tools", "dev"}  # programs of users and developers, which may touch anything

PURE_FOLDERS = (
    *("geometry/", "calibration/", "edge/detector/", "edge/tracker/", "bridge/ownership/"),
    *("central/admission/", "central/cues/", "central/estimators/", "central/filter/"),
    *("central/fusion/", "central/ground/", "central/handover/", "central/measurement/"),
    *("central/classify/", "central/offline/", "central/tracking/"),
    *("export/asterix/", "export/files/", "export/mqtt/", "export/sapient/", "export/tak/"),
)
FIRST_WORDS = {"messages", "bus", "aravis", "gige", "kept"}
LAST_WORDS = {
    *("main", "process", "thread", "signal", "handover"),  # the operating system
    *("folder", "store", "recorder", "recording"),  # the disk
    *("bus", "link", "server", "session", "socket", "stream", "inlet", "outlet", "puller"),
    *(
        "line",
        "port",
        "camera",
        "mount",
        "receiver",
        "gpio",
        "gpsd",
        "libgpiod",
        "inclinometer",
        "motor",
    ),
    *("pty", "tap"),
}
OTHER_DEVICES = [
    "base/trust/*_file.*",
    "base/trust/site_keeper.*",
    "base/trust/trust_options.h",
    "console/add_user.cpp",
    "console/maps/map_library.cpp",
    "console/maps/*tiles.cpp",
    "console/replay/re*",
    "edge/calibration/*_file.cpp",
    "edge/calibration/calibration_*",
    "edge/calibration/reference_views.cpp",
    "edge/camera/tai_reference.cpp",
    "edge/clock/clock_pair.cpp",
    "edge/clock/clock_source.cpp",
    "edge/device/behind_control_loop.cpp",
    "edge/frames/frame_desk.*",
    "edge/frames/frame_post.*",
    "edge/process/device_set.*",
    "edge/process/host_monitor.cpp",
    "edge/*_kind*.cpp",  # they open the device
    "export/conversion.cpp",
    "export/exporter.*",
    "export/factory.cpp",
    "export/fixes.*",
    "land/geoid.cpp",
    "export/readiness.*",
    "sim/*flood.cpp",
    "sim/camera/exposure_cue.*",
    "sim/live/live_site.*",
    "sim/lockstep/report.cpp",
    "sim/*/simulated_*",
    "sim/scenario/station_*file*.cpp",
    "sim/processes/stepped_clock.cpp",
    "wire/*_status.*",
    "wire/orders.*",
    "wire/read.h",
    "wire/skyline.*",
    "wire/target.*",
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')
OUTSIDE = re.compile(
    r"^(lcm/|ols_msg/|arv|boost/beast|glib-|gio|gpiod|gps\.h|systemd/|spdlog/|CLI/|toml\+\+|"
    r"fstream$|iostream$|filesystem$|thread$|mutex$|condition_variable$|chrono$|csignal$|"
    r"signal\.h$|unistd\.h$|fcntl\.h$|poll\.h$|termios\.h$|pty\.h$|ifaddrs\.h$|"
    r"mosquitto\.h$|nats/|openssl/|proj\.h$|netdb\.h$|boost/asio/(io_context|ip/udp)|"
    r"sys/|net/|netinet/|arpa/|linux/|opencv2/videoio|"
    r"base/(bus/boot_id|process/(clocks|command_output|service_notifier)|journal/journal)\.h$)"
)
CLOCK_FILE_OR_GLOBAL = re.compile(
    r"_clock::now|\b(clock_)?gettime(ofday)?\(|\btime\(\s*(nullptr|NULL|0|&\w+)\s*\)|\bclock\(\)|"
    r"\b(localtime(_r)?|mktime|nanosleep|getenv)\(|\bs?rand\(|random_device|\bim(read|write)\(|"
    r"\bg_(get_\w*time|file_|thread_)"
)
GENERATED = re.compile(r"^(ols_msg|lcm)/")
MAY_SEE_MESSAGES = re.compile(r"/(messages\w*|\w*main|lcm_bus)\.\w+$")
MAY_SEE_ARAVIS = re.compile(r"/(aravis_\w+|gige_\w+|simulated_camera)\.\w+$")
BRANCH_ON_SIMULATION = re.compile(r"\bif\s*\(.*\b(sim|simulat\w*|fake)\b")


@cache
def sources() -> dict[str, str]:
    """Path below the root -> text, of all C++ that stands in a folder of ALLOWED."""
    return {
        path.relative_to(ROOT).as_posix(): path.read_text()
        for folder in ALLOWED
        for path in sorted((ROOT / folder).rglob("*"))
        if path.suffix in {".h", ".cpp"}
    }


def includes(text: str) -> list[tuple[int, str]]:
    """Line and name of each."""
    return [
        (number, found[1])
        for number, line in enumerate(text.splitlines(), 1)
        if "#" in line and (found := INCLUDE.match(line))
    ]


def is_judged(name: str) -> bool:
    return name.split("/")[0] not in NOT_JUDGED


def words(name: str) -> list[str]:
    return Path(name).stem.split("_")


def is_device(name: str) -> bool:
    by_name = words(name)[0] in FIRST_WORDS or words(name)[-1] in LAST_WORDS
    return by_name or any(fnmatch(name, pattern) for pattern in OTHER_DEVICES)


def is_pure(name: str) -> bool:
    if not is_judged(name) or re.match(r"base/(?!trust/)", name):
        return False
    return name.startswith(PURE_FOLDERS) or not is_device(name)


def reaches_directly(text: str) -> list[tuple[int, str]]:
    """Line and name of what leads outside in this text itself."""
    return [(number, name) for number, name in includes(text) if OUTSIDE.match(name)] + [
        (number, found[0])
        for number, line in enumerate(text.splitlines(), 1)
        if (found := CLOCK_FILE_OR_GLOBAL.search(line))
    ]


@cache
def outside_reached() -> dict[str, str]:
    """Source of the project -> what it reaches outside, itself or through what it includes."""
    reached = {
        name: first[0][1]
        for name, text in sources().items()
        if is_judged(name) and (first := reaches_directly(text))
    }
    included_by: dict[str, list[str]] = {}
    for name, text in sources().items():
        for _, include in includes(text):
            included_by.setdefault(include, []).append(name)
    waiting = list(reached)
    while waiting:
        header = waiting.pop()
        for name in included_by.get(header, []):
            if is_judged(name) and name not in reached:
                reached[name] = reached[header]
                waiting.append(name)
    return reached


# ---- rules: each gives what it finds wrong in one file ------------------------------------------


def upward(name: str, text: str) -> list[str]:
    own = name.split("/")[0]
    may = ALLOWED[own] | {own}
    return [
        f"{name}:{line}: {own} may not include {include}"
        for line, include in includes(text)
        if "/" in include and (folder := include.split("/")[0]) in ALLOWED and folder not in may
    ]


def impure(name: str, text: str) -> list[str]:
    if not is_pure(name):
        return []
    found = [f"{name}:{line}: pure code has {what}" for line, what in reaches_directly(text)]
    for line, include in includes(text):
        if OUTSIDE.match(include):
            continue
        through = outside_reached().get(include)
        if through:
            found.append(f"{name}:{line}: pure code includes {include}, which has {through}")
        elif name.startswith(PURE_FOLDERS):
            body = include.removesuffix("h") + "cpp"
            if behind := body != name and outside_reached().get(body):
                found.append(f"{name}:{line}: mathematics includes {include}: {body} has {behind}")
    return found


def sees_messages(name: str, text: str) -> list[str]:
    if not is_judged(name) or name.startswith(("sim/", "wire/")) or MAY_SEE_MESSAGES.search(name):
        return []
    return [
        f"{name}:{line}: only messages*, main.cpp and the bus see generated messages"
        for line, one in enumerate(text.splitlines(), 1)
        if "ols_msg::" in one or (found := INCLUDE.match(one)) and GENERATED.match(found[1])
    ]


def sees_aravis(name: str, text: str) -> list[str]:
    return [
        f"{name}:{line}: only aravis_* and the simulated camera see Aravis"
        for line, include in includes(text)
        if include.startswith("arv") and not MAY_SEE_ARAVIS.search(name)
    ]


def branches_on_simulation(name: str, text: str) -> list[str]:
    if not is_judged(name) or name.startswith("sim/"):
        return []
    return [
        f"{name}:{line}: a branch asks whether it runs in simulation"
        for line, one in enumerate(text.splitlines(), 1)
        if BRANCH_ON_SIMULATION.search(one)
    ]


@pytest.mark.parametrize(
    "rule", [upward, impure, sees_messages, sees_aravis, branches_on_simulation]
)
def test_the_tree_keeps_the_rule(rule):
    assert [what for name, text in sources().items() for what in rule(name, text)] == []


# ---- the rules themselves -----------------------------------------------------------------------


def test_a_violation_is_found():
    forbidden = [
        (upward, "edge/station/station.h", '#include "central/fusion/fusion.h"'),
        (upward, "central/fusion/fusion.h", '#include "edge/station/station.h"'),
        (upward, "geometry/sight.h", '#include "base/config/toml_config.h"'),
        (upward, "sim/world/world.h", '#include "dev/bench/synthetic_scene.h"'),
        (upward, "console/console.cpp", '#include "central/fusion/fusion.h"'),
        (upward, "export/exporter.cpp", '#include "console/console.h"'),
        (impure, "edge/camera/clock_map.h", "#include <fstream>"),
        (impure, "central/fusion/fusion.cpp", "auto t = std::chrono::system_clock::now();"),
        (impure, "edge/station/station.cpp", '#include "base/process/clocks.h"'),
        (impure, "edge/station/station.cpp", '#include "base/bus/bus_client.h"'),
        (impure, "export/gate.cpp", "#include <proj.h>"),
        (impure, "console/web_api.cpp", "#include <boost/beast/http.hpp>"),
        (impure, "edge/a_new_file.cpp", "#include <thread>"),
        (impure, "edge/tracker/a_new_link.cpp", "#include <thread>"),
        (impure, "central/filter/a_new_file.cpp", '#include "base/files/small_file.h"'),
        (sees_messages, "edge/station/station.cpp", '#include "ols_msg/bearing_t.hpp"'),
        (sees_messages, "edge/process/station_process.cpp", "using M = ols_msg::bearing_t;"),
        (sees_aravis, "edge/main_loop.cpp", "#include <arv.h>"),
        (branches_on_simulation, "edge/station/station.cpp", "  if (config.simulated) return;"),
    ]
    assert [(name, text) for rule, name, text in forbidden if not rule(name, text)] == []


def test_no_exception_is_left_over():
    """Each word and each pattern excuses a file that is not pure."""
    excused = [name for name in outside_reached() if not name.startswith(PURE_FOLDERS)]
    assert FIRST_WORDS - {words(name)[0] for name in excused} == set()
    assert LAST_WORDS - {words(name)[-1] for name in excused} == set()
    assert [one for one in OTHER_DEVICES if not any(fnmatch(name, one) for name in excused)] == []
