// Images of a synthetic target in front of the simulator's landscape, with pixel noise.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "dev/bench/synthetic_target.h"
#include "edge/tracker/random.h"
#include "geometry/direction.h"
#include "sim/world/panorama.h"

namespace ols::bench {

// 50 mm focal length and pixels of 3.75 um: 1 px = 75 urad. No distortion. The field of view is 2.7
// by 2.2 degrees.
CameraIntrinsics bench_camera(cv::Size picture = {640, 512});

// The rotation from camera axes to east, north, up, for a camera without roll that points along
// `axis`.
Eigen::Matrix3d camera_rotation(const AzimuthElevation& axis);

// K R_2^T R_1 K^-1: maps pixels of an image taken at `from` to pixels of one taken at `to`.
Eigen::Matrix3d rotation_between(const CameraIntrinsics& camera, const AzimuthElevation& from,
                                 const AzimuthElevation& to);

enum class Backdrop { kBlankSky, kLandscape };

// The landscape. All cases share one, because making it takes a second.
class Landscape {
 public:
  explicit Landscape(const CameraIntrinsics& camera);

  cv::Mat1f backdrop(Backdrop kind, const AzimuthElevation& axis);
  double ridge_rad(double azimuth_rad) const { return panorama_.ridge_rad(azimuth_rad); }
  const CameraIntrinsics& camera() const { return camera_; }

 private:
  CameraIntrinsics camera_;
  sim::Panorama panorama_;
  cv::Mat drawn_;
};

// White noise of the pixels with standard deviation kNoiseSd, read from random positions of a long
// strip.
class PixelNoise {
 public:
  PixelNoise();
  // The image as the sensor returns it: with noise, and rounded to 8 bits.
  cv::Mat develop(const cv::Mat1f& picture, tracker::Random& random) const;

 private:
  cv::Mat1f strip_;
};

}  // namespace ols::bench
