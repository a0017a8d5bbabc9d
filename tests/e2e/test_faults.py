"""Three faults that need a whole site, function only; tools/fault-run does all, and judges times.

What the fault run measures with is tested here too, on tracks made by hand; its mutations are in
test_fault_mutations.py.
"""

import json
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import BIN, ROOT, finished
from helpers import at_frame_rate
from ols_demo.recording import Recording
from ols_faults import cases_stop, measure
from ols_faults.case import Outcome
from ols_faults.evidence import Evidence

DEADLINE_S = 300.0
CASES = ["fusion-killed", "bus-fragments", "emergency-stop"]
STEP_S = 0.0025


def recording_of(speed_deg_s):
    """A PTU whose pan turns at speed_deg_s(t) for 4 s from instant 0."""
    times = np.arange(0.0, 4.0, STEP_S)
    pan = np.radians(np.cumsum(speed_deg_s(times)) * STEP_S)
    recording = Recording()
    for first in range(0, len(times), 12):
        samples = pan[first : first + 12]
        message = SimpleNamespace(
            utime=round(times[first] * 1e6),
            station="alfa",
            interval_s=STEP_S,
            samples=len(samples),
            pan_rad=samples,
            tilt_rad=np.zeros(len(samples)),
        )
        recording.receive("OLS_SIM_PTU_alfa", message, message.utime)
    return recording


def braking_from(start_s, speed=50.0, slowing=100.0):
    return lambda t: np.clip(speed - slowing * np.maximum(0.0, t - start_s), 0.0, speed)


def test_rest_is_when_nothing_moves_any_more():
    recording = recording_of(braking_from(1.0))
    assert measure.rest_s(recording, "alfa", 500_000, 4_000_000) == pytest.approx(1.0, abs=0.02)
    assert measure.rest_s(recording, "alfa", 2_000_000, 4_000_000) == 0.0


def test_what_moves_on_is_not_at_rest():
    recording = recording_of(lambda t: np.full_like(t, 5.0))
    assert measure.rest_s(recording, "alfa", 0, 4_000_000) is None
    assert measure.moved_deg(recording, "alfa", 0, 2_000_000) == pytest.approx(10.0, abs=0.1)


def test_braking_is_found_to_a_few_milliseconds():
    recording = recording_of(braking_from(1.03))
    speed, begins_s, slowing = measure.braking(recording, "alfa", 1_000_000)
    assert speed == pytest.approx(50.0, abs=0.5)
    assert begins_s == pytest.approx(0.03, abs=0.004)
    assert slowing == pytest.approx(100.0, rel=0.05)


@pytest.mark.parametrize(
    ("slowing", "late_s", "passes"), [(57.3, 0.05, True), (50.0, 0.05, False), (57.3, 0.07, False)]
)
def test_a_stop_is_judged_by_the_configured_acceleration(slowing, late_s, passes):
    recording = recording_of(braking_from(1.0 + late_s, 50.0, slowing))
    outcome = Outcome()
    evidence = Evidence(recording, ["alfa"])
    cases_stop.judge_stop(evidence, outcome, "alfa", (1_000_000, 3_500_000))
    rest = next(check for check in outcome.checks if check.what.startswith("at rest"))
    assert rest.passed is passes, rest


def test_what_was_not_measured_does_not_pass():
    outcome = Outcome()
    assert not outcome.passed
    outcome.at_most("a figure", 1.0, 2.0)
    assert outcome.passed
    outcome.at_most("never measured", None, 2.0)
    outcome.at_most("no number", float("nan"), 2.0)
    assert [check.passed for check in outcome.checks] == [True, False, False]
    assert not outcome.passed


@pytest.fixture(scope="module")
def cases(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("faults")
    scenario = at_frame_rate(ROOT / "sim/scenarios/faults.toml", 6.0, folder)
    command = [sys.executable, "-m", "ols_faults", "--output", str(folder), "--bin", str(BIN)]
    command += ["--scenario", str(scenario)]
    command += [argument for name in CASES for argument in ("--only", name)]
    done = finished(*command, cwd=ROOT)
    assert (folder / "faults.json").exists(), done.stdout + done.stderr
    assert "| fusion-killed |" in (folder / "faults.md").read_text()
    return json.loads((folder / "faults.json").read_text())["cases"]


def checks_of(case):
    assert case["error"] == ""
    return {check["what"]: check["passed"] for check in case["checks"]}


def test_stations_track_without_a_fusion(cases):
    """Judged by bearings at all: how many a second, and that none is lost, the fault run judges,
    because a busy machine may starve a tracker."""
    checks_of(cases["fusion-killed"])
    bearings_hz = [
        float(check["measured"].split()[0])
        for check in cases["fusion-killed"]["checks"]
        if check["what"].endswith(": bearings meanwhile")
    ]
    assert len(bearings_hz) == 4
    assert min(bearings_hz) > 0.0
    assert cases["fusion-killed"]["recovery_s"] is not None


def test_an_emergency_stop_holds_until_it_is_rearmed(cases):
    checks = checks_of(cases["emergency-stop"])
    assert checks["the station says so"]
    assert checks["moved while pressed"]
    assert checks["moved released, not re-armed"]
    assert checks["moves once re-armed"]


def test_forged_fragments_end_nobody_and_are_counted(cases):
    checks = checks_of(cases["bus-fragments"])
    assert checks["ols-ctl lists the stations meanwhile"]
    assert checks["the recorder is the same process"]
    assert checks["no process ended by itself"]
    counted = [passed for what, passed in checks.items() if "bus_fragments_refused" in what]
    assert len(counted) == 5  # four stations and the fusion
    assert all(counted)


def test_an_unknown_case_is_refused():
    done = finished(sys.executable, "-m", "ols_faults", "--only", "nothing")
    assert done.returncode == 2
    assert "no such case: nothing" in done.stderr
