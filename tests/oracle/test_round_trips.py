"""There and back again through the product alone, over whatever hypothesis thinks of."""

import numpy as np
import ols
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from ols_demo.places import geodetic
from reference import Camera, Station
from stations import HEIGHT_PX, WIDTH_PX, as_product, pan_tilt

settings.register_profile("oracle", deadline=None, derandomize=True, max_examples=300)
settings.load_profile("oracle")

latitudes = st.floats(-90, 90)
longitudes = st.floats(-180, 180)
small_deg = st.floats(-6, 6)
pixels = st.tuples(st.floats(0, WIDTH_PX - 1), st.floats(0, HEIGHT_PX - 1))
cameras = st.builds(
    Camera,
    fx=st.floats(800, 20000),
    fy=st.floats(800, 20000),
    k1=st.floats(-0.15, 0.15),
    k2=st.floats(-0.01, 0.05),
    p1=st.floats(-2e-3, 2e-3),
    p2=st.floats(-2e-3, 2e-3),
)
stations = st.builds(
    Station,
    latitude=latitudes,
    longitude=longitudes,
    height_m=st.floats(-400, 9000),
    heading=st.floats(0, 360),
    tilt_x=small_deg,
    tilt_y=small_deg,
    mount_z=small_deg,
    mount_x=small_deg,
    mount_y=small_deg,
    pan_sign=st.sampled_from([-1, 1]),
    tilt_sign=st.sampled_from([-1, 1]),
    pan_zero=st.floats(-180, 180),
    camera=cameras,
)


@given(latitudes, longitudes, st.floats(-500, 400e3))
def test_geodetic(latitude, longitude, height_m):
    position = geodetic(latitude, longitude, height_m)
    p_ecef = ols.ecef_from_geodetic(position)
    back = ols.geodetic_from_ecef(p_ecef)
    np.testing.assert_allclose(ols.ecef_from_geodetic(back), p_ecef, atol=1e-8, rtol=0)
    assert abs(back.height_m - height_m) < 1e-8


@given(latitudes, longitudes, st.tuples(*[st.floats(-1e5, 1e5)] * 3))
def test_local_frame(latitude, longitude, p_enu):
    frame = ols.LocalFrame(
        ols.Geodetic(latitude_rad=np.radians(latitude), longitude_rad=np.radians(longitude))
    )
    np.testing.assert_allclose(frame.to_enu(frame.to_ecef(p_enu)), p_enu, atol=1e-8, rtol=0)


@given(st.floats(0, 2 * np.pi, exclude_max=True), st.floats(-np.pi / 2, np.pi / 2))
def test_direction(azimuth_rad, elevation_rad):
    direction = ols.AzimuthElevation(azimuth_rad=azimuth_rad, elevation_rad=elevation_rad)
    v_enu = ols.enu_from_azimuth_elevation(direction)
    back = ols.azimuth_elevation_from_enu(v_enu)
    assert 0 <= back.azimuth_rad < 2 * np.pi
    assert ols.angle_between(ols.enu_from_azimuth_elevation(back), v_enu) < 1e-15


@given(cameras, pixels)
def test_pixel(camera, pixel):
    camera = as_product(Station(camera=camera)).camera
    ray = ols.unproject(camera, pixel)
    assume(ray is not None)
    np.testing.assert_allclose(ols.project(camera, ray), pixel, atol=2e-9)


@given(stations, st.floats(-159, 159), st.floats(-47, 31), pixels, st.floats(2, 100e3))
def test_sight_and_view(station, pan, tilt, pixel, distance_m):
    product = as_product(station)
    line = ols.sight(product, ols.PixelSight(pixel=pixel, angles=pan_tilt(pan, tilt)))
    assume(line is not None)
    p_ecef = line.origin_ecef + distance_m * ols.direction_ecef(line)
    view = ols.view(product, pan_tilt(pan, tilt), p_ecef)
    np.testing.assert_allclose(view.pixel, pixel, atol=2e-4)  # nanometres of ECEF at 2 m
    assert abs(view.distance_m - distance_m) < 1e-8


@given(stations, st.floats(-159, 159), st.floats(-47, 31), pixels, st.floats(20, 100e3))
def test_sight_and_aim_at(station, pan, tilt, pixel, distance_m):
    product = as_product(station)
    line = ols.sight(product, ols.PixelSight(pixel=pixel, angles=pan_tilt(pan, tilt)))
    assume(line is not None)
    p_ecef = line.origin_ecef + distance_m * ols.direction_ecef(line)
    angles = ols.aim_at(product, p_ecef, pixel)
    view = ols.view(product, angles, p_ecef)
    np.testing.assert_allclose(view.pixel, pixel, atol=1e-4)
