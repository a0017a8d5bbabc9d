// The tilt part of the pose estimator. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/sensors/constant_estimator.h"
#include "edge/sensors/persisted_pose.h"
#include "edge/sensors/pose_estimator.h"

namespace ols::sensors {

class StationTilt {
 public:
  explicit StationTilt(const PoseEstimator::Config& config);
  // Resumes a persisted tilt. `age_s`: time since its measurement.
  void resume(const PersistedPose::Tilt& known, double now_s, double age_s);
  // Whether a sensor has measured or confirmed the tilt since the start; false if it is surveyed.
  bool is_from_sensor() const;
  void add(const TiltReading& reading);
  void fill(StationPose& pose, double now_s) const;
  void add_alarms(std::vector<Alarm>& alarms, double now_s) const;

 private:
  bool is_stuck(double time_s) const;
  bool is_inconsistent(double now_s) const;
  bool is_lost(double now_s) const;

  PoseEstimator::Config config_;
  ConstantEstimator<2> tilt_;  // x, y [rad]
  std::optional<TiltReading> last_;
  double changed_s_ = 0.0;  // time at which a digit of the readings last changed
  double known_s_ = 0.0;    // time at which the resumed tilt was measured
};

}  // namespace ols::sensors
