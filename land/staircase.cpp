#include "land/staircase.h"

#include <algorithm>
#include <limits>

namespace ols::land {

namespace {
constexpr double kTolerance = 0.25;  // of a cell
constexpr double kAny = std::numeric_limits<double>::infinity();
}  // namespace

void StaircaseBuilder::keep(const Step& step) {
  steps_.push_back(step);
  anchor_ = step;
  candidate_.reset();
  least_slope_ = -kAny;
  greatest_slope_ = kAny;
}

void StaircaseBuilder::add(double elevation_rad, double distance_m, double elevation_sd_rad,
                           double cell_m, bool corner) {
  const Step step{static_cast<float>(elevation_rad), static_cast<float>(distance_m),
                  static_cast<float>(elevation_sd_rad)};
  if (!anchor_) return keep(step);
  const auto from_anchor = [&](double distance) {
    const double run_rad = double{step.elevation_rad} - anchor_->elevation_rad;
    return run_rad > 0.0 ? (distance - anchor_->distance_m) / run_rad : kAny;
  };
  const double slope = from_anchor(step.distance_m);
  if (candidate_ && !(slope >= least_slope_ && slope <= greatest_slope_ && slope < kAny)) {
    keep(*candidate_);
  }
  if (corner) {
    keep(step);
    return;
  }
  candidate_ = step;
  least_slope_ = std::max(least_slope_, from_anchor(step.distance_m - kTolerance * cell_m));
  greatest_slope_ = std::min(greatest_slope_, from_anchor(step.distance_m + kTolerance * cell_m));
}

void StaircaseBuilder::end() {
  if (candidate_) keep(*candidate_);
  anchor_.reset();
}

}  // namespace ols::land
