// Another station of the site, as a target.
#include "calibration/targets/place_seen.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

class OtherStation : public Target {
 public:
  explicit OtherStation(std::size_t station) : station_(station) {}
  std::optional<std::size_t> on_station() const override { return station_; }
  TargetView view(const State& state, const Sighting& sighting, const VectorXd&) const override {
    const StationModel& other = state.stations[station_].model;
    const LocalFrame there = frame_of(state.stations[station_]);
    const auto poses = joints(other.geometry.chain, {});
    const Vector3d axes = poses[static_cast<std::size_t>(Joint::kAzi)].translation();
    TargetView view = place_seen(state, sighting, there.to_ecef(axes));
    view.by_position = R_enu_ecef(state, sighting) * there.R_ecef_enu();
    return view;
  }

 private:
  std::size_t station_;
};

}  // namespace

TargetPtr station_target(std::size_t station) { return std::make_shared<OtherStation>(station); }

}  // namespace ols::calibration
