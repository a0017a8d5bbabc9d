"""OLS from Python: the product's own C++ mathematics, so that there is no second one.

Units are SI and radians, heights are above the WGS84 ellipsoid. A name says its frame: `p_ecef` is
a point in Earth-centred Earth-fixed metres, `v_enu` a vector in east-north-up. Vectors and matrices
are numpy arrays of float64. Functions that may have no answer return None. All fields of the data
classes can be given by keyword; those left out keep the product's defaults. An array in a field is
read as a copy and replaced as a whole.
"""

from ols import _core
from ols._core import *  # noqa: F403
from ols._core import __version__

__all__ = ["__version__"]
__all__ += _core.__all__
