#include "edge/calibration/unit_count.h"

#include <cmath>

#include "geometry/angles.h"

namespace ols::station {

double count_of(const AxisModel& axis) {
  return 2.0 * kPi / static_cast<double>(axis.counts_per_turn);
}

bool is_count_of(const AxisModel& axis, double printed_rad) {
  constexpr double kRounding = 1e-4;  // of a printed size of six digits; step modes differ by 2
  return std::abs(printed_rad / count_of(axis) - 1.0) < kRounding;
}

}  // namespace ols::station
