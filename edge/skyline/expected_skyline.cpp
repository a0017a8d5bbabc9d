#include "edge/skyline/expected_skyline.h"

#include <cmath>

#include "geometry/angles.h"

namespace ols::skyline {
namespace {

// A heading and a tilt that are wrong by as much are still found at once.
constexpr double kHeadingSd_rad = radians(0.3), kTiltSd_rad = radians(0.1);

std::optional<AzimuthElevation> direction_of(const PictureView& view, double x_px, double y_px) {
  const auto ray = unproject(view.camera, {x_px, y_px});
  if (!ray) return std::nullopt;
  return azimuth_elevation_from_enu(view.R_enu_cam * *ray);
}

double slope(const land::HorizonMap& map, double azimuth_rad, double elevation_rad) {
  constexpr double kStep_rad = radians(0.1);
  const auto beyond = map.skyline(azimuth_rad + kStep_rad);
  return beyond ? (beyond->elevation_rad - elevation_rad) / kStep_rad : 0.0;
}

std::optional<Row> expected_row(const land::HorizonMap& map, const PictureView& view, double x_px) {
  constexpr int kIterations = 8;
  constexpr double kExact_px = 0.02;
  const double height_px = view.camera.height_px;
  double y_px = view.camera.cy_px;
  for (int i = 0; i < kIterations; ++i) {
    const auto direction = direction_of(view, x_px, y_px);
    if (!direction) return std::nullopt;
    const auto skyline = map.skyline(direction->azimuth_rad);
    if (!skyline) return std::nullopt;
    const double down_px = (direction->elevation_rad - skyline->elevation_rad) * view.camera.fy_px;
    y_px += down_px;
    if (!(y_px > -height_px && y_px < 2.0 * height_px)) return std::nullopt;
    if (std::abs(down_px) > kExact_px) continue;
    const double across =
        slope(map, direction->azimuth_rad, skyline->elevation_rad) * kHeadingSd_rad;
    return Row{y_px,
               view.camera.fy_px * std::hypot(skyline->elevation_sd_rad, kTiltSd_rad, across)};
  }
  return std::nullopt;
}

}  // namespace

Rows expected_rows(const land::HorizonMap& map, const PictureView& view) {
  Rows rows;
  for (int strip = 0; strip < strips_of(view.camera.width_px); ++strip) {
    rows.push_back(expected_row(map, view, strip_x_px(strip)));
  }
  return rows;
}

std::vector<SkylinePoint> directions(const Rows& found, const PictureView& view) {
  std::vector<SkylinePoint> points;
  for (std::size_t strip = 0; strip < found.size(); ++strip) {
    if (!found[strip]) continue;
    const auto direction =
        direction_of(view, strip_x_px(static_cast<int>(strip)), found[strip]->at_px);
    if (direction) points.push_back({*direction, found[strip]->sd_px / view.camera.fy_px});
  }
  return points;
}

}  // namespace ols::skyline
