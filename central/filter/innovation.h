// The measurement model: predicts a bearing with each motion model, and computes the innovation.
// Pure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "central/filter/interacting_models.h"
#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"

namespace ols::fusion {

// The effect of a station's own states on its bearing, on the tangent plane.
struct StationPart {
  Eigen::Index first = 0;  // index of the station's first state
  bool has_place = false;  // whether the station has position states
  Eigen::Matrix<double, 2, 3> by_rotation;
  Eigen::Matrix3d R_ecef_enu;
};

// The comparison of one motion model's prediction with one bearing. The measurement matrix H has
// the columns [J, ahead_s J, curved_s2 J] for the target's position, velocity and acceleration. The
// columns by_pose and by_place for the station follow.
struct ModelInnovation {
  double depth_m = 0.0;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the residual, without noise
  Eigen::Matrix<double, 2, 3> J = Eigen::Matrix<double, 2, 3>::Zero();
  // ahead_s: time from the filter's instant to the bearing's. curved_s2: half the square of
  // ahead_s; 0 for constant velocity.
  double ahead_s = 0.0, curved_s2 = 0.0;
  // The target's velocity: a clock error moves the bearing in proportion to it.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 2, kPoseStates> by_pose;
  Eigen::Matrix<double, 2, kPlaceStates> by_place;

  // P H^T, the covariance between the whole state and the residual.
  FilterMatrix2 cross(const FilterMatrix& P, const std::optional<StationPart>& part) const;
};

struct Innovation {
  std::array<ModelInnovation, kMotions> models;
  RayFrame frame;
  std::optional<StationPart> part;  // nullopt if the filter has no states for the station
  // The smallest squared normalised residual (NIS, 2 degrees of freedom) among the models; infinite
  // if the target is behind the camera.
  double nis = std::numeric_limits<double>::infinity();
  std::int64_t state = 0;  // the version of the filter's state from which this was computed
};

// about: the motion about which to linearise; nullopt for the current estimate.
ModelInnovation innovation_of(const InteractingModels& models, std::size_t which,
                              const BearingMeasurement& measurement, const RayFrame& frame,
                              const StationPart* station,
                              const std::optional<KinematicState>& about);

struct JudgedInnovation {
  double nis = std::numeric_limits<double>::infinity();
  // The noise variance that the bearing's residual shows, relative to the assumed variance.
  double noise = 1.0;
};

// Judges a bearing by the first `models` models, with this white noise; nullopt if the target is
// behind the camera.
std::optional<JudgedInnovation> judge(const Innovation& seen, std::size_t models,
                                      const Eigen::Matrix2d& white, double gate_nis);

}  // namespace ols::fusion
