#include "edge/station/station_snapshot.h"

namespace ols::station {

StationSnapshot snapshot_of(const StationParts& parts) {
  const auto& [config, mode, pointing, target, follows, now_s] = parts;
  StationSnapshot snapshot;
  snapshot.state = mode.state();
  snapshot.overview = config.overview;
  snapshot.moves = config.moves;
  snapshot.lens = pointing.lens();
  if (const auto zoom = pointing.zoom_at(now_s)) {
    snapshot.focal_length_px = zoom->camera.fx_px;
    snapshot.focal_length_sd_px = zoom->focal_sd_px;
    snapshot.camera = zoom->camera;
  }
  snapshot.track_id = target.track_id();
  snapshot.angles = pointing.newest_angles();
  if (snapshot.angles) {
    snapshot.optical_axis = optical_axis(pointing.geometry(), pointing.angles_now());
  }
  snapshot.camera_ecef = camera_centre_ecef(pointing.geometry(), pointing.angles_now());
  if (target.last_output() && follows) {
    const auto& camera = pointing.geometry().camera;
    snapshot.belief = target.last_output()->belief;
    snapshot.target_offset_px =
        target.last_output()->pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  }
  snapshot.motion_disagrees = follows && target.motion_disagrees();
  snapshot.pose = pointing.pose();
  return snapshot;
}

video::VideoFrame seen_in(const camera::Frame& frame, const StationParts& parts) {
  video::VideoFrame seen;
  seen.gray = frame.gray;
  seen.track_id = parts.target.track_id();
  const auto angles = parts.pointing.angles_at(frame.mid_exposure_s, frame.stamp_sd_s);
  if (angles) seen.camera = parts.pointing.camera_at(*angles);
  const auto* output = parts.follows ? parts.target.output_of(frame.mid_exposure_s) : nullptr;
  if (output == nullptr) return seen;
  seen.box = output->box;
  seen.belief = output->belief;
  return seen;
}

void add(const LensCommand& command, lens::LensOrder& orders) {
  for (const lens::Axis axis : lens::kAxes) {
    const auto& value = command.values[axis];
    if (!value) continue;
    const double until_s = command.received_s + command.lease_s;
    orders.axes[axis] = command.is_rate ? lens::AxisOrder{std::nullopt, *value, until_s}
                                        : lens::AxisOrder{*value, 0.0, 0.0};
  }
}

}  // namespace ols::station
