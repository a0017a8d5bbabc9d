#include "edge/frames/frame_history.h"

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

std::vector<const camera::Frame*> FrameHistory::since(double mid_exposure_s) const {
  const auto first = std::ranges::upper_bound(
      frames_, mid_exposure_s, {}, [](const auto& frame) { return frame.mid_exposure_s; });
  const auto count = static_cast<std::size_t>(frames_.end() - first);
  const std::size_t stride = std::max<std::size_t>(1, (count + kMostSince - 1) / kMostSince);
  std::vector<const camera::Frame*> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    if ((count - 1 - i) % stride == 0) chosen.push_back(&first[static_cast<std::ptrdiff_t>(i)]);
  }
  return chosen;
}

}  // namespace ols::station
