// Computes the camera's focal length and principal point at any recent instant, from reported zoom
// positions and the lens's calibration. Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/lens/lens_types.h"
#include "geometry/zoom_table.h"

namespace ols::lens {

class ZoomLens {
 public:
  // `position_sd`: 1-sigma of a reported position, including mechanical slack.
  ZoomLens(const ZoomTable& table, double position_sd) : table_(table), position_sd_(position_sd) {}

  // Adds a sample. Call in order of time; a sample that is not newer than the last one is dropped.
  void add(const ZoomSample& sample);

  // The calibrated values at `time_s`. nullopt if this is more than kSilent_s before the oldest or
  // after the newest sample. While the zoom moves, the 1-sigma of these values grows with the
  // zoom's speed, and with the error of the samples' times. Before the oldest or after the newest
  // sample, it also grows with the time from that sample.
  std::optional<ZoomPoint> at(double time_s) const;
  std::optional<ZoomPoint> newest() const;
  // Whether the zoom stood still at `time_s`: the samples just before and after differ by at most
  // position_sd. nullopt if one of them is missing, or if they are more than kSilent_s apart.
  std::optional<bool> rests_at(double time_s) const;

  static constexpr double kMemory_s = 3.0;
  static constexpr double kSilent_s = 1.0;  // how long the newest position remains valid

 private:
  ZoomTable table_;
  double position_sd_;
  std::deque<ZoomSample> samples_;
};

}  // namespace ols::lens
