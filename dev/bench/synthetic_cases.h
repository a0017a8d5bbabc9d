// The cases of the synthetic tracker benchmark: sweeps, each of which varies one property, and
// events.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dev/bench/synthetic_scene.h"

namespace ols::bench {

enum class CameraPath {
  kTurning,   // turns at a constant rate in azimuth; the target's path in the image stays the same
  kSwinging,  // turns to and fro; a target at rest in the sky crosses the image
};
enum class TargetPath {
  kCircle,    // in the image
  kVertical,  // up and down across the middle of the image
  kStill,     // at rest in the world
};

struct BenchCase {
  std::string sweep;
  double value = 0.0;  // of the property that the sweep varies
  TargetLook look;
  Backdrop backdrop = Backdrop::kBlankSky;
  CameraPath camera_path = CameraPath::kTurning;
  TargetPath target_path = TargetPath::kCircle;
  double speed_px_s = 40.0;     // of the target in the image
  double growth_per_s = 0.0;    // relative growth of the target's size
  double pan_rate_deg_s = 0.0;  // of the camera
  double elevation_deg = 0.0;   // of the camera; at 0 it sees woods, without a ridge line
  bool on_ridge = false;      // true: the camera points at the ridge line instead of elevation_deg
  bool angles_given = false;  // true: the tracker gets the homography from the PTU's angles
  std::optional<double> hidden_from_s;  // the target is hidden for kHidden_s from this time on
  double seconds = 2.0;
};

inline constexpr double kHidden_s = 1.0;
inline constexpr double kFrameInterval_s = 1.0 / 30.0;
inline constexpr double kExposure_s = 0.002;
inline constexpr double kAngleSd_rad =
    25e-6;  // 1-sigma of the PTU's angles in each frame: a third of a pixel

std::vector<BenchCase> bench_cases();

// One run of a case, with its random values.
class BenchPath {
 public:
  BenchPath(const BenchCase& which, const Landscape& landscape, tracker::Random& random);

  AzimuthElevation camera(double time_s) const;
  Eigen::Vector2d target_px(double time_s) const;
  Eigen::Vector2d smear_px(double time_s) const;
  bool hidden(double time_s) const;
  double growth(double time_s) const;
  double camera_smear_px() const;

 private:
  BenchCase case_;
  CameraIntrinsics camera_model_;
  AzimuthElevation axis_;       // direction of the camera at the beginning
  Eigen::Vector3d stands_enu_;  // the target's place, for TargetPath::kStill
  Eigen::Vector2d middle_px_;
  double phase_rad_ = 0.0;
};

}  // namespace ols::bench
