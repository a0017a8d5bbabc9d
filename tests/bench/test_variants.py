"""Clips made of clips: the target is where the new truth has it, and gone where it has none."""

import os
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

pytest.importorskip("cv2", reason="tools/install-benchmarks")

import cv2
from ols_bench.clips import BadInput, Clip, read_boxes, read_folder, write_boxes
from ols_bench.egomotion import chained, to_reference
from ols_bench.hiding import covered, erased
from ols_bench.pictures import frames_per_second, pictures, write_clip
from ols_bench.variants import KINDS, variant

pytestmark = pytest.mark.night  # of what the trackers are compared on, no part of the product
FRAMES, SIDE, RATE = 150, 16, 25.0
BRIGHT = 200  # gray levels; the background stays below 160


@cache
def background() -> np.ndarray:
    noise = np.random.default_rng(1).normal(size=(240, 960))
    smooth = cv2.GaussianBlur(noise, (0, 0), 2.0)
    return np.clip(110 + 15 * smooth / smooth.std(), 60, 159)


def scene(frame: int, corner: np.ndarray, pan: int) -> np.ndarray:
    picture = background()[:, pan * frame : pan * frame + 320].copy()
    x, y = corner.astype(int)
    picture[y : y + SIDE, x : x + SIDE] = 240
    return cv2.merge([picture.astype(np.uint8)] * 3)


def a_clip(folder, name: str = "V_SQUARE", speed: int = 1, pan: int = 0) -> Clip:
    folder.mkdir(exist_ok=True)
    frame = np.arange(FRAMES)
    corners = np.stack([80 + speed * frame, 100 + 0 * frame], axis=1)
    path = folder / f"{name}.avi"
    write_clip(path, (scene(k, corners[k], pan) for k in frame), RATE)
    write_boxes(folder / f"{name}.csv", np.hstack([corners, np.full((FRAMES, 2), float(SIDE))]))
    return Clip(path, read_boxes(folder / f"{name}.csv"))


def brightness(picture: np.ndarray, box: np.ndarray) -> float:
    x, y, w, h = np.round(box).astype(int)
    return float(picture[y : y + h, x : x + w].mean())


def brightnesses(clip: Clip, boxes: np.ndarray) -> np.ndarray:
    return np.array([brightness(p, b) for p, b in zip(pictures(clip), boxes, strict=True)])


def test_clips_are_written_without_loss(tmp_path):
    clip = a_clip(tmp_path)
    corners = clip.truth.xywh[:, :2]
    for frame, picture in enumerate(pictures(clip)):
        assert np.array_equal(picture, scene(frame, corners[frame], 0))
    assert frame == FRAMES - 1
    assert frames_per_second(clip) == RATE


def test_folders_of_pictures_are_read_in_order(tmp_path):
    folder = tmp_path / "clips" / "A.1"
    folder.mkdir(parents=True)
    for level in (9, 10, 2):
        cv2.imwrite(str(folder / f"{level}.png"), np.full((40, 60), level, np.uint8))
    (folder / "notes.txt").touch()
    with pytest.raises(BadInput, match="A.1.csv"):
        read_folder(tmp_path / "clips")
    write_boxes(tmp_path / "clips" / "A.1.csv", np.full((3, 4), 5.0))
    [clip] = read_folder(tmp_path / "clips")
    assert clip.name == "A.1" and frames_per_second(clip) == 30.0
    assert [picture[0, 0, 0] for picture in pictures(clip)] == [2, 9, 10]


def test_an_erased_target_is_gone_and_comes_back(tmp_path):
    clip = a_clip(tmp_path)
    [made] = variant("erased", [clip], tmp_path / "made")
    gone = ~made.truth.there
    assert list(np.flatnonzero(gone)) == list(range(75, 75 + 38))
    light = brightnesses(made, clip.truth.xywh)
    assert (light[gone] < BRIGHT).all() and (light[~gone] == 240).all()
    assert np.array_equal(made.truth.xywh[~gone], clip.truth.xywh[~gone])


def test_erased_as_the_other_tool_erases(shared, tmp_path):
    clip = a_clip(tmp_path / "clips")
    tool = [sys.executable, shared / "tools/erase_target.py", tmp_path / "clips", tmp_path / "tool"]
    subprocess.run([str(part) for part in tool], check=True)
    [made] = variant("erased", [clip], tmp_path / "ours")
    [theirs] = read_folder(tmp_path / "tool")
    assert np.array_equal(made.truth.there, theirs.truth.there)
    for ours, other in zip(pictures(made), pictures(theirs), strict=True):
        assert np.array_equal(ours, other)


@pytest.mark.parametrize(("speed", "pan"), [(1, 0), (0, 0), (0, 2)])
def test_a_covered_target_is_out_of_sight_where_its_label_is_empty(tmp_path, speed, pan):
    """It crosses, hovers, or is followed by the camera."""
    clip = a_clip(tmp_path, speed=speed, pan=pan)
    [made] = variant("covered", [clip], tmp_path / "made")
    gone = ~made.truth.there
    assert 5 <= gone.sum() <= 100
    light = brightnesses(made, clip.truth.xywh)
    assert (light[gone] < 0.5 * 240 + 0.5 * BRIGHT).all() and light[gone].min() < 110
    assert (light[~gone] > 120).all() and (light[:30] == 240).all()


def test_a_clip_with_gaps_or_too_short_hides_nothing(tmp_path):
    clip = a_clip(tmp_path)
    short = Clip(clip.path, clip.truth)
    short.truth = read_boxes(clip.path.with_suffix(".csv"), 119)
    assert erased(short) is None and covered(short) is None
    clip.truth.xywh[3] = np.nan
    assert erased(clip) is None and covered(clip) is None
    assert variant("erased", [clip], tmp_path / "made") == []


def test_the_motion_of_the_scene_is_followed(tmp_path):
    clip = a_clip(tmp_path, speed=0, pan=2)
    motion = to_reference(clip, 75)
    assert motion.shape == (FRAMES, 3, 3)
    centre = motion @ [160.0, 120.0, 1.0]
    assert centre[:, 0] - 160 == pytest.approx(2.0 * (np.arange(FRAMES) - 75), abs=1.0)
    assert centre[:, 1] - 120 == pytest.approx(np.zeros(FRAMES), abs=1.0)


def test_motion_is_chained_towards_the_reference():
    step = np.eye(3)
    step[0, 2] = -2.0
    assert chained([step] * 4, 1)[:, 0, 2] == pytest.approx([-2.0, 0.0, 2.0, 4.0, 6.0])


@pytest.mark.parametrize(
    ("kind", "frames", "least"),
    [("mirrored", 150, 240), ("half", 150, 225), ("alternate", 75, 240)],
)
def test_the_target_is_where_the_new_truth_has_it(tmp_path, kind, frames, least):
    """Halved, its edge may share a pixel with the background."""
    clip = a_clip(tmp_path)
    [made] = variant(kind, [clip], tmp_path / "made")
    assert made.frames == frames and made.truth.there.all()
    assert (brightnesses(made, made.truth.xywh) >= least).all()
    assert not np.array_equal(made.truth.xywh[1], clip.truth.xywh[1])


def test_every_second_frame_has_half_the_rate(tmp_path):
    [made] = variant("alternate", [a_clip(tmp_path)], tmp_path / "made")
    assert frames_per_second(made) == RATE / 2


def test_backward_the_last_frame_is_the_first(tmp_path):
    clip = a_clip(tmp_path)
    clip.truth.xywh[3] = np.nan
    [made] = variant("backward", [clip], tmp_path / "made")
    assert np.array_equal(made.truth.xywh, clip.truth.xywh[::-1], equal_nan=True)
    shown = zip(pictures(made), made.truth.xywh, made.truth.there, strict=True)
    light = [brightness(picture, box) for picture, box, there in shown if there]
    assert light == [240.0] * (FRAMES - 1)


def test_grey_pictures_have_no_colours(tmp_path):
    clip = a_clip(tmp_path)
    red = (np.dstack([picture[..., 0] // 2, picture[..., 1:]]) for picture in pictures(clip))
    write_clip(tmp_path / "red.avi", red, RATE)
    write_boxes(tmp_path / "red.csv", clip.truth.xywh)
    [made] = variant("grey", [Clip(tmp_path / "red.avi", clip.truth)], tmp_path / "made")
    picture = next(pictures(made))
    assert np.array_equal(picture[..., 0], picture[..., 2])
    assert np.array_equal(made.truth.xywh, clip.truth.xywh)


def test_first_boxes_are_off_by_what_is_stated(tmp_path):
    clip = a_clip(tmp_path)
    x, y, w, h = clip.first_box
    given = {
        kind: variant(kind, [clip], tmp_path / "made")[0].first_box
        for kind in ("shifted", "larger", "smaller")
    }
    assert np.abs(np.subtract(given["shifted"], (x, y, w, h))) == pytest.approx([0.8, 0.8, 0, 0])
    assert given["larger"] == pytest.approx([x - 0.8, y - 0.8, 17.6, 17.6])
    assert given["smaller"] == pytest.approx([x + 0.8, y + 0.8, 14.4, 14.4])
    assert clip.first_box == [x, y, w, h]


def test_what_was_made_is_kept_until_its_source_is_newer(tmp_path):
    clip = a_clip(tmp_path)
    [made] = variant("erased", [clip], tmp_path / "made")
    before = made.path.stat().st_mtime_ns
    variant("erased", [clip], tmp_path / "made")
    assert made.path.stat().st_mtime_ns == before
    later = made.path.stat().st_mtime + 1.0  # file systems count in steps of milliseconds
    os.utime(clip.path.with_suffix(".csv"), (later, later))
    variant("erased", [clip], tmp_path / "made")
    assert made.path.stat().st_mtime_ns > before


def test_every_kind_makes_a_clip(tmp_path):
    clip = a_clip(tmp_path)
    for kind in KINDS:
        [made] = variant(kind, [clip], tmp_path / kind)
        assert made.name == clip.name and made.frames > 0
