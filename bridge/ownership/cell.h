// Where a region's targets are: a box of latitude and longitude. Pure.
#pragma once

#include "base/area.h"

namespace ols::bridge {

using Cell = Area;

// How far inside of the cell's border this place is; negative: outside. [m]
double depth_m(const Cell& cell, double latitude_deg, double longitude_deg);

}  // namespace ols::bridge
