// An aircraft that announces its own positions: the adjustment solves for its latency and a
// constant offset.
#include <Eigen/Geometry>

#include "calibration/targets/place_seen.h"
#include "calibration/trajectory.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

class Aircraft : public Target {
 public:
  explicit Aircraft(const Trajectory& trajectory) : trajectory_(trajectory) {}
  int unknowns() const override { return 4; }
  VectorXd prior_sd() const override {
    constexpr double kLatency_s = 1.0;
    const double sd = trajectory_.sd_m;
    return Eigen::Vector4d(sd, sd, sd, kLatency_s);
  }
  // The position of an instant is announced with a later time.
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& nuisance) const override {
    constexpr double kMicrosecond_s = 1e-6;
    const double utime_us = static_cast<double>(sighting.utime_us) + nuisance[3] / kMicrosecond_s;
    const Motion motion = motion_at(trajectory_, utime_us);
    const Vector3d up = motion.ecef.normalized();
    const Vector3d across = motion.velocity_ecef.cross(up).normalized();
    Matrix3d axes;
    axes << up.cross(across), across, up;
    TargetView view = place_seen(state, sighting, motion.ecef + axes * nuisance.head<3>());
    const Matrix3d R = R_enu_ecef(state, sighting);
    view.by_nuisance.setZero(4, 4);
    view.by_nuisance.topLeftCorner<3, 3>() = R * axes;
    view.by_nuisance.col(3).head<3>() = R * motion.velocity_ecef;
    return view;
  }

 private:
  Trajectory trajectory_;
};

}  // namespace

TargetPtr aircraft_target(const Trajectory& trajectory) {
  return std::make_shared<Aircraft>(trajectory);
}

}  // namespace ols::calibration
