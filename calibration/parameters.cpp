#include "calibration/parameters.h"

#include "calibration/observation.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr double kArcsec = kPi / 648000.0;

constexpr std::array<const char*, 12> kKinds{"landmark",     "star",       "sun",   "scene",
                                             "station",      "aircraft",   "drone", "track",
                                             "inclinometer", "level_line", "cross", "ruler"};

}  // namespace

const char* name(Kind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

std::optional<Kind> kind_of(const std::string& name) {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (name == kKinds[i]) return static_cast<Kind>(i);
  }
  return std::nullopt;
}

const std::array<ParameterText, kStationParameters>& parameter_texts() {
  constexpr double kEccentricity = 40.0 * kArcsec, kWorm = 10.0 * kArcsec,
                   kBacklash = 20.0 * kArcsec, kMount = 360.0 * kArcsec;
  // The setup's have no such deviation: the station's configuration states them.
  static const std::array<ParameterText, kStationParameters> texts{{
      {"focal_px", false, 40.0, "Focal length along x over the pixel pitch."},
      {"aspect", false, 1e-4, "Focal length along y over that along x."},
      {"cx_px", false, 20.0, "Principal point."},
      {"cy_px", false, 20.0, "Principal point."},
      {"k1", false, 0.05, "Radial distortion, second order."},
      {"k2", false, 0.5, "Radial distortion, fourth order."},
      {"mount_z_deg", true, kMount, "Rotation of the camera on the unit about Z."},
      {"mount_x_deg", true, 2.0 * kMount, "Rotation of the camera on the unit about X (roll)."},
      {"mount_y_deg", true, kMount, "Rotation of the camera on the unit about Y."},
      {"trunnion_deg", true, 60.0 * kArcsec, "Tilt axis not square to the pan axis."},
      {"pan_cos1_deg", true, kEccentricity, "Eccentricity of the pan axis, cos."},
      {"pan_sin1_deg", true, kEccentricity, "Eccentricity of the pan axis, sin."},
      {"pan_cos2_deg", true, kEccentricity, "Second harmonic of the pan axis, cos."},
      {"pan_sin2_deg", true, kEccentricity, "Second harmonic of the pan axis, sin."},
      {"pan_worm_cos_deg", true, kWorm, "Error of a turn of the pan worm, cos."},
      {"pan_worm_sin_deg", true, kWorm, "Error of a turn of the pan worm, sin."},
      {"pan_backlash_deg", true, kBacklash, "Backlash of pan."},
      {"tilt_cos1_deg", true, kEccentricity, "Eccentricity of the tilt axis, cos."},
      {"tilt_sin1_deg", true, kEccentricity, "Eccentricity of the tilt axis, sin."},
      {"tilt_worm_cos_deg", true, kWorm, "Error of a turn of the tilt worm, cos."},
      {"tilt_worm_sin_deg", true, kWorm, "Error of a turn of the tilt worm, sin."},
      {"tilt_backlash_deg", true, kBacklash, "Backlash of tilt."},
      {"exposure_offset_s", false, 2e-3, "Exposure later than the stamp of the unit's counts."},
      {"k3", false, 0.0, "Radial distortion, sixth order; of a radial lens, its third term."},
      {"k4", false, 0.0, "Fourth term of a radial lens."},
      {"heading_deg", true, 0.0, "Direction of zero pan, clockwise from true north."},
      {"tilt_x_deg", true, 0.0, "Inclination of ORIGIN about X."},
      {"tilt_y_deg", true, 0.0, "Inclination of ORIGIN about Y."},
      {"east_m", false, 0.0, "Correction of the position."},
      {"north_m", false, 0.0, "Correction of the position."},
      {"up_m", false, 0.0, "Correction of the position."},
      {"refraction_k", false, 0.3, "Coefficient of terrestrial refraction."},
      {"air", false, 0.01, "Astronomical refraction over that of the stated air."},
  }};
  return texts;
}

double from_file(int parameter, double value) {
  return parameter_texts().at(static_cast<std::size_t>(parameter)).is_angle ? radians(value)
                                                                            : value;
}

double to_file(int parameter, double value) {
  return parameter_texts().at(static_cast<std::size_t>(parameter)).is_angle ? degrees(value)
                                                                            : value;
}

InstrumentVector instrument_of(const StationModel& model) {
  const CameraIntrinsics& camera = model.geometry.camera;
  const ChainParameters& chain = model.geometry.chain;
  const AxisModel &pan = model.pan, &tilt = model.tilt;
  InstrumentVector v;
  v << camera.fx_px, camera.fy_px / camera.fx_px, camera.cx_px, camera.cy_px, camera.k1, camera.k2,
      chain.mount_z_rad, chain.mount_x_rad, chain.mount_y_rad, chain.trunnion_rad, pan.cos1_rad,
      pan.sin1_rad, pan.cos2_rad, pan.sin2_rad, pan.worm_cos_rad, pan.worm_sin_rad,
      pan.backlash_rad, tilt.cos1_rad, tilt.sin1_rad, tilt.worm_cos_rad, tilt.worm_sin_rad,
      tilt.backlash_rad, model.exposure_offset_s, camera.k3, camera.k4;
  return v;
}

}  // namespace ols::calibration
