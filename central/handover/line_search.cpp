#include "central/handover/line_search.h"

#include <algorithm>
#include <cmath>

#include "central/measurement/time_span.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

CueRay CueRay::at(std::int64_t later_us) const {
  CueRay later = *this;
  later.utime_us = later_us;
  later.direction_ecef = (direction_ecef + seconds(later_us - utime_us) * rate_ecef).normalized();
  return later;
}

std::optional<LinePrior> range_by_size(const CueRay& ray) {
  constexpr double kSize_m = 0.6, kSizeSd = 0.5;  // of drones and birds (class_table.h); of its log
  constexpr double kMost = 0.7;                   // relative error
  if (!(ray.size_rad > 0.0 && ray.size_sd_rad > 0.0)) return std::nullopt;
  const double relative_sd = ray.size_sd_rad / ray.size_rad;
  if (relative_sd > kMost) return std::nullopt;
  const double range_m = kSize_m / ray.size_rad;
  return LinePrior{range_m, range_m * std::hypot(kSizeSd, relative_sd)};
}

LinePrior combined(const LinePrior& first, const LinePrior& second) {
  if (second.range_m <= second.sd_m) return first;
  const auto weight = [](const LinePrior& prior) {
    return std::pow(prior.range_m / prior.sd_m, 2);
  };
  const double both = weight(first) + weight(second);
  const double range_m = std::exp(
      (weight(first) * std::log(first.range_m) + weight(second) * std::log(second.range_m)) / both);
  return {range_m, range_m / std::sqrt(both)};
}

SweepStart sweep_start(const LinePrior& prior, const LineShare& share,
                       const LineSearchConfig& config) {
  constexpr double kAlone = 0.25;  // beginning nearer would delay what is farther for too long
  const bool outwards = 2 * share.rank >= share.of || share.of == 1;
  const double quantile =
      share.of > 1 ? static_cast<double>(share.rank + (outwards ? 0 : 1)) / share.of : kAlone;
  const double scale_m = prior.sd_m * std::sqrt(3.0) / kPi;
  const double range_m = prior.range_m + scale_m * std::log(quantile / (1.0 - quantile));
  return {std::clamp(range_m, config.near_m, config.far_m), outwards};
}

double turning_s(double angle_rad, const LineSearchConfig& config) {
  const double a = config.acceleration_rad_s2, v = config.speed_rad_s;
  const double to_speed_rad = v * v / a;  // angle in which it reaches full speed and brakes again
  const double turning =
      angle_rad < to_speed_rad ? 2.0 * std::sqrt(angle_rad / a) : v / a + angle_rad / v;
  return turning + config.settle_s;
}

SweepPlace to_and_fro(double begin_rad, double swept_rad, double way_rad, bool up_first) {
  if (way_rad <= 0.0) return {0.0, up_first};
  // On the round trip: 0 .. way upwards, way .. 2 way downwards.
  const double from = up_first ? begin_rad : 2.0 * way_rad - begin_rad;
  const double within = std::fmod(from + swept_rad, 2.0 * way_rad);
  return within <= way_rad ? SweepPlace{within, true} : SweepPlace{2.0 * way_rad - within, false};
}

// The line as seen from a station: directions in the plane of both, by their angle from the near
// end.
struct LineSweep::Plane {
  Plane(const CueRay& seen, const Eigen::Vector3d& from, const LineSearchConfig& config)
      : ray(seen),
        camera(from),
        near(ray.origin_ecef + config.near_m * ray.direction_ecef - camera),
        u(near.normalized()) {
    const Eigen::Vector3d far = to(config.far_m);
    way_rad = angle_between(near, far);
    const Eigen::Vector3d across = far - far.dot(u) * u;
    if (across.norm() > 1e-9 * far.norm()) v = across.normalized();
  }
  Eigen::Vector3d to(double range_m) const {
    return ray.origin_ecef + range_m * ray.direction_ecef - camera;
  }
  double angle_of(double range_m) const { return angle_between(near, to(range_m)); }
  Eigen::Vector3d direction(double angle_rad) const {
    return std::cos(angle_rad) * u + std::sin(angle_rad) * v;
  }
  Eigen::Vector3d along(double angle_rad) const {
    return -std::sin(angle_rad) * u + std::cos(angle_rad) * v;
  }
  // Range along the ray where it meets this direction.
  double range_at(const Eigen::Vector3d& direction, const LineSearchConfig& config) const {
    const Eigen::Vector3d base = camera - ray.origin_ecef;
    const double c = ray.direction_ecef.dot(direction);
    const double across = 1.0 - c * c;
    if (across < 1e-9) return config.far_m;
    const double range_m = (base.dot(ray.direction_ecef) - c * base.dot(direction)) / across;
    return std::clamp(range_m, config.near_m, config.far_m);
  }

  const CueRay& ray;
  const Eigen::Vector3d& camera;
  Eigen::Vector3d near, u;
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  // none where the station stands on the line
  double way_rad = 0.0;
};

LineSweep::LineSweep(const CueRay& ray, const StationTraits& station, const SweepStart& start,
                     const LineSearchConfig& config)
    : config_(config),
      start_(start),
      rate_rad_s_(station.field_of_view_rad / config.view_s),
      wait_s_(turning_s(kPi / 4.0, config)) {
  if (!station.axis) return;
  const Plane plane(ray, station.camera_ecef, config_);
  const Eigen::Vector3d there =
      R_ecef_enu(station.camera_ecef).transpose() * plane.to(start.range_m);
  wait_s_ = turning_s(angle_between(enu_from_azimuth_elevation(*station.axis), there), config_);
}

SweepPlace LineSweep::place(const Plane& plane, double searched_s) const {
  const double swept_rad = rate_rad_s_ * std::max(0.0, searched_s - wait_s_);
  const double begin_rad = std::min(plane.angle_of(start_.range_m), plane.way_rad);
  return to_and_fro(begin_rad, swept_rad, plane.way_rad, start_.outwards);
}

Eigen::Vector3d LineSweep::line_at(const Plane& plane, double searched_s) const {
  return plane.direction(place(plane, searched_s).angle_rad);
}

LineLook LineSweep::look(const CueRay& ray, const StationTraits& station, double searched_s) const {
  constexpr double kStep_s = 0.05, kMost_rad = 0.2;
  const Plane plane(ray, station.camera_ecef, config_);
  const CueRay next_ray = ray.at(ray.utime_us + std::llround(1e6 * kStep_s));
  const Plane next(next_ray, station.camera_ecef, config_);
  const Eigen::Matrix3d R_enu_ecef = R_ecef_enu(station.camera_ecef).transpose();
  const double angle_rad = place(plane, searched_s).angle_rad;
  const Eigen::Vector3d direction = plane.direction(angle_rad);
  LineLook look;
  look.direction = azimuth_elevation_from_enu(R_enu_ecef * direction);
  const Eigen::Matrix<double, 2, 3> on_plane =
      tangent_basis(look.direction).transpose() * R_enu_ecef;
  look.rate_rad_s = on_plane * (line_at(next, searched_s + kStep_s) - direction) / kStep_s;
  if (!plane.v.isZero()) look.line = (on_plane * plane.along(angle_rad)).normalized();
  const double range_m = plane.range_at(direction, config_);
  const double off_m = std::hypot(ray.sd_rad * range_m, station.camera_sd_enu_m.norm());
  look.sd_rad = std::min(kMost_rad, off_m / std::max(1.0, plane.to(range_m).norm()));
  return look;
}

}  // namespace ols::fusion
