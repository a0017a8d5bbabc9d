// The pictures of the simulated ONVIF camera for ols-bench-onvif: a landscape at the camera's true
// angles, or a scene that disturbs measurements.
#pragma once

#include <opencv2/core.hpp>
#include <random>

#include "geometry/sight.h"
#include "sim/world/panorama.h"

namespace ols::bench {

enum class Scene {
  kLandscape,
  kBlank,    // a sky without any structure
  kDrifts,   // everything in the picture moves, like clouds
  kPassing,  // for some seconds, a moving object covers most of the picture
  kTarget,   // the same with a fifth of the picture
};

// The station's geometry: a wide lens of a PTZ camera, 640 x 480.
StationGeometry ptz_geometry();

class OnvifPictures {
 public:
  OnvifPictures(Scene scene, std::uint64_t seed);
  cv::Mat draw(const PanTilt& angles, double time_s);

 private:
  void draw_landscape(const PanTilt& angles, cv::Mat& gray);

  Scene scene_;
  StationGeometry geometry_ = ptz_geometry();
  sim::Panorama panorama_;
  cv::RNG noise_;
  cv::Mat object_;
};

}  // namespace ols::bench
