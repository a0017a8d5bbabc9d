#include "wire/skyline.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::wire {
namespace {

bool within(double value, double least, double most) { return value >= least && value <= most; }

bool is_column(const ols_msg::skyline_t& message, std::size_t i) {
  constexpr double kFarthest_m = 1e6;
  return message.column[i] >= 0 && message.column[i] / kSkylineSectorColumns == message.sector &&
         (i == 0 || message.column[i] > message.column[i - 1]) &&
         within(message.elevation_rad[i], -kPi / 2.0, kPi / 2.0) && message.sd_rad[i] > 0.0F &&
         message.sd_rad[i] < kPi && within(message.hides_from_m[i], 0.0, kFarthest_m);
}

}  // namespace

bool is_skyline(const ols_msg::skyline_t& message) {
  if (message.sector < 0 || message.sector >= kSkylineSectors ||
      message.column.size() > kSkylineSectorColumns ||
      !std::ranges::all_of(message.camera_ecef_m, [](double m) { return std::isfinite(m); })) {
    return false;
  }
  for (std::size_t i = 0; i < message.column.size(); ++i) {
    if (!is_column(message, i)) return false;
  }
  return true;
}

}  // namespace ols::wire
