// A straight line through points of which some belong to something else. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace ols::calibration {

struct LinePoints {
  std::vector<double> x, y;
};

// y = offset + slope (x - middle)
struct FittedLine {
  double offset = 0.0, slope = 0.0, middle = 0.0;
  double gyration_px = 0.0;  // root mean square of x - middle
  double rms_px = 0.0;       // of the points that count
  std::size_t columns = 0;   // so many points count
};

// Least squares without what is farther off than three deviations, which the median of the
// distances tells, beginning at `start`. Nothing where fewer than eight points are left.
std::optional<FittedLine> fit_line(const LinePoints& points, const FittedLine& start);

}  // namespace ols::calibration
