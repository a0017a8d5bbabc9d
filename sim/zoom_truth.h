// A zoom lens as it really is, and what its calibration says of it. Pure.
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
  std::array<double, 2> range_mm{};  // widest, longest; 0: a fixed lens
  double travel_s = 3.0;             // from end to end at full speed
  double focal_sd = 0.002;           // 1-sigma of each calibrated focal length, of itself
  bool is_fixed() const { return range_mm[0] == 0.0 && range_mm[1] == 0.0; }
};

// Its keys in a scenario's [[station]].
std::vector<config::Row> zoom_rows(ZoomScenario& zoom);
// What is wrong with them; empty: nothing.
std::string zoom_problem(const ZoomScenario& zoom, bool overview);

class ZoomTruth {
 public:
  // `widest`: the camera at position 0.
  ZoomTruth(const CameraIntrinsics& widest, double ratio) : widest_(widest), ratio_(ratio) {}

  CameraIntrinsics camera_at(double position) const;

  // The calibration: nine points, each with an error of its own.
  std::vector<ZoomPoint> calibrated(double focal_sd, std::uint64_t seed) const;

 private:
  CameraIntrinsics widest_;
  double ratio_;
};

}  // namespace ols::sim
