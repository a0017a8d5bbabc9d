// The part of the pose keeper that knows the tilt. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/sensors/pose_keeper.h"
#include "edge/sensors/remembered_pose.h"
#include "edge/sensors/standing_value.h"

namespace ols {

class KeptTilt {
 public:
  explicit KeptTilt(const PoseKeeper::Config& config);
  // `age_s`: since it was so.
  void resume(const RememberedPose::Tilt& known, double now_s, double age_s);
  // Told, or confirmed, by a sensor since the start.
  bool is_from_sensor() const;
  void add(const TiltReading& reading);
  void fill(StationPose& pose, double now_s) const;
  void add_alarms(std::vector<std::string>& alarms, double now_s) const;

 private:
  bool is_stuck(double time_s) const;
  bool is_disbelieved(double now_s) const;
  bool is_lost(double now_s) const;

  PoseKeeper::Config config_;
  StandingValue<2> tilt_;  // x, y [rad]
  std::optional<TiltReading> last_;
  double changed_s_ = 0.0;  // last time that a digit changed
  double known_s_ = 0.0;    // when what was resumed was so
};

}  // namespace ols
