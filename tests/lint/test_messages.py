"""The messages: one a file, and each of their fields is explained."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MESSAGES = sorted((ROOT / "lcmtypes").glob("*.lcm"))
FIELD = re.compile(r"^\s*(?:int\d+_t|float|double|boolean|byte|string)\s+(\w+)[^;]*;(.*)$")
# A name with its unit, and the arrays of a list whose count is explained, need no comment.
UNIT_IN_NAME = re.compile(r"_(rad|deg|m|px|s|us|hz|rad_s|rad2|m2|bytes)$")
PARALLEL_ARRAY = re.compile(
    r"\[(counters|stations|devices|alarms|alarm_ids|alarm_parameters|readings|jpeg_bytes)\]"
)


def unexplained(path: Path) -> list[str]:
    """Fields without a comment, neither on their line nor above it."""
    found = []
    above = ""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if field := FIELD.match(line):
            name, rest = field.groups()
            is_commented = "//" in rest or above.strip().startswith("//")
            if not (is_commented or UNIT_IN_NAME.search(name) or PARALLEL_ARRAY.search(line)):
                found.append(f"{path.name}:{number}: {name}")
        above = line
    return found


def test_every_field_of_a_message_is_explained():
    assert [field for path in MESSAGES for field in unexplained(path)] == []


def test_a_file_has_the_one_message_of_its_name():
    """Others find a message by the name of its file."""
    named = {path.name: re.findall(r"^struct (\w+)$", path.read_text(), re.M) for path in MESSAGES}
    assert {name: found for name, found in named.items() if found != [name[:-4]]} == {}


def fields(path: Path) -> list[tuple[str, ...]]:
    """Type, name and dimensions of each, in their order."""
    code = re.sub(r"//.*", "", path.read_text())
    return re.findall(r"^\s*(?!const|package)(\w+)\s+(\w+)((?:\[\w+\])*)\s*;", code, re.M)


def test_a_message_begins_with_the_fields_of_each_frozen_one():
    """So that its decoder reads what was recorded before (lcmtypes/former.h)."""
    frozen = {path: re.sub(r"_v\d+_t$", "_t", path.stem) for path in MESSAGES}
    pairs = [(path, path.with_stem(now)) for path, now in frozen.items() if now != path.stem]
    assert pairs
    for former, now in pairs:
        assert fields(now)[: len(fields(former))] == fields(former), former.name
        assert len(fields(now)) > len(fields(former)), former.name


def test_a_field_without_a_comment_is_found(tmp_path):
    path = tmp_path / "a_t.lcm"
    path.write_text("struct a_t\n{\n  double x;  // metres\n  double y;\n  double z_m;\n}\n")
    assert unexplained(path) == ["a_t.lcm:4: y"]
