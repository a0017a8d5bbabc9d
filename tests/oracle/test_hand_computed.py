"""Cases that a person can check on a napkin, against the product and against the reference."""

import numpy as np
import ols
import pytest
import reference
from reference import Station
from stations import as_product, pan_tilt

CENTRE = np.array([639.5, 479.5])
PIXEL_DEG = np.degrees(np.arctan(3.75e-6 / 50e-3))  # one pixel of a 50 mm lens at the centre


def product_look(station, pan, tilt, pixel):
    line = ols.sight(as_product(station), ols.PixelSight(pixel=pixel, angles=pan_tilt(pan, tilt)))
    return np.degrees([line.direction.azimuth_rad, line.direction.elevation_rad])


def reference_look(station, pan, tilt, pixel):
    return np.array(
        reference.azimuth_elevation(*reference.look(station, pan, tilt, np.asarray(pixel)))
    )


@pytest.fixture(params=[product_look, reference_look], ids=["product", "reference"])
def look(request):
    return request.param


def test_heading_east_at_rest_looks_east(look):
    assert look(Station(heading=90), 0, 0, CENTRE) == pytest.approx([90, 0], abs=1e-5)


def test_heading_north_at_rest_looks_north(look):
    azimuth, elevation = look(Station(heading=0), 0, 0, CENTRE)
    assert (azimuth + 180) % 360 - 180 == pytest.approx(0, abs=1e-5)
    assert elevation == pytest.approx(0, abs=1e-5)


def test_positive_pan_turns_left_to_the_north(look):
    azimuth, _ = look(Station(heading=90), 30, 0, CENTRE)
    assert azimuth == pytest.approx(60, abs=1e-5)


def test_positive_tilt_looks_up(look):
    assert look(Station(heading=90), 0, 25, CENTRE) == pytest.approx([90, 25], abs=1e-5)


def test_negative_encoder_signs_turn_right_and_down(look):
    station = Station(heading=90, pan_sign=-1, tilt_sign=-1)
    assert look(station, 30, 25, CENTRE) == pytest.approx([120, -25], abs=1e-5)


def test_encoder_zeros_are_shaft_angles(look):
    station = Station(heading=90, pan_sign=-1, pan_zero=10, tilt_zero=5)
    # Shaft pan -30 + 10 = -20: right. Shaft tilt 5 + 5 = 10.
    assert look(station, 30, 5, CENTRE) == pytest.approx([110, 10], abs=1e-5)


def test_pixel_right_of_the_centre_has_a_greater_azimuth(look):
    azimuth, _ = look(Station(heading=90), 0, 0, CENTRE + [100, 0])
    assert azimuth == pytest.approx(90 + 100 * PIXEL_DEG, abs=2e-5)


def test_pixel_below_the_centre_has_a_lower_elevation(look):
    _, elevation = look(Station(heading=90), 0, 0, CENTRE + [0, 100])
    assert elevation == pytest.approx(-100 * PIXEL_DEG, abs=2e-5)


def test_azimuth_of_a_pixel_to_the_right_grows_with_the_elevation(look):
    azimuth, _ = look(Station(heading=90), 0, 60, CENTRE + [100, 0])
    assert azimuth == pytest.approx(90 + 200 * PIXEL_DEG, rel=1e-5)


@pytest.mark.parametrize(("pan", "elevation"), [(-90, -4), (90, 4), (0, 0), (180, 0)])
def test_tilt_x_puts_the_right_side_down(look, pan, elevation):
    assert look(Station(heading=90, tilt_x=4), pan, 0, CENTRE)[1] == pytest.approx(
        elevation, abs=1e-5
    )


@pytest.mark.parametrize(("pan", "elevation"), [(0, -4), (180, 4), (90, 0), (-90, 0)])
def test_tilt_y_puts_the_nose_down(look, pan, elevation):
    assert look(Station(heading=90, tilt_y=4), pan, 0, CENTRE)[1] == pytest.approx(
        elevation, abs=1e-5
    )


def test_mount_z_turns_the_camera_left_on_the_manipulator(look):
    assert look(Station(heading=90, mount_z=2), 0, 0, CENTRE) == pytest.approx([88, 0], abs=1e-5)
    # Tilted up by 60 degrees, the same rotation is 2 degrees of cross-elevation: twice in azimuth.
    azimuth, _ = look(Station(heading=90, mount_z=0.01), 0, 60, CENTRE)
    assert azimuth == pytest.approx(90 - 0.02, abs=1e-5)


def test_mount_y_puts_the_nose_of_the_camera_down(look):
    assert look(Station(heading=90, mount_y=2), 0, 10, CENTRE) == pytest.approx([90, 8], abs=1e-5)


def test_mount_x_rolls_the_camera_clockwise_seen_from_behind(look):
    # Rolled by a quarter, the image's right edge is at the bottom.
    azimuth, elevation = look(Station(heading=90, mount_x=90), 0, 0, CENTRE + [100, 0])
    assert azimuth == pytest.approx(90, abs=1e-5)
    assert elevation == pytest.approx(-100 * PIXEL_DEG, abs=2e-5)


def test_order_of_equation_one(look):
    # RZ 90: X north, Y west, Z up. Then RX 90: Y up, Z east. Then RY 20 takes X away from Z: from
    # north 20 degrees to the west. Any other order of the three looks elsewhere.
    station = Station(heading=90, mount_z=90, mount_x=90, mount_y=20)
    assert look(station, 0, 0, CENTRE) == pytest.approx([340, 0], abs=1e-5)


def test_camera_centre_moves_with_the_joints():
    # Panned left from east to north and tilted straight up: FOCUS, 0.06 above ELE, is now 0.06 to
    # the south of it, and CAMERA 0.05 above FOCUS.
    station = Station(heading=90)
    expected = [0, -0.06, 1.5 + 0.09 + 0.05]
    poses = ols.joints(as_product(station).chain, pan_tilt(90, 90))
    assert poses[ols.Joint.CAMERA][:3, 3] == pytest.approx(expected, abs=1e-12)
    assert reference.joints(station, 90, 90)["CAMERA"][:3, 3] == pytest.approx(expected, abs=1e-12)


def test_wgs84_axes():
    assert ols.ecef_from_geodetic(ols.Geodetic()) == pytest.approx([6378137, 0, 0], abs=1e-6)
    pole = ols.ecef_from_geodetic(ols.Geodetic(latitude_rad=np.pi / 2))
    assert pole == pytest.approx([0, 0, 6356752.314245], abs=1e-5)
