"""The messages' own definitions (lcmtypes/) as Arrow schemas: one source for wire and archive.

A comment of a definition becomes its column's description, so that a file of the archive says the
unit and the frame of each of its columns.
"""

import re
from dataclasses import dataclass
from importlib.resources import files

import pyarrow as pa

SCALARS = {
    "int8_t": pa.int8(),
    "int16_t": pa.int16(),
    "int32_t": pa.int32(),
    "int64_t": pa.int64(),
    "float": pa.float32(),
    "double": pa.float64(),
    "boolean": pa.bool_(),
    "string": pa.string(),
}
FIELD = re.compile(r"^\s*(\w+)\s+(\w+)((?:\[\w+\])*)\s*;(?:\s*//\s*(.*))?$")
COMMENT = re.compile(r"^\s*//\s*(.*)$")


@dataclass(frozen=True)
class Field:
    name: str
    type: pa.DataType
    description: str


def list_of(kind: pa.DataType, size: int = -1) -> pa.DataType:
    """Of so many, or of any number. With Parquet's own name: what is read back is the same type."""
    return pa.list_(pa.field("element", kind), size)


def arrow_type(word: str, dimensions: list[str]) -> pa.DataType:
    """Of `double bias_rad[stations][2]`: a list, as long as another field says, of pairs."""
    if word == "byte" and len(dimensions) == 1:
        return pa.binary()
    result = SCALARS[word]
    for dimension in reversed(dimensions):
        result = list_of(result, int(dimension) if dimension.isdigit() else -1)
    return result


def parse(text: str) -> list[Field]:
    """The fields of one message, in order. A comment behind a field is its description, with the
    lines that continue it; one above it stands for those below without their own."""
    fields: list[Field] = []
    above, goes_on = "", False
    for line in text.split("{", 1)[1].splitlines():
        found, comment = FIELD.match(line), COMMENT.match(line)
        if found and found[1] != "const":
            dimensions = re.findall(r"\[(\w+)\]", found[3])
            fields.append(Field(found[2], arrow_type(found[1], dimensions), found[4] or above))
            goes_on = bool(found[4])
        elif comment and goes_on and line.index("//") > 4:
            last = fields.pop()
            fields.append(Field(last.name, last.type, f"{last.description} {comment[1]}"))
        elif comment:
            above = comment[1] if goes_on or not above else f"{above} {comment[1]}"
            goes_on = False
        else:
            above, goes_on = "", False
    return fields


def fields_of(message: str) -> list[Field]:
    """Of a message by the name of its definition, without `.lcm`."""
    return parse((files("ols_lcmtypes") / f"{message}.lcm").read_text())
