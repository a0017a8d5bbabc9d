// Finds the object at which a person points: a compact object, at or near a pixel, that contrasts
// with its surroundings. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::tracker {

// Returns the box of the nearest object within 24 px of `pixel`; nullopt if there is none. Objects
// larger than 90 px are ignored. `gray`: 8-bit, one channel.
std::optional<cv::Rect2d> object_at(const cv::Mat& gray, const Eigen::Vector2d& pixel);

}  // namespace ols::tracker
