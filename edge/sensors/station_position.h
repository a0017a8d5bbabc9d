// The position of a station: chooses the GNSS fixes that are used, and averages them. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/sensors/constant_estimator.h"
#include "edge/sensors/persisted_pose.h"
#include "edge/sensors/pose_estimator.h"

namespace ols::sensors {

class StationPosition {
 public:
  explicit StationPosition(const PoseEstimator::Config& config);
  // `age_s`: time since its measurement.
  void resume(const PersistedPose::Position& known, double now_s, double age_s);
  // Whether the position was measured, or confirmed by a sensor, since the start.
  bool is_from_sensor() const;
  void add(const GnssReading& reading);
  void fill(StationPose& pose, double now_s) const;
  void add_alarms(std::vector<Alarm>& alarms, double now_s) const;

 private:
  bool is_lost(double now_s) const;
  bool is_inconsistent(double now_s) const;
  Alarm disagreement(double now_s) const;

  PoseEstimator::Config config_;
  // Origin: the survey or, if there is none, the first antenna position.
  std::optional<LocalFrame> frame_;
  std::optional<ConstantEstimator<3>> place_;  // antenna position, east-north-up in frame_ [m]
  std::optional<GnssReading> last_;
  double known_s_ = 0.0;  // time at which the resumed position was measured
};

}  // namespace ols::sensors
