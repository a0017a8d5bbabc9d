// The output files of a lockstep run: fixes with the truth, and a summary.
#pragma once

#include <string>

#include "sim/lockstep/bound.h"
#include "sim/lockstep/lockstep.h"

namespace ols::sim {

struct EstimatorSummary {
  int fixes = 0;
  double rmse_m = 0.0;
  double predicted_rmse_m = 0.0;  // root of the mean trace of the published covariances
  Eigen::Vector3d nees_axis = Eigen::Vector3d::Zero();  // mean error^2 / variance: east, north, up
  double nees = 0.0;                                    // mean of e' C^-1 e / 3
  double latency_median_s = 0.0, latency_p95_s = 0.0;  // from the epoch of a fix to its publication
};

struct BoundSummary {
  double crb_rmse_m = 0.0;  // root of the bound's mean trace, with one exposure of each station
  double crb_horizontal_rmse_m = 0.0;  // the same for the horizontal position only
  double crb_floor_rmse_m = 0.0;       // with all white noise averaged away
};

EstimatorSummary summarise(const std::vector<Fix>& fixes);
// The bound for every `stride`-th of these fixes, at the epoch and with the stations of that fix.
BoundSummary summarise_bound(const World& world, const std::vector<Fix>& fixes,
                             const MeasurementNoise& noise, std::size_t stride = 10);

// Errors of the measured pixels, per coordinate, in all frames in which a station tracks.
// `mean_px`: root mean square of the stations' mean errors. `white_sd_px`: standard deviation about
// each station's mean.
struct PixelSummary {
  double white_sd_px = 0.0;
  double mean_px = 0.0;
};
PixelSummary summarise_pixels(const std::vector<StationRecord>& stations);

// Writes truth.csv, fixes.csv, fixes_paper.csv, frames.csv, slews.csv, counters.csv, summary.json
// and sightings.lcm into `folder`, which it creates.
void write_report(const World& world, const LockstepResult& result, double duration_s,
                  const std::string& folder);

}  // namespace ols::sim
