// Fits the direction of one photograph to the skyline of the land by least squares, from a start
// that is right to about half a degree. Pure.
//
// The model of the differences is that of skyline_heading.h, for a camera whose focal length and
// first coefficient of distortion are uncertain, too. A column of the picture that disagrees with
// the rest (a tree, a cloud, a crest in haze) counts less, the more it disagrees.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "edge/skyline/picture_search.h"

namespace ols::skyline {

struct PictureFit {
  PicturePose pose;
  PicturePose sd;           // 1-sigmas
  CameraIntrinsics camera;  // with the fitted focal length and distortion
  int expected = 0;         // strips in which the land's skyline is inside the picture
  int found = 0;            // of them, those with a clear edge near it
  int agreeing = 0;         // of those, the ones within three of their sigmas
};

// `gray`: 8 bit, one channel. nullopt if there are too few edges near the expected skyline, or if
// the fit does not converge.
std::optional<PictureFit> fit_picture(const cv::Mat& gray, const CameraIntrinsics& camera,
                                      const land::HorizonMap& map, const PicturePrior& prior,
                                      const PicturePose& start);

}  // namespace ols::skyline
