#include "edge/detector/scene_background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/ego_motion.h"

namespace ols::detector {
namespace {

// Warps an earlier image to the present view; `seen` marks the pixels that it covers.
void bring(const cv::Mat& earlier, const Eigen::Matrix3d& to_present, cv::Mat& image,
           cv::Mat& seen) {
  const double moved = (to_present - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  seen = cv::Mat(earlier.size(), CV_8U, cv::Scalar(255));
  if (moved < 1e-6) {
    image = earlier;
    return;
  }
  cv::Mat matrix;
  cv::eigen2cv(to_present, matrix);
  cv::warpPerspective(earlier, image, matrix, earlier.size(), cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  cv::Mat inside;
  cv::warpPerspective(seen, inside, matrix, earlier.size(), cv::INTER_NEAREST);
  seen = inside;
}

cv::Mat median_of(const cv::Mat& a, const cv::Mat& b, const cv::Mat& c) {
  cv::Mat lower, upper, median;
  cv::min(a, b, lower);
  cv::max(a, b, upper);
  cv::min(upper, c, upper);
  cv::max(lower, upper, median);
  return median;
}

SceneBackground::Range within_a_pixel(const cv::Mat& least, const cv::Mat& greatest) {
  const cv::Mat element = cv::Mat::ones(3, 3, CV_8U);
  SceneBackground::Range range;
  cv::erode(least, range.low, element);
  cv::dilate(greatest, range.high, element);
  return range;
}

}  // namespace

void SceneBackground::advance(const Eigen::Matrix3d& motion) {
  for (Kept& kept : kept_) kept.to_present = motion * kept.to_present;
  std::erase_if(kept_, [](const Kept& kept) { return !tracker::aligns(kept.to_present); });
}

bool SceneBackground::ready(double time_s) const {
  return kept_.size() >= 3 && time_s - kept_.front().time_s >= kLeastAge_s;
}

const SceneBackground::Kept& SceneBackground::aged(double age_s, double time_s) const {
  return *std::min_element(kept_.begin(), kept_.end(), [&](const Kept& a, const Kept& b) {
    return std::abs(time_s - a.time_s - age_s) < std::abs(time_s - b.time_s - age_s);
  });
}

SceneBackground::Scene SceneBackground::scene(double time_s) const {
  const double span_s = std::min(kSpan_s, time_s - kept_.front().time_s);
  std::array<cv::Mat, 3> images, seen;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Kept& kept = aged(span_s * (static_cast<double>(i) + 1.0) / 3.0, time_s);
    bring(kept.image, kept.to_present, images[i], seen[i]);
  }
  const cv::Mat median = median_of(images[0], images[1], images[2]);
  cv::Mat least, greatest;
  cv::min(images[0], images[1], least);
  cv::min(least, images[2], least);
  cv::max(images[0], images[1], greatest);
  cv::max(greatest, images[2], greatest);
  return {within_a_pixel(median, median), within_a_pixel(least, greatest),
          seen[0] & seen[1] & seen[2]};
}

void SceneBackground::remember(const cv::Mat& image, double time_s) {
  constexpr double kInterval_s = 0.09;
  if (!kept_.empty() && time_s - kept_.back().time_s < kInterval_s) return;
  kept_.push_back({image, time_s, Eigen::Matrix3d::Identity()});
  while (time_s - kept_.front().time_s > kSpan_s + kInterval_s) kept_.pop_front();
}

}  // namespace ols::detector
