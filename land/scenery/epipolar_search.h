// Looks for a patch of one panorama along its epipolar line in another one. Pure.
//
// What is upright (a wall, a tree, a mast) looks wider or narrower from another direction, and
// larger or smaller from another distance, but its upright edges stay upright. So the patch is
// compared at several widths, with the height that the distances give, along the line. Level ground
// is sheared besides, and is seldom found.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "land/scenery/possible_ranges.h"
#include "land/scenery/scene_panorama.h"

namespace ols::scenery {

// A panorama at full size, at half of it, ...
struct ScenePyramid {
  const ScenePanorama* panorama;
  std::vector<cv::Mat1f> levels;
};
ScenePyramid pyramid_of(const ScenePanorama& panorama, int levels);

// Pixels of the panorama, and those of a level.
double to_level(double px, int level);
double from_level(double px, int level);
Eigen::Vector2d to_level(const Eigen::Vector2d& px, int level);
Eigen::Vector2d from_level(const Eigen::Vector2d& px, int level);

inline constexpr int kPatchHalf = 7;  // [px of a level]; a patch has twice that and one

// Slope of the epipolar line at a pixel: downwards, per pixel to the right.
double epipolar_slope(const ScenePanorama& panorama, const ScenePanorama& other,
                      const Eigen::Vector2d& px, double range_m);

struct PatchPlace {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  // of the other panorama
  double range_m = 0.0;                          // from the first one
  // How the patch is drawn there: its axes in pixels of the other panorama.
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();
  // Normalised correlation; that of the best other place, 0 if there is none.
  double score = 0.0, second = 0.0;
};

struct SearchLine {
  RangeInterval ranges;
  int beside_px = 2;  // rows of the level searched above and below the line
  // By how much the other panorama shows a column's points lower than the poses say [px].
  std::function<double(double x_px)> lower_px;
};

// nullopt if nothing there is like the patch.
std::optional<PatchPlace> find_patch(const ScenePyramid& pyramid, const ScenePyramid& other,
                                     int level, const Eigen::Vector2d& px, const SearchLine& line);

// The highest normalised correlation of the patch with other places of its own panorama, up to
// `reach_px` (of the level) to either side along `slope`; 0 if there is none. Windows of a house
// are alike: if the other station sees only some of them, the best place there may be another
// window.
double likest_beside(const ScenePyramid& pyramid, int level, const Eigen::Vector2d& px,
                     double slope, double reach_px);

}  // namespace ols::scenery
