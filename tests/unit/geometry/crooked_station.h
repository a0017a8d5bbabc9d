// Random stations with errors in every parameter.
#pragma once

#include <random>

#include "geometry/angles.h"
#include "geometry/pixel_prediction.h"

namespace ols::test {

inline StationModel crooked(std::mt19937& random, LensModel lens = LensModel::kPinhole) {
  std::normal_distribution<double> normal;
  StationModel model;
  model.geometry.position = {radians(49.2), radians(16.6), 300.0};
  ChainParameters& chain = model.geometry.chain;
  chain.heading_rad = radians(123.0);
  CameraIntrinsics& camera = model.geometry.camera;
  camera.model = lens;
  if (lens != LensModel::kPinhole) camera.fx_px = camera.fy_px = 700.0;
  chain.azi_to_ele_m = {0.01, -0.02, 0.03};
  chain.pan_sign = normal(random) > 0.0 ? 1 : -1;
  chain.tilt_sign = normal(random) > 0.0 ? 1 : -1;
  chain.pan_zero_rad = 0.3;
  chain.tilt_zero_rad = -0.05;
  ModelParameters by;
  for (int k = 0; k < kModelParameters; ++k) by[k] = 3e-3 * normal(random);
  by[kFocal] *= 1e4;
  by[kCx] *= 1e4;
  by[kCy] *= 1e4;
  by[kK1] *= 20.0;
  by[kK2] *= 100.0;
  return changed(model, by);
}

inline UnitReading some_reading(std::mt19937& random) {
  std::uniform_real_distribution<double> pan(-49000.0, 49000.0), tilt(-2000.0, 9000.0);
  return {{pan(random), 4000.0, -1}, {tilt(random), -900.0, 1}};
}

// A target that is seen at this pixel. `w`: its inverse distance.
inline HomogeneousPoint seen_at(const StationModel& model, const UnitReading& reading,
                                const Eigen::Vector2d& pixel, double w) {
  const Eigen::Isometry3d camera =
      enu_from_camera(model.geometry.chain, corrected_angles(model, reading));
  const Eigen::Vector3d ray = camera.linear() * *unproject(model.geometry.camera, pixel);
  return {ray + w * camera.translation(), w};
}

}  // namespace ols::test
