"""Runs trackers over a clip, all on the core that this process is pinned to.

Each writes BOXES (frame,x,y,w,h and, if it has one, belief) and TIMES (frame,total_ms and further
columns for its stages): processor time of its own thread inside the tracker's update alone, so that
neither decoding nor other load on the machine counts.
"""

import csv
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np

from ols_bench.clips import BadInput, Clip
from ols_bench.pictures import pictures
from ols_bench.places import Places

OPENCV = {
    "MOSSE": lambda: cv2.legacy.TrackerMOSSE_create(),
    "KCF": lambda: cv2.TrackerKCF_create(),
    "CSRT": lambda: cv2.TrackerCSRT_create(),
    "MIL": lambda: cv2.TrackerMIL_create(),
}
LOST = 1  # ols-track ends so if the target is lost at the end
OURS = {"ours (paper)": "paper", "ours (full)": "full"}
NAMES = (*OURS, *OPENCV)
RANDOM = (*OURS, "MIL")


def start(create: Callable, picture: np.ndarray, box: list[float]):
    tracker = create()
    if isinstance(tracker, cv2.legacy.Tracker):
        tracker.init(picture, tuple(box))
    else:
        x, y, w, h = box
        tracker.init(picture, (round(x), round(y), max(1, round(w)), max(1, round(h))))
    return tracker


def run_opencv(name: str, clip: Clip, places: Places, seed: int) -> None:
    cv2.setNumThreads(1)
    cv2.setRNGSeed(seed)
    boxes, times = [], []
    tracker = None
    for frame, picture in enumerate(pictures(clip)):
        if frame < clip.first:
            continue
        if tracker is None:
            tracker = start(OPENCV[name], picture, clip.first_box)
            boxes.append((frame, *clip.first_box))
            continue
        began = time.thread_time()
        found, box = tracker.update(picture)
        times.append((frame, 1e3 * (time.thread_time() - began)))
        boxes.append((frame, *box) if found else (frame, "", "", "", ""))
    write(places.times, ("frame", "total_ms"), times)
    write(places.boxes, ("frame", "x", "y", "w", "h"), boxes)


def run_ours(
    name: str, clip: Clip, places: Places, seed: int, program: Path, config: Path | None
) -> None:
    command = [program, "--input", clip.path, "--mode", OURS[name], "--seed", seed]
    command += ["--init", ",".join(f"{value:.6g}" for value in clip.first_box)]
    command += ["--start-frame", clip.first, "--output", places.boxes, "--timing", places.times]
    if config:
        command += ["--config", config]
    result = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, check=False
    )
    if result.returncode not in (0, LOST):
        raise BadInput(f"{clip.path}: {result.stderr.strip()}")


def write(path: Path, header: tuple, rows: list) -> None:
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(rows)
