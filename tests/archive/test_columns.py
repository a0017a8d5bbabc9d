"""The module's functions on columns: the same as on objects, and clear about bad columns."""

import math

import numpy as np
import ols
import pytest
from archive_site import flown
from ols_batch.task import TRIPLES

NAMES = (
    *("utime", "boot_id", "track_id", "calibration_id", "azimuth_rad", "elevation_rad", "belief"),
    *("clock_error_s", *sorted(TRIPLES)),
)


def columns_of(messages) -> dict:
    return {name: np.array([getattr(m, name) for m in messages]) for name in NAMES}


def bearings_of(messages, **changed) -> "ols.Bearings":
    stations = [message.station for message in messages]
    return ols.Bearings(stations, **(columns_of(messages) | changed))


def matrix(xx_xy_yy) -> list:
    xx, xy, yy = xx_xy_yy
    return [[xx, xy], [xy, yy]]


def measurement(m) -> "ols.BearingMeasurement":
    sight = ols.SightLine(
        origin_ecef=m.camera_ecef_m,
        direction=ols.AzimuthElevation(azimuth_rad=m.azimuth_rad, elevation_rad=m.elevation_rad),
        covariance_white=matrix(m.covariance_white_rad2),
        covariance_systematic=matrix(m.covariance_systematic_rad2),
        origin_sd_enu_m=m.camera_position_sd_m,
    )
    return ols.BearingMeasurement(
        station=m.station,
        utime_us=m.utime,
        sight=sight,
        belief=m.belief,
        clock_sd_s=m.clock_error_s,
        track_id=m.track_id,
    )


@pytest.mark.parametrize("estimator", ["filter", "least-squares", "paper"])
def test_columns_give_what_objects_give(estimator):
    messages = [message for message in flown(1) if message.track_id == 1]
    config = ols.OfflineConfig(estimator=estimator)
    wanted = ols.fuse_offline([measurement(m) for m in messages], config)
    found, _, _ = ols.fuse_columns(bearings_of(messages), np.arange(len(messages)), config)
    assert len(wanted) > 100
    assert found["utime"].tolist() == [target.utime_us for target in wanted]
    assert found["position_ecef_m"].tolist() == [
        target.estimate.position_ecef.tolist() for target in wanted
    ]
    assert found["stations_used"].max() == 4
    place = ols.geodetic_from_ecef(wanted[7].estimate.position_ecef)
    expected = [*map(math.degrees, (place.latitude_rad, place.longitude_rad)), place.height_m]
    assert found["place"][7].tolist() == pytest.approx(expected, rel=1e-12)
    R = np.asarray(ols.R_ecef_enu(wanted[7].estimate.position_ecef))
    enu = R.T @ wanted[7].estimate.covariance_ecef @ R
    assert found["position_covariance_enu_m2"][7] == pytest.approx(enu[np.triu_indices(3)])


def test_objects_are_told_apart_by_association():
    messages = flown(1)
    objects = ols.separate_objects(bearings_of(messages))
    drones = np.array([message.track_id for message in messages])
    assert set(objects.tolist()) == {1, 2}
    assert len({(a, b) for a, b in zip(objects.tolist(), drones.tolist(), strict=True)}) == 2


def test_a_refused_bearing_has_the_reason_of_the_fusion():
    messages = flown(1)[:20]
    azimuth_rad = columns_of(messages)["azimuth_rad"]
    azimuth_rad[3] = math.nan
    objects = ols.separate_objects(bearings_of(messages, azimuth_rad=azimuth_rad))
    assert ols.REFUSALS[int(objects[3])] == "refused_not_finite"
    assert (np.delete(objects, 3) >= 0).all()


def test_a_column_of_another_shape_is_named():
    messages = flown(1)[:5]
    with pytest.raises(ValueError, match="belief must have 5 rows of 1"):
        bearings_of(messages, belief=np.ones(4))
    with pytest.raises(ValueError, match="camera_ecef_m must have 5 rows of 3"):
        bearings_of(messages, camera_ecef_m=np.ones(15))
    columns = columns_of(messages)
    del columns["track_id"]
    with pytest.raises(TypeError, match="no column track_id"):
        ols.Bearings(["alfa"] * 5, **columns)
    with pytest.raises(IndexError):
        ols.fuse_columns(bearings_of(messages), np.array([5]))
