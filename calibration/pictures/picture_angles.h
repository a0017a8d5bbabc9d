// The angles of a camera at its pictures of still scenery, found from the pictures alone: what a
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
  // One for each picture, relative to the first that shares its view with others, whose angles are
  // taken as reported; nullopt where too little of the scenery is found again.
  std::vector<std::optional<PanTilt>> angles;
  double rms_px = 0.0;  // of the points that agree
};

// Each picture at rest must share most of its view with one at rest before it, each in motion with
// some picture at rest. `geometry`: its lens is the measure of all angles.
PictureAngles angles_of_pictures(const StationGeometry& geometry,
                                 const std::vector<TurnedPicture>& pictures);

}  // namespace ols::calibration
