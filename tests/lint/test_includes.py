"""The direction of dependencies: each folder may include only what stands below it."""

import re
from fnmatch import fnmatch
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)
# Folder of the project -> folders of the project that it may include.
ALLOWED = {
    "geometry": {"geometry"},
    "calibration": {"calibration", "geometry"},
    "base": {"base"},
    "command": {"command", "base"},
    "edge": {"edge", "calibration", "geometry", "base"},
    "central": {"central", "geometry", "base"},
    "console": {"console", "command", "geometry", "base"},
    "export": {"export", "geometry", "base"},
    "cue": {"cue", "export", "geometry", "base"},
    "bridge": {"bridge", "geometry", "base"},
    "sim": {"sim", "edge", "central", "geometry", "base"},
    "tools": {
        *(
            "tools",
            "bridge",
            "command",
            "console",
            "cue",
            "export",
            "edge",
            "central",
            "calibration",
        ),
        *("geometry", "base"),
    },
    "dev": {
        *(
            "dev",
            "tools",
            "bridge",
            "sim",
            "console",
            "cue",
            "export",
            "edge",
            "central",
            "calibration",
        ),
        *("geometry", "base"),
    },
}
SOURCES = sorted(
    path
    for folder in ALLOWED
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".h", ".cpp"}
)

# Everything in these folders is pure: no clock, thread, file, socket, message bus, device
# or configuration file, and no header of what is not pure.
PURE_FOLDERS = (
    *("geometry", "calibration", "base", "command", "edge", "central", "console", "export", "cue"),
    *("bridge", "sim"),
)
# All but these.
NOT_PURE = {
    "files": "base/append_line.* base/atomic_file.* base/background_file.cpp "
    "base/calibration_csv.cpp base/csv_files.cpp base/csv_rows.h "
    "base/fix_writer.* base/log_reader.* base/output_check.cpp "
    "base/small_file.cpp base/status_file.cpp base/toml_config.cpp base/toml_merge.cpp "
    "base/toml_text.cpp base/persisted_word.cpp "
    "base/trust/key_file.cpp base/trust/marks_file.* base/trust/site_keeper.* "
    "edge/calibration/*.cpp edge/drift/reference_views.* edge/drift/kept_calibration.* "
    "edge/drift/next_calibration.* "
    "edge/recorder/event_folder.cpp edge/recorder/event_store.cpp "
    "export/conversion.cpp export/fixes.cpp export/geoid.cpp sim/report.cpp "
    "sim/station_files.cpp sim/station_truth_file.cpp",
    "the message bus": "base/bus_* base/channel_pattern.cpp base/config_common.cpp "
    "base/lcm_bus.* base/lcm_url.* "
    "base/multicast_socket.* base/trust/bus_trust.* base/trust/messages_trust.* "
    "base/trust/trust_options.h command/messages.* console/console_bus.* console/messages* "
    "edge/messages* edge/video/messages_video.* central/app/messages* "
    "central/app/fusion_bus.* export/export_bus.* export/exporter.* export/messages.* "
    "export/fixes.h export/readiness.* cue/cue_bus.* cue/messages.* "
    "bridge/bridge_bus.* bridge/messages.* sim/*flood.cpp sim/recording.cpp",
    "the operating system": "base/alarm_journal.* base/boot_id.cpp base/clocks.h "
    "base/command_line.h base/command_output.cpp base/journal.* "
    "base/plain_text.cpp base/progress.cpp base/service_frame.* base/service_notifier.cpp "
    "base/shutdown.cpp base/tcp_keepalive.cpp base/trouble_log.cpp "
    "base/wakeup.cpp "
    "edge/host_monitor.cpp edge/rearm_signal.cpp edge/clock/clock_pair.cpp "
    "edge/clock/clock_source.cpp",
    "devices and their threads": "edge/device/behind_control_loop.* edge/device/device_thread.* "
    "edge/camera/aravis_*.cpp edge/camera/aravis_error.h "
    "edge/camera/aravis_session.h edge/camera/camera_handover.* edge/camera/tai_reference.cpp "
    "edge/frame_desk.* edge/frame_post.* "
    "edge/gpio/gpio.cpp edge/gpio/gpio_lines_* edge/ptu/ptu_thread.cpp edge/serial/serial_port.cpp "
    "edge/lens/lens_motor.cpp "
    "edge/recorder/recorder.cpp edge/sensors/gnss.cpp edge/sensors/gnss_from_gpsd.* "
    "edge/sensors/gpsd_link.* edge/sensors/inclinometer.cpp "
    "console/video_link.* console/video_puller.* edge/video/video_server.cpp "
    "edge/video/video_session.*",
    "in memory only, but with OpenCV's header of files": "edge/video/preview_picture.cpp",
    "receivers and their connections": "export/outlet/file_link.cpp export/outlet/mqtt_link.cpp "
    "export/outlet/queued_outlet.* export/outlet/sapient_link.* export/outlet/stream_link.* "
    "export/outlet/tcp_socket.cpp export/outlet/mqtt_link.h export/outlet/udp_outlet.* "
    "export/factory.cpp "
    "cue/inlet/inlet.cpp cue/inlet/poll_inlet.* cue/inlet/tcp_inlet.* cue/inlet/udp_inlet.*",
    "servers of NATS": "bridge/archive_stream.* bridge/nats_link.* bridge/owner_store.*",
    "simulated devices on real wires": "sim/simulated_camera.cpp sim/exposure_cue.* "
    "sim/gige_control.* sim/gige_device.* sim/gige_stream.* "
    "sim/gnss_line.cpp sim/gpio_socket.cpp sim/inclinometer_line.cpp sim/lens_line.cpp "
    "sim/live_site.* sim/nmea.cpp "
    "sim/ptu_line.cpp sim/ptu_tap.cpp sim/pty.cpp sim/stepped_clock.cpp",
    "programs": "console/add_user.cpp console/handed_over_socket.cpp "
    "console/live_socket.h console/main.cpp "
    "console/maps/map_library.cpp console/maps/mbtiles.cpp console/maps/pmtiles.* "
    "console/maps/tile_folder.cpp console/replay/recorded_frames.cpp "
    "console/replay/replay.* console/web_server.cpp edge/main.cpp "
    "edge/station_process.* edge/kept_pose.cpp central/app/main.cpp "
    "central/app/fusion_process.* "
    "export/main.cpp cue/main.cpp "
    "bridge/main.cpp bridge/bridge_process.* sim/*main.cpp",
}
FORBIDDEN_IN_PURE = re.compile(
    r"^(lcm/|ols_msg/|arv|boost/beast|glib|gio|gpiod|gps\.h|systemd/|spdlog/|CLI/|toml\+\+|"
    r"fstream$|iostream$|filesystem$|thread$|mutex$|condition_variable$|chrono$|ctime$|csignal$|"
    r"signal\.h$|unistd\.h$|fcntl\.h$|poll\.h$|termios\.h$|pty\.h$|time\.h$|ifaddrs\.h$|"
    r"mosquitto\.h$|nats/|openssl/|proj\.h$|netdb\.h$|boost/asio/(io_context|ip/udp)|"
    r"sys/|net/|netinet/|arpa/|linux/|opencv2/(videoio|imgcodecs))"
)
CLOCK_OR_GLOBAL = re.compile(
    r"(system_clock|steady_clock|high_resolution_clock)::now|clock_gettime|gettimeofday|"
    r"\btime\(\s*(nullptr|NULL|0)\s*\)|\brand\(\)|random_device"
)
GENERATED = re.compile(r"^(ols_msg/|lcm/)")
MAY_SEE_MESSAGES = re.compile(r"(^|/)(messages[a-z_]*\.(h|cpp)|main\.cpp|lcm_bus\.(h|cpp))$")
ARAVIS_ONLY_IN = re.compile(r"/(aravis_|gige_|simulated_camera)[a-z_]*\.(h|cpp)$")


def relative(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def is_pure(name: str) -> bool:
    patterns = [pattern for group in NOT_PURE.values() for pattern in group.split()]
    return name.startswith(PURE_FOLDERS) and not any(fnmatch(name, p) for p in patterns)


def includes(text: str) -> list[str]:
    return INCLUDE.findall(text)


def impurities(name: str, text: str) -> list[str]:
    """What a pure file must not have."""
    found = [i for i in includes(text) if FORBIDDEN_IN_PURE.search(i)]
    own_folders = tuple(f"{folder}/" for folder in PURE_FOLDERS)
    found += [i for i in includes(text) if i.startswith(own_folders) and not is_pure(i)]
    if CLOCK_OR_GLOBAL.search(text):
        found.append("a clock or a global generator")
    return [f"{name} is pure and has {what}" for what in found]


def violations(name: str, text: str) -> list[str]:
    """What is forbidden in this file; the tests below prove that it is found."""
    own = name.split("/")[0]
    found = impurities(name, text) if is_pure(name) else []
    for include in includes(text):
        folder = include.split("/")[0]
        if "/" in include and folder in ALLOWED and folder not in ALLOWED[own]:
            found.append(f"{name} includes {include}")
        if include.startswith("arv") and not ARAVIS_ONLY_IN.search(name):
            found.append(f"{name} sees Aravis: {include}")
    sees = any(GENERATED.search(include) for include in includes(text)) or "ols_msg::" in text
    is_product = own in PURE_FOLDERS and own != "sim"
    if is_product and sees and not MAY_SEE_MESSAGES.search(name):
        found.append(f"{name} sees messages")
    return found


@pytest.mark.parametrize("path", SOURCES, ids=relative)
def test_includes_only_what_it_may(path):
    assert violations(relative(path), path.read_text()) == []


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("edge/station.h", '#include "central/fusion/fusion.h"'),
        ("central/fusion/fusion.h", '#include "edge/station.h"'),
        ("geometry/sight.h", '#include "base/toml_config.h"'),
        ("sim/world.h", '#include "dev/bench/synthetic_scene.h"'),
        ("edge/camera/clock_map.h", "#include <fstream>"),
        ("edge/station.cpp", '#include "ols_msg/bearing_t.hpp"'),
        ("edge/station_process.cpp", "using M = ols_msg::bearing_t;"),
        ("edge/main_loop.cpp", "#include <arv.h>"),
        ("central/fusion/fusion.cpp", "auto t = std::chrono::system_clock::now();"),
        ("edge/station.cpp", '#include "base/clocks.h"'),
        ("console/console.cpp", '#include "central/fusion/fusion.h"'),
        ("export/exporter.cpp", '#include "console/console.h"'),
        ("export/gate.cpp", "#include <proj.h>"),
        ("console/web_api.cpp", "#include <boost/beast/http.hpp>"),
        ("edge/a_new_file.cpp", "#include <thread>"),
    ],
)
def test_a_forbidden_include_is_found(name, text):
    assert violations(name, text) != []


def test_every_exception_is_needed():
    """Each pattern names files, and one at least that would not pass as pure."""
    for pattern in (pattern for group in NOT_PURE.values() for pattern in group.split()):
        named = [path for path in SOURCES if fnmatch(relative(path), pattern)]
        assert any(impurities(relative(path), path.read_text()) for path in named), pattern


def test_no_branch_on_simulation_in_the_product():
    branch = re.compile(r"\bif\s*\(.*\b(sim|simulat\w*|fake)\b")
    for path in SOURCES:
        if relative(path).startswith(PURE_FOLDERS[:-1]):
            assert not branch.search(path.read_text()), relative(path)
