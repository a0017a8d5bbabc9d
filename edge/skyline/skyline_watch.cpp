#include "edge/skyline/skyline_watch.h"

#include <cmath>
#include <stdexcept>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::skyline {
namespace {

constexpr double kBegins = 4.0, kEnds = 3.0;  // sigmas

}  // namespace

void SkylineWatch::forget() {
  seen_.clear();
  heading_.reset();
  disagrees_ = false;
}

bool SkylineWatch::has_map(const Geodetic& camera) {
  if (place_ && (ecef_from_geodetic(*place_) - ecef_from_geodetic(camera)).norm() <= kMoved_m) {
    return map_.has_value();
  }
  forget();
  place_ = camera;
  map_.reset();
  why_none_.clear();
  try {
    map_.emplace(*surface_, camera, config_);
    place_sd_m_ = surface_->ground(camera.latitude_rad, camera.longitude_rad)->sd_m;
  } catch (const std::invalid_argument& reason) {
    why_none_ = reason.what();
  }
  return map_.has_value();
}

void SkylineWatch::look(const cv::Mat& gray, const video::CameraView& camera) {
  if (!has_map(geodetic_from_ecef(camera.centre_ecef))) return;
  const LocalFrame frame(map_->camera());
  const PictureView view{(camera.R_camera_ecef * frame.R_ecef_enu()).transpose(),
                         camera.intrinsics};
  seen_.add(directions(find_skyline(gray, expected_rows(*map_, view)), view));
  heading_ = skyline_heading(seen_.places(), *map_, place_sd_m_);
  if (!heading_) return;
  const double sigmas = std::abs(heading_->error_rad) / heading_->sd_rad;
  disagrees_ = sigmas > (disagrees_ ? kEnds : kBegins);
}

Alarm SkylineWatch::alarm() const {
  if (!why_none_.empty()) return alarm::skyline_not_compared(why_none_);
  if (!disagrees_) return {};
  return alarm::heading_disagrees_with_skyline(degrees(heading_->error_rad),
                                               degrees(heading_->sd_rad));
}

}  // namespace ols::skyline
