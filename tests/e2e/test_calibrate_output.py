"""The folder that `ols-calibrate adjust` writes: whole or not at all, never over another one.
Which names it refuses, OutputFolder judges."""

import json
import resource
import tomllib

import numpy as np
import pytest
from calibrate_run import SEED, Run
from conftest import BIN, finished


@pytest.fixture(name="run")
def fixture_run(tmp_path):
    print(f"seed {SEED}")
    return Run(tmp_path)


def test_the_folder_has_all_that_was_found(run):
    run.adjusted()
    assert sorted(path.name for path in run.output.iterdir()) == [
        *("covariance.csv", "instrument.toml", "predictions.csv"),
        *("report.html", "report.json", "setup.toml"),
    ]
    setup = tomllib.loads((run.output / "setup.toml").read_text())
    assert setup["calibration_id"] == run.report()["stations"][0]["calibration_id"] > 0
    heading = np.degrees(run.one.unit.heading)
    assert abs((setup["pose"]["heading_deg"] - heading + 180) % 360 - 180) < 60 / 3600
    assert run.rejected() == []
    assert "<svg" in (run.output / "report.html").read_text()


def test_the_same_input_has_the_same_id_and_another_one_another(run):
    ids = []
    for name in ("a", "b", "c"):
        run.output = run.folder / name
        if name == "c":
            run.change("observations.jsonl", 2, '"x_px": ', '"x_px": 0')
            line = json.loads(run.lines("observations.jsonl")[2])
            line["x_px"] += 0.01
            lines = run.lines("observations.jsonl")
            lines[1] = json.dumps(line)
            (run.folder / "observations.jsonl").write_text("\n".join(lines) + "\n")
        run.adjusted()
        ids.append(run.report()["stations"][0]["calibration_id"])
    assert ids[0] == ids[1] != ids[2]


def test_a_calibration_is_never_overwritten(run):
    run.adjusted()
    before = {path.name: path.read_bytes() for path in run.output.iterdir()}
    error = run.refused()
    assert "is not empty: a calibration is never overwritten" in error
    assert before == {path.name: path.read_bytes() for path in run.output.iterdir()}
    run.output = run.folder / "references.csv"
    assert "--output" in run.adjust().stderr


def test_a_disk_that_is_full_leaves_nothing(run):
    """The instrument still fits below the limit, the covariance does not."""
    before = sorted(run.folder.iterdir())
    done = finished(
        *(BIN / "ols-calibrate", "adjust", *run.arguments, "--output", run.output),
        restore_signals=False,  # of a file that grows too large: an error, not the end
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000)),
    )
    assert done.returncode == 2
    assert "covariance.csv" in done.stderr
    assert before == sorted(run.folder.iterdir())
