// The object that a person points at: the compact thing at this pixel that stands out from what is
// around it. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::tracker {

// Its box in the image, or nothing: nothing there stands out, or what does is larger than 90 px.
// Of several the one nearest to the pixel counts, at most 24 px away.
std::optional<cv::Rect2d> object_at(const cv::Mat& gray, const Eigen::Vector2d& pixel);

}  // namespace ols::tracker
