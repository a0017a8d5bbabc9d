// The position part of the pose estimator: chooses the usable GNSS fixes and averages them. Pure.
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
  // Resumes a persisted position. `age_s`: time since its measurement.
  void resume(const PersistedPose::Position& known, double now_s, double age_s);
  // Whether a sensor has measured or confirmed the position since the start; false if it is
  // surveyed.
  bool is_from_sensor() const;
  void add(const GnssReading& reading);
  void fill(StationPose& pose, double now_s) const;
  void add_alarms(std::vector<Alarm>& alarms, double now_s) const;

 private:
  bool is_lost(double now_s) const;
  bool is_inconsistent(double now_s) const;
  Alarm disagreement(double now_s) const;

  PoseEstimator::Config config_;
  // Origin: the surveyed position; otherwise the resumed one; otherwise the first position of the
  // antenna.
  std::optional<LocalFrame> frame_;
  // Position of the antenna, east-north-up in frame_ [m].
  std::optional<ConstantEstimator<3>> place_;
  std::optional<GnssReading> last_;
  double known_s_ = 0.0;  // time at which the resumed position was measured
};

}  // namespace ols::sensors
