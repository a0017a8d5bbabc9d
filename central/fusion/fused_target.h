// The fusion's output: targets, and lines of sight for objects without a position.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/bearing_check.h"
#include "central/estimators/estimator.h"
#include "central/fusion/occlusion_schedule.h"
#include "central/fusion/slew_planner.h"
#include "central/ground/above_ground.h"
#include "central/tracking/target_appearance.h"
#include "central/tracking/track.h"

namespace ols::fusion {

// The line of sight of the only station that sees an object.
struct BearingOnly {
  std::string station;
  std::int64_t track_id = 0;  // the station's own id
  LineOfSight sight;          // at the epoch
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
};

struct FusedTarget {
  std::int64_t utime_us = 0;  // the epoch
  // 0 if the object has no identity yet. A bearing-only track that becomes a target keeps its id.
  std::int64_t target_id = 0;
  TrackState state = TrackState::kTentative;
  std::string estimator;  // name of the estimator
  Estimate estimate;
  std::vector<ContributingStation> stations;  // sorted by id
  std::optional<BearingOnly> bearing_only;    // set if there is no position
  Appearance appearance;
  std::optional<HeightAboveGround> above_ground;  // set if position and ground are known
};

struct FusionOutput {
  BearingRefusal refusal = BearingRefusal::kNone;  // why the bearing was not used
  // All confirmed objects of one epoch, then the bearing-only tracks (kBearingOnly), each group
  // sorted by id. If there are none: one entry without a target, whose estimate states the reason.
  // With many objects, the vector contains only a part of the epoch; the rest follows with the next
  // bearings.
  std::vector<FusedTarget> targets;
  std::vector<FusedTarget> targets_paper;  // the paper's estimates of the same objects
  std::vector<Slew> slews;
  std::vector<OcclusionNotice> occlusions;
};

}  // namespace ols::fusion
