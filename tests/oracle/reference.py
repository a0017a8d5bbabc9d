"""The geometry of a camera station, written a second time from the paper, for the tests alone.

It shares no code with the product and goes other ways where there are any: 4x4 matrices in the
order of the paper's eq. (1), WGS84 from its textbook formulas, the camera in the paper's X-forward
frame throughout, distortion inverted by fixed-point iteration. Frames are X forward, Y left, Z up.
Angles of a station are in degrees, as a person writes them.
"""

from dataclasses import dataclass, field

import numpy as np

A_M = 6378137.0
FLATTENING = 1 / 298.257223563
E2 = FLATTENING * (2 - FLATTENING)


@dataclass
class Camera:
    fx: float = 50e-3 / 3.75e-6
    fy: float = 50e-3 / 3.75e-6
    cx: float = 639.5
    cy: float = 479.5
    skew: float = 0.0
    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0


@dataclass
class Station:
    latitude: float = 49.2
    longitude: float = 16.6
    height_m: float = 300.0
    heading: float = 0.0
    tilt_x: float = 0.0
    tilt_y: float = 0.0
    ground_to_origin: tuple = (0.0, 0.0, 1.5)
    origin_to_azi: tuple = (0.0, 0.0, 0.09)
    azi_to_ele: tuple = (0.0, 0.0, 0.0)
    ele_to_focus: tuple = (0.0, 0.0, 0.06)
    focus_to_camera: tuple = (0.05, 0.0, 0.0)
    mount_z: float = 0.0
    mount_x: float = 0.0
    mount_y: float = 0.0
    pan_sign: int = 1
    tilt_sign: int = 1
    pan_zero: float = 0.0
    tilt_zero: float = 0.0
    camera: Camera = field(default_factory=Camera)


def ecef(latitude, longitude, height_m):
    """Degrees, ellipsoidal metres -> ECEF metres."""
    lat, lon = np.radians([latitude, longitude])
    n = A_M / np.sqrt(1 - E2 * np.sin(lat) ** 2)
    return np.array(
        [
            (n + height_m) * np.cos(lat) * np.cos(lon),
            (n + height_m) * np.cos(lat) * np.sin(lon),
            (n * (1 - E2) + height_m) * np.sin(lat),
        ]
    )


def geodetic(p_ecef):
    """ECEF metres -> degrees, degrees, ellipsoidal metres; by iteration, not for the poles."""
    x, y, z = p_ecef
    across = np.hypot(x, y)
    lat = np.arctan2(z, across * (1 - E2))
    for _ in range(20):
        n = A_M / np.sqrt(1 - E2 * np.sin(lat) ** 2)
        lat = np.arctan2(z + E2 * n * np.sin(lat), across)
    n = A_M / np.sqrt(1 - E2 * np.sin(lat) ** 2)
    height_m = across * np.cos(lat) + z * np.sin(lat) - n * (1 - E2 * np.sin(lat) ** 2)
    return np.degrees(lat), np.degrees(np.arctan2(y, x)), height_m


def east_north_up(latitude, longitude):
    """Rows: the unit vectors of east, north and up in ECEF."""
    lat, lon = np.radians([latitude, longitude])
    up = np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
    east = np.array([-np.sin(lon), np.cos(lon), 0.0])
    return np.array([east, np.cross(up, east), up])


def translation(v):
    M = np.eye(4)
    M[:3, 3] = v
    return M


def rotation(axis, deg):
    """4x4, right-handed about x, y or z: takes the next axis in cyclic order to the one after."""
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    c, s = np.cos(np.radians(deg)), np.sin(np.radians(deg))
    M = np.eye(4)
    M[j, j], M[j, k], M[k, j], M[k, k] = c, -s, s, c
    return M


def next_joint(M_previous, v, rz=0.0, rx=0.0, ry=0.0):
    """Eq. (1)."""
    return M_previous @ translation(v) @ rotation("z", rz) @ rotation("x", rx) @ rotation("y", ry)


def joints(s, pan, tilt):
    """{name: 4x4 pose in GROUND}; pan and tilt in degrees as the PTU reports them."""
    shaft_pan = s.pan_sign * pan + s.pan_zero
    shaft_tilt = s.tilt_sign * tilt + s.tilt_zero
    M = {"GROUND": np.eye(4)}
    # X is east at GROUND; a heading turns clockwise away from north.
    M["ORIGIN"] = next_joint(M["GROUND"], s.ground_to_origin, 90.0 - s.heading, s.tilt_x, s.tilt_y)
    M["AZI"] = next_joint(M["ORIGIN"], s.origin_to_azi, rz=shaft_pan)
    M["ELE"] = next_joint(M["AZI"], s.azi_to_ele, ry=-shaft_tilt)
    M["FOCUS"] = next_joint(M["ELE"], s.ele_to_focus, s.mount_z, s.mount_x, s.mount_y)
    M["CAMERA"] = next_joint(M["FOCUS"], s.focus_to_camera)
    return M


def distort(c, x, y):
    """OpenCV's documented model."""
    r2 = x * x + y * y
    radial = 1 + c.k1 * r2 + c.k2 * r2**2 + c.k3 * r2**3
    return (
        x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
        y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y,
    )


def project(c, p_forward_left_up):
    """Pixel of a point in the camera's X-forward frame, or None behind it."""
    forward, left, up = p_forward_left_up
    if forward <= 0:
        return None
    x, y = distort(c, -left / forward, -up / forward)
    return np.array([c.fx * x + c.skew * y + c.cx, c.fy * y + c.cy])


def unproject(c, pixel):
    """Unit ray of a pixel in the camera's X-forward frame."""
    y_wanted = (pixel[1] - c.cy) / c.fy
    x_wanted = (pixel[0] - c.cx - c.skew * y_wanted) / c.fx
    x, y = x_wanted, y_wanted
    for _ in range(100):
        x_distorted, y_distorted = distort(c, x, y)
        x, y = x + x_wanted - x_distorted, y + y_wanted - y_distorted
        if abs(x_wanted - x_distorted) + abs(y_wanted - y_distorted) < 1e-16:
            break
    ray = np.array([1.0, -x, -y])
    return ray / np.linalg.norm(ray)


def to_ecef(s, p_enu):
    return ecef(s.latitude, s.longitude, s.height_m) + p_enu @ east_north_up(
        s.latitude, s.longitude
    )


def to_enu(s, p_ecef):
    axes = east_north_up(s.latitude, s.longitude)
    return axes @ (p_ecef - ecef(s.latitude, s.longitude, s.height_m))


def look(s, pan, tilt, pixel, after_camera=None):
    """Camera centre (ECEF) and unit direction (ECEF) of a pixel's ray.

    after_camera: a further small 4x4 rotation of the camera, in its X-forward frame.
    """
    M = joints(s, pan, tilt)["CAMERA"]
    if after_camera is not None:
        M = M @ after_camera
    direction_enu = M[:3, :3] @ unproject(s.camera, pixel)
    return to_ecef(s, M[:3, 3]), direction_enu @ east_north_up(s.latitude, s.longitude)


def azimuth_elevation(origin_ecef, direction_ecef):
    """Degrees, in the horizon at the origin."""
    latitude, longitude, _ = geodetic(origin_ecef)
    east, north, up = east_north_up(latitude, longitude) @ direction_ecef
    return np.degrees(np.arctan2(east, north)) % 360, np.degrees(
        np.arctan2(up, np.hypot(east, north))
    )


def view(s, pan, tilt, p_ecef):
    """Pixel of a point, or None behind the camera."""
    M = joints(s, pan, tilt)["CAMERA"]
    p_camera = np.linalg.inv(M) @ np.append(to_enu(s, p_ecef), 1.0)
    return project(s.camera, p_camera[:3])
