// The camera behind a zoom lens at any recent instant: what the lens said of its zoom, and what a
// calibration says that means. Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/lens/lens_types.h"
#include "geometry/zoom_table.h"

namespace ols::lens {

class ZoomLens {
 public:
  // `position_sd`: 1-sigma of a position that the lens says, its slack included.
  ZoomLens(const ZoomTable& table, double position_sd) : table_(table), position_sd_(position_sd) {}

  // In time order; another one is dropped.
  void add(const ZoomSample& sample);

  // Nothing: the lens has said nothing about that time. While the zoom moves, its deviation grows
  // with its speed and with how far from a sample the instant is.
  std::optional<ZoomPoint> at(double time_s) const;
  std::optional<ZoomPoint> newest() const;

  static constexpr double kMemory_s = 3.0;
  static constexpr double kSilent_s = 1.0;  // the newest position holds for so long

 private:
  ZoomTable table_;
  double position_sd_;
  std::deque<ZoomSample> samples_;
};

}  // namespace ols::lens
