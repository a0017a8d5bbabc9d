"""The product against the reference, over random stations that are crooked in every way."""

import numpy as np
import ols
import pytest
import reference
from ols_demo.places import geodetic
from stations import as_product, pan_tilt, random_angles_deg, random_pixel, random_station

STATIONS = 300


@pytest.fixture
def stations(rng):
    return [random_station(rng) for _ in range(STATIONS)]


def angle_between(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b))


def test_wgs84(rng):
    for _ in range(STATIONS):
        latitude, longitude, height_m = rng.uniform([-89.9, -180, -500], [89.9, 180, 30e3])
        position = geodetic(latitude, longitude, height_m)
        p_ecef = reference.ecef(latitude, longitude, height_m)
        np.testing.assert_allclose(ols.ecef_from_geodetic(position), p_ecef, atol=1e-8, rtol=0)
        axes = reference.east_north_up(latitude, longitude)
        np.testing.assert_allclose(ols.R_ecef_enu(position).T, axes, atol=1e-14)
        np.testing.assert_allclose(ols.R_ecef_enu(p_ecef).T, axes, atol=1e-13)
        back = ols.geodetic_from_ecef(p_ecef)
        latitude_back, longitude_back, height_back_m = reference.geodetic(p_ecef)
        assert np.degrees(back.latitude_rad) == pytest.approx(latitude_back, abs=1e-12)
        assert np.degrees(back.longitude_rad) == pytest.approx(longitude_back, abs=1e-12)
        assert back.height_m == pytest.approx(height_back_m, abs=1e-8)


def test_every_joint(stations, rng):
    for station in stations:
        pan, tilt = random_angles_deg(rng)
        expected = reference.joints(station, pan, tilt)
        poses = ols.joints(as_product(station).chain, pan_tilt(pan, tilt))
        assert [joint.name for joint in poses] == list(expected)
        for joint, pose in poses.items():
            np.testing.assert_allclose(pose, expected[joint.name], atol=1e-13)


def test_next_joint(rng):
    for _ in range(STATIONS):
        M = reference.next_joint(np.eye(4), rng.uniform(-1, 1, 3), *rng.uniform(-180, 180, 3))
        v, angles = rng.uniform(-1, 1, 3), rng.uniform(-180, 180, 3)
        rz, rx, ry = np.radians(angles)
        link = ols.Link(translation_m=v, rz_rad=rz, rx_rad=rx, ry_rad=ry)
        np.testing.assert_allclose(
            ols.next_joint(M, link), reference.next_joint(M, v, *angles), atol=1e-14
        )


def test_projection(stations, rng):
    for station in stations:
        camera = as_product(station).camera
        # Forward, left, up; within the image and a little beyond.
        forward_left_up = 40 * reference.unproject(station.camera, random_pixel(rng) * 1.1 - 50)
        forward, left, up = forward_left_up
        np.testing.assert_allclose(
            ols.project(camera, [-left, -up, forward]),
            reference.project(station.camera, forward_left_up),
            atol=1e-9,
        )


def test_unprojection(stations, rng):
    for station in stations:
        pixel = random_pixel(rng)
        forward, left, up = reference.unproject(station.camera, pixel)
        np.testing.assert_allclose(
            ols.unproject(as_product(station).camera, pixel), [-left, -up, forward], atol=1e-12
        )


def test_sight(stations, rng):
    for station in stations:
        pan, tilt = random_angles_deg(rng)
        pixel = random_pixel(rng)
        origin, direction = reference.look(station, pan, tilt, pixel)
        line = ols.sight(
            as_product(station), ols.PixelSight(pixel=pixel, angles=pan_tilt(pan, tilt))
        )
        np.testing.assert_allclose(line.origin_ecef, origin, atol=1e-8)
        assert angle_between(ols.direction_ecef(line), direction) < 1e-12
        azimuth, elevation = reference.azimuth_elevation(origin, direction)
        assert np.degrees(line.direction.elevation_rad) == pytest.approx(elevation, abs=1e-10)
        off = (np.degrees(line.direction.azimuth_rad) - azimuth + 180) % 360 - 180
        assert off * np.cos(line.direction.elevation_rad) == pytest.approx(0, abs=1e-10)


def test_view(stations, rng):
    seen = 0
    for station in stations:
        pan, tilt = random_angles_deg(rng)
        centre, direction = reference.look(station, pan, tilt, random_pixel(rng))
        p_ecef = centre + rng.choice([-1, 1, 1, 1]) * rng.uniform(5, 20e3) * direction
        expected = reference.view(station, pan, tilt, p_ecef)
        view = ols.view(as_product(station), pan_tilt(pan, tilt), p_ecef)
        assert (view is None) == (expected is None)
        if view is not None:
            seen += 1
            np.testing.assert_allclose(view.pixel, expected, atol=2e-5)  # 1e-9 m at 5 m
            assert view.distance_m == pytest.approx(np.linalg.norm(p_ecef - centre), abs=1e-8)
    assert STATIONS / 2 < seen < STATIONS


def test_aim_at_puts_the_point_on_the_pixel(stations, rng):
    reached = 0
    for station in stations:
        direction = reference.east_north_up(station.latitude, station.longitude).T @ [
            *rng.uniform(-1, 1, 2),
            rng.uniform(-0.7, 0.7),
        ]
        p_ecef = reference.to_ecef(station, np.zeros(3)) + rng.uniform(50, 50e3) * direction
        pixel = random_pixel(rng)
        angles = ols.aim_at(as_product(station), p_ecef, pixel)
        if angles is None:
            continue
        reached += 1
        found = reference.view(station, *np.degrees([angles.pan_rad, angles.tilt_rad]), p_ecef)
        np.testing.assert_allclose(found, pixel, atol=1e-4)
    assert reached > 0.9 * STATIONS


def test_aim_along_points_the_optical_axis(stations, rng):
    for station in stations:
        wanted = ols.AzimuthElevation(
            azimuth_rad=rng.uniform(0, 2 * np.pi), elevation_rad=rng.uniform(-1, 1)
        )
        angles = ols.aim_along(as_product(station), wanted)
        pan, tilt = np.degrees([angles.pan_rad, angles.tilt_rad])
        centre = [station.camera.cx, station.camera.cy]
        azimuth, elevation = reference.azimuth_elevation(
            *reference.look(station, pan, tilt, centre)
        )
        assert np.radians(azimuth) == pytest.approx(wanted.azimuth_rad, abs=1e-11)
        assert np.radians(elevation) == pytest.approx(wanted.elevation_rad, abs=1e-11)


def test_rotation_homography(stations, rng):
    for station in stations:
        for term in ("k1", "k2", "p1", "p2", "k3"):
            setattr(station.camera, term, 0.0)
        pan, tilt = random_angles_deg(rng)
        pixel = random_pixel(rng)
        centre, direction = reference.look(station, pan, tilt, pixel)
        pan_to, tilt_to = np.array([pan, tilt]) + rng.uniform(-1, 1, 2)
        H = ols.rotation_homography(
            as_product(station), pan_tilt(pan, tilt), pan_tilt(pan_to, tilt_to)
        )
        u, v, w = H @ [*pixel, 1]
        expected = reference.view(station, pan_to, tilt_to, centre + 1e10 * direction)
        np.testing.assert_allclose([u / w, v / w], expected, atol=1e-4)


def test_back_projection_is_the_papers_line(rng):
    # X(lambda) = P+ x + lambda C with the pseudo-inverse of P, near the origin of the world.
    for _ in range(STATIONS):
        K = np.array([[1200, 1.5, 640], [0, 1210, 480], [0, 0, 1.0]])
        R = reference.next_joint(np.eye(4), [0, 0, 0], *rng.uniform(-180, 180, 3))[:3, :3]
        C = rng.uniform(-10, 10, 3)
        P = K @ R @ np.hstack([np.eye(3), -C[:, None]])
        np.testing.assert_allclose(ols.projection_matrix(K, R, C), P, atol=1e-9)
        pixel = random_pixel(rng)
        point = P.T @ np.linalg.inv(P @ P.T) @ [*pixel, 1]
        along = point[:3] / point[3] - C
        direction = ols.back_project(P, pixel)
        assert abs(np.linalg.norm(np.cross(along, direction))) < 1e-6 * np.linalg.norm(along)
        assert (R @ direction)[2] > 0  # to the front
