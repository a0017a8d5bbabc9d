#include "central/filter/innovation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

// The contribution of the target's own states.
void see_target(const FilterMatrix& P, ModelInnovation& seen) {
  Eigen::Matrix3d position = whole_block<3>(P, 0);
  if (seen.ahead_s != 0.0) {
    const Matrix9 all = whole_block<9>(P, 0);
    const Eigen::Matrix<double, 9, 3> then = all.leftCols<3>() +
                                             seen.ahead_s * all.middleCols<3>(3) +
                                             seen.curved_s2 * all.rightCols<3>();
    position = then.topRows<3>() + seen.ahead_s * then.middleRows<3>(3) +
               seen.curved_s2 * then.bottomRows<3>();
  }
  seen.covariance = seen.J * position * seen.J.transpose();
}

// That of the station's states.
void see_station(const FilterGaussian& state, const StationPart& part, ModelInnovation& seen) {
  const Eigen::Index pose = part.first, place = part.first + kPoseStates;
  const FilterMatrix& P = state.covariance;
  const auto with_target = [&]<int K>(const Eigen::Matrix<double, 2, K>& H, Eigen::Index at) {
    Eigen::Matrix<double, K, 3> then = P.block<K, 3>(at, 0);
    if (seen.ahead_s != 0.0) {
      then += seen.ahead_s * P.block<K, 3>(at, 3) + seen.curved_s2 * P.block<K, 3>(at, 6);
    }
    return Eigen::Matrix2d(H * then * seen.J.transpose());
  };
  seen.by_pose << part.by_rotation, -seen.J * seen.velocity, Eigen::Vector2d::UnitY();
  Eigen::Matrix2d mixed = with_target(seen.by_pose, pose);
  seen.residual -= seen.by_pose * state.mean.segment<kPoseStates>(pose);
  seen.covariance += seen.by_pose * whole_block<kPoseStates>(P, pose) * seen.by_pose.transpose();
  if (part.has_place) {
    seen.by_place = -seen.J * part.R_ecef_enu;
    seen.residual -= seen.by_place * state.mean.segment<kPlaceStates>(place);
    seen.covariance +=
        seen.by_place * whole_block<kPlaceStates>(P, place) * seen.by_place.transpose();
    mixed += with_target(seen.by_place, place);
    mixed +=
        seen.by_place * P.block<kPlaceStates, kPoseStates>(place, pose) * seen.by_pose.transpose();
  }
  seen.covariance += mixed + mixed.transpose();
}

}  // namespace

FilterMatrix2 ModelInnovation::cross(const FilterMatrix& P,
                                     const std::optional<StationPart>& part) const {
  FilterMatrix2 result = FilterMatrix2::Zero(P.rows(), 2);
  add_product<3>(P, 0, J, result);
  if (ahead_s != 0.0) {
    add_product<3>(P, 3, ahead_s * J, result);
    add_product<3>(P, 6, curved_s2 * J, result);
  }
  if (!part) return result;
  add_product<kPoseStates>(P, part->first, by_pose, result);
  if (part->has_place) add_product<kPlaceStates>(P, part->first + kPoseStates, by_place, result);
  return result;
}

ModelInnovation innovation_of(const InteractingModels& models, std::size_t which,
                              const BearingMeasurement& measurement, const RayFrame& frame,
                              const StationPart* station,
                              const std::optional<KinematicState>& about) {
  const Motion motion = models.motion(which);
  const FilterGaussian& model = models[which];
  ModelInnovation result;
  result.ahead_s = seconds(measurement.utime_us - models.utime_us());  // < 0: late
  if (motion != Motion::kConstantVelocity) result.curved_s2 = std::pow(result.ahead_s, 2) / 2.0;
  result.velocity = model.mean.segment<3>(3);
  if (about) result.velocity = about->mean.segment<3>(3);
  const Eigen::Vector3d p_ecef = model.mean.head<3>() + result.ahead_s * model.mean.segment<3>(3) +
                                 result.curved_s2 * model.mean.segment<3>(6);
  const Eigen::Vector3d about_ecef = about ? position_at(*about, measurement.utime_us) : p_ecef;
  const Eigen::Vector3d line = about_ecef - measurement.sight.origin_ecef;
  result.depth_m = frame.direction.dot(line);
  if (!(result.depth_m > 0.0)) return result;
  result.residual = -frame.tangent.transpose() * line / result.depth_m;
  result.J =
      (frame.tangent.transpose() + result.residual * frame.direction.transpose()) / result.depth_m;
  result.residual -= result.J * (p_ecef - about_ecef);
  see_target(model.covariance, result);
  if (result.ahead_s != 0.0) {
    const Transition between =
        transition(motion, model.mean.head<9>(), std::abs(result.ahead_s), models.config());
    result.covariance += between.q(0, 0) * result.J * between.directions * result.J.transpose();
  }
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
