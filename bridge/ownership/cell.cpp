#include "bridge/ownership/cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ols::bridge {
namespace {

constexpr double kMetresPerDegree = 111'195.0;

double apart_deg(double one_deg, double other_deg) {
  return std::abs(std::remainder(one_deg - other_deg, 360.0));
}

}  // namespace

double depth_m(const Cell& cell, double latitude_deg, double longitude_deg) {
  const auto& [south, west, north, east] = cell;
  const double across = kMetresPerDegree * std::cos(latitude_deg * std::numbers::pi / 180.0);
  const double height_m = kMetresPerDegree * std::min(latitude_deg - south, north - latitude_deg);
  if (east - west >= 360.0) return height_m;
  // The nearer of both borders counts.
  const double side_deg = std::min(apart_deg(longitude_deg, west), apart_deg(longitude_deg, east));
  const bool is_between = spans_longitude(cell, std::remainder(longitude_deg, 360.0));
  return std::min(height_m, across * (is_between ? side_deg : -side_deg));
}

}  // namespace ols::bridge
