// The true focal lengths of a simulated zoom lens, and its calibration with errors. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/zoom_table.h"

namespace ols::config {
struct Row;
}
namespace ols::sim {

struct ZoomScenario {
  // Shortest and longest focal length; both 0: a lens without zoom.
  std::array<double, 2> range_mm{};
  double travel_s = 3.0;    // from end to end at full speed
  double focal_sd = 0.002;  // 1-sigma of each calibrated focal length, relative
  bool is_fixed() const { return range_mm[0] == 0.0 && range_mm[1] == 0.0; }
};

// The keys for the zoom lens in a scenario's [[station]].
std::vector<config::Row> zoom_rows(ZoomScenario& zoom);
// What is wrong with these keys; empty: nothing.
std::string zoom_problem(const ZoomScenario& zoom, bool overview);

class ZoomTruth {
 public:
  // `widest`: the camera at zoom position 0. `ratio`: longest over shortest focal length.
  ZoomTruth(const CameraIntrinsics& widest, double ratio) : widest_(widest), ratio_(ratio) {}

  CameraIntrinsics camera_at(double position) const;

  // The calibration: nine points of the zoom's travel. Each point's focal length and optical centre
  // have errors of their own.
  std::vector<ZoomPoint> calibrated(double focal_sd, std::uint64_t seed) const;

 private:
  CameraIntrinsics widest_;
  double ratio_;
};

}  // namespace ols::sim
