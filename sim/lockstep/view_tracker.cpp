#include "sim/lockstep/view_tracker.h"

#include <algorithm>

namespace ols::sim {

void ViewMemory::add(double time_s, const ViewTruth& view) {
  constexpr std::size_t kFrames = 100;
  views_.emplace_back(time_s, view);
  if (views_.size() > kFrames) views_.pop_front();
}

const ViewTruth* ViewMemory::at(double time_s) const {
  const auto found = std::find_if(views_.rbegin(), views_.rend(),
                                  [&](const auto& entry) { return entry.first == time_s; });
  return found == views_.rend() ? nullptr : &found->second;
}

ViewTracker::ViewTracker(const ViewMemory& views, double pixel_sd_px, std::uint64_t seed)
    : views_(views), pixel_sd_px_(pixel_sd_px), generator_(seed) {}

std::optional<tracker::TrackerError> ViewTracker::initialise(const tracker::TrackerInput& frame,
                                                             const cv::Rect2d& box) {
  const ViewTruth* view = views_.at(frame.time_s);
  if (view == nullptr || !view->visible) return tracker::TrackerError::kBox;
  // A box begins at a pixel's edge, half a pixel before its centre.
  const Eigen::Vector2d middle_px(box.x + 0.5 * box.width - 0.5, box.y + 0.5 * box.height - 0.5);
  offset_m_ = (middle_px - view->centre_px) / view->px_per_m;
  return std::nullopt;
}

tracker::TrackerResult ViewTracker::track(const tracker::TrackerInput& frame) {
  const ViewTruth* view = views_.at(frame.time_s);
  if (!offset_m_ || view == nullptr) return {std::nullopt, tracker::TrackerError::kNotInitialised};
  const double noise_x = normal_(generator_), noise_y = normal_(generator_);
  tracker::TrackerOutput output;
  output.pixel = view->centre_px + view->px_per_m * *offset_m_ +
                 pixel_sd_px_ * Eigen::Vector2d(noise_x, noise_y);
  output.box = view->box;
  output.covariance_px2 = pixel_sd_px_ * pixel_sd_px_ * Eigen::Matrix2d::Identity();
  output.belief = view->visible ? 0.95 : 0.0;
  return {output, std::nullopt};
}

}  // namespace ols::sim
