"""What `ols-calibrate` makes of a receiver of aircraft, and of pictures of boards."""

import gzip
import json
import os
import socket
import subprocess
import threading
import time
import tomllib
from datetime import UTC, datetime

import numpy as np
import pytest
from conftest import BIN, finished
from PIL import Image


def aircraft(*arguments, **options):
    command = [BIN / "ols-calibrate", "aircraft", *arguments]
    return subprocess.run(
        list(map(str, command)), capture_output=True, text=True, check=False, **options
    )


CHRONY = "50505300,PPS,1,$(date +%s.%N),0.0,0.0,1e-7,-1.8,0.0,0.016,1e-9,1e-5,16.0,{leap}"


@pytest.fixture(name="time_service")
def fixture_time_service(tmp_path):
    """An environment in which chronyc answers, and the clock is right or not."""

    def made(leap):
        folder = tmp_path / leap.replace(" ", "-")
        folder.mkdir()
        (folder / "chronyc").write_text(f"#!/bin/sh\necho {CHRONY.format(leap=leap)}\n")
        (folder / "chronyc").chmod(0o755)
        return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}

    return made


def aircraft_json(now_s):
    one = {"hex": "4ca2d6", "lat": 49.5, "lon": 16.25, "alt_geom": 33000}
    both = [one | {"seen_pos": age} for age in (0.5, 1.5)]
    return json.dumps({"now": now_s, "aircraft": both}).encode()


def sbs_lines(now_s):
    """Two; the second is sent as soon as it is heard, the first waited for some seconds."""
    lines = b""
    for age_s in (5.0, 0.0):
        stamp = datetime.fromtimestamp(now_s - age_s, UTC)
        day, second = stamp.strftime("%Y/%m/%d"), stamp.strftime("%H:%M:%S.%f")[:-3]
        times = f"{day},{second},{day},{second}"
        lines += f"MSG,3,1,1,4CA2D6,1,{times},,33000,,,49.5,16.25,,,0,0,0,0\n".encode()
    return lines


@pytest.fixture(name="receiver")
def fixture_receiver(network):
    """A receiver that tells of one aircraft, by a clock that is so far off; its address."""
    listener = socket.create_server(("127.0.0.1", 0))

    def listening(off_s, text=aircraft_json):
        def tell():
            connection, _ = listener.accept()
            connection.sendall(text(time.time() + off_s))
            connection.close()

        threading.Thread(target=tell, daemon=True).start()
        return f"127.0.0.1:{listener.getsockname()[1]}"

    yield listening
    listener.close()


def test_a_clock_that_is_not_synchronised_is_refused(time_service, receiver, tmp_path):
    arguments = ("--input", receiver(0.0), "--format", "json", "--output", tmp_path / "out.csv")
    done = aircraft(*arguments, env=time_service("Not synchronised"))
    assert done.returncode == 2
    assert "the clock of this computer is not synchronised" in done.stderr
    assert "--clock-is-right" in done.stderr
    assert not (tmp_path / "out.csv").exists()
    done = aircraft(*arguments, env=time_service("Normal"))
    assert done.returncode == 1, done.stderr
    assert "has closed the connection before --duration was over" in done.stderr
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 3


@pytest.mark.parametrize(
    "off_s, words, text, options",
    [
        (0.5, "s ahead by", aircraft_json, ("json",)),
        (-3.0, "s old by", sbs_lines, ("sbs", "--geometric")),
    ],
)
def test_a_receiver_whose_clock_is_off_is_refused(
    time_service, receiver, tmp_path, off_s, words, text, options
):
    arguments = ("--format", *options, "--output", tmp_path / "out.csv")
    normal = time_service("Normal")
    done = aircraft("--input", receiver(off_s, text), *arguments, env=normal)
    assert done.returncode == 2
    assert f"{words} this computer's clock" in done.stderr
    assert not (tmp_path / "out.csv").exists()
    done = aircraft("--input", receiver(0.0, text), *arguments, env=normal)
    assert done.returncode == 1, done.stderr  # it closes at once
    assert "2 positions\n" in done.stdout


def test_what_a_receiver_has_heard_becomes_references(tmp_path):
    inputs = []
    for k in range(2):
        one = {"hex": "4ca2d6", "lat": 49.5 + k / 100, "lon": 16.25, "alt_geom": 33000}
        low = {"hex": "4ca2d7", "lat": 49.5, "lon": 16.25, "alt_baro": 33000, "seen_pos": 0.1}
        text = {"now": 1_780_000_010 + k, "aircraft": [one | {"seen_pos": 0.5}, low]}
        path = tmp_path / f"aircraft{k}.json"
        path.write_text(json.dumps(text))
        inputs += ["--input", path]
    output = tmp_path / "references.csv"
    done = aircraft(*inputs, "--format", "json", "--output", output)
    assert done.returncode == 0, done.stderr
    assert "2 positions have a barometric height alone" in done.stderr
    assert output.read_text().splitlines()[1:] == [
        "4ca2d6,49.5000000,16.2500000,10058.4,10.0,1780000009500000",
        "4ca2d6,49.5100000,16.2500000,10058.4,10.0,1780000010500000",
    ]
    assert "is not overwritten" in aircraft(*inputs, "--format", "json", "--output", output).stderr
    silent = tmp_path / "silent.json"
    silent.write_text('{"now": 1780000010, "aircraft": []}')
    done = aircraft(
        *inputs, "--input", silent, "--format", "json", "--output", tmp_path / "without.csv"
    )
    assert done.returncode == 1
    assert f"{silent}: no position with a height above the ellipsoid" in done.stderr
    assert (tmp_path / "without.csv").read_text() == output.read_text()


def test_what_holds_no_reference_is_no_success(tmp_path):
    once, foreign, output = tmp_path / "once.json", tmp_path / "foreign", tmp_path / "x.csv"
    one = {"hex": "4ca2d6", "lat": 49.5, "lon": 16.25, "alt_geom": 33000, "seen_pos": 0.5}
    once.write_text(json.dumps({"now": 1_780_000_010, "aircraft": [one]}))
    foreign.write_bytes(gzip.compress(b"what a receiver sent"))
    beast = ("beast", "--start-utime", "1780000000000000")
    for path, how, said in (
        (once, ["json"], "each aircraft was seen at one time only"),
        (foreign, beast, f"{foreign}: no message of this format in it"),
    ):
        done = aircraft("--input", path, "--format", *how, "--output", output)
        assert done.returncode == 2
        assert said in done.stderr
        assert not output.exists()


def test_barometric_heights_are_refused_in_words(tmp_path):
    (tmp_path / "log").write_text("")
    done = aircraft("--input", tmp_path / "log", "--format", "sbs", "--output", tmp_path / "x")
    assert done.returncode == 2
    assert "its heights are barometric" in done.stderr


CAMERA = ("focal_px", "aspect", "cx_px", "cy_px")
CHESSBOARD = "data/calibration/opencv_chessboard"


def camera_of(pictures, output):
    command = [BIN / "ols-calibrate", "camera", "--columns", "9", "--rows", "6"]
    return finished(*command, "--pictures", *pictures, "--output", output)


def test_pictures_that_tell_less_than_they_should(shared, tmp_path):
    """Without the board: usual, unless most are; one that was bent is a fault. What is found,
    board_fit_test judges."""
    boards = sorted((shared / CHESSBOARD).glob("left*.jpg"))[:8]
    width, height = Image.open(boards[0]).size
    empty = [tmp_path / f"empty{k}.png" for k in range(9)]
    for path in empty:
        Image.new("L", (width, height), 128).save(path)

    done = camera_of([*boards, empty[0]], tmp_path / "one")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("8 of 9 pictures, residuals ")
    assert f"{empty[0]}: the board is not found" in done.stderr
    assert "residuals" not in done.stderr
    assert set(CAMERA) <= tomllib.loads((tmp_path / "one/instrument.toml").read_text())["sd"].keys()

    done = camera_of([*boards, *empty], tmp_path / "most")
    assert done.returncode == 1
    assert "most pictures do not show the board: check --board" in done.stderr
    assert done.stdout.startswith("8 of 17 pictures, ")

    bent = np.asarray(Image.open(boards[0]).convert("L"))
    columns = np.arange(width) + 6 * np.sin(np.arange(width) / 50)
    Image.fromarray(bent[:, columns.clip(0, width - 1).astype(int)]).save(tmp_path / "bent.png")
    done = camera_of([*boards[1:], tmp_path / "bent.png"], tmp_path / "bent")
    assert done.returncode == 1, done.stderr
    assert "bent.png: its corners are off by" in done.stderr
