#include "bridge/ownership/cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ols::bridge {
namespace {

constexpr double kMetresPerDegree = 111'195.0;

double east_of(double from_deg, double to_deg) {
  return std::fmod(to_deg - from_deg + 720.0, 360.0);
}

}  // namespace

double depth_m(const Cell& cell, double latitude_deg, double longitude_deg) {
  const auto& [south, west, north, east] = cell;
  const double across = kMetresPerDegree * std::cos(latitude_deg * std::numbers::pi / 180.0);
  const double height_m = kMetresPerDegree * std::min(latitude_deg - south, north - latitude_deg);
  const double width_deg = east - west >= 360.0 ? 360.0 : east_of(west, east);
  if (width_deg >= 360.0) return height_m;
  const double in_deg = east_of(west, longitude_deg);
  // Outside, the nearer of both borders counts.
  const double side_deg = in_deg <= width_deg ? std::min(in_deg, width_deg - in_deg)
                                              : -std::min(in_deg - width_deg, 360.0 - in_deg);
  return std::min(height_m, across * side_deg);
}

}  // namespace ols::bridge
