#include "edge/frames/frame_service.h"

#include <algorithm>
#include <cmath>

namespace ols::station {
namespace {

constexpr std::size_t kMostRequests = 4;  // of several senders
constexpr std::size_t kMostFrames = 4;    // that wait for their angles
constexpr double kStill_counts = 0.6;     // a standing axis whose readings are averages of two

bool stood(const PointingModel& unit, double from_s, double to_s) {
  constexpr double kLook_s = 0.02;
  const auto end = unit.counts_at(to_s);
  if (!end) return false;
  for (double time_s = from_s; time_s < to_s; time_s += kLook_s) {
    const auto then = unit.counts_at(time_s);
    if (!then || std::abs(then->pan - end->pan) > kStill_counts ||
        std::abs(then->tilt - end->tilt) > kStill_counts) {
      return false;
    }
  }
  return true;
}

bool meets(const FrameRequest& wanted, double mid_s, const ExposedCounts& counts,
           const PointingModel& unit) {
  if (wanted.at) {
    const double pan_off = counts.pan * counts.count.pan_rad - wanted.at->pan_rad;
    const double tilt_off = counts.tilt * counts.count.tilt_rad - wanted.at->tilt_rad;
    if (std::max(std::abs(pan_off), std::abs(tilt_off)) > wanted.tolerance_rad) return false;
  }
  return wanted.still_s == 0.0 || stood(unit, mid_s - wanted.still_s, mid_s);
}

}  // namespace

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

void FrameService::on_frame(const camera::Frame& frame) {
  if (requests_.empty()) return;
  frames_.push_back(frame);
  if (frames_.size() > kMostFrames) frames_.pop_front();
}

// A frame without angles waits for them until newer frames need its place.
std::vector<RequestedFrame> FrameService::take(double now_s, const PointingModel& unit) {
  std::erase_if(requests_,
                [now_s](const FrameRequest& wanted) { return wanted.expires_s <= now_s; });
  std::vector<RequestedFrame> answers;
  std::erase_if(frames_, [&](const camera::Frame& frame) {
    const auto counts = unit.counts_at(frame.mid_exposure_s);
    if (!counts) return false;
    std::erase_if(requests_, [&](const FrameRequest& wanted) {
      if (!meets(wanted, frame.mid_exposure_s, *counts, unit)) return false;
      answers.push_back({wanted, frame, *counts});
      return true;
    });
    return true;
  });
  if (requests_.empty()) frames_.clear();
  return answers;
}

}  // namespace ols::station
