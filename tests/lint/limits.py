"""What the sources declare: classes, their data members, their files, and where functions end.

Read with universal-ctags; those of the page with its own compiler, which alone knows where an arrow
function ends.
"""

import json
import subprocess
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = (
    *("geometry", "calibration", "base", "command", "edge", "central", "console", "export", "cue"),
    "bridge",
    *("sim", "tools", "dev"),
)
PAGE_COMPILER = ROOT / "build/page-libraries/node_modules/typescript"


@dataclass
class Class:
    """A class or struct with behaviour; a struct of values alone is a record, not a class."""

    header: str = ""
    members: int = 0
    functions: int = 0
    bodies: set[str] = field(default_factory=set)  # .cpp files that define its functions


def sources(folders=FOLDERS) -> list[Path]:
    return sorted(
        path
        for folder in folders
        for path in (ROOT / folder).rglob("*")
        if path.suffix in {".h", ".cpp"}
    )


def python_sources(folders=FOLDERS) -> list[Path]:
    return sorted(path for folder in folders for path in (ROOT / folder).rglob("*.py"))


def page_sources() -> list[Path]:
    """Of the console's page."""
    return sorted((ROOT / "console/page/src").glob("*.ts*"))


def relative(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def declared(paths: list[Path]) -> list[dict]:
    """ctags' entries, one each declaration."""
    command = ["ctags", "--output-format=json", "--fields=+nKSe", "--kinds-C++=+p", "-f", "-"]
    done = subprocess.run(
        [*command, *map(str, paths)], capture_output=True, text=True, check=True, timeout=120
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def declared_by_page(paths: list[Path]) -> list[dict]:
    """The outermost functions of TypeScript sources: what stands within one is counted with it."""
    reader = Path(__file__).with_name("page_functions.mjs")
    command = ["node", reader, PAGE_COMPILER, *paths]
    done = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, check=True, timeout=120
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def definitions(tags: list[dict]) -> dict[str, set[str]]:
    """Full name of each type -> the files that define it; unnamed namespaces' are their own."""
    found: dict[str, set[str]] = defaultdict(set)
    for tag in tags:
        if tag["kind"] in ("class", "struct", "enum", "union"):
            found[f"{tag.get('scope', '')}::{tag['name']}"].add(tag["path"])
    return found


def function_lines(tags: list[dict]) -> list[tuple[str, int]]:
    """Where each function is defined, and its lines from its name to its end."""
    return [
        (f"{tag['path']}:{tag['line']} {tag['name']}", tag["end"] - tag["line"] + 1)
        for tag in tags
        if tag["kind"] in ("function", "member") and "end" in tag
    ]


def classes(tags: list[dict]) -> dict[str, Class]:
    """By their full names."""
    found: dict[str, Class] = defaultdict(Class)
    for tag in tags:
        if tag.get("scopeKind") not in ("class", "struct"):
            continue
        one = found[tag["scope"]]
        if tag["kind"] == "member" and "static constexpr" not in tag["pattern"]:
            one.members += 1
            one.header = tag["path"]
        elif tag["kind"] in ("function", "prototype"):
            is_constructor = tag["name"].lstrip("~") == tag["scope"].split("::")[-1]
            one.functions += not is_constructor
            if tag["path"].endswith(".cpp"):
                one.bodies.add(tag["path"])
    return found
