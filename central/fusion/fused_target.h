// The fusion's output: targets, and lines of sight where there is no position.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/bearing_check.h"
#include "central/estimators/estimator.h"
#include "central/fusion/slew_planner.h"
#include "central/tracking/track.h"

namespace ols::fusion {

// A station that alone has a target in view: the line on which the target lies.
struct BearingOnly {
  std::string station;
  std::int64_t track_id = 0;  // the station's own
  LineOfSight sight;          // at the epoch
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
};

struct FusedTarget {
  std::int64_t utime_us = 0;   // the epoch
  std::int64_t target_id = 0;  // 0: no object yet. A bearing-only track's id passes to its target
  TrackState state = TrackState::kTentative;
  std::string estimator;  // its name
  Estimate estimate;
  std::vector<ContributingStation> stations;  // in the order of their ids
  std::optional<BearingOnly> bearing_only;    // instead of a position
};

struct FusionOutput {
  BearingRefusal refusal = BearingRefusal::kNone;  // the fate of the bearing
  // Each confirmed object of one epoch; without any, one target that states why. Also the
  // bearing-only tracks (kBearingOnly). With many objects, a part; the next bearings bring the rest
  // of the epoch, in the order of ids, bearing-only tracks last.
  std::vector<FusedTarget> targets;
  std::vector<FusedTarget> targets_paper;  // the paper's estimate of the same objects
  std::vector<Slew> slews;
};

}  // namespace ols::fusion
