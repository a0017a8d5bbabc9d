// A star: a direction that is known without error.
#include "calibration/targets/place_seen.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::VectorXd;

class Sky : public Target {
 public:
  explicit Sky(const SkyDirection& direction) : direction_(direction) {}
  TargetView view(const State& state, const Sighting& sighting, const VectorXd&) const override {
    const Matrix3d R = R_enu_ecef(state, sighting);
    TargetView view;
    view.by_air = R * direction_.by_air;
    view.by_ut1 = R * direction_.by_ut1;
    const double air = state.stations[sighting.station].air - 1.0;
    view.point.x = R * direction_.ecef + air * view.by_air + state.ut1_s * view.by_ut1;
    return view;
  }

 private:
  SkyDirection direction_;
};

}  // namespace

TargetPtr sky_target(const SkyDirection& direction) { return std::make_shared<Sky>(direction); }

}  // namespace ols::calibration
