#include "edge/frames/skyline_picture.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::station {
namespace {

// In the tenths of a second by which a time stamp may be wrong, it turns by some thousandths of a
// degree: less than any model of the land is good for.
constexpr double kAtRest_rad_s = radians(0.02);

bool is_at_rest(const UnitAngles& unit) {
  return std::abs(unit.rate.pan_rad) < kAtRest_rad_s &&
         std::abs(unit.rate.tilt_rad) < kAtRest_rad_s;
}

// The line of sight of the outermost pixel between an edge and the middle that has one: the image
// circle of a fisheye may be narrower than the picture.
std::optional<LineOfSight> outermost(const PointingModel& pointing, const UnitAngles& unit,
                                     PixelSight pixel, double edge_px, double middle_px) {
  constexpr int kSteps = 10;
  for (int step = 0; step <= kSteps; ++step) {
    pixel.pixel.x() = edge_px + step * (middle_px - edge_px) / kSteps;
    if (auto line = pointing.sight(pixel, unit)) return line;
  }
  return std::nullopt;
}

// The 1-sigma that the station states for the directions of this picture: at the left or right
// edge, where the lens errs most. False if it has no directions.
bool state_sigmas(const PointingModel& pointing, const UnitAngles& unit,
                  skyline::StatedPicture& picture) {
  const CameraIntrinsics& camera = picture.camera.intrinsics;
  PixelSight pixel;
  pixel.pixel.y() = camera.cy_px;
  pixel.angles_covariance_rad2 = unit.covariance;
  pixel.angles_systematic_rad2 = unit.lasting_covariance;
  bool any = false;
  for (const double edge_px : {0.0, camera.width_px - 1.0}) {
    const auto line = outermost(pointing, unit, pixel, edge_px, camera.cx_px);
    if (!line) continue;
    any = true;
    const Eigen::Vector2d sd_rad =
        (line->covariance_systematic + line->covariance_white).diagonal().cwiseSqrt();
    picture.azimuth_sd_rad =
        std::max(picture.azimuth_sd_rad, sd_rad.x() / std::cos(line->direction.elevation_rad));
    picture.elevation_sd_rad = std::max(picture.elevation_sd_rad, sd_rad.y());
  }
  return any;
}

}  // namespace

std::optional<skyline::StatedPicture> skyline_picture(const std::deque<camera::Frame>& frames,
                                                      const PointingModel& pointing) {
  if (pointing.pose().position_source == sensors::PoseSource::kNone) return std::nullopt;
  for (auto at = frames.rbegin(); at != frames.rend(); ++at) {
    const camera::Frame& frame = *at;
    const auto unit = pointing.angles_at(frame.mid_exposure_s, frame.stamp_sd_s);
    if (!unit || !unit->interpolated) continue;
    const auto zoom_rests = pointing.zoom_rests(frame.mid_exposure_s);
    if (!zoom_rests) continue;
    if (!is_at_rest(*unit) || !*zoom_rests) return std::nullopt;
    const auto camera = pointing.camera_at(*unit);
    if (!camera) return std::nullopt;
    skyline::StatedPicture picture{frame.mid_exposure_s, frame.gray, *camera};
    picture.position_sd_enu_m = pointing.pose().position_sd_enu_m;
    if (!state_sigmas(pointing, *unit, picture)) return std::nullopt;
    return picture;
  }
  return std::nullopt;
}

}  // namespace ols::station
