#include "central/filter/innovation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

// The contribution of the target's own states.
void see_target(const FilterCovariance& P, ModelInnovation& seen) {
  Eigen::Matrix3d position = P.square<3>(0);
  if (seen.by_velocity_s != 0.0) {
    const Matrix9 all = P.square<9>(0);
    const Eigen::Matrix<double, 9, 3> then = all.leftCols<3>() +
                                             seen.by_velocity_s * all.middleCols<3>(3) +
                                             seen.by_acceleration_s2 * all.rightCols<3>();
    position = then.topRows<3>() + seen.by_velocity_s * then.middleRows<3>(3) +
               seen.by_acceleration_s2 * then.bottomRows<3>();
  }
  seen.covariance = seen.J * position * seen.J.transpose();
}

// That of the station's states.
void see_station(const FilterGaussian& state, const StationPart& part, ModelInnovation& seen) {
  const Eigen::Index pose = part.first, place = part.first + kPoseStates;
  const FilterCovariance& P = state.covariance;
  const auto with_target = [&]<int K>(const Eigen::Matrix<double, 2, K>& H, Eigen::Index at) {
    Eigen::Matrix<double, K, 3> then = P.block<K, 3>(at, 0);
    if (seen.by_velocity_s != 0.0) {
      then += seen.by_velocity_s * P.block<K, 3>(at, 3) +
              seen.by_acceleration_s2 * P.block<K, 3>(at, 6);
    }
    return Eigen::Matrix2d(H * then * seen.J.transpose());
  };
  seen.by_pose << part.by_rotation, -seen.J * seen.velocity;
  Eigen::Matrix2d mixed = with_target(seen.by_pose, pose);
  seen.residual -= seen.by_pose * state.mean.segment<kPoseStates>(pose);
  seen.covariance += seen.by_pose * P.square<kPoseStates>(pose) * seen.by_pose.transpose();
  if (part.has_place) {
    seen.by_place = -seen.J * part.R_ecef_enu;
    seen.residual -= seen.by_place * state.mean.segment<kPlaceStates>(place);
    seen.covariance += seen.by_place * P.square<kPlaceStates>(place) * seen.by_place.transpose();
    mixed += with_target(seen.by_place, place);
    mixed +=
        seen.by_place * P.block<kPlaceStates, kPoseStates>(place, pose) * seen.by_pose.transpose();
  }
  seen.covariance += mixed + mixed.transpose();
}

}  // namespace

FilterMatrix2 ModelInnovation::cross(const FilterCovariance& P,
                                     const std::optional<StationPart>& part) const {
  FilterMatrix2 result = FilterMatrix2::Zero(P.rows(), 2);
  add_product<3>(P, 0, J, result);
  if (by_velocity_s != 0.0) {
    add_product<3>(P, 3, by_velocity_s * J, result);
    add_product<3>(P, 6, by_acceleration_s2 * J, result);
  }
  if (!part) return result;
  add_product<kPoseStates>(P, part->first, by_pose, result);
  if (part->has_place) add_product<kPlaceStates>(P, part->first + kPoseStates, by_place, result);
  return result;
}

Innovation Innovation::after_prediction() const {
  Innovation then = *this;
  ++then.state;  // the prediction is a change of it
  for (ModelInnovation& model : then.models) model.by_velocity_s = model.by_acceleration_s2 = 0.0;
  return then;
}

ModelInnovation innovation_of(const InteractingModels& models, std::size_t which,
                              const BearingMeasurement& measurement, const RayFrame& frame,
                              const StationPart* station,
                              const std::optional<KinematicState>& about) {
  const FilterGaussian& model = models[which];
  const auto p = model.mean.head<3>(), v = model.mean.segment<3>(3), a = model.mean.segment<3>(6);
  ModelInnovation result;
  const Transition to = models.transition_to(which, measurement.utime_us);
  result.by_velocity_s = to.f(0, 1);
  result.by_acceleration_s2 = to.f(0, 2);
  result.velocity = to.f(1, 1) * v + to.f(1, 2) * a;
  if (about) result.velocity = about->mean.segment<3>(3);
  const Eigen::Vector3d p_ecef = p + result.by_velocity_s * v + result.by_acceleration_s2 * a;
  const Eigen::Vector3d about_ecef = about ? position_at(*about, measurement.utime_us) : p_ecef;
  const Eigen::Vector3d line = about_ecef - measurement.sight.origin_ecef;
  result.depth_m = frame.direction.dot(line);
  if (!(result.depth_m > 0.0)) return result;
  result.residual = -frame.tangent.transpose() * line / result.depth_m;
  result.J =
      (frame.tangent.transpose() + result.residual * frame.direction.transpose()) / result.depth_m;
  result.residual -= result.J * (p_ecef - about_ecef);
  see_target(model.covariance, result);
  result.covariance += to.q(0, 0) * result.J * to.directions * result.J.transpose();
  if (station != nullptr) see_station(model, *station, result);
  return result;
}

std::optional<JudgedInnovation> judge(const Innovation& seen, std::size_t models,
                                      const Eigen::Matrix2d& white, double gate_nis) {
  JudgedInnovation judged;
  double squared = 0.0, expected = 0.0;  // of the part of the residual that is noise
  for (std::size_t m = 0; m < models; ++m) {
    const ModelInnovation& own = seen.models[m];
    if (!(own.depth_m > 0.0)) return std::nullopt;
    const Eigen::LLT<Eigen::Matrix2d> S(own.covariance + white);
    const Eigen::Vector2d scaled = S.solve(own.residual);
    const double here = own.residual.dot(scaled);
    if (here >= judged.nis) continue;
    judged.nis = here;
    squared = scaled.dot(white * scaled);
    expected = S.solve(white).trace();
  }
  // A far outlier counts as one at the gate (Huber): if the noise is many times the stated one,
  // most are there, and the others alone would never show it.
  squared *= std::min(1.0, gate_nis / judged.nis);
  judged.noise = 1.0 + (squared - expected) / 2.0;
  return judged;
}

}  // namespace ols::fusion
