"""See tools/goldens."""

import argparse
import sys
import tempfile
from pathlib import Path

import goldens


def compare(golden: goldens.Golden, accepting: bool, exact: bool) -> int:
    """How many rows differ."""
    with tempfile.TemporaryDirectory() as folder:
        golden.run(Path(folder))
        found = ["no golden yet"]
        if golden.folder().is_dir():
            found = goldens.differences(golden, Path(folder), exact)
        if found and accepting:
            goldens.accept(golden, Path(folder))
    for line in found:
        print(f"{golden.name}: {line}")
    return len(found)


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/goldens", description=__doc__)
    parser.add_argument("names", nargs="*", help="of the goldens; none: all")
    parser.add_argument("--accept", action="store_true", help="what comes out is the new golden")
    parser.add_argument("--exact", action="store_true", help="to the last character")
    arguments = parser.parse_args()
    different = 0
    for golden in goldens.GOLDENS:
        if arguments.names and golden.name not in arguments.names:
            continue
        different += compare(golden, arguments.accept, arguments.exact)
    print(f"{different} rows differ" + (", accepted" if different and arguments.accept else ""))
    if different and arguments.accept:
        print("Say in the commit's message what changed, and why it is right.")
    return 0 if arguments.accept or not different else 1


if __name__ == "__main__":
    sys.exit(main())
