#include "edge/frame_history.h"

#include <algorithm>
#include <cmath>

namespace ols::station {

bool FrameHistory::add(const camera::Frame& frame) {
  if (!frames_.empty() && frame.mid_exposure_s <= frames_.back().mid_exposure_s) return false;
  frames_.push_back(frame);
  while (frame.mid_exposure_s - frames_.front().mid_exposure_s > span_s_) frames_.pop_front();
  return true;
}

const camera::Frame* FrameHistory::find(const std::optional<double>& mid_exposure_s) const {
  if (frames_.empty()) return nullptr;
  if (!mid_exposure_s) return &frames_.back();
  const auto distance_s = [&](const camera::Frame& frame) {
    return std::abs(frame.mid_exposure_s - *mid_exposure_s);
  };
  constexpr double kSameFrame_s = 0.02;
  const auto nearest = std::ranges::min_element(frames_, {}, distance_s);
  return distance_s(*nearest) < kSameFrame_s ? &*nearest : nullptr;
}

}  // namespace ols::station
