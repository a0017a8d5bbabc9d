// Computes from pictures of still scenery how far a mount has turned between the pictures. The
// angles that the mount reports may be wrong. Pure.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "geometry/sight.h"

namespace ols::calibration {

struct TurnedPicture {
  cv::Mat gray;
  PanTilt reported;    // may be wrong by a factor, even a negative one
  bool moves = false;  // taken in motion
};

struct PictureAngles {
  // The angles at each picture. The first picture that shares its view with others has the angles
  // that were reported; the other angles are relative to it. nullopt if too little of the picture's
  // scenery is found in other pictures.
  std::vector<std::optional<PanTilt>> angles;
  double rms_px = 0.0;  // of the points that agree
};

// Each picture taken at rest must share most of its view with an earlier picture taken at rest.
// Each picture taken in motion must share most of its view with any picture taken at rest.
// `geometry`: its lens determines the scale of all angles.
PictureAngles angles_of_pictures(const StationGeometry& geometry,
                                 const std::vector<TurnedPicture>& pictures);

}  // namespace ols::calibration
