// Where rays of different stations meet: what a new track may be tried from. Pure.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "central/filter/bias_model.h"
#include "central/measurement/ray.h"
#include "central/tracking/unassociated_bearings.h"

namespace ols::fusion {

struct MeetingConfig {
  double pair_s = 0.1;         // the two rays are not further apart in time
  double rate_sd_rad_s = 0.5;  // angular rate that a target may have, 1-sigma
  double miss_sigma = 4.0;     // greatest miss of two rays
};

struct RayMeeting {
  Eigen::Vector3d p_ecef;
  double range_m = 0.0;
  std::string first, second;  // the stations whose rays meet
  double miss = 0.0;          // distance of the rays over the greatest one
  int support = 0;            // other stations that look there
};

class RayMeetings {
 public:
  RayMeetings(const MeetingConfig& config, double max_range_m)
      : config_(config), max_range_m_(max_range_m) {}

  // Where a ray meets those of other stations; where more of the others pass by, first.
  // failure: what it does with the last one that it does not meet.
  std::vector<RayMeeting> of(const BearingMeasurement& sighting,
                             const UnassociatedBearings& bearings, const BiasModel& errors,
                             Solution& failure) const;
  // How far a target may have gone on, generously.
  double moved_rad(double dt_s) const;
  const MeetingConfig& config() const { return config_; }

 private:
  // A ray, and what a quick look at it needs.
  struct LookedAt {
    const BearingMeasurement& sighting;
    const BearingSummary& look;
  };
  Solution meet(const LookedAt& a, const LookedAt& b, const BiasModel& errors,
                RayMeeting& meeting) const;
  std::ptrdiff_t nearest(const UnassociatedBearings::Station& own, const BearingMeasurement& to,
                         const RayMeeting* meeting, const BiasModel& errors) const;
  double gate_rad(const BearingMeasurement& sighting, double dt_s, double range_m,
                  const BiasModel& errors) const;

  MeetingConfig config_;
  double max_range_m_;
};

}  // namespace ols::fusion
