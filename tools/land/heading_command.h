// ols-land heading: the direction of one photograph by the skyline of the land.
#pragma once

#include <string>

#include "edge/skyline/picture_search.h"
#include "geometry/wgs84.h"

namespace ols::land {

struct HeadingOptions {
  std::string folder, picture;
  Geodetic at;
  double reach_m = 0.0;
  // Its width and height are read from the picture; NaN in fy, cx and cy: as fx, the middle.
  CameraIntrinsics camera;
  skyline::PicturePrior prior;
  double position_sd_m = 0.0;
};

// Prints the heading, or why there is none. Returns the program's exit status. Throws
// std::runtime_error if the picture or the folder cannot be read, std::invalid_argument if the
// place does not fit the land.
int print_heading(HeadingOptions options);

}  // namespace ols::land
