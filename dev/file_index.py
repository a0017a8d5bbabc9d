"""What every file of the product is for: the first sentence of its own first comment.

python3 dev/file_index.py [--write]     writes docs/files.md, or prints it
"""

import argparse
import re
import subprocess
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "files.md"
ROOMS = ["base", "geometry", "lcmtypes", "calibration", "edge", "central", "command", "console"]
ROOMS += ["cue", "export", "bridge", "sim", "tools", "dev"]
SUFFIXES = {".h", ".cpp", ".lcm", ".py", ".ts", ".tsx", ""}
LONGEST = 200  # characters of a description

HEAD = """# Files

What every file is for: the first sentence of its own first comment. `name.*` is a header with its
source. Where a change begins: [architecture](architecture.md#where-new-parts-go). After a change:
`python3 dev/file_index.py --write`.
"""


def first_comment(text: str) -> str:
    """The comment, or docstring, at the top of a source, in one line; empty if there is none."""
    text = re.sub(r"\A#!.*\n|\Apackage \w+;\n+", "", text)
    docstring = re.match(r'"""(.*?)(?:\n\n|""")', text, re.S)
    if docstring:
        return " ".join(docstring.group(1).split())
    block = re.match(r"(?://(?: .*)?\n)+|(?:# \S.*\n)+", text)
    if not block:
        return ""
    return " ".join(re.sub(r"^(//|#)", "", block.group(), flags=re.M).split())


def sentence(comment: str) -> str:
    """The first sentence; of a very long one what stands before its first colon or semicolon."""
    first = re.split(r"(?<=[^A-Z][.])\s+(?=[A-Z0-9`])", comment, maxsplit=1)[0].rstrip(".")
    if len(first) > LONGEST:
        first = re.split(r"[;:]\s", first, maxsplit=1)[0]
    return first.replace("|", "\\|")


def described() -> dict[Path, dict[str, str]]:
    """Folder -> name of the file, or of the pair of header and source -> what it is for."""
    listed = subprocess.run(
        ["git", "ls-files", *ROOMS], cwd=ROOT, capture_output=True, text=True, check=True
    )
    paths = {Path(line) for line in listed.stdout.splitlines()}
    result: dict[Path, dict[str, str]] = defaultdict(dict)
    for path in sorted(paths):
        is_source_of_header = path.suffix == ".cpp" and path.with_suffix(".h") in paths
        if path.suffix not in SUFFIXES or path.name == "__init__.py" or is_source_of_header:
            continue
        name = path.name
        if path.suffix == ".h" and path.with_suffix(".cpp") in paths:
            name = f"{path.stem}.*"
        result[path.parent][name] = sentence(first_comment((ROOT / path).read_text()))
    return result


def page() -> str:
    parts = [HEAD]
    for folder, files in described().items():
        parts.append(f"\n## {folder}\n\n| file | |\n|---|---|\n")
        parts += [f"| `{name}` | {what} |\n" for name, what in files.items()]
    return "".join(parts)


def main() -> None:
    parser = argparse.ArgumentParser(description="What every file is for, from its first comment.")
    parser.add_argument("--write", action="store_true", help="into docs/files.md")
    if parser.parse_args().write:
        PAGE.write_text(page())
    else:
        print(page(), end="")


if __name__ == "__main__":
    main()
