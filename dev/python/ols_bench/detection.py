"""tools/bench detection: everything that ols-track --detect finds in clips with ground truth.

The clips and their scorer are those of the evaluation data in OLS_SHARED.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

from ols_bench.clips import BadInput, Clip, read_folder

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/bin/ols-track"


def detect(clip: Clip, output: Path) -> None:
    command = [PROGRAM, "--detect", "--input", clip.path, "--output", output / f"{clip.name}.csv"]
    mount = clip.path.with_name(f"{clip.name}.mount.csv")
    if mount.exists():
        command += ["--mount", mount]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode:
        raise BadInput(f"{clip.path}: {result.stderr.strip()}")


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/bench detection", description=__doc__)
    folders = "folders of OLS_SHARED/data (default: %(default)s)"
    parser.add_argument(
        "folders",
        nargs="*",
        default=["tracking", "tracking_ground", "tracking_ground2"],
        help=folders,
    )
    parser.add_argument("--output", type=Path, default=ROOT / "out/detection")
    given = parser.parse_args()
    if not os.environ.get("OLS_SHARED"):
        raise BadInput("OLS_SHARED names no folder with evaluation data")
    shared = Path(os.environ["OLS_SHARED"])
    for name in given.folders:
        output = given.output / name
        output.mkdir(parents=True, exist_ok=True)
        for clip in read_folder(shared / "data" / name):
            detect(clip, output)
        print(name, flush=True)
        scorer = shared / "tools/score_detections.py"
        subprocess.run([sys.executable, scorer, shared / "data" / name, output], check=True)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as error:
        sys.exit(f"tools/bench detection: {error}")
