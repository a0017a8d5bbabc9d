// Fits a patch to the place where the search has found it, to a fraction of a pixel. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::scenery {

struct PatchFit {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  Eigen::Vector2d sd_px = Eigen::Vector2d::Zero();      // 1-sigma, by the residuals
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();  // adjusted axes
  double score = 0.0;                                   // normalised correlation
};

// All in pixels of the two images. The patch of `image` about `px` lies along `slope` (downwards
// per pixel to the right). `start`, `shape`: its centre and its axes in `other`. Position, axes,
// contrast and brightness are adjusted by least squares; the axes stay near `shape`. nullopt if the
// fit does not settle within 4 pixels of `start`.
std::optional<PatchFit> fit_patch(const cv::Mat1f& image, const Eigen::Vector2d& px, double slope,
                                  const cv::Mat1f& other, const Eigen::Vector2d& start,
                                  const Eigen::Matrix2d& shape);

// The place in the patch of `image` about `px` where the brightness changes most along `slope`, as
// an offset from the patch's centre. This place decides where the patch is found. A corner may lie
// on the far side of an edge; the patch then moves with the near side, whose edge is at this place.
Eigen::Vector2d deciding_offset(const cv::Mat1f& image, const Eigen::Vector2d& px, double slope);

}  // namespace ols::scenery
