"""Functions of the console's page by themselves: each *.test.ts beside this file, run by Node."""

from pathlib import Path

import pytest
from conftest import finished

HERE = Path(__file__).resolve().parent
LIBRARIES = HERE.parents[1] / "build/page-libraries/node_modules"

pytestmark = pytest.mark.skipif(
    not LIBRARIES.exists(), reason="build/page-libraries is missing: tools/fetch-page-libraries"
)


@pytest.mark.parametrize("source", sorted(HERE.glob("*.test.ts")), ids=lambda path: path.name)
def test_functions_of_the_page(source, tmp_path):
    bundled = tmp_path / "test.mjs"
    done = finished(
        *("esbuild", source, "--bundle", "--format=esm", "--platform=node"),
        *("--log-level=warning", f"--outfile={bundled}"),
        env={"PATH": "/usr/bin:/bin", "NODE_PATH": str(LIBRARIES)},
    )
    assert done.returncode == 0, done.stderr
    run = finished("node", "--test", bundled)
    assert run.returncode == 0, run.stdout + run.stderr
