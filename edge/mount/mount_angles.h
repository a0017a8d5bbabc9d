// The mount's angles at an exposure: by its reports alone, or carried by the pictures if that is
// more accurate and does not contradict the reports. Pure.
#pragma once

#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/mount/carried_angles.h"

namespace ols::mount {

class MountAngles {
 public:
  explicit MountAngles(const AngleHistory::Config& config) : reported_(config), carried_(config) {}

  // Each in order of time. A report out of order is rejected.
  bool add(const AngleSample& sample);
  void add(const SeenTurn& turn) { carried_.add(turn); }
  void clear();

  // `stamp_sd_s`: 1-sigma of the instant, if this is a picture's stamp; the covariance includes it.
  // nullopt if neither covers the instant.
  std::optional<AngleAt> at(double time_s, double stamp_sd_s = 0.0) const;
  // By the reports alone.
  const AngleHistory& reported() const { return reported_; }

 private:
  AngleHistory reported_;
  CarriedAngles carried_;
};

}  // namespace ols::mount
