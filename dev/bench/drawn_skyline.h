// Where the skyline of a simulated picture truly is.
#pragma once

#include <vector>

#include "edge/skyline/skyline_finder.h"
#include "sim/world/panorama.h"

namespace ols::bench {

// The row of each strip in the picture that was drawn last, which may be outside of it [px]: the
// mean of its columns, because trees are narrower than a strip.
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
