#include "geometry/zoom_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ols {
namespace {

void check(const std::vector<ZoomPoint>& points) {
  if (points.size() < 2) throw std::invalid_argument("needs at least two points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fail = [i](const std::string& what) {
      throw std::invalid_argument("point " + std::to_string(i + 1) + ": " + what);
    };
    const ZoomPoint& point = points[i];
    if (!(point.position >= 0.0 && point.position <= 1.0)) fail("position is outside 0 .. 1");
    if (!(point.camera.fx_px > 0.0 && point.camera.fy_px > 0.0)) {
      fail("the focal length must be positive");
    }
    if (i == 0) continue;
    if (!(point.position > points[i - 1].position)) fail("positions must rise");
    if (!(point.camera.fx_px > points[i - 1].camera.fx_px)) fail("focal lengths must rise");
  }
}

double between(double a, double b, double share) { return a + share * (b - a); }

double log_between(double a, double b, double share) {
  return std::exp(between(std::log(a), std::log(b), share));
}

CameraIntrinsics between(const CameraIntrinsics& a, const CameraIntrinsics& b, double share) {
  CameraIntrinsics camera = a;
  camera.fx_px = log_between(a.fx_px, b.fx_px, share);
  camera.fy_px = log_between(a.fy_px, b.fy_px, share);
  using Field = double CameraIntrinsics::*;
  for (const Field field :
       {&CameraIntrinsics::cx_px, &CameraIntrinsics::cy_px, &CameraIntrinsics::skew,
        &CameraIntrinsics::k1, &CameraIntrinsics::k2, &CameraIntrinsics::p1, &CameraIntrinsics::p2,
        &CameraIntrinsics::k3, &CameraIntrinsics::k4}) {
    camera.*field = between(a.*field, b.*field, share);
  }
  return camera;
}

}  // namespace

ZoomTable::ZoomTable(std::vector<ZoomPoint> points) : points_(std::move(points)) { check(points_); }

// Of the logarithm of the focal length.
double ZoomTable::slope(std::size_t interval) const {
  const ZoomPoint &a = points_[interval], &b = points_[interval + 1];
  return std::log(b.camera.fx_px / a.camera.fx_px) / (b.position - a.position);
}

// By how much the slope changes from the interval to its neighbours, at most.
double ZoomTable::bend(std::size_t interval) const {
  const double own = slope(interval);
  const double before = interval > 0 ? std::abs(own - slope(interval - 1)) : 0.0;
  const double after = interval + 2 < points_.size() ? std::abs(slope(interval + 1) - own) : 0.0;
  return std::max(before, after);
}

ZoomPoint ZoomTable::at(double position, double position_sd) const {
  const double inside = std::clamp(position, points_.front().position, points_.back().position);
  const auto after = std::ranges::find_if(points_.begin() + 1, points_.end() - 1,
                                          [&](const auto& p) { return p.position >= inside; });
  const auto interval = static_cast<std::size_t>(after - points_.begin()) - 1;
  const ZoomPoint &a = points_[interval], &b = points_[interval + 1];
  const double width = b.position - a.position;
  const double share = (inside - a.position) / width;
  ZoomPoint point;
  point.position = inside;
  point.camera = between(a.camera, b.camera, share);
  point.centre_sd_px = std::max(a.centre_sd_px, b.centre_sd_px);
  // The error of a linear interpolation: half of the second derivative times the distances to both
  // ends; the slopes of neighbouring intervals of this width differ by the derivative times it.
  const double bent = 0.5 * bend(interval) * share * (1.0 - share) * width;
  const double ratio = std::max(a.focal_sd_px / a.camera.fx_px, b.focal_sd_px / b.camera.fx_px);
  point.focal_sd_px = point.camera.fx_px * std::hypot(ratio, bent, slope(interval) * position_sd);
  return point;
}

}  // namespace ols
