#include "land/scenery/picture_panorama.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/angles.h"
#include "land/refraction.h"
#include "land/scenery/sample.h"

namespace ols::scenery {
namespace {

// The gray value of the picture there; nullopt outside.
std::optional<float> gray_at(const ScenePicture& picture, const Eigen::Vector3d& v_enu) {
  const auto px = project(picture.camera, picture.R_enu_camera.transpose() * v_enu);
  if (!px) return std::nullopt;
  const float value = sample(picture.gray, px->x(), px->y());
  if (std::isnan(value)) return std::nullopt;
  return value;
}

// The cosine of the greatest angle between the optical axis and a pixel of the picture.
double least_cosine(const ScenePicture& picture) {
  double least = 1.0;
  for (const double x : {0.0, picture.gray.cols - 1.0}) {
    for (const double y : {0.0, picture.gray.rows - 1.0}) {
      const auto ray = unproject(picture.camera, {x, y});
      least = std::min(least, ray ? ray->z() : -1.0);
    }
  }
  return least;
}

struct Aimed {
  const ScenePicture* picture;
  Eigen::Vector3d axis_enu;
  double least_cosine;
};

std::uint8_t gray_of(const std::vector<Aimed>& pictures, const Eigen::Vector3d& v_enu) {
  double nearest = -1.0;
  std::uint8_t gray = kUnseen;
  for (const Aimed& one : pictures) {
    const double cosine = one.axis_enu.dot(v_enu);
    if (cosine < one.least_cosine || cosine <= nearest) continue;
    const auto value = gray_at(*one.picture, v_enu);
    if (!value) continue;
    nearest = cosine;
    gray = static_cast<std::uint8_t>(std::clamp(std::lround(*value), 1L, 255L));
  }
  return gray;
}

// Grows around directions; the first one is the middle from which azimuths count.
class GrowingBox {
 public:
  void add(const AzimuthElevation& direction) {
    if (is_empty()) middle_rad_ = direction.azimuth_rad;
    const double right_rad = wrap_pi(direction.azimuth_rad - middle_rad_);
    left_rad_ = std::min(left_rad_, right_rad);
    right_rad_ = std::max(right_rad_, right_rad);
    bottom_rad_ = std::min(bottom_rad_, direction.elevation_rad);
    top_rad_ = std::max(top_rad_, direction.elevation_rad);
  }
  bool is_empty() const { return left_rad_ > right_rad_; }
  SceneBox box(double margin_rad) const {
    return {wrap_two_pi(middle_rad_ + left_rad_ - margin_rad),
            right_rad_ - left_rad_ + 2.0 * margin_rad, bottom_rad_ - margin_rad,
            top_rad_ + margin_rad};
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double middle_rad_ = 0.0, left_rad_ = kInfinity, right_rad_ = -kInfinity;
  double bottom_rad_ = kInfinity, top_rad_ = -kInfinity;
};

AzimuthElevation seen_from(const LocalFrame& camera, const Eigen::Vector3d& p_ecef) {
  const Eigen::Vector3d enu_m = camera.to_enu(p_ecef);
  return land::apparent(azimuth_elevation_from_enu(enu_m), enu_m.norm());
}

// Places along a line of sight that look alike from both stations.
std::vector<Eigen::Vector3d> seen_alike(const LocalFrame& camera, const LocalFrame& other,
                                        const AzimuthElevation& direction,
                                        const RangeInterval& ranges) {
  constexpr int kRanges = 8;
  const double least_cosine = std::cos(radians(50.0));
  const double nearest = 1.0 / ranges.near_m, farthest = 1.0 / ranges.far_m;
  std::vector<Eigen::Vector3d> places_ecef;
  for (int k = 0; k <= kRanges; ++k) {
    const double range_m = 1.0 / (nearest + (farthest - nearest) * k / kRanges);
    const Eigen::Vector3d ray_enu = enu_from_azimuth_elevation(land::straight(direction, range_m));
    const Eigen::Vector3d p_ecef = camera.to_ecef(range_m * ray_enu);
    const Eigen::Vector3d from_other = (p_ecef - other.origin_ecef()).normalized();
    if (from_other.dot(camera.R_ecef_enu() * ray_enu) > least_cosine) places_ecef.push_back(p_ecef);
  }
  return places_ecef;
}

}  // namespace

SceneBox around(const std::vector<ScenePicture>& pictures) {
  if (pictures.empty()) throw std::invalid_argument("no pictures of scenery");
  SceneBox box{0.0, 2.0 * kPi, kPi, -kPi};
  for (const ScenePicture& picture : pictures) {
    const double right_px = picture.gray.cols - 1.0, bottom_px = picture.gray.rows - 1.0;
    for (const double x : {0.0, 0.5 * right_px, right_px}) {
      for (const double y : {0.0, bottom_px}) {
        const auto ray = unproject(picture.camera, {x, y});
        if (!ray) continue;
        const double elevation_rad =
            azimuth_elevation_from_enu(picture.R_enu_camera * *ray).elevation_rad;
        box.bottom_rad = std::min(box.bottom_rad, elevation_rad);
        box.top_rad = std::max(box.top_rad, elevation_rad);
      }
    }
  }
  return box;
}

void draw(const std::vector<ScenePicture>& pictures, const SceneBox& box, ScenePanorama& panorama) {
  const auto pixels = [&](double rad) {
    return std::max(1, static_cast<int>(std::lround(rad / panorama.rad_per_px)));
  };
  panorama.first_azimuth_rad = box.first_azimuth_rad;
  panorama.top_elevation_rad = box.top_rad;
  panorama.gray.create(pixels(box.top_rad - box.bottom_rad), pixels(box.width_rad));
  std::vector<Aimed> all;
  for (const ScenePicture& picture : pictures) {
    all.push_back({&picture, picture.R_enu_camera.col(2), least_cosine(picture)});
  }
  for (int y = 0; y < panorama.gray.rows; ++y) {
    for (int x = 0; x < panorama.gray.cols; ++x) {
      panorama.gray(y, x) =
          gray_of(all, enu_from_azimuth_elevation(direction_of(panorama, Eigen::Vector2d(x, y))));
    }
  }
}

std::optional<SharedBoxes> shared_boxes(const SceneBox& sector, const LocalFrame& camera,
                                        const LocalFrame& other, const PossibleRanges& possible) {
  constexpr double kApart_rad = radians(0.5), kElevationsApart_rad = radians(0.1);
  constexpr double kMargin_rad = radians(0.1);
  GrowingBox own, others;
  const double height_rad = sector.top_rad - sector.bottom_rad;
  const int columns = static_cast<int>(std::ceil(sector.width_rad / kApart_rad));
  const int rows = static_cast<int>(std::ceil(height_rad / kElevationsApart_rad));
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const AzimuthElevation direction{
          wrap_two_pi(sector.first_azimuth_rad + sector.width_rad * i / columns),
          sector.bottom_rad + height_rad * j / rows};
      const auto ranges = possible(direction);
      if (!ranges) continue;
      for (const Eigen::Vector3d& p_ecef : seen_alike(camera, other, direction, *ranges)) {
        own.add(direction);
        others.add(seen_from(other, p_ecef));
      }
    }
  }
  if (own.is_empty()) return std::nullopt;
  const SceneBox shown = own.box(kMargin_rad);
  // What the pictures do not show is not looked for.
  return SharedBoxes{
      {sector.first_azimuth_rad, sector.width_rad, std::max(sector.bottom_rad, shown.bottom_rad),
       std::min(sector.top_rad, shown.top_rad)},
      others.box(kMargin_rad)};
}

}  // namespace ols::scenery
