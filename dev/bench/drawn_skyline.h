// The true skyline of a simulated picture.
#pragma once

#include <vector>

#include "edge/skyline/skyline_finder.h"
#include "sim/world/panorama.h"

namespace ols::bench {

// The row [px] of the skyline in each strip of the picture that was drawn last. It is the mean over
// the strip's columns, because trees are narrower than a strip. A row may be outside of the
// picture.
inline std::vector<double> drawn_rows(const sim::Panorama& panorama) {
  const std::vector<float>& columns = panorama.ridge_rows_px();
  std::vector<double> rows;
  for (int strip = 0; strip < skyline::strips_of(static_cast<int>(columns.size())); ++strip) {
    double sum_px = 0.0;
    for (int i = 0; i < skyline::kStrip_px; ++i) {
      sum_px += columns[static_cast<std::size_t>(strip * skyline::kStrip_px + i)];
    }
    rows.push_back(sum_px / skyline::kStrip_px);
  }
  return rows;
}

}  // namespace ols::bench
