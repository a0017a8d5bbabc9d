"""ols-track as its users meet it: pictures of a target that moves, and files that are no good."""

import csv
import struct
import subprocess

import numpy as np
import pytest
from conftest import BIN, finished, lines_said

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
    return finished(
        BIN / "ols-track", "--input", source, "--output", output, "--init", box, *options
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
    for picture in (b"P5\n", b"P5\n70000 70000\n255\n"):
        (folder / "3.pgm").write_bytes(picture)
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


def write_clip(path, pictures) -> None:
    """Uncompressed AVI, readable without any codec: each picture stands by itself."""
    height, width = pictures[0].shape

    def chunk(name: bytes, content: bytes) -> bytes:
        return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)

    def listing(name: bytes, content: bytes) -> bytes:
        return chunk(b"LIST", name + content)

    size = width * height * 3
    main = struct.pack("<14I", 33333, size * 30, 0, 16, len(pictures), 0, 1, size, width, height,
                       0, 0, 0, 0)  # fmt: skip
    stream = struct.pack("<4s4sIHHIIIIIIII4H", b"vids", b"DIB ", 0, 0, 0, 0, 1, 30, 0,
                         len(pictures), size, 0, 0, 0, 0, width, height)  # fmt: skip
    form = struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, size, 0, 0, 0, 0)
    header = chunk(b"avih", main)
    header += listing(b"strl", chunk(b"strh", stream) + chunk(b"strf", form))
    body = b"".join(
        chunk(b"00db", np.repeat(picture[::-1, :, None], 3, axis=2).tobytes())
        for picture in pictures
    )
    content = b"AVI " + listing(b"hdrl", header) + listing(b"movi", body)
    path.write_bytes(b"RIFF" + struct.pack("<I", len(content)) + content)


@pytest.fixture
def clip(tmp_path, pictures):
    result = tmp_path / "clip.avi"
    write_clip(result, pictures)
    return result


def test_follows_through_a_clip_and_says_where_the_time_goes(clip, tmp_path):
    output, timing = tmp_path / "boxes.csv", tmp_path / "timing.csv"
    result = track(clip, output, "--timing", str(timing))
    assert result.returncode == 0, result.stderr
    assert_follows(output)
    rows = list(csv.DictReader(timing.read_text().splitlines()))
    assert [int(row["frame"]) for row in rows] == list(range(1, FRAMES))
    for row in rows:
        stages = [float(row[key]) for key in row if key not in ("frame", "total_ms")]
        assert len(stages) >= 5
        assert 0.0 < sum(stages) <= float(row["total_ms"]) + 1e-3


@pytest.mark.parametrize("mode", ["paper", "full"])
def test_both_modes(clip, tmp_path, mode):
    output = tmp_path / "boxes.csv"
    result = track(clip, output, "--mode", mode)
    assert result.returncode == 0, result.stderr
    assert len(output.read_text().splitlines()) == FRAMES + 1
    refused(track(clip, tmp_path / "other.csv", "--mode", "best"), tmp_path / "other.csv", "--mode")


def test_truncated_clip_is_refused_and_says_after_how_many_frames(clip, tmp_path):
    whole = clip.read_bytes()
    clip.write_bytes(whole[: len(whole) // 2])
    output = tmp_path / "boxes.csv"
    refused(track(clip, output), output, str(clip), f"of {FRAMES} frames")


def test_empty_folder_and_folder_without_pictures(tmp_path):
    empty = tmp_path / "empty"
    empty.mkdir()
    output = tmp_path / "boxes.csv"
    refused(track(empty, output), output, "no pictures")
    (empty / "notes.txt").write_text("none")
    refused(track(empty, output), output, "no pictures")


def test_pictures_of_another_size_are_skipped_counted_and_told(folder, tmp_path, pictures):
    odd = (5, 6, 11)
    for frame in odd:
        write_pgm(folder / f"{frame}.pgm", pictures[frame][:200])
    output = tmp_path / "boxes.csv"
    result = track(folder, output)
    assert result.returncode == 0, result.stderr
    (line,) = lines_said(result.stderr)
    assert "skipped 3 frames, the first is 5: frame has another size" in line
    assert_follows(output)
    rows = list(csv.DictReader(output.read_text().splitlines()))
    for row in rows:
        if int(row["frame"]) in odd:
            assert row["x"] == "" and float(row["belief"]) == 0.0 and row["state"] == "coasting"
        else:
            assert row["x"] != ""


def test_every_later_picture_of_another_size(folder, tmp_path, pictures):
    for frame in range(1, FRAMES):
        write_pgm(folder / f"{frame}.pgm", pictures[frame][:, :300])
    output = tmp_path / "boxes.csv"
    refused(track(folder, output), output, str(folder), "another size")


def test_a_target_that_is_lost_is_said(tmp_path, pictures):
    """Nothing is seen any more, for longer than it coasts: 30 frames a second."""
    emptied = tmp_path / "emptied"
    emptied.mkdir()
    for frame in range(FRAMES + 60):
        picture = pictures[min(frame, FRAMES - 1)]
        seen = picture if frame < 5 else np.full_like(picture, 128)
        write_pgm(emptied / f"{frame}.pgm", seen)
    output = tmp_path / "boxes.csv"
    result = track(emptied, output)
    assert result.returncode == 1, result.stderr
    lost = sum(row["state"] == "lost" for row in csv.DictReader(output.open()))
    assert lost > 10
    assert f"the target was lost in {lost} frames; it was last seen in frame " in result.stderr


def test_colour_deep_and_black_pictures(tmp_path, pictures):
    """Colour and 16 bits are read as grey; a black or a saturated picture is no target."""
    kinds = tmp_path / "kinds"
    kinds.mkdir()
    for frame, picture in enumerate(pictures):
        height, width = picture.shape
        if frame % 3 == 0:
            colour = np.repeat(picture[:, :, None], 3, axis=2).tobytes()
            (kinds / f"{frame}.ppm").write_bytes(b"P6\n%d %d\n255\n" % (width, height) + colour)
        elif frame in (7, 8):
            write_pgm(kinds / f"{frame}.pgm", np.full_like(picture, 255 * (frame == 8)))
        else:
            write_pgm(kinds / f"{frame}.pgm", picture)
    output = tmp_path / "boxes.csv"
    result = track(kinds, output)
    assert result.returncode == 0, result.stderr
    rows = list(csv.DictReader(output.read_text().splitlines()))
    numbers = [float(row[key]) for row in rows for key in ("x", "y", "w", "h") if row[key]]
    assert np.isfinite(numbers).all()
    assert len(rows) == FRAMES


@pytest.mark.parametrize("size", [(1, 1), (2, 3), (8, 8)])
def test_tiny_pictures(tmp_path, size):
    tiny = tmp_path / "tiny"
    tiny.mkdir()
    for frame in range(4):
        write_pgm(tiny / f"{frame}.pgm", np.full(size, 40 * frame, dtype=np.uint8))
    output = tmp_path / "boxes.csv"
    result = track(tiny, output, box="0,0,3,3")
    if result.returncode == 0:
        assert len(output.read_text().splitlines()) == 5
    else:
        refused(result, output, "box", f"{size[1]} by {size[0]} pixels")


def test_refused_box_names_frame_and_size_of_the_picture(folder, tmp_path):
    output = tmp_path / "boxes.csv"
    refused(track(folder, output, box="400,50,12,12"), output, "frame 0", "320 by 240", "box")


def test_output_that_cannot_be_written(folder, tmp_path):
    output = tmp_path / "none" / "boxes.csv"
    result = track(folder, output)
    assert result.returncode == 2 and "none" in result.stderr


def test_clip_is_not_overwritten_by_its_own_boxes(clip):
    before = clip.read_bytes()
    result = track(clip, clip)
    assert result.returncode == 2 and "--output" in result.stderr
    assert clip.read_bytes() == before


def detect(source, output, *options) -> subprocess.CompletedProcess:
    return finished(BIN / "ols-track", "--detect", "--input", source, "--output", output, *options)


def test_detects_without_a_box(clip, tmp_path):
    output, mount = tmp_path / "detections.csv", tmp_path / "mount.csv"
    mount.write_text(
        "frame,azimuth_deg,elevation_deg,hfov_deg\n"
        + "".join(f"{frame},10,2,30\n" for frame in range(FRAMES))
    )
    result = detect(clip, output, "--mount", mount)
    assert result.returncode == 0, result.stderr
    lines = output.read_text().splitlines()
    assert lines[0] == "frame,id,x,y,w,h,confidence,class"
    last = [row for row in csv.DictReader(lines) if int(row["frame"]) == FRAMES - 1]
    assert [row["class"] for row in last] == ["other"]
    assert 0.5 < float(last[0]["confidence"]) <= 1.0
    centre = [float(last[0][a]) + float(last[0][size]) / 2 for a, size in (("x", "w"), ("y", "h"))]
    assert np.hypot(*(np.array(centre) - corner(FRAMES - 1) - SIDE / 2)) < 6.0


def test_detection_refuses_what_it_cannot_use(clip, tmp_path):
    output, mount = tmp_path / "detections.csv", tmp_path / "mount.csv"
    refused(detect(tmp_path / "none.mp4", output), output, "none.mp4")
    refused(detect(clip, output, "--mount", mount), output, "mount.csv: cannot be read")
    mount.write_text("frame,azimuth_deg,elevation_deg,hfov_deg\n0,10,95,30\n")
    refused(detect(clip, output, "--mount", mount), output, "mount.csv:2: elevation_deg", "95")
    refused(detect(clip, output, "--init", init(0)), output, "--detect")
    refused(track(clip, output, "--mount", mount), output, "--mount", "--detect")
    refused(detect(clip, output, "--false-alarms", "0"), output, "--false-alarms")
    before = clip.read_bytes()
    assert detect(clip, clip).returncode == 2
    assert clip.read_bytes() == before
