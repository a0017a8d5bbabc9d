// The angles of a camera at its pictures of still scenery, found from the pictures alone: how far a
// mount turned between them, whatever it reports. Pure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "geometry/sight.h"

namespace ols::calibration {

struct TurnedPicture {
  cv::Mat gray;
  PanTilt reported;    // may be wrong by a factor, its sign included
  bool moves = false;  // taken in motion
};

struct PictureAngles {
  // One for each picture, relative to the first picture that shares its view with others; the
  // angles of that one are taken as reported. nullopt where too little of the scenery is found
  // again.
  std::vector<std::optional<PanTilt>> angles;
  double rms_px = 0.0;  // of the points that agree
};

// Each picture taken at rest must share most of its view with an earlier one taken at rest, and
// each picture taken in motion with some picture taken at rest. `geometry`: its lens gives the
// scale of all angles.
PictureAngles angles_of_pictures(const StationGeometry& geometry,
                                 const std::vector<TurnedPicture>& pictures);

}  // namespace ols::calibration
