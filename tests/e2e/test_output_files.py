"""What a program writes never costs what it reads, and what it has half written does not stay."""

import json
import signal
import subprocess

import pytest
from conftest import BIN, finished

STATIONS = "station,latitude_deg,longitude_deg,height_m\na,49.2,16.598,250\nb,49.2,16.602,250\n"
BEARINGS = "utime_us,station,azimuth_deg,elevation_deg,sigma_deg\n1600000000000000,a,45,10,0.01\n"
RING = [[16.6, 49.2], [16.61, 49.2], [16.61, 49.21], [16.6, 49.2]]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "stations.csv").write_text(STATIONS)
    (tmp_path / "bearings.csv").write_text(BEARINGS)
    (tmp_path / "area.json").write_text(json.dumps({"type": "Polygon", "coordinates": [RING]}))
    (tmp_path / "link.csv").symlink_to("stations.csv")
    return tmp_path


ADVISE = "ols-precision advise --places link.csv --area area.json --stations 1 --ground 250"


@pytest.mark.parametrize(
    "command",
    [
        "ols-fuse --stations stations.csv --bearings bearings.csv --output ./bearings.csv",
        "ols-fuse --stations stations.csv --bearings bearings.csv --output link.csv",
        "ols-precision map --stations stations.csv --output link.csv",
        "ols-precision map --stations stations.csv --output new.csv --geojson new.csv",
        "ols-precision budget --stations stations.csv --at 49.2,16.6,300 --output stations.csv",
        "ols-precision table --input stations.csv --output stations.csv",
        ADVISE + " --spacing 300 --kept stations.csv --output stations.csv",
        "ols-stationing --station stations.csv --landmarks l --sightings s --output link.csv",
    ],
)
def test_an_output_that_is_an_input_is_refused(folder, command):
    before = {path: path.read_bytes() for path in folder.iterdir()}
    program, *words = command.split()
    result = finished(BIN / program, *words, cwd=folder)
    assert result.returncode == 2 and " is the same file as --" in result.stderr, result.stderr
    assert {path: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_leaves_nothing_half_written(folder, number):
    """The figure of four million points takes longer than the signal does to arrive."""
    figure = ["figure3", "--steps", "2000", "--output", "out.csv"]
    # A background job is born deaf to SIGINT.
    heard = {"preexec_fn": lambda: signal.signal(number, signal.SIG_DFL)}
    with subprocess.Popen([BIN / "ols-precision", *figure], cwd=folder, **heard) as process:
        while not (folder / "out.csv.partial").exists():
            assert process.poll() is None
        process.send_signal(number)
        assert process.wait(timeout=60) == -number
    assert not list(folder.glob("out.csv*"))
