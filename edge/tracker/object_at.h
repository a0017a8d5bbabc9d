// Finds the object at which a person points: the compact object at this pixel that contrasts with
// its surroundings. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::tracker {

// Returns its box in the image; nullopt if nothing there contrasts, or if the object is larger than
// 90 px. If there are several, it is the one nearest to the pixel, at most 24 px away.
std::optional<cv::Rect2d> object_at(const cv::Mat& gray, const Eigen::Vector2d& pixel);

}  // namespace ols::tracker
