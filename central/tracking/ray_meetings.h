// The points where rays of different stations intersect: the hypotheses for track initiation. Pure.
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
  double pair_s = 0.1;         // largest time between the two rays
  double rate_sd_rad_s = 0.5;  // 1-sigma of a target's possible angular rate
  double miss_sigma = 4.0;     // largest distance between two rays, in sigmas
};

struct RayMeeting {
  Eigen::Vector3d p_ecef;
  double range_m = 0.0;
  std::string first, second;  // the stations whose rays intersect
  double miss = 0.0;          // distance between the rays, relative to the largest allowed
  int support = 0;            // number of other stations with a bearing towards the point
};

class RayMeetings {
 public:
  RayMeetings(const MeetingConfig& config, double max_range_m)
      : config_(config), max_range_m_(max_range_m) {}

  // The points where this bearing's ray intersects rays of other stations, best supported first.
  // failure: why the ray does not intersect the last ray with which it was compared.
  std::vector<RayMeeting> of(const BearingMeasurement& measurement,
                             const UnassociatedBearings& bearings, const BiasModel& errors,
                             Solution& failure) const;
  // Whether two bearings may belong to one object.
  bool may_meet(const BearingMeasurement& a, const BearingMeasurement& b,
                const BiasModel& errors) const;
  // An upper bound of the angle by which a target moves in this time; generous.
  double moved_rad(double dt_s) const;
  const MeetingConfig& config() const { return config_; }

 private:
  // A bearing, and its summary for a quick check.
  struct LookedAt {
    const BearingMeasurement& measurement;
    const BearingSummary& look;
  };
  Solution meet(const LookedAt& a, const LookedAt& b, const BiasModel& errors,
                RayMeeting& meeting) const;
  std::ptrdiff_t nearest(const UnassociatedBearings::Station& own, const BearingMeasurement& to,
                         const RayMeeting* meeting, const BiasModel& errors) const;
  double gate_rad(const BearingMeasurement& measurement, double dt_s, double range_m,
                  const BiasModel& errors) const;

  MeetingConfig config_;
  double max_range_m_;
};

}  // namespace ols::fusion
