// Searches all directions for those in which the skyline of the land lies where a photograph may
// have its own. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/skyline/picture_evidence.h"
#include "geometry/lens.h"
#include "land/horizon_map.h"

namespace ols::skyline {

struct PicturePose {
  double heading_rad = 0.0;  // azimuth of the optical axis
  double tilt_rad = 0.0;     // elevation of the optical axis
  double roll_rad = 0.0;     // positive: the right side of the picture is lowered
};
// Rotates from the camera's axes to east, north, up.
Eigen::Matrix3d R_enu_cam(const PicturePose& pose);

// What is known of a photograph beforehand, with 1-sigmas.
struct PicturePrior {
  std::optional<double> heading_rad;  // nullopt: all around
  double heading_sd_rad = 0.0;
  double tilt_rad = 0.0, tilt_sd_rad = 0.0;
  double roll_rad = 0.0, roll_sd_rad = 0.0;
  double focal_sd = 0.0;                                     // of the focal length, as a part of it
  double k1_sd = 0.0;                                        // of the lens's first coefficient
  Eigen::Vector3d place_sd_enu_m = Eigen::Vector3d::Zero();  // of the camera in the model
};

// Whether a heading is within three sigmas of the stated one.
bool is_within(const PicturePrior& prior, double heading_rad);

struct PoseCandidate {
  PicturePose pose;
  double score = 0.0;  // sum of the evidence, and the logarithm of the prior but for the heading
};

// The size of a cell for PictureEvidence.
int cell_px_for(const CameraIntrinsics& camera);

// The best pose for each of some hundred headings all around, as far as the land there is known.
std::vector<PoseCandidate> search_poses(const PictureEvidence& evidence,
                                        const CameraIntrinsics& camera, const land::HorizonMap& map,
                                        const PicturePrior& prior);

// The evidence for one pose: the sum over the columns of cells.
double evidence_for(const PicturePose& pose, const PictureEvidence& evidence,
                    const CameraIntrinsics& camera, const land::HorizonMap& map);

}  // namespace ols::skyline
