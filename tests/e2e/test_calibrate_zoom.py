"""The table of the overview station's zoom lens, measured live, against the lens as it is."""

import tomllib

import pytest
from conftest import BIN, ROOT, finished
from helpers import Listener, at_frame_rate
from ols_demo.bus import LIVE_URL
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring

SCENARIO = ROOT / "sim/scenarios/overview.toml"
STATION = "overview"
WIDEST_PX, RATIO, BEND = 8.0 / 3.75e-3, 10.0, 0.2  # of the scenario, and of sim/lens/zoom_truth.cpp


def true_focal_px(position):
    return WIDEST_PX * RATIO ** (position + BEND * position * (1.0 - position))


@pytest.fixture
def config(network, tmp_path):
    scenario = at_frame_rate(SCENARIO, 6.0, tmp_path)
    wiring = Wiring(BIN, scenario, 3, tmp_path)
    bring_up_loopback(wiring.prepare())
    listener = Listener()
    with Site(tmp_path / "logs") as started:
        wiring.start_simulator(started)
        wiring.start_station(started, STATION)
        listener.wait(
            lambda: abs(listener.wait_for_status(STATION).pan_limits_rad[0]) > 0.0, "homing", 60.0
        )
        yield wiring.configs[STATION]
        started.check()


def test_the_table_is_that_of_the_lens(config, tmp_path):
    """The simulated scenery has no structure that is finer than the longest end would need: there
    it must be said, and the other points stand."""
    table = tmp_path / "zoom.toml"
    command = [BIN / "ols-calibrate", "zoom", "--station", config, "--lcm-url", LIVE_URL]
    command += ["--positions", "3", "--output", table]
    done = finished(*command)
    print(done.stdout, done.stderr)
    points = tomllib.loads(table.read_text())["lens_motor"]["point"]
    assert [round(point["position"], 2) for point in points][:2] == [0.0, 0.5]
    assert done.stderr.count("too little of the scenery") == 3 - len(points)
    assert done.returncode == (0 if len(points) == 3 else 1)
    for point in points:
        truth, sd = true_focal_px(point["position"]), point["focal_sd_px"]
        assert sd < 0.004 * truth
        assert abs(point["focal_px"] - truth) < 3.5 * sd
