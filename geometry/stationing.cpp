#include "geometry/stationing.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/angles.h"
#include "geometry/chi_square.h"
#include "geometry/data_snooping.h"
#include "geometry/landmark_adjustment.h"

namespace ols {
namespace {

// (cross-elevation, elevation) covariance of the optical axis at these angles.
Eigen::Matrix2d axis_covariance(const StationGeometry& station, const PanTilt& angles,
                                const PoseCovariance& covariance) {
  constexpr double kStep = 1e-6;
  const auto axis = [&](const PoseUnknowns& by) -> Eigen::Vector3d {
    return enu_from_camera(changed(station, by).chain, angles).linear().col(2);
  };
  const auto basis = tangent_basis(azimuth_elevation_from_enu(axis(PoseUnknowns::Zero())));
  Eigen::Matrix<double, 2, 6> J;
  for (int k = 0; k < 6; ++k) {
    const PoseUnknowns step = kStep * PoseUnknowns::Unit(k);
    J.col(k) = basis.transpose() * (axis(step) - axis(-step)) / (2.0 * kStep);
  }
  return J * covariance * J.transpose();
}

// The heading's and the tilts' deviations that geometry/sight.h must be told so that no line of
// sight up to `highest_rad` is stated better than it is.
void cover(Stationing& result, double highest_rad) {
  StationGeometry& station = result.station;
  constexpr int kAzimuths = 24, kElevations = 2;  // elevations on each side of the horizon
  std::vector<std::pair<double, Eigen::Matrix2d>> seen;
  for (int e = -kElevations; e <= kElevations; ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      const double elevation_rad = highest_rad * e / kElevations;
      const auto angles = aim_along(station, {2.0 * kPi * a / kAzimuths, elevation_rad});
      if (!angles) continue;
      seen.emplace_back(elevation_rad, axis_covariance(station, *angles, result.covariance));
    }
  }
  double tilt = 0.0, heading = 0.0;
  for (const auto& [elevation_rad, C] : seen) tilt = std::max(C(1, 1), tilt);
  for (const auto& [elevation_rad, C] : seen) {
    const double by_tilt = tilt * std::pow(std::sin(elevation_rad), 2);
    heading = std::max(heading, (C(0, 0) - by_tilt) / std::pow(std::cos(elevation_rad), 2));
  }
  station.sd.heading_rad = std::sqrt(heading);
  station.sd.tilt_rad = std::sqrt(tilt);
  station.sd.mount_rad = 0.0;
}

// Where along the horizon the elevation is known best and least.
void look_around(Stationing& result) {
  constexpr int kAzimuths = 72;
  result.best.elevation_sd_rad = kPi;
  for (int a = 0; a < kAzimuths; ++a) {
    const double azimuth_rad = 2.0 * kPi * a / kAzimuths;
    const auto angles = aim_along(result.station, {azimuth_rad, 0.0});
    if (!angles) continue;
    const HorizonSd here{
        azimuth_rad, std::sqrt(axis_covariance(result.station, *angles, result.covariance)(1, 1))};
    if (here.elevation_sd_rad < result.best.elevation_sd_rad) result.best = here;
    if (here.elevation_sd_rad > result.worst.elevation_sd_rad) result.worst = here;
  }
}

void check_heading(const Stationing& result) {
  const double worst_rad = std::max(result.station.sd.heading_rad, result.station.sd.tilt_rad);
  if (!result.covariance.allFinite() || !(worst_rad > 0.0 && worst_rad < radians(10.0))) {
    throw std::invalid_argument(
        "stationing: the landmarks leave the heading unknown; they are too near, or too high");
  }
}

// The tilt with which all would agree, whatever is stated of it; empty where none would do.
std::string tilt_that_would_do(StationGeometry rough, std::span<const LandmarkSighting> sightings,
                               double level) {
  constexpr std::size_t kLeast = 3;  // two agree with almost any
  rough.sd.tilt_rad = radians(10.0);
  const LandmarkAdjustment adjustment(rough, sightings);
  const std::vector<bool> all(adjustment.landmarks().size(), true);
  if (all.size() < kLeast) return "";
  try {
    const LandmarkFit fit = without_mistaken(adjustment, level);
    if (fit.kept != all) return "";
    const ChainParameters& chain = fit.station.chain;
    char text[128];
    std::snprintf(text, sizeof text, "; all would agree at a tilt of x %.2f, y %.2f deg",
                  degrees(chain.tilt_x_rad), degrees(chain.tilt_y_rad));
    return text;
  } catch (const LandmarksContradict&) {
    return "";
  }
}

LandmarkFit tested_fit(const LandmarkAdjustment& adjustment, const StationGeometry& rough,
                       std::span<const LandmarkSighting> sightings, double level) {
  try {
    return without_mistaken(adjustment, level);
  } catch (const LandmarksContradict& problem) {
    throw LandmarksContradict(problem.why() + tilt_that_would_do(rough, sightings, level),
                              problem.alternatives(), problem.failing());
  }
}

void test_landmarks(Stationing& result, const LandmarkAdjustment& adjustment,
                    const LandmarkFit& fit, double level) {
  constexpr double kPower = 0.8;
  std::map<std::size_t, std::pair<double, double>> limits;  // by the number of sightings
  for (std::size_t l = 0; l < fit.kept.size(); ++l) {
    const auto& sightings = adjustment.landmarks()[l];
    auto& [critical, noncentrality] = limits[sightings.size()];
    if (critical == 0.0) {
      critical = critical_value(adjustment, l, level);
      noncentrality = least_noncentrality(critical, 2 * static_cast<int>(sightings.size()), kPower);
    }
    result.landmarks.push_back({.sightings = sightings,
                                .rejected = !fit.kept[l],
                                .w = std::sqrt(std::max(0.0, leave_one_out(fit, l))),
                                .critical = std::sqrt(critical),
                                .detectable_m = detectable_m(adjustment, fit, l, noncentrality)});
  }
}

void test_stated(Stationing& result, const LandmarkAdjustment& adjustment, const LandmarkFit& fit,
                 const PoseInformation& spread) {
  constexpr double kUnseen = 1e-9;
  for (int k = 1; k < kPoseUnknowns; ++k) {
    const double seen = 1.0 - spread(k, k);
    if (adjustment.scale()[k] == 0.0 || seen < kUnseen) continue;
    result.stated_w[static_cast<std::size_t>(k - 1)] = fit.unknowns[k] / std::sqrt(seen);
  }
}

void test_globally(Stationing& result, const LandmarkFit& fit, double level) {
  const int redundancy = fit.redundancy;
  result.global = {.variance_factor = fit.misfit / redundancy,
                   .critical = chi_square_critical(level, redundancy) / redundancy,
                   .redundancy = redundancy};
  if (result.global.variance_factor > result.global.critical) {
    result.scaled_by = std::sqrt(std::max(1.0, result.global.variance_factor));
  }
}

}  // namespace

Stationing station_by_landmarks(const StationGeometry& rough,
                                std::span<const LandmarkSighting> sightings, double highest_rad,
                                const StationingLevels& levels) {
  if (!std::isfinite(highest_rad)) {
    throw std::invalid_argument("stationing: the highest elevation is not a finite number");
  }
  const LandmarkAdjustment adjustment(rough, sightings);
  const LandmarkFit fit = tested_fit(adjustment, rough, sightings, levels.mistaken);
  Stationing result;
  result.station = fit.station;
  result.station.position = rough.position;
  result.station.chain.heading_rad = wrap_two_pi(fit.station.chain.heading_rad);
  test_globally(result, fit, levels.misfit);
  const auto scale = (result.scaled_by * adjustment.scale()).asDiagonal();
  const PoseInformation spread = fit.information.inverse();
  const PoseInformation covariance = scale * spread * scale;
  result.covariance = covariance.topLeftCorner<6, 6>();
  result.station.sd.mount_roll_rad = std::sqrt(result.covariance(4, 4));
  cover(result, highest_rad);
  check_heading(result);
  look_around(result);
  test_stated(result, adjustment, fit, spread);
  test_landmarks(result, adjustment, fit, levels.mistaken);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    result.residuals_rad.push_back(adjustment.residual(fit.station, i));
    result.residuals.push_back(result.residuals_rad.back() / adjustment.deviation_rad(i));
  }
  return result;
}

}  // namespace ols
