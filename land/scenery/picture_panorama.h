// Makes a station's panorama from its pictures, and chooses which part of it shows the same scenery
// as which part of another station's. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "geometry/lens.h"
#include "geometry/wgs84.h"
#include "land/scenery/possible_ranges.h"
#include "land/scenery/scene_panorama.h"

namespace ols::scenery {

struct ScenePicture {
  cv::Mat1b gray;
  CameraIntrinsics camera;
  // From the camera's axes to east, north, up at the station.
  Eigen::Matrix3d R_enu_camera = Eigen::Matrix3d::Identity();
};

// A part of a panorama.
struct SceneBox {
  double first_azimuth_rad = 0.0, width_rad = 0.0;  // clockwise
  double bottom_rad = 0.0, top_rad = 0.0;           // elevations
};

// The elevations that the pictures show, all around. Throws std::invalid_argument if there is no
// picture.
SceneBox around(const std::vector<ScenePicture>& pictures);

// Fills `panorama` with the box, at its scale, from the pictures; uses its `rad_per_px` only. Of
// several pictures that show a place, the one is used whose optical axis is nearest to it. Where no
// picture shows anything, the gray value is kUnseen; elsewhere it is at least 1.
void draw(const std::vector<ScenePicture>& pictures, const SceneBox& box, ScenePanorama& panorama);

struct SharedBoxes {
  SceneBox own, other;
};

// The smallest boxes that show to both stations whatever can stand in `sector` of the first one's
// panorama. A place where the lines of sight of both stations meet at more than 50 degrees does not
// count, because it looks too different. nullopt if nothing can stand there.
std::optional<SharedBoxes> shared_boxes(const SceneBox& sector, const LocalFrame& camera,
                                        const LocalFrame& other, const PossibleRanges& possible);

}  // namespace ols::scenery
