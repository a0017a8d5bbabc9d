#include "edge/skyline/expected_skyline.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"
#include "land/column_march.h"

namespace ols::skyline {
namespace {

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
    const double across = slope(map, direction->azimuth_rad, skyline->elevation_rad) *
                          std::hypot(kHeadingSd_rad, view.azimuth_sd_rad);
    const double up = std::hypot(kTiltSd_rad, view.elevation_sd_rad);
    const double sd_rad = uncertain_skyline(map, direction->azimuth_rad)->elevation_sd_rad;
    return Row{y_px, view.camera.fy_px * std::hypot(sd_rad, up, across)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<land::Skyline> uncertain_skyline(const land::HorizonMap& map, double azimuth_rad) {
  // Nearer to the camera the land errs as at the camera, which sees over it.
  constexpr double kNearest_m = land::kLowered_m, kSigmas = 2.0;
  auto skyline = map.skyline(azimuth_rad);
  if (!skyline) return std::nullopt;
  for (double at_m = 0.5 * skyline->distance_m; at_m > kNearest_m; at_m *= 0.5) {
    const auto nearer = map.highest_before(azimuth_rad, at_m);
    if (!nearer) break;
    const double sd_rad = nearer->elevation_sd_rad;
    if (skyline->elevation_rad - nearer->elevation_rad > kSigmas * sd_rad) continue;
    skyline->elevation_sd_rad = std::max(skyline->elevation_sd_rad, sd_rad);
  }
  return skyline;
}

Rows expected_rows(const land::HorizonMap& map, const PictureView& view) {
  Rows rows;
  for (int strip = 0; strip < strips_of(view.camera.width_px); ++strip) {
    rows.push_back(expected_row(map, view, strip_x_px(strip)));
  }
  return rows;
}

Rows widely_expected(Rows rows, const PictureView& view) {
  constexpr double kSigmas = 3.0;  // that find_skyline() searches
  for (auto& row : rows) {
    if (row) row->sd_px = std::max(row->sd_px, kHighest_rad / kSigmas * view.camera.fy_px);
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
