// Gives the camera's focal length and principal point at any recent instant, from the reported zoom
// and the lens's calibration. Pure.
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

  // Call in order of time; a sample out of order is dropped.
  void add(const ZoomSample& sample);

  // nullopt if there is no report near that time. While the zoom moves, the deviation grows with
  // its speed and with the time from the nearest sample.
  std::optional<ZoomPoint> at(double time_s) const;
  std::optional<ZoomPoint> newest() const;
  // Whether the zoom stood still at that time: the reports before and after it are the same but for
  // the error of a position. nullopt if one of them is missing.
  std::optional<bool> rests_at(double time_s) const;

  static constexpr double kMemory_s = 3.0;
  static constexpr double kSilent_s = 1.0;  // how long the newest position remains valid

 private:
  ZoomTable table_;
  double position_sd_;
  std::deque<ZoomSample> samples_;
};

}  // namespace ols::lens
