// Ranges of scenery: what two stations see, matched in their panoramas with the poses that they
// state. Pure, but slow: a minute for two panoramas of 40 by 8 degrees.
//
// 1. Corners of one panorama are looked for along their epipolar lines in the other one. A place
//    counts if it is much more alike than any other, and if the search back leads to the corner.
// 2. What is right lies on the epipolar line to a tenth of a pixel, but for what the errors of tilt
//    and position do to a whole panorama; that is fitted, and the rest must be small.
// 3. Around each place further corners are looked for at about the same range. Things have an
//    extent: where the place is right, many are found; where it is wrong, few. Only places with
//    enough of these count.
// 4. What repeats along the line in the first panorama itself, such as the windows of a house, does
//    not count.
//
// The range is given to the place in the patch where the brightness changes most along the line. If
// a corner is found beside the edge of a tree, the patch moves with the tree, and the range is that
// of the edge.
//
// What stands up is found: houses, trees, masts, steep slopes. Level ground is seldom found.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "land/scenery/possible_ranges.h"
#include "land/scenery/scene_panorama.h"

namespace ols::scenery {

struct SceneryRange {
  AzimuthElevation direction;  // from the first station, as its panorama has it
  double range_m = 0.0;
  double sd_white_m = 0.0;       // 1-sigma, from the pictures; its own for each point
  double sd_systematic_m = 0.0;  // 1-sigma, from the poses; all ranges err alike
  Eigen::Vector2d px = Eigen::Vector2d::Zero();        // of the first panorama
  Eigen::Vector2d other_px = Eigen::Vector2d::Zero();  // of the second one

  double sd_m() const { return std::hypot(sd_white_m, sd_systematic_m); }
};

// Both panoramas have the same scale. `possible`, `possible_other`: from the first and from the
// second station.
std::vector<SceneryRange> scenery_ranges(const ScenePanorama& panorama, const ScenePanorama& other,
                                         const PossibleRanges& possible,
                                         const PossibleRanges& possible_other);

}  // namespace ols::scenery
