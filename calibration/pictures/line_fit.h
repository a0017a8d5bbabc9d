// Fits a straight line through points, some of which may not belong to it. Pure.
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
  double rms_px = 0.0;       // RMS distance of the used points from the line
  std::size_t columns = 0;   // number of used points
};

// Least squares, starting from `start`. Points more than three sigmas off the line are left out;
// sigma is estimated from the median of the distances. nullopt if fewer than eight points remain.
std::optional<FittedLine> fit_line(const LinePoints& points, const FittedLine& start);

}  // namespace ols::calibration
