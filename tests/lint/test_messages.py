"""The messages: one a file, and each of their fields is explained."""

import hashlib
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


END = re.compile(r"^  // ---- (\w+)_v(\d+)_t ends here: (.*)$", re.M)


def fields(text: str) -> list[tuple[str, ...]]:
    """Type, name and dimensions of each, in their order."""
    code = re.sub(r"//.*", "", text)
    return re.findall(r"^\s*(?!const|package)(\w+)\s+(\w+)((?:\[\w+\])*)\s*;", code, re.M)


def sum_of(text: str) -> str:
    return hashlib.sha256(repr(fields(text)).encode()).hexdigest()[:8]


# Of the fields of each former message: their logs must be read for ever.
FORMER = {
    "bearing_v1": "31ee93e4",
    "bearing_v2": "696644f9",
    "bearing_v3": "15819c4e",
    "bearing_v4": "dc0b16cc",
    "cue_order_v1": "b07b09c1",
    "fusion_status_v1": "5eae55e2",
    "fusion_status_v2": "bc400360",
    "slew_v1": "88ef0ac0",
    "station_status_v1": "f51c5e11",
    "station_status_v2": "f655c9c8",
    "target_v1": "7ceb0a14",
    "target_v2": "4c15fc6c",
    "video_frame_v1": "3273b474",
}


def test_the_fields_of_a_former_message_stay_as_they_were():
    """So that the decoder reads what was recorded before (lcmtypes/former.h)."""
    former = {}
    for path in MESSAGES:
        text = path.read_text()
        for number, end in enumerate(END.finditer(text), 1):
            assert end.groups() == (path.stem[:-2], str(number), sum_of(text[: end.start()]))
            assert fields(text[end.end() :]), f"{path.name}: nothing behind {end[0]}"
            former[f"{end[1]}_v{end[2]}"] = end[3]
    assert former == FORMER


def test_a_field_without_a_comment_is_found(tmp_path):
    path = tmp_path / "a_t.lcm"
    path.write_text("struct a_t\n{\n  double x;  // metres\n  double y;\n  double z_m;\n}\n")
    assert unexplained(path) == ["a_t.lcm:4: y"]
