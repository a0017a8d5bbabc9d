#include "geometry/landmark_adjustment.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "geometry/angles.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Of the residuals by the scaled unknowns, by central differences.
constexpr double kStep = 1e-2;

PoseUnknowns scale_of(const CalibrationSd& sd) {
  PoseUnknowns s;
  s << 1e-3, sd.tilt_rad, sd.tilt_rad, sd.mount_rad, sd.mount_roll_rad, sd.mount_rad, sd.position_m,
      sd.position_m, sd.position_m;
  return s;
}

PoseUnknowns prior() {
  PoseUnknowns information = PoseUnknowns::Ones();
  information[0] = 0.0;
  return information;
}

Vector3d to_landmark_enu(const StationGeometry& station, const Eigen::Isometry3d& camera,
                         const LandmarkSighting& sighting) {
  return LocalFrame(station.position).to_enu(sighting.landmark_ecef) - camera.translation();
}

void check(const LandmarkSighting& s, std::size_t i) {
  const Vector3d sds(s.landmark_sd_m, s.pixel_sd_px, s.angles_sd_rad);
  if (!s.landmark_ecef.allFinite()) throw LandmarkRefused(i, "landmark", "not a finite number");
  if (!s.pixel.allFinite()) throw LandmarkRefused(i, "pixel", "not a finite number");
  if (!std::isfinite(s.angles.pan_rad) || !std::isfinite(s.angles.tilt_rad)) {
    throw LandmarkRefused(i, "angles", "not a finite number");
  }
  if (!sds.allFinite() || sds.minCoeff() < 0.0 || sds.tail<2>().isZero(0.0)) {
    throw LandmarkRefused(i, "deviation", "must be positive");
  }
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

}  // namespace

StationGeometry changed(const StationGeometry& station, const PoseUnknowns& by) {
  StationGeometry result = station;
  ChainParameters& chain = result.chain;
  chain.heading_rad += by[0];
  chain.tilt_x_rad += by[1];
  chain.tilt_y_rad += by[2];
  chain.mount_z_rad += by[3];
  chain.mount_x_rad += by[4];
  chain.mount_y_rad += by[5];
  const Vector3d shift_enu = by.tail<3>();
  if (!shift_enu.isZero(0.0)) {
    result.position = geodetic_from_ecef(LocalFrame(station.position).to_ecef(shift_enu));
  }
  return result;
}

LandmarkAdjustment::LandmarkAdjustment(const StationGeometry& rough,
                                       std::span<const LandmarkSighting> sightings)
    : rough_(rough),
      sightings_(sightings.begin(), sightings.end()),
      landmarks_(by_landmark(sightings)),
      scale_(scale_of(rough.sd)) {
  // Another zone or hemisphere, or latitude and longitude exchanged, are farther; no sight is.
  constexpr double kLeastDistance_m = 1.0, kGreatestDistance_m = 200e3;
  if (sightings.empty()) throw std::invalid_argument("stationing: no landmark was sighted");
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    check(sightings[i], i);
    const auto ray = unproject(rough.camera, sightings[i].pixel);
    if (!ray) throw LandmarkRefused(i, "pixel", "is outside of the lens model");
    rays_cam_.push_back(*ray);
    const Eigen::Isometry3d camera = enu_from_camera(rough.chain, sightings[i].angles);
    distances_m_.push_back(to_landmark_enu(rough, camera, sightings[i]).norm());
    if (!(distances_m_.back() >= kLeastDistance_m)) {
      throw LandmarkRefused(i, "landmark", "is at the station");
    }
    if (distances_m_.back() > kGreatestDistance_m) {
      throw LandmarkRefused(i, "landmark",
                            "is " + std::to_string(std::lround(1e-3 * distances_m_.back())) +
                                " km from the station, more than can be sighted");
    }
  }
}

double LandmarkAdjustment::distance_m(std::size_t sighting) const { return distances_m_[sighting]; }

double LandmarkAdjustment::deviation_rad(std::size_t sighting) const {
  const LandmarkSighting& s = sightings_[sighting];
  return Vector3d(s.pixel_sd_px / rough_.camera.fx_px, s.angles_sd_rad,
                  s.landmark_sd_m / distances_m_[sighting])
      .norm();
}

double LandmarkAdjustment::heading_by(std::size_t landmark) const {
  const std::size_t i = landmarks_[landmark].front();
  const Eigen::Isometry3d camera = enu_from_camera(rough_.chain, sightings_[i].angles);
  const Vector3d there = to_landmark_enu(rough_, camera, sightings_[i]).normalized();
  const Vector3d measured = camera.linear() * rays_cam_[i];
  return wrap_two_pi(rough_.chain.heading_rad + azimuth_elevation_from_enu(there).azimuth_rad -
                     azimuth_elevation_from_enu(measured).azimuth_rad);
}

// On the tangent plane at the landmark, as long as the angle is: a line to the other side is not
// taken for one that meets the landmark.
Vector2d LandmarkAdjustment::residual(const StationGeometry& station, std::size_t sighting) const {
  const LandmarkSighting& s = sightings_[sighting];
  const Eigen::Isometry3d camera = enu_from_camera(station.chain, s.angles);
  const Vector3d landmark = to_landmark_enu(station, camera, s).normalized();
  const Vector3d measured = camera.linear() * rays_cam_[sighting];
  const Vector2d off = tangent_basis(azimuth_elevation_from_enu(landmark)).transpose() * measured;
  const double sine = off.norm(), cosine = landmark.dot(measured);
  if (sine == 0.0) return cosine > 0.0 ? off : Vector2d(kPi, 0.0);
  return off * (std::atan2(sine, cosine) / sine);
}

LandmarkAdjustment::Residuals LandmarkAdjustment::residuals(const StationGeometry& station,
                                                            std::size_t landmark) const {
  const auto& sightings = landmarks_[landmark];
  Residuals all(sightings.size(), 2);
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    all.row(static_cast<Eigen::Index>(k)) = residual(station, sightings[k]).transpose();
  }
  return all;
}

// W times the residuals: each sighting's own variance is d, what all have of the landmark's
// coordinates c, so that their covariance is diag(d) + c c^T (Sherman and Morrison).
LandmarkAdjustment::Residuals LandmarkAdjustment::weighted(const Residuals& residuals,
                                                           std::size_t landmark) const {
  const auto& sightings = landmarks_[landmark];
  Eigen::VectorXd own(sightings.size()), common(sightings.size());
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    const LandmarkSighting& s = sightings_[sightings[k]];
    const auto row = static_cast<Eigen::Index>(k);
    common[row] = s.landmark_sd_m / distances_m_[sightings[k]];
    own[row] = std::pow(s.pixel_sd_px / rough_.camera.fx_px, 2) + std::pow(s.angles_sd_rad, 2);
  }
  const Eigen::VectorXd of_common = common.cwiseQuotient(own);
  const Residuals alone = own.cwiseInverse().asDiagonal() * residuals;
  return alone - of_common * (of_common.transpose() * residuals) / (1.0 + common.dot(of_common));
}

std::vector<StationGeometry> LandmarkAdjustment::beside(const PoseUnknowns& unknowns) const {
  std::vector<StationGeometry> stations;
  for (int k = 0; k < kPoseUnknowns; ++k) {
    for (const double step : {kStep, -kStep}) {
      const PoseUnknowns there = unknowns + step * PoseUnknowns::Unit(k);
      stations.push_back(changed(rough_, scale_.cwiseProduct(there)));
    }
  }
  return stations;
}

LandmarkEquations LandmarkAdjustment::equations(const StationGeometry& at,
                                                const std::vector<StationGeometry>& beside,
                                                std::size_t landmark) const {
  const Residuals v = residuals(at, landmark);
  const Residuals Wv = weighted(v, landmark);
  const Residuals ones = Residuals::Ones(v.rows(), 2);
  const Residuals W_ones = weighted(ones, landmark);
  std::array<Residuals, kPoseUnknowns> J, WJ;
  LandmarkEquations result;
  for (int k = 0; k < kPoseUnknowns; ++k) {
    J[k] = Residuals::Zero(v.rows(), 2);
    if (scale_[k] != 0.0) {
      J[k] = (residuals(beside[2 * k], landmark) - residuals(beside[2 * k + 1], landmark)) /
             (2.0 * kStep);
    }
    WJ[k] = weighted(J[k], landmark);
    result.gradient[k] = J[k].cwiseProduct(Wv).sum();
    result.shift_pose.row(k) = J[k].cwiseProduct(W_ones).colwise().sum();
    for (int l = 0; l <= k; ++l) {
      result.information(k, l) = result.information(l, k) = J[l].cwiseProduct(WJ[k]).sum();
    }
  }
  result.squares = v.cwiseProduct(Wv).sum();
  result.shift_information = W_ones.col(0).sum();
  return result;
}

// Returns the gradient of half the misfit.
PoseUnknowns LandmarkAdjustment::linearise(LandmarkFit& fit, bool also_others) const {
  fit.station = changed(rough_, scale_.cwiseProduct(fit.unknowns));
  fit.information = prior().asDiagonal();
  fit.misfit = fit.unknowns.tail<kPoseUnknowns - 1>().squaredNorm();
  fit.redundancy = -1;  // the heading
  fit.landmarks.assign(fit.kept.size(), {});
  PoseUnknowns gradient = prior().cwiseProduct(fit.unknowns);
  const std::vector<StationGeometry> others = beside(fit.unknowns);
  for (std::size_t l = 0; l < fit.kept.size(); ++l) {
    if (!fit.kept[l] && !also_others) continue;
    const LandmarkEquations& here = fit.landmarks[l] = equations(fit.station, others, l);
    if (!fit.kept[l]) continue;
    fit.information += here.information;
    gradient += here.gradient;
    fit.misfit += here.squares;
    fit.redundancy += 2 * static_cast<int>(landmarks_[l].size());
  }
  return gradient;
}

LandmarkFit LandmarkAdjustment::fit(const std::vector<bool>& kept, double heading_rad) const {
  constexpr int kIterations = 15;
  constexpr double kStill = 1e-6;
  LandmarkFit result;
  result.kept = kept;
  result.unknowns[0] = wrap_pi(heading_rad - rough_.chain.heading_rad) / scale_[0];
  for (int i = 0; i < kIterations; ++i) {
    const PoseUnknowns gradient = linearise(result, false);
    const PoseUnknowns step = result.information.ldlt().solve(gradient);
    result.unknowns -= step;
    if (step.lpNorm<Eigen::Infinity>() < kStill) break;
  }
  linearise(result, true);
  return result;
}

}  // namespace ols
