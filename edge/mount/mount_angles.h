// The mount's angles at an exposure. Computes them from the mount's reports alone (AngleHistory)
// and from reports and pictures (CarriedAngles). Uses the angles from reports and pictures if they
// are more accurate than those from the reports alone, and do not contradict the reports. Pure.
#pragma once

#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/mount/carried_angles.h"

namespace ols::mount {

class MountAngles {
 public:
  explicit MountAngles(const AngleHistory::Config& config) : reported_(config), carried_(config) {}

  // Call each of the two functions in order of time. Returns false and drops the report if it is
  // out of order.
  bool add(const AngleSample& sample);
  void add(const SeenTurn& turn) { carried_.add(turn); }
  void clear();

  // The angles at an instant. `stamp_sd_s`: 1-sigma of `time_s`, if it is a picture's stamp; the
  // covariance includes its effect. nullopt if neither source covers the instant.
  std::optional<AngleAt> at(double time_s, double stamp_sd_s = 0.0) const;
  // The angles from the reports alone.
  const AngleHistory& reported() const { return reported_; }

 private:
  AngleHistory reported_;
  CarriedAngles carried_;
};

}  // namespace ols::mount
