// The data that a target's filter keeps about a contributing station. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "central/filter/coloured_noise.h"
#include "central/measurement/activity.h"
#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

struct FilterStation {
  std::string station;
  LineOfSight sight;                                         // its last bearing
  Eigen::Matrix3d R_ecef_enu = Eigen::Matrix3d::Identity();  // at the origin of `sight`
  Activity last_used, last_offered;
  int used = 0;      // number of used bearings
  int rejected = 0;  // number of consecutive rejections since the last used bearing
  // If one of these ids changes, the station has a new bias.
  std::int64_t calibration_id = 0, track_id = 0;
  double weight = 0.0;             // of the last bearing; 0 if it was rejected
  double clock_sd_s = 0.0;         // 1-sigma of the clock, as learnt from the bearings
  double stated_clock_sd_s = 0.0;  // 1-sigma of the clock, as stated by the station
  double mean_nis = 2.0;           // recent mean over the used bearings; 2 is ideal
  ColouredNoise noise{};

  // Takes note of a bearing that was used, with its weight.
  void note_use(const BearingMeasurement& measurement, double nis, double used_weight);
};

// Whether the residuals can distinguish this station's errors from the target's motion. True if the
// station declares a bias. Otherwise true only if more than two stations deliver: the residuals of
// two stations have one dimension, but their biases and clocks have six.
bool is_redundant(const std::vector<FilterStation>& stations, const FilterStation& entry);

}  // namespace ols::fusion
