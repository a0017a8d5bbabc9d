// The scenery as one station sees it, with the pose that the station states; and the range of a
// point that two such panoramas show. Pure.
//
// A pixel is (x, y), growing with azimuth and downwards; (0, 0) is the centre of the first pixel.
// Elevations are apparent: lifted by the usual refraction (land/refraction.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "geometry/direction.h"

namespace ols::scenery {

struct PoseSd {  // 1-sigma; the errors are the same in the whole panorama
  double heading_rad = 0.0;
  double tilt_rad = 0.0;    // for each of two axes
  double position_m = 0.0;  // each axis
};

inline constexpr std::uint8_t kUnseen = 0;

struct ScenePanorama {
  cv::Mat1b gray;                  // kUnseen where no picture shows anything
  double first_azimuth_rad = 0.0;  // of the first column
  double top_elevation_rad = 0.0;  // of the first row
  double rad_per_px = 0.0;         // the same in azimuth and elevation
  Eigen::Vector3d centre_ecef = Eigen::Vector3d::Zero();
  // From the axes of its azimuths and elevations: east, north, up at the station.
  Eigen::Matrix3d R_ecef_enu = Eigen::Matrix3d::Identity();
  PoseSd sd;
};

// An error of a pose.
struct PoseError {
  double heading_rad = 0.0;
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();
  Eigen::Vector3d position_enu_m = Eigen::Vector3d::Zero();
};
// The panorama as it would be stated with this error.
ScenePanorama with_error(const ScenePanorama& panorama, const PoseError& error);

AzimuthElevation direction_of(const ScenePanorama& panorama, const Eigen::Vector2d& px);
Eigen::Vector3d point_ecef(const ScenePanorama& panorama, const Eigen::Vector2d& px,
                           double range_m);

struct ScenePixel {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  // may be outside the panorama
  double range_m = 0.0;
};
ScenePixel pixel_of(const ScenePanorama& panorama, const Eigen::Vector3d& p_ecef);

// The range along a pixel's line of sight at which the other panorama has the point in column
// `other_x_px`. `guess_m`: any range near it. nullopt if there is none, or if the line is seen
// lengthwise from the other station.
std::optional<double> range_m(const ScenePanorama& panorama, const ScenePanorama& other,
                              const Eigen::Vector2d& px, double other_x_px, double guess_m);
// 1-sigma of that range from the errors of both poses.
double range_sd_m(const ScenePanorama& panorama, const ScenePanorama& other,
                  const Eigen::Vector2d& px, double other_x_px, double range_m);

}  // namespace ols::scenery
