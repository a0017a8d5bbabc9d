// Where a region's targets are: a box of latitude and longitude. Pure.
#pragma once

#include <array>

namespace ols::bridge {

// South, west, north, east [deg]; where west is greater than east, across the date line.
using Cell = std::array<double, 4>;

// How far inside of the cell's border this place is; negative: outside. [m]
double depth_m(const Cell& cell, double latitude_deg, double longitude_deg);

}  // namespace ols::bridge
