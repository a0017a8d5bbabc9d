// A point of the scenery whose place nobody knows, as a sweep finds them.
#include <cmath>

#include "calibration/target.h"
#include "geometry/direction.h"

namespace ols::calibration {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// The nuisance: azimuth, elevation and inverse distance [1/m].
class Scene : public Target {
 public:
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override {
    // Nothing of a sweep is much nearer than this.
    constexpr double kNear_m = 50.0;
    return Vector3d(kNoPrior, kNoPrior, 1.0 / kNear_m);
  }
  VectorXd initial(const State& state, const std::vector<Sighting>& sightings) const override {
    const Sighting& first = sightings.front();
    const auto seen =
        predict_direction(state.stations[first.station].model, first.reading, first.pixel);
    if (!seen) return Vector3d::Zero();
    return Vector3d(seen->direction.azimuth_rad, seen->direction.elevation_rad, 0.0);
  }
  TargetView view(const State&, const Sighting&, const VectorXd& nuisance) const override {
    const AzimuthElevation direction{nuisance[0], nuisance[1]};
    const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(direction);
    TargetView view;
    view.moves_with_us = true;
    view.point = {enu_from_azimuth_elevation(direction), nuisance[2]};
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.col(0).head<3>() = tangent.col(0) * std::cos(nuisance[1]);
    view.by_nuisance.col(1).head<3>() = tangent.col(1);
    view.by_nuisance(3, 2) = 1.0;
    return view;
  }
};

}  // namespace

TargetPtr scene_target() { return std::make_shared<Scene>(); }

}  // namespace ols::calibration
