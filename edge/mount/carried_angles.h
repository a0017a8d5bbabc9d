// Computes the mount's angles at the instants of pictures: a reported angle plus the mount's
// rotation since the report, which the pictures show. Reports may be late and rare. Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/mount/carried_axis.h"
#include "edge/mount/seen_path.h"

namespace ols::mount {

class CarriedAngles {
 public:
  // Reports and pictures older than config.span_s are not used.
  explicit CarriedAngles(const AngleHistory::Config& config)
      : config_(config), path_(config.span_s) {}

  // Call each of the two functions in order of time.
  void add(const AngleSample& sample);
  void add(const SeenTurn& turn);
  void clear();

  // The mount's angles at the exposure of the picture with the stamp `time_s`. The covariance
  // includes the error of the pictures' stamps, which is estimated together with the delay of the
  // reports. nullopt if there are no pictures of that time, or if the newest report is older than
  // config.span_s.
  std::optional<AngleAt> at(double time_s) const;

 private:
  void use_reports();
  CarriedAxis::Report report(const AngleSample& sample, double PanTilt::*axis,
                             double time_sd_s) const;

  AngleHistory::Config config_;
  SeenPath path_;
  CarriedAxis pan_, tilt_;
  double stamp_sd_s_ = 0.0;          // 1-sigma of the stamps of all pictures
  std::deque<AngleSample> waiting_;  // reports that are later than the newest picture
};

}  // namespace ols::mount
