// Measures the size of an object against a smooth background to a fraction of a pixel. A box of
// whole pixels in a pyramid level is too coarse, because its steps look like a wing beat.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::detector {

struct Outline {
  // [px] Width and height of the upright box around an ellipse. The ellipse has the second moments
  // of the object's contrast.
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d sd_px = Eigen::Vector2d::Zero();  // 1-sigma that image noise causes
};

// `gray`: 8-bit, one channel. `centre`: the object's approximate centre. `extent_px`: its
// approximate longer side. Returns nullopt in three cases: the object hardly stands out from its
// surroundings; it is connected with something farther from `centre` than `extent_px`; or the edge
// of the image is nearer than `extent_px`.
std::optional<Outline> outline_at(const cv::Mat& gray, const Eigen::Vector2d& centre,
                                  double extent_px);

}  // namespace ols::detector
