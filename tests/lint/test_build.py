"""tools/build on a small project: the build follows the presets, the generator and the place."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import finished

ROOT = Path(__file__).resolve().parents[2]
PROJECT = """\
cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES NONE)
set(WORD "none" CACHE STRING "")
add_custom_target(say ALL COMMAND ${CMAKE_COMMAND} -E echo ${WORD} from ${CMAKE_SOURCE_DIR}
                  > ${CMAKE_BINARY_DIR}/said)
"""


def write_presets(checkout: Path, variables: dict[str, str]) -> None:
    preset = {
        "name": "release",
        "generator": "Ninja",
        "binaryDir": "${sourceDir}/build/release",
        "cacheVariables": variables,
    }
    builds = [{"name": "release", "configurePreset": "release"}]
    presets = {"version": 6, "configurePresets": [preset], "buildPresets": builds}
    (checkout / "CMakePresets.json").write_text(json.dumps(presets))


def build(checkout: Path) -> str:
    done = finished(checkout / "tools/build", "release")
    assert done.returncode == 0, done.stdout + done.stderr
    return (checkout / "build/release/said").read_text().strip()


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    folder = tmp_path / "first"
    (folder / "tools").mkdir(parents=True)
    shutil.copy(ROOT / "tools/build", folder / "tools")
    (folder / "tools/install-dependencies").symlink_to("/bin/true")
    (folder / "CMakeLists.txt").write_text(PROJECT)
    write_presets(folder, {"WORD": "one"})
    assert build(folder) == f"one from {folder}"
    return folder


def test_a_changed_preset_is_built(checkout):
    write_presets(checkout, {"WORD": "two"})
    assert build(checkout) == f"two from {checkout}"


def test_what_left_the_preset_leaves_the_build(checkout):
    write_presets(checkout, {})
    assert build(checkout) == f"none from {checkout}"


def test_a_moved_checkout_is_built_where_it_is_now(checkout):
    moved = checkout.rename(checkout.with_name("second"))
    assert build(moved) == f"one from {moved}"


def test_a_build_of_another_generator_is_configured_afresh(checkout):
    folder = checkout / "build/release"
    command = ["cmake", "--fresh", "-S", checkout, "-B", folder, "-G", "Unix Makefiles"]
    subprocess.run(command, capture_output=True, check=True)
    assert build(checkout) == f"one from {checkout}"
