"""Stations for the tests: random ones, and the product's form of a reference station."""

import numpy as np
import ols
from ols_demo.places import geodetic
from reference import Camera, Station

# The sensor of all of them.
WIDTH_PX, HEIGHT_PX = 1280, 960


def as_product(s, sd=None):
    """The reference's Station as the product's StationGeometry."""
    rad, c = np.radians, s.camera
    return ols.StationGeometry(
        position=geodetic(s.latitude, s.longitude, s.height_m),
        chain=ols.ChainParameters(
            heading_rad=rad(s.heading),
            tilt_x_rad=rad(s.tilt_x),
            tilt_y_rad=rad(s.tilt_y),
            ground_to_origin_m=s.ground_to_origin,
            origin_to_azi_m=s.origin_to_azi,
            azi_to_ele_m=s.azi_to_ele,
            ele_to_focus_m=s.ele_to_focus,
            focus_to_camera_m=s.focus_to_camera,
            mount_z_rad=rad(s.mount_z),
            mount_x_rad=rad(s.mount_x),
            mount_y_rad=rad(s.mount_y),
            pan_sign=s.pan_sign,
            tilt_sign=s.tilt_sign,
            pan_zero_rad=rad(s.pan_zero),
            tilt_zero_rad=rad(s.tilt_zero),
        ),
        camera=ols.CameraIntrinsics(
            width_px=WIDTH_PX,
            height_px=HEIGHT_PX,
            fx_px=c.fx,
            fy_px=c.fy,
            cx_px=c.cx,
            cy_px=c.cy,
            skew=c.skew,
            k1=c.k1,
            k2=c.k2,
            p1=c.p1,
            p2=c.p2,
            k3=c.k3,
        ),
        sd=sd or ols.CalibrationSd(),
    )


def pan_tilt(pan_deg, tilt_deg):
    return ols.PanTilt(pan_rad=np.radians(pan_deg), tilt_rad=np.radians(tilt_deg))


def random_camera(rng):
    focal_px = rng.uniform(900, 15000)
    return Camera(
        fx=focal_px,
        fy=focal_px * rng.uniform(0.98, 1.02),
        cx=639.5 + rng.uniform(-30, 30),
        cy=479.5 + rng.uniform(-30, 30),
        skew=rng.uniform(-2, 2),
        k1=rng.uniform(-0.2, 0.1),
        k2=rng.uniform(0, 0.05),
        p1=rng.uniform(-2e-3, 2e-3),
        p2=rng.uniform(-2e-3, 2e-3),
        k3=rng.uniform(0, 0.01),
    )


def random_station(rng):
    """Anywhere on Earth but the poles, crooked in every way."""
    return Station(
        latitude=rng.uniform(-85, 85),
        longitude=rng.uniform(-180, 180),
        height_m=rng.uniform(-300, 5000),
        heading=rng.uniform(0, 360),
        tilt_x=rng.uniform(-8, 8),
        tilt_y=rng.uniform(-8, 8),
        ground_to_origin=tuple(rng.uniform(-2, 2, 3)),
        origin_to_azi=tuple(rng.uniform(-0.2, 0.2, 3)),
        azi_to_ele=tuple(rng.uniform(-0.1, 0.1, 3)),
        ele_to_focus=tuple(rng.uniform(-0.1, 0.1, 3)),
        focus_to_camera=tuple(rng.uniform(-0.1, 0.1, 3)),
        mount_z=rng.uniform(-5, 5),
        mount_x=rng.uniform(-5, 5),
        mount_y=rng.uniform(-5, 5),
        pan_sign=rng.choice([-1, 1]).item(),
        tilt_sign=rng.choice([-1, 1]).item(),
        pan_zero=rng.uniform(-180, 180),
        tilt_zero=rng.uniform(-10, 10),
        camera=random_camera(rng),
    )


def random_pixel(rng):
    return rng.uniform([0, 0], [WIDTH_PX - 1, HEIGHT_PX - 1])


def random_angles_deg(rng):
    return rng.uniform(-159, 159), rng.uniform(-47, 31)
