// Finds the direction of one photograph by the skyline of the land. Pure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "edge/skyline/picture_fit.h"

namespace ols::skyline {

struct PictureHeading {
  // The best direction; nullopt if the picture shows no skyline that could be one of the land.
  std::optional<PictureFit> fit;
  // Why the picture does not determine the heading, as a sentence; empty: it does.
  std::string doubt;
  // How much the evidence for this heading exceeds that for any other.
  double lead = 0.0;
};

// How far one may have seen, if the land is known to `reach_m`: haze hides the land beyond.
std::vector<double> visibilities_m(double reach_m);

// `picture`: 8 bit, blue, green, red; sky above, by day. `camera`: of the whole picture. `maps`: of
// the same place, one for each distance that one may have seen. Throws std::invalid_argument if the
// picture shows less than a cell of the search.
PictureHeading picture_heading(const cv::Mat& picture, const CameraIntrinsics& camera,
                               std::span<const land::HorizonMap> maps, const PicturePrior& prior);

}  // namespace ols::skyline
