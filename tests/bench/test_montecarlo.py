"""What tools/montecarlo --live makes of the reports of its runs."""

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from types import SimpleNamespace

import numpy as np
import ols
from conftest import ROOT
from ols_demo.evaluate import off_truth
from ols_demo.places import geodetic


def montecarlo():
    loader = SourceFileLoader("montecarlo", str(ROOT / "tools/montecarlo"))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def test_a_run_counts_if_stations_gave_bearings_of_their_images_while_they_tracked():
    tracked = {"alfa": (110, 1.0), "bravo": (60, 0.5), "charlie": (90, 1.0)}
    stations = {
        name: {"bearings": bearings, "tracking_fraction": share}
        for name, (bearings, share) in tracked.items()
    }
    report = {"seconds": 10.0, "stations": stations}
    assert montecarlo().starved(report, 12.0) == ["charlie"]


def test_the_runs_together_are_root_mean_squares():
    def report(rms_deg):
        error = {"rms_deg": [rms_deg, 0.1], "stated_deg": [0.2, 0.2]}
        details = {
            "normalised_error_squared_enu": [rms_deg, 1.0, 2.0],
            "rmse_m": rms_deg,
            "predicted_rmse_m": 1.0,
        }
        return {"joint_details": details, "stations": {"alfa": {"bearing_error": error}}}

    joint = montecarlo().summarise_live([report(3.0), report(1.0)])
    assert joint["nees_axis"]["east"] == {"mean": 2.0, "standard_error": 1.0}
    assert np.isclose(joint["rmse_m"], 5.0**0.5)
    assert np.allclose(joint["bearings"]["alfa"]["rms_deg"], [5.0**0.5, 0.1])


def test_a_bearings_error_is_on_the_tangent_plane():
    camera = np.asarray(ols.ecef_from_geodetic(geodetic(49.2, 16.6, 300.0)))
    elevation, azimuth = np.radians(60.0), np.radians(200.0)
    level = np.cos(elevation)
    enu = [level * np.sin(azimuth), level * np.cos(azimuth), np.sin(elevation)]
    truth = camera + 300.0 * np.asarray(ols.R_ecef_enu(camera)) @ enu
    bearing = SimpleNamespace(
        camera_ecef_m=camera, azimuth_rad=azimuth + 1e-3, elevation_rad=elevation - 2e-3
    )
    assert np.allclose(off_truth(bearing, truth), [0.5e-3, -2e-3], atol=1e-9)
