"""Functions of the console's page by themselves: each *.test.ts beside this file, run by Node."""

import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
LIBRARIES = HERE.parents[1] / "build/page-libraries/node_modules"

pytestmark = pytest.mark.skipif(
    not LIBRARIES.exists(), reason="build/page-libraries is missing: tools/fetch-page-libraries"
)


@pytest.mark.parametrize("source", sorted(HERE.glob("*.test.ts")), ids=lambda path: path.name)
def test_functions_of_the_page(source, tmp_path):
    bundled = tmp_path / "test.mjs"
    bundle = ["esbuild", source, "--bundle", "--format=esm", "--platform=node"]
    done = subprocess.run(
        [*bundle, "--log-level=warning", f"--outfile={bundled}"],
        env={"PATH": "/usr/bin:/bin", "NODE_PATH": str(LIBRARIES)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    run = subprocess.run(["node", "--test", bundled], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
