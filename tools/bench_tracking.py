#!/usr/bin/env python3
"""Run ols-track on every clip of a folder and say how long a frame takes.

    bench_tracking.py CLIPS RESULTS [--program build/release/bin/ols-track] [--scorer SCORE.py]

CLIPS holds NAME.mp4 or NAME.avi beside NAME.csv (frame,x,y,w,h: the truth). Tracking starts from
the first row that has a box. RESULTS/NAME.csv are written, and judged by `SCORE.py CLIPS RESULTS`.
"""

import argparse
import csv
import subprocess
import sys
import time
from pathlib import Path


def first_box(truth):
    """(frame, [x, y, w, h]) of the first row that has a box, and how many rows there are."""
    with open(truth, newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        box = [row[key] for key in "xywh"]
        if all(value and value.strip() for value in box):
            return int(row["frame"]), box, len(rows)
    raise SystemExit(f"{truth}: no row has a box")


def track(program, clip, truth, output, options):
    """Seconds a frame, decoding included."""
    frame, box, rows = first_box(truth)
    command = [program, "--input", clip, "--init", ",".join(box), "--start-frame", str(frame)]
    began = time.perf_counter()
    subprocess.run([*command, "--output", output, *options], check=True)
    return (time.perf_counter() - began) / rows


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("clips", type=Path)
    parser.add_argument("results", type=Path)
    parser.add_argument("--program", default="build/release/bin/ols-track")
    parser.add_argument("--scorer", type=Path)
    parser.add_argument("--config")
    parser.add_argument("--seed", default="1")
    arguments = parser.parse_args()
    arguments.results.mkdir(parents=True, exist_ok=True)
    options = ["--seed", arguments.seed]
    if arguments.config:
        options += ["--config", arguments.config]
    clips = sorted([*arguments.clips.glob("*.mp4"), *arguments.clips.glob("*.avi")])
    if not clips:
        raise SystemExit(f"{arguments.clips}: no clips")
    for clip in clips:
        output = arguments.results / f"{clip.stem}.csv"
        taken = track(arguments.program, clip, clip.with_suffix(".csv"), output, options)
        print(f"{clip.stem:20s} {1e3 * taken:6.2f} ms per frame", flush=True)
    if arguments.scorer:
        command = [sys.executable, arguments.scorer, arguments.clips, arguments.results]
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
