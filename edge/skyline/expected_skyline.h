// The rows of a picture where the map of the land expects the skyline, and the directions of the
// skyline that was found. Pure.
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

// 1-sigma of heading and tilt that is added to what the station states, so that errors larger than
// stated are still found at once.
inline constexpr double kHeadingSd_rad = radians(0.3), kTiltSd_rad = radians(0.1);

// How a picture was taken, according to the station.
struct PictureView {
  Eigen::Matrix3d R_enu_cam = Eigen::Matrix3d::Identity();  // in the frame of the map's camera
  CameraIntrinsics camera;
  // 1-sigma of the picture's directions, as the station states it.
  double azimuth_sd_rad = 0.0, elevation_sd_rad = 0.0;
};

// The map's skyline. Nearer land may be lower than the crest by so little that, with the map's
// errors, it may cover the crest. The sigma is then that of the nearer land. nullopt where the land
// is unknown.
std::optional<land::Skyline> uncertain_skyline(const land::HorizonMap& map, double azimuth_rad);

// The row of the land's skyline in each strip of a picture. The sigmas are wide enough for a
// station whose errors of heading and tilt are somewhat larger than stated. nullopt where the land
// is unknown and where the skyline is far outside the picture.
Rows expected_rows(const land::HorizonMap& map, const PictureView& view);

// The same rows, with sigmas wide enough for obstacles that stand kHighest_rad above the skyline.
Rows widely_expected(Rows rows, const PictureView& view);
inline constexpr double kHighest_rad = radians(2.0);

// The direction of a found row.
struct SkylinePoint {
  AzimuthElevation direction;
  double sd_rad = 0.0;  // 1-sigma of the elevation, from the picture alone
};
std::vector<SkylinePoint> directions(const Rows& found, const PictureView& view);

}  // namespace ols::skyline
