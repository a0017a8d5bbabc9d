"""tools/bench tracker-synthetic: the tracker on the simulator's images, with exact truth."""

import argparse
import subprocess
import sys
from pathlib import Path

from ols_bench import synthetic_report
from ols_bench.synthetic import point_measures, read_points

ROOT = Path(__file__).resolve().parents[3]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/bench tracker-synthetic", description=__doc__)
    parser.add_argument("--runs", type=int, default=20, help="of each point (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the first run")
    parser.add_argument("--mode", choices=("paper", "full"), default="full")
    parser.add_argument("--sweeps", help="only these, for example size,contrast")
    parser.add_argument("--config", type=Path, help="TOML file with a table [tracker]")
    parser.add_argument("--output", type=Path, default=ROOT / "out/tracker-synthetic")
    parser.add_argument(
        "--program", type=Path, default=ROOT / "build/release/bin/ols-bench-tracker"
    )
    return parser.parse_args()


def run(given: argparse.Namespace, rows: Path) -> None:
    command = [given.program, "--runs", given.runs, "--seed", given.seed, "--mode", given.mode]
    command += ["--sweeps", given.sweeps] if given.sweeps else []
    command += ["--config", given.config] if given.config else []
    command += ["--pictures", given.output / "pictures", "--output", rows]
    if subprocess.run([str(part) for part in command], check=False).returncode:
        sys.exit(1)


def main() -> None:
    given = arguments()
    given.output.mkdir(parents=True, exist_ok=True)
    rows = given.output / "frames.csv"
    run(given, rows)
    points = [point_measures(point) for point in read_points(rows)]
    about = f"Mode {given.mode}, seeds {given.seed} to {given.seed + given.runs - 1} at each point."
    synthetic_report.write(given.output, points, about)
    print((given.output / "synthetic.md").read_text())
    print(f"Written to {given.output}")


if __name__ == "__main__":
    main()
