#include "calibration/stationing.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "calibration/mistaken_landmarks.h"
#include "calibration/systematic.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "geometry/chi_square.h"
#include "geometry/station_calibration.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Of PoseCovariance.
constexpr std::array<int, 6> kPose{kHeading, kTiltX, kTiltY, kMountZ, kMountX, kMountY};
constexpr std::array<int, 3> kPosition{kEast, kNorth, kUp};
// Of Stationing::stated_w.
constexpr std::array<int, 8> kStated{kTiltX, kTiltY, kMountZ, kMountX, kMountY, kEast, kNorth, kUp};

Vector3d to_landmark_enu(const StationGeometry& station, const LandmarkSighting& sighting) {
  return LocalFrame(station.position).to_enu(sighting.landmark_ecef) -
         enu_from_camera(station.chain, sighting.angles).translation();
}

double distance_m(const StationGeometry& station, const LandmarkSighting& sighting) {
  return to_landmark_enu(station, sighting).norm();
}

void check(const StationGeometry& rough, const LandmarkSighting& s, std::size_t i) {
  // Another zone or hemisphere, or latitude and longitude exchanged, are farther; no sight is.
  constexpr double kLeastDistance_m = 1.0, kGreatestDistance_m = 200e3;
  const Vector3d sds(s.landmark_sd_m, s.pixel_sd_px, s.angles_sd_rad);
  if (!s.landmark_ecef.allFinite()) throw LandmarkRefused(i, "landmark", "not a finite number");
  if (!s.pixel.allFinite()) throw LandmarkRefused(i, "pixel", "not a finite number");
  if (!std::isfinite(s.angles.pan_rad) || !std::isfinite(s.angles.tilt_rad)) {
    throw LandmarkRefused(i, "angles", "not a finite number");
  }
  if (!sds.allFinite() || sds.minCoeff() < 0.0 || sds.tail<2>().isZero(0.0)) {
    throw LandmarkRefused(i, "deviation", "must be positive");
  }
  if (!unproject(rough.camera, s.pixel)) {
    throw LandmarkRefused(i, "pixel", "is outside of the lens model");
  }
  const double away_m = distance_m(rough, s);
  if (!(away_m >= kLeastDistance_m)) throw LandmarkRefused(i, "landmark", "is at the station");
  if (away_m > kGreatestDistance_m) {
    throw LandmarkRefused(i, "landmark",
                          "is " + std::to_string(std::lround(1e-3 * away_m)) +
                              " km from the station, more than can be sighted");
  }
}

// The setup's stated deviations, and nothing else unknown: an instrument without errors, no
// refraction.
StationPrior prior_of(const StationGeometry& rough) {
  StationPrior prior;
  prior.model.geometry = rough;
  prior.refraction = 0.0;
  const CalibrationSd& sd = rough.sd;
  const std::array<double, 8> sds{sd.tilt_rad,  sd.tilt_rad,   sd.mount_rad,  sd.mount_roll_rad,
                                  sd.mount_rad, sd.position_m, sd.position_m, sd.position_m};
  for (std::size_t k = 0; k < sds.size(); ++k) {
    prior.covariance(kStated[k], kStated[k]) = sds[k] * sds[k];
  }
  return prior;
}

std::vector<std::vector<std::size_t>> by_landmark(std::span<const LandmarkSighting> sightings) {
  std::vector<std::vector<std::size_t>> landmarks;
  std::map<std::array<double, 3>, std::size_t> known;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Vector3d& p = sightings[i].landmark_ecef;
    const auto [place, is_new] = known.try_emplace({p.x(), p.y(), p.z()}, landmarks.size());
    if (is_new) landmarks.emplace_back();
    landmarks[place->second].push_back(i);
  }
  return landmarks;
}

UnitReading reading_at(const StationModel& model, const PanTilt& angles) {
  const UnitCounts counts = counts_for(model, angles, 0, 0);
  UnitReading reading;
  reading.pan.counts = counts.pan;
  reading.tilt.counts = counts.tilt;
  return reading;
}

Sighting sighting_of(const StationModel& model, const LandmarkSighting& one) {
  Sighting sighting;
  sighting.reading = reading_at(model, one.angles);
  sighting.pixel = one.pixel;
  sighting.sd_px = one.pixel_sd_px;
  sighting.pose_sd_rad = one.angles_sd_rad;
  return sighting;
}

// A group for each landmark: its sightings share the error of its coordinates.
Network network_of(const StationGeometry& rough, std::span<const LandmarkSighting> sightings) {
  if (sightings.empty()) throw std::invalid_argument("stationing: no landmark was sighted");
  for (std::size_t i = 0; i < sightings.size(); ++i) check(rough, sightings[i], i);
  Network network;
  network.layout.stations = 1;
  network.stations = {prior_of(rough)};
  network.names = {""};
  const StationPrior& prior = network.stations[0];
  for (const std::vector<std::size_t>& members : by_landmark(sightings)) {
    const LandmarkSighting& first = sightings[members.front()];
    std::vector<Sighting> own;
    for (const std::size_t i : members) own.push_back(sighting_of(prior.model, sightings[i]));
    Group group;
    group.blocks = {network.blocks.size()};
    group.observations = members;
    network.blocks.push_back(pixel_block(fixed_target({first.landmark_ecef, first.landmark_sd_m}),
                                         std::move(own), {.layout = network.layout}));
    group.degrees_of_freedom = network.blocks.back()->degrees_of_freedom();
    network.groups.push_back(std::move(group));
  }
  network.priors_from = network.blocks.size();
  network.blocks.push_back(station_prior_block(network.layout, 0, prior.covariance));
  network.blocks.push_back(ut1_prior_block(network.layout, 1.0));
  return network;
}

// The angles by which the sighting's line of sight misses the landmark [rad]: (across, up). On the
// tangent plane at the landmark, as long as the angle is: a line to the other side is not taken for
// one that meets the landmark.
Vector2d missed_rad(const StationGeometry& station, const LandmarkSighting& s) {
  const Vector3d landmark = to_landmark_enu(station, s).normalized();
  const Vector3d measured = enu_from_camera(station.chain, s.angles).linear() *
                            unproject(station.camera, s.pixel).value();
  const Vector2d off = tangent_basis(azimuth_elevation_from_enu(landmark)).transpose() * measured;
  const double sine = off.norm(), cosine = landmark.dot(measured);
  if (sine == 0.0) return cosine > 0.0 ? off : Vector2d(kPi, 0.0);
  return off * (std::atan2(sine, cosine) / sine);
}

// (cross-elevation, elevation) covariance of the optical axis at these angles.
Eigen::Matrix2d axis_covariance(const Stationing& result, const StationMatrix& covariance,
                                const PanTilt& angles) {
  StationModel model;
  model.geometry = result.station;
  const CameraIntrinsics& camera = model.geometry.camera;
  const UnitReading reading = reading_at(model, angles);
  return systematic_direction(model, covariance, reading, {camera.cx_px, camera.cy_px})
      .value()
      .covariance_rad2;
}

// The heading's and the tilts' deviations that geometry/sight.h must be told so that no line of
// sight up to `highest_rad` is stated better than it is.
void cover(Stationing& result, const StationMatrix& covariance, double highest_rad) {
  StationGeometry& station = result.station;
  constexpr int kAzimuths = 24, kElevations = 2;  // elevations on each side of the horizon
  std::vector<std::pair<double, Eigen::Matrix2d>> seen;
  for (int e = -kElevations; e <= kElevations; ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      const double elevation_rad = highest_rad * e / kElevations;
      const auto angles = aim_along(station, {2.0 * kPi * a / kAzimuths, elevation_rad});
      if (!angles) continue;
      seen.emplace_back(elevation_rad, axis_covariance(result, covariance, *angles));
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
void look_around(Stationing& result, const StationMatrix& covariance) {
  constexpr int kAzimuths = 72;
  result.best.elevation_sd_rad = kPi;
  for (int a = 0; a < kAzimuths; ++a) {
    const double azimuth_rad = 2.0 * kPi * a / kAzimuths;
    const auto angles = aim_along(result.station, {azimuth_rad, 0.0});
    if (!angles) continue;
    const HorizonSd here{azimuth_rad,
                         std::sqrt(axis_covariance(result, covariance, *angles)(1, 1))};
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
  const Adjustment adjustment(network_of(rough, sightings));
  const std::vector<bool> all(adjustment.groups().size(), true);
  if (all.size() < kLeast) return "";
  try {
    const Fit fit = without_mistaken(adjustment, level);
    if (fit.kept != all) return "";
    const ChainParameters& chain = fit.state.stations[0].model.geometry.chain;
    return printed("; all would agree at a tilt of x %.2f, y %.2f deg", degrees(chain.tilt_x_rad),
                   degrees(chain.tilt_y_rad));
  } catch (const LandmarksContradict&) {
    return "";
  }
}

Fit tested_fit(const Adjustment& adjustment, const StationGeometry& rough,
               std::span<const LandmarkSighting> sightings, double level) {
  try {
    return without_mistaken(adjustment, level);
  } catch (const LandmarksContradict& problem) {
    throw LandmarksContradict(problem.why() + tilt_that_would_do(rough, sightings, level),
                              problem.alternatives(), problem.failing());
  }
}

void test_landmarks(Stationing& result, const Adjustment& adjustment, const Fit& fit,
                    std::span<const LandmarkSighting> sightings, double level) {
  const std::vector<GroupTest> tests = tests_of(adjustment, fit, level);
  for (std::size_t l = 0; l < tests.size(); ++l) {
    const std::vector<std::size_t>& members = adjustment.groups()[l].observations;
    const StationGeometry& rough = adjustment.network().stations[0].model.geometry;
    result.landmarks.push_back(
        {.sightings = members,
         .rejected = tests[l].rejected,
         .w = tests[l].w,
         .critical = tests[l].critical,
         .detectable_m = tests[l].detectable_rad * distance_m(rough, sightings[members.front()])});
  }
}

void test_stated(Stationing& result, const Adjustment& adjustment, const Fit& fit) {
  constexpr double kUnseen = 1e-9;
  const StationMatrix& prior = adjustment.network().stations[0].covariance;
  for (std::size_t k = 0; k < kStated.size(); ++k) {
    const int at = kStated[k];
    const double seen = prior(at, at) - fit.covariance(at, at);
    if (prior(at, at) == 0.0 || seen < kUnseen * prior(at, at)) continue;
    result.stated_w[k] = fit.state.stations[0].change[at] / std::sqrt(seen);
  }
}

void test_globally(Stationing& result, const Adjustment& adjustment, const Fit& fit, double level) {
  const int redundancy = stationing_redundancy(adjustment, fit.kept);
  result.global = {.variance_factor = fit.misfit / redundancy,
                   .critical = chi_square_critical(level, redundancy) / redundancy,
                   .redundancy = redundancy};
  if (result.global.variance_factor > result.global.critical) {
    result.scaled_by = std::sqrt(std::max(1.0, result.global.variance_factor));
  }
}

void add_residuals(Stationing& result, const StationGeometry& adjusted,
                   std::span<const LandmarkSighting> sightings) {
  for (const LandmarkSighting& s : sightings) {
    const double deviation_rad = Vector3d(s.pixel_sd_px / adjusted.camera.fx_px, s.angles_sd_rad,
                                          s.landmark_sd_m / distance_m(adjusted, s))
                                     .norm();
    result.residuals_rad.push_back(missed_rad(adjusted, s));
    result.residuals.push_back(result.residuals_rad.back() / deviation_rad);
  }
}

}  // namespace

Stationing station_by_landmarks(const StationGeometry& rough,
                                std::span<const LandmarkSighting> sightings, double highest_rad,
                                const Levels& levels) {
  if (!std::isfinite(highest_rad)) {
    throw std::invalid_argument("stationing: the highest elevation is not a finite number");
  }
  const Adjustment adjustment(network_of(rough, sightings));
  const Fit fit = tested_fit(adjustment, rough, sightings, levels.mistaken);
  const StationGeometry& adjusted = fit.state.stations[0].model.geometry;
  Stationing result;
  result.station = adjusted;
  result.station.position = rough.position;
  result.station.chain.heading_rad = wrap_two_pi(adjusted.chain.heading_rad);
  test_globally(result, adjustment, fit, levels.misfit);
  const StationMatrix covariance =
      result.scaled_by * result.scaled_by *
      fit.covariance.topLeftCorner<kStationParameters, kStationParameters>();
  result.covariance = covariance(kPose, kPose);
  result.position = adjusted.position;
  result.position_sd_m = std::sqrt(covariance(kPosition, kPosition).diagonal().maxCoeff());
  result.station.sd.mount_roll_rad = std::sqrt(covariance(kMountX, kMountX));
  cover(result, covariance, highest_rad);
  check_heading(result);
  look_around(result, covariance);
  test_stated(result, adjustment, fit);
  test_landmarks(result, adjustment, fit, sightings, levels.mistaken);
  add_residuals(result, adjusted, sightings);
  return result;
}

}  // namespace ols::calibration
