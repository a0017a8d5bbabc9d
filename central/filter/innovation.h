// The measurement model: the prediction of a bearing by each motion model, and the innovation.
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
  Eigen::Index first = 0;  // index of the first of the station's states
  bool has_place = false;  // whether the states contain its position
  Eigen::Matrix<double, 2, 3> by_rotation;
  Eigen::Matrix3d R_ecef_enu;
};

// One model's prediction compared with one bearing. The measurement matrix H has the columns
// [J, ahead_s J, curved_s2 J] for the target's position, velocity and acceleration, then by_pose
// and by_place for the station.
struct ModelInnovation {
  double depth_m = 0.0;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the residual, without noise
  Eigen::Matrix<double, 2, 3> J = Eigen::Matrix<double, 2, 3>::Zero();
  // From the filter's time to the bearing's. curved_s2: half its square; 0 for constant velocity.
  double ahead_s = 0.0, curved_s2 = 0.0;
  // A clock error moves the bearing in proportion to this velocity.
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
  std::int64_t state = 0;  // version of the filter's state to which this belongs
};

// about: the motion at which to linearise; nullopt for the current estimate.
ModelInnovation innovation_of(const InteractingModels& models, std::size_t which,
                              const BearingMeasurement& measurement, const RayFrame& frame,
                              const StationPart* station,
                              const std::optional<KinematicState>& about);

struct JudgedInnovation {
  double nis = std::numeric_limits<double>::infinity();
  // The noise variance that the bearing shows, relative to the assumed variance.
  double noise = 1.0;
};

// Judges the bearing with this white noise and number of models; nullopt if the target is behind
// the camera.
std::optional<JudgedInnovation> judge(const Innovation& seen, std::size_t models,
                                      const Eigen::Matrix2d& white, double gate_nis);

}  // namespace ols::fusion
