"""What the scenario's sigmas promise: the Cramer-Rao bound at its targets."""

import tomllib
from dataclasses import dataclass, replace

import numpy as np
import ols

from ols_accuracy.runs import SCENARIOS

PIXEL_SD_PX, DESIGNATION_SD_PX = 0.3, 1.0


@dataclass(frozen=True)
class Sigmas:
    """1-sigma; the roll about the optical axis moves nothing on it."""

    pixel_px: float
    heading_rad: float
    tilt_rad: float
    mounting_rad: float
    position_m: float

    def alone(self, source: str) -> "Sigmas":
        """Only this one; "all" of them, or "none" but the pixels."""
        if source == "all":
            return self
        fields = {"heading": "heading_rad", "tilt": "tilt_rad", "mounting": "mounting_rad"}
        fields |= {"position": "position_m"}
        return replace(self, **{f: 0.0 for name, f in fields.items() if name != source})


def scenario(name: str) -> dict:
    return tomllib.loads((SCENARIOS / f"{name}.toml").read_text())


def sigmas(content: dict) -> Sigmas:
    errors = content["errors"]
    return Sigmas(
        float(np.hypot(PIXEL_SD_PX, DESIGNATION_SD_PX)),
        *(np.radians(errors[name]["sd_deg"]) for name in ("heading", "tilt", "mounting")),
        errors["position"]["sd_m"],
    )


def site(content: dict) -> ols.LocalFrame:
    s = content["site"]
    return ols.LocalFrame(
        ols.Geodetic(
            latitude_rad=np.radians(s["latitude_deg"]),
            longitude_rad=np.radians(s["longitude_deg"]),
            height_m=s["height_m"],
        )
    )


def landmark(trajectory: dict) -> ols.Geodetic:
    utm = ols.Utm(
        zone=trajectory["zone"],
        northern=True,
        easting_m=trajectory["easting_m"],
        northing_m=trajectory["northing_m"],
    )
    return ols.geodetic_from_utm(utm, trajectory["height_m"])


def predicted_m(content: dict, place: ols.Geodetic, given: Sigmas) -> float:
    """Horizontal 1-sigma (root of the two variances' sum) [m] of one exposure of each station."""
    camera = content["camera"]
    px_rad = camera["pixel_um"] * 1e-3 / camera["focal_length_mm"]
    stations = [
        ols.PlannedStation(
            place=ols.LocalFrame(
                ols.geodetic_from_ecef(site(content).to_ecef(np.array(s["position_enu_m"])))
            ),
            white_rad=given.pixel_px * px_rad,
            calibration=ols.CalibrationSd(
                heading_rad=given.heading_rad,
                tilt_rad=given.tilt_rad,
                mount_rad=given.mounting_rad,
                position_m=given.position_m,
            ),
        )
        for s in content["station"]
    ]
    target = ols.PlannedTarget(p_ecef=ols.ecef_from_geodetic(place))
    C = ols.position_precision(stations, target).covariance_ecef
    R = ols.R_ecef_enu(place)
    return float(np.sqrt(np.trace((R.T @ C @ R)[:2, :2])))
