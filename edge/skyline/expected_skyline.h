// Computes the rows of a picture at which the map of the land expects the skyline, and the
// directions of the skyline that was found in the picture. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/skyline/skyline_finder.h"
#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/lens.h"
#include "land/horizon_map.h"

namespace ols::skyline {

// 1-sigma of heading and tilt. It is added in quadrature to the 1-sigma that the station states, so
// that errors larger than stated are found, too.
inline constexpr double kHeadingSd_rad = radians(0.3), kTiltSd_rad = radians(0.1);

// Direction and camera of a picture, as the station states them.
struct PictureView {
  // Rotates from the camera's axes to east, north, up at the place for which the map was made.
  Eigen::Matrix3d R_enu_cam = Eigen::Matrix3d::Identity();
  CameraIntrinsics camera;
  // 1-sigma of the picture's directions, as the station states them.
  double azimuth_sd_rad = 0.0, elevation_sd_rad = 0.0;
};

// The map's skyline. If nearer land is lower than the crest by less than two of its own sigmas,
// this land may in reality hide the crest. The result then has the greater one of the two sigmas.
// nullopt where the land is unknown.
std::optional<land::Skyline> uncertain_skyline(const land::HorizonMap& map, double azimuth_rad);

// The row of the land's skyline in each strip of a picture. The sigmas contain kHeadingSd_rad and
// kTiltSd_rad. nullopt where the land is unknown, or where the skyline is far outside the picture.
Rows expected_rows(const land::HorizonMap& map, const PictureView& view);

// The same rows with greater sigmas, so that obstacles up to kHighest_rad above the skyline are
// found.
Rows widely_expected(Rows rows, const PictureView& view);
inline constexpr double kHighest_rad = radians(2.0);

// The direction of a found row.
struct SkylinePoint {
  AzimuthElevation direction;
  double sd_rad = 0.0;  // 1-sigma of the elevation, from the picture alone
};
std::vector<SkylinePoint> directions(const Rows& found, const PictureView& view);

}  // namespace ols::skyline
