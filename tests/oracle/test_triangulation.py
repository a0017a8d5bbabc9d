"""The triangulation against a second one, written from the paper's section 6 in numpy."""

import itertools

import numpy as np
import ols
import pytest
from scipy.optimize import least_squares

SITE = ols.LocalFrame(ols.Geodetic(latitude_rad=0.86, longitude_rad=0.29, height_m=300.0))
TRIALS = 50


def unit(v):
    return v / np.linalg.norm(v)


def turned(v, axis, angle):
    """Rodrigues' formula."""
    along = axis * (axis @ v)
    return along + np.cos(angle) * (v - along) + np.sin(angle) * np.cross(axis, v)


def two_view(m1, u, b1, m2, v, b2):
    """The mid-plane intersection: both rays turned about the baseline into one plane."""
    m = unit(m2 - m1)
    normal_u, normal_v = unit(np.cross(m, u)), unit(np.cross(m, v))
    alpha = np.arccos(np.clip(normal_u @ normal_v, -1, 1))
    if np.cross(normal_u, normal_v) @ m < 0:
        alpha = -alpha
    beta1 = alpha * b2 / (b1 + b2)
    u, v = turned(u, m, beta1), turned(v, m, -(alpha - beta1))
    s_t, *_ = np.linalg.lstsq(np.column_stack([u, -v]), m2 - m1, rcond=None)
    return m1 + s_t[0] * u


def bases(views):
    for (m1, u, b1), (m2, v, b2) in itertools.combinations(views, 2):
        yield two_view(m1, u, b1, m2, v, b2), (m1 + m2) / 2, unit(m2 - m1)


def sine(target, centre, along):
    """n . unit(target - centre): the sine of the angle to the baseline."""
    return np.linalg.norm(np.cross(along, unit(target - centre)))


def n_view(views):
    pairs = list(bases(views))
    first = np.mean([t for t, _, _ in pairs], axis=0)
    w = np.exp([sine(first, centre, along) for _, centre, along in pairs])
    return w @ np.array([t for t, _, _ in pairs]) / w.sum()


def best_baseline(views):
    pairs = list(bases(views))
    first = np.mean([t for t, _, _ in pairs], axis=0)
    return max(pairs, key=lambda pair: sine(first, *pair[1:]))[0]


def random_views(rng, stations, noise_rad=1e-3):
    """Stations around a site, their noisy views of one target; local coordinates [m]."""
    target = np.array([*rng.uniform(-300, 300, 2), rng.uniform(50, 500)])
    views = []
    for k in range(stations):
        angle = 2 * np.pi * (k + rng.uniform(-0.3, 0.3)) / stations
        centre = np.array([600 * np.cos(angle), 600 * np.sin(angle), rng.uniform(-20, 20)])
        direction = unit(unit(target - centre) + noise_rad * rng.normal(size=3))
        views.append((centre, direction, rng.uniform(0.3, 1.0)))
    return target, views


def product_views(views):
    return [
        ols.PaperView(centre_ecef=SITE.to_ecef(m), direction_ecef=SITE.R_ecef_enu @ u, belief=b)
        for m, u, b in views
    ]


def local(answer):
    solution, position_ecef = answer
    assert solution == ols.Solution.OK
    return SITE.to_enu(position_ecef)


def test_two_view(rng):
    for _ in range(TRIALS):
        _, views = random_views(rng, 3)
        views = views[:2]
        (m1, u, b1), (m2, v, b2) = views
        found = local(ols.paper_two_view(*product_views(views)))
        np.testing.assert_allclose(found, two_view(m1, u, b1, m2, v, b2), atol=1e-6)


@pytest.mark.parametrize("stations", [3, 4, 7])
def test_n_view_and_best_baseline(rng, stations):
    for _ in range(TRIALS):
        _, views = random_views(rng, stations)
        found = local(ols.paper_n_view(product_views(views)))
        np.testing.assert_allclose(found, n_view(views), atol=1e-6)
        found = local(ols.paper_best_baseline(product_views(views)))
        np.testing.assert_allclose(found, best_baseline(views), atol=1e-6)


def rays_of(views, sigma_rad):
    rays = []
    for m, u, _ in views:
        origin = SITE.to_ecef(m)
        own_enu = ols.R_ecef_enu(origin).T @ (SITE.R_ecef_enu @ u)
        sight = ols.SightLine(
            origin_ecef=origin,
            direction=ols.azimuth_elevation_from_enu(own_enu),
            covariance_white=np.eye(2) * sigma_rad**2,
        )
        rays.append(ols.Ray(sight=sight))
    return rays


@pytest.mark.parametrize("stations", [2, 3, 5])
def test_joint_least_squares(rng, stations):
    """scipy's minimum of the same squared angles, and its covariance from its Jacobian."""
    sigma_rad = 1e-3
    for _ in range(TRIALS):
        target, views = random_views(rng, max(stations, 3), sigma_rad / 2)
        views = views[:stations]

        def residuals(x, views=views):
            # Tangents of the angles, times the direction they are turned in: isotropic noise.
            parts = [(x - m) / (u @ (x - m)) - u for m, u, _ in views]
            return np.concatenate(parts) / sigma_rad

        best = least_squares(residuals, target, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        estimate = ols.least_squares(rays_of(views, sigma_rad))
        assert estimate.solution == ols.Solution.OK
        np.testing.assert_allclose(SITE.to_enu(estimate.position_ecef), best.x, atol=1e-5)
        covariance = SITE.R_ecef_enu.T @ estimate.covariance_ecef @ SITE.R_ecef_enu
        expected = np.linalg.inv(best.jac.T @ best.jac)
        np.testing.assert_allclose(covariance, expected, rtol=1e-4, atol=1e-4 * expected.max())
        chi2 = 2 * best.cost
        np.testing.assert_allclose(estimate.residual**2 * (2 * stations - 3), chi2, rtol=1e-5)
