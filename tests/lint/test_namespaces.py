"""Each library has its own namespace; geometry and base are the vocabulary of all: `ols`."""

import re

import limits
import pytest

NAMESPACES: dict[str, str | None] = {
    "geometry": "ols",
    "calibration": "ols::calibration",
    "base": "ols",
    "edge/calibration": "ols::calibration",
    "edge/camera": "ols::camera",
    "edge/clock": "ols::clock",
    "edge/device": "ols::device",
    "edge/gpio": "ols::gpio",
    "edge/lens": "ols::lens",
    "edge/ptu": "ols::ptu",
    "edge/recorder": "ols::recorder",
    "edge/video": "ols::video",
    "edge/sensors": "ols::sensors",
    "edge/serial": "ols::serial",
    "edge/tracker": "ols::tracker",
    "edge": "ols::station",
    "central": "ols::fusion",
    "command": "ols::command",
    "console": "ols::console",
    "export": "ols::exports",  # export is a word of C++
    "cue": "ols::cues",
    "bridge": "ols::bridge",
    "sim": "ols::sim",
    "tools/calibrate": "ols::calibration",
    "tools/ctl": "ols::ctl",
    "tools/doctor": "ols::doctor",
    "tools/exporter": "ols::exporter",
    "tools/key": "ols::key",
    "tools/logger": "ols::logger",
    "tools/offline": "ols::offline",
    "tools/python": "ols::python",
    "tools/setup": "ols::setup",
    "dev/bench": "ols::bench",
    "dev/config_reference": None,  # a program of one file
    "dev/estimators": "ols::bench",
}
# But for a forward declaration of another library's type.
OPENED = re.compile(r"^namespace (ols[\w:]*) \{(?!\n(?:struct|class) \w+;\n\})", re.MULTILINE)


def row(name: str) -> str:
    """The innermost folder with a row that the file is in; empty: none."""
    return max((one for one in NAMESPACES if name.startswith(one + "/")), key=len, default="")


def strangers(name: str, text: str) -> set[str]:
    """Namespaces that the file opens and that are neither its own nor inside of it."""
    own = NAMESPACES[row(name)]
    return {
        opened
        for opened in OPENED.findall(text)
        if own is None or not (opened + "::").startswith(own + "::")
    }


@pytest.mark.parametrize("path", limits.sources(), ids=limits.relative)
def test_a_file_declares_in_its_librarys_namespace(path):
    name = limits.relative(path)
    assert row(name), "its folder has no row in NAMESPACES"
    assert strangers(name, path.read_text()) == set()


def test_every_row_is_needed():
    rows = {row(limits.relative(path)) for path in limits.sources()}
    assert set(NAMESPACES) == rows


def test_a_strange_namespace_is_found():
    assert strangers("edge/camera/frame.h", "namespace ols {\n}") == {"ols"}
    assert strangers("edge/camera/frame.h", "namespace ols::camera::detail {\n}") == set()
    assert strangers("dev/config_reference/main.cpp", "namespace ols::x {\n}") == {"ols::x"}


def test_a_folder_without_a_row_is_found():
    assert row("tools/a_new_folder/main.cpp") == ""
    assert row("toolshed/main.cpp") == ""
    assert row("central/fusion/fusion.h") == "central"
