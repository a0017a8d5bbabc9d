#include "geometry/station_model.h"

#include <cmath>

#include "geometry/angles.h"

namespace ols {
namespace {

void change_axis(AxisModel& axis, const ModelParameters& by, bool is_pan) {
  axis.cos1_rad += by[is_pan ? kPanCos1 : kTiltCos1];
  axis.sin1_rad += by[is_pan ? kPanSin1 : kTiltSin1];
  axis.worm_cos_rad += by[is_pan ? kPanWormCos : kTiltWormCos];
  axis.worm_sin_rad += by[is_pan ? kPanWormSin : kTiltWormSin];
  axis.backlash_rad += by[is_pan ? kPanBacklash : kTiltBacklash];
  if (!is_pan) return;
  axis.cos2_rad += by[kPanCos2];
  axis.sin2_rad += by[kPanSin2];
}

void change_camera(CameraIntrinsics& camera, const ModelParameters& by) {
  const double aspect = camera.fy_px / camera.fx_px + by[kAspect];
  camera.fx_px += by[kFocal];
  camera.fy_px = camera.fx_px * aspect;
  camera.cx_px += by[kCx];
  camera.cy_px += by[kCy];
  camera.k1 += by[kK1];
  camera.k2 += by[kK2];
  camera.k3 += by[kK3];
  camera.k4 += by[kK4];
}

}  // namespace

ShaftAngle shaft_angle(const AxisModel& axis, int sign, double zero_rad, const AxisReading& reading,
                       double exposure_offset_s) {
  const double counts = reading.counts + reading.counts_per_s * exposure_offset_s;
  const double turns = counts / static_cast<double>(axis.counts_per_turn);
  const double t = sign * 2.0 * kPi * turns + zero_rad;
  const double m = axis.worm_teeth;
  ShaftAngle shaft;
  shaft.nominal_rad = t;
  shaft.rad = t + axis.cos1_rad * std::cos(t) + axis.sin1_rad * std::sin(t) +
              axis.cos2_rad * std::cos(2.0 * t) + axis.sin2_rad * std::sin(2.0 * t) +
              axis.worm_cos_rad * std::cos(m * t) + axis.worm_sin_rad * std::sin(m * t) +
              0.5 * axis.backlash_rad * reading.approach;
  shaft.by_nominal =
      1.0 - axis.cos1_rad * std::sin(t) + axis.sin1_rad * std::cos(t) -
      2.0 * axis.cos2_rad * std::sin(2.0 * t) + 2.0 * axis.sin2_rad * std::cos(2.0 * t) -
      m * axis.worm_cos_rad * std::sin(m * t) + m * axis.worm_sin_rad * std::cos(m * t);
  return shaft;
}

PanTilt corrected_angles(const StationModel& model, const UnitReading& reading) {
  const ChainParameters& chain = model.geometry.chain;
  const double offset_s = model.exposure_offset_s;
  const ShaftAngle pan =
      shaft_angle(model.pan, chain.pan_sign, chain.pan_zero_rad, reading.pan, offset_s);
  const ShaftAngle tilt =
      shaft_angle(model.tilt, chain.tilt_sign, chain.tilt_zero_rad, reading.tilt, offset_s);
  return {chain.pan_sign * (pan.rad - chain.pan_zero_rad),
          chain.tilt_sign * (tilt.rad - chain.tilt_zero_rad)};
}

StationModel changed(const StationModel& model, const ModelParameters& by) {
  StationModel result = model;
  change_camera(result.geometry.camera, by);
  change_axis(result.pan, by, true);
  change_axis(result.tilt, by, false);
  result.exposure_offset_s += by[kExposureOffset];
  ChainParameters& chain = result.geometry.chain;
  chain.mount_z_rad += by[kMountZ];
  chain.mount_x_rad += by[kMountX];
  chain.mount_y_rad += by[kMountY];
  chain.trunnion_rad += by[kTrunnion];
  chain.heading_rad += by[kHeading];
  chain.tilt_x_rad += by[kTiltX];
  chain.tilt_y_rad += by[kTiltY];
  const Eigen::Vector3d shift_enu = by.segment<3>(kEast);
  if (!shift_enu.isZero(0.0)) {
    Geodetic& position = result.geometry.position;
    position = geodetic_from_ecef(LocalFrame(position).to_ecef(shift_enu));
  }
  return result;
}

}  // namespace ols
