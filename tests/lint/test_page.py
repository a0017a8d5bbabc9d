"""The console's page in the eyes of the TypeScript compiler; the bundler only strips the types."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
COMPILER = ROOT / "build/page-libraries/node_modules/typescript/bin/tsc"


@pytest.mark.skipif(
    not COMPILER.exists(), reason="build/page-libraries is missing: tools/fetch-page-libraries"
)
def test_the_types_of_the_page_fit():
    done = subprocess.run(
        ["node", COMPILER, "-p", ROOT / "console/page"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
