#include "calibration/targets/place_seen.h"

#include "calibration/refraction.h"

namespace ols::calibration {

using Eigen::Vector3d;

TargetView place_seen(const State& state, const Sighting& sighting, const Vector3d& ecef) {
  const StationState& station = state.stations[sighting.station];
  TargetView view;
  view.point = {frame_of(station).to_enu(ecef), 1.0};
  view.by_refraction = terrestrial_lift_m(view.point.x);
  view.point.x += station.refraction * view.by_refraction;
  return view;
}

Eigen::Matrix3d R_enu_ecef(const State& state, const Sighting& sighting) {
  return frame_of(state.stations[sighting.station]).R_ecef_enu().transpose();
}

}  // namespace ols::calibration
