"""Each library has its own namespace; geometry and base are the vocabulary of all: `ols`."""

import re

import limits
import pytest

NAMESPACES = {
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
    "edge/tracker": "ols::tracker",
    "edge": "ols::station",
    "central": "ols::fusion",
    "command": "ols::command",
    "console": "ols::console",
    "export": "ols::exports",  # export is a word of C++
    "sim": "ols::sim",
    "tools/calibrate": "ols::calibration",
    "tools/ctl": "ols::ctl",
    "tools/doctor": "ols::doctor",
    "tools/logger": "ols::logger",
    "tools/offline": "ols::offline",
    "tools/python": "ols::python",
    "dev/bench": "ols::bench",
    "dev/estimators": "ols::bench",
}
# But for a forward declaration of another library's type.
OPENED = re.compile(r"^namespace (ols[\w:]*) \{(?!\n(?:struct|class) \w+;\n\})", re.MULTILINE)


def wanted(name: str) -> str:
    folders = [folder for folder in NAMESPACES if name.startswith(folder + "/")]
    return NAMESPACES[max(folders, key=len)]


def strangers(name: str, text: str) -> set[str]:
    """Namespaces that the file opens and that are neither its own nor inside of it."""
    own = wanted(name)
    return {opened for opened in OPENED.findall(text) if not (opened + "::").startswith(own + "::")}


@pytest.mark.parametrize("path", limits.sources(), ids=limits.relative)
def test_a_file_declares_in_its_librarys_namespace(path):
    name = limits.relative(path)
    if any(name.startswith(folder + "/") for folder in NAMESPACES):
        assert strangers(name, path.read_text()) == set()


def test_a_strange_namespace_is_found():
    assert strangers("edge/camera/frame.h", "namespace ols {\n}") == {"ols"}
    assert strangers("edge/camera/frame.h", "namespace ols::camera::detail {\n}") == set()
