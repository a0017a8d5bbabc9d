// The part of the pose keeper that knows the position. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/sensors/pose_keeper.h"
#include "edge/sensors/remembered_pose.h"
#include "edge/sensors/standing_value.h"

namespace ols {

class KeptPosition {
 public:
  explicit KeptPosition(const PoseKeeper::Config& config);
  // `age_s`: since it was so.
  void resume(const RememberedPose::Position& known, double now_s, double age_s);
  // Told, or confirmed, by a sensor since the start.
  bool is_from_sensor() const;
  void add(const GnssReading& reading);
  void fill(StationPose& pose, double now_s) const;
  void add_alarms(std::vector<std::string>& alarms, double now_s) const;

 private:
  bool is_lost(double now_s) const;
  bool is_disbelieved(double now_s) const;
  std::string disagreement(double now_s) const;

  PoseKeeper::Config config_;
  std::optional<LocalFrame> frame_;        // of the survey, else of the first antenna position
  std::optional<StandingValue<3>> place_;  // of the antenna, east-north-up in frame_ [m]
  std::optional<GnssReading> last_;
  double known_s_ = 0.0;  // when what was resumed was so
};

}  // namespace ols
