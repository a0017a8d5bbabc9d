// The mount's angles at the instants of pictures, carried from its reports by the turns that the
// pictures show. Reports may come late and rarely. Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/mount/carried_axis.h"
#include "edge/mount/seen_path.h"

namespace ols::mount {

class CarriedAngles {
 public:
  // Neither reports nor pictures older than `span_s` are used.
  explicit CarriedAngles(const AngleHistory::Config& config)
      : config_(config), path_(config.span_s) {}

  // Each in order of time.
  void add(const AngleSample& sample);
  void add(const SeenTurn& turn);
  void clear();

  // The angles in the picture that is stamped with this instant. The error of the pictures' stamps
  // is part of the covariance; it is learnt together with the delay of the reports. nullopt without
  // pictures of that time, and when the newest report is older than the span.
  std::optional<AngleAt> at(double time_s) const;

 private:
  void use_reports();
  CarriedAxis::Report report(const AngleSample& sample, double PanTilt::*axis,
                             double time_sd_s) const;

  AngleHistory::Config config_;
  SeenPath path_;
  CarriedAxis pan_, tilt_;
  double stamp_sd_s_ = 0.0;          // of the pictures
  std::deque<AngleSample> waiting_;  // reports later than the newest picture
};

}  // namespace ols::mount
