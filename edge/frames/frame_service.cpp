#include "edge/frames/frame_service.h"

#include <algorithm>
#include <cmath>

namespace ols::station {
namespace {

constexpr std::size_t kMostRequests = 4;  // of several senders
constexpr std::size_t kMostFrames = 4;    // that wait for their angles
constexpr double kStill_counts = 0.6;     // a standing axis whose readings are averages of two

}  // namespace

void FrameService::set_count(const PanTilt& count_rad) {
  if (count_rad.pan_rad == count_rad_.pan_rad && count_rad.tilt_rad == count_rad_.tilt_rad) return;
  count_rad_ = count_rad;
  approach_.set_step(count_rad);
}

std::string FrameService::request(const FrameRequest& wanted) {
  constexpr double kMostStill_s = 2.0;
  if (!(wanted.still_s >= 0.0 && wanted.still_s <= kMostStill_s)) return "still_s is not 0..2 s";
  if (wanted.at && !(wanted.tolerance_rad > 0.0 && std::isfinite(wanted.at->pan_rad) &&
                     std::isfinite(wanted.at->tilt_rad))) {
    return "the angles or their tolerance are not numbers";
  }
  std::erase_if(requests_,
                [&](const FrameRequest& other) { return other.boot_id == wanted.boot_id; });
  if (requests_.size() >= kMostRequests) return "too many ask for frames";
  requests_.push_back(wanted);
  return "";
}

void FrameService::on_angles(const mount::AngleSample& sample) {
  if (trusted_ && history_.add(sample)) approach_.add(sample.time_s, sample.angles);
}

void FrameService::set_trusted(bool trusted) {
  trusted_ = trusted;
  if (trusted) return;
  history_.clear();
  approach_.clear();
  frames_.clear();
}

void FrameService::on_frame(const camera::Frame& frame) {
  if (requests_.empty() || !trusted_) return;
  frames_.push_back(frame);
  if (frames_.size() > kMostFrames) frames_.pop_front();
}

std::optional<ExposedCounts> FrameService::counts_at(double time_s) const {
  const auto at = history_.at(time_s);
  if (!at || !at->interpolated || count_rad_.pan_rad <= 0.0 || count_rad_.tilt_rad <= 0.0) {
    return std::nullopt;
  }
  ExposedCounts counts;
  counts.count = count_rad_;
  counts.pan = at->angles.pan_rad / count_rad_.pan_rad;
  counts.tilt = at->angles.tilt_rad / count_rad_.tilt_rad;
  counts.pan_s = at->rate.pan_rad / count_rad_.pan_rad;
  counts.tilt_s = at->rate.tilt_rad / count_rad_.tilt_rad;
  counts.approach = approach_.at(time_s);
  return counts;
}

bool FrameService::stood(double from_s, double to_s) const {
  constexpr double kLook_s = 0.02;
  const auto end = counts_at(to_s);
  if (!end) return false;
  for (double time_s = from_s; time_s < to_s; time_s += kLook_s) {
    const auto then = counts_at(time_s);
    if (!then || std::abs(then->pan - end->pan) > kStill_counts ||
        std::abs(then->tilt - end->tilt) > kStill_counts) {
      return false;
    }
  }
  return true;
}

bool FrameService::meets(const FrameRequest& wanted, const camera::Frame& frame,
                         const ExposedCounts& counts) const {
  if (wanted.at) {
    const double pan_off = counts.pan * count_rad_.pan_rad - wanted.at->pan_rad;
    const double tilt_off = counts.tilt * count_rad_.tilt_rad - wanted.at->tilt_rad;
    if (std::max(std::abs(pan_off), std::abs(tilt_off)) > wanted.tolerance_rad) return false;
  }
  const double mid_s = frame.mid_exposure_s;
  return wanted.still_s == 0.0 || stood(mid_s - wanted.still_s, mid_s);
}

std::vector<RequestedFrame> FrameService::take(double now_s) {
  std::erase_if(requests_,
                [now_s](const FrameRequest& wanted) { return wanted.expires_s <= now_s; });
  std::vector<RequestedFrame> answers;
  while (!frames_.empty() && !requests_.empty()) {
    const auto counts = counts_at(frames_.front().mid_exposure_s);
    if (!counts) break;  // its angles may still come
    const camera::Frame frame = frames_.front();
    frames_.pop_front();
    std::erase_if(requests_, [&](const FrameRequest& wanted) {
      if (!meets(wanted, frame, *counts)) return false;
      answers.push_back({wanted, frame, *counts});
      return true;
    });
  }
  if (requests_.empty()) frames_.clear();
  return answers;
}

}  // namespace ols::station
