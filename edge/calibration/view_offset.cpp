#include "edge/calibration/view_offset.h"

#include <cmath>

#include "calibration/pictures/view_registration.h"

namespace ols::station {

std::optional<ViewOffset> offset_of(const View& stored, const View& seen,
                                    const StationGeometry& geometry, double angle_sd_rad) {
  const auto moved = calibration::register_view(stored.gray, seen.gray);
  if (!moved) return std::nullopt;
  const ChainParameters& chain = geometry.chain;
  const auto shafts = [&chain](const PanTilt& reported) {
    return PanTilt{chain.pan_sign * reported.pan_rad + chain.pan_zero_rad,
                   chain.tilt_sign * reported.tilt_rad + chain.tilt_zero_rad};
  };
  ViewOffset offset;
  offset.shafts = shafts(stored.reported);
  const PanTilt now = shafts(seen.reported);
  // A camera that turns to the left sees the scene move to the right.
  offset.left_rad = moved.shift_px.x() / geometry.camera.fx_px -
                    (now.pan_rad - offset.shafts.pan_rad) * std::cos(offset.shafts.tilt_rad);
  offset.up_rad =
      moved.shift_px.y() / geometry.camera.fy_px - (now.tilt_rad - offset.shafts.tilt_rad);
  offset.sd_rad = std::hypot(moved.sd_px / geometry.camera.fx_px, angle_sd_rad);
  return offset;
}

}  // namespace ols::station
