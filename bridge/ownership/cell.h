// The area for which a fusion owns targets: a box of latitude and longitude. Pure.
#pragma once

#include "base/config/area.h"

namespace ols::bridge {

using Cell = Area;

// How far a place is inside the cell's border [m]; negative: outside.
double depth_m(const Cell& cell, double latitude_deg, double longitude_deg);

}  // namespace ols::bridge
