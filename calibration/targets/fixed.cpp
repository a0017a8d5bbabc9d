// A surveyed place, such as a landmark.
#include "calibration/targets/place_seen.h"

namespace ols::calibration {
namespace {

using Eigen::VectorXd;

class Fixed : public Target {
 public:
  explicit Fixed(const FixedPoint& point) : point_(point) {}
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override { return VectorXd::Constant(3, point_.sd_m); }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& off_ecef) const override {
    TargetView view = place_seen(state, sighting, point_.ecef + off_ecef);
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.topRows<3>() = R_enu_ecef(state, sighting);
    return view;
  }

 private:
  FixedPoint point_;
};

}  // namespace

TargetPtr fixed_target(const FixedPoint& point) { return std::make_shared<Fixed>(point); }

}  // namespace ols::calibration
