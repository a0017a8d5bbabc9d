"""tools/bench dim: the share of dim moving points that ols-track --detect finds, by their signal.

Points are put into real pictures: the first frames of clips from OLS_SHARED, in which the camera
stands still and parts show even sky, with white noise of two grey levels, because their encoder
has taken the camera's noise away. Each point moves evenly, at 0.8 to 3 pixels per frame, where the
sky is even. It is found if a confirmed object is within 10 pixels of it for half a second. Two
kinds of points, with two measures of the signal, both in standard deviations of a pixel:
- square: of 3 by 3 pixels; its signal is the mean contrast of these pixels;
- point: as a lens shows it (a bell of 0.9 pixels); its signal is that after a matched filter, in
  one image. A square of the same light has about a third of this number.
"""

import argparse
import csv
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from ols_bench.clips import BadInput
from ols_bench.markdown import table

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/bin/ols-track"
CLIPS = ("V_AIRPLANE_016", "V_AIRPLANE_031", "V_AIRPLANE_057", "V_BIRD_030", "V_DRONE_065")
CLIPS += ("V_DRONE_089",)
FRAMES, RATE = 120, 30.0
NOISE = 2.0  # [grey levels]
BELL_PX = 0.9
NEAR_PX = 10.0
EVEN = 2.0  # [grey levels] the most that 15 x 15 pixels of sky vary (standard deviation)
POINTS = 8  # in a clip
APART_PX = 60.0


@dataclass
class Point:
    start: np.ndarray  # x, y in frame 0 [px]
    velocity: np.ndarray  # [px per frame]
    sign: int

    def at(self, frame: int) -> np.ndarray:
        return self.start + frame * self.velocity

    @property
    def path(self) -> np.ndarray:
        return self.start + np.arange(FRAMES)[:, None] * self.velocity


def read_frames(path: Path) -> list[np.ndarray]:
    video = cv2.VideoCapture(str(path))
    frames = []
    while len(frames) < FRAMES:
        there, frame = video.read()
        if not there:
            raise BadInput(f"{path}: fewer than {FRAMES} frames")
        frames.append(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY).astype(np.float32))
    return frames


def places(frames: list[np.ndarray], random: np.random.Generator) -> list[Point]:
    """Paths before even sky, apart from each other."""
    mean = cv2.blur(frames[0], (15, 15))
    spread = np.sqrt(np.maximum(0, cv2.blur(frames[0] ** 2, (15, 15)) - mean**2))
    height, width = spread.shape
    points: list[Point] = []
    for _ in range(4000):
        if len(points) == POINTS:
            break
        speed, direction = random.uniform(0.8, 3.0), random.uniform(0, 2 * np.pi)
        velocity = speed * np.array([np.cos(direction), np.sin(direction)])
        start = random.uniform((20, 20), (width - 20, height - 20))
        point = Point(start, velocity, random.choice((-1, 1)))
        path = point.path
        if (path < 20).any() or (path > (width - 20, height - 20)).any():
            continue
        x, y = path.round().astype(int).T
        if spread[y, x].max() > EVEN:
            continue
        apart = [np.linalg.norm(path - other.path, axis=1).min() for other in points]
        if min(apart, default=np.inf) > APART_PX:
            points.append(point)
    return points


def draw(image: np.ndarray, at: np.ndarray, light: float, kind: str) -> None:
    """`light`: grey levels of the square; sum of grey levels of the bell."""
    if kind == "square":
        x, y = at.round().astype(int)
        image[y - 1 : y + 2, x - 1 : x + 2] += light
        return
    x, y = at.astype(int)
    rows, columns = np.mgrid[y - 5 : y + 7, x - 5 : x + 7]
    bell = np.exp(-0.5 * ((rows - at[1]) ** 2 + (columns - at[0]) ** 2) / BELL_PX**2)
    image[y - 5 : y + 7, x - 5 : x + 7] += light * bell / bell.sum()


def light_of(signal: float, kind: str) -> float:
    # The matched filter of a bell of unit light has the signal 1 / (2 sqrt(pi) BELL_PX).
    return signal * NOISE * (1.0 if kind == "square" else 2 * np.sqrt(np.pi) * BELL_PX)


def write_clip(
    path: Path,
    frames: list[np.ndarray],
    points: list[Point],
    signal: float,
    kind: str,
    random: np.random.Generator,
) -> None:
    height, width = frames[0].shape
    video = cv2.VideoWriter(
        str(path), cv2.VideoWriter_fourcc(*"FFV1"), RATE, (width, height), isColor=False
    )
    for number, frame in enumerate(frames):
        image = frame.copy()
        for point in points:
            draw(image, point.at(number), point.sign * light_of(signal, kind), kind)
        image += random.normal(0, NOISE, image.shape)
        video.write(image.round().clip(0, 255).astype(np.uint8))
    video.release()


def detections(path: Path, program: Path) -> list[list[np.ndarray]]:
    """Of each frame, the centres of the confirmed objects."""
    output = path.with_suffix(".csv")
    command = [program, "--detect", "--input", path, "--output", output]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode:
        raise BadInput(f"{path}: {result.stderr.strip()}")
    found: list[list[np.ndarray]] = [[] for _ in range(FRAMES)]
    with open(output, newline="") as file:
        for row in csv.DictReader(file):
            corner = np.array([float(row["x"]), float(row["y"])])
            size = np.array([float(row["w"]), float(row["h"])])
            found[int(row["frame"])].append(corner + 0.5 * size - 0.5)
    return found


def first_found(point: Point, found: list[list[np.ndarray]]) -> int | None:
    """The first of half a second's frames with an object on the point."""
    wanted, run = int(RATE / 2), 0
    for frame, centres in enumerate(found):
        on = any(np.linalg.norm(centre - point.at(frame)) < NEAR_PX for centre in centres)
        run = run + 1 if on else 0
        if run == wanted:
            return frame - wanted + 1
    return None


def measure(
    signal: float, kind: str, shared: Path, output: Path, program: Path
) -> tuple[int, list[int]]:
    """The number of points, and of each found one the frame."""
    count, first = 0, []
    for number, name in enumerate(CLIPS):
        random = np.random.default_rng(number)
        frames = read_frames(shared / "data/tracking" / f"{name}.mp4")
        points = places(frames, random)
        path = output / f"{name}.avi"
        write_clip(path, frames, points, signal, kind, random)
        found = detections(path, program)
        count += len(points)
        first += [at for point in points if (at := first_found(point, found)) is not None]
        path.unlink()
    return count, first


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="tools/bench dim",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("signals", nargs="*", type=float, default=[2.5, 3.0, 4.0, 5.0, 8.0])
    parser.add_argument("--program", type=Path, default=PROGRAM, help="another ols-track")
    parser.add_argument("--output", type=Path, default=ROOT / "out/dim")
    given = parser.parse_args()
    if not os.environ.get("OLS_SHARED"):
        raise BadInput("OLS_SHARED names no folder with evaluation data")
    given.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for kind in ("square", "point"):
        for signal in given.signals:
            count, first = measure(
                signal, kind, Path(os.environ["OLS_SHARED"]), given.output, given.program
            )
            print(kind, signal, count, len(first), file=sys.stderr)
            after = f"{np.median(first) / RATE:.1f} s" if first else "-"
            rows.append([kind, f"{signal:g}", str(count), f"{len(first) / count:.2f}", after])
    print(table(("", "signal", "points", "found", "after, median"), rows))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as error:
        sys.exit(f"tools/bench dim: {error}")
