"""The tree itself: each message documents its fields, each file has one subject."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
MESSAGES = sorted((ROOT / "lcmtypes").glob("*.lcm"))
FIELD = re.compile(r"^\s*(?:int\d+_t|float|double|boolean|byte|string)\s+(\w+)[^;]*;(.*)$")
# A name with a unit in it needs no comment below the first of its kind.
UNIT_IN_NAME = re.compile(r"_(rad|deg|m|px|s|us|hz|rad_s|rad2|m2|bytes)$")


@pytest.mark.parametrize("path", MESSAGES, ids=lambda path: path.stem)
def test_one_message_a_file_and_every_field_explained(path):
    lines = path.read_text().splitlines()
    assert f"struct {path.stem}" in lines
    assert sum(line.startswith("struct ") for line in lines) == 1
    above = ""
    for line in lines:
        field = FIELD.match(line)
        if field:
            name, rest = field.groups()
            commented = "//" in rest or above.strip().startswith("//")
            in_array = re.search(
                r"\[(counters|stations|devices|alarms|readings|jpeg_bytes)\]", line
            )
            assert commented or UNIT_IN_NAME.search(name) or in_array, f"{path.name}: {line}"
        above = line
