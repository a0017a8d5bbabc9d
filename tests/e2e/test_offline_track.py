"""ols-track as its users meet it: pictures of a target that moves, and files that are no good."""

import csv
import subprocess

import numpy as np
import pytest
from conftest import BIN, lines_said

FRAMES = 24
SIDE = 12  # [px]


def corner(frame: int) -> tuple[int, int]:
    return 60 + 3 * frame, 50 + 2 * frame


def write_pgm(path, picture: np.ndarray) -> None:
    height, width = picture.shape
    path.write_bytes(b"P5\n%d %d\n255\n" % (width, height) + picture.tobytes())


def smooth(picture: np.ndarray) -> np.ndarray:
    for axis in (0, 1):
        picture = sum(np.roll(picture, shift, axis) for shift in range(-3, 4)) / 7
    return picture


@pytest.fixture(scope="module")
def pictures() -> list[np.ndarray]:
    """A bright square that moves over a still, textured background."""
    random = np.random.default_rng(1)
    background = 90 + smooth(random.normal(0.0, 60.0, (240, 320)))
    result = []
    for frame in range(FRAMES):
        picture = background + random.normal(0.0, 2.0, background.shape)
        x, y = corner(frame)
        picture[y : y + SIDE, x : x + SIDE] = 230
        result.append(np.clip(picture, 0, 255).astype(np.uint8))
    return result


@pytest.fixture
def folder(tmp_path, pictures):
    """Names without leading zeros: as text, 10.pgm would come before 2.pgm."""
    result = tmp_path / "frames"
    result.mkdir()
    for frame, picture in enumerate(pictures):
        write_pgm(result / f"{frame}.pgm", picture)
    return result


def init(frame: int) -> str:
    x, y = corner(frame)
    return f"{x},{y},{SIDE},{SIDE}"


def track(source, output, *options, box: str = init(0)) -> subprocess.CompletedProcess:
    command = [BIN / "ols-track", "--input", source, "--output", output, "--init", box]
    return subprocess.run(
        [*map(str, command), *options], capture_output=True, text=True, timeout=120, check=False
    )


def refused(result: subprocess.CompletedProcess, output, *parts: str) -> None:
    assert result.returncode == 2, result.stderr
    assert len(lines_said(result.stderr)) == 1, result.stderr
    for part in parts:
        assert part in result.stderr
    assert not list(output.parent.glob(output.name + "*"))


def assert_follows(output, start: int = 0) -> None:
    lines = output.read_text().splitlines()
    assert lines[0] == "frame,x,y,w,h,belief,state"
    rows = list(csv.DictReader(lines))
    assert [int(row["frame"]) for row in rows] == list(range(start, FRAMES))
    assert all(0.0 <= float(row["belief"]) <= 1.0 for row in rows)
    assert {row["state"] for row in rows} <= {"tracking", "coasting", "lost"}
    last = rows[-1]
    assert last["state"] == "tracking"
    centre = [float(last[a]) + float(last[size]) / 2 for a, size in (("x", "w"), ("y", "h"))]
    assert np.hypot(*(np.array(centre) - corner(FRAMES - 1) - SIDE / 2)) < 3.0


@pytest.mark.parametrize("name", ["", "%d.pgm"])
def test_follows_the_target(folder, tmp_path, name):
    output = tmp_path / "boxes.csv"
    result = track(folder / name, output)
    assert result.returncode == 0, result.stderr
    assert_follows(output)


def test_folder_and_pattern_are_the_same_frames(folder, tmp_path):
    by_folder, by_pattern = tmp_path / "folder.csv", tmp_path / "pattern.csv"
    track(folder, by_folder)
    track(folder / "%d.pgm", by_pattern)
    assert by_folder.read_text() == by_pattern.read_text()


def test_later_start(folder, tmp_path):
    output = tmp_path / "boxes.csv"
    result = track(folder, output, "--start-frame", "5", box=init(5))
    assert result.returncode == 0, result.stderr
    assert_follows(output, start=5)


def test_padded_pattern_may_start_at_any_number(tmp_path, pictures):
    for frame, picture in enumerate(pictures):
        write_pgm(tmp_path / f"f{frame + 95:04d}_left.pgm", picture)
    write_pgm(tmp_path / "f0200_right.pgm", pictures[0])  # of another pattern
    output = tmp_path / "boxes.csv"
    result = track(tmp_path / "f%04d_left.pgm", output)
    assert result.returncode == 0, result.stderr
    assert_follows(output)


def test_gap_in_a_pattern_is_refused(folder, tmp_path):
    (folder / "6.pgm").unlink()
    output = tmp_path / "boxes.csv"
    refused(track(folder / "%d.pgm", output), output, "number 6 is missing")


def test_unreadable_inputs(folder, tmp_path):
    output = tmp_path / "boxes.csv"
    clip = tmp_path / "clip.mp4"
    clip.write_bytes(b"not a clip" * 100)
    refused(track(clip, output), output, str(clip))
    refused(track(tmp_path / "none.mp4", output), output, "none.mp4")
    refused(track(tmp_path / "%d.png", output), output, "%d.png")
    (folder / "3.pgm").write_bytes(b"P5\n")
    refused(track(folder, output), output, "3.pgm")


@pytest.mark.parametrize(
    "box", ["400,50,12,12", "60,50,0,12", "nan,50,12,12", "60,50,12", "a,b,c,d"]
)
def test_bad_box(folder, tmp_path, box):
    output = tmp_path / "boxes.csv"
    refused(track(folder, output, box=box), output)


@pytest.mark.parametrize("option", [("--seed", "-1"), ("--seed", "x"), ("--start-frame", "-1")])
def test_bad_numbers(folder, tmp_path, option):
    output = tmp_path / "boxes.csv"
    refused(track(folder, output, *option), output, option[0])


def test_start_after_the_end(folder, tmp_path):
    output = tmp_path / "boxes.csv"
    refused(track(folder, output, "--start-frame", "99"), output, "99")
