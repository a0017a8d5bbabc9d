"""The notebooks as scripts run, and find what is true of their example."""

import importlib.util
import os
import sys

import numpy as np
import ols
import pandas as pd
from archive_site import ROOT
from conftest import finished
from ols_demo.places import geodetic

NOTEBOOKS = ROOT / "docs/notebooks"
FRAME = ols.LocalFrame(geodetic(49.2266, 16.5969, 310.0))


def run(name, *arguments):
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    return finished(sys.executable, NOTEBOOKS / f"{name}.py", *arguments, env=environment)


def flown():
    """What made the example: the drone `a` of the goldens."""
    path = ROOT / "tests/golden/make_log.py"
    spec = importlib.util.spec_from_file_location("make_log", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_csv_is_triangulated(tmp_path):
    ran = run("triangulate_csv", "--output", tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "triangulated.png").stat().st_size > 10_000
    fixes, truth = pd.read_csv(tmp_path / "fixes.csv"), flown()
    off_m = []
    for fix in fixes.itertuples():
        place = geodetic(fix.latitude_deg, fix.longitude_deg, fix.height_m)
        there = truth.place("a", (fix.utime - truth.START_US) * 1e-6)
        off_m.append(FRAME.to_enu(ols.ecef_from_geodetic(place)) - there)
    rms_m = np.sqrt(np.mean(np.square(off_m), axis=0))
    stated_m = fixes[["east_sd_m", "north_sd_m", "up_sd_m"]].median().to_numpy()
    print(f"{len(fixes)} positions, off by {rms_m.round(3)} m, stated {stated_m.round(3)} m")
    assert len(fixes) > 200
    assert (rms_m < 2 * stated_m).all()


def test_a_csv_that_is_damaged_is_named(tmp_path):
    damaged = tmp_path / "bearings.csv"
    damaged.write_text(
        (NOTEBOOKS / "example/bearings.csv").read_text() + "1700000099000000,alfa,north,3,0.1,1\n"
    )
    ran = run("triangulate_csv", NOTEBOOKS / "example/stations.csv", damaged, "--output", tmp_path)
    assert ran.returncode != 0
    assert f"{damaged}:259: azimuth_deg" in ran.stderr


def test_a_site_is_planned(tmp_path):
    ran = run("plan_a_site", "--output", tmp_path)
    assert ran.returncode == 0, ran.stderr
    worst_m = {line[:12].strip(): float(line.split()[-2]) for line in ran.stdout.splitlines()[:2]}
    assert worst_m["best places"] < 0.7 * worst_m["in a row"], ran.stdout
    assert (tmp_path / "plan.png").stat().st_size > 10_000


def test_a_log_is_computed_again(tmp_path):
    ran = run("reanalyse_a_log", "--output", tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert "257 bearings of 3 stations" in ran.stdout
    moved = [line for line in ran.stdout.splitlines() if line.startswith("without ")]
    assert [line.split()[1] for line in moved] == ["alfa", "bravo", "charlie"]
    assert (tmp_path / "left_out.png").stat().st_size > 10_000
    again = run("reanalyse_a_log", tmp_path / "example.lcmlog", "--output", tmp_path)
    assert again.stdout == ran.stdout
