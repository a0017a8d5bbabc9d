// What comes out of the fusion: targets, and lines of sight where there is no position.
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

// A station that has a target in view which no other one sees: where it is known to lie.
struct BearingOnly {
  std::string station;
  std::int64_t track_id = 0;  // the station's own
  LineOfSight sight;          // at the epoch
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
};

struct FusedTarget {
  std::int64_t utime_us = 0;   // the epoch
  std::int64_t target_id = 0;  // 0: no object yet. A line's becomes that of its position
  TrackState state = TrackState::kTentative;
  std::string estimator;  // its name
  Estimate estimate;
  std::vector<ContributingStation> stations;  // in the order of their ids
  std::optional<BearingOnly> bearing_only;    // instead of a position
};

struct FusionOutput {
  BearingRefusal refusal = BearingRefusal::kNone;  // what became of the bearing
  // Of one epoch: each confirmed object; where there is none, what there is in place of it; and the
  // lines of stations that follow what is no target (kBearingOnly). Of many, some; the next
  // bearings bring the others of the same epoch, in the order of their ids, the lines last.
  std::vector<FusedTarget> targets;
  std::vector<FusedTarget> targets_paper;  // the paper's estimate of the same objects
  std::vector<Slew> slews;
};

}  // namespace ols::fusion
