"""The console's page in the eyes of the TypeScript compiler; the bundler only strips the types."""

import json
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
COMPILER = ROOT / "build/page-libraries/node_modules/typescript"
MOST_LINES = 60  # a screen

pytestmark = pytest.mark.skipif(
    not COMPILER.exists(), reason="build/page-libraries is missing: tools/fetch-page-libraries"
)


def node(*arguments: str | Path) -> str:
    done = subprocess.run(["node", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def longer_than_a_screen(sources: list[Path]) -> list[str]:
    """The page's outermost functions, each with what stands within it."""
    read = node(Path(__file__).with_name("page_functions.mjs"), COMPILER, *sources)
    functions = [json.loads(line) for line in read.splitlines()]
    return [
        f"{one['path']}:{one['line']} {one['name']}"
        for one in functions
        if one["end"] - one["line"] >= MOST_LINES
    ]


def test_the_types_of_the_page_fit():
    node(COMPILER / "bin/tsc", "-p", ROOT / "console/page")


def test_functions_of_the_page_fit_on_a_screen():
    assert longer_than_a_screen(sorted((ROOT / "console/page/src").glob("*.ts*"))) == []


def test_a_function_that_is_longer_is_found(tmp_path):
    source = tmp_path / "long.ts"
    source.write_text("const f = () => {\n" + "  g();\n" * MOST_LINES + "};\n")
    assert longer_than_a_screen([source]) == [f"{source}:1 f"]
