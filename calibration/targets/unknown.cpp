// An object that several stations see at once and whose place nobody knows.
#include <Eigen/LU>

#include "calibration/targets/place_seen.h"
#include "geometry/direction.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

class Unknown : public Target {
 public:
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override { return VectorXd::Constant(3, kNoPrior); }
  // Where the lines of sight are nearest to each other.
  VectorXd initial(const State& state, const std::vector<Sighting>& sightings) const override {
    Matrix3d N = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero(), centre = Vector3d::Zero();
    for (const Sighting& one : sightings) centre += origin(state, one);
    centre /= static_cast<double>(sightings.size());
    for (const Sighting& one : sightings) {
      const StationState& station = state.stations[one.station];
      const auto seen = predict_direction(station.model, one.reading, one.pixel);
      if (!seen) continue;
      const Vector3d d =
          frame_of(station).R_ecef_enu() * enu_from_azimuth_elevation(seen->direction);
      const Matrix3d across = Matrix3d::Identity() - d * d.transpose();
      N += across;
      b += across * (origin(state, one) - centre);
    }
    // Lines that are nearly parallel meet at some kilometres rather than anywhere.
    constexpr double kWeak = 1e-9;
    N += kWeak * Matrix3d::Identity();
    return centre + N.inverse() * b;
  }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& ecef) const override {
    TargetView view = place_seen(state, sighting, ecef);
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.topRows<3>() = R_enu_ecef(state, sighting);
    return view;
  }

 private:
  static Vector3d origin(const State& state, const Sighting& one) {
    return frame_of(state.stations[one.station]).origin_ecef();
  }
};

}  // namespace

TargetPtr unknown_target() { return std::make_shared<Unknown>(); }

}  // namespace ols::calibration
