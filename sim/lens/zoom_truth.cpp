#include "sim/lens/zoom_truth.h"

#include <cmath>
#include <random>

#include "base/config/config_section.h"

namespace ols::sim {
namespace {

// How much a real lens' logarithm of the focal length bends over its travel.
constexpr double kBend = 0.2;
constexpr int kPoints = 9;

}  // namespace

std::vector<config::Row> zoom_rows(ZoomScenario& zoom) {
  return {config::numbers("zoom_mm", zoom.range_mm, {0, 2000}, "mm",
                          "Focal lengths of an overview station's lens: widest, longest; 0: the "
                          "camera's."),
          config::number("zoom_travel_s", zoom.travel_s, {0.1, 60}, "s",
                         "Of the zoom, from end to end."),
          config::number("zoom_focal_sd", zoom.focal_sd, {0, 0.2}, "",
                         "1-sigma of its calibrated focal lengths, of themselves.")};
}

std::string zoom_problem(const ZoomScenario& zoom, bool overview) {
  if (zoom.is_fixed()) return "";
  if (!overview) return "needs kind = \"overview\"";
  const bool is_range = zoom.range_mm[0] > 0.0 && zoom.range_mm[1] > zoom.range_mm[0];
  return is_range ? "" : "must be the widest and a longer focal length";
}

CameraIntrinsics ZoomTruth::camera_at(double position) const {
  CameraIntrinsics camera = widest_;
  const double bent = position + kBend * position * (1.0 - position);
  camera.fx_px = widest_.fx_px * std::pow(ratio_, bent);
  camera.fy_px = widest_.fy_px * std::pow(ratio_, bent);
  return camera;
}

std::vector<ZoomPoint> ZoomTruth::calibrated(double focal_sd, std::uint64_t seed) const {
  constexpr double kCentreSd_px = 2.0;
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<ZoomPoint> points;
  for (int i = 0; i < kPoints; ++i) {
    ZoomPoint point;
    point.position = static_cast<double>(i) / (kPoints - 1);
    point.camera = camera_at(point.position);
    const double error = 1.0 + focal_sd * normal(generator);
    point.camera.fx_px *= error;
    point.camera.fy_px *= error;
    point.camera.cx_px += kCentreSd_px * normal(generator);
    point.camera.cy_px += kCentreSd_px * normal(generator);
    point.focal_sd_px = focal_sd * point.camera.fx_px;
    point.centre_sd_px = kCentreSd_px;
    points.push_back(point);
  }
  return points;
}

}  // namespace ols::sim
