// A body of the sky whose direction is known less well than a star's: a planet, the sun.
#include <Eigen/Geometry>
#include <algorithm>

#include "calibration/targets/place_seen.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The nuisance: along the equator and towards the pole, the same for all sightings.
class Body : public Target {
 public:
  Body(std::vector<SkyPosition> positions, double sd_rad)
      : positions_(std::move(positions)), sd_rad_(sd_rad) {}
  int unknowns() const override { return 2; }
  VectorXd prior_sd() const override { return VectorXd::Constant(2, sd_rad_); }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& off_rad) const override {
    const auto at = std::ranges::find_if(positions_, [&sighting](const SkyPosition& one) {
      return one.station == sighting.station && one.utime_us == sighting.utime_us;
    });
    const Vector3d& ecef = at->direction.ecef;
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = Vector3d::UnitZ().cross(ecef).normalized();
    axes.col(1) = ecef.cross(axes.col(0));
    TargetView view = sky_target(at->direction)->view(state, sighting, VectorXd(0));
    const Matrix3d R = R_enu_ecef(state, sighting);
    view.point.x += R * axes * off_rad;
    view.by_nuisance.setZero(4, 2);
    view.by_nuisance.topRows<3>() = R * axes;
    return view;
  }

 private:
  std::vector<SkyPosition> positions_;  // of all sightings
  double sd_rad_;
};

}  // namespace

TargetPtr body_target(std::vector<SkyPosition> positions, double sd_rad) {
  return std::make_shared<Body>(std::move(positions), sd_rad);
}

}  // namespace ols::calibration
