// The area in which a fusion owns targets: a box of latitude and longitude. Pure.
#pragma once

#include "base/config/area.h"

namespace ols::bridge {

using Cell = Area;

// Distance of a place from the cell's border [m]; positive inside, negative outside.
double depth_m(const Cell& cell, double latitude_deg, double longitude_deg);

}  // namespace ols::bridge
