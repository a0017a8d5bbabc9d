#include "calibration/pictures/line_fit.h"

#include <algorithm>
#include <cmath>

#include "geometry/median.h"

namespace ols::calibration {

std::optional<FittedLine> fit_line(const LinePoints& points, const FittedLine& start) {
  constexpr int kRounds = 6;
  constexpr double kFar = 3.0, kSigmaOfMedian = 1.4826, kLeast_px = 0.05;
  constexpr std::size_t kLeastColumns = 8;
  FittedLine line = start;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> off;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      off.push_back(std::abs(points.y[i] - line.offset - line.slope * (points.x[i] - line.middle)));
    }
    if (off.size() < kLeastColumns) return std::nullopt;
    const double limit = kFar * std::max(kLeast_px, kSigmaOfMedian * median(off));
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
    for (std::size_t i = 0; i < off.size(); ++i) {
      if (off[i] > limit) continue;
      n += 1.0;
      sx += points.x[i];
      sy += points.y[i];
    }
    if (n < static_cast<double>(kLeastColumns)) return std::nullopt;
    for (std::size_t i = 0; i < off.size(); ++i) {
      if (off[i] > limit) continue;
      const double dx = points.x[i] - sx / n, dy = points.y[i] - sy / n;
      sxx += dx * dx;
      sxy += dx * dy;
      syy += dy * dy;
    }
    line.middle = sx / n;
    line.offset = sy / n;
    line.slope = sxy / sxx;
    line.gyration_px = std::sqrt(sxx / n);
    line.rms_px = std::sqrt(std::max(0.0, syy - sxy * sxy / sxx) / n);
    line.columns = static_cast<std::size_t>(n);
  }
  return line;
}

}  // namespace ols::calibration
