// The skyline of a map of the land in a picture, and the found one as directions. Pure.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/skyline/skyline_finder.h"
#include "geometry/direction.h"
#include "geometry/lens.h"
#include "land/horizon_map.h"

namespace ols::skyline {

// How a picture was taken, according to the station.
struct PictureView {
  Eigen::Matrix3d R_enu_cam = Eigen::Matrix3d::Identity();  // in the frame of the map's camera
  CameraIntrinsics camera;
};

// The row of the land's skyline in each strip of a picture. The sigmas are wide enough for a
// station whose heading and tilt are somewhat wrong. nullopt where the land is unknown and where
// the skyline is far outside the picture.
Rows expected_rows(const land::HorizonMap& map, const PictureView& view);

// The direction of a found row.
struct SkylinePoint {
  AzimuthElevation direction;
  double sd_rad = 0.0;  // 1-sigma of the elevation, from the picture alone
};
std::vector<SkylinePoint> directions(const Rows& found, const PictureView& view);

}  // namespace ols::skyline
