"""Geographic places in degrees, as messages carry them."""

import numpy as np
import ols


def geodetic(latitude_deg: float, longitude_deg: float, height_m: float) -> ols.Geodetic:
    """A place from WGS84 degrees and metres above the ellipsoid."""
    return ols.Geodetic(
        latitude_rad=float(np.radians(latitude_deg)),
        longitude_rad=float(np.radians(longitude_deg)),
        height_m=float(height_m),
    )
