"""The modules `ols` and `ols_msg` as Python's users expect values to behave."""

import pickle
import re

import numpy as np
import ols
import ols_msg


def same(a, b):
    """Also inside: values have no equality of their own, and arrays none that is one answer."""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b, equal_nan=True)
    if isinstance(a, list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if type(a).__module__ != "ols._core" or isinstance(a, ols.Solution | ols.ErrorSource):
        return a == b or (a != a and b != b)
    members = [name for name, kind in vars(type(a)).items() if isinstance(kind, property)]
    return all(same(getattr(a, name), getattr(b, name)) for name in members)


def test_has_a_version():
    assert re.fullmatch(r"\d+\.\d+\.\d+", ols.__version__)


def test_values_are_pickled_whole():
    place = ols.Geodetic(latitude_rad=0.8, longitude_rad=0.3, height_m=250.0)
    frame = ols.LocalFrame(place)
    station = ols.PlannedStation(place=frame, white_rad=1e-4)
    other = ols.PlannedStation(
        place=ols.LocalFrame(ols.Geodetic(latitude_rad=0.8001, longitude_rad=0.3)), white_rad=1e-4
    )
    above = ols.PlannedTarget(p_ecef=frame.to_ecef(np.array([100.0, 200.0, 300.0])))
    target = ols.FusedTarget(
        utime_us=5,
        estimate=ols.Estimate(solution=ols.Solution.TOO_FAR, rays=[ols.RayUse(weight=0.5)]),
        contributing=[ols.ContributingStation(station="a", used=True, weight=0.5)],
    )
    assert target.stations == ["a"]
    for value in (station, ols.position_precision([station, other], above), target):
        again = pickle.loads(pickle.dumps(value))
        assert same(again, value) and not same(again, type(value)())


def test_decoded_booleans_can_be_read_again():
    message = ols_msg.target_t()
    message.stations, message.station = 2, ["a", "b"]
    message.used, message.weight, message.age_s = [True, False], [1.0, 0.0], [0.0, 0.0]
    decoded = ols_msg.target_t.decode(message.encode())
    assert [list(decoded.used), list(decoded.used)] == 2 * [[True, False]]
