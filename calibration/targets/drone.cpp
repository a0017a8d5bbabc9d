// A drone whose positions are recorded (RTK): its antenna is off by a constant.
#include "calibration/targets/place_seen.h"
#include "calibration/trajectory.h"

namespace ols::calibration {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

class Drone : public Target {
 public:
  explicit Drone(const Trajectory& trajectory) : trajectory_(trajectory) {}
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override {
    constexpr double kAntenna_m = 0.1;
    return VectorXd::Constant(3, kAntenna_m);
  }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& offset_ecef) const override {
    const Motion motion = motion_at(trajectory_, static_cast<double>(sighting.utime_us));
    TargetView view = place_seen(state, sighting, motion.ecef + offset_ecef);
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.topRows<3>() = R_enu_ecef(state, sighting);
    view.white_sd_m = trajectory_.sd_m;
    return view;
  }

 private:
  Trajectory trajectory_;
};

}  // namespace

TargetPtr drone_target(const Trajectory& trajectory) { return std::make_shared<Drone>(trajectory); }

}  // namespace ols::calibration
