"""What the scenarios say of the site and its landmarks."""

import tomllib

import numpy as np
import ols
from ols_demo.places import geodetic

from ols_accuracy.runs import SCENARIOS


def scenario(name: str) -> dict:
    return tomllib.loads((SCENARIOS / f"{name}.toml").read_text())


def site(content: dict) -> ols.LocalFrame:
    s = content["site"]
    return ols.LocalFrame(geodetic(s["latitude_deg"], s["longitude_deg"], s["height_m"]))


def landmark(trajectory: dict) -> ols.Geodetic:
    utm = ols.Utm(
        zone=trajectory["zone"],
        northern=True,
        easting_m=trajectory["easting_m"],
        northing_m=trajectory["northing_m"],
    )
    return ols.geodetic_from_utm(utm, trajectory["height_m"])


def grid_north_cost_m(content: dict, targets: list[str]) -> list[float]:
    """What it costs to take a grid bearing for an azimuth: the whole site turns."""
    origin = site(content)
    convergence_rad = ols.utm_from_geodetic(origin.origin).convergence_rad
    trajectories = {t["id"]: t["trajectory"] for t in content["target"]}
    costs = []
    for target in targets:
        place = origin.to_enu(ols.ecef_from_geodetic(landmark(trajectories[target])))
        costs.append(2 * np.sin(abs(convergence_rad) / 2) * np.hypot(*place[:2]))
    return costs
